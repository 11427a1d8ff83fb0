// Paths that are led around what blocks them, and the points of a cell that are asked for them.

#include <algorithm>
#include <cmath>

#include "propagation/coverage_grid.h"
#include "propagation/effort.h"
#include "propagation/sequence.h"
#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

/// Two long thin screens in a row, 20 m and 16 m high; the street lies behind both.
Scene two_walls() {
  MeshDescription screens = solids::empty_mesh("metal");
  solids::add_quad(screens, {40, -200, 0}, {40, 200, 0}, {40, 200, 20}, {40, -200, 20});
  solids::add_quad(screens, {90, -200, 0}, {90, 200, 0}, {90, 200, 16}, {90, -200, 16});
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({screens}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

PlanDescription street(double rays, std::uint64_t seed) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, {0, 0, 10});
  plan.coverage = CoverageRequest{1.5, 5, std::array<double, 4>{95, -20, 125, 20}, Polarisation::both};
  plan.depth = 2;
  plan.reflection = false;
  plan.rays = rays;
  plan.seed = seed;
  return plan;
}

// The street sees nothing but waves over two edges. What blocks the direct wave leads to them without luck: a hundred
// rays find as much as a hundred thousand, but for the points that a run with more rays asks (4 × 4 against 2 × 2; the
// level falls by 1 dB over a cell, so they agree to a few hundredths).
TEST(Detour, TwoWallsNeedNoLuck) {
  const Scene scene = two_walls();
  const Result few = test::run(scene, street(100, 1)), many = test::run(scene, street(1e5, 2));
  for (std::size_t i = 0; i < few.coverage->path_gain.size(); ++i) {
    ASSERT_GT(few.coverage->path_gain[i], 0) << i;
    EXPECT_NEAR(test::decibel(few.coverage->path_gain[i] / many.coverage->path_gain[i]), 0, 0.1) << i;
  }
}

// At a point too, where there are no cells to start from.
TEST(Detour, APointBehindTwoWalls) {
  const Scene scene = two_walls();
  PlanDescription plan = street(100, 1);
  plan.coverage.reset();
  plan.receivers = {test::receiver_at({110, 0, 1.5})};
  const Result alone = test::run(scene, plan);
  ASSERT_GT(alone.profiles[0].total[0], 0);
  // Another receiver before it changes nothing.
  plan.receivers.insert(plan.receivers.begin(), test::receiver_at({100, 15, 1.5}));
  const Result second = test::run(scene, plan);
  EXPECT_EQ(second.profiles[1].total[0], alone.profiles[0].total[0]);
  EXPECT_EQ(second.profiles[1].paths[0].size(), alone.profiles[0].paths[0].size());
}

// More screens in the way than a path can hold edges (each as high as the line of sight asks for one edge more): the
// ways around end at max_edges, whatever the depth.
TEST(Detour, NoPathHasMoreEdgesThanItCanHold) {
  MeshDescription screens = solids::empty_mesh("metal");
  constexpr int count = 11;
  for (int i = 1; i <= count; ++i) {
    const double x = 20 * i, top = 20 - 0.3 * (i - 6) * (i - 6);
    solids::add_quad(screens, {x, -200, 0}, {x, 200, 0}, {x, 200, top}, {x, -200, top});
  }
  Diagnostics diagnostics;
  const Scene scene = build_scene(solids::scene({screens}), {}, diagnostics);
  diagnostics.throw_if_errors();
  PlanDescription plan = test::plan_for(WaveKind::radio, 1e9, {0, 0, 2});
  plan.receivers = {test::receiver_at({20.0 * (count + 1), 0, 2}), test::receiver_at({170, 0, 5})};
  plan.depth = 12;
  plan.reflection = false;
  plan.rays = 100;
  const Result result = test::run(scene, plan);
  std::size_t most = 0;
  for (const ReceiverProfile& profile : result.profiles)
    for (const PathStory& path : profile.paths[0])
      most =
          std::max(most, static_cast<std::size_t>(std::count(path.interactions.begin(), path.interactions.end(), 'D')));
  EXPECT_EQ(most_edges(plan), static_cast<int>(max_edges));
  EXPECT_LE(most, max_edges);
  EXPECT_GE(most, 4u);  // the receivers lie behind eight and eleven screens
}

// Without the direct wave in the run what blocks it is led around all the same.
TEST(Detour, WithoutTheDirectWave) {
  const Scene scene = two_walls();
  PlanDescription plan = street(100, 1);
  const Result with = test::run(scene, plan);
  plan.direct = false;
  EXPECT_EQ(test::run(scene, plan).coverage->path_gain, with.coverage->path_gain);
}

// The weights of each set of points add up to one over every cell with outdoor area, and more rays ask more points.
TEST(Detour, SetsOfPointsCoverTheCell) {
  const Scene scene = test::built_in("demo-city");
  PlanDescription description = test::plan_for(WaveKind::radio, 3.5e9, {8.5, 21, 27});
  description.coverage = CoverageRequest{1.5, 5, std::array<double, 4>{-100, -100, 100, 100}, Polarisation::both};
  description.rays = 1e6;
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  const CoverageGrid grid = make_coverage_grid(scene, plan);
  for (std::size_t cell = 0; cell < grid.layout.size(); ++cell) {
    if (grid.of(cell).empty()) continue;
    double fine = 0, coarse = 0, dense = 0;
    for (const SubPoint& p : grid.of(cell)) fine += p.weight, coarse += p.edge_weight;
    for (const SubPoint& p : grid.dense_of(cell)) dense += p.edge_weight;
    for (const double sum : {fine, coarse, dense}) EXPECT_NEAR(sum, 1, 1e-13) << cell;
  }
  EXPECT_EQ(effort_of(description).dense_points, 5);
  description.rays = 4e6;
  EXPECT_EQ(effort_of(description).dense_points, 8);
  description.rays = 6e4;  // not two more than the coarse ones: none
  EXPECT_EQ(effort_of(description).dense_points, 0);
}

}  // namespace
}  // namespace grimaldi
