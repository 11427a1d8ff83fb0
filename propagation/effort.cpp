#include "propagation/effort.h"

#include <algorithm>
#include <cmath>

#include "propagation/plan.h"

namespace grimaldi {

Effort effort_of(const PlanDescription& request) {
  const double e = std::sqrt(request.rays / 1e6), steep = std::pow(e, 1.5);
  const auto rounded = [](double value, int least, int most) {
    return static_cast<int>(std::lround(std::clamp(value, double(least), double(most))));
  };
  Effort effort{};
  if (most_edges(request) > 0) {
    effort.coarse_points = rounded(2 * e, 2, 5);
    const int dense = rounded(5 * std::sqrt(e), 0, 8);
    effort.dense_points = dense > effort.coarse_points + 1 ? dense : 0;
  }
  effort.strong_share = std::min(0.1, 0.02 / e);
  effort.negligible_share = std::min(0.01, 1e-3 / steep);
  effort.detours_tried = rounded(48 * steep, 6, 96);
  effort.detours_kept = rounded(12 * steep, 1, 24);
  return effort;
}

}  // namespace grimaldi
