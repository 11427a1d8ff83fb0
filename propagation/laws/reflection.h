#pragma once
// What a plane face does to a plane wave.

#include <complex>

namespace grimaldi {

/// Reflection coefficients of the two polarisations. TE (⊥): E perpendicular to the plane of incidence, along s = k ×
/// n; TM (∥): E along s × k before and s × k' after the reflection, so that a perfect conductor has te = −1, tm = +1.
struct ReflectionCoefficients {
  std::complex<double> te, tm;
};

/// Half-space. Formula: ITU-R P.2040-3, equations (35a), (35b).
/// Inputs: permittivity ε' − jε'' (relative, exp(+jωt)), cos_incidence = |cos θ| of the angle to the normal, 0 … 1.
/// Returns: dimensionless, |·| ≤ 1. Error: a few ulp; at grazing incidence both tend to −1 without loss of digits.
ReflectionCoefficients half_space_reflection(std::complex<double> permittivity, double cos_incidence);

/// Single slab in air, multiple reflections inside summed. Formula: ITU-R P.2040-3, equations (42), (44):
/// R = R'(1 − e^{−j2q})/(1 − R'² e^{−j2q}), q = k d √(η − sin²θ).
/// Inputs: as above; thickness d ≥ 0 in m (infinity: half-space), wavenumber k in rad/m.
/// Error: 1e-13 absolute (e^{−j2q} is formed once; 1 − e^{−j2q} by expm1 for thin slabs).
ReflectionCoefficients slab_reflection(std::complex<double> permittivity, double thickness, double wavenumber,
                                       double cos_incidence);

/// Transmission into a half-space: tangential E (TE) and E along its own ∥ direction (TM) behind the face over that of
/// the incident wave. Formula: T_TE = 2 cos θ/(cos θ + q), T_TM = 2 √η cos θ/(η cos θ + q), q = √(η − sin²θ), ITU-R
/// P.2040-3, equations (36a), (36b).
/// Inputs: as half_space_reflection. Error: a few ulp.
ReflectionCoefficients half_space_transmission(std::complex<double> permittivity, double cos_incidence);

/// What a slab in air sends back and lets through; both over the incident wave at the entry, the latter at the point of
/// the exit face straight opposite, the phase e^{−jq} through the slab included.
struct SlabCoefficients {
  ReflectionCoefficients reflection, transmission;
};

/// Formula: R as slab_reflection, T = (1 − R'²) e^{−jq}/(1 − R'² e^{−j2q}), ITU-R P.2040-3, equations (42) to (44).
/// Inputs: as slab_reflection; infinite thickness lets nothing through. Error: 1e-13 absolute.
SlabCoefficients slab_coefficients(std::complex<double> permittivity, double thickness, double wavenumber,
                                   double cos_incidence);

/// Pressure reflection factor of a locally reacting, angle-independent wall of absorption coefficient α: √(1 − α),
/// phase 0. α in 0 … 1.
double wall_reflection(double absorption);

}  // namespace grimaldi
