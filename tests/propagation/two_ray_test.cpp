// A flat ground: direct and reflected wave as fields, against the exact two-ray model.

#include <cmath>
#include <complex>
#include <limits>

#include "core/constants.h"
#include "scenes/shapes.h"
#include "tests/core/reference_rows.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

/// The grounds of the file: half-spaces of P.2040-3, and a perfect conductor.
Material ground_material(const std::string& name) {
  Material material;
  if (name == "pec") {
    // |R_TM| departs from 1 by 2/(√|η| cos θ): 1e-9 at the grazing angles of the file.
    material.permittivity = Spectrum{{1e9}, {1}};
    material.conductivity = Spectrum{{1e9}, {1e26}};
  } else {
    material = built_in_materials().at(name == "medium_dry-3" ? "medium_dry_ground" : "concrete");
  }
  material.thickness = std::numeric_limits<double>::infinity();
  return material;
}

Scene flat_ground(const Material& material, double half) {
  SceneDescription description;
  description.name = "plane";
  description.meshes = {ground_sheet({-half, -half}, {half, half}, "ground")};
  MaterialChoice choice;
  choice.overrides = {{"ground", material}};
  Diagnostics diagnostics;
  Scene scene = build_scene(description, choice, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

// total_coherent of a receiver is |H|². The file is good to 1e-6 dB and H to 1e-8; phases of k r = 6e5 rad leave 1e-10
// of H, the conductor that stands for a perfect one 1e-9 of a wave, which a null (down to −30 dB of the direct wave)
// raises to 1e-7.
TEST(TwoRay, CoherentTotalAgainstReference) {
  const auto rows = reference_rows("radio/two_ray.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/two_ray.csv";
  double worst = 0, worst_field = 0;
  for (const auto& row : rows) {
    const double frequency = std::stod(row[1]) * 1e9, up = std::stod(row[2]), down = std::stod(row[3]),
                 far = std::stod(row[4]);
    const Scene scene = flat_ground(ground_material(row[5]), std::max(far, 50.0));
    for (const bool vertical : {false, true}) {
      const auto polarisation = vertical ? Polarisation::vertical : Polarisation::horizontal;
      PlanDescription plan = test::plan_for(WaveKind::radio, frequency, {-far / 2, 0.3, up});
      plan.transmitters[0].antenna.polarisation = polarisation;
      plan.receivers = {test::receiver_at({far / 2, 0.3, down}, polarisation)};
      plan.depth = 1;
      plan.rays = 1e4;
      const Result result = test::run(scene, plan);
      const ReceiverProfile& profile = result.profiles[0];
      const std::size_t column = vertical ? 9 : 7;
      const std::complex<double> exact(std::stod(row[column]), std::stod(row[column + 1]));
      const double loss = -test::decibel(profile.total_coherent[0]), expected = std::stod(row[vertical ? 12 : 11]);
      EXPECT_NEAR(loss, expected, 1e-5) << row[0] << (vertical ? " V" : " H");
      worst = std::max(worst, std::abs(loss - expected));
      ASSERT_EQ(profile.paths[0].size(), 2u) << row[0];
      std::complex<double> field = 0;
      // The receiver's frame is that of the direction in which it looks: its azimuth points against the transmitter's.
      for (const PathStory& path : profile.paths[0]) field += vertical ? path.amplitude[0] : -path.amplitude[1];
      // Of the direct wave's size: H itself may be a null.
      const double size = std::abs(profile.paths[0][0].amplitude[vertical ? 0 : 1]);
      EXPECT_LT(std::abs(field - exact), 2e-8 * size) << row[0] << (vertical ? " V" : " H");
      worst_field = std::max(worst_field, std::abs(field - exact) / size);
      // Nothing here interferes in a map: the power sum is that of the two waves.
      double power = 0;
      for (const PathStory& path : profile.paths[0]) power += std::norm(path.amplitude[vertical ? 0 : 1]);
      EXPECT_NEAR(profile.total[0] / power, 1, 1e-12) << row[0];
    }
  }
  std::printf("two rays: %zu rows, H and V: loss within %.1e dB, field within %.1e of the direct wave\n", rows.size(),
              worst, worst_field);
}

// Without the file: a perfect conductor doubles the vertical field at grazing and far away, and cancels the horizontal
// one.
TEST(TwoRay, GrazingOverAConductor) {
  const Scene scene = flat_ground(ground_material("pec"), 1000);
  for (const bool vertical : {false, true}) {
    const auto polarisation = vertical ? Polarisation::vertical : Polarisation::horizontal;
    PlanDescription plan = test::plan_for(WaveKind::radio, 1e8, {-500, 0.3, 0.5});
    plan.transmitters[0].antenna.polarisation = polarisation;
    plan.receivers = {test::receiver_at({500, 0.3, 0.5}, polarisation)};
    plan.depth = 1;
    plan.rays = 1e4;
    const double gain = test::run(scene, plan).profiles[0].total_coherent[0];
    const double free_space = std::pow(299792458.0 / 1e8 / (4 * pi * 1000), 2);
    // Path difference 2 h²/d = 0.5 mm: a phase of 1.05e-3 rad. V: 4 cos²(half of it); H: 4 sin².
    if (vertical)
      EXPECT_NEAR(gain / free_space, 4, 1e-5);
    else
      EXPECT_NEAR(gain / free_space, std::pow(2 * pi / 2.99792458 * 5e-4, 2), 1e-3 * 1.1e-6);
  }
}

}  // namespace
}  // namespace grimaldi
