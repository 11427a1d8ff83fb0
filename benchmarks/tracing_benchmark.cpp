// The discover stage against bare Embree on the same segments, in the same order, blocks and flags.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "benchmarks/bare_embree.h"
#include "benchmarks/cities.h"
#include "benchmarks/stopwatch.h"
#include "core/blocks.h"
#include "propagation/discover.h"
#include "propagation/launcher.h"

namespace grimaldi {
namespace {

constexpr double rays = 1e6;
/// Launched beams in a block of work: that of discover().
constexpr std::uint64_t beams_per_block = 4096;

/// The segments of a run in the order in which one thread walks them.
struct Record {
  std::vector<BareSegment> segments;
  std::vector<std::size_t> begins = {0};  ///< of the blocks, and one more
  std::size_t hits = 0;
  std::span<const BareSegment> block(std::size_t i) const {
    return {segments.data() + begins[i], segments.data() + begins[i + 1]};
  }
  std::size_t blocks() const { return begins.size() - 1; }
};

/// Walks the beams of discover() without diffraction: reflections at every face up to the depth. A segment that leaves
/// a face starts a surface gap off it, so that bare Embree answers it with one query.
Record recorded(const City& city, const Plan& plan, const BareEmbree& bare) {
  Record record;
  const auto total = static_cast<std::uint64_t>(plan.request.rays), passes = std::uint64_t(plan.request.passes);
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    const std::uint64_t count = (pass + 1) * total / passes - pass * total / passes;
    const Launcher launcher(plan.request.seed, static_cast<std::uint32_t>(pass), count);
    for (std::uint64_t i = 0; i < count; ++i) {
      Vec3 origin = city.transmitter, direction = launcher.direction(i);
      std::uint32_t leave = no_index;
      for (int depth = 0; depth <= plan.request.depth; ++depth) {
        record.segments.push_back(bare.segment(origin, direction, leave == no_index ? 0 : city.tracer->surface_gap()));
        const Hit hit = city.tracer->nearest(origin, direction, leave);
        if (hit.triangle == no_index) break;
        ++record.hits;
        leave = city.scene.patches.triangle_patch[hit.triangle];
        const Vec3& normal = city.scene.patches.patches[leave].normal;
        origin += hit.distance * direction;
        direction = normalized(direction - 2 * dot(normal, direction) * normal);
      }
      if ((i + 1) % beams_per_block == 0 || i + 1 == count) record.begins.push_back(record.segments.size());
    }
  }
  return record;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Arguments: city, threads. Each iteration times both, one after the other, so that what else the machine does meets
/// both alike. `ratio` is discover's time over that of bare Embree, `cpu_ratio` the same of the processors' time, which
/// other programs disturb less; medians over the iterations.
void discover_over_bare_embree(benchmark::State& state) {
  const City* city = city_for(state, state.range(0));
  if (!city) return;
  const auto threads = static_cast<unsigned>(state.range(1));
  const Plan plan = radio_plan(*city, false, rays, threads);
  const BareEmbree bare(city->scene);
  const Record record = recorded(*city, plan, bare);
  // Two surfaces nearer to each other than the gap are met differently: one segment in a thousand at the most.
  const std::size_t tolerance = record.segments.size() / 1000;
  std::vector<double> bare_seconds, discover_seconds, merge_shares, ratios, cpu_ratios;
  for (auto _ : state) {
    std::atomic<std::size_t> hits = 0;
    const Stopwatch bare_watch;
    for_each_block(record.blocks(), threads,
                   [&](std::size_t block, unsigned) { hits += bare.intersect(record.block(block)); });
    bare_seconds.push_back(bare_watch.wall());
    const double bare_processor = bare_watch.processor();
    const Stopwatch discover_watch;
    const Discovered discovered = discover(city->scene, *city->tracer, plan, 0, Search{}, {}, nullptr);
    discover_seconds.push_back(discover_watch.wall());
    cpu_ratios.push_back(discover_watch.processor() / bare_processor);
    ratios.push_back(discover_seconds.back() / bare_seconds.back());
    merge_shares.push_back(discovered.merge_seconds / discover_seconds.back());
    state.SetIterationTime(discover_seconds.back());
    if (discovered.segments != record.segments.size()) {
      state.SkipWithError("the recorded segments are not those of discover()");
      return;
    }
    if (hits + tolerance < record.hits || hits > record.hits + tolerance) {
      state.SkipWithError("bare Embree does not hit what the walk hit");
      return;
    }
  }
  const auto segments = double(record.segments.size());
  state.counters["segments"] = segments;
  state.counters["discover_per_s"] = segments / median(discover_seconds);
  state.counters["bare_per_s"] = segments / median(bare_seconds);
  state.counters["merge_share"] = median(merge_shares);
  state.counters["ratio"] = median(ratios);
  state.counters["cpu_ratio"] = median(cpu_ratios);
}

BENCHMARK(discover_over_bare_embree)
    ->ArgNames({"city", "threads"})
    ->ArgsProduct({{demo, munich, etoile}, {1, 2}})
    ->Iterations(7)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grimaldi
