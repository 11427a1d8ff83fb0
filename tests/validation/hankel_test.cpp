// Hankel functions off the real axis.

#include "validation/hankel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.h"
#include "validation/bessel.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

TEST(Hankel, OnTheRealAxis) {
  // Another implementation; both turn by a rounded argument: 1e-16 |z|.
  for (double z = 1e-8; z < 1e3; z *= 1.07) {
    const HankelPair pair = hankel2_pair(z);
    for (const auto& [ours, theirs] : {std::pair{pair.zero, hankel2(0, z)}, {pair.one, hankel2(1, z)}})
      EXPECT_LE(std::abs(ours - theirs), (2e-14 + 2e-16 * z) * std::abs(theirs)) << z;
  }
}

TEST(Hankel, OffTheRealAxis) {
  // K_ν(w) = ∫_0^∞ e^{−w cosh t} cosh νt dt, Re w > 0, by the trapezoidal rule of 1e-15 of its largest value.
  for (const double size : {0.05, 0.7, 1.9, 2.1, 4.0, 13.0, 60.0})
    for (const double turn : {-0.2, -0.5, -pi / 4, -1.2, -1.5}) {
      const Complex z = std::polar(size, turn), w{-z.imag(), z.real()};
      const double reach = std::acosh(1 + 40 / w.real());
      const auto integral = [&](int nu) {
        return 0.5 *
               integrate_line([&](double t) { return std::exp(-w * std::cosh(t)) * std::cosh(nu * t); }, reach, 0, 0.1)
                   .value;
      };
      const HankelPair pair = hankel2_pair(z);
      // The integral's rounding is that of its largest value, e^{−Re w} times the width.
      const double rest = 1e-13 * std::exp(-w.real()) * (1 + 1 / std::abs(w));
      EXPECT_LE(std::abs(pair.zero - Complex(0, 2 / pi) * integral(0)), rest) << z;
      EXPECT_LE(std::abs(pair.one + 2 / pi * integral(1)), rest) << z;
    }
}

}  // namespace
}  // namespace grimaldi
