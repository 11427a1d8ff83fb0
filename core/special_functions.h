#pragma once
// The special functions of diffraction theory, each with the form that keeps its digits.

#include <complex>
#include <span>

namespace grimaldi {

/// Faddeeva function w(z) = exp(−z²) erfc(−jz).
/// Formula: Abramowitz & Stegun 7.1.3.
/// Source: of the method, Al Azah & Chandler-Wilde, SIAM J. Numer. Anal. 59 (2021): modified trapezium, midpoint rules.
/// Inputs: z finite.   Returns: dimensionless.
/// Valid: Im z ≥ 0 (|w| ≤ 1); elsewhere (|z| ≤ 1e150) by w(−z) = 2exp(−z²) − w(z), which overflows to infinity where
/// w does, and whose phase loses |z|² ulps.
/// Error: ≤ 1e-14 of |w| for Im z ≥ 0 (held by SpecialFunctions.Faddeeva*; 1.1e-15 measured at 3914 points).
std::complex<double> faddeeva(std::complex<double> z);

/// w(e^{3jπ/4} t), t ≥ 0 real: the one argument that straight edges need.
/// Formula: e^{jt²} erfc(e^{jπ/4} t); F(x) = √(πx) e^{jπ/4} w(e^{3jπ/4}√x).
/// Source: of the method, Taylor series about 96 centres up to t = 12, then Abramowitz & Stegun 7.1.23.
/// Inputs: t ≥ 0; +∞ is allowed.   Returns: dimensionless.
/// Error: ≤ 1e-14 of |w| on 0 … 1e8 and beyond (held by SpecialFunctions.Ray*; 5e-16 measured at 3516 points).
std::complex<double> faddeeva_on_ray(double t);

/// The same for every t of a span, to the same bits, several at once. Spans of one length.
void faddeeva_on_ray(std::span<const double> t, std::span<std::complex<double>> w);

/// UTD transition function F(x) = 2j√x e^{jx} ∫_{√x}^∞ e^{−ju²} du, exp(+jωt).
/// Source: Kouyoumjian & Pathak, Proc. IEEE 62 (1974), equation (26).   Inputs: x ≥ 0.   Valid: every x ≥ 0; F(∞) = 1.
/// Error: ≤ 1e-14 relative on 0 … 1e16 (held by SpecialFunctions.TransitionFunction*).
std::complex<double> transition_function(double x);

/// The same for every x of a span, to the same bits, several at once. Spans of one length.
void transition_function(std::span<const double> x, std::span<std::complex<double>> f);

/// Field behind a straight black edge over the free field, as a function of the Fresnel-Kirchhoff parameter v:
/// E(v) = (1+j)/2 ∫_v^∞ exp(−jπu²/2) du. E(0) = 1/2, E(−∞) = 1, E(+∞) = 0; conjugate of ITU-R P.526's exp(−iωt) form.
/// Inputs: any v but NaN; ±∞ is allowed.
/// Error: ≤ 1e-14 absolute for |v| ≤ 1e8 (held by SpecialFunctions.KnifeEdge*).
std::complex<double> knife_edge(double v);

}  // namespace grimaldi
