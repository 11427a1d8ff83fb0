// The figures of the paper on the free-space diffraction BSDF (Steinberg et al. 2024), in its printed and in the
// repaired form, next to the truth.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/published_diffraction.h"
#include "validation/cases/families.h"
#include "validation/cases/opening.h"
#include "validation/cases/patterns.h"
#include "validation/fraunhofer.h"
#include "validation/knife_edge.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
/// |α1|, |α2| in canonical space, whole and without the central lobe.
Figure canonical_space() {
  RasterRow row;
  row.title = "Edge waves in canonical space (edge of length 1 along x)";
  row.x_name = "ζx", row.y_name = "ζy", row.scale_name = "20 lg |α|, dB";
  row.left = row.bottom = -15, row.right = row.top = 15;
  row.low = -90, row.high = -10;
  constexpr int side = 180;
  const struct {
    const char* name;
    bool first, whole;
  } panels[] = {{"α1, whole", true, true},
                {"α2, whole", false, true},
                {"α1 as printed, lobe removed", true, false},
                {"α2 as printed, lobe removed", false, false}};
  for (const auto& panel : panels) {
    Raster raster{panel.name, side, {}};
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double x = 15 * ((2 * i + 1.0) / side - 1), y = 15 * ((2 * j + 1.0) / side - 1);
        const double kept = panel.whole ? 1 : std::sqrt(-std::expm1(-(x * x + y * y) / 6));
        raster.values.push_back(level_of(kept * (panel.first ? alpha1(x, y) : alpha2(x, y))));
      }
    row.panels.push_back(std::move(raster));
  }
  return {
      "canonical-edge-waves",
      "The two functions of which the BSDF makes every edge's wave; left whole, as they add up to the exact far field, "
      "right as printed, each edge without a lobe of its own.",
      row};
}

/// The whole edge waves of a polygon of constant amplitude add up to its Fraunhofer integral.
Outcome canonical_sum() {
  Outcome outcome;
  constexpr double k = 2 * pi;
  for (const char* name : {"square", "triangle", "star", "ring"}) {
    const Opening shape = opening(name, 10);
    for (double x = -0.9; x < 0.95; x += 0.173)
      for (double y = -0.8; y < 0.9; y += 0.211) {
        Complex sum = 0;
        for (const PublishedEdge& edge : boundary_edges(shape.triangles)) sum += whole_edge_wave(k, edge, {x, y});
        const Complex truth = k / (2 * pi) * std::conj(fraunhofer_integral(shape.aperture, k * x, k * y));
        outcome.error = std::max(outcome.error, std::abs(sum - truth) / (k / (2 * pi) * area(shape.aperture)));
      }
  }
  outcome.figures = {canonical_space()};
  return outcome;
}

/// I1 and I2 of S2.34 by quadrature in polar coordinates, against the kernel's power of an edge and the print.
Outcome edge_powers() {
  const auto square = [](bool first, double r, double t) {
    const double x = r * std::cos(t), y = r * std::sin(t), a = first ? alpha1(x, y) : alpha2(x, y);
    return -std::expm1(-r * r / 6) * a * a * r;
  };
  double integral[2] = {0, 0};
  for (const bool first : {true, false}) {
    const auto ring = [&](double r) {  // four equal quarters; sharp about t = 0 and π/2 by 1/r
      const auto over = [&](double from, double to, int panels) {
        return integrate([&](double t) { return Complex(square(first, r, t)); }, from, to, 1e-16, panels).value;
      };
      const int panels = 2 + int(r / 4);
      return 4.0 * (over(0, pi / 4, panels) + over(pi / 4, pi / 2, panels));
    };
    double from = 0, before = 0, last = 0;
    double sum = 0;
    for (const double to : {1.0, 4.0, 16.0, 32.0, 64.0, 128.0, 256.0}) {
      before = last;
      last = integrate(ring, from, to, 1e-13, 1 + int((to - from) / 4)).value.real();
      sum += last;
      from = to;
    }
    // Beyond, an edge's power per ring falls as c/r² + 2d/r³: c and d from the last two octaves of r.
    integral[first ? 0 : 1] = sum + (5 * last - before) / 3;
  }
  const double ours[2] = {
      published_edge_power({{0, 0}, {1, 0}, 1, 0}) - published_edge_power({{0, 0}, {1, 0}, 0.5, 0.5}),
      published_edge_power({{0, 0}, {1, 0}, 1, 1})};
  const double printed[2] = {0.0045255085, 0.11487543};
  const double error = std::max(std::abs(ours[0] / integral[0] - 1), std::abs(ours[1] / integral[1] - 1));
  return {error,
          fmt::format(
              "quadrature {:.8f}, {:.8f}; kernel {:.8f}, {:.8f}; printed S2.36 {:.8f}, {:.8f}: {:.1f} and {:.1f} % low",
              integral[0], integral[1], ours[0], ours[1], printed[0], printed[1], 100 * (1 - printed[0] / integral[0]),
              100 * (1 - printed[1] / integral[1])),
          {}};
}

/// Cutting the rim finer changes what is left in print, not in the repaired form.
Outcome tessellation() {
  double power[2] = {0, 0};
  for (const int pieces : {1, 8})
    for (int i = 0; i < pieces; ++i) {
      const double a = double(i) / pieces, b = double(i + 1) / pieces;
      power[pieces == 1 ? 0 : 1] += published_edge_power({{a, 0}, {b, 0}, 1, 1});
    }
  return {std::abs(10 * std::log10(power[1] / power[0])), "one edge of constant amplitude, cut in eight", {}};
}

constexpr Theory truth = Theory::truth, fraunhofer = Theory::fraunhofer, polygon = Theory::polygon,
                 printed = Theory::printed, edges = Theory::edges, cones = Theory::cones;

/// Median error of the whole polygon at N = 0.1; the others' in the note.
Outcome far_away(const Opening& shape) {
  return {median_error(polygon, shape, 0.1),
          fmt::format("as printed {:.2f} dB, UTD with ends {:.2f} dB", median_error(printed, shape, 0.1),
                      median_error(edges, shape, 0.1)),
          {}};
}

Outcome ring() {
  const Opening shape = opening("ring", 30);
  Outcome outcome = far_away(shape);
  outcome.figures = {
      pattern_figure(
          shape, 0.1, 3, {truth, fraunhofer, polygon, printed, cones},
          {"ring-32", "Ring of 32 edges, D = 30 λ, N = 0.1",
           "The published ring, two circles of 32 edges each. The whole polygon is the truth; as printed each edge "
           "loses its lobe and with it the rings; UTD by cones alone draws the strips of 64 edges."}),
      pattern_figure(shape, 3, 1.3, {truth, polygon, printed, edges, cones},
                     {"ring-32-near", "The same ring at N = 3",
                      "Nearer to the ring the far field is the wrong picture and edges are nearer to the truth."})};
  return outcome;
}

Outcome double_slit() {
  const Opening shape = opening("double-slit", 30);
  Outcome outcome = far_away(shape);
  outcome.figures = {
      cut_figure(shape, 0.1, 4, {truth, polygon, printed, edges},
                 {"double-slit", "Double slit, D = 30 λ, N = 0.1: cut across the slits",
                  "Far away every theory that knows ends and lobes has the fringes."}),
      cut_figure(
          shape, 3, 2, {truth, polygon, printed, edges},
          {"double-slit-near", "Double slit, D = 30 λ, N = 3: cut across the slits",
           "Nearer, the far field puts its fringes where the truth has the shadows of the slits; edges follow it."})};
  return outcome;
}

Outcome square() {
  const Opening shape = opening("square", 10);
  Outcome outcome = far_away(shape);
  outcome.figures = {pattern_figure(shape, 0.1, 3, {truth, fraunhofer, polygon, edges, cones},
                                    {"square-far", "Square opening of 10 λ, N = 0.1",
                                     "Far: the polygon form and edges with ends are the truth, cones are not."}),
                     pattern_figure(shape, 3, 1.2, {truth, fraunhofer, polygon, edges, cones},
                                    {"square-near", "Square opening of 10 λ, N = 3",
                                     "Near: the polygon form is a far field still, edges follow the truth."}),
                     cut_figure(shape, 0.3, 3, {truth, fraunhofer, polygon, printed, edges},
                                {"square-cut", "Square opening of 10 λ, N = 0.3: cut along x",
                                 "At N = 0.3 the far field still has the lobes, its zeros are too deep."})};
  return outcome;
}

/// Level behind a half-plane, 1 GHz, 100 m on both sides: the published estimate and the repaired law.
Outcome behind_an_edge(bool as_printed) {
  constexpr double wavelength = 0.299792458, before = 100, behind = 100;
  LineChart chart;
  chart.title = "Behind a half-plane: 1 GHz, 100 m on either side";
  chart.x_name = "Fresnel parameter v", chart.y_name = "level over free space, dB";
  chart.low = -35, chart.high = 0;
  Curve exact_curve{"Fresnel integral", {}, {}}, old_form{"BSDF as printed, σ = 25 λ", {}, {}},
      repaired{"repaired", {}, {}};
  Outcome outcome;
  for (double v = 0.2; v <= 4.01; v += 0.4) {
    const double length = before * behind / (before + behind);
    const double epsilon = 2 * std::asin(v / (2 * std::sqrt(2 * length / wavelength)));
    const double below = behind * std::tan(epsilon);
    const double exact = -diffraction_loss(exact_knife_edge(v));
    const double s = std::hypot(behind, below), leg = before * s / (before + s);
    const double free = distance(Vec3{-before, 0, 0}, Vec3{behind, 0, -below}) / (before + s);
    const double ours =
        20 * std::log10(std::abs(edge_wave(fresnel_parameter(leg, wavelength, 1, epsilon), true)) * free);
    const double theirs = as_printed ? 10 * std::log10(published_half_plane_level({25 * wavelength, 12}, wavelength,
                                                                                  before, behind, below, 1000, 200))
                                     : NAN;
    // The exact level at the true detour.
    const double detour = before + s - distance(Vec3{-before, 0, 0}, Vec3{behind, 0, -below});
    const double at_detour = -diffraction_loss(exact_knife_edge(2 * std::sqrt(detour / wavelength)));
    outcome.error = std::max(outcome.error, std::abs((as_printed ? theirs : ours) - at_detour));
    exact_curve.x.push_back(v), exact_curve.y.push_back(exact);
    old_form.x.push_back(v), old_form.y.push_back(theirs);
    repaired.x.push_back(v), repaired.y.push_back(ours);
  }
  if (as_printed) {
    chart.curves = {exact_curve, old_form, repaired};
    outcome.figures = {
        {"behind-an-edge",
         "The published estimate, footprint of 25 wavelengths, against the Fresnel integral; the repaired law "
         "lies on it.",
         chart}};
  }
  return outcome;
}

/// Far in the shadow the weight of the published estimate integrates to ln 2 for every footprint.
Outcome weight_of_hits() {
  Outcome outcome;
  constexpr double wavelength = 0.3;
  for (const double sigma : {1.0, 2.0}) {
    // Probability of a hit and weight 1/P_A: ∫ φ(x)/Φ(x) over hits x > 0, φ the footprint's density.
    const Complex sum = integrate(
                            [&](double x) {
                              const PublishedFootprint footprint{sigma, 12};
                              return Complex(std::exp(-x * x / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * pi)) /
                                             power_on_obstacle(footprint, x));
                            },
                            0, 12 * sigma, 1e-14, 8)
                            .value;
    outcome.error = std::max(outcome.error, std::abs(sum.real() - std::log(2)));
  }
  outcome.note = fmt::format("10 lg ln 2 = {:.2f} dB at {} m", 10 * std::log10(std::log(2)), wavelength);
  return outcome;
}

}  // namespace

Cases published_cases() {
  const std::string integral = "Rayleigh-Sommerfeld integral, first kind";
  return {
      {"published/canonical/sum", "edge waves of a polygon, whole, summed: largest |error| over k A/2 pi",
       "Fraunhofer integral", "1", 1e-14, "the edges' poles 1/xi cancel to 1e-15/xi", 0, canonical_sum},
      {"published/canonical/powers", "power of an edge without its lobe (S2.33), largest relative error of I1, I2",
       "quadrature", "1", 1e-6, "what lies beyond zeta = 256 is extrapolated: 1e-7; S2.36 prints both too low", 0,
       edge_powers},
      {"published/canonical/tessellation", "power of an edge without lobes when cut in eight: change", "no change",
       "dB", 9.1, "a fact: the printed form depends on how a rim is cut, as 1/n: 9.03 dB", 8.9, tessellation},
      {"published/ring", "ring of 32 edges, N = 0.1, whole polygon: median |error of level|", integral, "dB", 0.1,
       "far field", 0, ring},
      {"published/ring-as-printed", "ring of 32 edges, N = 0.1, as printed: median |error of level|", integral, "dB",
       14, "a fact: 64 short edges, each without its lobe; 4 to 14 dB", 4,
       [] {
         return Outcome{median_error(printed, opening("ring", 30), 0.1), {}, {}};
       }},
      {"published/double-slit", "double slit, N = 0.1, whole polygon: median |error of level|", integral, "dB", 0.1,
       "far field", 0, double_slit},
      {"published/square", "square, N = 0.1, whole polygon: median |error of level|", integral, "dB", 0.1, "far field",
       0, square},
      {"published/edge/printed",
       "level behind a half-plane as printed, sigma = 25 wavelengths, v from 0.2 to 4: largest |error|",
       "Fresnel integral", "dB", 9, "a fact: -7 to +6 dB", 3, [] { return behind_an_edge(true); }},
      {"published/edge/repaired", "level behind a half-plane, repaired, v from 0.2 to 4: largest |error|",
       "Fresnel integral", "dB", 0.06, "0.006 dB up to v = 0.8, 0.04 dB at v = 4", 0,
       [] { return behind_an_edge(false); }},
      {"published/edge/weight", "weight of the hits as printed, summed over hits: |error| against ln 2",
       "ln 2, -1.59 dB", "1", 1e-10, "closed form: the integral of dP/P", 0, weight_of_hits},
  };
}

}  // namespace grimaldi
