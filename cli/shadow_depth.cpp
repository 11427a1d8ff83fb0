#include "cli/shadow_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace grimaldi {
namespace {

/// The way around one edge.
struct Way {
  double detour;
  Vec3 point;
};

/// Over the point of the edge where the way is shortest: both legs make one angle with the edge, else its nearer end.
Way way_around(const Wedge& wedge, const Vec3& from, const Vec3& to, double straight) {
  const Vec3 a = from - wedge.start, b = to - wedge.start;
  const double along_a = dot(a, wedge.direction), along_b = dot(b, wedge.direction);
  const double off_a = std::sqrt(std::max(0.0, norm2(a) - along_a * along_a)),
               off_b = std::sqrt(std::max(0.0, norm2(b) - along_b * along_b));
  const double share = off_a + off_b > 0 ? off_a / (off_a + off_b) : 0.5;
  const double t = std::clamp(along_a + share * (along_b - along_a), 0.0, wedge.length);
  const double detour = std::hypot(off_a, along_a - t) + std::hypot(off_b, along_b - t) - straight;
  return {std::max(0.0, detour), wedge.point(t) + 1e-3 * wedge.bisector()};  // 1 mm off the edge, into the open
}

}  // namespace

double shadow_depth(const Scene& scene, const Tracer& tracer, const Vec3& from, const Vec3& to, double wavelength,
                    double lit_limit, double shadow_limit) {
  const bool lit = tracer.visible(from, to);
  const double straight = norm(to - from), limit = lit ? lit_limit : shadow_limit;
  const double most = wavelength * limit * limit / 4;
  std::vector<Way> ways;
  for (const Wedge& wedge : scene.wedges.wedges) {
    const Way way = way_around(wedge, from, to, straight);
    if (way.detour <= most) ways.push_back(way);
  }
  std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.detour < b.detour; });
  for (const Way& way : ways)
    if (tracer.visible(from, way.point) && tracer.visible(way.point, to))
      return (lit ? -2 : 2) * std::sqrt(way.detour / wavelength);
  return lit ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

}  // namespace grimaldi
