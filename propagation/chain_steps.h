#pragma once
// How a wave passes the edges of a chain, term by term: three laws behind one interface.
//
// What leaves an edge is kept for each of its terms as one or more parts, so that the next edge can couple with it:
// * PairSteps, one edge or two: the whole.
// * MomentSteps, three and more: the whole, and its moment at the edge beyond that of the edge's own wave.
// * RowSteps, three and more that lie in one another's transition regions: its values at the nodes of the aperture.
//
// Of each law, edge by edge: `meet`; for each term t of the edge and each a of the edge before (one wave meets the
// first edge) `pass` of arriving(a) parts, which adds to most parts; then `leave`, after which leaving(t) parts count.

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>

#include "propagation/edge_chain.h"
#include "propagation/edge_ends.h"
#include "propagation/edge_faces.h"
#include "propagation/laws/edge_row.h"

namespace grimaldi {

/// Terms of all edges of a path.
using ChainTerms = std::array<EdgeTerms, max_edges>;

/// One edge: its terms, times the weights of its ends. Two: pairs of terms by `pair_wave`, the ends coupled with the
/// other edge where a term of it has an argument below 2.
class PairSteps {
 public:
  static constexpr std::size_t most = 1;
  PairSteps(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges)
      : chain_(chain), terms_(terms), edges_(edges) {}
  void meet(std::size_t number, const EndWeights& ends);
  std::size_t arriving(std::size_t) const { return 1; }
  void pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const;
  void leave(std::size_t t, std::span<ConeField> wave) const;
  std::size_t leaving(std::size_t) const { return 1; }

 private:
  std::complex<double> coupled_ends(std::size_t a, std::size_t t) const;
  const EdgeChain& chain_;
  const ChainTerms& terms_;
  const std::size_t edges_;
  std::size_t number_ = 0;
  bool ends_couple_ = false;
  std::optional<EndWeights> ends_, ends_before_;
  std::array<std::complex<double>, max_terms> weights_, weights_before_;
};

/// Formula: the Gaussian integral over the apertures 1, 2, 3 by powers m and n of the couplings 12 and 23 is Σ
/// (2jw₁₂)^m/m! (2jw₂₃)ⁿ/n! I_m(q₁) I_{m+n}(q₂) I_n(q₃), I_n as in double_edge.h. At each inner edge I_{m+n} is taken
/// as I_m I_n/I_0 + S_m S_n/S_1, S_m = I_{m+1} − I_m I_1/I_0, which is right for all m and n of which one is 0 or 1;
/// the sums over m and n are then waves and moments of pairs of edges (`double_edge_moments`). Source: own; two steps
/// of the elimination of the matrix I_{m+n}. Valid: the same with the ends exchanged. Error: of a chain that `is_row`
/// does not take 0.01 of the wave (held by EdgeChain.MomentsSufficeBelowTheRow); screens in a row, all tips on one
/// line: 0.3, 1.0, 2.2 dB too little for 3, 4, 5 of them.
class MomentSteps {
 public:
  static constexpr std::size_t most = 2;
  MomentSteps(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges)
      : chain_(chain), terms_(terms), edges_(edges) {}
  void meet(std::size_t number, const EndWeights& ends);
  std::size_t arriving(std::size_t) const { return number_ > 1 ? 2 : 1; }
  void pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const;
  void leave(std::size_t t, std::span<ConeField> wave) const;
  std::size_t leaving(std::size_t) const { return number_ > 0 && number_ + 1 < edges_ ? 2 : 1; }

 private:
  const EdgeChain& chain_;
  const ChainTerms& terms_;
  const std::size_t edges_;
  std::size_t number_ = 0;
  std::array<std::complex<double>, max_terms> weights_;
};

/// Formula: `edge_row_wave`, for all terms of all edges at once; where the slope of a term differs from its plain
/// factor, what each coupling adds is multiplied by slope/plain of both its terms. Error: that of edge_row_wave.
class RowSteps {
 public:
  static constexpr std::size_t most = most_row_nodes;
  RowSteps(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges);
  void meet(std::size_t number, const EndWeights& ends);
  std::size_t arriving(std::size_t a) const { return number_ > 0 ? before_[a].count : 1; }
  void pass(std::size_t a, std::size_t t, std::span<const ConeField> wave, std::span<ConeField> into) const;
  void leave(std::size_t t, std::span<ConeField> wave) const;
  std::size_t leaving(std::size_t t) const { return number_ + 1 < edges_ ? here_[t].count : 1; }

 private:
  const EdgeChain& chain_;
  const ChainTerms& terms_;
  const std::size_t edges_;
  std::size_t number_ = 0;
  std::array<double, max_edges> rests_;
  std::array<RowAperture, max_terms> here_, before_;
  std::array<std::complex<double>, max_terms> weights_;
};

/// True if MomentSteps would err by more than 0.01 and RowSteps can do it: an inner edge both of whose couplings count,
/// z z' ≥ 0.05 with z = |w|/(2 q q'), q the least argument of the edge's terms, 0.7 at the least.
bool is_row(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges);

}  // namespace grimaldi
