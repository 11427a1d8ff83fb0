#pragma once
// Materials as constants over frequency: ITU-R P.2040 for radio, absorption coefficients for sound.

#include <complex>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/bands.h"
#include "core/contract.h"

namespace grimaldi {

/// ε_r' = a f^b, σ = c f^d, f in GHz, for a range of frequency. Source: ITU-R P.2040-3, equations (28), (29), Table 3.
struct PermittivityRange {
  double a, b, c, d;
  double from_GHz, to_GHz;
};

/// A value over frequency, linear in log f between the points; constant beyond the ends only if there is one point.
struct Spectrum {
  std::vector<double> frequency;  ///< Hz, ascending
  std::vector<double> value;
};

struct Material {
  std::string name;                      ///< normalised by `material_key`
  std::vector<PermittivityRange> radio;  ///< empty: nothing known for radio
  std::optional<Spectrum> permittivity;  ///< relative permittivity over f, overrides `radio`
  std::optional<Spectrum> conductivity;  ///< S/m over f, overrides `radio`
  double thickness = 0.1;                ///< of the slab, m; infinity = half-space
  std::optional<Spectrum> absorption;    ///< random-incidence absorption coefficient 0 … 1; nothing: unknown
};

/// "ITU Concrete", "mat-itu_concrete", "itu_concrete" → "concrete"; blanks become underscores, case is lowered.
std::string material_key(std::string_view name);

/// The built-in table: P.2040-3's materials (vacuum, concrete, brick, plasterboard, wood, glass, ceiling_board,
/// chipboard, plywood, marble, floorboard, metal, very_dry_ground, medium_dry_ground, wet_ground), each also with an
/// absorption spectrum in octaves 63 Hz … 8 kHz (exact mid-band frequencies) where a textbook table has one for such a
/// surface (source named in the .cpp), by key.
const std::map<std::string, Material>& built_in_materials();

/// Complex relative permittivity ε' − jσ/(ε0 ω) at `frequency` Hz, exp(+jωt).
/// Source: ITU-R P.2040-3, equations (9), (27) to (29). Outside every range of the material the nearest range is used
/// and a warning (material, frequency, range, value used) goes to `diagnostics`; a table (`permittivity`,
/// `conductivity`) that does not cover the frequency is an error there (the value of the nearest end is returned). No
/// radio data: an error. A permittivity without any conductivity: 0 S/m with a warning.
std::complex<double> relative_permittivity(const Material& material, double frequency, Diagnostics& diagnostics);

/// Absorption coefficient at `frequency` Hz, 0 … 1. A spectrum with one point is constant; a table that does not cover
/// the frequency within half an octave is an error; no data: the value 0.05 with a warning.
double absorption_coefficient(const Material& material, double frequency, Diagnostics& diagnostics);

}  // namespace grimaldi
