#include "propagation/effort.h"

#include <algorithm>
#include <cmath>

#include "propagation/plan.h"

namespace grimaldi {

namespace {

Effort effort_of_rays(const PlanDescription& request, double rays) {
  const double millions = rays / 1e6, e = std::sqrt(millions);
  const auto within = [](double value, int least, int most) {
    return static_cast<int>(std::clamp(value, double(least), double(most)));
  };
  Effort effort{};
  if (most_edges(request) > 0) {
    effort.coarse_points = within(std::round(2 * e), 2, 5);
    const int dense = within(std::ceil(5 * std::sqrt(e)), 0, 8);
    effort.dense_points = dense > effort.coarse_points + 1 ? dense : 0;
  }
  effort.strong_share = std::min(0.1, 0.02 / e);
  effort.negligible_share = std::clamp(1.4e-3 / millions, 5e-5, 0.01);
  effort.detours_tried = within(std::round(40 * e), 6, 160);
  effort.detours_kept = within(std::round(20 * millions), 1, 40);
  return effort;
}

}  // namespace

Effort effort_of(const PlanDescription& request) { return effort_of_rays(request, request.rays); }

Effort effort_at_a_point(const PlanDescription& request) {
  constexpr double least_rays = 1e6;
  Effort effort = effort_of_rays(request, std::max(double(request.rays), least_rays));
  effort.negligible_share = std::min(effort.negligible_share, 1e-3);
  return effort;
}

}  // namespace grimaldi
