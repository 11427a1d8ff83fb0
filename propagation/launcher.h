#pragma once
// Directions of launched beams: a full sphere a pass, neighbours in number are neighbours in direction.

#include <cstdint>

#include "core/vector.h"

namespace grimaldi {

/// Equal-area map of the unit square onto the sphere (octahedral, continuous). Source: Clarberg, "Fast equal-area
/// mapping of the (hemi)sphere using SIMD", J. Graphics Tools 13(3), 2008. u, v in [0, 1]. Returns a unit vector.
Vec3 equal_area_direction(double u, double v);

/// Direction of beam `index` of `count` in pass `pass`: the point at (index + shift)/count along Morton's curve through
/// the square, the square shifted on its torus by amounts drawn from (seed, pass). Each beam stands for 4π/count sr.
class Launcher {
 public:
  Launcher(std::uint64_t seed, std::uint32_t pass, std::uint64_t count);
  Vec3 direction(std::uint64_t index) const;

 private:
  std::uint64_t count_;
  double shift_, shift_u_, shift_v_;
};

}  // namespace grimaldi
