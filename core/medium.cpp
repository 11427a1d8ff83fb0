#include "core/medium.h"

#include <cmath>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

constexpr double reference_temperature = 293.15;  // K, ISO 9613-1
constexpr double reference_pressure = 101325.0;   // Pa, ISO 9613-1
constexpr double triple_point = 273.16;           // K, of water, ISO 9613-1 annex B
constexpr double gas_constant = 8.314462618;      // J/(mol·K), CODATA 2018 (exact since 2019)
constexpr double molar_mass_of_air = 28.9647e-3;  // kg/mol, dry, US Standard Atmosphere 1976

double speed_of_sound(const Air& air) {
  return 343.2 * std::sqrt(air.temperature / reference_temperature);
}

}  // namespace

double wave_speed(WaveKind kind, const Air& air) {
  if (kind == WaveKind::radio) return speed_of_light;
  GRIMALDI_EXPECT(air.temperature > 0);
  return speed_of_sound(air);
}

double characteristic_impedance(const Air& air) {
  GRIMALDI_EXPECT(air.temperature > 0 && air.pressure > 0);
  return air.pressure * molar_mass_of_air / (gas_constant * air.temperature) * speed_of_sound(air);
}

double sound_attenuation(const Air& air, double frequency) {
  GRIMALDI_EXPECT(air.temperature > 0 && air.pressure > 0 && air.relative_humidity >= 0 && frequency >= 0);
  const double T = air.temperature;
  const double pressure = air.pressure / reference_pressure;
  const double warmth = T / reference_temperature;
  // Molar concentration of water vapour in percent: (B.1) to (B.3).
  const double saturation = std::pow(10.0, -6.8346 * std::pow(triple_point / T, 1.261) + 4.6151);
  const double h = 100 * air.relative_humidity * saturation / pressure;
  // Relaxation frequencies of oxygen and nitrogen, Hz: (3) and (4).
  const double oxygen = pressure * (24 + 4.04e4 * h * (0.02 + h) / (0.391 + h));
  const double nitrogen = pressure / std::sqrt(warmth) * (9 + 280 * h * std::exp(-4.170 * (std::cbrt(1 / warmth) - 1)));
  // (5). Each relaxation term is written 1/(f_r + f²/f_r).
  const double f2 = frequency * frequency;
  const double classical = 1.84e-11 / pressure * std::sqrt(warmth);
  const double relaxation = 0.01275 * std::exp(-2239.1 / T) / (oxygen + f2 / oxygen) +
                            0.1068 * std::exp(-3352.0 / T) / (nitrogen + f2 / nitrogen);
  return 8.686 * f2 * (classical + std::pow(warmth, -2.5) * relaxation);
}

}  // namespace grimaldi
