// The layers of a map add up to its gain.

#include <cmath>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

class MechanismLayers : public testing::TestWithParam<WaveKind> {};

TEST_P(MechanismLayers, AddUpToTheGain) {
  const Scene scene = test::built_in("demo-city");
  const bool radio = GetParam() == WaveKind::radio;
  PlanDescription plan = test::plan_for(GetParam(), radio ? 3.5e9 : 250, demo_city_rooftop);
  plan.frequency.push_back(radio ? 5.8e9 : 1000);
  plan.transmitters.push_back({"mast", demo_city_mast, {0.0}, {}});
  plan.coverage = CoverageRequest{1.5, 5, std::array<double, 4>{-120, -120, 120, 120}, Polarisation::both};
  plan.depth = 2;
  plan.rays = 5e4;
  const Result result = test::run(scene, plan);
  const CoverageMap& map = *result.coverage;
  const std::size_t cells = map.inside_fraction.size(), bands = 2, transmitters = 2;
  std::array<double, mechanism_count> sums{};
  double worst = 0;
  int negative = 0;
  for (std::size_t t = 0; t < transmitters; ++t)
    for (std::size_t band = 0; band < bands; ++band)
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const double gain = map.path_gain[(t * bands + band) * cells + cell];
        if (std::isnan(gain)) continue;
        double sum = 0, size = 0;
        for (std::size_t m = 0; m < mechanism_count; ++m) {
          const double layer = map.mechanism_gain[((t * mechanism_count + m) * bands + band) * cells + cell];
          sum += layer;
          size += std::abs(layer);
          sums[m] += layer;
          if (m == static_cast<std::size_t>(Mechanism::interference))
            negative += layer < 0;
          else
            ASSERT_GE(layer, 0) << mechanism_names[m] << " in cell " << cell;
        }
        // A power is never negative, whatever interferes; the sum of six terms rounds to a few ulp of the largest.
        EXPECT_GE(gain, 0) << "transmitter " << t << ", band " << band << ", cell " << cell;
        if (size > 0) worst = std::max(worst, std::abs(sum - gain) / size);
        ASSERT_NEAR(sum, gain, 1e-12 * size) << cell;
      }
  std::printf("layers: largest difference %.1e;", worst);
  for (std::size_t m = 0; m < mechanism_count; ++m) std::printf(" %s %.3e", mechanism_names[m], sums[m]);
  std::printf("; interference negative in %d cells\n", negative);
  // The test sees all layers that this run has, with interference of both signs.
  for (const Mechanism m : {Mechanism::direct, Mechanism::reflection, Mechanism::diffraction})
    EXPECT_GT(sums[static_cast<std::size_t>(m)], 0);
  for (const Mechanism m : {Mechanism::transmission, Mechanism::scattering})
    EXPECT_EQ(sums[static_cast<std::size_t>(m)], 0);
  EXPECT_GT(negative, 100);
}

INSTANTIATE_TEST_SUITE_P(Engine, MechanismLayers, testing::Values(WaveKind::radio, WaveKind::acoustic),
                         [](const auto& p) { return p.param == WaveKind::radio ? "radio" : "sound"; });

}  // namespace
}  // namespace grimaldi
