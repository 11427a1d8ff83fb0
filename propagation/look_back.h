#pragma once
// From the cells back: beams that find the faces with which a path ends, where the way to them is not free.

#include <atomic>

#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// Where they go: from the cells of a map, over ground, upward; what lies below one point may be a roof.
enum class BackwardBeams { upward, all_round };

/// Launched beams meet the walls of the streets that an edge lights behind a roof by chance alone; a beam from the
/// street meets them at once. Each pass launches one beam from a point of a cell for 8 of the plan's rays, cells in
/// turn, directions uniform over the upper half or all round; it reflects as often as the depth leaves room for an
/// edge. Each face on its way that the transmitter does not see at that point makes a blocked path: the faces from
/// there to the cell, its first leg (from the transmitter) blocked. The path itself need not exist (its mirror's point
/// may lie beside the face); the ways around it (`detours`) may. Every `stride`-th beam is launched. Adds the blocked
/// paths and their sequences to `discovered`.
void look_back(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
               const CoverageGrid& grid, BackwardBeams beams, Discovered& discovered, const std::atomic<bool>* stop,
               std::uint64_t stride = 1);

}  // namespace grimaldi
