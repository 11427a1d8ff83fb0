#pragma once
// Reference: Sommerfeld's half-plane under a plane wave, normal incidence. exp(+jωt).

#include "core/constants.h"
#include "validation/wedge_field.h"

namespace grimaldi {

/// Exact total field; the half-plane is φ = 0 (= 2π), the incident wave e^{jkρ cos(φ−φ')} arrives from φ'.
/// Formula: u = v(φ−φ') ∓ v(φ+φ'), v(ψ) = e^{jkρ cos ψ} ½ erfc(−e^{jπ/4} √(2kρ) cos(ψ/2)).
/// Source: Sommerfeld 1896; Born & Wolf 11.5.
/// Inputs: k_rho = kρ ≥ 0 (rad); phi, phip from 0 to two half turns (1e-9 of a half turn over an end is taken as the
/// end), in a unit of which `half_turn` make π: 180 for degrees, which keeps the digits that radians lose.
/// Returns: over the incident amplitude; soft 0 and hard 1 on the edge.
/// Error: 1e-15 + 2e-16·kρ absolute in degrees, 1e-15 + 1.5e-15·kρ in radians (held by HalfPlane.*).
/// Throws: InputErrors for an angle outside the range, kρ < 0 or a number that is not finite.
WedgeField half_plane_plane_wave(double k_rho, double phi, double phip, double half_turn = pi);

}  // namespace grimaldi
