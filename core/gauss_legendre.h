#pragma once
// Gauss-Legendre quadrature. (The references in validation have a rule of their own.)

#include <vector>

namespace grimaldi {

struct GaussPoint {
  double position;  ///< in (−1, 1)
  double weight;    ///< of an interval of length 2
};

/// Points and weights of the rule of n points, exact for polynomials of degree 2n − 1, ascending.
/// Formula: zeros x of P_n by Newton, weights 2/((1 − x²) P_n'(x)²). Source: Abramowitz & Stegun 25.4.29.
/// Inputs: n ≥ 1.   Error: 1e-14 of a weight for n ≤ 48 (held by GaussLegendre.*).
std::vector<GaussPoint> gauss_legendre_points(int n);

}  // namespace grimaldi
