#pragma once
// Reference: Sommerfeld's half-plane under a plane wave, normal incidence. exp(+jωt).

#include "validation/wedge_field.h"

namespace grimaldi {

/// Exact total field; the half-plane is φ = 0 (= 2π), the incident wave e^{jkρ cos(φ−φ')} arrives from φ'.
/// Formula: u = v(φ−φ') ∓ v(φ+φ'), v(ψ) = e^{jkρ cos ψ} ½ erfc(−e^{jπ/4} √(2kρ) cos(ψ/2)).
/// Source: Sommerfeld 1896; Born & Wolf 11.5.
/// Inputs: k_rho = kρ ≥ 0 (rad); phi, phip in rad, 0 … 2π (1e-9 rad over an end is taken as the end).
/// Returns: over the incident amplitude; soft 0 and hard 1 on the edge.
/// Error: 1e-15 + 4e-16·kρ absolute (held by HalfPlane.*).
/// Throws: InputErrors for an angle outside the range, kρ < 0 or a number that is not finite.
WedgeField half_plane_plane_wave(double k_rho, double phi, double phip);

}  // namespace grimaldi
