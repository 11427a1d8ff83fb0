// What must be conserved: power of edges, openings and faces.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/laws/aperture.h"
#include "propagation/laws/edge_sampling.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/reflection.h"
#include "scenes/demo_city.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"
#include "validation/cases/opening.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

double integral(const std::function<double(double)>& f, double a, double b, double tolerance, int panels = 1) {
  return integrate([&](double x) { return Complex(f(x)); }, a, b, tolerance, panels).value.real();
}

/// ∫_0^∞ |U|² dv: to v = 1e4 in decades, the rest by its law 1/(2π²v²).
Outcome power_of_an_edge() {
  double sum = 0, from = 0;
  for (double to = 1; to <= 1e4; from = to, to *= 10)
    sum += integral([](double v) { return std::norm(edge_wave(v, true)); }, from, to, 1e-15, 8);
  sum += 1 / (2 * pi * pi * from);
  return {std::abs(sum * 2 * pi - 1), {}, {}};
}

/// Lit and shadow together: ∫ (|E|² − H) dv under a window that fades the fringes out.
Outcome balance_of_an_edge() {
  constexpr double full = 20, end = 60;
  const auto window = [](double v) { return v < full ? 1 : std::pow(std::cos(pi / 2 * (v - full) / (end - full)), 2); };
  const auto gain = [&](double v) {  // both sides at the distance v
    const Complex phase = std::polar(1.0, -pi / 2 * v * v);
    const double shadow = std::norm(edge_wave(v, true));
    const double lit = std::norm(1.0 + edge_wave(v, false) * phase) - 1;
    return window(v) * (shadow + lit);
  };
  // What the window takes from the two smooth tails 1/(2π²v²), one on each side.
  const double tail =
      2 * integral([&](double v) { return (1 - window(v)) / (2 * pi * pi * v * v); }, full, end, 1e-15, 8) +
      2 / (2 * pi * pi * end);
  const double sum = integral(gain, 0, end, 1e-13, 2000) + tail;
  return {std::abs(sum), "over the power of one side of the edge, 1/(2 pi), in units of v", {}};
}

Outcome shadow_of_an_edge() {
  // λ = 1, L = 1e6: the power per unit length over irradiance times r_F.
  const double distance = 1e6;
  double sum = 0, from = 0;
  for (double to = 1e-5; from < pi; from = to, to = std::min(to * 10, pi))
    sum += integral([&](double e) { return edge_power_density(distance, 1, 1, e); }, from, to,
                    1e-12 * std::sqrt(distance), 8);
  const double share = sum / std::sqrt(distance);
  return {std::abs(share / (boundary_power / 2) - 1),
          fmt::format("{:.6f} r_F, expected {:.6f}", share, boundary_power / 2),
          {}};
}

Outcome tail_of_an_edge() {
  Outcome outcome;
  for (const double v : {0.1, 0.5, 1.0, 2.0, 5.0}) {
    double sum = 0, from = v;
    for (double to = v + 1; to < 2e4; from = to, to *= 10)
      sum += integral([](double u) { return std::norm(edge_wave(u, true)); }, from, to, 1e-15, 8);
    sum += 1 / (2 * pi * pi * from);
    outcome.error = std::max(outcome.error, std::abs(2 * pi * sum - edge_tail(v)));
  }
  return outcome;
}

Outcome law_of_azimuths() {
  Outcome outcome;
  for (const double in : {0.2, 1.0, 2.2})
    for (const double distance : {10.0, 1e3}) {
      const EdgeSector sector{1.5 * pi, in, false, true};
      const AzimuthLaw law(sector, distance, 0.3, 0.8);
      // Kinks lie at the boundaries.
      std::vector<double> cuts = {0, sector.exterior_angle, in + pi, pi - in, 3 * pi - in - pi};
      for (double& cut : cuts) cut = std::clamp(cut, 0.0, sector.exterior_angle);
      std::sort(cuts.begin(), cuts.end());
      double sum = 0;
      for (std::size_t i = 1; i < cuts.size(); ++i)
        if (cuts[i] > cuts[i - 1])
          sum += integral([&](double phi) { return law.density(phi); }, cuts[i - 1], cuts[i], 1e-12, 64);
      outcome.error = std::max(outcome.error, std::abs(sum - 1));
    }
  return outcome;
}

/// Power through the plane behind an opening over the power that falls on the opening, by connected edges.
Outcome through_an_opening(const std::string& name, double size, double fresnel_number) {
  const Opening shape = opening(name, size);
  const double z = distance_of(size, fresnel_number), half = size / 2 + 12 * z / size;
  const int steps = 240;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps; ++k) {
      const Vec3 point{half * ((2 * i + 1.0) / steps - 1), half * ((2 * k + 1.0) / steps - 1), z};
      const double r = norm(point);
      // Flux through the plane: |u|² times the cosine of the direction from the opening.
      sum += std::norm(connected_field(shape, point)) * point.z / r;
    }
  sum *= std::pow(2 * half / steps, 2) / area(shape.aperture);
  return {std::abs(decibel(sum)), fmt::format("{:.4f} of the power arrives within the window", sum), {}};
}

/// ∫ |Rψ|² d²ξ = ∫ |φ|² d²q (Parseval), for a triangle whose amplitude vanishes on its rim but for one corner.
Outcome parseval() {
  // A hat: six triangles about a vertex of amplitude 1, 0 on the rim, so that the transform falls off as ξ^−3 and more.
  TriangleAperture hat;
  hat.vertices.push_back({0.1, -0.05}), hat.amplitudes.push_back(1.0);
  for (int i = 0; i < 6; ++i) {
    hat.vertices.push_back({std::cos(pi * i / 3 + 0.2), std::sin(pi * i / 3 + 0.2)});
    hat.amplitudes.push_back(0.0);
    hat.triangles.push_back({0, std::size_t(1 + i), std::size_t(1 + (i + 1) % 6)});
  }
  constexpr double k = 2 * pi * 1000;  // a small angle holds everything
  double sum = 0;
  constexpr int steps = 400;
  const double half = 40.0 / k;  // |κ| ≤ 40 rad per unit
  for (int i = 0; i < steps; ++i)
    for (int m = 0; m < steps; ++m)
      sum +=
          std::norm(aperture_field(hat, k, {half * ((2 * i + 1.0) / steps - 1), half * ((2 * m + 1.0) / steps - 1)}));
  sum *= std::pow(2 * half / steps, 2);
  return {std::abs(sum / aperture_power(hat) - 1),
          fmt::format("integral {:.6g}, power {:.6g}", sum, aperture_power(hat)),
          {}};
}

Outcome lossless_slab() {
  Outcome outcome;
  for (const double permittivity : {1.5, 4.0, 80.0})
    for (const double thickness : {0.0, 0.001, 0.03, 0.5})
      for (double cosine = 1e-6; cosine <= 1; cosine += 0.0499999) {
        const SlabCoefficients slab = slab_coefficients(permittivity, thickness, 2 * pi / 0.1, cosine);
        outcome.error =
            std::max({outcome.error, std::abs(std::norm(slab.reflection.te) + std::norm(slab.transmission.te) - 1),
                      std::abs(std::norm(slab.reflection.tm) + std::norm(slab.transmission.tm) - 1)});
      }
  return outcome;
}

Outcome flux_ledger() {
  const Scene scene = scene_of(scene_description("demo-city"));
  PlanDescription plan = point_to_point(WaveKind::radio, 3.5e9, demo_city_rooftop, 2e4);
  plan.depth = 3;
  add_receiver(plan, {20, 20, 1.5});
  const FluxLedger flux = run_engine(scene, plan).figures.flux;
  return {std::abs((flux.absorbed + flux.escaped + flux.cut_by_depth) / flux.launched - 1),
          fmt::format("absorbed {:.3f}, escaped {:.3f}, cut by depth {:.3f}", flux.absorbed, flux.escaped,
                      flux.cut_by_depth),
          {}};
}

/// Power through a plane behind a half-plane over the power that passes above its edge, in the engine. The plane ends
/// in a window that fades out over the far fringes.
Outcome behind_a_half_plane(DiffractionModel model, Polarisation polarisation) {
  const Scene scene = scene_of(scene_description("half-plane"), perfect_faces());
  PlanDescription plan = point_to_point(WaveKind::radio, 1e9, {-100, 0, 0});
  plan.transmitters[0].antenna.polarisation = polarisation;
  plan.diffraction_model = model;
  const double behind = 100, zone = std::sqrt(wavelength_of(plan) * 50), reach = 8 * zone;
  constexpr int steps = 600;
  std::vector<double> heights;
  for (int i = 0; i < steps; ++i) heights.push_back(reach * ((2 * i + 1.0) / steps - 1));
  for (const double z : heights) add_receiver(plan, {behind, 0, z});
  const Result result = run_engine(scene, plan);
  double arrived = 0, sent = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double beyond = std::max(0.0, std::abs(heights[i]) / reach - 0.5) * 2;
    const double window = std::pow(std::cos(pi / 2 * beyond), 2);
    arrived += window * result.profiles[i].total[0];
    if (heights[i] > 0) sent += window * free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position);
  }
  return {std::abs(arrived / sent - 1), fmt::format("{:.5f} of the power arrives", arrived / sent), {}};
}

}  // namespace

Cases energy_cases() {
  const std::string one = "1";
  Cases cases = {
      {"energy/edge/power", "power of one side of an edge, relative error", "closed form 1/(2 pi)", one, 1e-12,
       "quadrature to 1e-15 in decades, and the tail's next term 1e-8/v^2", 0, power_of_an_edge},
      {"energy/edge/balance", "what the lit side loses and the shadow gains, sum", "0", one, 1e-8,
       "fringes under a window that fades over 900 of them: 1e-9", 0, balance_of_an_edge},
      {"energy/edge/shadow", "power into the shadow per length over r_F, relative error", "0.11254 (closed form)", one,
       1e-6, "paraxial closed form at v up to 2800: 1/v^2", 0, shadow_of_an_edge},
      {"energy/edge/tail", "share of an edge's power beyond v, largest |error|", "quadrature", one, 1e-10,
       "1e-10 of the law, and the quadrature's own tail", 0, tail_of_an_edge},
      {"energy/edge/azimuths", "density of drawn azimuths about an edge, integral less 1", "1", one, 1e-10,
       "1e-10 of the law, quadrature over its kinks", 0, law_of_azimuths},
      {"energy/hat/parseval", "power of the far field over that of the amplitude, relative error", "Parseval's theorem",
       one, 2e-4, "the window holds |kappa| up to 40: the rest of a continuous amplitude falls as its square and more",
       0, parseval},
      {"energy/slab", "lossless slab, |R|^2 + |T|^2 less 1, largest of 252", "1", one, 1e-12,
       "1e-13 absolute of each coefficient", 0, lossless_slab},
      {"energy/engine/ledger", "demo city, flux absorbed, escaped and cut over that launched, less 1", "1", one, 1e-12,
       "sums of 2e4 beams of rounding 1e-16", 0, flux_ledger},
  };
  for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd})
    for (const Polarisation polarisation : {Polarisation::horizontal, Polarisation::vertical})
      cases.push_back(
          {fmt::format("energy/engine/half-plane/{}-{}", polarisation == Polarisation::vertical ? "hard" : "soft",
                       model == DiffractionModel::utd ? "utd" : "fsd"),
           "engine, power through a plane behind a half-plane over that above its edge, less 1", "1", one, 0.01,
           "the goal of 1 %; the window keeps all but the farthest fringes", 0,
           [=] { return behind_a_half_plane(model, polarisation); }});
  for (const double n : {3.0, 1.0, 0.3})
    cases.push_back(
        {fmt::format("energy/opening/N{:g}", n), "power behind a square opening of 30 wavelengths by connected edges",
         "power that falls on the opening", "dB", 0.2,
         "the window ends 12 lobes out (0.1 dB beyond); 0.1 dB for a black edge's obliquity near the screen", 0,
         [n] { return through_an_opening("square", 30, n); }});
  return cases;
}

}  // namespace grimaldi
