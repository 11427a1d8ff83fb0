// The stated error of a map against a converged run.

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

Result run_of(const Scene& scene, double rays, std::uint64_t seed) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, demo_city_rooftop);
  plan.coverage = CoverageRequest{1.5, 5, std::array<double, 4>{-150, -150, 150, 150}, Polarisation::both};
  plan.depth = 2;
  plan.rays = rays;
  plan.seed = seed;
  return test::run(scene, plan);
}

struct Deviation {
  std::size_t cells = 0, honest = 0, empty = 0;
  double rms = 0, median = 0,
         typical = 0;  ///< dB; of the cells that both reach; typical: within which 68 % of them lie
};

/// Cells above −150 dB in the converged run.
Deviation deviation(const CoverageMap& map, const CoverageMap& converged) {
  Deviation d;
  std::vector<double> off;
  for (std::size_t i = 0; i < map.path_gain.size(); ++i) {
    const double truth = converged.path_gain[i], gain = map.path_gain[i];
    if (!(truth > 1e-15)) continue;
    ++d.cells;
    d.honest += std::abs(gain - truth) < 2 * map.standard_error[i] + map.bias[i];
    if (gain > 0)
      off.push_back(std::abs(test::decibel(gain / truth)));
    else
      ++d.empty;
  }
  std::sort(off.begin(), off.end());
  for (const double x : off) d.rms += x * x / double(off.size());
  d.rms = std::sqrt(d.rms);
  d.median = off[off.size() / 2];
  d.typical = off[off.size() * 68 / 100];
  return d;
}

// The converged run has 16 times the rays and another seed. Its own error, a quarter, is left out of the bound: it
// makes the test harder.
TEST(StandardErrorSlow, CoversTheDifferenceAndFalls) {
  const Scene scene = test::built_in("demo-city");
  const double budgets[] = {6.25e4, 2.5e5, 1e6};
  const Result converged = run_of(scene, 4e6, 2);
  std::vector<Deviation> found;
  for (const double rays : budgets) {
    const Result result = run_of(scene, rays, 1);
    const Deviation d = deviation(*result.coverage, *converged.coverage);
    found.push_back(d);
    std::printf(
        "%.3g rays: %zu cells, %.1f %% within 2 standard errors + bias, %zu empty; off by %.3f dB (rms), %.3f (68 %%), "
        "%.3f (median); %.1f s\n",
        rays, d.cells, 100 * double(d.honest) / double(d.cells), d.empty, d.rms, d.typical, d.median,
        result.figures.trace_seconds);
    EXPECT_GE(double(d.honest), 0.9 * double(d.cells)) << rays;
  }
  for (std::size_t i = 1; i < found.size(); ++i) {
    std::printf("rays × 4: rms error ÷ %.2f, 68 %% ÷ %.2f\n", found[i - 1].rms / found[i].rms,
                found[i - 1].typical / found[i].typical);
  }
}

}  // namespace
}  // namespace grimaldi
