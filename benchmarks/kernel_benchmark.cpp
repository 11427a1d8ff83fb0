// Nanoseconds of what is called for every path: special functions, laws, geometry.

#include <benchmark/benchmark.h>

#include <array>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "benchmarks/libcerf_faddeeva.h"
#include "core/special_functions.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/laws/double_edge.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/reflection.h"
#include "propagation/laws/triangle_transform.h"
#include "propagation/laws/utd.h"
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

/// Two edges: arguments of both over the whole table, couplings 0.05 to 0.95.
template <class Function>
void double_edge_kernel(benchmark::State& state, const Function& function) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        function(i % table_size, (i * 31 + 7) % table_size, 0.05 + 0.9 * double(i % 17) / 16, i % 2 == 0));
    ++i;
  }
}

void double_edge_wave_kernel(benchmark::State& state) {
  const auto q = spread_arguments();
  double_edge_kernel(state, [&](std::size_t a, std::size_t b, double w, bool dark) {
    return double_edge_wave(q[a], dark, q[b], true, w);
  });
}
BENCHMARK(double_edge_wave_kernel)->Name("double_edge_wave");

void double_edge_excess_kernel(benchmark::State& state) {
  std::vector<EdgeWave> waves;
  for (const double q : spread_arguments()) waves.push_back(make_edge_wave(q));
  double_edge_kernel(state, [&](std::size_t a, std::size_t b, double w, bool dark) {
    return double_edge_excess(waves[a], waves[b], dark ? w : -w);
  });
}
BENCHMARK(double_edge_excess_kernel)->Name("double_edge_excess");

// ---- special functions and wedges, one at a time and in spans: nanoseconds per value
// ---------------------------------

/// Calls `all` on whole spans; items per second = values per second.
template <class All>
void in_spans(benchmark::State& state, const All& all) {
  for (auto _ : state) {
    all();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(table_size));
}

/// |z| as for faddeeva_on_ray, along its ray and elsewhere in the upper half-plane.
std::array<std::complex<double>, table_size> spread_plane(bool on_ray) {
  std::array<std::complex<double>, table_size> z;
  const auto t = spread_arguments();
  for (std::size_t i = 0; i < table_size; ++i)
    z[i] = std::polar(t[i],
                      on_ray ? 3 * std::numbers::pi / 4 : std::numbers::pi * double(i * 59 % table_size) / table_size);
  return z;
}

template <class Function>
void plane_kernel(benchmark::State& state, const Function& function, bool on_ray) {
  const auto z = spread_plane(on_ray);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(function(z[i++ % table_size]));
}

void faddeeva_plane(benchmark::State& state) {
  plane_kernel(
      state, [](std::complex<double> z) { return faddeeva(z); }, false);
}
BENCHMARK(faddeeva_plane)->Name("faddeeva/plane");

void faddeeva_ray_by_plane(benchmark::State& state) {
  plane_kernel(
      state, [](std::complex<double> z) { return faddeeva(z); }, true);
}
BENCHMARK(faddeeva_ray_by_plane)->Name("faddeeva/ray");

void faddeeva_of_libcerf(benchmark::State& state) { plane_kernel(state, libcerf_faddeeva, false); }
BENCHMARK(faddeeva_of_libcerf)->Name("libcerf w_of_z/plane");

void faddeeva_of_libcerf_on_ray(benchmark::State& state) { plane_kernel(state, libcerf_faddeeva, true); }
BENCHMARK(faddeeva_of_libcerf_on_ray)->Name("libcerf w_of_z/ray");

void faddeeva_on_ray_span(benchmark::State& state) {
  const auto t = spread_arguments();
  std::vector<std::complex<double>> w(table_size);
  in_spans(state, [&] { faddeeva_on_ray(t, w); });
}
BENCHMARK(faddeeva_on_ray_span)->Name("faddeeva_on_ray/span");

void transition_kernel(benchmark::State& state) {
  const auto x = spread_arguments();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(transition_function(x[i++ % table_size]));
}
BENCHMARK(transition_kernel)->Name("transition_function");

void transition_span(benchmark::State& state) {
  const auto x = spread_arguments();
  std::vector<std::complex<double>> f(table_size);
  in_spans(state, [&] { transition_function(x, f); });
}
BENCHMARK(transition_span)->Name("transition_function/span");

/// Directions about a wedge of 270° at L = 1 … 1000 m.
struct Directions {
  std::vector<double> phi_in, phi, sin_beta, distance, epsilon;
  Directions() {
    for (std::size_t i = 0; i < table_size; ++i) {
      phi_in.push_back(4.7 * double(i * 37 % table_size) / table_size);
      phi.push_back(4.7 * double(i * 91 % table_size) / table_size);
      sin_beta.push_back(0.2 + 0.8 * double(i * 53 % table_size) / table_size);
      distance.push_back(std::pow(1000.0, double(i) / table_size));
      epsilon.push_back(phi[i] - phi_in[i]);
    }
  }
};

void edge_wave_span(benchmark::State& state) {
  const Directions d;
  std::vector<std::complex<double>> waves(table_size);
  in_spans(state, [&] { edge_waves(d.distance, wavelength, d.sin_beta, d.epsilon, waves); });
}
BENCHMARK(edge_wave_span)->Name("fresnel_parameter + edge_wave/span");

void edge_wave_with_parameter(benchmark::State& state) {
  const Directions d;
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t n = i++ % table_size;
    benchmark::DoNotOptimize(
        edge_wave(fresnel_parameter(d.distance[n], wavelength, d.sin_beta[n], d.epsilon[n]), d.epsilon[n] >= 0));
  }
}
BENCHMARK(edge_wave_with_parameter)->Name("fresnel_parameter + edge_wave");

void utd_kernel(benchmark::State& state) {
  const Directions d;
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t n = i++ % table_size;
    const double l = d.distance[n];
    benchmark::DoNotOptimize(utd_coefficients(1.5 * std::numbers::pi, d.phi_in[n], d.phi[n], d.sin_beta[n],
                                              2 * std::numbers::pi / wavelength, {l, l, l, l}));
  }
}
BENCHMARK(utd_kernel)->Name("utd_coefficients");

void utd_span(benchmark::State& state) {
  const Directions d;
  std::vector<WedgeTerms> terms(table_size);
  in_spans(state, [&] {
    utd_coefficients(1.5 * std::numbers::pi, d.phi_in, d.phi, d.sin_beta, 2 * std::numbers::pi / wavelength, d.distance,
                     terms);
  });
}
BENCHMARK(utd_span)->Name("utd_coefficients/span");

/// A triangle of 1 m seen at κ = 0.1 … 100 rad/m (0), or at 0.1 … 1 (1: all by series).
std::vector<PlanePoint> spread_kappa(bool close) {
  std::vector<PlanePoint> kappa;
  for (std::size_t i = 0; i < table_size; ++i) {
    const double size = 0.1 * std::pow(close ? 10.0 : 1000.0, double(i * 97 % table_size) / table_size);
    kappa.push_back({size * std::cos(double(i)), size * std::sin(double(i))});
  }
  return kappa;
}
const AmplitudeTriangle triangle{{{{0, 0}, {1, 0.1}, {0.4, 0.9}}}, {{{1, 0}, {0.8, 0.3}, {0.5, -0.2}}}};

void triangle_kernel(benchmark::State& state) {
  const auto kappa = spread_kappa(state.range(0) != 0);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(triangle_transform(triangle, kappa[i++ % table_size]));
}
BENCHMARK(triangle_kernel)->Name("triangle_transform")->ArgName("close")->Arg(0)->Arg(1);

void triangle_span(benchmark::State& state) {
  const auto kappa = spread_kappa(state.range(0) != 0);
  std::vector<std::complex<double>> transform(table_size);
  in_spans(state, [&] { triangle_transform(triangle, kappa, transform); });
}
BENCHMARK(triangle_span)->Name("triangle_transform/span")->ArgName("close")->Arg(0)->Arg(1);

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

/// The bound that comes before it.
void power_bound_kernel(benchmark::State& state) {
  const Street street;
  const Course way = course(street, state.range(0));
  PathGeometry path;
  if (!UnfoldedSequence(street.scene, way.source, way.interactions).solve(way.receiver, wavelength, path)) {
    state.SkipWithError("a path was not found");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(power_bound(street.scene, street.plan, way.interactions, path));
    benchmark::ClobberMemory();
  }
}
BENCHMARK(power_bound_kernel)->Name("power_bound")->ArgName("edges")->Arg(1)->Arg(2);

}  // namespace
}  // namespace grimaldi
