// Sine and cosine of the kernels against the library's.

#include "core/sine_cosine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/constants.h"
#include "core/random.h"

namespace grimaldi {
namespace {

// The library's are right to 0.6 ulp (glibc), 7e-17 absolute.
TEST(SineCosine, AgainstTheLibrary) {
  double worst = 0, worst_relative = 0;
  for (std::uint64_t i = 0; i < 500000; ++i) {
    const auto u = uniform4(1, 1, i, 0);
    const double x = (2 * u[0] - 1) * std::pow(10.0, 18 * u[1] - 9);
    const auto [s, c] = sine_cosine(x);
    const double sine = std::sin(x), cosine = std::cos(x);
    worst = std::fmax(worst, std::fmax(std::fabs(s - sine), std::fabs(c - cosine)));
    if (std::fabs(sine) < 0.7 && x != 0) worst_relative = std::fmax(worst_relative, std::fabs(s / sine - 1));
    if (std::fabs(cosine) < 0.7) worst_relative = std::fmax(worst_relative, std::fabs(c / cosine - 1));
  }
  std::printf("sine, cosine: %.1e absolute, %.1e relative\n", worst, worst_relative);
  EXPECT_LT(worst, 2.5e-16);
  EXPECT_LT(worst_relative, 4e-16);
}

TEST(SineCosine, AtQuarterTurnsAndZero) {
  for (int n = -2000000; n < 2000000; n += 37) {
    const double x = n * (pi / 2);
    const auto [s, c] = sine_cosine(x);
    EXPECT_LE(std::fabs(s - std::sin(x)), 2.3e-16 * std::fabs(std::sin(x)) + 2e-33 * std::fabs(x)) << n;
    EXPECT_LE(std::fabs(c - std::cos(x)), 2.3e-16 * std::fabs(std::cos(x)) + 2e-33 * std::fabs(x)) << n;
  }
  EXPECT_EQ(sine_cosine(0).sine, 0);
  EXPECT_EQ(sine_cosine(0).cosine, 1);
  EXPECT_EQ(sine_cosine(1e-300).sine, 1e-300);
}

}  // namespace
}  // namespace grimaldi
