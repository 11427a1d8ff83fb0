#pragma once
// What air and rain take from radio waves along a path.

namespace grimaldi {

/// Air as ITU-R P.676 takes it.
struct RadioAir {
  double dry_pressure = 1013.25;  ///< hPa, of the air without its vapour
  double temperature = 288.15;    ///< K
  double vapour_density = 7.5;    ///< g/m³
};

/// Specific attenuation by gases, dB/km: dry air (oxygen lines, Debye spectrum, pressure-induced nitrogen) and vapour.
struct GasAttenuation {
  double dry, vapour;
  double total() const { return dry + vapour; }
};

/// Formula: γ = 0.182 f N''(f), N'' the sum over 44 oxygen and 35 water vapour lines and the dry continuum.
/// Source: Recommendation ITU-R P.676-13, Annex 1, equations (1) to (9), Tables 1 and 2 (the same as in P.676-12).
/// Inputs: frequency GHz, > 0.   Valid: 1 … 1000 GHz; below it only the Debye spectrum counts.
/// Error: ≤ 1e-13 relative against the formula (held by RadioAttenuation.Gas*).
GasAttenuation gas_attenuation(double frequency_GHz, const RadioAir& air);

/// γ = k R^α, dB/km.
struct RainLaw {
  double k, alpha;
};

/// Formula: lg k and α as sums of Gaussians in lg f and a line, for both polarisations, mixed by cos² of the path's
/// elevation and cos 2τ. Source: Recommendation ITU-R P.838-3, equations (2) to (5), Tables 1 to 4.
/// Inputs: frequency GHz, 1 … 1000; elevation of the path and tilt τ of the polarisation from the horizontal, rad (τ =
/// π/4: circular).
/// Error: ≤ 1e-12 relative against the formula (held by RadioAttenuation.Rain*).
RainLaw rain_law(double frequency_GHz, double elevation, double tilt);

/// Specific attenuation by rain, dB/km. Inputs: as above, rain rate mm/h ≥ 0.
double rain_attenuation(double frequency_GHz, double rain_rate, double elevation, double tilt);

}  // namespace grimaldi
