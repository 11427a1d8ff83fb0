// The stated error of a map against a converged run.

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

Result run_of(const Scene& scene, bool diffraction, double rays, std::uint64_t seed) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, demo_city_rooftop);
  plan.coverage = CoverageRequest{1.5, 5, std::array<double, 4>{-150, -150, 150, 150}, Polarisation::both};
  plan.depth = 2;
  plan.diffraction = diffraction;
  plan.rays = rays;
  plan.seed = seed;
  return test::run(scene, plan);
}

struct Deviation {
  std::size_t cells = 0, honest = 0, empty = 0, wrong = 0;  ///< wrong: off by more than 0.1 dB, or empty
  double median = 0, typical = 0;  ///< dB, of the cells that both reach; typical: what 68 % of them stay within
};

/// Cells above −150 dB in the converged run.
Deviation deviation(const CoverageMap& map, const CoverageMap& converged) {
  Deviation d;
  std::vector<double> off;
  for (std::size_t i = 0; i < map.path_gain.size(); ++i) {
    const double truth = converged.path_gain[i], gain = map.path_gain[i];
    if (!(truth > 1e-15)) continue;
    ++d.cells;
    // Free space alone has no sampling error; two quadratures of it differ by 1e-6.
    d.honest += std::abs(gain - truth) < 2 * map.standard_error[i] + map.bias[i] + 1e-6 * truth;
    if (gain > 0)
      off.push_back(std::abs(test::decibel(gain / truth)));
    else
      ++d.empty;
    d.wrong += std::abs(gain / truth - 1) > 0.0233;  // 0.1 dB
  }
  std::sort(off.begin(), off.end());
  d.median = off[off.size() / 2];
  d.typical = off[off.size() * 68 / 100];
  return d;
}

/// Runs of 62,500, 250,000, 1,000,000 and 4,000,000 rays against one of `converged` rays and another seed.
std::vector<Deviation> deviations(bool diffraction, double converged) {
  const Scene scene = test::built_in("demo-city");
  const Result truth = run_of(scene, diffraction, converged, 2);
  std::vector<Deviation> found;
  for (const double rays : {6.25e4, 2.5e5, 1e6, 4e6}) {
    const Result result = run_of(scene, diffraction, rays, 1);
    const Deviation d = deviation(*result.coverage, *truth.coverage);
    std::printf(
        "%.3g rays: %zu cells, %.1f %% within 2 standard errors + bias, %zu empty, %zu wrong; off by %.4f dB (median), "
        "%.4f (68 "
        "%%); "
        "%.1f s\n",
        rays, d.cells, 100 * double(d.honest) / double(d.cells), d.empty, d.wrong, d.median, d.typical,
        result.figures.trace_seconds);
    found.push_back(d);
  }
  return found;
}

double honest_share(const Deviation& d) { return double(d.honest) / double(d.cells); }

// What is promised: 90 % of the cells above −150 dB, for the default budget. With fewer rays the 16 passes miss the
// same weak sequences together, which no jackknife tells: a tenth of the cells is granted to that at a quarter of the
// rays. The error of the converged run is left out of the bound, which makes the test harder.
TEST(StandardErrorSlow, CoversWhatReflectionMisses) {
  const auto found = deviations(false, 1.6e7);
  EXPECT_GE(honest_share(found[2]), 0.9);
  EXPECT_GE(honest_share(found[1]), 0.8);
  // More rays find more: 16 times the rays leave a quarter of the empty cells (one over the root), and half is granted
  // to chance: they are a few. What a crossed cell owes to the draw of its points does not depend on the rays.
  EXPECT_LE(double(found[2].empty), 0.5 * double(found[0].empty));
  EXPECT_LE(found[2].wrong, found[0].wrong);
}

TEST(StandardErrorSlow, CoversWhatDiffractionMisses) {
  const auto found = deviations(true, 1.6e7);
  EXPECT_GE(honest_share(found[2]), 0.9);
  EXPECT_GE(honest_share(found[1]), 0.8);
  // 64 times the rays leave an eighth of the error, of which the converged run's own, half of the last one's by the
  // same law, hides a little. On the way it falls unevenly: pairs of edges and faces are asked by name from 1.25e5 rays
  // on, and the points of a cell are whole numbers.
  EXPECT_LE(found[3].typical, found[0].typical / 7);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].typical, found[i - 1].typical / 1.25);
  EXPECT_LT(found[2].wrong, found[0].wrong);
  EXPECT_LE(found[2].empty, found[0].empty);
}

}  // namespace
}  // namespace grimaldi
