#pragma once
// A wedge whose faces have a surface impedance, exact.

#include <complex>

namespace grimaldi {

/// Maliuzhinets' function ψ_Φ(z) of a wedge of exterior angle 2Φ = nπ; even in z.
/// Formula: ψ = exp(−½ ∫_0^∞ (cosh(zs) − 1)/(s cosh(πs/2) sinh(2Φs)) ds) for |Re z| ≤ π/2; beyond by
/// ψ(z + π/2) ψ(z − π/2) = ψ²(π/2) cos(πz/4Φ).
/// Source: Maliuzhinets, Soviet Physics Doklady 3 (1958) 752; Osipov & Norris, Wave Motion 29 (1999) 313.
/// Inputs: n 0.5 … 2, z in rad, |Re z| ≤ 4π, |Im z| ≤ 30.   Returns: dimensionless; 0 at z = ±(nπ + π/2), poles π
/// farther out.
/// Error: 2e-14 (1 + |Im z|) relative away from zeros and poles (held by ImpedanceWedge.Maliuzhinets*).
/// Throws std::runtime_error if the integral does not settle.
std::complex<double> maliuzhinets(double n, std::complex<double> z);

/// Diffraction of a plane wave at right angles to the edge of a wedge with faces φ = 0 and φ = nπ, both of the same
/// normalised admittance β: R(c) = (c − β)/(c + β) at the cosine c of incidence to the normal, −1 a soft and +1 a hard
/// face. exp(+jωt).
class ImpedanceWedge {
 public:
  /// Inputs: n 0.5 … 2; β dimensionless, real part > 0, 1e-6 ≤ |β| ≤ 1e6.
  ImpedanceWedge(double n, std::complex<double> admittance);

  /// The spectral function s(α) of the total field u(ρ, φ) = (1/2πj) ∫ s(φ − nπ/2 + α) e^{jkρ cos α} dα over
  /// Sommerfeld's contours: residue 1 at α = φ' − nπ/2, that of the incident wave, and on either face (sin α ± β)
  /// s(±nπ/2 + α) is even in α.
  /// Formula: s = Ψ(α)/Ψ(α') ν cos να'/(sin να − sin να'), ν = 1/n, α' = φ' − nπ/2, Ψ the product of four ψ with θ,
  /// sin θ = β. Source: Maliuzhinets, as above.
  /// Inputs: rad, |Re α| ≤ nπ/2 + π, |Im α| ≤ 15; 0 < φ' < nπ.   Error: 1e-12 relative, away from
  /// poles and zeros (held by ImpedanceWedge.BoundaryCondition).
  std::complex<double> spectrum(std::complex<double> alpha, double phi_in) const;

  /// Diffraction coefficient in Keller's form, d: far from the edge the diffracted wave is u_i(Q) D e^{−jkρ}/√ρ, D =
  /// −e^{−jπ/4}/√(2πk) d.
  /// Formula: d = s(φ − nπ/2 + π) − s(φ − nπ/2 − π), from the two points of stationary phase α = ±π.
  /// Inputs: rad; 0 < φ' < nπ, 0 ≤ φ ≤ nπ.
  /// Returns: dimensionless; infinite at the shadow and reflection boundaries, 0 on the faces.
  /// Valid: far from the boundaries (v ≫ 1); surface waves along the faces are not part of it.
  /// Error: 1e-13, and 1e-15 over |β| and over the square of the distance from a boundary in rad (held by
  /// ImpedanceWedge.*).
  std::complex<double> coefficient(double phi_in, double phi) const;

 private:
  /// Ψ(α): what the faces make of the spectrum of a wedge without them.
  std::complex<double> faces(std::complex<double> alpha) const;

  double n_, half_angle_;            // Φ
  std::complex<double> complement_;  // π/2 − θ = arccos β
};

}  // namespace grimaldi
