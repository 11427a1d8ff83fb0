#pragma once
// Sine and cosine in one go, without a branch, so that loops over them are vectorised and give the bits of the single
// call.

#include <bit>
#include <cmath>
#include <cstdint>

namespace grimaldi {

struct SineCosine {
  double sine, cosine;
};

/// Formula: x = nπ/2 + r, |r| ≤ π/4, n the nearest whole number; Taylor series of r.
/// Source: of the reduction, Cody & Waite, Software Manual for the Elementary Functions, 1980: π/2 in two doubles; the
/// first product is exact with one rounding of a·b+c.
/// Inputs: rad, |x| ≤ 1e9.
/// Error: ≤ 2.5e-16 absolute; ≤ 4e-16 of the value + 2e-33 |x| where |value| < 0.7 (held by SineCosine.*).
inline SineCosine sine_cosine(double x) {
  constexpr double two_over_pi = 0.63661977236758134308;
  constexpr double high = 1.5707963267948965580, low = 6.1232339957367658e-17;  // π/2
  constexpr double whole = 6755399441055744.0;                                  // 1.5·2⁵²: its last bit counts ones
  const double shifted = x * two_over_pi + whole;
  const double n = shifted - whole;
  const double r = std::fma(-n, low, std::fma(-n, high, x));
  const double q = r * r;
  // Next terms: r¹⁹/19! = 8e-20 and r¹⁸/18! = 2e-18.
  const double s =
      r + r * (q * (-1.0 / 6 +
                    q * (1.0 / 120 +
                         q * (-1.0 / 5040 +
                              q * (1.0 / 362880 + q * (-1.0 / 39916800 +
                                                       q * (1.0 / 6227020800 + q * (-1.0 / 1307674368000 +
                                                                                    q * (1.0 / 355687428096000)))))))));
  const double c =
      1 + q * (-0.5 + q * (1.0 / 24 +
                           q * (-1.0 / 720 +
                                q * (1.0 / 40320 + q * (-1.0 / 3628800 +
                                                        q * (1.0 / 479001600 + q * (-1.0 / 87178291200 +
                                                                                    q * (1.0 / 20922789888000))))))));
  const auto quarter = std::bit_cast<std::int64_t>(shifted);
  const double sine = (quarter & 1) != 0 ? c : s, cosine = (quarter & 1) != 0 ? s : c;
  return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

}  // namespace grimaldi
