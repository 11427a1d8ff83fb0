#include "propagation/connect.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

/// A point of the edge as rays see it: moved out of the solid.
Vec3 outside_edge(const Wedge& wedge, const Vec3& point, double gap) {
  const double half = 0.5 * wedge.exterior_angle;
  return point + 3 * gap * (std::cos(half) * wedge.along0 + std::sin(half) * wedge.normal0);
}

}  // namespace

bool connected(const Scene& scene, const Tracer& tracer, std::span<const Interaction> interactions,
               const PathGeometry& geometry, std::uint64_t& shadow_rays) {
  const double gap = tracer.surface_gap();
  const std::size_t legs = geometry.count - 1;
  Vec3 from = geometry.points[0];
  // The last leg first: it is the one that most often ends in a wall.
  const auto place = [&](std::size_t i) {
    if (i == 0 || i == legs || !is_edge(interactions[i - 1])) return geometry.points[i];
    return outside_edge(scene.wedges.wedges[index_of(interactions[i - 1])], geometry.points[i], gap);
  };
  for (std::size_t k = 0; k < legs; ++k) {
    const std::size_t leg = legs - 1 - k;  // from point `leg` to point `leg + 1`
    from = place(leg);
    const Vec3 to = place(leg + 1);
    ++shadow_rays;
    const bool to_face = leg + 1 < legs && !is_edge(interactions[leg]);
    if (!to_face) {
      if (!tracer.visible(from, to)) return false;
      continue;
    }
    const std::uint32_t target = interactions[leg];
    const Vec3 way = to - from;
    const double length = norm(way);
    const std::uint32_t left = leg > 0 && !is_edge(interactions[leg - 1]) ? interactions[leg - 1] : no_index;
    const Hit hit = tracer.nearest(from, way / length, left);
    if (hit.triangle == no_index || scene.patches.triangle_patch[hit.triangle] != target) return false;
    const double cosine = std::abs(dot(way, scene.patches.patches[target].normal)) / length;
    if (std::abs(hit.distance - length) > 4 * gap / std::max(cosine, 1e-3)) return false;
  }
  return true;
}

}  // namespace grimaldi
