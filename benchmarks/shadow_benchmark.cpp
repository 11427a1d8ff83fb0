// Shadow rays per second, in the order of their origins and in none.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <vector>

#include "benchmarks/cities.h"
#include "benchmarks/stopwatch.h"
#include "core/blocks.h"

namespace grimaldi {
namespace {

struct ShadowRay {
  Vec3 from, to;
};

/// From the middles of up to 256 edges, just outside them, to 512 cells each: neighbours in the list start at the same
/// edge and end in neighbouring cells.
std::vector<ShadowRay> edge_to_cell_rays(const City& city, const Plan& plan) {
  const auto& wedges = city.scene.wedges.wedges;
  const std::size_t edge_step = std::max<std::size_t>(1, wedges.size() / 256), cells = 512;
  std::vector<ShadowRay> rays;
  for (std::size_t w = 0, number = 0; w < wedges.size(); w += edge_step, ++number) {
    const Wedge& wedge = wedges[w];
    const double half = 0.5 * wedge.exterior_angle;
    const Vec3 from = wedge.point(0.5 * wedge.length) +
                      3 * city.tracer->surface_gap() * (std::cos(half) * wedge.along0 + std::sin(half) * wedge.normal0);
    // Another run of cells for each edge.
    const std::size_t first = number * 7919 % (plan.grid.size() - cells);
    for (std::size_t i = 0; i < cells; ++i) rays.push_back({from, plan.grid.centre(first + i)});
  }
  return rays;
}

/// Arguments: city, threads, whether the order is kept. `rays_per_cpu_s` is by the time of the processors, which other
/// programs disturb less.
void shadow_rays(benchmark::State& state) {
  const City* city = city_for(state, state.range(0));
  if (!city) return;
  const auto threads = static_cast<unsigned>(state.range(1));
  std::vector<ShadowRay> rays = edge_to_cell_rays(*city, radio_plan(*city, false, 1e6, threads));
  if (!state.range(2)) std::shuffle(rays.begin(), rays.end(), std::mt19937_64(1));
  constexpr std::size_t rays_per_block = 4096;
  std::atomic<std::size_t> visible = 0;
  const Stopwatch watch;
  for (auto _ : state) {
    visible = 0;
    for_each_block((rays.size() + rays_per_block - 1) / rays_per_block, threads, [&](std::size_t block, unsigned) {
      const std::size_t end = std::min(rays.size(), (block + 1) * rays_per_block);
      std::size_t free = 0;
      for (std::size_t i = block * rays_per_block; i < end; ++i)
        free += city->tracer->visible(rays[i].from, rays[i].to);
      visible += free;
    });
  }
  state.counters["rays_per_s"] = benchmark::Counter(double(rays.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["rays_per_cpu_s"] = double(rays.size()) * double(state.iterations()) / watch.processor();
  state.counters["visible_share"] = double(visible) / double(rays.size());
}

BENCHMARK(shadow_rays)
    ->ArgNames({"city", "threads", "sorted"})
    ->ArgsProduct({{demo, munich, etoile}, {1, 2}, {1, 0}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grimaldi
