#include "scenes/mitsuba_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <set>

#include "scenes/scene_file.h"
#include "tests/scenes/temporary_folder.h"

namespace grimaldi {
namespace {

std::string all_messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& one : diagnostics.all()) text += to_string(one) + "\n";
  return text;
}

struct MitsubaFile : testing::Test {
  MitsubaFile() {
    folder.write("meshes/roof.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  }
  SceneDescription read(const std::string& contents) {
    diagnostics = {};
    return read_mitsuba(folder.write("scene.xml", contents), diagnostics);
  }
  SceneDescription read_shape(const std::string& inside, const std::string& before = "") {
    return read("<scene version=\"2.1.0\">\n" + before +
                "<shape type=\"ply\" id=\"mesh-roof\"><string name=\"filename\" value=\"meshes/roof.ply\"/>" + inside +
                "</shape></scene>");
  }
  bool says(std::string_view words) const { return all_messages(diagnostics).find(words) != std::string::npos; }
  TemporaryFolder folder;
  Diagnostics diagnostics;
};

TEST_F(MitsubaFile, SionnaMaterials) {
  const SceneDescription scene =
      read_shape("<ref id=\"box-mat\" name=\"bsdf\"/>",
                 "<bsdf type=\"itu-radio-material\" id=\"box-mat\">"
                 "<string name=\"type\" value=\"Metal\"/><float name=\"thickness\" value=\"1.\"/></bsdf>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "mesh-roof");
  EXPECT_EQ(scene.meshes[0].material, "metal");
  ASSERT_TRUE(scene.materials.contains("metal"));
  EXPECT_EQ(scene.materials.at("metal").thickness, 1.0);
  EXPECT_FALSE(scene.materials.at("metal").relative_permittivity.has_value());
}

TEST_F(MitsubaFile, MaterialByNumbersByNameAndInPlace) {
  const SceneDescription numbers =
      read_shape("<ref id=\"m\"/>",
                 "<bsdf type=\"radio-material\" id=\"m\"><float name=\"relative_permittivity\" value=\"6.25\"/>"
                 "<float name=\"conductivity\" value=\"0.5\"/><float name=\"thickness\" value=\"0.2\"/></bsdf>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(numbers.meshes.at(0).material, "m");
  EXPECT_EQ(numbers.materials.at("m").relative_permittivity, 6.25);
  EXPECT_EQ(numbers.materials.at("m").conductivity, 0.5);
  EXPECT_EQ(numbers.materials.at("m").thickness, 0.2);

  const SceneDescription named = read_shape("<ref id=\"mat-itu_concrete\" name=\"bsdf\"/>",
                                            "<bsdf type=\"twosided\" id=\"mat-itu_concrete\"><bsdf type=\"diffuse\">"
                                            "<rgb value=\"0.5 0.5 0.5\" name=\"reflectance\"/></bsdf></bsdf>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(named.meshes.at(0).material, "concrete");
  EXPECT_TRUE(named.materials.empty());

  const SceneDescription in_place = read_shape(
      "<bsdf type=\"twosided\"><bsdf type=\"itu-radio-material\"><string name=\"type\" value=\"wood\"/></bsdf></bsdf>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(in_place.meshes.at(0).material, "wood");
  EXPECT_EQ(read_shape("").meshes.at(0).material, "");
}

TEST_F(MitsubaFile, TwoGlassesOfDifferentThickness) {
  const std::string glass =
      "<bsdf type=\"itu-radio-material\" id=\"NAME\"><string name=\"type\" value=\"glass\"/>"
      "<float name=\"thickness\" value=\"T\"/></bsdf>\n";
  const auto made = [&](const std::string& name, const std::string& thickness) {
    std::string text = glass;
    text.replace(text.find("NAME"), 4, name);
    return text.replace(text.find("\"T\""), 3, "\"" + thickness + "\"");
  };
  const SceneDescription scene =
      read_shape("<ref id=\"window\"/>", made("pane", "0.004") + made("window", "0.01") + made("third", "0.004"));
  EXPECT_TRUE(says("a second material \"glass\"")) << all_messages(diagnostics);
  EXPECT_EQ(scene.meshes.at(0).material, "window");
  EXPECT_EQ(scene.materials.at("window").based_on, "glass");
  EXPECT_EQ(scene.materials.at("window").thickness, 0.01);
  EXPECT_EQ(scene.materials.at("glass").thickness, 0.004);
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST_F(MitsubaFile, TransformsInOrder) {
  // Turn x to y, double, then move: (1, 0, 0) → (0, 1, 0) → (0, 2, 0) → (10, 2, 5).
  const SceneDescription scene = read_shape(
      "<transform name=\"to_world\"><rotate z=\"1\" angle=\"90\"/><scale value=\"2\"/>"
      "<translate x=\"10\" z=\"5\"/></transform>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  const Vec3 moved = scene.meshes.at(0).vertices.at(1);
  EXPECT_NEAR(moved.x, 10, 1e-14);  // cos 90° as doubles have it is 6e-17
  EXPECT_NEAR(moved.y, 2, 1e-14);
  EXPECT_NEAR(moved.z, 5, 1e-14);
  EXPECT_EQ(scene.meshes[0].triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));

  const SceneDescription matrix =
      read_shape("<transform name=\"to_world\"><matrix value=\"-1 0 0 7  0 1 0 8  0 0 1 9  0 0 0 1\"/></transform>");
  EXPECT_EQ(matrix.meshes.at(0).vertices.at(1), (Vec3{6, 8, 9}));
  EXPECT_EQ(matrix.meshes[0].triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));  // mirrored

  const SceneDescription scaled =
      read_shape("<transform name=\"to_world\"><scale x=\"3\"/><translate value=\"1, 2, 3\"/></transform>");
  EXPECT_EQ(scaled.meshes.at(0).vertices.at(1), (Vec3{4, 2, 3}));

  // A third of a turn about (1, 1, 1) takes x to y and y to z.
  const SceneDescription turned =
      read_shape("<transform name=\"to_world\"><rotate value=\"1 1 1\" angle=\"120\"/></transform>");
  EXPECT_NEAR(distance(turned.meshes.at(0).vertices.at(1), Vec3{0, 1, 0}), 0,
              1e-15 * 10);  // a dozen roundings of 1e-16
  EXPECT_NEAR(distance(turned.meshes.at(0).vertices.at(2), Vec3{0, 0, 1}), 0, 1e-15 * 10);
}

TEST_F(MitsubaFile, BadTransforms) {
  const auto bad = [&](const std::string& step, std::string_view words) {
    read_shape("\n<transform name=\"to_world\">\n" + step + "</transform>");
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_TRUE(says(words)) << all_messages(diagnostics);
    EXPECT_TRUE(says("scene.xml:4:")) << all_messages(diagnostics);
  };
  bad("<matrix value=\"1 2 3\"/>", "it has 3");
  bad("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 nan\"/>", "no finite number");
  bad("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1\"/>", "last row");
  bad("<rotate angle=\"90\"/>", "axis");
  bad("<rotate z=\"1\"/>", "angle");
  bad("<translate x=\"five\"/>", "five");
  bad("<scale value=\"1 2\"/>", "one or three");
  bad("<trnslate x=\"5\"/>", "did you mean translate");
}

TEST_F(MitsubaFile, Defaults) {
  const SceneDescription scene = read(
      "<scene><default name=\"mesh\" value=\"roof\"/><default name=\"mesh_folder\" value=\"meshes\"/>"
      "<shape type=\"ply\"><string name=\"filename\" value=\"$mesh_folder/$mesh.ply\"/></shape></scene>");
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes.at(0).name, "roof");
  read(
      "<scene><default name=\"mesh\" value=\"roof\"/>\n<shape type=\"ply\"><string name=\"filename\" "
      "value=\"$mush\"/></shape></scene>");
  EXPECT_TRUE(says("$mush has no value")) << all_messages(diagnostics);
  EXPECT_TRUE(says("did you mean mesh?")) << all_messages(diagnostics);
}

TEST_F(MitsubaFile, WhatIsPassedOverIsSaidOnce) {
  const SceneDescription scene =
      read_shape("<boolean name=\"face_normals\" value=\"true\"/>",
                 "<integrator type=\"path\"/><sensor type=\"perspective\"/><emitter type=\"constant\"/>\n"
                 "<shape type=\"sphere\"/>\n<shape type=\"sphere\"/>\n<shape type=\"cube\"/><gizmo/>\n");
  EXPECT_FALSE(diagnostics.has_errors()) << all_messages(diagnostics);
  EXPECT_EQ(diagnostics.all().size(), 3u) << all_messages(diagnostics);
  EXPECT_TRUE(says("scene.xml:3: shape of type \"sphere\"")) << all_messages(diagnostics);
  EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST_F(MitsubaFile, BadReferences) {
  read_shape("\n<ref id=\"concret\" name=\"bsdf\"/>", "<bsdf type=\"diffuse\" id=\"concrete\"/>\n");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_TRUE(says("scene.xml:4:") && says("did you mean concrete?")) << all_messages(diagnostics);

  read("<scene>\n<shape type=\"ply\" id=\"a\">\n<string name=\"filename\" value=\"meshes/rof.ply\"/></shape></scene>");
  EXPECT_TRUE(says("scene.xml:3:") && says("meshes/rof.ply") && says("did you mean roof.ply?"))
      << all_messages(diagnostics);

  read("<scene>\n<shape type=\"ply\" id=\"a\"/></scene>");
  EXPECT_TRUE(says("names no file")) << all_messages(diagnostics);

  read_shape("<ref id=\"a\"/>", "<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"a\"/>");
  EXPECT_TRUE(says("a second element with the id \"a\"")) << all_messages(diagnostics);

  read_shape("<ref id=\"a\"/>", "<bsdf type=\"itu-radio-material\" id=\"a\"/>");
  EXPECT_TRUE(says("without type")) << all_messages(diagnostics);
  read_shape("",
             "<bsdf type=\"itu-radio-material\" id=\"a\"><string name=\"type\" value=\"glass\"/>"
             "<float name=\"thickness\" value=\"-1\"/></bsdf>");
  EXPECT_TRUE(diagnostics.has_errors() && says("thickness")) << all_messages(diagnostics);
}

TEST_F(MitsubaFile, ManyMissingMeshesFewMessages) {
  std::string text = "<scene>\n";
  for (int i = 0; i < 5000; ++i) {
    text += "<shape type=\"ply\"><string name=\"filename\" value=\"meshes/r" + std::to_string(i) + ".ply\"/></shape>\n";
  }
  read(text + "</scene>");
  EXPECT_LT(diagnostics.all().size(), 20u);
  EXPECT_TRUE(says("4990 more meshes")) << all_messages(diagnostics);
}

TEST_F(MitsubaFile, FaultsOfAMeshNameTheMesh) {
  folder.write("meshes/bad.ply",
               "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
               "property float z\nend_header\n");
  read("<scene><shape type=\"ply\"><string name=\"filename\" value=\"meshes/bad.ply\"/></shape></scene>");
  EXPECT_TRUE(diagnostics.has_errors() && says("meshes/bad.ply")) << all_messages(diagnostics);
}

TEST_F(MitsubaFile, BadXml) {
  read("<scene>\n\n<shape></scene>");
  EXPECT_TRUE(says("scene.xml:3:") && says("XML")) << all_messages(diagnostics);
  read("no xml at all");
  EXPECT_TRUE(diagnostics.has_errors());
  read("<city/>");
  EXPECT_TRUE(says("not a Mitsuba scene")) << all_messages(diagnostics);
  read(std::string("<\0s\0c\0", 6));
  EXPECT_TRUE(says("UTF-8")) << all_messages(diagnostics);
}

TEST_F(MitsubaFile, DeepNestingIsAnErrorNotACrash) {
  for (const int levels : {65, 100000, 2000000}) {
    std::string text = "<scene>";
    for (int i = 0; i < levels; ++i) text += "<a>";
    read(text);  // never closed
    EXPECT_TRUE(diagnostics.has_errors());
    for (int i = 0; i < levels; ++i) text += "</a>";
    read(text + "</scene>");
    EXPECT_TRUE(diagnostics.has_errors() && says("nested too deeply")) << levels;
  }
}

TEST_F(MitsubaFile, EntitiesAreNotExpanded) {
  // Ten levels of ten: 10¹⁰ letters if they were expanded.
  std::string text = "<?xml version=\"1.0\"?>\n<!DOCTYPE scene [<!ENTITY e0 \"roof\">";
  for (int i = 1; i <= 10; ++i) {
    text += "<!ENTITY e" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) text += "&e" + std::to_string(i - 1) + ";";
    text += "\">";
  }
  text +=
      "<!ENTITY file SYSTEM \"file:///etc/passwd\">]>\n<scene><shape type=\"ply\" id=\"&file;\">"
      "<string name=\"filename\" value=\"meshes/&e10;.ply\"/></shape></scene>";
  const SceneDescription scene = read(text);
  EXPECT_TRUE(scene.meshes.empty());
  EXPECT_TRUE(says("&e10;.ply")) << all_messages(diagnostics);
  std::string groups = "<!DOCTYPE scene [";
  for (int i = 0; i < 100000; ++i) groups += "<![INCLUDE[";
  read(groups);
  EXPECT_TRUE(diagnostics.has_errors());
}

struct SionnaScene {
  const char* name;
  std::size_t meshes, triangles;
  std::set<std::string> materials;
};

class SionnaScenes : public testing::TestWithParam<SionnaScene> {};

// Counts: the PLY headers of the folders added up (element face), all faces of which are triangles.
TEST_P(SionnaScenes, AreReadWhole) {
  const SionnaScene& known = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(GRIMALDI_SHARED) / "data/sionna" / known.name / (std::string(known.name) + ".xml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs ../shared/data/sionna";
  Diagnostics diagnostics;
  const auto start = std::chrono::steady_clock::now();
  const SceneDescription scene = read_scene_file(file, diagnostics);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(diagnostics.all().empty()) << all_messages(diagnostics);
  std::size_t vertices = 0, triangles = 0;
  std::set<std::string> materials;
  for (const MeshDescription& mesh : scene.meshes) {
    vertices += mesh.vertices.size();
    triangles += mesh.triangles.size();
    materials.insert(mesh.material);
  }
  std::cout << known.name << ": " << scene.meshes.size() << " meshes, " << vertices << " vertices, " << triangles
            << " triangles, " << seconds << " s\n";
  EXPECT_EQ(scene.meshes.size(), known.meshes);
  EXPECT_EQ(triangles, known.triangles);
  EXPECT_EQ(materials, known.materials);
}

INSTANTIATE_TEST_SUITE_P(
    , SionnaScenes,
    testing::Values(SionnaScene{"munich", 2367, 38938, {"brick", "concrete", "wood", "metal", "marble"}},
                    SionnaScene{"etoile", 563, 13058, {"wood", "metal", "marble", "concrete"}},
                    SionnaScene{"simple_street_canyon", 7, 74, {"glass", "wood", "concrete", "brick", "marble"}},
                    SionnaScene{"simple_wedge", 1, 4, {"concrete"}},
                    SionnaScene{"box_one_screen", 2, 14, {"glass", "metal"}}),
    [](const testing::TestParamInfo<SionnaScene>& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace grimaldi
