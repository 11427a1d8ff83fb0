#pragma once
// The wave over many straight edges in a row, uniform through all their transition regions at once. exp(+jωt).
//
// Signs, arguments and couplings as in double_edge.h. Each edge is an aperture whose displacement t = e^{−jπ/4} s runs
// from its tip; on that contour the integral over all apertures decays as a real Gaussian, and neighbours alone are
// coupled: it is a product of matrices over the nodes of the apertures.

#include <array>
#include <complex>
#include <cstddef>
#include <span>

namespace grimaldi {

inline constexpr std::size_t most_row_nodes = 48;

/// The displacements at which one edge's aperture is taken, with their weights.
struct RowAperture {
  std::size_t count = 0;
  std::array<double, most_row_nodes> place;                 ///< s
  std::array<std::complex<double>, most_row_nodes> weight;  ///< (1/√π) e^{−2q e^{jπ/4} s} ds
};

/// True if the nodes suffice for an aperture of that width (below 11.4).
bool row_fits(double width);

/// Formula: Gauss-Legendre nodes on 0 … S, S = 3.5 W/√(1+(qW/2)²), 8 + S of them: W the width of the Gaussian over
/// which the displacement spreads among its neighbours, 1 for an edge alone.
/// Inputs: q ≥ 0; W ≥ 1, row_fits(W).
RowAperture row_aperture(double argument, double width);

/// The Gaussian that binds an edge to the next, s² and s'² and the coupling, as one square that never exceeds 1.
struct RowLink {
  double coupling;  ///< −1 … 1, with the signs of both terms
  double rest;      ///< of row_rests, at the edge that it leads to
};

/// d_N = 1, d_i = 1 − w_i²/d_{i+1}: Σ s_i² − 2 Σ w_i s_i s_{i+1} = d_1 s_1² + Σ (√d_{i+1} s_{i+1} − w_i s_i/√d_{i+1})².
/// Inputs: N − 1 couplings of a positive definite chain.   Returns: rests[i] for all N edges.
void row_rests(std::span<const double> couplings, std::span<double> rests);

/// What meets each node of an edge from the nodes of the edge before: kernel[to·from.count + from] = (plain − slope) ·
/// (value without coupling) + slope · (value with it).
/// Inputs: `kernel` of to.count · from.count values.
void row_kernel(const RowAperture& from, const RowAperture& to, const RowLink& link, double plain, double slope,
                std::span<double> kernel);

/// Wave over N edges over the product of the amplitudes that each has alone.
/// Formula: U_N = ∏ σ_i (j/π)^{N/2} ∫₀^∞ … exp(−j(Σ t_i² − 2 Σ w_i σ_i σ_{i+1} t_i t_{i+1}) − 2j Σ q_i t_i) dt₁ … dt_N;
/// σ = + dark, − lit. N = 1: U(q); N = 2: `double_edge_wave`. Source: the multiple Fresnel integral (Millington, Hewitt
/// & Immirzi 1962; Vogler, Radio Science 17, 1982, equation 1), each displacement about the bent ray; the contour, own.
/// Inputs: q_i ≥ 0, N − 1 couplings, the widths of the apertures (for a chain with covariance C and K = C⁻¹: √(C_ii
/// K_ii)).   Returns: dimensionless.
/// Valid: row_fits(width) for all. Error: 3e-5 of the wave for 8 edges and legs of which the longest is 50 times the
/// shortest, 1e-4 where a q is 40 (held by EdgeRow.*).
std::complex<double> edge_row_wave(std::span<const double> arguments, std::span<const bool> dark,
                                   std::span<const double> couplings, std::span<const double> widths);

}  // namespace grimaldi
