#include "validation/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/constants.h"
#include "validation/bessel.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

// `error` is a promise: the truth lies within it.
void expect_integral(const Integral& integral, Complex truth, double tolerance) {
  EXPECT_LE(std::abs(integral.value - truth), integral.error);
  EXPECT_LE(integral.error, tolerance);
}

TEST(Quadrature, RuleIsExactForPolynomials) {
  // 21 points of Kronrod's rule integrate degree 31 exactly: one panel, rounding only.
  for (int degree = 0; degree <= 30; degree += 2) {
    const Integral integral = integrate([&](double x) { return std::pow(x, degree); }, -1, 1, 1);
    EXPECT_NEAR(integral.value.real(), 2.0 / (degree + 1), 1e-15) << degree;
    EXPECT_EQ(integral.evaluations, 21);
  }
}

TEST(Quadrature, Oscillations) {
  const auto wave = [](double x) { return std::exp(300.0 * j * x); };
  expect_integral(integrate(wave, 0, 2, 1e-13), (std::exp(600.0 * j) - 1.0) / (300.0 * j), 1e-13);
  expect_integral(integrate(wave, 0, 2, 1e-13, 96), (std::exp(600.0 * j) - 1.0) / (300.0 * j), 1e-13);
  // A stationary point and a tail that quickens: ∫_0^∞ e^{−ju² − u²/10}.
  const Complex a{0.1, 1};
  expect_integral(integrate([&](double u) { return std::exp(-a * u * u); }, 0, 20, 1e-13), std::sqrt(pi / a) / 2.0,
                  1e-13);
}

TEST(Quadrature, EndsWithRootsAndLogarithms) {
  expect_integral(integrate([](double x) { return std::sqrt(x); }, 0, 1, 1e-12), 2.0 / 3, 1e-12);
  expect_integral(integrate([](double x) { return std::log(x); }, 0, 1, 1e-12), -1.0, 1e-12);
  expect_integral(integrate([](double x) { return 1e-3 / (x * x + 1e-6); }, -1, 1, 1e-12), 2 * std::atan(1e3), 1e-12);
}

TEST(Quadrature, EmptyAndReversedRanges) {
  EXPECT_EQ(integrate([](double) { return 1.0; }, 2, 2, 0).value, 0.0);
  EXPECT_NEAR(integrate([](double x) { return x; }, 1, 0, 1e-14).value.real(), -0.5, 1e-15);
}

TEST(Quadrature, WholeLine) {
  expect_integral(integrate_line([](double x) { return std::exp(-x * x); }, 6.3, 1e-15, 0.5), std::sqrt(pi), 1e-14);
  // K_0 by its integral, w = 2 + 3j, against Boost.Math's Hankel function by K_0(jx) = −(jπ/2) H_0^(2)(x) for real x.
  const Integral integral = integrate_line(
      [](double v) {
        return 0.5 * std::exp(-5.0 * j * std::cosh(v + j * std::atan(-std::sinh(v)) / 2.0)) *
               (1.0 - j / (2 * std::cosh(v)));
      },
      5, 1e-14, 0.2);
  EXPECT_LE(std::abs(integral.value - -j * pi / 2.0 * hankel2(0, 5)), 1e-13);
}

TEST(Quadrature, GaussLegendre) {
  for (const int n : {1, 2, 5, 16, 64, 255, 256}) {
    const auto& rule = gauss_legendre(n);
    ASSERT_EQ(static_cast<int>(rule.size()), n);
    double length = 0, square = 0, odd = 0;
    for (const QuadratureNode& node : rule) {
      length += node.weight;
      square += node.weight * node.x * node.x;
      odd += node.weight * std::pow(node.x, 3);
    }
    // n terms of size 1/n, each good to a few 1e-16.
    EXPECT_NEAR(length, 2, 4e-15) << n;
    EXPECT_NEAR(square, n > 1 ? 2.0 / 3 : 0, 4e-15) << n;
    EXPECT_NEAR(odd, 0, 1e-15) << n;
  }
  // Degree 2n − 1 exactly, 2n not: ∫ P_5² = 2/11.
  double sum = 0;
  for (const auto& [x, weight] : gauss_legendre(6)) sum += weight * std::pow(std::legendre(5, x), 2);
  EXPECT_NEAR(sum, 2.0 / 11, 1e-15);
}

}  // namespace
}  // namespace grimaldi
