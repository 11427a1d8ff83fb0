// A full run, and what share of its time each stage takes.

#include <benchmark/benchmark.h>

#include "benchmarks/cities.h"
#include "propagation/simulation.h"

namespace grimaldi {
namespace {

/// Arguments: city, whether edges diffract. 250,000 rays to depth 3 on all processors.
void stages(benchmark::State& state) {
  const City* city = city_for(state, state.range(0));
  if (!city) return;
  const Plan plan = radio_plan(*city, state.range(1) != 0, 2.5e5, 0);
  RunFigures figures;
  for (auto _ : state) figures = simulate(city->scene, *city->tracer, plan).figures;
  const double whole = figures.trace_seconds;
  // Merge is part of the figure of discover.
  state.counters["discover"] = (figures.discover_seconds - figures.merge_seconds) / whole;
  state.counters["merge"] = figures.merge_seconds / whole;
  state.counters["grow"] = figures.grow_seconds / whole;
  state.counters["evaluate"] = figures.evaluate_seconds / whole;
  state.counters["sequences"] = double(figures.sequences);
  state.counters["pairs"] = double(figures.sequence_cell_pairs);
  state.counters["shadow_rays"] = double(figures.shadow_rays);
}

BENCHMARK(stages)
    ->ArgNames({"city", "diffraction"})
    ->ArgsProduct({{demo, munich, etoile}, {0, 1}})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace grimaldi
