#pragma once
// The chance of a χ², for the tests of samplers.

#include <cmath>

namespace grimaldi {

/// Q(a, x), regularised upper incomplete gamma function: series or continued fraction (Numerical Recipes, 3rd
/// ed., 6.2). Chance of a χ² of 2a degrees above 2x.
inline double upper_gamma(double a, double x) {
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 1000; ++n) sum += term *= x / (a + n);
    return 1 - sum * front;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 1000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
  }
  return front * h;
}

}  // namespace grimaldi
