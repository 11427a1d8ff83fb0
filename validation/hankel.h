#pragma once
// Hankel functions of a complex argument: outgoing waves along a path that leaves the real axis.

#include <complex>

namespace grimaldi {

struct HankelPair {
  std::complex<double> zero, one;  ///< of order 0 and 1
};

/// H_0^(2)(z) and H_1^(2)(z), the outgoing waves of exp(+jωt).
/// Formula: H_0^(2)(z) = (2j/π) K_0(jz), H_1^(2)(z) = −(2/π) K_1(jz); K by its power series for |z| ≤ 2, else by
/// Temme's continued fraction.
/// Source: Abramowitz & Stegun 9.6.4, 9.6.10 to 9.6.13; Temme, J. Comput. Phys. 19 (1975) 324.
/// Inputs: Re z ≥ 0, Im z ≤ 0, 1e-100 ≤ |z| ≤ 1e6 (rad).
/// Returns: dimensionless; they fall off as exp(Im z).
/// Error: 2e-14 of |H| besides 1e-16 |z| of its phase (held by Hankel.*).
HankelPair hankel2_pair(std::complex<double> z);

}  // namespace grimaldi
