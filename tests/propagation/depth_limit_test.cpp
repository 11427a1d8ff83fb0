// Edges beside a path as deep as the plan allows: what lies beyond the depth, estimated.

#include "propagation/depth_limit.h"

#include <cmath>

#include "core/constants.h"
#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

constexpr double frequency = 1e9;

/// A metal ground and a screen that hangs over it, its lower rim at that height.
Scene ground_and_screen(double rim) {
  MeshDescription ground = solids::empty_mesh("metal"), screen = solids::empty_mesh("metal");
  solids::add_quad(ground, {-1000, -1000, 0}, {1000, -1000, 0}, {1000, 1000, 0}, {-1000, 1000, 0});
  solids::add_quad(screen, {0, -500, rim}, {0, 500, rim}, {0, 500, 1000}, {0, -500, 1000});
  ground.artificial_edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  screen.artificial_edges = {{1, 2}, {2, 3}, {0, 3}};
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({ground, screen}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

/// Level of all that arrives, dB over free space: at depth 1, and that completed; at depth 2.
struct Levels {
  double one, completed, two;
};

Levels levels(const Scene& scene) {
  const Vec3 source{-60, 0, 5}, receiver{40, 0, 10};
  PlanDescription plan = test::plan_for(WaveKind::radio, frequency, source);
  plan.rays = 1e4;
  plan.diffraction_model = DiffractionModel::utd;
  plan.receivers = {test::receiver_at(receiver)};
  const double wavelength = 299792458.0 / frequency, length = distance(source, receiver);
  const auto level = [&](double gain) { return test::decibel(gain / std::pow(wavelength / (4 * pi * length), 2)); };
  plan.depth = 1;
  const Result one = test::run(scene, plan);
  plan.depth = 2;
  const Result two = test::run(scene, plan);
  return {level(one.profiles[0].total_coherent[0]), level(one.profiles[0].total_completed[0]),
          level(two.profiles[0].total_coherent[0])};
}

// The screen hides the receiver but for what the ground reflects, which passes the rim (it crosses the screen's plane
// at 4 m, r_F = 2.7 m) within its transition region: its edge's wave is a path of depth 2. The estimate is one edge on
// the unfolded leg, so it differs from that wave by the images in the screen; and what is not beside an edge, the wave
// from the rim to the ground, is missing in it (30 dB below: 0.3 dB).
TEST(DepthLimit, TheTotalOfDepthOneCompletedIsThatOfDepthTwo) {
  for (const double beyond : {0.02, 0.3, 1.0, 2.0}) {
    const Levels at = levels(ground_and_screen(4 + beyond));
    EXPECT_NEAR(at.completed, at.two, 0.7) << beyond;
    EXPECT_LT(std::abs(at.completed - at.two), std::abs(at.one - at.two)) << beyond;
    if (beyond < 0.1) {
      EXPECT_GT(at.one - at.two, 2) << beyond;
    }
  }
}

}  // namespace
}  // namespace grimaldi
