#pragma once
// Bessel functions of real order and argument: the one door to Boost.Math.

#include <complex>

namespace grimaldi {

/// J_ν(x).   Source: Boost.Math, cyl_bessel_j.
/// Inputs: ν ≥ 0, x ≥ 0, finite.   Returns: dimensionless; 0 where it underflows.
/// Error: 1e-14 absolute for x ≤ 1e3 (held by Bessel.*).
double bessel_j(double order, double x);

/// H_ν^(2)(x) = J_ν(x) − j Y_ν(x), the outgoing wave of exp(+jωt).   Source: Boost.Math, cyl_bessel_j, cyl_neumann.
/// Inputs: ν ≥ 0, x > 0, finite.   Returns: dimensionless; +j∞ in its second part where it overflows.
/// Error: 1e-14 of |H| for x ≤ 1e3 (held by Bessel.*).
std::complex<double> hankel2(double order, double x);

}  // namespace grimaldi
