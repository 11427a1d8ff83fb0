// One and two knife edges, and the half-plane through the whole engine.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/special_functions.h"
#include "propagation/laws/free_space_diffraction.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"
#include "validation/knife_edge.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// The z of a receiver at x = behind whose path over the edge (along y at x = z = 0) from (−before, 0, 0) has v =
/// ±2√(detour/λ).
double height_for(double v, double before, double behind, double wavelength) {
  const double detour = v * v * wavelength / 4;
  double low = 0, high = behind;
  for (int i = 0; i < 200; ++i) {
    const double z = 0.5 * (low + high);
    const double here = before + std::hypot(behind, z) - std::hypot(before + behind, z);
    (here < detour ? low : high) = z;
  }
  return v > 0 ? -low : low;
}

struct Link {
  const char* name;
  WaveKind kind;
  double frequency, before, behind;  ///< Hz, m
};

/// Levels of the engine behind the half-plane without reflection, against the Fresnel integral.
Outcome black_half_plane(const Link& link) {
  const Scene scene = scene_of(scene_description("half-plane"));
  PlanDescription plan = point_to_point(link.kind, link.frequency, {-link.before, 0, 0});
  plan.reflection = false;
  const double wavelength = wavelength_of(plan);
  std::vector<double> levels;
  for (double v = -2.8; v <= 4.01; v += 0.2) levels.push_back(v + 1e-3);
  for (const double v : levels)
    add_receiver(plan, {link.behind, 0, height_for(v, link.before, link.behind, wavelength)});
  const Result result = run_engine(scene, plan);
  LineChart chart;
  chart.title = fmt::format("Half-plane through the engine: {}, {:g} Hz, {:g} m and {:g} m",
                            link.kind == WaveKind::radio ? "radio" : "sound", link.frequency, link.before, link.behind);
  chart.x_name = "Fresnel parameter v (> 0 in shadow)";
  chart.y_name = "level over free space, dB";
  chart.low = -30, chart.high = 5;
  Curve truth{"Fresnel integral", {}, {}}, engine{"engine", {}, {}};
  Outcome outcome;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double exact = decibel(std::norm(exact_knife_edge(levels[i])));
    const double here = decibel(result.profiles[i].total[0] /
                                free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position));
    const double error = std::abs(here - exact);
    if (!(error <= outcome.error))
      outcome.error = error, outcome.note = fmt::format("largest at v = {:.2f}", levels[i]);
    truth.x.push_back(levels[i]), truth.y.push_back(exact);
    engine.x.push_back(levels[i]), engine.y.push_back(here);
  }
  chart.curves = {truth, engine};
  outcome.figures = {
      {fmt::format("half-plane-{}", link.name),
       "A mesh of a half-plane, traced, connected and summed, against the Fresnel integral of a black edge.", chart}};
  return outcome;
}

/// The same with reflection: hard or soft, against the exact field of a point source.
Outcome perfect_half_plane(const Link& link, bool soft, DiffractionModel model) {
  const Scene scene = scene_of(scene_description("half-plane"), perfect_faces());
  PlanDescription plan = point_to_point(link.kind, link.frequency, {-link.before, 0, 0});
  plan.transmitters[0].antenna.polarisation = soft ? Polarisation::horizontal : Polarisation::vertical;
  plan.diffraction_model = model;
  const double wavelength = wavelength_of(plan), k = 2 * pi / wavelength;
  const std::vector<double> levels = {0.05, 0.3, 0.8, 1.5, 2.5, 4};
  for (const double v : levels)
    add_receiver(plan, {link.behind, 0, height_for(v, link.before, link.behind, wavelength)});
  const Result result = run_engine(scene, plan);
  Outcome outcome;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    // About the edge from the lit face: the screen hangs down from it, the source stands at 90°.
    const Vec3& r = plan.receivers[i].position;
    const EdgePoint source{link.before, pi / 2, 0}, receiver{std::hypot(r.x, r.z), 1.5 * pi + std::atan2(-r.z, r.x), 0};
    const WedgeField exact = wedge_point_source(2, k, source, receiver);
    const double air = link.kind == WaveKind::radio ? 0 : -decibel(free_gain(plan, {}, {0, 0, 1}) * 4 * pi);
    const double way = distance(plan.transmitters[0].position, r);
    const double expected = decibel(std::norm(soft ? exact.soft : exact.hard) * way * way);
    const double here = decibel(result.profiles[i].total[0] / free_gain(plan, plan.transmitters[0].position, r));
    // The engine's air acts over the way round the edge, the reference has none.
    const double detour = link.before + receiver.rho - way;
    const double error = std::abs(here + air * detour - expected);
    if (!(error <= outcome.error)) outcome.error = error, outcome.note = fmt::format("largest at v = {:g}", levels[i]);
  }
  return outcome;
}

/// Product of single-edge waves over two edges against the exact double integral: what a chain of edges costs.
Outcome product_of_two(const DoubleKnifeEdge& edges) {
  const auto& [wavelength, d1, d2, d3, h1, h2] = edges;
  // Heights over the line source → edge 2, and over edge 1 → receiver: each edge as its neighbour sees it.
  const double v1 = (h1 - h2 * d1 / (d1 + d2)) * std::sqrt(2 / wavelength * (1 / d1 + 1 / d2));
  const double v2 = (h2 - h1 * d3 / (d2 + d3)) * std::sqrt(2 / wavelength * (1 / d2 + 1 / d3));
  const double spread = std::sqrt((d1 + d2) * (d2 + d3) / (d2 * (d1 + d2 + d3)));
  const auto wave = [](double v) { return std::abs(edge_wave(std::abs(v), true)); };
  const double ours = 20 * std::log10(wave(v1) * wave(v2) / spread);
  const double exact = -diffraction_loss(exact_double_knife_edge(edges));
  return {std::abs(ours - exact), fmt::format("exact {:.2f} dB, product {:.2f} dB", exact, ours), {}};
}

}  // namespace

Cases knife_edge_cases() {
  Cases cases;
  cases.push_back({"knife-edges/one", "field behind a black edge, v from -30 to 30: largest |error|",
                   "Fresnel integral by quadrature on a rotated ray", "1", 5e-14,
                   "1e-14 of the kernel, 2e-16 v^2 of the reference times the field", 0, [] {
                     Outcome outcome;
                     for (double v = -30; v <= 30; v += 0.0625)
                       outcome.error = std::max(outcome.error, std::abs(knife_edge(v) - exact_knife_edge(v)));
                     return outcome;
                   }});
  cases.push_back({"knife-edges/edge-wave", "lit part and edge wave, v from 0 to 30: largest |error|",
                   "Fresnel integral by quadrature on a rotated ray", "1", 5e-14,
                   "1e-14 of the kernel, 2e-16 v^2 of the reference times the field", 0, [] {
                     Outcome outcome;
                     for (double v = 0; v <= 30; v += 0.0625) {
                       const Complex phase = std::polar(1.0, -pi / 2 * v * v);
                       outcome.error =
                           std::max({outcome.error, std::abs(edge_wave(v, true) * phase - exact_knife_edge(v)),
                                     std::abs(1.0 + edge_wave(v, false) * phase - exact_knife_edge(-v))});
                     }
                     return outcome;
                   }});
  const struct {
    const char* name;
    DoubleKnifeEdge edges;
    double least, most;
    const char* reason;
  } pairs[] = {
      {"far-apart",
       {0.125, 5000, 5000, 5000, 60, 60},
       0,
       0.5,
       "each edge far outside the transition region of the other: 0.5 dB of its tail"},
      {"equal-heights",
       {0.125, 200, 50, 300, 2, 2},
       1.5,
       12,
       "a fact: the second edge lies in the transition region of the first, where a product of waves fails"},
      {"close",
       {0.125, 200, 5, 300, 4, 4},
       1.5,
       12,
       "a fact: the second edge lies in the transition region of the first, where a product of waves fails"},
  };
  for (const auto& pair : pairs)
    cases.push_back({fmt::format("knife-edges/two/{}", pair.name),
                     "two edges as a product of single-edge waves: |error of level|", "exact double knife edge", "dB",
                     pair.most, pair.reason, pair.least, [edges = pair.edges] { return product_of_two(edges); }});
  const struct {
    Link link;
    double tolerance;
    const char* reason;
  } links[] = {
      {{"radio-100-100", WaveKind::radio, 1e9, 100, 100},
       0.06,
       "the law's own angle (Keller against paraxial): 0.04 dB at v = 4, and 0.01 dB of the fringes on the lit side"},
      {{"radio-1000-100", WaveKind::radio, 1e9, 1000, 100},
       0.06,
       "the law's own angle (Keller against paraxial): 0.04 dB at v = 4, and 0.01 dB of the fringes on the lit side"},
      {{"sound-20-20", WaveKind::acoustic, 500, 20, 20},
       0.5,
       "at v = 4 the ray bends by 35 degrees: the paraxial truth itself is 0.4 dB off"},
  };
  for (const auto& one : links)
    cases.push_back({fmt::format("knife-edges/engine/black/{}", one.link.name),
                     "half-plane as a mesh, no reflection: largest |error of level| for v from -2.8 to 4",
                     "Fresnel integral by quadrature on a rotated ray", "dB", one.tolerance, one.reason, 0,
                     [link = one.link] { return black_half_plane(link); }});
  for (const auto& one : links)
    for (const bool soft : {false, true}) {
      if (soft && one.link.kind == WaveKind::acoustic) continue;
      for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd})
        cases.push_back({fmt::format("knife-edges/engine/{}/{}{}", soft ? "soft" : "hard", one.link.name,
                                     model == DiffractionModel::utd ? "/utd" : ""),
                         "half-plane as a mesh, perfect faces: largest |error of level| for v from 0.05 to 4",
                         "exact field of a point source at a half-plane", "dB", 0.05,
                         "exact law; 0.02 dB for a source and a receiver at finite distance", 0,
                         [link = one.link, soft, model] { return perfect_half_plane(link, soft, model); }});
    }
  return cases;
}

}  // namespace grimaldi
