// Gauss-Legendre rules: polynomials up to their degree.

#include "core/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grimaldi {
namespace {

// ∫ x^m over −1 … 1 is 2/(m + 1) or 0; rounding of 48 terms: 1e-14. The next even power is not met by a rule of few.
TEST(GaussLegendre, IsExactUpToItsDegree) {
  for (const int n : {1, 2, 5, 12, 48}) {
    const auto rule = gauss_legendre_points(n);
    ASSERT_EQ(rule.size(), static_cast<std::size_t>(n));
    const auto moment = [&](int m) {
      double sum = 0;
      for (const GaussPoint& point : rule) sum += point.weight * std::pow(point.position, m);
      return sum;
    };
    for (int m = 0; m < 2 * n; ++m) EXPECT_NEAR(moment(m), m % 2 == 0 ? 2.0 / (m + 1) : 0, 1e-14) << n << ' ' << m;
    if (n <= 5) {
      EXPECT_GT(std::abs(moment(2 * n) - 2.0 / (2 * n + 1)), 1e-4) << n;
    }
    for (int i = 1; i < n; ++i) EXPECT_LT(rule[std::size_t(i - 1)].position, rule[std::size_t(i)].position);
  }
}

}  // namespace
}  // namespace grimaldi
