#pragma once
// The Fresnel integral of the references, by quadrature on a rotated ray; the kernels have another one of their own.

#include <complex>

namespace grimaldi {

/// Complementary Fresnel integral ½ erfc(e^{jπ/4} x) = (e^{jπ/4}/√π) ∫_x^∞ e^{−ju²} du; 1 at −∞, ½ at 0, 0 at +∞.
/// Formula: for x ≥ 0, (1/√π) e^{−jx²} ∫_0^∞ e^{−u² − 2 e^{jπ/4} x u} du, Gauss-Legendre; else 1 minus that of −x.
/// Source: Abramowitz & Stegun 7.1.2, turned to the ray along which nothing oscillates in growth.
/// Inputs: x finite or ±∞.   Returns: dimensionless.
/// Error: 1e-15 + 1e-16·x² absolute, times |value| for x > 0 (held by FresnelIntegral.*).
std::complex<double> fresnel_tail(double x);

}  // namespace grimaldi
