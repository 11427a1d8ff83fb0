// Kernels at the ends of their domains: against many digits, quadrature, closed limits, or a clear refusal.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <string>

#include "core/constants.h"
#include "core/contract.h"
#include "core/special_functions.h"
#include "propagation/laws/aperture.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/published_diffraction.h"
#include "propagation/laws/reflection.h"
#include "propagation/laws/triangle_transform.h"
#include "propagation/laws/utd.h"
#include "validation/bessel.h"
#include "validation/cases/families.h"
#include "validation/cases/many_digits.h"
#include "validation/half_plane.h"
#include "validation/knife_edge.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Keeps the largest error and where it was; what is not finite is infinitely wrong.
void worst(Outcome& outcome, double error, const std::string& where) {
  if (!std::isfinite(error)) error = infinite;
  if (error > outcome.error || outcome.note.empty())
    outcome.error = std::max(error, outcome.error), outcome.note = "largest at " + where;
}

/// Triangles of one kind: error over what the bound of the header allows.
Outcome triangles(const std::string& kind) {
  Outcome outcome;
  for (const auto& row : many_digits::triangles) {
    if (row.kind != kind) continue;
    AmplitudeTriangle triangle{{{{0.3, -0.2}, {1.3, 0.05}, {0.55, 0.9}}}, {1.0, Complex(0.5, 0.25), -0.75}};
    double surface = 0.5 * std::abs(1.0 * 1.1 - 0.25 * 0.25), reach = 1.32;
    if (row.height > 0) {
      triangle.corner = {{{0, 0}, {1, 0}, {0.5, row.height}}};
      surface = row.height / 2, reach = 1;
    }
    const Complex ours = triangle_transform(triangle, {row.kx, row.ky});
    const double kappa = std::hypot(row.kx, row.ky);
    const double bound = (2e-15 + 4.5e-16 * kappa * reach) * surface;
    worst(outcome, std::abs(ours - Complex(row.re, row.im)) / bound,
          fmt::format("kappa = {:.3g}, {:.2g} of the value", kappa,
                      std::abs(ours - Complex(row.re, row.im)) / std::abs(Complex(row.re, row.im))));
  }
  return outcome;
}

/// The same, over the value itself: nothing is lost where the pattern is weak.
Outcome triangle_digits() {
  Outcome outcome;
  for (const auto& row : many_digits::triangles) {
    if (row.height > 0) continue;
    const AmplitudeTriangle triangle{{{{0.3, -0.2}, {1.3, 0.05}, {0.55, 0.9}}}, {1.0, Complex(0.5, 0.25), -0.75}};
    const Complex ours = triangle_transform(triangle, {row.kx, row.ky}), truth(row.re, row.im);
    const double kappa = std::hypot(row.kx, row.ky);
    // Phases of κ·u themselves have an error of half an ulp.
    worst(outcome, std::abs(ours - truth) / std::abs(truth) / (1 + kappa),
          fmt::format("kappa = {:.3g} {}", kappa, row.kind));
  }
  return outcome;
}

Outcome alphas() {
  Outcome outcome;
  for (const auto& row : many_digits::alphas) {
    const std::string where = fmt::format("zeta = ({:.3g}, {:.3g})", row.x, row.y);
    // Near a zero of the sine its phase counts: 1 ulp of ζx/2.
    const double phase = 1e-16 * std::abs(row.x);
    const double r2 = row.x * row.x + row.y * row.y,
                 envelope2 = std::abs(row.y) / (2 * pi * r2) / std::max(1.0, std::abs(row.x));
    const double envelope1 = row.x == 0 ? 1 : std::min(1.0, std::abs(row.x)) * envelope2;
    const double error1 = std::abs(alpha1(row.x, row.y) - row.alpha1),
                 error2 = std::abs(alpha2(row.x, row.y) - row.alpha2);
    worst(outcome, error1 / (std::abs(row.alpha1) + phase / 1e-15 * envelope1 + 1e-300), where + ", alpha1");
    worst(outcome, error2 / (std::abs(row.alpha2) + phase / 1e-15 * envelope2), where + ", alpha2");
  }
  return outcome;
}

/// Towards ξ → 0 the edges of an aperture of constant amplitude must add up to its area, at any distance of ke.
Outcome forward() {
  Outcome outcome;
  TriangleAperture square;
  square.vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, square.amplitudes = {1, 1, 1, 1};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (double ke = 1e-6; ke < 2e8; ke *= 100)
    for (const double xi : {0.0, 1e-300, 1e-20, 1e-12}) {
      const Complex ours = aperture_field(square, ke, {xi, xi / 3});
      const double truth = ke / (2 * pi);
      worst(outcome, std::abs(ours - truth) / truth / (1 + ke * xi * 1e16),
            fmt::format("ke = {:.2g}, xi = {:.2g}", ke, xi));
    }
  return outcome;
}

Outcome transition() {
  Outcome outcome;
  for (const auto& row : many_digits::transition) {
    const Complex truth(row.re, row.im);
    worst(outcome, std::abs(transition_function(row.x) - truth) / std::abs(truth), fmt::format("x = {:g}", row.x));
  }
  return outcome;
}

Outcome edges() {
  Outcome outcome;
  for (const auto& row : many_digits::knife_edge)
    worst(outcome, std::abs(knife_edge(row.v) - Complex(row.re, row.im)), fmt::format("v = {:g}", row.v));
  return outcome;
}

/// The half-plane from 1 mm at 20 Hz (sound) to 100 km at 300 GHz, faces, boundaries and grazing incidence included.
Outcome half_plane_everywhere() {
  Outcome outcome;
  const double k_rhos[] = {2 * pi * 20 / 343 * 1e-3, 1e-2, 1, 1e3, 1e6, 2 * pi * 300e9 / speed_of_light * 1e5};
  for (const double k_rho : k_rhos)
    for (const double in : {0.0, 1e-6, 30.0, 90.0, 150.0, 180.0, 330.0, 360.0})
      for (const double offset : {-1e-6, -1e-12, 0.0, 1e-12, 1e-6, 40.0})
        for (const double boundary : {0.0, 180 - in, 180 + in, 540 - in, 360.0}) {
          const double phi = boundary + offset;
          if (phi < 0 || phi > 360) continue;
          const WedgeTotal ours = utd_plane_wave(360, k_rho, in, phi, 180);
          const WedgeField truth = half_plane_plane_wave(k_rho, phi * pi / 180, in * pi / 180);
          const double error = std::max(std::abs(ours.soft - truth.soft), std::abs(ours.hard - truth.hard));
          worst(outcome, error / (1 + k_rho),
                fmt::format("k rho = {:.3g}, phi' = {:g}, phi = {:.12g}", k_rho, in, phi));
        }
  return outcome;
}

/// Every wedge from a half-plane to a slot of 0.1° at its boundaries and faces: finite, continuous, and the exact field
/// where n is 1/m.
Outcome wedges_of_all_angles(bool against_exact) {
  Outcome outcome;
  for (const double interior :
       {0.0, 0.1, 1.0, 45.0, 90.0, 135.0, 179.9, 180.0, 180.1, 225.0, 270.0, 300.0, 330.0, 345.0, 350.0}) {
    const double exterior = 360 - interior, n = exterior / 180;
    for (const double k_rho : {10.0, 100.0, 1000.0})
      for (const double in : {0.0, 0.3 * exterior, 0.5 * exterior, exterior})
        for (double place : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          const double phi = place * exterior;
          const WedgeTotal ours = utd_plane_wave(exterior, k_rho, in, phi, 180);
          const std::string where =
              fmt::format("interior {:g}, k rho {:g}, phi' {:g}, phi {:g} degrees", interior, k_rho, in, phi);
          const double size = std::max(std::abs(ours.soft), std::abs(ours.hard));
          if (!against_exact) {
            worst(outcome, std::isfinite(size) && size <= 2 * std::ceil(1 / std::min(1.0, n)) + 1 ? 0 : infinite,
                  where);
            continue;
          }
          const WedgeField truth = wedge_plane_wave(n, k_rho, phi * pi / 180, in * pi / 180);
          worst(outcome, k_rho * std::max(std::abs(ours.soft - truth.soft), std::abs(ours.hard - truth.hard)), where);
        }
  }
  return outcome;
}

/// Slots of 0.1° to 9°: soft walls let nothing in, hard walls hold (2/n) J0 on all directions.
Outcome slots() {
  Outcome outcome;
  for (const double exterior : {0.1, 1.0, 9.0}) {
    const double n = exterior / 180;
    for (const double k_rho : {0.5, 3.0, 8.0})
      for (const double place : {0.0, 0.3, 1.0}) {
        const WedgeTotal ours = utd_plane_wave(exterior, k_rho, exterior / 2, place * exterior, 180);
        const double hard = 2 / n * bessel_j(0, k_rho);  // the next mode has the order 1/n = 20 and more
        const double next = 4 / n * bessel_j(1 / n, k_rho);
        worst(outcome, std::max(std::abs(ours.soft), std::abs(ours.hard - hard)) * n - next * n,
              fmt::format("slot of {:g} degrees, k rho = {:g}", exterior, k_rho));
      }
  }
  return outcome;
}

/// On the boundary itself a term is ½, whatever the distance and the angle.
Outcome halves() {
  Outcome outcome;
  for (const double n : {2.0, 1.9999, 1.5, 1.0001, 0.75, 0.0005556})
    for (double kl = 1e-12; kl < 1e17; kl *= 1e3)
      for (const bool dark : {true, false}) {
        worst(outcome, std::abs(wedge_wave(n, kl, 0, dark) - (dark ? 0.5 : -0.5)),
              fmt::format("n = {:g}, kL = {:g}", n, kl));
        worst(outcome, std::abs(edge_wave(0, dark) - (dark ? 0.5 : -0.5)), "the edge wave");
      }
  return outcome;
}

/// Nothing but finite numbers over a grid of everything.
Outcome finite_numbers() {
  Outcome outcome;
  std::size_t asked = 0;
  const auto check = [&](const Complex& value, const std::string& where) {
    ++asked;
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag())) worst(outcome, infinite, where);
  };
  const double values[] = {0, 1e-300, 1e-20, 1e-8, 1, 1e8, 1e16, 1e150};
  for (const double a : values) {
    check(transition_function(a), fmt::format("F({:g})", a));
    check(knife_edge(a), fmt::format("E({:g})", a));
    check(knife_edge(-a), fmt::format("E(-{:g})", a));
    check(edge_wave(a, true), fmt::format("edge wave {:g}", a));
    check(edge_tail(std::min(a, 1e8)), fmt::format("tail {:g}", a));
    for (const double b : values) {
      check(alpha1(a, b), fmt::format("alpha1({:g}, {:g})", a, b));
      check(alpha2(a, b), fmt::format("alpha2({:g}, {:g})", a, b));
      if (a <= 1e16 && b <= 1) check(wedge_wave(1.5, a, b, true), fmt::format("term kL = {:g}, turn {:g}", a, b));
      if (b <= 1)
        check(half_space_reflection(Complex(1 + a, -a), b).tm, fmt::format("permittivity {:g}, cos {:g}", a, b));
    }
  }
  if (outcome.error == 0) outcome.note = fmt::format("{} values, all finite", asked);
  return outcome;
}

/// Grazing incidence on faces: both polarisations tend to −1, and to the right slope.
Outcome grazing_faces() {
  Outcome outcome;
  for (const Complex permittivity : {Complex(2.25, 0), Complex(5.24, -0.3), Complex(81, -30)})
    for (const double cosine : {0.0, 1e-300, 1e-12, 1e-6}) {
      const ReflectionCoefficients r = half_space_reflection(permittivity, cosine);
      // First order: R = −1 + 2 cos θ/√(η−1), times η for TM.
      const Complex root = std::sqrt(permittivity - 1.0);
      const double second = 4 * cosine * cosine * std::norm(permittivity);
      worst(outcome, std::abs(r.te - (-1.0 + 2 * cosine / root)) - second,
            fmt::format("half-space, cos = {:g}", cosine));
      worst(outcome, std::abs(r.tm - (-1.0 + 2 * cosine * permittivity / root)) - second,
            fmt::format("half-space, cos = {:g}", cosine));
      const SlabCoefficients slab = slab_coefficients(permittivity, 0.1, 2 * pi / 0.1, cosine);
      worst(outcome, std::max(std::abs(slab.reflection.te + 1.0), std::abs(slab.transmission.te)) - 40 * cosine,
            fmt::format("slab, cos = {:g}", cosine));
    }
  outcome.error = std::max(outcome.error, 0.0);
  return outcome;
}

/// What is outside the domain must say so.
Outcome refusals() {
  const std::pair<const char*, std::function<void()>> questions[] = {
      {"a slot of 0.1 degrees asked of the exact wedge", [] { wedge_plane_wave(0.1 / 180, 10, 0.0005, 0.0005); }},
      {"an exterior angle above 360 degrees", [] { wedge_plane_wave(2.1, 10, 1, 1); }},
      {"a direction inside the solid", [] { wedge_plane_wave(1.5, 10, 5, 1); }},
      {"a distance that is not a number", [] { half_plane_plane_wave(std::nan(""), 1, 1); }},
      {"a receiver at the source",
       [] {
         wedge_point_source(1.5, 1, {1, 1, 0}, {1, 1, 0});
       }},
      {"edges at no distance",
       [] {
         exact_double_knife_edge({0.1, 0, 1, 1, 0, 0});
       }},
  };
  Outcome outcome;
  int refused = 0;
  for (const auto& [what, ask] : questions) {
    try {
      ask();
      worst(outcome, 1, what);
    } catch (const InputErrors&) {
      ++refused;
    }
  }
  if (outcome.note.empty())
    outcome.note = fmt::format("{} of {} refused with a message", refused, std::size(questions));
  return outcome;
}

}  // namespace

Cases extreme_kernel_cases() {
  Cases cases;
  for (const char* kind : {"general", "parallel", "perpendicular", "needle"})
    cases.push_back({fmt::format("extremes/triangle/{}", kind),
                     "transform of a triangle, ke from 0 to 1e8: largest |error| over (2e-15 + 4.5e-16 k reach) area",
                     "80 digits, divided differences", "1", 1, "the bound that the header states", 0,
                     [kind = std::string(kind)] { return triangles(kind); }});
  cases.push_back({"extremes/triangle/digits",
                   "transform of a triangle, ke from 0 to 1e8: largest |error| over the value and 1 + ke", "80 digits",
                   "1", 1e-15, "an ulp of each phase, a few of the value: weak directions keep their digits", 0,
                   triangle_digits});
  cases.push_back({"extremes/aperture/forward", "square opening, xi to 0, ke from 1e-6 to 1e8: largest relative error",
                   "closed form k A/2 pi", "1", 4e-15, "the transform has no pole: a few ulp", 0, forward});
  cases.push_back({"extremes/alphas",
                   "alpha1, alpha2, zeta from 1e-6 to 1e8, along and across the edge: largest relative error",
                   "80 digits", "1", 4e-15, "2e-15 of the value and the phase of the sine", 0, alphas});
  cases.push_back({"extremes/transition", "transition function F, x from 1e-16 to 1e16: largest relative error",
                   "80 digits", "1", 2e-15, "1e-14 promised, 1e-15 within reach", 0, transition});
  cases.push_back({"extremes/knife-edge", "black edge, v from -1e8 to 1e8: largest |error|", "80 digits", "1", 1e-14,
                   "the bound that the header states", 0, edges});
  cases.push_back(
      {"extremes/half-plane",
       "half-plane by UTD on and beside its faces and boundaries, at grazing incidence, from 1 mm at 20 Hz (sound) to "
       "100 km at 300 GHz: largest |error| over 1 + k rho",
       "Sommerfeld's half-plane by quadrature", "1", 3e-15, "exact: an ulp of each phase k rho", 0,
       half_plane_everywhere});
  cases.push_back({"extremes/wedges/finite",
                   "UTD, wedges of 0 to 350 degrees at faces and boundaries: numbers out of all bounds",
                   "no more than the images there are", "1", 0, "no NaN, no infinity", 0,
                   [] { return wedges_of_all_angles(false); }});
  cases.push_back(
      {"extremes/wedges/exact", "UTD, wedges of 0 to 350 degrees at faces and boundaries: largest |error| times k rho",
       "exact wedge", "1", 0.2, "what UTD leaves out next to its boundaries, of order 1/(k rho): 0.1 measured", 0,
       [] { return wedges_of_all_angles(true); }});
  cases.push_back({"extremes/wedges/slots",
                   "UTD in slots of 9 to 0.1 degrees (wedges up to 359.9): largest |error| over 2/n", "0 and (2/n) J0",
                   "1", 1e-12, "exact for n = 1/m: rounding of up to 1800 images", 0, slots});
  cases.push_back({"extremes/boundary", "terms exactly on their boundary, kL from 1e-12 to 1e17: largest |error|",
                   "1/2", "1", 1e-15, "closed limit", 0, halves});
  cases.push_back({"extremes/faces/grazing", "reflection at grazing incidence: largest |error|", "closed limit", "1",
                   1e-14, "-1 without loss of digits; slope to first order", 0, grazing_faces});
  cases.push_back({"extremes/finite", "kernels over arguments of 0 to 1e150: values that are not finite", "none", "1",
                   0, "no NaN, no infinity", 0, finite_numbers});
  cases.push_back({"extremes/refusals", "questions outside the domain that are answered all the same",
                   "a clear refusal", "1", 0, "the references throw with a message", 0, refusals});
  return cases;
}

}  // namespace grimaldi
