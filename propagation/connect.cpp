#include "propagation/connect.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {

Vec3 seen_point(const Scene& scene, const Tracer& tracer, std::span<const Interaction> interactions,
                const PathGeometry& geometry, std::size_t i) {
  if (i == 0 || i + 1 == geometry.count || !is_edge(interactions[i - 1])) return geometry.points[i];
  const Wedge& wedge = scene.wedges.wedges[index_of(interactions[i - 1])];
  return geometry.points[i] + 3 * tracer.surface_gap() * wedge.bisector();
}

std::uint32_t face_at(std::span<const Interaction> interactions, std::size_t i) {
  return i > 0 && i <= interactions.size() && !is_edge(interactions[i - 1]) ? interactions[i - 1] : no_index;
}

std::optional<std::size_t> blocked_leg(const Scene& scene, const Tracer& tracer,
                                       std::span<const Interaction> interactions, const PathGeometry& geometry,
                                       std::uint64_t& shadow_rays) {
  const double gap = tracer.surface_gap();
  // The last leg first: it is the one that most often ends in a wall.
  for (std::size_t leg = geometry.count - 1; leg-- > 0;) {
    const Vec3 from = seen_point(scene, tracer, interactions, geometry, leg);
    const Vec3 to = seen_point(scene, tracer, interactions, geometry, leg + 1);
    ++shadow_rays;
    const std::uint32_t target = face_at(interactions, leg + 1);
    if (target == no_index) {
      if (!tracer.visible(from, to)) return leg;
      continue;
    }
    const Vec3 way = to - from;
    const double length = norm(way);
    const Hit hit = tracer.nearest(from, way / length, face_at(interactions, leg));
    if (hit.triangle == no_index || scene.patches.triangle_patch[hit.triangle] != target) return leg;
    const double cosine = std::abs(dot(way, scene.patches.patches[target].normal)) / length;
    if (std::abs(hit.distance - length) > 4 * gap / std::max(cosine, 1e-3)) return leg;
  }
  return std::nullopt;
}

}  // namespace grimaldi
