#pragma once
// Embree with nothing around it: the yardstick of the walk. The second door to Embree, for benchmarks alone.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/vector.h"
#include "scenes/scene.h"

namespace grimaldi {

/// One ray as Embree takes it, from the scene's centre.
struct BareSegment {
  float origin[3], direction[3];
  float near;  ///< length that is passed over at the start, m
};

/// The scene built with the flags and the quality of `Tracer`.
class BareEmbree {
 public:
  explicit BareEmbree(const Scene& scene);
  ~BareEmbree();

  /// As `Tracer` rounds a ray.
  BareSegment segment(const Vec3& origin, const Vec3& direction, double near) const;

  /// rtcIntersect1 on each of `segments` in order, one thread. Returns the number of those that hit.
  std::size_t intersect(std::span<const BareSegment> segments) const;

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

}  // namespace grimaldi
