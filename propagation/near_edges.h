#pragma once
// Edges beside free legs: the lit side of shadow boundaries.

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// Calls act(leg, wedge) for each wedge whose detour δ from a leg of a path has v = 2√(δ/λ) < v_most.
/// Inputs: wavelength λ, m; v_most > 0; the path must not change meanwhile.
void each_near_edge(const Scene& scene, const PathGeometry& geometry, double wavelength, double v_most,
                    const std::function<void(std::size_t, std::uint32_t)>& act);

/// Adds to `sequences` those, not among the `known`, that pass an edge beside a free leg of a path to `point`: nothing
/// blocks that leg, so nothing leads the search there, but the edge's wave is part of the total as long as the leg lies
/// in its transition region. A map finds them by growing from the cells behind the boundary; a point has no such
/// neighbours. Returns their numbers. Method: for the paths `arriving` (numbers in `sequences`, at most 64, the first
/// count) with room for one more edge, every edge within v = 6 of a leg, where composites end (`each_near_edge`), at
/// the first band; solved and asked for visibility; what is found so is searched in its turn.
std::vector<std::uint32_t> add_near_edges(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                          std::size_t transmitter, const Vec3& point,
                                          std::span<const std::uint32_t> arriving,
                                          std::span<const SequenceTable* const> known, SequenceTable& sequences,
                                          std::uint64_t& shadow_rays, const std::atomic<bool>* stop);

/// Adds to `sequences` those that pass a second edge of the face along which the wave of their last edge must go to
/// reach `point`, which its own solid hides from it: no ray says so, the wave would start inside the solid. Returns
/// their numbers. Method: for every sequence that ends so, with room for one more edge, the rims of both faces of its
/// last edge that the point sees; kept are the paths that arrive and whose `power_bound` is not below `least`.
std::vector<std::uint32_t> add_second_edges(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                            std::size_t transmitter, const Vec3& point, double least,
                                            SequenceTable& sequences, std::uint64_t& shadow_rays,
                                            const std::atomic<bool>* stop);

}  // namespace grimaldi
