#pragma once
// The ends of an edge: which part of each term there is.

#include <array>
#include <complex>
#include <cstddef>

#include "propagation/edge_chain.h"
#include "propagation/fermat.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Weights T = H + Σ w UV of the terms of an edge, w by `edge_end_share`. Source: physics of an edge, line 6.
class EndWeights {
 public:
  /// Inputs: wavelength m, wavenumber rad/m; `mirrors`: an end that stands on a face has no wave.
  EndWeights(const Wedge& wedge, const EdgePassage& passage, double wavelength, double wavenumber, bool mirrors);

  std::complex<double> of(const EdgeTerm& term) const;

  /// The same, there `weight`, in a pair with a term of the one other edge: the ends couple with it where its argument
  /// is below 2 (a fade from 1 on), and share as they do without it. `alone`: the term's argument without the other
  /// edge; `coupling`: of the other edge's aperture with the way along this edge.
  std::complex<double> of_pair(std::complex<double> weight, double alone, const EdgeTerm& other, double coupling) const;

 private:
  struct End {
    double side;      ///< + where the edge starts, - where it ends
    double argument;  ///< of its wave, √(kδ)
    bool dark;
    std::complex<double> wave;
  };
  void add(double detour, double side, double wavelength, double wavenumber, bool inside);
  double inside_;
  std::array<End, 2> ends_{};
  std::size_t count_ = 0;
};

/// True if a term of an edge is so near its boundary that the ends of the edge next to it couple with it.
bool couple_with_ends(const EdgeTerms& terms);

}  // namespace grimaldi
