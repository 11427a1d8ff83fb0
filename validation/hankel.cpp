#include "validation/hankel.h"

#include <cmath>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

struct KPair {
  Complex zero, one;
};

constexpr double euler_gamma = 0.57721566490153286;

/// K_0 and K_1 by their power series.
KPair k_series(Complex w) {
  const Complex square = 0.25 * w * w, log_half = std::log(0.5 * w);
  Complex term0 = 1, term1 = 1;  // (w²/4)^m / (m!)² and / (m! (m+1)!)
  double harmonic = 0;           // 1 + 1/2 + … + 1/m
  Complex i0 = 0, i1 = 0, rest0 = 0, rest1 = 0;
  for (int m = 0; m < 40; ++m) {
    if (m > 0) {
      term0 *= square / double(m * m);
      term1 *= square / double(m * (m + 1));
      harmonic += 1.0 / m;
    }
    i0 += term0, rest0 += harmonic * term0;
    i1 += term1, rest1 += (2 * (harmonic - euler_gamma) + 1.0 / (m + 1)) * term1;
    if (std::abs(term0) < 1e-18) break;
  }
  return {rest0 - (log_half + euler_gamma) * i0, 1.0 / w + 0.5 * w * log_half * i1 - 0.25 * w * rest1};
}

/// K_0 and K_1 by Temme's continued fraction and the sum that goes with it.
KPair k_fraction(Complex w) {
  Complex b = 2.0 * (1.0 + w), d = 1.0 / b, delta = d, h = d;
  Complex q1 = 0, q2 = 1, q = 0.25, sum = 1.0 + q * delta;
  double a = -0.25, c = 0.25;
  for (int i = 2; i < 10000; ++i) {
    a -= 2 * (i - 1);
    c *= -a / i;
    const Complex next = (q1 - b * q2) / a;
    q1 = q2, q2 = next;
    q += c * next;
    b += 2;
    d = 1.0 / (b + a * d);
    delta *= b * d - 1.0;
    h += delta;
    const Complex more = q * delta;
    sum += more;
    if (std::abs(more) < 1e-17 * std::abs(sum)) break;
  }
  const Complex zero = std::sqrt(pi / (2.0 * w)) * std::exp(-w) / sum;
  return {zero, zero * (w + 0.5 - 0.25 * h) / w};
}

}  // namespace

HankelPair hankel2_pair(Complex z) {
  GRIMALDI_EXPECT(z.real() >= 0 && z.imag() <= 0 && z != 0.0);
  const Complex w{-z.imag(), z.real()};
  const KPair k = std::norm(w) <= 4 ? k_series(w) : k_fraction(w);
  return {Complex(0, 2 / pi) * k.zero, -2 / pi * k.one};
}

}  // namespace grimaldi
