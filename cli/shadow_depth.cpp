#include "cli/shadow_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace grimaldi {
namespace {

/// The way around one edge.
struct Way {
  double detour;
  const Wedge* wedge;
  double along;  // m from the edge's start
};

// As std::hypot, which guards against overflow and takes ten times as long.
double hypotenuse(double a, double b) { return std::sqrt(a * a + b * b); }

/// Over the point of the edge where the way is shortest: both legs make one angle with the edge, else its nearer end.
Way way_around(const Wedge& wedge, const Vec3& from, const Vec3& to, double straight) {
  const Vec3 a = from - wedge.start, b = to - wedge.start;
  const double along_a = dot(a, wedge.direction), along_b = dot(b, wedge.direction);
  const double off_a = std::sqrt(std::max(0.0, norm2(a) - along_a * along_a)),
               off_b = std::sqrt(std::max(0.0, norm2(b) - along_b * along_b));
  const double share = off_a + off_b > 0 ? off_a / (off_a + off_b) : 0.5;
  const double t = std::clamp(along_a + share * (along_b - along_a), 0.0, wedge.length);
  const double detour = hypotenuse(off_a, along_a - t) + hypotenuse(off_b, along_b - t) - straight;
  return {std::max(0.0, detour), &wedge, t};
}

/// True if `point` lies behind both faces: there is no wave of the edge inside its own wedge.
bool inside_wedge(const Wedge& wedge, const Vec3& point) {
  const Vec3 ray = point - wedge.start;
  return dot(wedge.normal0, ray) < 0 && dot(wedge.normaln(), ray) < 0;
}

/// Where the way passes: 1 mm off the edge, into the open.
Vec3 passing_point(const Way& way) { return way.wedge->point(way.along) + 1e-3 * way.wedge->bisector(); }

}  // namespace

ShadowDepth::ShadowDepth(const Scene& scene, const Tracer& tracer, double wavelength)
    : scene_(scene), tracer_(tracer), wavelength_(wavelength) {
  const std::vector<Wedge>& wedges = scene.wedges.wedges;
  if (wedges.empty()) return;
  constexpr double groups_a_side = 40;
  Vec3 low = wedges.front().start, high = low;
  for (const Wedge& wedge : wedges)
    for (const Vec3& end : {wedge.start, wedge.end()}) {
      low = {std::min(low.x, end.x), std::min(low.y, end.y), std::min(low.z, end.z)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y), std::max(high.z, end.z)};
    }
  const double side = std::max({high.x - low.x, high.y - low.y, 1.0}) / groups_a_side;
  std::map<std::pair<int, int>, Group> squares;  // seen from above, by the middle of the edge
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    const Vec3 middle = wedges[i].point(wedges[i].length / 2) - low;
    squares[{int(middle.x / side), int(middle.y / side)}].wedges.push_back(i);
  }
  for (auto& [square, group] : squares) {
    for (const std::uint32_t i : group.wedges)
      group.centre = group.centre + 1.0 / double(group.wedges.size()) * wedges[i].point(wedges[i].length / 2);
    for (const std::uint32_t i : group.wedges)
      group.radius =
          std::max({group.radius, distance(group.centre, wedges[i].start), distance(group.centre, wedges[i].end())});
    groups_.push_back(std::move(group));
  }
}

double ShadowDepth::operator()(const Vec3& from, const Vec3& to, double lit_limit, double shadow_limit) const {
  const bool lit = tracer_.visible(from, to);
  const double straight = distance(from, to), limit = lit ? lit_limit : shadow_limit;
  const double most = wavelength_ * limit * limit / 4;
  std::vector<Way> ways;
  for (const Group& group : groups_) {
    // No way over a point of the ball is shorter than this.
    if (distance(from, group.centre) + distance(group.centre, to) - 2 * group.radius > straight + most) continue;
    for (const std::uint32_t i : group.wedges) {
      const Way way = way_around(scene_.wedges.wedges[i], from, to, straight);
      if (way.detour <= most && !inside_wedge(*way.wedge, to) && !inside_wedge(*way.wedge, from)) ways.push_back(way);
    }
  }
  // Mostly one of the first sees both ends: a heap sorts no further than it is asked.
  const auto longer = [](const Way& a, const Way& b) { return a.detour > b.detour; };
  std::make_heap(ways.begin(), ways.end(), longer);
  for (auto end = ways.end(); end != ways.begin(); --end) {
    std::pop_heap(ways.begin(), end, longer);
    const Way& way = *(end - 1);
    const Vec3 point = passing_point(way);
    // Down in the street fewer edges are in sight than from a mast: ask there first.
    if (tracer_.visible(point, to) && tracer_.visible(from, point))
      return (lit ? -2 : 2) * std::sqrt(way.detour / wavelength_);
  }
  return lit ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

}  // namespace grimaldi
