// The model `auto`: its shares, the objects that it takes as wholes, its bound and its records.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "propagation/edge_model.h"
#include "propagation/object_wave.h"
#include "propagation/result_file.h"
#include "propagation/small_object.h"
#include "scenes/shapes.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

EdgePassage passage(double s_in, double s_out) {
  EdgePassage made;
  made.s_in = s_in;
  made.s_out = s_out;
  return made;
}

TEST(EdgeModel, LongEdgesAreUtdAndShortOnesFsd) {
  // L = 50 m, λ = 0.5 m: r_F = 5 m.
  const auto share = [](double length) {
    return utd_share(DiffractionModel::automatic, length, passage(100, 100), 0.5);
  };
  EXPECT_EQ(share(10.001), 1);
  EXPECT_EQ(share(4.999), 0);
  EXPECT_NEAR(share(10 / std::sqrt(2.0)), 0.5, 1e-12);  // the middle of the fade; rounding
  // Near a source the zone is small, and the wavelength decides.
  EXPECT_EQ(utd_share(DiffractionModel::automatic, 0.501, passage(0.01, 100), 0.5), 1);
  EXPECT_EQ(utd_share(DiffractionModel::automatic, 0.249, passage(0.01, 100), 0.5), 0);
  EXPECT_EQ(utd_share(DiffractionModel::utd, 1e-3, passage(100, 100), 0.5), 1);
  EXPECT_EQ(utd_share(DiffractionModel::fsd, 1e3, passage(100, 100), 0.5), 0);
}

TEST(EdgeModel, SharesAreContinuousSteadyAndSymmetric) {
  double utd = 0, polygon = 1;
  for (double length = 1; length < 40; length *= 1.002) {
    const double next = utd_share(DiffractionModel::automatic, length, passage(70, 130), 0.5);
    EXPECT_EQ(next, utd_share(DiffractionModel::automatic, length, passage(130, 70), 0.5));
    const double whole = polygon_share(length, true, 70, 130, 0.5);
    EXPECT_EQ(whole, polygon_share(length, true, 130, 70, 0.5));
    EXPECT_GE(next, utd);
    EXPECT_LE(whole, polygon);
    // The steepest slope of the fade is π/(2 ln 2) per unit of ln l: 0.0046 for a step of 0.2 %.
    EXPECT_LT(next - utd, 0.005);
    EXPECT_LT(polygon - whole, 0.005);
    utd = next;
    polygon = whole;
  }
  EXPECT_EQ(utd, 1);
  EXPECT_EQ(polygon, 0);
}

TEST(EdgeModel, PolygonFormUpToAFresnelNumberOfATenth) {
  // L = 50 m, λ = 0.5 m: N = D²/100 m².
  EXPECT_EQ(polygon_share(3.16, true, 100, 100, 0.5), 1);
  EXPECT_EQ(polygon_share(6.33, true, 100, 100, 0.5), 0);
  // Nowhere within a diameter.
  EXPECT_EQ(polygon_share(2, true, 1.99, 1e4, 10), 0);
  // Nothing while a boundary may cut the object, all where it is a diameter off.
  EXPECT_EQ(clear_share(2, 1), 0);
  EXPECT_EQ(clear_share(2, 2), 1);
  // The largest diameter over a reach is that of the middle.
  const double largest = largest_small_diameter(200, 0.5);
  EXPECT_GT(polygon_share(0.999 * largest, false, 100, 100, 0.5), 0);
  EXPECT_EQ(polygon_share(1.001 * largest, false, 100, 100, 0.5), 0);
}

/// A flat rectangle in x = `x`, or with a depth a closed box behind it; metal.
void append(SceneDescription& scene, double x, double depth, double half) {
  MeshDescription mesh{"object", "", "metal", {}, {}, {}};
  for (const double at : {x, x + depth})
    for (const auto& [y, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      mesh.vertices.push_back({at, half * y, half * z});
  if (depth == 0) {
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.vertices.resize(4);
  } else {
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  }
  scene.meshes.push_back(std::move(mesh));
}

/// A metal sheet in x = `x` over the squares between the lines of `grid` along y and z, without those numbered by
/// `holes` (along y first); outer rim artificial.
void append_holed(SceneDescription& scene, double x, const std::vector<double>& grid, std::vector<std::size_t> holes) {
  MeshDescription mesh{"sheet", "", "metal", {}, {}, {}};
  append_sheet(grid, grid, {x, 0, 0}, {0, 1, 0}, {0, 0, 1}, {true, true, true, true}, mesh);
  std::sort(holes.rbegin(), holes.rend());
  for (const std::size_t cell : holes) {
    const auto first = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(2 * cell);
    mesh.triangles.erase(first, first + 2);
  }
  scene.meshes.push_back(std::move(mesh));
}

Scene built(const SceneDescription& description) {
  Diagnostics diagnostics;
  MaterialChoice choice;
  Scene scene = build_scene(description, choice, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

TEST(SmallObject, SheetsAndConvexSolidsThatStandFree) {
  SceneDescription description;
  append(description, 0, 0, 1);
  append(description, 20, 1, 1);
  append(description, 40, 2, 2);
  append(description, 42, 1, 1);  // touches the one before: neither stands free
  const Scene scene = built(description);
  const SmallObjects found = find_small_objects(scene, 1e3);
  ASSERT_EQ(found.objects.size(), 2u);
  EXPECT_EQ(found.objects[0].kind, ObjectKind::sheet);
  EXPECT_EQ(found.objects[1].kind, ObjectKind::solid);
  EXPECT_DOUBLE_EQ(found.objects[0].diameter, 2 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(found.objects[1].diameter, 3);
  EXPECT_DOUBLE_EQ(found.objects[0].area, 4);
  EXPECT_DOUBLE_EQ(found.objects[1].area, 16);
  std::size_t edges[2] = {};
  for (const std::uint32_t object : found.of_wedge)
    if (object != no_index) ++edges[object];
  EXPECT_EQ(edges[0], 4u);
  EXPECT_EQ(edges[1], 12u);
  EXPECT_TRUE(crosses(found.objects[1], {10, 0.3, 0.2}, {30, 0.3, 0.2}));
  EXPECT_FALSE(crosses(found.objects[1], {10, 1.3, 0.2}, {30, 1.3, 0.2}));
  EXPECT_FALSE(crosses(found.objects[1], {10, 0.3, 0.2}, {19, 0.3, 0.2}));
  EXPECT_EQ(find_small_objects(scene, 2.9).objects.size(), 1u);
}

TEST(SmallObject, BuildingsOnTheGroundAndCutSheetsAreNone) {
  EXPECT_TRUE(find_small_objects(test::built_in("demo-city"), 1e6).objects.empty());
  EXPECT_TRUE(find_small_objects(test::built_in("half-plane"), 1e6).objects.empty());
}

TEST(SmallObject, HolesInSheets) {
  const std::vector<double> grid{-30, -1, 0, 1, 30};
  SceneDescription description;
  append_holed(description, 0, grid, {5, 6, 9});  // three of the four small squares
  append_holed(description, 20, grid, {5, 6, 9, 10});
  append(description, 20, 0, 0.2);               // a plate in the middle of that hole
  append_holed(description, 40, grid, {5, 10});  // two that meet at a corner
  append_holed(description, 60, grid, {4, 5});   // a notch
  const Scene scene = built(description);
  const SmallObjects found = find_small_objects(scene, 5);
  // The plate stands free: an object; the hole that it stands in is none.
  ASSERT_EQ(found.objects.size(), 2u);
  EXPECT_EQ(found.objects[0].kind, ObjectKind::sheet);
  const SmallObject& hole = found.objects[1];
  EXPECT_EQ(hole.kind, ObjectKind::opening);
  EXPECT_DOUBLE_EQ(hole.area, 3);
  EXPECT_DOUBLE_EQ(hole.diameter, 2 * std::sqrt(2.0));
  double rim = 0;
  for (std::uint32_t w = 0; w < found.of_wedge.size(); ++w)
    if (found.of_wedge[w] == 1) rim += scene.wedges.wedges[w].length;
  EXPECT_DOUBLE_EQ(rim, 8);
  EXPECT_TRUE(crosses(hole, {-1, -0.5, 0.5}, {1, -0.5, 0.5}));
  EXPECT_FALSE(crosses(hole, {-1, 0.5, 0.5}, {1, 0.5, 0.5}));  // the square that is left
  EXPECT_TRUE(find_small_objects(scene, 2.8).objects.size() == 1);
}

TEST(SmallObject, HolesInASmallSheetArePartOfIt) {
  SceneDescription description;
  append_holed(description, 0, {-3, -1, 1, 3}, {4});
  description.meshes[0].artificial_edges.clear();
  const SmallObjects found = find_small_objects(built(description), 50);
  ASSERT_EQ(found.objects.size(), 1u);
  EXPECT_EQ(found.objects[0].kind, ObjectKind::sheet);
  EXPECT_DOUBLE_EQ(found.objects[0].area, 32);
  // The sheet is too large, the hole is not.
  const SmallObjects holes = find_small_objects(built(description), 5);
  ASSERT_EQ(holes.objects.size(), 1u);
  EXPECT_EQ(holes.objects[0].kind, ObjectKind::opening);
}

TEST(ObjectWave, SmallOpeningsShineWhereTheirEdgesDoNot) {
  SceneDescription description;
  append_holed(description, 0, {-30, -0.4, 0.4, 30}, {4});
  const Scene scene = built(description);
  const SmallObjects found = find_small_objects(scene, 5);
  ASSERT_EQ(found.objects.size(), 1u);
  const Vec3 source{-40, 0.1, 0.2};
  int edges = 0;
  for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
    const Interaction interactions[] = {edge_interaction(w)};
    PathGeometry geometry;
    const auto reaches = [&](const SmallObjects* objects, double wavelength) {
      return UnfoldedSequence(scene, source, interactions, objects).solve({40, 16, 16}, wavelength, geometry);
    };
    // 7.6 m beyond the edges' ends: v_V = 4.4.
    EXPECT_FALSE(reaches(nullptr, 0.3));
    EXPECT_TRUE(reaches(&found, 0.3));
    EXPECT_FALSE(reaches(&found, 0.01));  // N = 1.5
    edges += found.of_wedge[w] == 0;
  }
  EXPECT_EQ(edges, 4);
}

TEST(ObjectWave, StaysBelowItsBound) {
  for (const int kind : {0, 1, 2}) {
    SceneDescription description;
    if (kind == 2)
      append_holed(description, 0, {-30, -0.4, 0.4, 30}, {4});
    else
      append(description, 0, 0.6 * kind, 0.4);
    const Scene scene = built(description);
    PlanDescription request = test::plan_for(WaveKind::radio, 1e9, {-20, 0, 0});
    request.diffraction_model = DiffractionModel::automatic;
    const Tracer tracer(scene);
    Diagnostics diagnostics;
    Plan plan = make_plan(request, scene, tracer, diagnostics);
    ASSERT_EQ(plan.small_objects.objects.size(), 1u);
    std::size_t asked = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const auto u = uniform4(3, 0, i, 0), v = uniform4(3, 0, i, 1);
      // Near the straight ways past the object, and all round it.
      const double spread = i % 2 == 0 ? 3 : 40;
      const Vec3 source{-1 - 30 * u[0], spread * (u[1] - 0.5), spread * (u[2] - 0.5)};
      const Vec3 receiver{i % 4 < 2 ? 1 + 30 * v[0] : -1 - 30 * v[0], spread * (v[1] - 0.5), spread * (v[2] - 0.5)};
      plan.request.transmitters[0].position = source;
      for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
        const Interaction interactions[] = {edge_interaction(w)};
        PathGeometry geometry;
        if (!UnfoldedSequence(scene, source, interactions, &plan.small_objects).solve(receiver, 0.3, geometry))
          continue;
        std::array<std::complex<double>, 2> field[1];
        arrival_field(scene, plan, plan.request.transmitters[0], interactions, geometry, true, 1, field);
        EXPECT_LE(received_power(field[0], Polarisation::both), power_bound(scene, plan, interactions, geometry));
        ++asked;
      }
    }
    EXPECT_GT(asked, 1000u);
  }
}

TEST(ObjectWave, MapsCountItOnceAndTellWhatCarriedIt) {
  for (const bool hole : {false, true}) {
    SceneDescription description;
    if (hole)
      append_holed(description, 0, {-30, -0.4, 0.4, 30}, {4});
    else
      append(description, 0, 0, 0.4);
    const Scene scene = built(description);
    PlanDescription request = test::plan_for(WaveKind::radio, 1e9, {-40, 0.1, 0.2});
    request.diffraction_model = DiffractionModel::automatic;
    request.depth = 1;
    request.rays = 1e5;
    request.coverage = CoverageRequest{};
    request.coverage->height = 0.3;
    request.coverage->cell_size = 0.02;
    request.coverage->area = {{30, -1, 30.1, 1}};
    const Tracer tracer(scene);
    Diagnostics diagnostics;
    Plan plan = make_plan(request, scene, tracer, diagnostics);
    diagnostics.throw_if_errors();
    std::vector<std::size_t> cells;
    for (std::size_t cell = 2; cell < plan.grid.size(); cell += 61) {
      cells.push_back(cell);
      request.receivers.push_back(test::receiver_at(plan.grid.centre(cell)));
    }
    plan = make_plan(request, scene, tracer, diagnostics);
    const Result result = simulate(scene, tracer, plan);
    const MapFigures figures = map_figures(plan, *result.coverage);
    const double diffraction = figures.mechanism_power[std::size_t(Mechanism::diffraction)];
    EXPECT_GT(diffraction, 0);
    // N = 0.06 at all cells: the whole object alone. 1e-12: rounding of sums.
    EXPECT_NEAR(figures.model_power[std::size_t(EdgeModel::polygon)] / diffraction, 1, 1e-12);
    EXPECT_EQ(figures.model_power[std::size_t(EdgeModel::utd)], 0);
    for (std::size_t i = 0; i < cells.size(); ++i)
      // A cell of 2 cm is nearly a point: the level changes by less than 0.05 dB over it.
      EXPECT_NEAR(test::decibel(result.coverage->path_gain[cells[i]] / result.profiles[i].total[0]), 0, 0.05);
  }
}

}  // namespace
}  // namespace grimaldi
