#include "core/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/constants.h"
#include "core/p2040.h"
#include "core/quantity.h"

namespace grimaldi {
namespace {

// ---- the built-in table ---------------------------------------------------------------------------------------------

struct AbsorptionRow {
  std::string_view name;
  std::array<double, 7> octaves;  // 125 Hz … 8 kHz
};

// Random-incidence absorption coefficients. Source: M. Vorländer, Auralization, Springer 2008, appendix with tables of
// random-incidence absorption coefficients, the entry named behind each row. The appendix has no 63 Hz octave: the
// value of 125 Hz is used there; where it ends at 4 kHz (*) that value is used at 8 kHz. It has no entry that fits
// vacuum, metal or bare ground; those materials have no spectrum.
constexpr AbsorptionRow vorlaender[] = {
    {"concrete", {0.02, 0.03, 0.03, 0.03, 0.04, 0.07, 0.07}},       // rough concrete
    {"brick", {0.03, 0.03, 0.03, 0.04, 0.05, 0.07, 0.07}},          // brick wall, stuccoed with a rough finish
    {"plasterboard", {0.15, 0.10, 0.06, 0.04, 0.04, 0.05, 0.05}},   // 2 × 13 mm on steel frame, mineral wool in cavity
    {"wood", {0.18, 0.12, 0.10, 0.09, 0.08, 0.07, 0.07}},           // 16 mm wood on 40 mm studs
    {"glass", {0.10, 0.05, 0.04, 0.03, 0.03, 0.03, 0.03}},          // glass window, 0.68 kg/m²
    {"ceiling_board", {0.49, 0.53, 0.53, 0.75, 0.92, 0.99, 0.99}},  // fissured ceiling tile (*)
    {"chipboard", {0.18, 0.12, 0.10, 0.09, 0.08, 0.07, 0.07}},      // 16 mm wood on 40 mm studs
    {"plywood", {0.27, 0.23, 0.22, 0.15, 0.10, 0.07, 0.06}},        // wooden lining, 12 mm fixed on frame
    {"marble", {0.01, 0.01, 0.01, 0.02, 0.02, 0.02, 0.02}},         // marble floor
    {"floorboard", {0.10, 0.07, 0.06, 0.06, 0.06, 0.06, 0.06}},     // stage floor, 2 layers, 27 mm over airspace (*)
};

std::map<std::string, Material> make_built_in_materials() {
  std::map<std::string, Material> table = p2040_materials(3);
  const std::vector<double> octaves = octave_bands(63, 8000);
  for (const AbsorptionRow& row : vorlaender) {
    Spectrum spectrum{octaves, {row.octaves.front()}};
    spectrum.value.insert(spectrum.value.end(), row.octaves.begin(), row.octaves.end());
    table.at(std::string(row.name)).absorption = std::move(spectrum);
  }
  return table;
}

// ---- spectra
// ----------------------------------------------------------------------------------------------------------

bool is_usable(const Spectrum& spectrum) {
  return !spectrum.frequency.empty() && spectrum.frequency.size() == spectrum.value.size();
}

// Linear in log f between the points, the value of the nearest end outside. Requires is_usable(spectrum).
double interpolated(const Spectrum& spectrum, double frequency) {
  const auto& f = spectrum.frequency;
  const auto above = std::upper_bound(f.begin(), f.end(), frequency);
  if (above == f.begin()) return spectrum.value.front();
  if (above == f.end()) return spectrum.value.back();
  const auto i = static_cast<std::size_t>(above - f.begin());
  const double share = std::log(frequency / f[i - 1]) / std::log(f[i] / f[i - 1]);
  return spectrum.value[i - 1] + share * (spectrum.value[i] - spectrum.value[i - 1]);
}

// The value of a table, with an error if the table does not reach the frequency by a factor of `reach`.
double from_table(const Spectrum& spectrum, double frequency, double reach, const Material& material,
                  std::string_view quantity, Diagnostics& diagnostics) {
  const std::string option = "material." + material.name;
  if (!is_usable(spectrum)) {
    diagnostics.error(
        {}, 0, option, fmt::format("the table of {} is not usable", quantity),
        fmt::format("it has {} frequencies and {} values", spectrum.frequency.size(), spectrum.value.size()),
        "give one value per frequency");
    return 0;
  }
  const double value = interpolated(spectrum, frequency);
  const double lowest = spectrum.frequency.front(), highest = spectrum.frequency.back();
  if (spectrum.frequency.size() > 1 && (frequency * reach < lowest || frequency > highest * reach))
    diagnostics.error({}, 0, option,
                      fmt::format("the table of {} does not cover {}", quantity, format_frequency(frequency)),
                      fmt::format("it goes from {} to {}", format_frequency(lowest), format_frequency(highest)),
                      "extend the table, give one constant value, or leave this frequency out");
  return value;
}

// ---- ITU-R P.2040
// -----------------------------------------------------------------------------------------------------

struct Electric {
  double permittivity;  // relative
  double conductivity;  // S/m
};

// Distance of a frequency from a range, as a ratio ≥ 1 (1 = inside).
double ratio_outside(const PermittivityRange& range, double f_GHz) {
  if (f_GHz < range.from_GHz) return range.from_GHz / f_GHz;
  if (f_GHz > range.to_GHz) return f_GHz / range.to_GHz;
  return 1;
}

Electric from_p2040(const Material& material, double frequency, Diagnostics& diagnostics) {
  const double f = frequency / 1e9;
  const PermittivityRange& range =
      *std::min_element(material.radio.begin(), material.radio.end(), [&](const auto& a, const auto& b) {
        return ratio_outside(a, f) < ratio_outside(b, f);  // the first range that holds f, else the nearest
      });
  const Electric result{range.a * std::pow(f, range.b), range.c * std::pow(f, range.d)};
  if (ratio_outside(range, f) > 1)
    diagnostics.warning(
        {}, 0, "material." + material.name,
        fmt::format("ITU-R P.2040 used outside its range at {}", format_frequency(frequency)),
        fmt::format("the nearest range is {} to {}", format_frequency(range.from_GHz * 1e9),
                    format_frequency(range.to_GHz * 1e9)),
        fmt::format("used: relative permittivity {:.5g}, conductivity {:.5g} S/m; give relative_permittivity and "
                    "conductivity to replace them",
                    result.permittivity, result.conductivity));
  return result;
}

// Takes `prefix` off the front, unless nothing would be left.
void strip(std::string& name, std::string_view prefix) {
  if (name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0) name.erase(0, prefix.size());
}

}  // namespace

std::string material_key(std::string_view name) {
  std::string key;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isspace(byte) == 0)
      key += static_cast<char>(std::tolower(byte));
    else if (!key.empty() && key.back() != ' ')
      key += ' ';  // a run of blanks counts as one
  }
  if (!key.empty() && key.back() == ' ') key.pop_back();
  std::replace(key.begin(), key.end(), ' ', '_');
  strip(key, "mat-");
  strip(key, "itu_");
  return key;
}

const std::map<std::string, Material>& built_in_materials() {
  static const std::map<std::string, Material> table = make_built_in_materials();
  return table;
}

std::complex<double> relative_permittivity(const Material& material, double frequency, Diagnostics& diagnostics) {
  GRIMALDI_EXPECT(frequency > 0);
  const std::string option = "material." + material.name;
  Electric used{1, 0};
  if (material.radio.empty()) {
    if (!material.permittivity) {
      diagnostics.error({}, 0, option, "nothing known for radio",
                        "the material has neither a relative permittivity nor constants of ITU-R P.2040",
                        "give relative_permittivity and conductivity, or use a material of the built-in table");
      return {1, 0};
    }
    if (!material.conductivity)
      diagnostics.warning({}, 0, option, "no conductivity known", "only a relative permittivity is given",
                          "used: conductivity 0 S/m (a lossless material)");
  } else if (!material.permittivity || !material.conductivity) {
    used = from_p2040(material, frequency, diagnostics);
  }
  if (material.permittivity)
    used.permittivity =
        from_table(*material.permittivity, frequency, 1.0, material, "relative permittivity", diagnostics);
  if (material.conductivity)
    used.conductivity = from_table(*material.conductivity, frequency, 1.0, material, "conductivity", diagnostics);
  return {used.permittivity, -used.conductivity / (vacuum_permittivity * 2 * pi * frequency)};
}

double absorption_coefficient(const Material& material, double frequency, Diagnostics& diagnostics) {
  GRIMALDI_EXPECT(frequency > 0);
  if (!material.absorption) {
    constexpr double unknown = 0.05;  // between hard masonry (0.02 … 0.04) and light claddings (0.1)
    diagnostics.warning(
        {}, 0, "material." + material.name, "no absorption known",
        "the material has no absorption coefficient for sound",
        fmt::format("used: {} at {}; give absorption to replace it", unknown, format_frequency(frequency)));
    return unknown;
  }
  const double half_octave = std::sqrt(2.0);
  return from_table(*material.absorption, frequency, half_octave, material, "absorption", diagnostics);
}

}  // namespace grimaldi
