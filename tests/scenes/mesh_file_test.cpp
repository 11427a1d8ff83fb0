#include "scenes/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "scenes/scene_file.h"
#include "tests/scenes/temporary_folder.h"

namespace grimaldi {
namespace {

std::string all_messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& one : diagnostics.all()) text += to_string(one) + "\n";
  return text;
}

template <typename T>
std::string bytes_of(T value) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string replaced(std::string text, std::string_view old, std::string_view now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

// Signed volume enclosed by the meshes; positive if the fronts look outwards.
double volume(const std::vector<MeshDescription>& meshes) {
  double sum = 0;
  for (const MeshDescription& mesh : meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
    }
  }
  return sum;
}

struct MeshFile : testing::Test {
  std::vector<MeshDescription> read(const std::string& name, std::string_view contents) {
    diagnostics = {};
    return read_with_assimp(folder.write(name, contents), diagnostics);
  }
  void refused(const std::string& name, std::string_view contents, std::string_view words) {
    const auto meshes = read(name, contents);
    EXPECT_TRUE(diagnostics.has_errors()) << "wanted: " << words;
    EXPECT_NE(all_messages(diagnostics).find(words), std::string::npos) << all_messages(diagnostics);
  }
  TemporaryFolder folder;
  Diagnostics diagnostics;
};

const std::string box_obj =
    "# a box 2 x 3 x 5, quads, outward\nmtllib none.mtl\no box\n"
    "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 5\nv 2 0 5\nv 2 3 5\nv 0 3 5\n"
    "usemtl itu_concrete\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    "usemtl ITU Metal\nf -4 -3 -2 -1\n";

TEST_F(MeshFile, ObjBox) {
  const auto meshes = read("box.obj", box_obj);
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].triangles.size(), 10u);
  EXPECT_EQ(meshes[1].triangles.size(), 2u);
  EXPECT_EQ(meshes[0].material, "concrete");
  EXPECT_EQ(meshes[1].material, "metal");
  EXPECT_EQ(meshes[0].name, "box");
  EXPECT_EQ(volume(meshes), 30);  // small whole numbers: every product is exact
  double top = 0;
  for (const Vec3& vertex : meshes[1].vertices) top = std::max(top, vertex.z);
  EXPECT_EQ(top, 5);  // z stays up
}

TEST_F(MeshFile, NoMaterialIsEmpty) {
  const auto obj = read("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(obj.size(), 1u) << all_messages(diagnostics);
  EXPECT_EQ(obj[0].material, "");
  // Faces before the first usemtl name none either.
  const auto later = read("later.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl wood\nf 3 2 1\n");
  ASSERT_EQ(later.size(), 2u);
  EXPECT_EQ(later[0].material, "");
  EXPECT_EQ(later[1].material, "wood");
  // A material holds for the objects that follow, until the next usemtl.
  const auto kept = read("kept.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl wood\nf 1 2 3\no b\nf 3 2 1\n");
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[1].material, "wood");
}

TEST_F(MeshFile, LinesAndPointsArePassedOver) {
  const auto meshes = read("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\nf 1 2 3\n");
  EXPECT_FALSE(diagnostics.has_errors()) << all_messages(diagnostics);
  std::size_t triangles = 0;
  for (const auto& mesh : meshes) triangles += mesh.triangles.size();
  EXPECT_EQ(triangles, 1u);
}

TEST_F(MeshFile, FarCoordinatesWarn) {
  const auto meshes = read("far.obj", "v 4463781.25 5 0\nv 4463782.3 5 0\nv 4463781 7 0\nf 1 2 3\n");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_NE(all_messages(diagnostics).find("single precision"), std::string::npos);
  ASSERT_EQ(meshes.size(), 1u);
  // Half the spacing of floats between 2²² and 2²³ is 0.25 m.
  EXPECT_NEAR(meshes[0].vertices[1].x, 4463782.3, 0.25);
}

TEST_F(MeshFile, StlTextAndBinary) {
  const auto text = read("a.stl",
                         "solid roof\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                         "endloop\nendfacet\nendsolid roof\n");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(text.size(), 1u);
  EXPECT_EQ(text[0].triangles.size(), 1u);
  EXPECT_EQ(text[0].material, "");

  std::string binary(80, ' ');
  binary += bytes_of(std::uint32_t{2});
  for (int i = 0; i < 2; ++i) {
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 2.5f, 1.f, 0.f, 2.5f, 0.f, 1.f, 2.5f}) binary += bytes_of(value);
    binary += bytes_of(std::uint16_t{0});
  }
  const auto two = read("b.stl", binary);
  ASSERT_EQ(two.size(), 1u) << all_messages(diagnostics);
  EXPECT_EQ(two[0].triangles.size(), 2u);
  EXPECT_EQ(two[0].vertices[0].z, 2.5);

  refused("c.stl", replaced(binary, bytes_of(std::uint32_t{2}), bytes_of(std::uint32_t{4000000000u})), "stl");
  refused("d.stl", binary.substr(0, 120), "stl");
  refused("e.stl", "s", "stl");
}

std::string gltf(const std::string& node, const std::string& material = R"("materials": [{"name": "itu_brick"}],)") {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f}) bytes += bytes_of(value);  // y up: 2 m high
  for (const std::uint16_t index : {0, 1, 2, 0}) bytes += bytes_of(index);
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + node + "], " +
         material + R"("meshes": [{"name": "wall", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1)" +
         (material.empty() ? "" : R"(, "material": 0)") + R"(}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0]},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8}],
    "buffers": [{"byteLength": 44, "uri": "data:application/octet-stream;base64,)" +
         base64(bytes) + R"("}]})";
}

TEST_F(MeshFile, GltfIsTurnedUpright) {
  const auto meshes = read("wall.gltf", gltf(R"({"mesh": 0})"));
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].material, "brick");
  ASSERT_EQ(meshes[0].triangles.size(), 1u);
  const auto& [a, b, c] = meshes[0].triangles[0];
  EXPECT_EQ(meshes[0].vertices[b], (Vec3{1, 0, 0}));
  EXPECT_EQ(meshes[0].vertices[c], (Vec3{0, 0, 2}));
  // (x, y, z) → (x, −z, y): a rotation, so the normal +z of glTF becomes −y.
  const Vec3 normal =
      cross(meshes[0].vertices[b] - meshes[0].vertices[a], meshes[0].vertices[c] - meshes[0].vertices[a]);
  EXPECT_EQ(normal, (Vec3{0, -2, 0}));
}

TEST_F(MeshFile, GltfNodesMoveMeshes) {
  // The child is moved by (0, 0, 3), then the parent doubles and moves by (10, 0, 0).
  const auto meshes = read("nodes.gltf", gltf(R"({"children": [1], "scale": [2, 2, 2], "translation": [10, 0, 0]},
                                                 {"mesh": 0, "translation": [0, 0, 3]})"));
  ASSERT_EQ(meshes.size(), 1u) << all_messages(diagnostics);
  EXPECT_EQ(meshes[0].vertices[1], (Vec3{12, -6, 0}));
  EXPECT_EQ(meshes[0].vertices[2], (Vec3{10, -6, 4}));
  // A mirror reverses the winding, so that the front stays in front: the normal keeps pointing to −y.
  const auto mirrored = read("mirror.gltf", gltf(R"({"mesh": 0, "scale": [-1, 1, 1]})"));
  ASSERT_EQ(mirrored.size(), 1u);
  const auto& [a, b, c] = mirrored[0].triangles[0];
  const auto& v = mirrored[0].vertices;
  EXPECT_LT(cross(v[b] - v[a], v[c] - v[a]).y, 0);
}

TEST_F(MeshFile, GltfWithoutMaterial) {
  const auto meshes = read("none.gltf", gltf(R"({"mesh": 0})", ""));
  ASSERT_EQ(meshes.size(), 1u) << all_messages(diagnostics);
  EXPECT_EQ(meshes[0].material, "");
}

TEST_F(MeshFile, BinaryGltfAndBufferBesideIt) {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f}) bytes += bytes_of(value);
  for (const std::uint16_t index : {0, 1, 2, 0}) bytes += bytes_of(index);
  std::string text = gltf(R"({"mesh": 0})");
  const std::size_t uri = text.find(", \"uri\"");
  const std::string no_uri = text.substr(0, uri) + "}]}";
  std::string json = no_uri;
  while (json.size() % 4 != 0) json += ' ';
  const auto glb = [&](std::uint32_t promised) {
    return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(std::uint32_t(28 + json.size() + bytes.size())) +
           bytes_of(std::uint32_t(json.size())) + "JSON" + json + bytes_of(promised) + std::string("BIN\0", 4) + bytes;
  };
  EXPECT_EQ(read("wall.glb", glb(44)).size(), 1u) << all_messages(diagnostics);
  refused("long.glb", glb(4000000000u), "shorter than it says");
  refused("cut.glb", glb(44).substr(0, 200), "shorter than its header says");

  folder.write("wall data.bin", bytes);
  const std::string outside = no_uri.substr(0, no_uri.size() - 3) + R"(, "uri": "wall%20data.bin"}]})";
  EXPECT_EQ(read("outside.gltf", outside).size(), 1u) << all_messages(diagnostics);
  refused("missing.gltf", replaced(outside, "wall%20data", "wal%20data"), "did you mean wall data.bin");
}

TEST_F(MeshFile, HostileGltf) {
  const std::string good = gltf(R"({"mesh": 0})");
  refused("a.gltf", "{", "JSON");
  refused("b.gltf", std::string(100000, '['), "nested too deeply");
  refused("c.gltf", replaced(good, R"("count": 3, "type": "VEC3")", R"("count": 4000000000, "type": "VEC3")"),
          "beyond the end");
  refused("d.gltf", replaced(good, R"("byteLength": 44)", R"("byteLength": 4400000000)"), "shorter than it says");
  refused("e.gltf",
          replaced(good, R"("byteOffset": 36, "byteLength": 8)", R"("byteOffset": 9007199254740000, "byteLength": 8)"),
          "beyond the end of its buffer");
  refused("f.gltf", replaced(good, R"("bufferView": 1)", R"("bufferView": 7)"), "buffer view 7");
  refused("g.gltf", replaced(good, R"("version": "2.0")", R"("version": "1.0")"), "version 1.0");
  refused("h.gltf", replaced(good, R"("count": 3, "type": "VEC3")", R"("count": -3, "type": "VEC3")"), "whole number");
  refused("i.gltf", gltf(R"({"children": [0]})"), "contain themselves");
  refused("j.gltf", gltf(R"({"children": [1, 1]}, {"mesh": 0})"), "two parents");
  std::string uneven = replaced(good, R"(5123, "count": 3, "type": "SCALAR")", R"(5121, "count": 4, "type": "SCALAR")");
  refused("r.gltf", uneven, "no whole shapes");
  for (int mode = 4; mode <= 7; ++mode) {  // two corners make no triangle
    std::string two = replaced(good, R"(5123, "count": 3)", R"(5123, "count": 2)");
    refused("s.gltf", replaced(two, R"("indices": 1)", R"("indices": 1, "mode": )" + std::to_string(mode)),
            "primitive");
  }
  refused("o.gltf", replaced(good, R"("POSITION": 0}, "indices": 1)", R"("POSITION": 0}, "indices": 0)"), "indices");
  refused("p.gltf", replaced(good, R"(5126, "count": 3, "type": "VEC3")", R"(5123, "count": 3, "type": "VEC3")"),
          "three floats");
  refused("q.gltf", gltf(R"({"mesh": 0, "skin": 0})"), "skinned");
  refused("k.gltf", replaced(good, R"("POSITION": 0)", R"("POSITION": 9)"), "accessor 9");
  std::string chain = R"({"children": [1]})";
  for (int i = 2; i < 100000; ++i) chain += R"(, {"children": [)" + std::to_string(i) + "]}";
  refused("l.gltf", gltf(chain + R"(, {"mesh": 0})"), "nodes nested too deeply");
  refused("m.gltf", replaced(good, R"("asset")", R"("extensionsRequired": ["KHR_draco_mesh_compression"], "asset")"),
          "KHR_draco_mesh_compression");
}

TEST_F(MeshFile, GltfIndexOutOfRange) {
  std::string bytes;
  for (int i = 0; i < 9; ++i) bytes += bytes_of(float(i));
  for (const std::uint16_t index : {0, 1, 2, 0}) bytes += bytes_of(index);
  std::string wrong = bytes;
  wrong[40] = 77;  // the third index, low byte
  std::string text = gltf(R"({"mesh": 0})");
  const std::size_t at = text.find("base64,") + 7;
  text.replace(at, base64(bytes).size(), base64(wrong));
  refused("index.gltf", text, "index 2 is 77, the primitive has 3 vertices");
}

// Comments behind a face, indented and joined lines, an mtllib that is no material library.
TEST_F(MeshFile, ObjWrittenByHand) {
  const auto meshes = read("hand.obj",
                           "mtllib hand.obj\nv 0 0 \\\n0\nv 1 0 0\r\n\tv +0 1 0 # tip\n"
                           "  usemtl  light   wood\n f 1// 2// \\\r\n 3// # face\nf 3 2 1#back");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].triangles.size(), 2u);
  EXPECT_EQ(meshes[0].material, "light_wood");
}

TEST_F(MeshFile, BadObj) {
  refused("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
          "range.obj:4: a face names a vertex that is not there (v 9; the file has 3)");
  refused("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\nv 1 1 1\n", "3 of them so far");
  refused("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 0 1 2\n", "zero.obj:5:");
  refused("uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/2\n", "vt 2; the file has 1");
  refused("short.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "short.obj:1: vertex 1 has fewer than three numbers");
  refused("comma.obj", "v 0,5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\"0,5\" is not a number");
  refused("huge.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "huge.obj:2: vertex 2 is NaN or infinite");
  refused("float.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n", "NaN or infinite");  // beyond a float
  refused("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "NaN or infinite");
  EXPECT_TRUE(read("words.obj", "this is not a mesh at all\n").empty());
  EXPECT_NE(all_messages(diagnostics).find("no faces"), std::string::npos);
  refused("empty.obj", "", "empty");
  EXPECT_TRUE(read_with_assimp(folder.path() / "rang.obj", diagnostics).empty());
  EXPECT_NE(all_messages(diagnostics).find("did you mean range.obj"), std::string::npos);
}

// Whatever bytes are changed: meshes with indices in range, or an error; never a crash.
TEST_F(MeshFile, SurvivesAnyBytes) {
  std::mt19937 random(20240802);
  const std::pair<std::string, std::string> good[] = {{"a.obj", box_obj}, {"a.gltf", gltf(R"({"mesh": 0})")}};
  for (int round = 0; round < 600; ++round) {
    auto [name, text] = good[round % 2];
    for (int change = 0; change < 1 + round % 4; ++change) {
      text[random() % text.size()] = round % 3 ? static_cast<char>(random()) : static_cast<char>('0' + random() % 10);
    }
    for (const MeshDescription& mesh : read(name, text)) {
      for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t index : triangle) ASSERT_LT(index, mesh.vertices.size());
      }
      for (const Vec3& vertex : mesh.vertices) ASSERT_TRUE(is_finite(vertex));
    }
  }
}

}  // namespace
}  // namespace grimaldi
