#include "validation/bessel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

TEST(Bessel, HalfIntegerOrders) {
  // Closed forms of order 1/2 and 3/2: the bound of the header.
  for (const double x : {1e-3, 0.3, 1.0, 7.5, 40.0, 333.3, 1000.0}) {
    const double scale = std::sqrt(2 / (pi * x));
    EXPECT_NEAR(bessel_j(0.5, x), scale * std::sin(x), 1e-14 * scale) << x;
    if (x > 0.1) {  // the closed form cancels below
      EXPECT_NEAR(bessel_j(1.5, x), scale * (std::sin(x) / x - std::cos(x)), 2e-14 * scale * (1 + 1 / x)) << x;
    }
    const std::complex<double> h = scale * std::complex<double>(std::sin(x), std::cos(x));  // j e^{−jx}
    EXPECT_LE(std::abs(hankel2(0.5, x) - h), 1e-14 * std::abs(h)) << x;
  }
}

TEST(Bessel, Wronskian) {
  // J_{ν+1} Y_ν − J_ν Y_{ν+1} = 2/(πx), for the orders m/n of wedges; two products, each good to 1e-14 or better.
  for (const double n : {0.5, 2.0 / 3, 1.25, 4.0 / 3, 1.5, 5.0 / 3, 1.75, 2.0})
    for (const double x : {0.05, 0.7, 3.0, 20.0, 40.0, 150.0})
      for (int m = 0; m <= 60; m += 3) {
        const double order = m / n;
        const auto low = hankel2(order, x), high = hankel2(order + 1, x);
        if (!std::isfinite(high.imag())) continue;
        const double product = low.real() * high.imag() - high.real() * low.imag();
        EXPECT_NEAR(product * pi * x / 2, 1, 2e-13) << order << " " << x;
      }
}

TEST(Bessel, NothingOverflows) {
  EXPECT_EQ(bessel_j(400, 0.1), 0);
  EXPECT_TRUE(std::isinf(hankel2(400, 0.1).imag()));
  EXPECT_EQ(bessel_j(0, 0), 1);
  EXPECT_EQ(bessel_j(0.5, 0), 0);
}

}  // namespace
}  // namespace grimaldi
