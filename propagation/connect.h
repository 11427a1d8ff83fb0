#pragma once
// Visibility of a path whose points are known.

#include <span>

#include "propagation/fermat.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// True if every leg of the path is free: a leg that ends at a face must hit that face's patch at its point first,
/// every other leg must meet nothing. Edges are passed 3 `surface_gap()` out along the bisector of their exterior.
/// `shadow_rays` grows by the rays asked.
bool connected(const Scene& scene, const Tracer& tracer, std::span<const Interaction> interactions,
               const PathGeometry& geometry, std::uint64_t& shadow_rays);

}  // namespace grimaldi
