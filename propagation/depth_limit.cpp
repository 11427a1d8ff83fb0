#include "propagation/depth_limit.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/edge_chain.h"
#include "propagation/edge_ends.h"
#include "propagation/fade.h"
#include "propagation/near_edges.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

constexpr double negligible = 1e-6;  ///< share of the power
constexpr double full_edge = 1.5;    ///< v up to which an edge beside a path counts wholly
constexpr double own_edge = 0.75;    ///< v up to which the path without one of its own edges arrives too

/// True if the plan has no room for one more edge on this path.
bool is_full(const Plan& plan, const Arrival& arrival) {
  return static_cast<int>(arrival.interactions.size()) >= plan.request.depth ||
         static_cast<int>(arrival.geometry.edge_count) >= most_edges(plan.request);
}

/// n: into how many paths the wave over one more edge is divided.
double parents_of(const Scene& scene, const PathGeometry& geometry, double wavelength) {
  double parents = 1;
  for (std::size_t e = 0; e < geometry.edge_count; ++e) {
    const EdgePassage& passage = geometry.edges[e];
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    if (!is_dark(wedge, passage, beyond_boundary(wedge, passage, Boundary::incident)))
      parents += fade(boundary_parameter(scene, passage, Boundary::incident, wavelength), own_edge);
  }
  return parents;
}

/// What the edge of `passage`, beside the path, leaves of it in a band if the path has that part of the edge's wave.
Complex left_by(const Scene& scene, const Plan& plan, const EdgePassage& passage, double detour, double part,
                double wavenumber) {
  const double wavelength = 2 * pi / wavenumber, q = std::sqrt(wavenumber * detour);
  EdgeTerm term{};
  term.wave = make_edge_wave(q);
  const EndWeights ends(scene.wedges.wedges[passage.wedge], passage, wavelength, wavenumber, plan.request.reflection);
  const double v = 2 * std::sqrt(detour / wavelength);
  return 1.0 - part * fade(v, full_edge) * term.wave.wave * ends.of(term) * std::polar(1.0, -q * q);
}

}  // namespace

std::vector<Complex> left_at_depth(const Scene& scene, const Plan& plan, const Vec3& source, const Vec3& point,
                                   double hair, std::span<const Arrival> arrivals) {
  const std::size_t bands = plan.bands();
  std::vector<Complex> left(arrivals.size() * bands, 1.0);
  if (most_edges(plan.request) == 0) return left;
  const double longest = 2 * pi / plan.wavenumber.front();
  double power = 0;
  for (const Arrival& arrival : arrivals) power += received_power(arrival.field[0], Polarisation::both);
  std::vector<Interaction> longer;
  PathGeometry geometry;
  for (std::size_t a = 0; a < arrivals.size(); ++a) {
    const Arrival& arrival = arrivals[a];
    if (!is_full(plan, arrival) || received_power(arrival.field[0], Polarisation::both) < negligible * power) continue;
    each_near_edge(scene, arrival.geometry, longest, 2 * full_edge, [&](std::size_t leg, std::uint32_t wedge) {
      longer.assign(arrival.interactions.begin(), arrival.interactions.end());
      longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(leg), edge_interaction(wedge));
      UnfoldedSequence unfolded(scene, source, longer, &plan.small_objects);
      if (!unfolded.possible() || !unfolded.solve(point, longest, geometry)) return;
      const EdgePassage& passage = geometry.edges[count_edges(std::span(longer).first(leg))];
      const Wedge& beside = scene.wedges.wedges[wedge];
      const double epsilon = beyond_boundary(beside, passage, Boundary::incident);
      const double turn = hair / passage.sin_beta * (1 / passage.s_in + 1 / passage.s_out);
      const bool dark = is_dark(beside, passage, epsilon);
      if (dark && (std::abs(epsilon) > turn || !passage.inside)) return;
      const double onward = fade(std::abs(epsilon), 0.25 * pi);
      const double detour = std::max(0.0, geometry.length - arrival.geometry.length);
      for (std::size_t band = 0; band < bands; ++band) {
        const double k = plan.wavenumber[band];
        const double part = onward / parents_of(scene, arrival.geometry, 2 * pi / k);
        left[a * bands + band] *= dark ? Complex(0) : left_by(scene, plan, passage, detour, part, k);
      }
    });
  }
  return left;
}

}  // namespace grimaldi
