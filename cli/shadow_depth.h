#pragma once
// How deep a point lies in the shadow of the nearest edge.

#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The parameter of a knife edge between two points: the edge that leads around with the least detour and sees both,
/// neither of them inside its own wedge.
class ShadowDepth {
 public:
  /// Sorts the edges into groups that lie together. `scene` and `tracer` must outlive it; wavelength in m.
  ShadowDepth(const Scene& scene, const Tracer& tracer, double wavelength);

  /// Formula: v = ±2 √(Δ/λ), Δ the detour over the edge; negative where the straight line is free. Source: ITU-R
  ///          P.526-15, (26), (28).
  /// Inputs:  `lit_limit`, `shadow_limit`: largest |v| that is asked, on either side. Any number of threads may ask.
  /// Returns: v; −infinity where the line is free and no edge lies within lit_limit; +infinity where it is blocked and
  ///          no single edge within shadow_limit sees both ends (deeper, or several edges stand between).
  double operator()(const Vec3& from, const Vec3& to, double lit_limit, double shadow_limit) const;

 private:
  /// Edges within a ball.
  struct Group {
    Vec3 centre;
    double radius = 0;
    std::vector<std::uint32_t> wedges;
  };

  const Scene& scene_;
  const Tracer& tracer_;
  double wavelength_;
  std::vector<Group> groups_;
};

}  // namespace grimaldi
