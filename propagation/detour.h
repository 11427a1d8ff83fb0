#pragma once
// Around what stands in the way: a path that would arrive but for one blocked leg is led over an edge of what blocks
// it.

#include <atomic>
#include <vector>

#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/effort.h"
#include "propagation/grow.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// The blocked paths of `discovered` with one more edge, or both edges of a face of a solid that hides either end of
/// the leg from the edge nearer to the other (a flat roof, a wall between two corners): free ones as seeds, those that
/// something else blocks as blocked paths in their turn.
///
/// Candidates are the rims of the patches that stand in the blocked leg (of the four next to either end), and the rims
/// of the patches next to those. Of the shortest ways around that a path can take and whose bound is not negligible in
/// the cell (`Effort::negligible_share` of `known`) some that are free are kept, and some that are not. One of the
/// cells of a 3 × 3 tile asks for all. No chance is involved, but for the pass: what one tile alone finds shall count
/// as found by one pass, so each tile belongs to a pass that is drawn. Inputs: `known` per cell, as in Grown;
/// most_edges along a path. Blocked paths without room for one more edge are passed over.
Discovered detours(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                   const CoverageGrid& grid, const Effort& effort, const Discovered& discovered,
                   const std::vector<double>& known, int most_edges, const std::atomic<bool>* stop);

}  // namespace grimaldi
