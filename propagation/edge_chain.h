#pragma once
// The edges of one path as a chain: how the wave spreads over them, which terms each has and how neighbours couple.

#include <algorithm>
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

/// A wave that an edge bounds: the path without the edge, or with one of its faces in its place.
struct BoundedWave {
  Boundary boundary;
  Interaction instead;  ///< the face, or no_interaction
};

/// The waves that an edge bounds; that of the incident boundary alone where no face reflects, and one mirror for the
/// two sides of a thin screen.
class BoundedWaves {
 public:
  BoundedWaves(const Wedge& wedge, bool reflection)
      : waves_{{{Boundary::incident, no_interaction},
                {Boundary::face0, wedge.patch0},
                {Boundary::facen, wedge.patchn}}},
        count_(!reflection      ? 1
               : wedge.free_rim ? 2
                                : 3) {}
  const BoundedWave* begin() const { return waves_.data(); }
  const BoundedWave* end() const { return waves_.data() + count_; }

 private:
  std::array<BoundedWave, 3> waves_;
  std::size_t count_;
};

/// Places of a path's edges among its interactions.
class EdgePlaces {
 public:
  explicit EdgePlaces(std::span<const Interaction> interactions) {
    for (std::size_t i = 0; i < interactions.size(); ++i)
      if (is_edge(interactions[i])) places_[count_++] = i;
  }
  std::size_t operator[](std::size_t edge) const { return places_[edge]; }

 private:
  std::array<std::size_t, max_edges> places_;
  std::size_t count_ = 0;
};

/// Unit vectors along and across the edge's cone for a wave of direction k: φ̂ = ê × k/|ê × k|, β̂ = φ̂ × k. Turned about
/// the edge as k is.
struct ConeFrame {
  Vec3 phi, beta;
  ConeFrame(const Vec3& edge, const Vec3& k) : phi(normalized(cross(edge, k))), beta(cross(phi, k)) {}
};

/// Fresnel-Kirchhoff parameter of a passage at a boundary, at `wavelength` m; v ≥ 0.
double boundary_parameter(const Scene& scene, const EdgePassage& passage, Boundary boundary, double wavelength);

/// How a wave spreads over the edges of a path.
struct EdgeChain {
  double amplitude = 0;                          ///< of the product of the edges' waves, source of unit strength, 1/m
  std::array<double, max_edges> distance{};      ///< L of each edge, m, without sin²β
  std::array<double, max_edges - 1> coupling{};  ///< w of edges i and i+1; its sign goes with φ̂ of both
  std::array<double, max_edges> width{};  ///< of three and more: how far each displacement spreads beyond that of an
                                          ///< edge between fixed neighbours, √(C_ii K_ii) ≥ 1
  std::array<double, 2> end_coupling{};  ///< of two edges: of the way along the first with the second's φ̂, and of φ̂ of
                                         ///< the first with the way along the second
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
  bool black;  ///< of a black edge (`fsd`), not of `utd`
  std::complex<double> value() const { return sign * plain * wave.wave; }
};

/// Terms of an edge's wave at the most: four of `utd` and three of `fsd`, where `auto` mixes both.
inline constexpr std::size_t max_terms = 7;

struct EdgeTerms {
  std::array<EdgeTerm, max_terms> term;
  std::size_t count = 0;
  bool has(bool black) const {
    return std::any_of(begin(), end(), [&](const EdgeTerm& t) { return t.black == black; });
  }
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

/// The coupling of two terms, with the signs of double_edge.h, from that of their edges.
double signed_coupling(const EdgeTerm& first, const EdgeTerm& second, double coupling);

/// The face that both edges bound and along which the wave goes from one to the other, or no_index. What arrives is
/// then the wave and its image in one. The same for both directions of the way.
std::uint32_t grazed_face(const Scene& scene, const EdgePassage& before, const EdgePassage& here);

}  // namespace grimaldi
