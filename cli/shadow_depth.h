#pragma once
// How deep a point lies in the shadow of the nearest edge.

#include "core/vector.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The parameter of a knife edge between `from` and `to`: the edge that leads around with the least detour and sees
/// both ends. Formula: v = ±2 √(Δ/λ), Δ the detour over the edge; negative where the straight line is free. Source:
/// ITU-R P.526-15,
///          (26), (28).
/// Inputs:  wavelength m; `lit_limit`, `shadow_limit`: largest |v| that is asked, on either side.
/// Returns: v; −infinity where the line is free and no edge lies within lit_limit; +infinity where it is blocked and no
///          single edge within shadow_limit sees both ends (deeper, or several edges stand between).
double shadow_depth(const Scene& scene, const Tracer& tracer, const Vec3& from, const Vec3& to, double wavelength,
                    double lit_limit, double shadow_limit);

}  // namespace grimaldi
