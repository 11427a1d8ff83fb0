#pragma once
// Rays against the triangles of a scene. The one door to Embree.

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/vector.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Nearest hit of a ray. `triangle` = no_index if there is none.
struct Hit {
  std::uint32_t triangle = no_index;
  double distance = 0;  ///< m along the ray; recomputed in double against the plane of the triangle's patch
};

class EdgeVisibility;

/// Rays in single precision choose the triangle; the point is recomputed in double. Const after construction, any
/// number of threads may ask. Coordinates are taken relative to the scene's centre before they are rounded, so that a
/// scene far from its origin loses nothing (5e5 m and 5e6 m alike).
class Tracer {
 public:
  explicit Tracer(const Scene& scene);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Nearest triangle from `origin` along the unit vector `direction`. Triangles of the patches `leave0`, `leave1`
  /// nearer than `surface_gap()` are passed over: a ray never hits the face that it leaves.
  Hit nearest(const Vec3& origin, const Vec3& direction, std::uint32_t leave0 = no_index,
              std::uint32_t leave1 = no_index) const;

  /// True if nothing lies strictly between `a` and `b`: no triangle is hit further than `surface_gap()` from both ends.
  bool visible(const Vec3& a, const Vec3& b) const;

  /// True if `point` lies inside a solid: an odd number of surfaces, ground excluded, lies straight above it. Surfaces
  /// nearer to each other than 1 mm along the ray count each (both sides of a party wall).
  bool inside_solid(const Vec3& point) const;

  /// Length within which a hit at the end of a ray is taken for the end itself: the rounding of single precision over
  /// the extent of the scene, 16 ulp of half its diagonal, at least 0.1 mm. m.
  double surface_gap() const { return surface_gap_; }

  /// Which wedges of the scene hide from each other; what is once found out is kept as long as the tracer is.
  const EdgeVisibility& edges() const;

 private:
  struct Device;
  std::unique_ptr<Device> device_;
  const Scene* scene_;
  double surface_gap_;
  mutable std::once_flag edges_asked_;
  mutable std::unique_ptr<EdgeVisibility> edges_;
};

}  // namespace grimaldi
