#pragma once
// Visibility of a path whose points are known.

#include <optional>
#include <span>

#include "propagation/fermat.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// The number of a leg (from point `leg` to point `leg` + 1) that is not free; nothing if all are: a leg that ends at a
/// face must hit that face's patch at its point first, every other leg must meet nothing. The last leg is asked first.
/// Edges are passed 3 `surface_gap()` out along the bisector of their exterior. `shadow_rays` grows by the rays asked.
std::optional<std::size_t> blocked_leg(const Scene& scene, const Tracer& tracer,
                                       std::span<const Interaction> interactions, const PathGeometry& geometry,
                                       std::uint64_t& shadow_rays);

/// Point i of a path as rays see it: an edge's is moved 3 `surface_gap()` out along the bisector of its exterior.
Vec3 seen_point(const Scene& scene, const Tracer& tracer, std::span<const Interaction> interactions,
                const PathGeometry& geometry, std::size_t i);

/// The face at point i of a path; no_index for an edge or an end.
std::uint32_t face_at(std::span<const Interaction> interactions, std::size_t i);

/// True if no leg is blocked.
inline bool connected(const Scene& scene, const Tracer& tracer, std::span<const Interaction> interactions,
                      const PathGeometry& geometry, std::uint64_t& shadow_rays) {
  return !blocked_leg(scene, tracer, interactions, geometry, shadow_rays);
}

}  // namespace grimaldi
