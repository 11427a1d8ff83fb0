// A map of the direct wave alone: free space where it is lit, nothing where it is not.

#include <cmath>

#include "core/constants.h"
#include "propagation/antenna.h"
#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

constexpr double frequency = 3.5e9, cell = 5;
constexpr int raster = 20, fine = 80;  ///< points a side that are asked for sight; of the quadrature

double gain_at(const Transmitter& transmitter, const Vec3& point) {
  const Vec3 way = point - transmitter.position;
  const double r = norm(way);
  return norm2(radiated_field(transmitter.antenna, way / r)) * std::pow(speed_of_light / frequency / (4 * pi * r), 2);
}

class DirectWave : public testing::TestWithParam<Transmitter> {};

// A lit cell holds the mean of (λ/4πd)² G over it. The program promises 0.1 %; the quadrature here (80 × 80 midpoints)
// errs by some (cell/(80 d))² = 5e-5 at the least distance of 8.5 m.
TEST_P(DirectWave, LitCellsHoldTheirMean) {
  const Scene scene = test::built_in("demo-city");
  const Tracer tracer(scene);
  PlanDescription plan = test::plan_for(WaveKind::radio, frequency, {});
  plan.transmitters = {GetParam()};
  plan.reflection = plan.diffraction = false;
  plan.depth = 0;
  plan.coverage = CoverageRequest{1.5, cell, std::array<double, 4>{-200, -200, 200, 200}, Polarisation::both};
  const Result result = test::run(scene, plan);
  const CoverageMap& map = *result.coverage;
  int lit = 0, dark = 0;
  double worst = 0, worst_centre = 0;
  for (std::size_t i = 0; i < map.path_gain.size(); ++i) {
    if (map.inside_fraction[i] > 0) continue;
    const Vec3 corner{-200 + double(i % 80) * cell, -200 + double(i / 80) * cell, 1.5};
    double mean = 0;
    int seen = 0;
    for (int j = 0; j < raster * raster; ++j) {
      const Vec3 point = corner + cell / raster * Vec3{j % raster + 0.5, j / raster + 0.5, 0};
      seen += tracer.visible(GetParam().position, point);
    }
    if (seen == 0 && map.path_gain[i] == 0) ++dark;
    if (seen < raster * raster) continue;
    // A sliver of shadow that falls between the raster's points would tell itself by a standard error.
    if (map.standard_error[i] > 0) continue;
    ++lit;
    for (int j = 0; j < fine * fine; ++j)
      mean += gain_at(GetParam(), corner + cell / fine * Vec3{j % fine + 0.5, j / fine + 0.5, 0}) / (fine * fine);
    worst = std::max(worst, std::abs(map.path_gain[i] / mean - 1));
    worst_centre =
        std::max(worst_centre, std::abs(gain_at(GetParam(), corner + Vec3{cell / 2, cell / 2, 0}) / mean - 1));
    EXPECT_NEAR(map.path_gain[i] / mean, 1, 1e-3) << corner.x << " " << corner.y;
    EXPECT_EQ(map.mechanism_gain[i], map.path_gain[i]);
  }
  std::printf("%s: %d lit cells, largest deviation %.2e (of the value at the centre: %.2e); %d dark\n",
              GetParam().name.c_str(), lit, worst, worst_centre, dark);
  EXPECT_GT(lit, 300);
  EXPECT_GT(dark, 100);
}

INSTANTIATE_TEST_SUITE_P(
    Engine, DirectWave,
    testing::Values(
        Transmitter{"rooftop", demo_city_rooftop, {0.0}, {}}, Transmitter{"mast", demo_city_mast, {0.0}, {}},
        Transmitter{"dipole", demo_city_mast, {0.0}, {AntennaPattern::dipole, Polarisation::vertical, 40, 15}},
        Transmitter{"lying_dipole", demo_city_mast, {0.0}, {AntennaPattern::dipole, Polarisation::horizontal, 40, 0}}),
    [](const auto& p) { return p.param.name; });

// No pixel of a cell wholly inside, and none of the layers but the direct one.
TEST(DirectWaveMap, NothingElseIsThere) {
  const Scene scene = test::built_in("demo-city");
  PlanDescription plan = test::plan_for(WaveKind::radio, frequency, demo_city_mast);
  plan.reflection = plan.diffraction = false;
  plan.coverage = CoverageRequest{1.5, cell, std::array<double, 4>{-100, -100, 100, 100}, Polarisation::both};
  const Result result = test::run(scene, plan);
  const CoverageMap& map = *result.coverage;
  const std::size_t cells = map.path_gain.size();
  for (std::size_t i = 0; i < cells; ++i) {
    EXPECT_EQ(std::isnan(map.path_gain[i]), map.inside_fraction[i] == 1);
    for (std::size_t m = 1; m < mechanism_count && map.inside_fraction[i] < 1; ++m)
      EXPECT_EQ(map.mechanism_gain[m * cells + i], 0);
  }
}

}  // namespace
}  // namespace grimaldi
