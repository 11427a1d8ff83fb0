// Perfectly reflecting wedges: UTD and the three black edges of the BSDF against exact fields.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/constants.h"
#include "propagation/laws/edge_sampling.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/utd.h"
#include "validation/cases/families.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

constexpr double degree = pi / 180;

double level(const Complex& field) { return 20 * std::log10(std::abs(field)); }

/// Largest error of UTD over incidences 5°, 25° … and directions 2.5°, 7.5° … about the wedge.
Outcome utd_error(double exterior, double k_rho, bool soft) {
  Outcome outcome;
  double where_in = 0, where = 0;
  for (double in = 5; in < exterior; in += 20)
    for (double phi = 2.5; phi < exterior; phi += 5) {
      const WedgeTotal ours = utd_plane_wave(exterior, k_rho, in, phi, 180);
      const WedgeField truth = wedge_plane_wave(exterior / 180, k_rho, phi * degree, in * degree);
      const double error = soft ? std::abs(ours.soft - truth.soft) : std::abs(ours.hard - truth.hard);
      if (!(error <= outcome.error)) outcome.error = error, where_in = in, where = phi;
    }
  outcome.note = fmt::format("largest at phi' = {:g}, phi = {:g} degrees", where_in, where);
  return outcome;
}

/// Field in the shadow of a wedge by three black edges: the incident wave and its images in the faces.
Complex black_edges(double exterior, double k_rho, double in, double phi, bool soft) {
  const EdgeSector sector{exterior * degree, in * degree, exterior == 360, true};
  const auto waves = sector_waves(sector, k_rho / (2 * pi), 1, 1, phi * degree);
  const double sign = soft ? -1 : 1;
  return (waves[0] + sign * (waves[1] + waves[2])) * std::polar(1.0, -k_rho);
}

Outcome black_error(double exterior, double k_rho, bool soft) {
  std::vector<double> errors;
  for (double in = 5; in < 90; in += 10)
    for (double phi = in + 182.5; phi < exterior; phi += 2.5) {
      const WedgeField truth = wedge_plane_wave(exterior / 180, k_rho, phi * degree, in * degree);
      errors.push_back(
          std::abs(level(black_edges(exterior, k_rho, in, phi, soft)) - level(soft ? truth.soft : truth.hard)));
    }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2],
          fmt::format("largest {:.3g} dB of {} directions; incidence 5 to 85 degrees from a face", errors.back(),
                      errors.size()),
          {}};
}

/// Point source and receiver before a wedge, rays at 45° to the edge: phases and spreading of spherical waves.
Outcome point_source_error(double exterior, bool soft) {
  constexpr double k = 2 * pi, rho = 30;  // wavelengths
  const double n = exterior / 180;
  std::vector<double> errors;
  for (double in = 20; in < 170; in += 30)
    for (double phi = in + 190; phi < exterior - 4; phi += 10) {
      const EdgePoint source{rho, in * degree, -rho}, receiver{rho, phi * degree, rho};
      const WedgeField exact = wedge_point_source(n, k, source, receiver);
      const double leg = rho * std::sqrt(2.0), sin_beta = std::sqrt(0.5);
      const double distance = leg * leg / (2 * leg) * sin_beta * sin_beta;
      const WedgeTerms d = utd_coefficients(exterior * degree, in * degree, phi * degree, sin_beta, k,
                                            {distance, distance, distance, distance});
      const Complex incident = std::polar(1 / leg, -std::fmod(k * leg, 2 * pi));
      const Complex field = incident * (soft ? d.soft() : d.hard()) * std::sqrt(leg / (leg * 2 * leg)) *
                            std::polar(1.0, -std::fmod(k * leg, 2 * pi));
      errors.push_back(std::abs(level(field) - level(soft ? exact.soft : exact.hard)));
    }
  std::sort(errors.begin(), errors.end());
  return {errors.back(),
          fmt::format("median {:.2g} dB of {} directions in shadow", errors[errors.size() / 2], errors.size()),
          {}};
}

Figure wedge_figure(double exterior, double in, double k_rho, bool soft) {
  const char* condition = soft ? "soft" : "hard";
  LineChart chart;
  chart.title = fmt::format("{} wedge, {:g}° of free space, plane wave from {:g}°, kρ = {:g}", soft ? "Soft" : "Hard",
                            exterior, in, k_rho);
  chart.x_name = "direction φ, degrees from the lit face";
  chart.y_name = "total field, dB";
  chart.low = -45, chart.high = 10;
  Curve exact{"exact", {}, {}}, utd{"UTD", {}, {}}, black{"three black edges (BSDF)", {}, {}};
  for (double phi = 0.25; phi < exterior; phi += 0.25) {
    const WedgeField truth = wedge_plane_wave(exterior / 180, k_rho, phi * degree, in * degree);
    const WedgeTotal ours = utd_plane_wave(exterior, k_rho, in, phi, 180);
    for (Curve* curve : {&exact, &utd, &black}) curve->x.push_back(phi);
    exact.y.push_back(level(soft ? truth.soft : truth.hard));
    utd.y.push_back(level(soft ? ours.soft : ours.hard));
    black.y.push_back(phi > in + 180 ? level(black_edges(exterior, k_rho, in, phi, soft)) : NAN);
  }
  chart.curves = {exact, utd, black};
  return {fmt::format("wedge-{:g}-{}", exterior, condition),
          soft ? "UTD lies on the exact field. The three black edges of the BSDF, drawn in the shadow, miss the soft "
                 "field near "
                 "the dark face, where it must vanish."
               : "UTD lies on the exact field; in the shadow so do the three black edges of the BSDF, but for their "
                 "weights.",
          chart};
}

}  // namespace

Cases wedge_cases() {
  Cases cases;
  const char* exact = "exact field of eigenfunctions or contour integral";
  for (const bool soft : {true, false})
    for (const double exterior : {360.0, 300.0, 270.0, 225.0})
      for (const double k_rho : {1.0, 10.0, 100.0, 1000.0}) {
        const bool half_plane = exterior == 360;
        cases.push_back({fmt::format("wedges/utd/{:g}/{}/k-rho-{:g}", exterior, soft ? "soft" : "hard", k_rho),
                         "UTD, total field of a plane wave: largest |error| over all directions, incident amplitude 1",
                         exact, "1", half_plane ? 1e-14 * (1 + k_rho) : 0.06 / k_rho,
                         half_plane
                             ? "exact for the half-plane: rounding, 1e-14 (1 + k rho)"
                             : "what UTD leaves out is of order (k rho)^-3/2 in each direction, of order 1/(k rho) "
                               "next to its boundaries; 0.06 measured at 225 degrees",
                         0, [=] { return utd_error(exterior, k_rho, soft); }});
      }
  for (const bool soft : {false, true})
    for (const double exterior : {360.0, 300.0, 270.0, 225.0}) {
      const bool half_plane = exterior == 360;
      cases.push_back({fmt::format("wedges/black-edges/{:g}/{}", exterior, soft ? "soft" : "hard"),
                       "three black edges (BSDF of a wedge), k rho = 100: median |error of level| in the shadow", exact,
                       "dB",
                       half_plane ? 1e-9
                       : soft     ? 8.0
                                  : 1.2,
                       half_plane ? "exact for the half-plane, one mirror"
                       : soft ? "a fact: near grazing the soft field vanishes, its three terms do not; UTD is for that"
                              : "the terms' own weights at n < 2; 0.1 to 0.8 dB expected",
                       half_plane ? 0.0
                       : soft     ? 2.0
                                  : 0.0,
                       [=] {
                         Outcome outcome = black_error(exterior, 100, soft);
                         if (exterior == 270) outcome.figures = {wedge_figure(exterior, 40, 100, soft)};
                         return outcome;
                       }});
    }
  for (const bool soft : {false, true})
    cases.push_back(
        {fmt::format("wedges/point-source/270/{}", soft ? "soft" : "hard"),
         "UTD, point source 42 wavelengths from the edge, rays at 45 degrees to it: largest |error of level| in "
         "the shadow",
         exact, "dB", 0.02, "what UTD leaves out, of order (kL)^-3/2", 0,
         [=] { return point_source_error(270, soft); }});
  cases.push_back({"wedges/same-law", "repaired BSDF and UTD on a thin screen: largest difference of the edge's wave",
                   "each other (n = 2)", "1", 2e-13,
                   "the same law written twice: rounding of the angle, 2 ulp of 2 pi, times sqrt(k L/2)", 0, [] {
                     Outcome outcome;
                     for (double kl = 1e-3; kl < 1e7; kl *= 7)
                       for (double in = 0.1; in < 2 * pi; in += 0.4)
                         for (double phi = 0.05; phi < 2 * pi; phi += 0.15) {
                           const WedgeTerms utd = wedge_waves(2 * pi, in, phi, {kl, kl, kl, kl});
                           const double turn = std::abs(phi - in) - pi;
                           const Complex edge = edge_wave(fresnel_parameter(kl / (2 * pi), 1, 1, turn), turn >= 0);
                           outcome.error = std::max(outcome.error, std::abs(utd.term[0] + utd.term[1] - edge));
                         }
                     return outcome;
                   }});
  return cases;
}

}  // namespace grimaldi
