#pragma once
// Arrivals at one point: which of them add as fields, which as powers.

#include <array>
#include <complex>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/sequence.h"

namespace grimaldi {

/// What one path brings to one point.
struct Arrival {
  SequenceHash hash = 0;
  double whole = 1;  ///< share of its object's wave that the edges of others leave (object_fields)
  std::span<const Interaction> interactions;
  PathGeometry geometry;
  std::vector<std::array<std::complex<double>, 2>> field;  ///< [band] → V, H (sound: pressure, 0)
  std::size_t number = 0;                                  ///< of whoever keeps the list
};

/// The layer that a path belongs to.
Mechanism mechanism_of(std::span<const Interaction> interactions);

/// Σ over the polarisations that the receiver takes of |field|².
double received_power(const std::array<std::complex<double>, 2>& field, Polarisation polarisation);

/// The cross terms of all arrivals at one point, per band: 2 Σ γ_ab Re(a b*).
///
/// An edge bounds up to three waves: the one that it cuts off (the sequence without the edge) and the ones that its two
/// faces reflect (the sequence with the face in place of the edge). The bounded wave and the waves of all edges that
/// bound it form one composite, whether the bounded wave arrives or not. An edge belongs to a composite with the weight
/// t = 1 up to v = 3 and a cos² fade to 0 at v = 6 (v of that boundary), times, where it is passed beyond its end, 1 up
/// to v_V = 1.5 and a fade to 0 at v_V = 3, with which its wave ends. A bounded wave that does not arrive is itself
/// tied to the waves that its edges bound, as passed by the path nearest to it. Edges that end at one corner, before
/// and after the same other interactions, are tied there, each with 1 up to r_F from it and a fade to 0 at 2 r_F. A
/// wave ties the waves that it belongs to with one another only as far as it has power, itself or in what belongs to
/// it: 1 from 1/300 of the whole, a fade to 0 at 1/3000: what is so weak may have been left out. What has less than
/// 1e-5 of it adds its power alone. γ_ab is the product of the weights along the way from a to b over these ties (of
/// several ways the strongest: the maximum spanning tree of the first band): 1 for a wave and an edge on its boundary,
/// t_a t_b for two edges of one wave, t t' for a direct and a reflected wave that one edge bounds both (near grazing
/// they are one coherent wave). Products along a tree are a correlation, so power + interference = the mean power of
/// correlated waves ≥ 0; it is continuous where a bounded wave appears or ends, since there its edge's wave jumps by as
/// much. Source: physics of an edge, lines 8 to 10; the fades and what absent waves tie, own.
class CompositeSum {
 public:
  CompositeSum(const Scene& scene, const Plan& plan) : scene_(&scene), plan_(&plan) {}

  /// interference[band] of the arrivals at one point, for the receiver's polarisation. With `extent` h > 0 (m) its mean
  /// over the horizontal square of side h about the point: the phase between two waves of directions d, d' changes
  /// there by k(d − d')·δ, so each cross term is multiplied by sinc(k Δd_x h/2) sinc(k Δd_y h/2). (A correlation times
  /// the transform of a square is a correlation: the total stays ≥ 0.)
  void interference(std::span<const Arrival> arrivals, Polarisation polarisation, std::span<double> out,
                    double extent = 0);

 private:
  /// A wave by its name. The arrivals come first, then the bounded waves that do not arrive and the corners.
  struct Node {
    std::vector<Interaction> interactions;
    std::vector<EdgePassage> edges;  ///< as passed by itself or by the path nearest to it; none at a corner
    double apart;                    ///< Σ v of the boundaries between that path and it
    std::vector<double> power;       ///< per band, of itself and of what belongs to it: the greatest
  };
  /// Two nodes that add as fields.
  struct Tie {
    std::uint32_t a, b;
    std::uint32_t weights;  ///< first of its weights, one per band
  };
  /// A wave that an edge of a node bounds.
  struct Bounded {
    std::size_t edge, position;  ///< among the node's edges and among its interactions
    Interaction face;            ///< in place of the edge, or no_interaction
    double v;                    ///< of the boundary
  };
  void enter(std::span<const Arrival> arrivals, Polarisation polarisation);
  void tie_to_composites();
  void tie_upward(std::uint32_t node);
  void tie(std::uint32_t node, const Bounded& wave, double beyond_end, bool nearest);
  void tie_corners(std::uint32_t node);
  bool bridges(std::uint32_t node) const;
  void note(std::uint32_t other, std::uint32_t node, const Bounded& wave);
  void drop_loose_ends();
  void span_tree();
  double at_the_point(std::span<const Arrival> arrivals, std::size_t band, Polarisation polarisation);
  double over_a_square(std::span<const Arrival> arrivals, std::size_t band, Polarisation polarisation, double extent);
  std::uint32_t node_of(SequenceHash composite);
  std::uint32_t root_of(std::uint32_t node);

  const Scene* scene_;
  const Plan* plan_;
  std::vector<Tie> ties_;
  std::vector<double> weights_;
  std::unordered_map<SequenceHash, std::uint32_t> node_by_hash_;
  std::vector<Node> nodes_;  ///< the first node_count_ of them
  std::size_t node_count_ = 0, arrivals_ = 0;
  std::vector<double> power_;          ///< per band, of all arrivals
  std::vector<Bounded> bounded_;       ///< of one node
  std::vector<std::uint32_t> root_;    ///< union-find
  std::vector<std::uint32_t> degree_;  ///< ties of each node
  struct Branch {
    std::uint32_t node, parent, weights;
  };
  std::vector<Branch> branches_;                      ///< of the spanning forest, parents first
  std::vector<std::uint32_t> first_, next_, tie_of_;  ///< neighbours of the nodes along kept ties
  std::vector<std::array<std::complex<double>, 2>> sums_;
  std::vector<std::uint32_t> place_;  ///< of a node in its tree
  std::vector<double> gamma_;         ///< of the pairs of one tree
};

}  // namespace grimaldi
