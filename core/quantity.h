#pragma once
// Numbers with units, as people write them: "3.5GHz", "30dBm", "5 m", "550nm", "20degC"; a bare number is SI.

#include <optional>
#include <string>
#include <string_view>

namespace grimaldi {

enum class Dimension {
  number,       ///< no unit; "%" = 0.01
  length,       ///< → m: m, km, cm, mm, um, µm, nm
  frequency,    ///< → Hz: Hz, kHz, MHz, GHz, THz
  time,         ///< → s: s, ms, us, µs, ns, ps, min, h
  power_level,  ///< → dBm: dBm, dBW, W, mW, kW (watts are converted); a bare number is W (SI)
  sound_level,  ///< → dB re 1 pW: dB; a bare number is taken as dB
  ratio,        ///< → dB: dB; a bare number is dB
  angle,        ///< → degrees: deg, °, rad; a bare number is degrees
  temperature,  ///< → K: K, degC, °C; a bare number is K
  pressure,     ///< → Pa: Pa, hPa, kPa, mbar, bar, atm
  conductivity  ///< → S/m: S/m, mS/m
};

struct QuantityFault {
  std::string problem;     ///< "not a number", "unit of the wrong kind", "unknown unit", "not finite",
                           ///< "negative power"
  std::string why;         ///< e.g. "5m is a length, a frequency is needed"
  std::string suggestion;  ///< e.g. "write 3.5GHz"
};

/// The value of `text` in the unit named above. Returns nothing and fills `fault` when the text is not a finite number
/// with a unit of this dimension. Blanks around and between are allowed; the decimal mark is a point in every locale;
/// case counts (mW ≠ MW), yet a unit that is wrong only by its case is suggested.
std::optional<double> parse_quantity(std::string_view text, Dimension dimension, QuantityFault& fault);

/// The name of the dimension with its usual unit, e.g. "a frequency (Hz, kHz, MHz, GHz)".
std::string describe(Dimension dimension);

/// A short text for people, e.g. "3.5 GHz", "500 Hz", "7.943 kHz" (SI prefix so that 1 ≤ |value| < 1000, up to 4
/// digits).
std::string format_frequency(double hertz);

}  // namespace grimaldi
