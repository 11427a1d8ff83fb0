// The Fresnel integral of the references, one and two knife edges.

#include "validation/knife_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/fresnel_integral.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

TEST(FresnelIntegral, Ends) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_LE(std::abs(fresnel_tail(0) - 0.5), 1e-15);
  EXPECT_EQ(fresnel_tail(infinity), 0.0);
  EXPECT_EQ(fresnel_tail(-infinity), 1.0);
}

TEST(FresnelIntegral, AgainstTheOscillatingIntegral) {
  // ½ − (e^{jπ/4}/√π) ∫_0^x e^{−ju²} du, the definition, by adaptive quadrature of 1e-14.
  for (const double x : {1e-8, 0.1, 0.7, 1.9, 2.1, 4.0, 9.7, 21.3}) {
    const Integral part =
        integrate([](double u) { return std::polar(1.0, -u * u); }, 0, x, 1e-14, 1 + static_cast<int>(x * x / 6));
    const Complex truth = 0.5 - std::polar(1 / std::sqrt(pi), pi / 4) * part.value;
    EXPECT_LE(std::abs(fresnel_tail(x) - truth), 3e-14) << x;
    EXPECT_LE(std::abs(fresnel_tail(-x) - (1.0 - truth)), 3e-14) << x;
  }
}

TEST(FresnelIntegral, AsymptoticSeries) {
  // e^{−z²}/(2√π z) (1 − 1/2z² + 3/4z⁴ − 15/8z⁶), z = e^{jπ/4}x; the next term is 6.6/x⁸. Both turn by the
  // same rounded x².
  for (const double x : {100.0, 1e3, 1e5, 1e8}) {
    const Complex z2 = j * x * x;
    const Complex series = std::polar(1 / (2 * std::sqrt(pi) * x), -pi / 4) * std::polar(1.0, -x * x) *
                           (1.0 - 0.5 / z2 + 0.75 / (z2 * z2) - 1.875 / (z2 * z2 * z2));
    EXPECT_LE(std::abs(fresnel_tail(x) - series), 2e-15 * std::abs(series)) << x;
  }
}

TEST(ExactKnifeEdge, Babinet) {
  // A screen and its complement add up to the free field.
  for (double v = 0; v < 30; v += 0.37)
    EXPECT_LE(std::abs(exact_knife_edge(v) + exact_knife_edge(-v) - 1.0), 1e-15) << v;
}

TEST(ExactKnifeEdge, Power) {
  // ∫_0^∞ |E|² dv = 1/(2π); the tail beyond V is 1/(2π²V), less 1/(2π⁴V⁵)·5/… below 1e-12 at V = 200.
  const double end = 200;
  const Integral power = integrate([](double v) { return std::norm(exact_knife_edge(v)); }, 0, end, 1e-12, 40);
  EXPECT_NEAR(power.value.real() + 1 / (2 * pi * pi * end), 1 / (2 * pi), 1e-11);
}

constexpr DoubleKnifeEdge hill{0.3, 1000, 500, 800, 12, -4};

TEST(DoubleKnifeEdge, AgainstTheDoubleIntegral) {
  // The definition on the rotated rays x_i = h_i + e^{−jπ/4} u_i, on which the integrand falls like a Gaussian.
  for (const DoubleKnifeEdge& e :
       {hill, DoubleKnifeEdge{0.05, 40, 12, 25, 0.5, 0.9}, DoubleKnifeEdge{0.1, 100, 100, 100, -1, -2}}) {
    const double k = 2 * pi / e.wavelength, D = e.d1 + e.d2 + e.d3;
    const Complex ray = std::polar(1.0, -pi / 4);
    const auto phase = [&](Complex x1, Complex x2) {
      return -j * (k / 2) * (x1 * x1 / e.d1 + (x2 - x1) * (x2 - x1) / e.d2 + x2 * x2 / e.d3);
    };
    const double end = 9 * std::sqrt(e.wavelength * D / 8);
    const Integral outer = integrate(
        [&](double u1) {
          return integrate([&](double u2) { return std::exp(phase(e.h1 + ray * u1, e.h2 + ray * u2)); }, 0, end, 1e-14,
                           4)
              .value;
        },
        0, end, 1e-12, 4);
    const Complex truth = j / e.wavelength * std::sqrt(D / (e.d1 * e.d2 * e.d3)) * ray * ray * outer.value;
    // Heights below the line make the integrand of the rays large before it falls: e^{few}.
    EXPECT_LE(std::abs(exact_double_knife_edge(e) - truth), 1e-10) << e.h1;
  }
}

TEST(DoubleKnifeEdge, QuadrantAtGrazing) {
  // Both edges on the line: the quadrant probability of two correlated Gaussians, 1/3 for equal spacing.
  EXPECT_LE(std::abs(exact_double_knife_edge({0.1, 70, 70, 70, 0, 0}) - 1.0 / 3), 1e-14);
  const double r = std::sqrt(1000.0 * 200 / (1500.0 * 700));
  EXPECT_LE(std::abs(exact_double_knife_edge({0.1, 1000, 500, 200, 0, 0}) - (0.25 + std::asin(r) / (2 * pi))), 1e-14);
}

TEST(DoubleKnifeEdge, Reciprocity) {
  const DoubleKnifeEdge back{hill.wavelength, hill.d3, hill.d2, hill.d1, hill.h2, hill.h1};
  EXPECT_LE(std::abs(exact_double_knife_edge(hill) - exact_double_knife_edge(back)), 1e-14);
}

TEST(DoubleKnifeEdge, OneEdgeOutOfTheWay) {
  // The second edge far below: what it takes away falls like 1/(√2 π ν): 2.3e-3 at ν = −98.
  DoubleKnifeEdge alone = hill;
  alone.h2 = -870;
  const double v = hill.h1 * std::sqrt(2 / hill.wavelength * (1 / hill.d1 + 1 / (hill.d2 + hill.d3)));
  EXPECT_LE(std::abs(exact_double_knife_edge(alone) - exact_knife_edge(v)), 2.5e-3);
}

// Beyond |ν| = 100 the two terms of the formula cancel: refused, not guessed.
TEST(DoubleKnifeEdge, RefusesWhatItCannotKeep) {
  EXPECT_NO_THROW(exact_double_knife_edge({0.1, 100, 100, 100, 100, 10}));
  EXPECT_THROW(exact_double_knife_edge({0.01, 100, 100, 100, 500, 500}), InputErrors);
  EXPECT_THROW(exact_double_knife_edge({0.1, 100, 100, 100, 0, -1e4}), InputErrors);
}

TEST(DoubleKnifeEdge, RefusesLengthsOfZero) {
  EXPECT_THROW(exact_double_knife_edge({0.3, 0, 1, 1, 0, 0}), InputErrors);
  EXPECT_THROW(exact_double_knife_edge({-0.3, 1, 1, 1, 0, 0}), InputErrors);
  EXPECT_THROW(exact_double_knife_edge({0.3, 1, 1, 1, 0, std::nan("")}), InputErrors);
}

}  // namespace
}  // namespace grimaldi
