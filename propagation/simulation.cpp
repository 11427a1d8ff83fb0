#include "propagation/simulation.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "core/blocks.h"
#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/evaluate.h"
#include "propagation/grow.h"
#include "propagation/power_delay_profile.h"

namespace grimaldi {
namespace {

/// Adds the wall time of its life to a figure.
class StageClock {
 public:
  explicit StageClock(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~StageClock() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Shares of what was launched, from sums over beams.
void add_flux(FluxLedger& ledger, const FluxLedger& sums, double share) {
  if (sums.launched == 0) return;
  ledger.launched += share;
  ledger.absorbed += share * sums.absorbed / sums.launched;
  ledger.escaped += share * sums.escaped / sums.launched;
  ledger.cut_by_depth += share * sums.cut_by_depth / sums.launched;
}

}  // namespace

Result simulate(const Scene& scene, const Tracer& tracer, const Plan& plan, const ProgressReport& progress,
                const std::atomic<bool>* stop) {
  Result result;
  RunFigures& figures = result.figures;
  figures.threads = plan.request.threads ? plan.request.threads : hardware_threads();
  figures.passes = plan.request.passes;
  const std::size_t transmitters = plan.request.transmitters.size();
  const auto stopped = [&] { return stop && *stop; };
  {
    const StageClock clock(figures.trace_seconds);
    CoverageGrid grid;
    if (plan.request.coverage) {
      const StageClock grid_clock(figures.grow_seconds);
      grid = make_coverage_grid(scene, tracer, plan);
      result.coverage = empty_map(plan, grid);
    }
    result.profiles = empty_profiles(plan);
    for (std::size_t t = 0; t < transmitters && !stopped(); ++t) {
      const auto report = [&](const char* stage, double from, double to) {
        return [&, stage, from, to](double share) {
          if (progress) progress(stage, (double(t) + from + (to - from) * share) / double(transmitters));
        };
      };
      Discovered discovered;
      {
        const StageClock stage(figures.discover_seconds);
        discovered = discover(scene, tracer, plan, t, report("discover", 0, 0.4), stop);
      }
      figures.merge_seconds += discovered.merge_seconds;
      figures.rays += discovered.rays;
      figures.segments += discovered.segments;
      figures.sequences += discovered.sequences.size();
      add_flux(figures.flux, discovered.flux, 1 / double(transmitters));
      if (plan.request.coverage && !stopped()) {
        Grown grown;
        {
          const StageClock stage(figures.grow_seconds);
          grown = grow(scene, tracer, plan, t, grid, discovered, report("grow", 0.4, 0.8), stop);
        }
        figures.shadow_rays += grown.shadow_rays;
        figures.sequence_cell_pairs += grown.pairs.size();
        const StageClock stage(figures.evaluate_seconds);
        evaluate(scene, plan, t, grid, discovered, grown.pairs, *result.coverage, report("evaluate", 0.8, 1), stop);
      }
      if (!plan.request.receivers.empty() && !stopped()) {
        const StageClock stage(figures.evaluate_seconds);
        figures.shadow_rays += connect_receivers(scene, tracer, plan, t, discovered, result.profiles, stop);
      }
    }
  }
  if (stopped()) {
    result.interrupted = true;
    result.coverage.reset();
    result.profiles.clear();
    return result;
  }
  fill_bins(plan, result.profiles, result.warnings);
  figures.peak_memory_bytes = peak_memory();
  figures.cpu_seconds = double(std::clock()) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace grimaldi
