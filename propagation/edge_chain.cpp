#include "propagation/edge_chain.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/edge_model.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/utd.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// K = C⁻¹ by Gauss and Jordan; C is positive definite. Returns det K.
double invert(std::array<std::array<double, max_edges>, max_edges>& c, std::size_t n) {
  double determinant = 1;
  for (std::size_t p = 0; p < n; ++p) {
    const double pivot = c[p][p], inverse = 1 / pivot;
    determinant *= inverse;
    c[p][p] = 1;
    for (std::size_t j = 0; j < n; ++j) c[p][j] *= inverse;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == p) continue;
      const double factor = c[i][p];
      c[i][p] = 0;
      for (std::size_t j = 0; j < n; ++j) c[i][j] -= factor * c[p][j];
    }
  }
  return determinant;
}

constexpr double nearly_one = 1 - 1e-12;  ///< of couplings

/// True if the azimuth of a way of length s from the edge runs along its face `patch`.
bool along_face(const Wedge& wedge, std::uint32_t patch, double azimuth, double s) {
  const double grazing = 5e-3 / s;  // rad; edges lie on their face to the millimetres of a patch's plane
  return (patch == wedge.patch0 && azimuth < grazing) ||
         (patch == wedge.patchn && azimuth > wedge.exterior_angle - grazing);
}

}  // namespace

double beyond_boundary(const Wedge& wedge, const EdgePassage& passage, Boundary boundary) {
  const double sum = passage.phi_in + passage.phi_out;
  switch (boundary) {
    case Boundary::incident:
      return std::min(std::abs(passage.phi_in - passage.phi_out) - pi, pi);
    // The two sides of a thin screen are one mirror: its image wave has one edge term, not two (Sommerfeld).
    case Boundary::face0:
      return std::min(wedge.free_rim ? std::min(sum, 4 * pi - sum) - pi : sum - pi, pi);
    case Boundary::facen:
      return std::min(2 * wedge.exterior_angle - sum - pi, pi);
  }
  return pi;
}

bool is_dark(const Wedge& wedge, const EdgePassage& passage, double epsilon) {
  constexpr double rounding = 1e-9;  // rad
  if (std::abs(epsilon) > rounding) return epsilon > 0;
  const auto [least, most] = std::minmax(passage.phi_in, passage.phi_out);
  return !wedge.free_rim && (least < rounding || most > wedge.exterior_angle - rounding);
}

double boundary_parameter(const Scene& scene, const EdgePassage& passage, Boundary boundary, double wavelength) {
  // The transition region of an edge in a chain is that of the legs next to it.
  const double effective = passage.s_in * passage.s_out / (passage.s_in + passage.s_out);
  return fresnel_parameter(effective, wavelength, passage.sin_beta,
                           beyond_boundary(scene.wedges.wedges[passage.wedge], passage, boundary));
}

EdgeChain edge_chain(const Scene& scene, std::span<const Interaction> interactions, const PathGeometry& geometry) {
  EdgeChain chain;
  const std::size_t n = geometry.edge_count;
  const auto& edges = geometry.edges;
  std::array<double, max_edges> before{}, behind{};  // a_i, b_i
  before[0] = edges[0].s_in;
  behind[n - 1] = edges[n - 1].s_out;
  for (std::size_t i = 1; i < n; ++i) {
    before[i] = before[i - 1] + edges[i].s_in;
    behind[n - 1 - i] = behind[n - i] + edges[n - i].s_in;
  }
  const double whole = before[0] + behind[0];
  if (n == 1) {
    chain.amplitude = 1 / whole;
    chain.distance[0] = before[0] * behind[0] / whole;
    return chain;
  }
  // φ̂ of the edges passed, carried along the ray: for each its cosine with φ̂ of every later edge.
  std::array<std::array<double, max_edges>, max_edges> cosine{};
  std::array<Vec3, max_edges> carried;
  Vec3 way_along{};  // of two edges the first's direction, carried too
  std::size_t passed = 0;
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    if (!is_edge(interactions[i])) {
      const Vec3& normal = scene.patches.patches[interactions[i]].normal;
      for (std::size_t e = 0; e < passed; ++e) carried[e] -= 2 * dot(carried[e], normal) * normal;
      way_along -= 2 * dot(way_along, normal) * normal;
      continue;
    }
    const Vec3& direction = scene.wedges.wedges[edges[passed].wedge].direction;
    const Vec3 to = geometry.points[i + 2] - geometry.points[i + 1];
    if (passed + 1 == n && n == 2) {
      // Only φ̂ is asked for, and of the way here alone.
      const Vec3 phi = normalized(cross(direction, geometry.points[i + 1] - geometry.points[i]));
      cosine[0][1] = dot(carried[0], phi);
      chain.end_coupling = {dot(way_along, phi) / edges[0].sin_beta, dot(carried[0], direction) / edges[1].sin_beta};
      break;
    }
    const ConeFrame out(direction, normalized(to));
    if (passed > 0) {
      const ConeFrame in(direction, normalized(geometry.points[i + 1] - geometry.points[i]));
      for (std::size_t e = 0; e < passed; ++e) {
        const double along = cosine[e][passed] = dot(carried[e], in.phi);
        carried[e] = along * out.phi + dot(carried[e], in.beta) * out.beta;
      }
    }
    way_along = direction;
    carried[passed++] = out.phi;
  }
  if (n == 2) {
    const double c = std::clamp(cosine[0][1], -1.0, 1.0);
    const double w2 = before[0] * behind[1] / (before[1] * behind[0]);
    // 1 − w² cos²χ without the difference of near numbers.
    const double rest = edges[1].s_in * whole / (before[1] * behind[0]) + w2 * (1 - c) * (1 + c);
    chain.amplitude = std::sqrt(rest) / whole;
    chain.distance[0] = before[0] * behind[0] / whole * rest;
    chain.distance[1] = before[1] * behind[1] / whole * rest;
    chain.coupling[0] = c * std::sqrt(w2);
    for (double& w : chain.end_coupling) w = std::clamp(w * std::sqrt(w2), -nearly_one, nearly_one);
    return chain;
  }
  std::array<std::array<double, max_edges>, max_edges> k{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j)
      k[i][j] = k[j][i] = before[i] * behind[j] / whole * (i == j ? 1 : std::clamp(cosine[i][j], -1.0, 1.0));
  double share = invert(k, n);
  for (std::size_t i = 0; i < n; ++i) {
    share *= chain.distance[i] = 1 / k[i][i];
    chain.width[i] = std::sqrt(std::max(1.0, before[i] * behind[i] / whole * k[i][i]));
  }
  for (std::size_t i = 0; i + 1 < n; ++i)
    chain.coupling[i] =
        std::clamp(-k[i][i + 1] * std::sqrt(chain.distance[i] * chain.distance[i + 1]), -nearly_one, nearly_one);
  chain.amplitude = std::sqrt(std::max(0.0, share)) / whole;
  return chain;
}

EdgeTerms edge_terms(DiffractionModel model, bool faces, const Wedge& wedge, const EdgePassage& passage,
                     double distance, double wavenumber) {
  EdgeTerms terms;
  const double phase = wavenumber * distance * passage.sin_beta * passage.sin_beta;
  const double utd = utd_share(model, wedge.length, passage, 2 * pi / wavenumber);
  double share = utd;
  bool black = false;
  const auto add = [&](const WedgeFactors& factors, bool dark, double lit_out, double lit_in, Boundary boundary) {
    terms.term[terms.count++] = {make_edge_wave(factors.argument),
                                 dark ? 1.0 : -1.0,
                                 share * factors.plain,
                                 share * factors.slope,
                                 lit_out,
                                 lit_in,
                                 boundary,
                                 black};
  };
  if (utd > 0) {
    const double n = wedge.exterior_angle / pi;
    const auto turns = wedge_turns(wedge.exterior_angle, passage.phi_in, passage.phi_out);
    // The two sides of a thin screen are one mirror.
    const Boundary boundaries[4] = {Boundary::incident, Boundary::incident,
                                    wedge.free_rim ? Boundary::face0 : Boundary::facen, Boundary::face0};
    constexpr double lit_out[4] = {1, -1, 1, -1}, lit_in[4] = {-1, 1, 1, -1};
    for (std::size_t i = 0; i < 4; ++i)
      add(wedge_factors(n, phase, turns[i]), is_dark(wedge, passage, turns[i]), lit_out[i], lit_in[i], boundaries[i]);
  }
  if (utd == 1) return terms;
  share = 1 - utd;
  black = true;
  const auto add_black = [&](Boundary boundary, double lit_out, double lit_in) {
    const double epsilon = beyond_boundary(wedge, passage, boundary);
    const double half = 0.5 * std::abs(epsilon);
    add({std::sqrt(2 * phase) * std::sin(half), 1, std::cos(half)}, is_dark(wedge, passage, epsilon), lit_out, lit_in,
        boundary);
  };
  const double turn = passage.phi_out > passage.phi_in ? -1 : 1;
  add_black(Boundary::incident, turn, -turn);
  if (!faces) return terms;
  const double side = wedge.free_rim && passage.phi_in + passage.phi_out > 2 * pi ? 1 : -1;
  add_black(Boundary::face0, side, side);
  if (!wedge.free_rim) add_black(Boundary::facen, 1, 1);
  return terms;
}

Complex pair_wave(const EdgeTerm& first, const EdgeTerm& second, double coupling) {
  const double slopes = first.slope * second.slope * first.sign * second.sign;
  return first.value() * second.value() +
         slopes * double_edge_excess(first.wave, second.wave, signed_coupling(first, second, coupling));
}

/// Displacements of the apertures count towards the lit side: out along φ̂ of the first, of the source of the second
/// against its φ̂. A lit term is that of the other side of its edge.
double signed_coupling(const EdgeTerm& first, const EdgeTerm& second, double coupling) {
  return -coupling * first.lit_out * second.lit_in * first.sign * second.sign;
}

std::uint32_t grazed_face(const Scene& scene, const EdgePassage& before, const EdgePassage& here) {
  const Wedge& first = scene.wedges.wedges[before.wedge];
  const Wedge& second = scene.wedges.wedges[here.wedge];
  for (const std::uint32_t patch : {first.patch0, first.patchn})
    if ((patch == second.patch0 || patch == second.patchn) &&
        (along_face(first, patch, before.phi_out, before.s_out) || along_face(second, patch, here.phi_in, here.s_in)))
      return patch;
  return no_index;
}

}  // namespace grimaldi
