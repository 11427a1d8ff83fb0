#include "scenes/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

using solids::box;
using solids::scene;

const Material& material_of(const Scene& s, const std::string& name) {
  const auto found =
      std::find_if(s.materials.begin(), s.materials.end(), [&](const Material& m) { return m.name == name; });
  EXPECT_NE(found, s.materials.end()) << name;
  return found == s.materials.end() ? s.materials.front() : *found;
}

std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += to_string(d) + "\n";
  return text;
}

SceneDescription street() {
  return scene({solids::ground(50, -2), box({0, 0, -2}, {10, 10, 10}, true, "glass"),
                box({20, 0, -2}, {30, 10, 7}, false, "brick"), box({0, 20, -2}, {10, 30, 7}, false, "glass")});
}

TEST(Scene, IsCompleteAndConsistent) {
  Diagnostics diagnostics;
  const Scene s = build_scene(street(), {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(s.name, "test");
  EXPECT_EQ(s.ground, -2);
  EXPECT_EQ(s.low, (Vec3{-50, -50, -2}));
  EXPECT_EQ(s.high, (Vec3{50, 50, 10}));
  ASSERT_EQ(s.materials.size(), 3u);  // in order of first appearance
  EXPECT_EQ(s.materials[0].name, "wet_ground");
  EXPECT_EQ(s.materials[1].name, "glass");
  EXPECT_EQ(s.materials[2].name, "brick");
  EXPECT_EQ(s.triangles.size(), 2u + 12u + 10u + 10u);
  EXPECT_EQ(s.triangle_material.size(), s.triangles.size());
  EXPECT_EQ(s.patches.triangle_patch.size(), s.triangles.size());
  EXPECT_EQ(s.wedges.wedges.size(), 3u * 8u);
  // The ground, not the floor of the house that has one.
  ASSERT_EQ(s.triangle_is_ground.size(), s.triangles.size());
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    EXPECT_EQ(s.triangle_is_ground[t] != 0, s.triangle_material[t] == 0);
}

TEST(Scene, FingerprintTellsScenesApart) {
  Diagnostics diagnostics;
  const auto print = [&](const SceneDescription& d, const MaterialChoice& choice = {}) {
    return build_scene(d, choice, diagnostics).fingerprint;
  };
  EXPECT_EQ(print(street()), print(street()));
  SceneDescription moved = street();
  moved.meshes[1].vertices[0].x += 0.02;
  EXPECT_NE(print(street()), print(moved));
  MaterialChoice other;
  other.replace["brick"] = "wood";
  EXPECT_NE(print(street()), print(street(), other));
  SceneDescription thicker = street();
  thicker.materials["glass"].thickness = 0.02;
  EXPECT_NE(print(street()), print(thicker));
}

TEST(Scene, ScenarioOverFileOverTable) {
  SceneDescription description = street();
  description.meshes[2].material = "foam";
  description.materials["foam"] = {0.3, 1.1, {}};
  description.materials["glass"] = {0.006, {}, {}};
  description.materials["wet_ground"] = {{}, 20.0, 0.5};
  MaterialChoice choice;
  Diagnostics diagnostics;
  {
    const Scene s = build_scene(description, choice, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << messages(diagnostics);
    EXPECT_EQ(material_of(s, "glass").thickness, 0.006);
    EXPECT_FALSE(material_of(s, "glass").radio.empty());
    EXPECT_EQ(material_of(s, "foam").thickness, 0.3);
    EXPECT_EQ(relative_permittivity(material_of(s, "foam"), 3e9, diagnostics), (std::complex<double>{1.1, 0}));
    // ε' − jσ/(ε0 ω) at 3 GHz
    const auto wet = relative_permittivity(material_of(s, "wet_ground"), 3e9, diagnostics);
    EXPECT_NEAR(wet.real(), 20, 1e-12);
    EXPECT_NEAR(wet.imag(), -0.5 / (8.8541878128e-12 * 2 * 3.14159265358979 * 3e9), 1e-9);
  }
  Material own;
  own.name = "glass";
  own.thickness = 0.5;
  choice.overrides["glass"] = own;
  const Scene s = build_scene(description, choice, diagnostics);
  EXPECT_EQ(material_of(s, "glass").thickness, 0.5);
  EXPECT_TRUE(material_of(s, "glass").radio.empty());
}

TEST(Scene, AMaterialBasedOnAnotherTakesFromItWhatTheFileDoesNotSay) {
  // The file has glass twice: of 6 mm, and of 1 cm by the name of its id; and foam, which only says its own numbers.
  SceneDescription description = street();
  description.meshes[2].material = "window";
  description.materials["glass"] = {0.006, {}, {}, "glass"};
  description.materials["window"] = {0.01, {}, 0.5, "glass"};
  MaterialChoice choice;
  Diagnostics diagnostics;
  {
    const Scene s = build_scene(description, choice, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << messages(diagnostics);
    const Material &glass = material_of(s, "glass"), &window = material_of(s, "window");
    EXPECT_EQ(glass.thickness, 0.006);
    EXPECT_EQ(window.thickness, 0.01);
    // ITU-R P.2040-3, Table 3: glass ε' = 6.31; the conductivity is the file's.
    const auto permittivity = relative_permittivity(window, 3e9, diagnostics);
    EXPECT_EQ(permittivity.real(), 6.31);
    EXPECT_NEAR(permittivity.imag(), -0.5 / (8.8541878128e-12 * 2 * 3.14159265358979 * 3e9), 1e-9);
    EXPECT_NE(relative_permittivity(glass, 3e9, diagnostics).imag(), permittivity.imag());
    EXPECT_EQ(window.absorption->value, built_in_materials().at("glass").absorption->value);
  }
  // The scenario's glass is glass for both; what the file says of the window stays.
  Material own;
  own.permittivity = Spectrum{{1e9}, {7.5}};
  own.conductivity = Spectrum{{1e9}, {0.0}};
  own.thickness = 0.5;
  choice.overrides["glass"] = own;
  {
    const Scene s = build_scene(description, choice, diagnostics);
    EXPECT_EQ(material_of(s, "glass").thickness, 0.5);
    EXPECT_EQ(material_of(s, "window").thickness, 0.01);
    EXPECT_EQ(relative_permittivity(material_of(s, "window"), 3e9, diagnostics).real(), 7.5);
    EXPECT_NE(relative_permittivity(material_of(s, "window"), 3e9, diagnostics).imag(), 0);
  }
  // Its own name in the scenario goes over all.
  choice.overrides["window"] = own;
  EXPECT_EQ(material_of(build_scene(description, choice, diagnostics), "window").thickness, 0.5);
  EXPECT_FALSE(diagnostics.has_errors()) << messages(diagnostics);
  description.materials["window"].based_on = "glas";
  Diagnostics unknown;
  build_scene(description, {}, unknown);
  EXPECT_TRUE(unknown.has_errors());
  EXPECT_NE(messages(unknown).find("unknown material \"glas\" (\"window\" is based on it); did you mean glass?"),
            std::string::npos)
      << messages(unknown);
}

TEST(Scene, OpenRimsAreThoseOfSheetsAndHoles) {
  const auto rims = [](const SceneDescription& description, bool warned) {
    Diagnostics diagnostics;
    const Scene s = build_scene(description, {}, diagnostics);
    EXPECT_EQ(messages(diagnostics).find("open rim") != std::string::npos, warned) << messages(diagnostics);
    return s.open_rims;
  };
  // The end of the ground, the open feet of houses on it; a lone house without floor or ground.
  EXPECT_EQ(rims(street(), false).count, 0u);
  EXPECT_EQ(rims(scene({box({0, 0, 5}, {4, 4, 9}, false)}), false).count, 0u);
  // A screen of 8 m × 3 m that stands on the ground: both sides and the top.
  SceneDescription screen = street();
  screen.meshes.push_back(solids::empty_mesh("wood"));
  solids::add_quad(screen.meshes.back(), {40, 0, -2}, {40, 8, -2}, {40, 8, 1}, {40, 0, 1});
  EXPECT_EQ(rims(screen, true).count, 1u);
  EXPECT_NEAR(rims(screen, true).length, 14, 0.05);  // a contact distance at each corner
  // One that hangs in the air, its upper edge artificial.
  SceneDescription hanging = street();
  hanging.meshes.push_back(solids::empty_mesh("wood"));
  solids::add_quad(hanging.meshes.back(), {40, 0, 3}, {40, 8, 3}, {40, 8, 6}, {40, 0, 6});
  EXPECT_NEAR(rims(hanging, true).length, 22, 1e-9);  // rounding
  hanging.meshes.back().artificial_edges.push_back({2, 3});
  EXPECT_NEAR(rims(hanging, true).length, 14, 1e-9);
  hanging.meshes.back().artificial_edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  EXPECT_EQ(rims(hanging, false).count, 0u);
  // A house without a piece of its roof, and one without a piece of a wall.
  for (const std::size_t missing : {8u, 2u}) {
    SceneDescription holed = street();
    auto& triangles = holed.meshes[2].triangles;
    ASSERT_LT(missing, triangles.size());
    triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_EQ(rims(holed, true).count, 1u) << missing;
  }
}

TEST(Scene, ReplacesMaterials) {
  MaterialChoice choice;
  choice.replace["brick"] = "Wood";
  Diagnostics diagnostics;
  EXPECT_EQ(build_scene(street(), choice, diagnostics).materials[2].name, "wood");
  choice.replace["*"] = "metal";
  const Scene s = build_scene(street(), choice, diagnostics);
  ASSERT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0].name, "metal");
  EXPECT_EQ(s.materials[1].name, "wood");
  EXPECT_FALSE(diagnostics.has_errors());
  choice.replace["glas"] = "metal";
  build_scene(street(), choice, diagnostics);
  EXPECT_NE(messages(diagnostics).find("did you mean glass"), std::string::npos) << messages(diagnostics);
}

TEST(Scene, UnknownMaterialIsAnErrorWithASuggestion) {
  SceneDescription description = street();
  description.meshes[2].material = "bricks";
  Diagnostics diagnostics;
  build_scene(description, {}, diagnostics);
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_NE(messages(diagnostics).find("unknown material \"bricks\""), std::string::npos);
  EXPECT_NE(messages(diagnostics).find("did you mean brick"), std::string::npos);
}

TEST(Scene, NumbersOutOfRangeAreErrors) {
  SceneDescription description = street();
  description.materials["glass"] = {-0.1, 0.5, -1.0};
  Diagnostics diagnostics;
  build_scene(description, {}, diagnostics);
  EXPECT_EQ(std::count_if(diagnostics.all().begin(), diagnostics.all().end(),
                          [](const Diagnostic& d) { return d.severity == Severity::error; }),
            3);
}

TEST(Scene, FacesWithoutMaterialTakeTheDefaultAndSaySo) {
  SceneDescription description = street();
  description.meshes[2].material.clear();
  MaterialChoice choice;
  choice.default_material = "marble";
  Diagnostics diagnostics;
  const Scene s = build_scene(description, choice, diagnostics);
  EXPECT_EQ(s.materials[2].name, "marble");
  EXPECT_NE(messages(diagnostics).find("10 triangles without a material; \"marble\" is used"), std::string::npos)
      << messages(diagnostics);
}

TEST(Scene, DefectsAreReportedWithTheirCounts) {
  SceneDescription description = street();
  description.meshes.push_back(description.meshes[1]);
  description.meshes.push_back(box({-20, 0, -2}, {-19.996, 1, 0}, false, "wood"));  // 4 mm thick: narrow faces vanish
  for (auto& t : description.meshes[3].triangles) std::swap(t[1], t[2]);
  Diagnostics diagnostics;
  const Scene s = build_scene(description, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_GT(s.defects.degenerate, 0u);
  const std::string text = messages(diagnostics);
  for (const std::string& part :
       {std::to_string(s.defects.degenerate) + " degenerate", std::to_string(s.defects.duplicate) + " duplicate",
        std::to_string(s.defects.flipped) + " triangles turned round"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(Scene, WithoutTrianglesIsAnError) {
  Diagnostics nothing;
  EXPECT_TRUE(build_scene(SceneDescription{}, {}, nothing).triangles.empty());
  EXPECT_TRUE(nothing.has_errors());
  // A city in kilometres taken for metres: every triangle is welded away.
  Diagnostics tiny;
  build_scene(scene({box({0, 0, 0}, {0.004, 0.004, 0.004})}), {}, tiny);
  EXPECT_TRUE(tiny.has_errors());
  EXPECT_NE(messages(tiny).find("12 are degenerate"), std::string::npos);
}

}  // namespace
}  // namespace grimaldi
