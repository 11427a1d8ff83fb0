#pragma once
// Reference: the paraxial field behind one and two absorbing knife edges. exp(+jωt).

#include <complex>

namespace grimaldi {

/// One knife edge, field over the free field: (1+j)/2 ∫_v^∞ e^{−jπu²/2} du.
/// Source: ITU-R P.526, 4.1, conjugated to exp(+jωt).   Inputs: v, > 0 in shadow; ±∞ allowed.
/// Error: 1e-15 + 2e-16·v² absolute (held by ExactKnifeEdge.*).
std::complex<double> exact_knife_edge(double v);

/// Two parallel edges between transmitter and receiver.
struct DoubleKnifeEdge {
  double wavelength;  ///< m, > 0
  double d1, d2, d3;  ///< m, > 0: transmitter to edge 1, edge 1 to edge 2, edge 2 to receiver
  double h1, h2;      ///< m, heights of the edges above the straight line transmitter-receiver, either sign
};

/// Field over the free field.
/// Formula: (j/λ) √(D/(d1 d2 d3)) ∫_{h1}^∞ ∫_{h2}^∞ exp(−j(k/2)[x1²/d1 + (x2−x1)²/d2 + x2²/d3]) dx1 dx2,
/// D = d1+d2+d3. It is the orthant of two correlated complex Gaussians: E(ν1) E(ν2) + (1/2π) ∫_0^{asin r}
/// exp(−j(π/2)(ν1² + ν2² − 2 ν1 ν2 sin θ)/cos² θ) dθ, r = √(d1 d3/((d1+d2)(d2+d3))), ν_i and E(ν_i) of each edge alone.
/// Source: Millington, Hewitt & Immirzi, Proc. IEE 109C (1962); Plackett, Biometrika 41 (1954) for the second form.
/// Returns: dimensionless.
/// Valid: |ν| ≤ 100 of either edge over the straight line.
/// Error: 1e-12 absolute (held by DoubleKnifeEdge.*, against the double integral).
/// Throws: InputErrors if a length is not > 0, a number not finite, or |ν| above 100.
std::complex<double> exact_double_knife_edge(const DoubleKnifeEdge& edges);

/// −20 lg |field|, dB; +∞ for 0.
double diffraction_loss(std::complex<double> field);

}  // namespace grimaldi
