// Gases and rain against the Recommendations' own validation rows.

#include "core/radio_attenuation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/constants.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

// Largest relative error of dry, vapour and total; vapour 0 in dry air.
void compare_gas(const char* file, double bound, std::size_t least) {
  const auto rows = reference_rows(std::string("radio/") + file);
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/" << file;
  double worst = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const GasAttenuation gas = gas_attenuation(number(1), {number(2), number(3), number(4)});
    double error = std::max(std::abs(gas.dry / number(5) - 1), std::abs(gas.total() / number(7) - 1));
    if (number(6) > 0)
      error = std::max(error, std::abs(gas.vapour / number(6) - 1));
    else
      EXPECT_EQ(gas.vapour, 0);
    EXPECT_LT(error, bound) << row[0];
    worst = std::max(worst, error);
  }
  std::printf("%s: %zu rows, largest relative error %.1e\n", file, rows.size(), worst);
  EXPECT_GE(rows.size(), least);
}

// ITU-R's numbers have nine decimals, 4e-8 of the smallest; 1e-6 is asked.
TEST(RadioAttenuation, GasOfP676Version12) { compare_gas("p676_12_specific_attenuation.csv", 1e-7, 40); }
TEST(RadioAttenuation, GasOfP676Version13) { compare_gas("p676_13_specific_attenuation.csv", 1e-13, 60); }
// 12 digits are printed.
TEST(RadioAttenuation, GasOfOtherAtmospheres) { compare_gas("p676_13_other_atmospheres.csv", 1e-11, 30); }

TEST(RadioAttenuation, GasTheorems) {
  // No air, no loss; the lines stand out; dry air has no 22 GHz line.
  EXPECT_EQ(gas_attenuation(60, {0, 288.15, 0}).total(), 0);
  EXPECT_GT(gas_attenuation(60, {}).dry, 10 * gas_attenuation(50, {}).dry);
  EXPECT_GT(gas_attenuation(22.235, {}).vapour, 2 * gas_attenuation(30, {}).vapour);
  // Far below its lines the vapour's loss grows as f².
  EXPECT_NEAR(gas_attenuation(0.02, {}).vapour / gas_attenuation(0.01, {}).vapour, 4, 1e-4);
}

TEST(RadioAttenuation, RainOfP838) {
  const auto rows = reference_rows("radio/p838_3_rain.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p838_3_rain.csv";
  double worst = 0, worst_own = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const double degree = pi / 180;
    const RainLaw law = rain_law(number(1), number(3) * degree, number(4) * degree);
    const double rain = rain_attenuation(number(1), number(2), number(3) * degree, number(4) * degree);
    EXPECT_NEAR(law.k / number(5), 1, 1e-6) << row[0];
    EXPECT_NEAR(law.alpha / number(6), 1, 1e-6) << row[0];
    EXPECT_NEAR(rain / number(7), 1, 1e-6) << row[0];
    worst = std::max(worst, std::abs(rain / number(7) - 1));
    worst_own = std::max(worst_own, std::abs(rain / number(10) - 1));
  }
  std::printf("p838_3_rain.csv: %zu rows, largest relative error %.1e, %.1e of the nine-digit column\n", rows.size(),
              worst, worst_own);
  EXPECT_LT(worst_own, 5e-9);
  EXPECT_GT(rows.size(), 30u);
}

TEST(RadioAttenuation, RainCoefficientsOfP838) {
  const auto rows = reference_rows("radio/p838_3_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p838_3_coefficients.csv";
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const RainLaw horizontal = rain_law(number(1), 0, 0), vertical = rain_law(number(1), 0, pi / 2);
    // Nine digits are printed.
    EXPECT_NEAR(horizontal.k / number(2), 1, 5e-9) << row[0];
    EXPECT_NEAR(horizontal.alpha / number(3), 1, 5e-9) << row[0];
    EXPECT_NEAR(vertical.k / number(4), 1, 5e-9) << row[0];
    EXPECT_NEAR(vertical.alpha / number(5), 1, 5e-9) << row[0];
    EXPECT_NEAR(rain_attenuation(number(1), 10, 0, 0) / number(6), 1, 5e-9) << row[0];
    EXPECT_NEAR(rain_attenuation(number(1), 50, 0, pi / 2) / number(7), 1, 5e-9) << row[0];
    EXPECT_NEAR(rain_attenuation(number(1), 100, pi / 6, pi / 4) / number(8), 1, 5e-9) << row[0];
  }
}

// Circular polarisation is the mean of k, whatever the elevation; a path straight up sees no difference either.
TEST(RadioAttenuation, RainTheorems) {
  const RainLaw h = rain_law(12, 0, 0), v = rain_law(12, 0, pi / 2), circular = rain_law(12, 0.3, pi / 4),
                up = rain_law(12, pi / 2, 0.1);
  EXPECT_NEAR(circular.k, 0.5 * (h.k + v.k), 1e-15);
  EXPECT_NEAR(up.k, 0.5 * (h.k + v.k), 1e-15);
  EXPECT_EQ(rain_attenuation(12, 0, 0, 0), 0);
}

}  // namespace
}  // namespace grimaldi
