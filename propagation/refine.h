#pragma once
// The strong paths over edges, asked at more points of each cell.

#include <atomic>

#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/grow.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// Asks the dense points of each cell for every sequence that brings `Effort::strong_share` of the cell's power or
/// more, and for those over edges that would bring 20 % of it as they do next door but do not arrive at the cell's
/// coarse points: a path that lights a tenth of a cell is missed or overrated by few points. Pairs found so join
/// `grown`. Nothing is done where the grid has no dense points. Independent of the number of threads.
void refine(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
            const CoverageGrid& grid, const Discovered& discovered, Grown& grown, const std::atomic<bool>* stop);

}  // namespace grimaldi
