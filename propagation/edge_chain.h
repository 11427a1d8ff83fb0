#pragma once
// The edges of one path as a chain: how the wave spreads over them, which terms each has and how neighbours couple.

#include <array>
#include <complex>
#include <cstddef>
#include <span>

#include "propagation/fermat.h"
#include "propagation/laws/double_edge.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The three boundaries of an edge's wave: incident shadow, reflection at face 0, at face n.
enum class Boundary { incident, face0, facen };

/// ε beyond a boundary: > 0 on its dark side, capped at π, rad.
double beyond_boundary(const Wedge& wedge, const EdgePassage& passage, Boundary boundary);

/// True if a turn ε beyond a boundary of this passage is on its dark side. On the boundary to within the rounding of
/// azimuths: lit, but dark if a way runs along a face of a solid, where the wave and its image are one. All places ask
/// here.
bool is_dark(const Wedge& wedge, const EdgePassage& passage, double epsilon);

/// Unit vectors along and across the edge's cone for a wave of direction k: φ̂ = ê × k/|ê × k|, β̂ = φ̂ × k. Turned about
/// the edge as k is.
struct ConeFrame {
  Vec3 phi, beta;
  ConeFrame(const Vec3& edge, const Vec3& k) : phi(normalized(cross(edge, k))), beta(cross(phi, k)) {}
};

/// How a wave spreads over the edges of a path.
struct EdgeChain {
  double amplitude = 0;                          ///< of the product of the edges' waves, source of unit strength, 1/m
  std::array<double, max_edges> distance{};      ///< L of each edge, m, without sin²β
  std::array<double, max_edges - 1> coupling{};  ///< w of edges i and i+1; its sign goes with φ̂ of both
};

/// Formula: the wave over N edges is the Gaussian integral over N apertures, its displacements along the edges
/// integrated out: covariance C_ij = a_i b_j cos χ_ij/D (i ≤ j), a_i the way from the source to edge i, b_j that from
/// edge j to the receiver, D the whole, χ_ij the angle between the edges' φ̂, carried along the ray (turned about the
/// edges, mirrored in the faces). With K = C⁻¹: L_i = 1/K_ii, w_i = −K_{i,i+1} √(L_i L_{i+1}), amplitude
/// √(det K ∏ L_i)/D. One edge: L = s s'/(s+s'), 1/D. The product of waves with these L and this amplitude is, outside
/// the transition regions, that of the astigmatic radii (Kouyoumjian & Pathak 1974, eqs. 31 to 35); exchange of the
/// ends changes nothing. Source: own; paraxial wave between apertures. Inputs: a path with an edge or more.
EdgeChain edge_chain(const Scene& scene, std::span<const Interaction> interactions, const PathGeometry& geometry);

/// One term of an edge's wave: ± plain · U(q).
struct EdgeTerm {
  EdgeWave wave;
  double sign;          ///< + on the dark side of its boundary
  double plain, slope;  ///< WedgeFactors, 1 and cos(ε/2) of a black edge; times the share of the model
  double lit_out;       ///< ±1: the azimuth φ of the way on grows towards the lit side, or not
  double lit_in;        ///< the same for φ' of the way here
  Boundary boundary;
  std::complex<double> value() const { return sign * plain * wave.wave; }
};

/// Terms of an edge's wave at the most: four of `utd` and three of `fsd`, where `auto` mixes both.
inline constexpr std::size_t max_terms = 7;

struct EdgeTerms {
  std::array<EdgeTerm, max_terms> term;
  std::size_t count = 0;
  const EdgeTerm* begin() const { return term.data(); }
  const EdgeTerm* end() const { return term.data() + count; }
};

/// Terms of a passage. `utd`: four; `fsd`: the incident one and, with faces, the images in both (one of a thin screen);
/// `auto`: both, each times its share (utd_share). A mix of fields is linear in the terms, in a chain of edges too.
/// `distance` L, m, without sin²β. Which side of a boundary: `is_dark`.
EdgeTerms edge_terms(DiffractionModel model, bool faces, const Wedge& wedge, const EdgePassage& passage,
                     double distance, double wavenumber);

/// Wave of term `first` of one edge and `second` of the next: the product of the two, and what the coupling adds, by
/// their slopes.
std::complex<double> pair_wave(const EdgeTerm& first, const EdgeTerm& second, double coupling);

/// What a wave is when it has passed an edge of a chain of three and more.
template <typename Amplitude>
struct ChainWave {
  Amplitude whole;   ///< all of it
  Amplitude plain;   ///< without what the coupling with the edge before added
  Amplitude moment;  ///< that, weighted with the displacement at this edge
};

/// From a chain's edge to the next: factors of what the wave is there.
struct ChainStep {
  std::complex<double> plain;         ///< of `whole`: the next edge's own wave
  std::complex<double> excess;        ///< of `plain`: what the coupling adds
  std::complex<double> linked;        ///< of `moment`: what it adds to what the coupling before added
  std::complex<double> moment;        ///< of `plain`: `excess` with its moment
  std::complex<double> moment_again;  ///< of `moment`: `linked` with its moment
};

/// The first two edges of a chain of three and more; `linked` is 0.
ChainStep first_step(const EdgeTerm& first, const EdgeTerm& second, double coupling);

/// From edge to edge in a chain of three and more, in factors of what came out of `first`, itself included. Formula:
/// the Gaussian integral over the apertures 1, 2, 3 by powers m and n of the couplings 12 and 23 is Σ (2jw₁₂)^m/m!
/// (2jw₂₃)ⁿ/n! I_m(q₁) I_{m+n}(q₂) I_n(q₃). All terms with m = 0 or n = 0 are taken whole, and Σ_{m,n≥1} as D₁₂
/// D₂₃/I₂(q₂) with the moments D = Σ_{n≥1} (2jw)ⁿ/n! I_n I_{n+1}(q₂): all terms with m = 1 or n = 1 are then right. A
/// slope counts four times the plain factor at the most. Source: own. Valid: the same with the ends exchanged. Error:
/// of I_{m+n} for m = n = 2 at q₂ = 0 15 %; of four edges and more the moment of what is linked is its first term's.
ChainStep next_step(const EdgeTerm& first, const EdgeTerm& second, double coupling);

/// The face that both edges bound and along which the wave goes from one to the other, or no_index. What arrives is
/// then the wave and its image in one. The same for both directions of the way.
std::uint32_t grazed_face(const Scene& scene, const EdgePassage& before, const EdgePassage& here);

}  // namespace grimaldi
