// Nanoseconds of what is called for every path: special functions, laws, geometry.

#include <benchmark/benchmark.h>

#include <array>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/special_functions.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/reflection.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"
#include "scenes/canonical.h"

namespace grimaldi {
namespace {

constexpr double wavelength = 0.0857;  ///< m, of 3.5 GHz

/// Arguments cycle through a table, so that branches meet what a city brings: v from 0.01 to 30, evenly in its
/// logarithm.
constexpr std::size_t table_size = 256;
std::array<double, table_size> spread_arguments() {
  std::array<double, table_size> values;
  for (std::size_t i = 0; i < table_size; ++i)
    values[i] = 0.01 * std::pow(3000.0, double(i * 97 % table_size) / (table_size - 1));
  return values;
}

void faddeeva_on_ray_kernel(benchmark::State& state) {
  const auto t = spread_arguments();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(faddeeva_on_ray(t[i++ % table_size]));
}
BENCHMARK(faddeeva_on_ray_kernel)->Name("faddeeva_on_ray");

void edge_wave_kernel(benchmark::State& state) {
  const auto v = spread_arguments();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(edge_wave(v[i % table_size], i % 2 == 0));
    ++i;
  }
}
BENCHMARK(edge_wave_kernel)->Name("edge_wave");

void slab_reflection_kernel(benchmark::State& state) {
  const double wavenumber = 2 * std::numbers::pi / wavelength;
  std::size_t i = 0;
  for (auto _ : state) {
    const double cosine = double(i++ % table_size + 1) / table_size;
    benchmark::DoNotOptimize(slab_reflection({5.24, -0.63}, 0.1, wavenumber, cosine));  // concrete
  }
}
BENCHMARK(slab_reflection_kernel)->Name("slab_reflection");

/// A street 20 m wide along x between houses 20 m high and 15 m deep; x = −37.5 m is the middle of a house on either
/// side.
struct Street {
  Scene scene;
  Plan plan;
  Street() {
    Diagnostics diagnostics;
    scene = build_scene(canonical_scene("street-canyon", {}, diagnostics), {}, diagnostics);
    const Tracer tracer(scene);
    PlanDescription request;
    request.frequency = {3.5e9};
    request.transmitters = {{"tx", {-37.5, 0, 10}, {0.0}, {}}};
    plan = make_plan(request, scene, tracer, diagnostics);
    diagnostics.throw_if_errors();
  }
  /// The patch that faces `normal` and contains `point`.
  Interaction face(const Vec3& point, const Vec3& normal) const {
    for (std::uint32_t p = 0; p < scene.patches.patches.size(); ++p) {
      const Patch& patch = scene.patches.patches[p];
      const bool inside =
          point.x >= patch.low.x && point.x <= patch.high.x && point.z >= patch.low.z && point.z <= patch.high.z;
      if (dot(patch.normal, normal) > 0.99 && std::abs(dot(patch.normal, point) - patch.offset) < 0.01 && inside)
        return p;
    }
    throw std::runtime_error("the street has no such face");
  }
  /// The edge through `point`.
  Interaction edge(const Vec3& point) const {
    for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
      const Wedge& wedge = scene.wedges.wedges[w];
      const double along = dot(point - wedge.start, wedge.direction);
      if (along >= 0 && along <= wedge.length && distance(wedge.point(along), point) < 0.01) return edge_interaction(w);
    }
    throw std::runtime_error("the street has no such edge");
  }
};

/// A sequence, where its wave comes from and the first of the places where it goes.
struct Course {
  Vec3 source, receiver;
  std::vector<Interaction> interactions;
};

/// Through `edges` edges: from the street by both its walls; from above a roof over its rim into the street; from
/// behind a house over both rims of its roof.
Course course(const Street& street, std::int64_t edges) {
  const double x = -37.5, top = 20, near = 10, far = 25;
  const Interaction near_rim = street.edge({x, near, top});
  if (edges == 0)
    return {
        {x, 0, 10}, {x - 5, 0, 1.5}, {street.face({x, near, 10}, {0, -1, 0}), street.face({x, -near, 10}, {0, 1, 0})}};
  if (edges == 1) return {{x, 18, 30}, {x - 5, 0, 1.5}, {near_rim}};
  return {{x, 40, 10}, {x - 5, 0, 1.5}, {street.edge({x, far, top}), near_rim}};
}

/// Argument: number of edges. Receivers 0.1 m apart on a line, as neighbouring sub-points are asked.
void unfolded_solve(benchmark::State& state) {
  const Street street;
  const Course way = course(street, state.range(0));
  UnfoldedSequence unfolded(street.scene, way.source, way.interactions);
  PathGeometry geometry;
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    const Vec3 receiver = way.receiver + Vec3{0.1 * double(i++ % 100), 0, 0};
    found += unfolded.solve(receiver, wavelength, geometry);
    benchmark::DoNotOptimize(geometry);
  }
  if (found != i) state.SkipWithError("a path was not found");
}
BENCHMARK(unfolded_solve)->ArgName("edges")->Arg(0)->Arg(1)->Arg(2);

/// Argument: number of edges (0: two faces). One band, both polarisations.
void path_field_kernel(benchmark::State& state) {
  const Street street;
  const Course way = course(street, state.range(0));
  UnfoldedSequence unfolded(street.scene, way.source, way.interactions);
  std::vector<PathGeometry> paths(100);
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (!unfolded.solve(way.receiver + Vec3{0.1 * double(i), 0, 0}, wavelength, paths[i])) {
      state.SkipWithError("a path was not found");
      return;
    }
  std::vector<std::array<std::complex<double>, 2>> field(1);
  std::size_t i = 0;
  for (auto _ : state) {
    path_field(street.scene, street.plan, street.plan.request.transmitters[0], way.interactions,
               paths[i++ % paths.size()], field);
    benchmark::DoNotOptimize(field.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(path_field_kernel)->Name("path_field")->ArgName("edges")->Arg(0)->Arg(1)->Arg(2);

}  // namespace
}  // namespace grimaldi
