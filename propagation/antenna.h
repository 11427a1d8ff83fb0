#pragma once
// What a transmitter radiates in a direction, and what a receiver takes.

#include "core/vector.h"
#include "propagation/plan_file.h"

namespace grimaldi {

/// Unit vectors of growing polar angle θ (from +z) and of growing azimuth about `direction`. At the poles the azimuth
/// is taken as 0.
struct PolarFrame {
  Vec3 theta, phi;
};
PolarFrame polar_frame(const Vec3& direction);

/// Electric field at 1 m, over that of an isotropic antenna of the same power: |·|² = gain over isotropic.
/// isotropic: E along θ (V) or φ (H) of the polar frame, gain 1.  short-dipole: gain 1.5 sin²ϑ, ϑ from the dipole's
/// axis; dipole (half-wave): gain G₀ [cos(π/2 cos ϑ)/sin ϑ]², G₀ = 1.6409223769 (Balanis, Antenna Theory, 4th ed., eq.
/// 4-91); E along growing ϑ. Axis of a dipole: V: up, tilted by `tilt` towards the azimuth, so that the pattern's front
/// points down; H: horizontal, across the azimuth.
Vec3 radiated_field(const Antenna& antenna, const Vec3& direction);

}  // namespace grimaldi
