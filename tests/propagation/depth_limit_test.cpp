// Edges beside a path as deep as the plan allows: what lies beyond the depth, estimated.

#include "propagation/depth_limit.h"

#include <cmath>

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

/// Level of what meets the ground first, dB over the free field of the image.
double reflected(const Scene& scene, int depth) {
  const Vec3 source{-60, 0, 5}, receiver{40, 0, 10};
  PlanDescription plan = test::plan_for(WaveKind::radio, frequency, source);
  plan.depth = depth;
  plan.rays = 1e4;
  plan.diffraction_model = DiffractionModel::utd;
  plan.receivers = {test::receiver_at(receiver)};
  const Result result = test::run(scene, plan);
  const double wavelength = 299792458.0 / frequency, length = std::hypot(100.0, 15.0);
  std::complex<double> sum = 0;
  for (const PathStory& path : result.profiles[0].paths[0])
    if (path.interactions.starts_with("R:")) sum += path.amplitude[0];
  return test::decibel(std::norm(sum) / std::pow(wavelength / (4 * pi * length), 2));
}

// At depth 1 the reflection passes the rim (it crosses the screen's plane at 4 m, r_F = 2.7 m) within its transition
// region; its edge's wave is a path of depth 2. The estimate is one edge on the unfolded leg, so it differs from that
// wave by the images in the screen alone.
TEST(DepthLimit, TheReflectionAtDepthOneIsThatOfDepthTwo) {
  for (const double beyond : {0.02, 0.3, 1.0, 2.0}) {
    const Scene scene = ground_and_screen(4 + beyond);
    const double one = reflected(scene, 1), two = reflected(scene, 2);
    EXPECT_NEAR(one, two, 0.5) << beyond;
    if (beyond < 0.1) {
      EXPECT_NEAR(one, -6, 0.5) << beyond;
    }
  }
}

}  // namespace
}  // namespace grimaldi
