#pragma once
// The cities that the benchmarks share, each loaded once.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "propagation/plan.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

struct City {
  std::string name;
  Vec3 transmitter;
  Scene scene;
  std::unique_ptr<Tracer> tracer;  ///< of `scene`, which therefore stays where it is
};

/// Numbers of the cities: the demo city, then those that need ../shared.
enum CityNumber { demo = 0, munich = 1, etoile = 2 };

/// The city, which is also the label of `state`; if its files are not there, nullptr, and `state` says so and is
/// skipped.
const City* city_for(benchmark::State& state, std::int64_t number);

/// 3.5 GHz from the city's transmitter to cells of 5 m at 1.5 m, depth 3, `rays` in 16 passes.
Plan radio_plan(const City& city, bool diffraction, double rays, unsigned threads);

}  // namespace grimaldi
