#include "core/medium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

// The exact mid-band frequency that a nominal one stands for, by its definition f = 1000·10^(n/10).
double exact(double nominal) {
  return 1000 * std::pow(10.0, std::round(10 * std::log10(nominal / 1000)) / 10);
}

TEST(Medium, AttenuationOfIso9613Tables) {
  const auto rows = reference_rows("acoustic/iso9613_air_absorption.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/acoustic/iso9613_air_absorption.csv";
  int compared = 0;
  for (const auto& row : rows) {
    const Air air{std::stod(row[1]) + 273.15, std::stod(row[2]) / 100, 101325};
    const double printed = std::stod(row[4]);
    const double here = 1000 * sound_attenuation(air, exact(std::stod(row[3])));
    // 0.5 % or half a unit of the last printed digit, whichever is more: Table 2 of part 2 prints tenths.
    const auto point = row[4].find('.');
    const double half_digit = 0.5 * std::pow(10.0, -static_cast<double>(row[4].size() - 1 - point));
    EXPECT_NEAR(here, printed, std::max(0.005 * printed, half_digit))
        << row[0] << " " << row[1] << " degC " << row[2] << " % " << row[3] << " Hz";
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

TEST(Medium, ValuesOfTheStandardWithoutAnyFile) {
  // ISO 9613-1:1993, Table 1, dB/km to three digits: half a unit of the last.
  EXPECT_NEAR(1000 * sound_attenuation({293.15, 0.5, 101325}, 1000), 4.66, 0.005);
  EXPECT_NEAR(1000 * sound_attenuation({283.15, 0.5, 101325}, exact(4000)), 46.7, 0.05);
}

TEST(Medium, FarAboveTheRelaxationsPureAbsorptionGrowsWithTheSquare) {
  // Above 10 MHz the relaxation terms are constant, 1e-5 of f² times the classical one: what stays is 8.686·1.84e-11
  // f².
  const Air air;
  EXPECT_NEAR(sound_attenuation(air, 1e9) / (8.686 * 1.84e-11 * 1e18), 1.0, 1e-4);
  EXPECT_EQ(sound_attenuation(air, 0), 0);
}

TEST(Medium, AttenuationDependsOnConcentrationAndPressureAsTheGasDoes) {
  // In (3) to (5) pressure enters by f/p at a fixed concentration h of water: α(f, p) = p·α(f/p, 1 atm). Twice the
  // pressure needs twice the relative humidity for the same h. Rounding only: 20 operations.
  const double one = sound_attenuation({293.15, 0.3, 101325}, 1000);
  const double two = sound_attenuation({293.15, 0.6, 2 * 101325.0}, 2000);
  EXPECT_NEAR(two / one, 2.0, 1e-14);
}

TEST(Medium, SpeedOfWaves) {
  EXPECT_EQ(wave_speed(WaveKind::radio, {}), speed_of_light);
  EXPECT_EQ(wave_speed(WaveKind::acoustic, {}), 343.2);
  // ISO 9613-1's formula at 0 °C, 343.2 √(273.15/293.15) = 331.286; the textbooks' 331.3 m/s to four digits.
  EXPECT_NEAR(wave_speed(WaveKind::acoustic, {273.15, 0.5, 101325}), 331.3, 0.05);
}

TEST(Medium, ImpedanceOfAir) {
  // ρ of dry air at 20 °C and 1 atm: 1.2041 kg/m³ (US Standard Atmosphere's gas), times 343.2 m/s; half the last digit.
  EXPECT_NEAR(characteristic_impedance({}), 1.2041 * 343.2, 0.00005 * 343.2);
  // ρc ~ p/√T
  EXPECT_NEAR(characteristic_impedance({4 * 293.15, 0.5, 3 * 101325.0}) / characteristic_impedance({}), 1.5, 1e-15);
}

}  // namespace
}  // namespace grimaldi
