#pragma once
// Geometrical optics and diffraction integral of a wedge, on the path of steepest descent.

#include <complex>
#include <functional>

namespace grimaldi {

/// The wave of a problem along the path. All lengths are times k (rad). Distance: R(t)² = R_a² + 2ρρ_s(cosh t − 1)
/// about the path over the edge, R_a; for a plane wave kR(t) = kρ cosh t.
struct WedgePath {
  bool plane;      ///< plane wave
  double apex;     ///< kR_a; kρ for a plane wave
  double product;  ///< k²ρρ_s; not used for a plane wave
  /// The wave at the distance kR = apex − js², over e^{−jkR}; the square of s is given.
  std::function<std::complex<double>(std::complex<double> s2)> amplitude;
  /// The complete wave of an image at the real angle θ from it, |θ| ≤ π (a little more where the line has moved).
  std::function<std::complex<double>(double theta)> image;
};

/// U(ψ), even and of period 2πn: the wave of a wedge is U(φ−φ') ∓ U(φ+φ').
/// Formula: U = Σ_N image(ψ + 2πnN) over |ψ + 2πnN| < π, and −(1/4πn) ∫ wave(R(t)) [cot((π+ψ+jt)/2n) +
/// cot((π−ψ−jt)/2n)] dt. With t(s) from kR = kR_a − js² the wave is a Gaussian in s. The line of s is moved off the
/// real axis, away from the poles; poles that it passes join or leave the sum of images. So nothing is singular at a
/// shadow boundary.
/// Source: Bowman, Senior & Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes (1969), ch. 6.
/// Inputs: n 0.05 … 2, ψ in rad, |ψ| ≤ 2πn; apex, product > 0.
/// Error: 2e-15 of the largest term, and 2e-16·kR of its phase (held by WedgeSeries.*).
std::complex<double> wedge_contour(double n, double psi, const WedgePath& path);

}  // namespace grimaldi
