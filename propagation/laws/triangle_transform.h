#pragma once
// Fourier transform of a triangle whose amplitude is linear between its corners.

#include <array>
#include <complex>
#include <span>

namespace grimaldi {

using PlanePoint = std::array<double, 2>;  ///< in the plane across the ray, m, or direction cosines there

/// A triangle and the complex amplitudes at its corners; wound either way.
struct AmplitudeTriangle {
  std::array<PlanePoint, 3> corner;
  std::array<std::complex<double>, 3> amplitude;
};

/// ∫ φ(q) e^{−iκ·q} d²q over the triangle.
/// Formula: 2|S| Σ_j φ_j exp[z₁, z₂, z₃, z_j], z = −iκ·u, exp[…] the divided difference of the exponential function:
/// by its power series where the phases −κ·u lie within 2 of each other, else by differences, innermost sinc, so that
/// no digits cancel at any size or shape. Exact S2.7 of Steinberg et al. 2024, without its pole at κ = 0.
/// Inputs: corners m; κ = kξ, rad/m, |κ·u| ≤ 1e9. Returns amplitude × m². A triangle without area gives 0.
/// Error: ≤ (2e-15 + 4.5e-16 |κ| max|u|) |S| max|φ|; the second part is that of the phases themselves (held by
/// TriangleTransform.*).
std::complex<double> triangle_transform(const AmplitudeTriangle& triangle, const PlanePoint& kappa);

/// The same for many κ, several at once, within the same error. Spans of one length.
void triangle_transform(const AmplitudeTriangle& triangle, std::span<const PlanePoint> kappa,
                        std::span<std::complex<double>> transform);

}  // namespace grimaldi
