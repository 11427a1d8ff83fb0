#include "scenes/edge_foot.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

constexpr double around = 0.03;                 // m
const double upright = std::cos(2 * pi / 180);  // of the angle between edge and normal
constexpr double on_rim = 1e-3;                 // m, by which a point may lie outside a triangle

/// True if the point, moved along the normal, lies on the triangle.
bool lies_over(const Surroundings& s, std::uint32_t triangle, const Vec3& point) {
  const auto& t = s.triangles[triangle];
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = s.vertices[t[k]], &b = s.vertices[t[(k + 1) % 3]];
    const Vec3 inward = normalized(cross(s.normal[triangle], b - a));
    if (dot(point - a, inward) < -on_rim) return false;
  }
  return true;
}

bool stands(const Surroundings& s, const Wedge& wedge, const Vec3& end, std::vector<std::uint32_t>& near) {
  const Vec3 reach{around, around, around};
  s.tree.find(end - reach, end + reach, near);
  std::erase_if(near, [&](std::uint32_t t) {
    const Vec3& normal = s.normal[t];
    return std::abs(dot(normal, wedge.direction)) < upright ||
           std::abs(dot(normal, end - s.vertices[s.triangles[t][0]])) > contact_distance;
  });
  constexpr int parts = 8;
  for (int i = 0; i < parts; ++i) {
    const double azimuth = wedge.exterior_angle * (i + 0.5) / parts;
    const Vec3 beside = end + around * (std::cos(azimuth) * wedge.along0 + std::sin(azimuth) * wedge.normal0);
    if (std::none_of(near.begin(), near.end(), [&](std::uint32_t t) { return lies_over(s, t, beside); })) return false;
  }
  return true;
}

}  // namespace

void find_feet(const Surroundings& surroundings, std::vector<Wedge>& wedges) {
  std::vector<std::uint32_t> near;
  for (Wedge& wedge : wedges) {
    wedge.stands_at_start = stands(surroundings, wedge, wedge.start, near);
    wedge.stands_at_end = stands(surroundings, wedge, wedge.end(), near);
  }
}

}  // namespace grimaldi
