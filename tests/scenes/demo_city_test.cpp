#include "scenes/demo_city.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "scenes/scene.h"

namespace grimaldi {
namespace {

using Polygon = std::vector<PlanPoint>;

double turn(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Even-odd rule.
bool inside(const Polygon& polygon, const PlanPoint& p) {
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

bool inside(const Building& building, const PlanPoint& p) {
  return inside(building.outline, p) && !inside(building.courtyard, p);
}

double distance(const PlanPoint& p, const PlanPoint& a, const PlanPoint& b) {
  const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  const double t = std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

/// Distance of two polygons' rims; 0 if they cross or touch.
double distance(const Polygon& p, const Polygon& q) {
  double least = 1e9;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const PlanPoint &a = p[i], &b = p[(i + 1) % p.size()];
    for (std::size_t j = 0; j < q.size(); ++j) {
      const PlanPoint &c = q[j], &d = q[(j + 1) % q.size()];
      // A true crossing; where they only touch, a corner of one lies on the other and its distance is 0.
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return 0;
      least = std::min({least, distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
    }
  }
  return least;
}

std::vector<Polygon> rims(const Building& building) {
  if (building.courtyard.empty()) return {building.outline};
  return {building.outline, building.courtyard};
}

double distance(const Building& a, const Building& b) {
  double least = 1e9;
  for (const Polygon& p : rims(a)) {
    for (const Polygon& q : rims(b)) least = std::min(least, distance(p, q));
  }
  return least;
}

double floor_area(const Building& building) { return signed_area(building.outline) - signed_area(building.courtyard); }

TEST(DemoCity, buildings_stand_apart) {
  const std::vector<Building> buildings = demo_city_buildings();
  EXPECT_GE(buildings.size(), 45u);
  EXPECT_LE(buildings.size(), 70u);
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    for (std::size_t j = i + 1; j < buildings.size(); ++j) {
      const Building &a = buildings[i], &b = buildings[j];
      // Rims apart and no corner of one within the other: the footprints are disjoint.
      EXPECT_FALSE(inside(a, b.outline[0]) || inside(b, a.outline[0])) << a.name << ", " << b.name;
      const bool one_block = a.name.substr(0, 2) == b.name.substr(0, 2);
      // Alleys of 3 m within a block, streets of 12 m between blocks; 1e-9: rounding of coordinates of 300 m.
      EXPECT_GE(distance(a, b), (one_block ? 3 : 12) - 1e-9) << a.name << ", " << b.name;
    }
  }
}

TEST(DemoCity, footprints_are_sound) {
  double built_up = 0;
  std::map<std::string, int> names;
  for (const Building& b : demo_city_buildings()) {
    EXPECT_EQ(++names[b.name], 1);
    EXPECT_GT(signed_area(b.outline), 200) << b.name;
    built_up += floor_area(b);
    for (const Polygon& rim : rims(b)) {
      EXPECT_GT(signed_area(rim), 0) << b.name;  // counter-clockwise, both
      for (std::size_t i = 0; i < rim.size(); ++i) {
        const PlanPoint &p = rim[i], &q = rim[(i + 1) % rim.size()];
        EXPECT_GE(std::hypot(q.x - p.x, q.y - p.y), 5.9) << b.name;  // no slivers: courtyard sides of 6 m at least
        EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 300) << b.name;
        EXPECT_GT(std::abs(turn(p, q, rim[(i + 2) % rim.size()])), 1) << b.name;  // no three corners in line, m²
      }
    }
    if (!b.courtyard.empty()) {
      for (const PlanPoint& p : b.courtyard) EXPECT_TRUE(inside(b.outline, p)) << b.name;
      EXPECT_NEAR(distance(b.outline, b.courtyard), 13, 1e-9) << b.name;  // the depth of a wing
    }
    EXPECT_GE(b.height, 8) << b.name;
    if (b.name == "E2 1") {
      EXPECT_EQ(b.height, 90);
    } else {
      EXPECT_LE(b.height + b.rise, 40) << b.name;
    }
  }
  // A European inner city has a quarter to a half of its ground built up.
  EXPECT_GT(built_up / (600 * 600), 0.25);
  EXPECT_LT(built_up / (600 * 600), 0.5);
}

TEST(DemoCity, has_what_its_header_says) {
  const std::vector<Building> buildings = demo_city_buildings();
  const auto count = [&](auto&& is) { return std::count_if(buildings.begin(), buildings.end(), is); };
  EXPECT_GE(count([](const Building& b) { return b.rise > 0; }), 6);              // gabled
  EXPECT_GE(count([](const Building& b) { return !b.courtyard.empty(); }), 10);   // closed courtyards
  EXPECT_GE(count([](const Building& b) { return b.outline.size() == 12; }), 5);  // courtyards with a passage
  EXPECT_GE(count([](const Building& b) { return b.outline.size() == 6; }), 6);   // L
  EXPECT_GE(count([](const Building& b) { return b.outline.size() == 8; }), 6);   // U (and the tower)
  EXPECT_EQ(count([](const Building& b) { return b.height == 90; }), 1);
  EXPECT_EQ(count([](const Building& b) { return b.height == 25; }), 4);
  for (const Building& b : buildings) {
    // Square, avenue and canyon are free: probed with a comb finer than the smallest building (12 m).
    for (double s = -300; s <= 300; s += 3) {
      for (double t = -1; t <= 1; t += 0.25) {
        EXPECT_FALSE(inside(b, {0.8 * s - 0.6 * 11.9 * t, 0.6 * s + 0.8 * 11.9 * t})) << b.name << " on the avenue";
        EXPECT_FALSE(s < -40 && inside(b, {234 + 5.9 * t, s})) << b.name << " in the canyon";
        EXPECT_FALSE(std::abs(s) < 40 && inside(b, {39.9 * t, s})) << b.name << " on the square";
      }
    }
  }
}

TEST(DemoCity, transmitters_stand_outside) {
  double house = 0;
  for (const Building& b : demo_city_buildings()) {
    EXPECT_FALSE(inside(b, {demo_city_mast.x, demo_city_mast.y})) << b.name;
    EXPECT_FALSE(inside(b, {0, 0})) << b.name;
    if (!inside(b, {demo_city_rooftop.x, demo_city_rooftop.y})) continue;
    EXPECT_EQ(house, 0);
    EXPECT_EQ(b.rise, 0);
    house = b.height;
    // 1 m behind the façade on the square, a difference of small whole numbers.
    EXPECT_NEAR(distance(Polygon{{demo_city_rooftop.x, demo_city_rooftop.y}, {-41, 8.001}}, b.outline), 1, 1e-9);
  }
  EXPECT_EQ(house, 23);
  EXPECT_EQ(demo_city_rooftop.z - house, 3);
}

using Point = std::tuple<double, double, double>;
Point key(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Each pair of meshes, walls and roof, bounds a solid that is open at its foot alone, and encloses the volume that its
/// footprint and heights give.
TEST(DemoCity, solids_are_closed_but_for_the_foot) {
  const SceneDescription scene = demo_city();
  const std::vector<Building> buildings = demo_city_buildings();
  ASSERT_EQ(scene.meshes.size(), 1 + 2 * buildings.size());
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const Building& b = buildings[i];
    std::map<std::pair<Point, Point>, int> edges;
    double six = 0, roof_area = 0;
    for (std::size_t m : {2 * i + 1, 2 * i + 2}) {
      const MeshDescription& mesh = scene.meshes[m];
      const bool roof = m % 2 == 0;
      EXPECT_EQ(mesh.name, b.name + (roof ? " roof" : " walls"));
      EXPECT_EQ(mesh.material, roof ? b.roof_material : b.wall_material);
      for (const auto& t : mesh.triangles) {
        const Vec3 &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
        for (const auto& [from, to] : {std::pair{p, q}, std::pair{q, r}, std::pair{r, p}}) {
          ++edges[{key(from), key(to)}];
        }
        six += dot(p, cross(q, r));
        const Vec3 twice = cross(q - p, r - p);
        EXPECT_GT(norm(twice), 2) << mesh.name;  // no triangle below 1 m²
        if (roof) {
          EXPECT_GT(twice.z, 0) << mesh.name;
          roof_area += twice.z / 2;
        } else {
          EXPECT_EQ(twice.z, 0) << mesh.name;  // upright
        }
      }
    }
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1) << b.name;
      const bool foot = std::get<2>(edge.first) == 0 && std::get<2>(edge.second) == 0;
      EXPECT_EQ(edges.count({edge.second, edge.first}), foot ? 0u : 1u) << b.name;
    }
    // The floor at z = 0 adds nothing to the sum. Gable: half of the prism above the eaves. 1e-9: 2⁻⁵³ of terms of 1e7
    // m³.
    EXPECT_NEAR(six / 6, floor_area(b) * (b.height + b.rise / 2), 1e-9 * 1e5) << b.name;
    EXPECT_NEAR(roof_area, floor_area(b), 1e-8) << b.name;  // every point of the plan is roofed once
  }
}

TEST(DemoCity, ground) {
  const MeshDescription ground = demo_city().meshes.at(0);
  EXPECT_EQ(ground.name, "ground");
  double area = 0;
  for (const auto& t : ground.triangles) {
    const Vec3 &p = ground.vertices[t[0]], &q = ground.vertices[t[1]], &r = ground.vertices[t[2]];
    EXPECT_EQ(std::max({p.z, q.z, r.z}), 0);
    EXPECT_LE(std::max({p.x, q.x, r.x}) - std::min({p.x, q.x, r.x}), 150);
    EXPECT_GT(cross(q - p, r - p).z, 0);
    area += cross(q - p, r - p).z / 2;
  }
  EXPECT_EQ(area, 700.0 * 700);                       // cells of 140 m: whole numbers, exact
  EXPECT_EQ(ground.artificial_edges.size(), 4 * 5u);  // the rim
}

/// As the engine sees it: nothing to repair, and every edge that diffracts is one of a house.
TEST(DemoCity, builds_without_defects) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(scene.defects.degenerate, 0u);
  EXPECT_EQ(scene.defects.duplicate, 0u);
  EXPECT_EQ(scene.defects.non_manifold_edges, 0u);
  EXPECT_EQ(scene.defects.flipped, 0u);
  EXPECT_EQ(scene.wedges.report.free_rims.count, 0u);
  EXPECT_EQ(scene.wedges.report.filled.length, 0);
  // Wedges by hand: of a flat roof every side (90° of solid), and every corner that is convex seen from outside; of a
  // gabled house four uprights, two eaves (solid angle 90° + slope), four rakes and the ridge.
  std::size_t expected = 0, feet = 1;  // the rim of the ground is open, too
  for (const Building& b : demo_city_buildings()) {
    feet += rims(b).size();
    if (b.rise > 0) {
      expected += 4 + 2 + 4 + 1;
      continue;
    }
    expected += b.outline.size() + b.courtyard.size();
    for (std::size_t i = 0; i < b.outline.size(); ++i) {
      const std::size_t n = b.outline.size();
      expected += turn(b.outline[i], b.outline[(i + 1) % n], b.outline[(i + 2) % n]) > 0;
    }  // of the courtyard every corner is concave
  }
  EXPECT_EQ(scene.wedges.wedges.size(), expected);
  EXPECT_EQ(scene.defects.holes, feet);
}

/// The same bits on every machine: FNV-1a over the coordinates, taken on x86-64 with the flags of this project. Its
/// arithmetic leaves no freedom (IEEE 754), so another value means that the city has changed: then results for it
/// change too.
TEST(DemoCity, same_bits_everywhere) {
  std::uint64_t hash = 14695981039346656037u;
  for (const MeshDescription& mesh : demo_city().meshes) {
    for (const Vec3& v : mesh.vertices) {
      for (double x : {v.x, v.y, v.z}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
      }
    }
  }
  EXPECT_EQ(hash, 17244369354212838405u);
}

}  // namespace
}  // namespace grimaldi
