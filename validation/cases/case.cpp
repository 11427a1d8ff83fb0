#include "validation/cases/case.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {

bool within_tolerance(const Case& subject, double error) {
  return std::isfinite(error) && error >= subject.at_least && error <= subject.tolerance;
}

double correct_digits(double error) { return error > 1e-17 ? -std::log10(error) : 17; }

}  // namespace grimaldi
