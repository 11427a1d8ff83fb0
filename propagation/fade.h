#pragma once
// The fade by which composites end.

#include <cmath>

#include "core/constants.h"

namespace grimaldi {

/// 1 up to `full`, cos² down to 0 at twice that. Inputs: x ≥ 0, full > 0, of one unit.
inline double fade(double x, double full) {
  if (x <= full) return 1;
  if (x >= 2 * full) return 0;
  const double c = std::cos(0.5 * pi * (x / full - 1));
  return c * c;
}

}  // namespace grimaldi
