#pragma once
// The air: speed of a wave in it and what it takes away.

#include "core/bands.h"

namespace grimaldi {

struct Air {
  double temperature = 293.15;     ///< K, 223.15 … 323.15
  double relative_humidity = 0.5;  ///< 0 … 1
  double pressure = 101325.0;      ///< Pa
};

/// Speed of the wave, m/s. Radio: the speed of light in vacuum (the refractivity of air, 3e-4, is left out).
/// Sound: c = 343.2 √(T/293.15) m/s. Source: ISO 9613-1:1993, clause 6.
double wave_speed(WaveKind kind, const Air& air);

/// Characteristic impedance of air ρc, Pa·s/m, at its temperature and pressure (ideal gas, M = 28.9647 g/mol).
double characteristic_impedance(const Air& air);

/// Pure-tone attenuation by the atmosphere for sound, dB/m (of level: 10 lg of power).
/// Source: ISO 9613-1:1993, equations (3) to (5), (B.2), (B.3).
/// frequency in Hz (exact mid-band frequency, 50 Hz … 10 kHz in the standard; the formula is used outside it too).
/// Error: ±10 % of nature in the standard's range; the printed tables to half a unit of their last digit.
double sound_attenuation(const Air& air, double frequency);

}  // namespace grimaldi
