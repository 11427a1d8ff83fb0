#pragma once
// An aperture, or the obstacle in its place, as triangles in the plane across a ray: field, powers and central lobe by
// the published free-space diffraction BSDF (Steinberg et al. 2024, supplemental, equations S… and B.…), with the
// errors of print mended. exp(−iωt), as there; R = 1.

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "propagation/laws/published_diffraction.h"
#include "propagation/laws/triangle_transform.h"

namespace grimaldi {

/// Amplitudes at the vertices, 1/m for unit power; linear in between. Triangles do not overlap; wound either way.
struct TriangleAperture {
  std::vector<PlanePoint> vertices;
  std::vector<std::complex<double>> amplitudes;
  std::vector<std::array<std::size_t, 3>> triangles;

  AmplitudeTriangle triangle(std::size_t i) const;
};

/// Fraunhofer field of the aperture, without approximation of the linear amplitude. Formula: ψ = k/(2πR) ∫ φ e^{−ikξ·q}
/// d²q, S2.1. Inputs: wavenumber rad/m, direction cosines ξ. Error: that of triangle_transform, summed.
std::complex<double> aperture_field(const TriangleAperture& aperture, double wavenumber, const PlanePoint& xi);

/// The same for many directions, several at once. Spans of one length.
void aperture_field(const TriangleAperture& aperture, double wavenumber, std::span<const PlanePoint> xi,
                    std::span<std::complex<double>> field);

/// Sides of one triangle only, the aperture on their left.
std::vector<PublishedEdge> boundary_edges(const TriangleAperture& aperture);

/// ∫ |φ|² d²q. Formula: Σ |S|/6 Re Σ_{j≤l} φ_j φ_l*, S2.31, S2.32.
double aperture_power(const TriangleAperture& aperture);

/// Moments ∫ φ qq… d²q: M0 = Σ |S| P/3, M1 = Σ |S|/12 Σ_j (P + φ_j) u_j, M2 = Σ |S|/60 Σ_ij (1+δ_ij)(P + φ_i + φ_j)
/// u_i u_jᵀ, P = φ1 + φ2 + φ3. M2 stands in place of B.4 to B.12 (where the signs of B.8 and B.10 are wrong) and of
/// B.13.
struct ApertureMoments {
  std::complex<double> zeroth;
  std::array<std::complex<double>, 2> first;
  std::array<std::complex<double>, 3> second;  ///< xx, xy, yy
};
ApertureMoments aperture_moments(const TriangleAperture& aperture);

/// The central lobe as a Gaussian: |ψ(0)|² exp(−½ ξᵀ Σ₀⁻¹ ξ).
struct CentralLobe {
  double peak = 0;                           ///< |ψ(0)|², B.2
  std::array<double, 3> inverse_covariance;  ///< Σ₀⁻¹: xx, xy, yy
  double power = 0;                          ///< P̃₀, B.16
};

/// Formula: Σ₀⁻¹ = 2k² [Re(M2/M0) − Re(M1 M1ᴴ)/|M0|²], the Hessian of |ψ|² at 0, the second part of which B.3 leaves
/// out; σ_ξ = √3/(k e), e the edges' mean length weighted by their power (B.15); P̃₀ = 2π |Σ₀⁻¹ + σ_ξ⁻²|^{−1/2} |ψ(0)|².
/// Valid: M0 ≠ 0; a Σ₀⁻¹ so negative that the sum is not positive definite (a field with a hole at its centre) has no
/// such lobe: power 0.
CentralLobe central_lobe(const TriangleAperture& aperture, double wavenumber);

/// Share of the power that is diffracted, (P − P̃₀)/P, S3.1, 0 … 1; a lobe that claims more than there is leaves 0.
double diffracted_share(const TriangleAperture& aperture, double wavenumber);

/// Quality of sampling by edges: diffracted power over the sum of the edges' own, S3.2; good near 1.
double sampling_quality(const TriangleAperture& aperture, double wavenumber);

}  // namespace grimaldi
