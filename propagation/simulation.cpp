#include "propagation/simulation.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "core/blocks.h"
#include "propagation/bounded_waves.h"
#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/effort.h"
#include "propagation/evaluate.h"
#include "propagation/grow.h"
#include "propagation/look_back.h"
#include "propagation/path_search.h"
#include "propagation/power_delay_profile.h"
#include "propagation/refine.h"
#include "propagation/run_sample.h"

namespace grimaldi {
namespace {

/// Adds the wall time of its life to a figure, and the processors' time to another if that is given.
class StageClock {
 public:
  explicit StageClock(double& seconds, double* cpu_seconds = nullptr)
      : seconds_(seconds),
        cpu_seconds_(cpu_seconds),
        start_(std::chrono::steady_clock::now()),
        cpu_start_(std::clock()) {}
  ~StageClock() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (cpu_seconds_ != nullptr) *cpu_seconds_ += double(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  double& seconds_;
  double* cpu_seconds_;
  std::chrono::steady_clock::time_point start_;
  std::clock_t cpu_start_;
};

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// A search for paths, and the growth of what it finds over the map.
struct Round {
  int fewest_edges, most_edges;
  bool pairs;   ///< by name, else by launched beams
  double size;  ///< share of the work
};

/// Paths of at most one edge first; then, where it is known what they bring, pairs of edges and faces asked by name,
/// and paths of more edges. What stands in the way of a path is gone around by one more edge.
std::vector<Round> rounds_of(const Plan& plan) {
  const int most = most_edges(plan.request);
  if (!plan.request.coverage || most == 0) return {{0, most, false, 0.8}};
  std::vector<Round> rounds = {{0, 1, false, 0.3}};
  if (plan.request.depth > 1) rounds.push_back({1, 1, true, 0.1});
  if (most > 1) rounds.push_back({2, most, false, 0.4});
  return rounds;
}

/// Shares of what was launched, from sums over beams.
void add_flux(FluxLedger& ledger, const FluxLedger& sums, double share) {
  if (sums.launched == 0) return;
  ledger.launched += share;
  ledger.absorbed += share * sums.absorbed / sums.launched;
  ledger.escaped += share * sums.escaped / sums.launched;
  ledger.cut_by_depth += share * sums.cut_by_depth / sums.launched;
}

/// The plan with its rays divided by `stride`.
Plan thinned(Plan plan, std::uint64_t stride) {
  plan.request.rays = std::max(1.0, plan.request.rays / double(stride));
  return plan;
}

/// A run of one beam in `stride` of each pass, to the cells of `ready` or, if that is null, of the plan.
Result run(const Scene& scene, const Tracer& tracer, const Plan& asked, const CoverageGrid* ready, std::uint64_t stride,
           const ProgressReport& progress, const std::atomic<bool>* stop) {
  // The published BSDF has no closed form at a point: its layer is sampled, and what is connected goes without edges.
  const bool sampled = asked.request.diffraction && asked.request.diffraction_model == DiffractionModel::fsd_published;
  Plan connected = asked;
  if (sampled) connected.request.diffraction = false;
  const Plan& plan = connected;
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
      grid = ready ? *ready : make_coverage_grid(scene, plan);
      connected.grid = grid.layout;
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
      Grown grown;
      double done = 0;
      for (const Round& round : rounds_of(plan)) {
        if (stopped()) break;
        const double from = done, middle = done + 0.5 * round.size;
        done += round.size;
        std::size_t first_seed = 0;
        {
          const StageClock stage(figures.discover_seconds, &figures.discover_cpu_seconds);
          Search wanted;
          wanted.fewest_edges = round.fewest_edges;
          wanted.most_edges = round.most_edges;
          wanted.stride = stride;
          const double share = effort_of(plan.request).negligible_share;
          for (const double power : grown.known) wanted.negligible.push_back(share * power);
          const auto telling = report("discover", from, middle);
          auto found = round.pairs ? discover_pairs(scene, tracer, plan, t, wanted, telling, stop)
                                   : discover(scene, tracer, plan, t, wanted, telling, stop);
          if (from == 0)
            discovered = std::move(found);
          else
            first_seed = discovered.append(found);
        }
        if (!plan.request.coverage || stopped()) continue;
        const StageClock stage(figures.grow_seconds, &figures.grow_cpu_seconds);
        if (from == 0) look_back(scene, tracer, plan, t, grid, BackwardBeams::upward, discovered, stop, stride);
        grow_and_lead_around(scene, tracer, plan, t, grid, effort_of(plan.request), first_seed,
                             std::min(round.most_edges, most_edges(plan.request)), discovered, grown,
                             report("grow", middle, done), stop);
      }
      if (plan.request.coverage && !stopped()) {
        const StageClock stage(figures.grow_seconds, &figures.grow_cpu_seconds);
        refine(scene, tracer, plan, t, grid, discovered, grown, stop);
        add_bounded_waves(scene, tracer, plan, t, grid, discovered, grown, stop);
      }
      figures.merge_seconds += discovered.merge_seconds;
      figures.view_seconds += discovered.view_seconds;
      figures.rays += discovered.rays;
      figures.segments += discovered.segments;
      figures.sequences += discovered.sequences.size();
      figures.shadow_rays += grown.shadow_rays + discovered.shadow_rays;
      figures.sequence_cell_pairs += grown.pairs.size();
      figures.seeds += discovered.seeds.size();
      add_flux(figures.flux, discovered.flux, 1 / double(transmitters));
      if (plan.request.coverage && !stopped()) {
        const StageClock stage(figures.evaluate_seconds, &figures.evaluate_cpu_seconds);
        evaluate(scene, tracer, plan, t, grid, discovered, grown.pairs, *result.coverage, report("evaluate", 0.8, 1),
                 stop);
        if (sampled && !stopped()) {
          Plan fewer = thinned(asked, stride);
          fewer.grid = grid.layout;
          add_sampled_diffraction(scene, tracer, fewer, t, grid, *result.coverage, stop);
          figures.rays += static_cast<std::uint64_t>(fewer.request.rays);
        }
      }
      if (!plan.request.receivers.empty() && !stopped()) {
        const StageClock stage(figures.evaluate_seconds, &figures.evaluate_cpu_seconds);
        figures.shadow_rays +=
            connect_receivers(scene, tracer, thinned(plan, stride), t, discovered.sequences, result.profiles, stop);
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

}  // namespace

Result simulate(const Scene& scene, const Tracer& tracer, const Plan& plan, const ProgressReport& progress,
                const std::atomic<bool>* stop) {
  return run(scene, tracer, plan, nullptr, 1, progress, stop);
}

RunFigures simulate_sample(const Scene& scene, const Tracer& tracer, const Plan& plan, const CoverageGrid& cells,
                           std::uint64_t stride, const std::atomic<bool>* stop) {
  return run(scene, tracer, plan, &cells, stride, {}, stop).figures;
}

}  // namespace grimaldi
