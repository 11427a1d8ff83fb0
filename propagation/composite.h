#pragma once
// Arrivals at one point: which of them add as fields, which as powers.

#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/sequence.h"

namespace grimaldi {

/// What one path brings to one point.
struct Arrival {
  std::uint32_t sequence = 0;
  SequenceHash hash = 0;
  std::span<const Interaction> interactions;
  PathGeometry geometry;
  std::vector<std::array<std::complex<double>, 2>> field;  ///< [band] → V, H (sound: pressure, 0)
};

/// The layer that a path belongs to.
Mechanism mechanism_of(std::span<const Interaction> interactions);

/// Σ over the polarisations that the receiver takes of |field|².
double received_power(const std::array<std::complex<double>, 2>& field, Polarisation polarisation);

/// The cross terms of all arrivals at one point, per band: 2 Σ γ_ab Re(a b*).
///
/// An edge bounds up to three waves: the one that it cuts off (the sequence without the edge) and the ones that its two faces
/// reflect (the sequence with the face in place of the edge). The bounded wave, where it arrives, and the waves of all edges that bound it form one composite.
/// A member's weight t is 1 for the bounded wave and, for an edge, 1 up to v = 3 and a cos² fade to 0 at v = 6 (v of that boundary); γ_ab = t_a t_b, the largest over the composites that hold both.
/// So power + interference = |Σ t a|² + Σ (1 − t²)|a|² ≥ 0 for one composite, and it is continuous where the bounded wave appears or ends, since there its
/// edge's wave jumps by as much. Direct and reflected wave of one grazed face share an edge's two composites: γ = t t'.
/// Edges that end at one vertex, before and after the same other interactions, both diffraction points within r_F of it: γ = 1.
/// Source: physics of an edge, lines 8 to 10.
///
/// Where the same pair meets in several composites with different partners the sum of γ might make the total negative;
/// the interference is then limited to −Σ|a|² (the total is 0, a null of the field).
class CompositeSum {
 public:
  CompositeSum(const Scene& scene, const Plan& plan) : scene_(&scene), plan_(&plan) {}

  /// interference[band] of the arrivals at one point, for the receiver's polarisation.
  void interference(std::span<const Arrival> arrivals, Polarisation polarisation, std::span<double> out);

 private:
  /// An edge's wave as a member of a composite.
  struct Member {
    SequenceHash composite;
    std::uint32_t arrival;
    std::uint32_t weights;  ///< first of its weights t, one per band
  };
  /// Two arrivals that add as fields.
  struct Pair {
    std::uint32_t a, b;     ///< a < b
    std::uint32_t weights;  ///< first of the weights γ, one per band
  };
  void gather_members(std::span<const Arrival> arrivals);
  void pair_members(std::span<const Arrival> arrivals);
  void pair_corners(std::span<const Arrival> arrivals);
  void add_pair(std::uint32_t a, std::uint32_t b, const double* ta, const double* tb);

  const Scene* scene_;
  const Plan* plan_;
  std::vector<Member> members_;
  std::vector<Pair> pairs_;
  std::vector<double> weights_;
};

}  // namespace grimaldi
