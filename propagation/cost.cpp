#include "propagation/cost.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "propagation/coverage_grid.h"
#include "propagation/grow.h"
#include "propagation/run_sample.h"

namespace grimaldi {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double first_share = 1.0 / 1024;
constexpr double second_share = 0.02, second_seconds = 4;  ///< of the run's time, whichever is less
constexpr double fewest_cells = 80;                        ///< of a sample, if the map has them
constexpr double fewest_beams = 1600, most_first_beams = 30000;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::uint64_t memory_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

/// Bytes of the map's arrays.
double map_bytes(const Plan& plan) {
  const double transmitters = double(plan.request.transmitters.size()), bands = double(plan.bands());
  return double(sizeof(double)) * double(plan.grid.size()) *
         (transmitters * (bands * (5 + mechanism_count) + edge_model_count + 1) + 1);
}

/// The share of the beams and of the cells nearest to `share` that leaves enough of both, and no more than
/// `most_beams`.
RunSample sample_for(const Plan& plan, double share, double most_beams) {
  const double cells = double(plan.grid.size());
  RunSample sample;
  const double beams = std::min(std::max(share * plan.request.rays, fewest_beams), most_beams);
  sample.stride = static_cast<std::uint64_t>(std::max(1.0, std::round(plan.request.rays / beams)));
  sample.block = static_cast<std::size_t>(
      std::max(1.0, std::floor(std::min(std::sqrt(1 / share), std::sqrt(cells / fewest_cells)))));
  return sample;
}

SampleCost run_sample(const Scene& scene, const Tracer& tracer, const Plan& plan, const CoverageGrid& grid,
                      double outdoors, double share, double most_beams, const std::atomic<bool>* stop) {
  const RunSample sample = sample_for(plan, share, most_beams);
  SampleCost cost;
  const CoverageGrid cells = sample_of(grid, sample.block, plan.request.seed);
  const auto asked =
      double(std::count_if(cells.ranges.begin(), cells.ranges.end(), [](const auto& r) { return r.count > 0; }));
  cost.beam_share = 1 / double(sample.stride);
  cost.cell_share = std::clamp(asked / std::max(outdoors, 1.0), 1 / std::max(outdoors, 1.0), 1.0);
  cost.figures = simulate_sample(scene, tracer, plan, cells, sample.stride, stop);
  cost.depth = plan.request.depth;
  return cost;
}

}  // namespace

Prediction scaled_up(const SampleCost& sample) {
  const double f = sample.beam_share, c = sample.cell_share;
  const RunFigures& run = sample.figures;
  const double more_growth = sample.depth == 1 ? 0.2 : sample.depth == 2 ? 0.07 : 0.02;
  const double more_paths = sample.depth == 1 ? 0.3 : sample.depth == 2 ? 0.2 : 0.15;
  const double beams = 1 / f, growth = std::pow(c, -0.6) * std::pow(f, -0.4 - more_growth),
               paths = std::pow(f, -more_paths) / c;
  Prediction whole;
  // What the transmitter sees is looked for once.
  const double view = std::min(run.view_seconds, run.discover_cpu_seconds);
  whole.cpu_seconds = view + beams * (run.discover_cpu_seconds - view) + growth * run.grow_cpu_seconds +
                      paths * run.evaluate_cpu_seconds;
  const double cpu = run.discover_cpu_seconds + run.grow_cpu_seconds + run.evaluate_cpu_seconds;
  const double wall = run.discover_seconds + run.grow_seconds + run.evaluate_seconds;
  whole.seconds = cpu > 0 ? whole.cpu_seconds * wall / cpu : 0;
  // Beams name cells anew all the time until 8 million are united (`discover`).
  const double pairs = std::pow(f, -0.4) / c * double(run.sequence_cell_pairs);
  const double sequences = std::pow(f, -0.75) * double(run.sequences);
  const double seeds = std::pow(f, -0.6) * std::pow(c, -0.45) * double(run.seeds);
  const double named = std::min(1e7, beams * double(run.segments) / 2);
  whole.memory_bytes = static_cast<std::uint64_t>(2 * double(sizeof(Pair)) * pairs + 80 * sequences +
                                                  double(sizeof(Seed)) * std::max(2 * seeds, named));
  return whole;
}

std::optional<Prediction> predict_cost(const Scene& scene, const Tracer& tracer, const Plan& plan, double least_seconds,
                                       const std::atomic<bool>* stop) {
  if (!plan.request.coverage) return std::nullopt;
  const Clock::time_point start = Clock::now();
  const std::uint64_t memory_before = memory_so_far();
  const std::clock_t cpu_start = std::clock();
  Plan map = plan;
  map.request.receivers.clear();
  const CoverageGrid grid = make_coverage_grid(scene, map);
  const double fixed = seconds_since(start), fixed_cpu = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const std::uint64_t memory = std::max(memory_before, memory_so_far());
  const auto outdoors =
      double(std::count_if(grid.ranges.begin(), grid.ranges.end(), [](const auto& r) { return r.count > 0; }));
  const auto predict = [&](double share, double most_beams) {
    Prediction found = scaled_up(run_sample(scene, tracer, map, grid, outdoors, share, most_beams, stop));
    found.seconds += fixed;
    found.cpu_seconds += fixed_cpu;
    found.memory_bytes += memory + static_cast<std::uint64_t>(map_bytes(plan));
    return found;
  };
  Prediction told = predict(first_share, most_first_beams);
  if (told.seconds < least_seconds) return std::nullopt;
  const double share = std::min(second_share, second_seconds / told.seconds);
  if (share > first_share && !(stop && *stop)) told = predict(share, plan.request.rays);
  if (stop && *stop) return std::nullopt;
  told.pilot_seconds = seconds_since(start);
  return told;
}

}  // namespace grimaldi
