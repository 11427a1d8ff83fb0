#pragma once
// Geometrical optics and diffraction integral of a wedge, on the path of steepest descent.

#include <complex>
#include <functional>

namespace grimaldi {

/// The distance function of a problem: R(t)² = R_a² + 2 ρ ρ_s (cosh t − 1) about the path over the edge, and the wave
/// that runs along it. All lengths are times k (rad).
struct WedgePath {
  double apex = 0;     ///< k R_a, the path over the edge; 0 for a plane wave
  double product = 0;  ///< k² ρ ρ_s; kρ for a plane wave
  bool plane = false;  ///< plane wave: kR → kρ cosh t
  /// The wave at a distance kR = apex − j s² (plane: kρ − j s²), without its factor e^{−j apex} e^{−s²}.
  std::function<std::complex<double>(std::complex<double> k_distance)> amplitude;
  /// The image wave at a real distance, complete; plane: at the angle θ from the direction of arrival.
  std::function<std::complex<double>(double theta)> image;
};

/// U(ψ), even and of period 2πn: the wave of a wedge is U(φ−φ') ∓ U(φ+φ').
/// Formula: U = Σ_N image(ψ + 2πnN) over |ψ + 2πnN| < π − (1/4πn) ∫ wave(R(t)) [cot((π+ψ+jt)/2n) + cot((π−ψ−jt)/2n)]
/// dt; t(s) with kR = kR_a − j s² makes the wave a Gaussian in s. The line of s is moved off the real axis, away from
/// the poles; poles that it passes join or leave the sum of images. So nothing is singular at a shadow boundary.
/// Source: Bowman, Senior & Uslenghi (1969), ch. 6; trapezoidal rule: quadrature.h.
/// Inputs: n 0.05 … 2, ψ in rad, any.
/// Error: 1e-14 of the wave over the edge and of each image.
std::complex<double> wedge_contour(double n, double psi, const WedgePath& path);

}  // namespace grimaldi
