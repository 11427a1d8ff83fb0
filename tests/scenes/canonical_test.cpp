#include "scenes/canonical.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/constants.h"
#include "scenes/scene.h"
#include "scenes/shapes.h"

namespace grimaldi {
namespace {

SceneDescription make(const std::string& name, const CanonicalParameters& parameters = {}) {
  Diagnostics diagnostics;
  SceneDescription scene = canonical_scene(name, parameters, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << name;
  EXPECT_EQ(scene.name, name);
  return scene;
}

Scene built(const std::string& name, const CanonicalParameters& parameters = {}) {
  Diagnostics diagnostics;
  Scene scene = build_scene(make(name, parameters), {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << name;
  return scene;
}

using Point = std::tuple<double, double, double>;
Point key(const Vec3& p) { return {p.x, p.y, p.z}; }

/// How often each directed edge occurs, corners told apart by their exact coordinates.
std::map<std::pair<Point, Point>, int> directed_edges(const SceneDescription& scene) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const MeshDescription& mesh : scene.meshes) {
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{key(mesh.vertices[t[i]]), key(mesh.vertices[t[(i + 1) % 3]])}];
    }
  }
  return edges;
}

/// Every edge once in each direction: a closed surface of one orientation.
void expect_closed(const SceneDescription& scene) {
  const auto edges = directed_edges(scene);
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    EXPECT_TRUE(edges.count({edge.second, edge.first}));
  }
}

/// Volume by the divergence theorem; positive if the normals point outward.
double signed_volume(const SceneDescription& scene) {
  double six = 0;
  for (const MeshDescription& mesh : scene.meshes) {
    for (const auto& t : mesh.triangles) {
      six += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    }
  }
  return six / 6;
}

double area(const SceneDescription& scene) {
  double twice = 0;
  for (const MeshDescription& mesh : scene.meshes) {
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      twice += norm(cross(b - a, c - a));
    }
  }
  return twice / 2;
}

bool has_origin(const SceneDescription& scene) {
  const auto& v = scene.meshes.at(0).vertices;
  return std::find(v.begin(), v.end(), Vec3{}) != v.end();
}

double wedge_length(const Scene& scene) {
  double sum = 0;
  for (const Wedge& wedge : scene.wedges.wedges) sum += wedge.length;
  return sum;
}

TEST(Canonical, names) {
  EXPECT_EQ(canonical_names(),
            (std::vector<std::string>{"demo-city", "half-plane", "strip", "slit", "wedge", "box", "street-canyon"}));
  for (const std::string& name : canonical_names()) {
    const SceneDescription scene = make(name);
    ASSERT_FALSE(scene.meshes.empty()) << name;
    for (const MeshDescription& mesh : scene.meshes) {
      EXPECT_FALSE(mesh.triangles.empty()) << mesh.name;
      EXPECT_FALSE(mesh.material.empty()) << mesh.name;
      for (const auto& t : mesh.triangles) {
        for (std::uint32_t i : t) ASSERT_LT(i, mesh.vertices.size());
      }
      for (const auto& e : mesh.artificial_edges) {
        for (std::uint32_t i : e) ASSERT_LT(i, mesh.vertices.size());
      }
      for (const Vec3& v : mesh.vertices) ASSERT_TRUE(is_finite(v));
    }
  }
}

/// Ends of every documented range build: the extreme values are promises too.
TEST(Canonical, range_ends_build) {
  for (const std::string& name : canonical_names()) {
    for (const CanonicalParameter& parameter : canonical_parameters(name)) {
      EXPECT_LE(parameter.low, parameter.value);
      EXPECT_GE(parameter.high, parameter.value);
      for (double value : {parameter.low, parameter.high}) make(name, {{std::string(parameter.name), value}});
    }
  }
}

TEST(Canonical, half_plane_has_one_edge) {
  const SceneDescription scene = make("half-plane", {{"length", 3000}, {"depth", 500}});
  EXPECT_TRUE(has_origin(scene));
  EXPECT_NEAR(area(scene), 3000 * 500, 1e-6);  // 1.5e6 m² in doubles: rounding of some 1e-10
  for (const Vec3& v : scene.meshes[0].vertices) {
    EXPECT_EQ(v.x, 0);
    EXPECT_LE(v.z, 0);
  }
  const Scene ready = built("half-plane", {{"length", 3000}, {"depth", 500}});
  ASSERT_EQ(ready.wedges.wedges.size(), 1u);
  const Wedge& edge = ready.wedges.wedges[0];
  EXPECT_TRUE(edge.free_rim);
  EXPECT_NEAR(edge.length, 3000, 1e-9);               // a difference of exact corners
  EXPECT_NEAR(std::abs(edge.direction.y), 1, 1e-12);  // a normalised axis
  EXPECT_NEAR(norm(edge.point(edge.length / 2)), 0, 1e-9);
  EXPECT_NEAR(edge.exterior_angle, 2 * pi, 1e-12);
  EXPECT_EQ(ready.patches.patches.size(), 1u);
}

/// No piece of a screen is longer than 200 m either way: the bound on single precision in the header rests on it.
TEST(Canonical, pieces_are_short) {
  for (const char* name : {"half-plane", "strip", "slit"}) {
    for (const MeshDescription& mesh : make(name).meshes) {
      for (const auto& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 side = mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]];
          EXPECT_LE(std::abs(side.y), 200 + 1e-9) << name;  // cuts of 4000 m round by some 1e-13
          EXPECT_LE(std::abs(side.z), 200 + 1e-9) << name;
        }
      }
    }
  }
}

TEST(Canonical, strip_and_slit_have_two_edges) {
  for (const char* name : {"strip", "slit"}) {
    const Scene ready = built(name, {{"width", 0.6}});
    ASSERT_EQ(ready.wedges.wedges.size(), 2u) << name;
    std::set<double> heights;
    for (const Wedge& edge : ready.wedges.wedges) {
      EXPECT_TRUE(edge.free_rim);
      EXPECT_NEAR(edge.length, 4000, 1e-9);
      heights.insert(edge.start.z);
    }
    EXPECT_EQ(heights, (std::set<double>{-0.3, 0.3})) << name;
  }
  EXPECT_NEAR(area(make("strip", {{"width", 0.6}})), 0.6 * 4000, 1e-9);
  EXPECT_NEAR(area(make("slit", {{"width", 0.6}, {"depth", 300}, {"length", 1000}})), 2 * 300 * 1000, 1e-6);
}

/// The narrowest strip and slit that the ranges allow are not welded shut.
TEST(Canonical, narrowest_strip_and_slit) {
  EXPECT_EQ(built("strip", {{"width", 0.05}}).wedges.wedges.size(), 2u);
  EXPECT_EQ(built("slit", {{"width", 0.05}}).wedges.wedges.size(), 2u);
}

TEST(Canonical, wedge_is_a_closed_solid_with_one_edge) {
  for (double degrees : {1.0, 30.0, 90.0, 120.0, 174.9}) {
    const CanonicalParameters parameters = {{"interior_angle", degrees}, {"length", 1000}, {"depth", 700}};
    const SceneDescription scene = make("wedge", parameters);
    expect_closed(scene);
    EXPECT_TRUE(has_origin(scene));
    const double exact = 0.5 * 700 * 700 * std::sin(degrees * pi / 180) * 1000;  // isosceles triangle × length
    EXPECT_NEAR(signed_volume(scene), exact, 1e-9 * exact + 1e-4);  // sums of terms up to 1e9 m³, 2⁻⁵³ each
    const Scene ready = built("wedge", parameters);
    ASSERT_EQ(ready.wedges.wedges.size(), 1u) << degrees;
    const Wedge& edge = ready.wedges.wedges[0];
    EXPECT_NEAR(edge.exterior_angle, 2 * pi - degrees * pi / 180, 1e-9);  // normals of faces of 700 m: 1e-13 rad
    EXPECT_NEAR(edge.length, 1000, 1e-9);
    EXPECT_FALSE(edge.free_rim);
    EXPECT_NEAR(norm(edge.point(edge.length / 2)), 0, 1e-9);
    EXPECT_NEAR(edge.along0.z, -std::cos(degrees / 2 * pi / 180), 1e-9);  // symmetric about −z
    EXPECT_EQ(ready.defects.flipped, 0u);
    EXPECT_EQ(ready.defects.degenerate, 0u);
  }
}

TEST(Canonical, box_looks_inward) {
  const SceneDescription scene = make("box");
  expect_closed(scene);
  EXPECT_EQ(signed_volume(scene), -10.0 * 12 * 8);  // small whole numbers: exact
  EXPECT_EQ(area(scene), 2.0 * (10 * 12 + 10 * 8 + 12 * 8));
  EXPECT_EQ(scene.meshes[0].artificial_edges.size(), 12u);
  EXPECT_TRUE(built("box").wedges.wedges.empty());
}

TEST(Canonical, box_with_walls) {
  const SceneDescription scene = make("box", {{"thick", 0.5}});
  expect_closed(scene);
  EXPECT_EQ(signed_volume(scene), 11.0 * 13 * 9 - 10.0 * 12 * 8);  // the walls; halves of whole numbers: exact
  EXPECT_EQ(scene.meshes[0].artificial_edges.size(), 24u);
  EXPECT_TRUE(built("box", {{"thick", 0.5}}).wedges.wedges.empty());
}

TEST(Canonical, street_canyon) {
  const CanonicalParameters parameters = {{"count", 3}, {"width", 12}, {"height", 25}};
  const SceneDescription scene = make("street-canyon", parameters);
  ASSERT_EQ(scene.meshes.size(), 1u + 2 * 2 * 3);
  EXPECT_EQ(scene.meshes[0].material, "concrete");
  EXPECT_EQ(scene.meshes[1].name, "north 1 walls");
  EXPECT_EQ(scene.meshes[1].material, "brick");
  EXPECT_EQ(scene.meshes[2].material, "metal");
  for (const MeshDescription& mesh : scene.meshes) {
    for (const Vec3& v : mesh.vertices) {
      EXPECT_LE(std::abs(v.x), 105 + 50);  // (3·60 + 2·15)/2 and the margin
      EXPECT_LE(std::abs(v.y), 6 + 15 + 50);
      if (mesh.name != "ground") {
        EXPECT_GE(std::abs(v.y), 6);
      }
    }
  }
  const Scene ready = built("street-canyon", parameters);
  // Of each house four edges round the roof (walls and roof differ in material) and four upright ones; the ground ends
  // nowhere.
  EXPECT_EQ(ready.wedges.wedges.size(), 6u * 8);
  EXPECT_NEAR(wedge_length(ready), 6 * (2 * (60 + 15) + 4 * 25), 1e-9);
  for (const Wedge& edge : ready.wedges.wedges) EXPECT_NEAR(edge.exterior_angle, 1.5 * pi, 1e-9);
  EXPECT_EQ(ready.defects.flipped, 0u);
}

TEST(Canonical, faults_are_told) {
  const auto messages = [](const std::string& name, const CanonicalParameters& parameters) {
    Diagnostics diagnostics;
    const SceneDescription scene = canonical_scene(name, parameters, diagnostics);
    EXPECT_TRUE(scene.meshes.empty()) << name;
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) {
      EXPECT_EQ(d.severity, Severity::error);
      EXPECT_FALSE(d.suggestion.empty());
      all += to_string(d) + "\n";
    }
    return all;
  };
  EXPECT_NE(messages("half-plan", {}).find("did you mean half-plane"), std::string::npos);
  EXPECT_NE(messages("strip", {{"widht", 1}}).find("did you mean width"), std::string::npos);
  EXPECT_NE(messages("strip", {{"width", 0}}).find("0.05"), std::string::npos);
  EXPECT_NE(messages("demo-city", {{"size", 1}}).find("takes none"), std::string::npos);
  EXPECT_NE(messages("street-canyon", {{"count", 2.5}}).find("whole number"), std::string::npos);
  EXPECT_NE(messages("box", {{"thick", 0.01}}).find("too thin"), std::string::npos);
  EXPECT_NE(messages("wedge", {{"interior_angle", std::nan("")}}).find("finite"), std::string::npos);
  EXPECT_NE(messages("wedge", {{"depth", std::numeric_limits<double>::infinity()}}).find("finite"), std::string::npos);
  const std::string both = messages("wedge", {{"interior_angle", 180}, {"length", -1}});  // all faults at once
  EXPECT_NE(both.find("interior_angle"), std::string::npos);
  EXPECT_NE(both.find("length"), std::string::npos);
}

/// Errors of another input that stand in the list already are not taken for the scene's own.
TEST(Canonical, earlier_errors_do_not_matter) {
  Diagnostics diagnostics;
  diagnostics.error("other", 1, {}, "something else");
  EXPECT_FALSE(canonical_scene("box", {}, diagnostics).meshes.empty());
  EXPECT_EQ(diagnostics.all().size(), 1u);
}

TEST(Shapes, cuts) {
  const std::vector<double> cuts = symmetric_cuts(1000, 300);
  EXPECT_EQ(cuts.size(), 9u);  // ceil(1000/300) = 4 pieces each side
  for (std::size_t i = 0; i < cuts.size(); ++i) EXPECT_EQ(cuts[i], -cuts[cuts.size() - 1 - i]);
  EXPECT_EQ(cuts[4], 0);
  EXPECT_EQ(equal_cuts(-1, 0.5, 0.5), (std::vector<double>{-1, -0.5, 0, 0.5}));
}

}  // namespace
}  // namespace grimaldi
