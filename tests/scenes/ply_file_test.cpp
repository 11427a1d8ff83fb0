#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <random>

#include "scenes/mesh_file.h"
#include "scenes/scene_file.h"
#include "tests/scenes/temporary_folder.h"

namespace grimaldi {
namespace {

std::string all_messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& one : diagnostics.all()) text += to_string(one) + "\n";
  return text;
}

// Values to bytes in either order; the machine is little-endian.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <typename T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian_) std::reverse(raw, raw + sizeof(T));
    text_.append(raw, sizeof(T));
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

const std::string ascii_triangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

struct PlyFile : testing::Test {
  MeshDescription read(std::string_view contents) { return read_ply(folder.write("mesh.ply", contents), diagnostics); }
  // Reads what must be refused, and holds the message against the words it must have.
  void refused(std::string_view contents, std::string_view words, int line = -1) {
    diagnostics = {};
    const MeshDescription mesh = read(contents);
    ASSERT_TRUE(diagnostics.has_errors()) << "wanted: " << words;
    EXPECT_NE(all_messages(diagnostics).find(words), std::string::npos) << all_messages(diagnostics);
    EXPECT_TRUE(mesh.triangles.empty());
    if (line >= 0) {
      EXPECT_EQ(diagnostics.all().back().line, line) << all_messages(diagnostics);
    }
  }
  static std::string with(std::string text, std::string_view old, std::string_view now) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, old.size(), now);
  }
  TemporaryFolder folder;
  Diagnostics diagnostics;
};

TEST_F(PlyFile, AsciiTriangle) {
  const MeshDescription mesh = read(ascii_triangle);
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(mesh.vertices.size(), 3u);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.name, "mesh");
  EXPECT_EQ(mesh.material, "");
}

TEST_F(PlyFile, LineEndsAndCommentsDoNotMatter) {
  std::string text = with(ascii_triangle, "element face", "comment made by hand\nobj_info num_cols 5\n\nelement face");
  for (const std::string end : {"\r\n", "\r", "\n"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    const MeshDescription mesh = read(other);
    EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
    EXPECT_EQ(mesh.triangles.size(), 1u);
  }
}

// Every scalar type, both byte orders, lists and other elements before and after what is wanted.
TEST_F(PlyFile, EveryTypeInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string order = big ? "big" : "little";
    Bytes body(big);
    // other: an element before the vertices, with a list
    body.add(std::int8_t{-1}).add(std::uint16_t{2}).add(1.5).add(2.5);
    const double x[] = {0.1, 1e7 + 0.1, -3e-9};
    for (int i = 0; i < 3; ++i) {
      body.add(std::uint8_t{3}).add(std::int16_t{7}).add(std::int16_t{8}).add(std::int16_t{9});  // list before
      body.add(std::uint32_t{4000000000u}).add(x[i]).add(float(i)).add(std::int16_t(-i)).add(std::int32_t{-5});
    }
    for (const std::uint32_t third : {2u, 1u}) {
      body.add(std::int8_t{5}).add(std::int32_t{3}).add(std::uint32_t{0}).add(std::uint32_t{1}).add(third);
      body.add(std::uint8_t{1}).add(3.5f);
    }
    body.add(std::uint8_t{42});
    const std::string header = "ply\nformat binary_" + order +
                               "_endian 1.0\n"
                               "element other 1\nproperty char a\nproperty list ushort double b\n"
                               "element vertex 3\nproperty list uint8 int16 l\nproperty uint c\nproperty double x\n"
                               "property float32 y\nproperty short z\nproperty int32 d\n"
                               "element face 2\nproperty int8 flags\nproperty list int uint vertex_index\n"
                               "property list uchar float texcoord\n"
                               "element last 1\nproperty uchar e\nend_header\n";
    diagnostics = {};
    const MeshDescription mesh = read(header + body.text());
    EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
    ASSERT_EQ(mesh.vertices.size(), 3u);
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(mesh.vertices[i], (Vec3{x[i], double(i), double(-i)}));  // doubles, bit for bit
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 1, 1}));

    // Cut off after any byte it is an error, never a mesh.
    for (std::size_t length = 0; length < body.text().size(); ++length) {
      diagnostics = {};
      EXPECT_TRUE(read(header + body.text().substr(0, length)).triangles.empty());
      EXPECT_TRUE(diagnostics.has_errors()) << length;
    }
  }
}

TEST_F(PlyFile, AsciiDoublesAreExact) {
  // 17 digits tell every double apart; a detour over float would leave 7.
  const MeshDescription mesh =
      read(with(with(ascii_triangle, "float x", "double x"), "1 0 0", "4463781.2345678901 0 0"));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[1].x, 4463781.2345678901);
}

TEST_F(PlyFile, FacesMayComeBeforeVertices) {
  const MeshDescription mesh = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST_F(PlyFile, PolygonsBecomeFans) {
  // A regular octagon of radius 1 has the area 2√2; its fan of six triangles must have the same.
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 3.141592653589793 / 4;
    text += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
  }
  const MeshDescription mesh = read(text + "8 0 1 2 3 4 5 6 7\n");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(mesh.triangles.size(), 6u);
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z / 2;
  }
  // to_string rounds coordinates to 5e-7; the area moves by at most half the perimeter (3.1) times that, times √2.
  EXPECT_NEAR(area, 2 * std::sqrt(2.0), 3e-6);
}

TEST_F(PlyFile, SaysWhichPolygonsAFanCutsBadly) {
  // A dart: tip, left, notch, right. The tip sees all of it, the left corner does not see the right one past the notch.
  const std::string dart =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 3 0\n-2 -1 0\n0 0 0\n2 -1 0\n";
  read(dart + "4 0 1 2 3\n");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(read(dart + "4 1 2 3 0\n").triangles.size(), 2u);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_NE(all_messages(diagnostics).find("1 polygons are not convex"), std::string::npos)
      << all_messages(diagnostics);
}

TEST_F(PlyFile, FewerThanThreeCornersAreAWarning) {
  const MeshDescription mesh = read(with(with(ascii_triangle, "face 1", "face 3"), "3 0 1 2\n", "2 0 1\n3 0 1 2\n0\n"));
  EXPECT_FALSE(diagnostics.has_errors()) << all_messages(diagnostics);
  EXPECT_NE(all_messages(diagnostics).find("2 faces have fewer than three corners"), std::string::npos);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST_F(PlyFile, HostileHeaders) {
  refused("plx\n", "not a PLY file");
  refused("ply", "not a PLY file");
  refused("ply\nformat ascii 1.0\nelement vertex 3\n", "no end_header");
  refused("ply\n" + std::string(3 << 20, 'c'), "no end_header", 2);
  refused("ply\nend_header\n", "no format", 2);
  refused(with(ascii_triangle, "ascii", "binary_middle_endian"), "did you mean", 2);
  refused(with(ascii_triangle, "1.0", "2.0"), "version", 2);
  refused(with(ascii_triangle, "property float x", "property flaot x"), "did you mean float", 4);
  refused(with(ascii_triangle, "property float x", "propery float x"), "did you mean property", 4);
  refused(with(ascii_triangle, "vertex 3", "vertex -3"), "bad count", 3);
  refused(with(ascii_triangle, "vertex 3", "vertex 99999999999999999999999"), "bad count", 3);
  refused(with(ascii_triangle, "vertex 3", "vertex 3x"), "bad count", 3);
  refused(with(ascii_triangle, "list uchar", "list float"), "counted by a float");
  refused(with(ascii_triangle, "uchar int", "uchar float"), "vertex_indices");
  refused(with(ascii_triangle, "property float y", "property float x"), "a second property");
  refused(with(ascii_triangle, "element face", "element vertex"), "a second element");
  refused(with(ascii_triangle, "property float z\n", ""), "no property z");
  refused(with(ascii_triangle, "element vertex", "element point"), "no vertices");
  refused(with(ascii_triangle, "vertex_indices", "corners"), "vertex_indices");
  refused(with(ascii_triangle, "format", "property int a\nformat"), "before the first element");
}

// Each would ask for gigabytes if it were believed: refused from the header alone.
TEST_F(PlyFile, CountsAreHeldAgainstTheFile) {
  refused(with(ascii_triangle, "vertex 3", "vertex 4294967295"), "shorter than its header says");
  refused(with(ascii_triangle, "vertex 3", "vertex 18446744073709551615"), "shorter than its header says");
  refused(with(ascii_triangle, "face 1", "face 4000000000"), "shorter than its header says");
  const std::string binary = with(ascii_triangle, "ascii", "binary_little_endian");
  refused(with(binary, "vertex 3", "vertex 4000000000"), "shorter than its header says");
  refused(with(binary, "face 1", "face 6148914691236517206"), "shorter than its header says");
  // An element without properties takes no bytes, so any count of it is true and costs nothing.
  diagnostics = {};
  read(with(ascii_triangle, "element face", "element nothing 18446744073709551615\nelement face"));
  EXPECT_FALSE(diagnostics.has_errors()) << all_messages(diagnostics);
  // Vertices that fit but a list that promises four billion indices.
  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
  refused(list + "\xff\xff\xff\xff", "longer than the rest of the file");
  refused(with(list, "uint", "int") + "\xff\xff\xff\xff", "negative count");
}

TEST_F(PlyFile, BadBodies) {
  refused(with(ascii_triangle, "3 0 1 2", "3 0 1 3"), "vertex 3, the file has 3", 13);
  refused(with(ascii_triangle, "3 0 1 2", "3 0 -1 2"), "vertex -1", 13);
  refused(with(ascii_triangle, "3 0 1 2", "-3 0 1 2"), "\"-3\"", 13);  // a uchar cannot be negative
  refused(with(with(ascii_triangle, "uchar", "char"), "3 0 1 2", "-3 0 1 2"), "negative count", 13);
  refused(with(ascii_triangle, "3 0 1 2", "3 0 1 1.5"), "not a number", 13);
  refused(with(ascii_triangle, "3 0 1 2", "3 0 1"), "ends in the middle");
  refused(with(ascii_triangle, "3 0 1 2", "4 0 1 2"), "ends in the middle");
  refused(with(ascii_triangle, "3 0 1 2", "250 0 1 2"), "longer than the rest");
  refused(with(ascii_triangle, "1 0 0", "1 zero 0"), "not a number", 11);
  refused(with(ascii_triangle, "1 0 0", "1 0x1 0"), "not a number", 11);
  refused(with(ascii_triangle, "1 0 0", "1 0 0 0"), "");  // one number too many shifts all that follow
  refused(ascii_triangle + "3 0 1 2\n", "goes on after its last element");
}

TEST_F(PlyFile, NotFiniteVertexIsNamed) {
  for (const std::string bad : {"nan", "inf", "-inf", "-nan", "1e39999"}) {
    refused(with(ascii_triangle, "1 0 0", "1 " + bad + " 0"),
            bad == "1e39999" ? "" : "vertex 1 of mesh \"mesh\" is NaN or infinite");
  }
  Bytes body(false);
  for (int i = 0; i < 9; ++i) body.add(i == 8 ? std::numeric_limits<float>::quiet_NaN() : 0.0f);
  body.add(std::uint8_t{3}).add(0).add(1).add(2);
  const std::string header = ascii_triangle.substr(0, ascii_triangle.find("0 0 0\n"));
  refused(with(header, "ascii", "binary_little_endian") + body.text(), "vertex 2 of mesh");
}

// Whatever bytes are changed: a mesh whose indices are in range, or an error; never a crash.
TEST_F(PlyFile, SurvivesAnyBytes) {
  std::mt19937 random(20240801);
  const std::string header = ascii_triangle.substr(0, ascii_triangle.find("0 0 0\n"));
  Bytes body(false);
  for (int i = 0; i < 9; ++i) body.add(float(i));
  body.add(std::uint8_t{3}).add(0).add(1).add(2);
  const std::string binary = with(header, "ascii", "binary_little_endian") + body.text();
  for (int round = 0; round < 1000; ++round) {
    std::string text = round % 2 ? ascii_triangle : binary;
    for (int change = 0; change < 1 + round % 5; ++change) {
      text[random() % text.size()] = round % 3 ? static_cast<char>(random()) : static_cast<char>('0' + random() % 10);
    }
    diagnostics = {};
    const MeshDescription mesh = read(text);
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t index : triangle) ASSERT_LT(index, mesh.vertices.size());
    }
    for (const Vec3& vertex : mesh.vertices) ASSERT_TRUE(is_finite(vertex));
  }
}

TEST_F(PlyFile, SceneFileSaysWhatIsWrong) {
  folder.write("munich.ply", ascii_triangle);
  folder.write("empty.ply", "");
  folder.write("house.dwg", "x");
  folder.write("points.ply", with(with(ascii_triangle, "face 1", "face 0"), "3 0 1 2\n", ""));
  const auto message = [&](const std::filesystem::path& name) {
    Diagnostics found;
    read_scene_file(folder.path() / name, found);
    EXPECT_EQ(std::count_if(found.all().begin(), found.all().end(),
                            [](const Diagnostic& one) { return one.severity == Severity::error; }),
              1)
        << name;
    return all_messages(found);
  };
  EXPECT_NE(message("munch.ply").find("did you mean munich.ply?"), std::string::npos) << message("munch.ply");
  EXPECT_NE(message("nowhere/a.ply").find("is not there"), std::string::npos);
  EXPECT_NE(message("").find("is a folder"), std::string::npos);
  EXPECT_NE(message("empty.ply").find("empty"), std::string::npos);
  EXPECT_NE(message("house.dwg").find(".glb"), std::string::npos);
  EXPECT_NE(message("points.ply").find("no triangles"), std::string::npos);
  Diagnostics fine;
  std::filesystem::rename(folder.path() / "munich.ply", folder.path() / "MUNICH.PLY");
  EXPECT_EQ(read_scene_file(folder.path() / "MUNICH.PLY", fine).meshes.size(), 1u);
  EXPECT_TRUE(fine.all().empty()) << all_messages(fine);
}

TEST(PlyFiles, TwoThousandSmallFilesInUnderASecond) {
  const std::filesystem::path meshes = std::filesystem::path(GRIMALDI_SHARED) / "data/sionna/munich/meshes";
  if (!std::filesystem::exists(meshes)) GTEST_SKIP() << "needs ../shared/data/sionna";
  Diagnostics diagnostics;
  std::size_t files = 0, triangles = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const auto& entry : std::filesystem::directory_iterator(meshes)) {
    triangles += read_ply(entry.path(), diagnostics).triangles.size();
    ++files;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("seconds", std::to_string(seconds));
  std::cout << files << " files, " << triangles << " triangles, " << seconds << " s\n";
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  // 23 µs a file were measured; a second leaves room for a slow disk and sanitizers, not for a quadratic reader.
  EXPECT_LT(seconds, 1.0);
}

}  // namespace
}  // namespace grimaldi
