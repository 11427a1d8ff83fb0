// A small mirror far away: its reflection and the waves of its four edges all but cancel.

#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

constexpr double half_side = 0.25, away = 400, frequency = 3.5e9;

/// A square mirror that sends what comes from the transmitter to the receiver.
const Vec3 transmitter{0, -300, 2}, receiver{0, 300, 2};
Scene far_mirror() {
  MeshDescription mirror = solids::empty_mesh("metal");
  const Vec3 across{0, half_side, 0}, up{0, 0, half_side}, middle{away, 0, 2};
  solids::add_quad(mirror, middle - across - up, middle + across - up, middle + across + up, middle - across + up);
  // A screen hides the ends from each other.
  MeshDescription screen = solids::empty_mesh("metal");
  solids::add_quad(screen, {-1000, 0, -1000}, {50, 0, -1000}, {50, 0, 1000}, {-1000, 0, 1000});
  screen.artificial_edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({mirror, screen}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

// A plate of area A sends |h|² = (λ/4π)² (A cos θ/λ s s')², s = s' = 500 m and cos θ = 0.8 here; its own edges alone
// bring (λ/4π)²/(s + s')² and more, 34 dB above. The mirror fills 2e-7 of the sphere: 1e4 beams miss it.
TEST(BoundedWaves, TheMirrorIsAskedForWhereItsEdgesArrive) {
  PlanDescription plan = test::plan_for(WaveKind::radio, frequency, transmitter);
  plan.depth = 1;
  plan.rays = 1e4;
  plan.diffraction_model = DiffractionModel::utd;
  plan.receivers = {test::receiver_at(receiver)};
  const Result result = test::run(far_mirror(), plan);
  const double wavelength = 299792458.0 / frequency, s = std::hypot(away, 300.0);
  const double plate = wavelength / (4 * pi) * 4 * half_side * half_side * (away / s) / (wavelength * s * s);
  const auto& paths = result.profiles[0].paths[0];
  EXPECT_TRUE(std::any_of(paths.begin(), paths.end(), [](const PathStory& p) { return p.interactions == "R:metal"; }));
  // UTD's edges cancel to the digits of their theory, not to Kirchhoff's plate: 20 of the 34 dB are asked.
  EXPECT_LT(test::decibel(result.profiles[0].total[0] / (plate * plate)), 14);
}

}  // namespace
}  // namespace grimaldi
