#pragma once
// A small part of a run that costs what a part of the run costs.

#include <atomic>
#include <cstdint>

#include "propagation/coverage_grid.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// One beam in `stride` is launched; one cell in each square of `block` × `block` is asked.
struct RunSample {
  std::uint64_t stride = 1;
  std::size_t block = 1;
};

/// One cell of each square of `block` × `block` of `grid` (those at its north and east border may be cut), drawn from
/// `seed`, with its own sub-points, in a layout of cells that are the squares: what names or reaches a square is asked
/// at its one cell.
CoverageGrid sample_of(const CoverageGrid& grid, std::size_t block, std::uint64_t seed);

/// Runs `plan` with the effort of all its rays, but with every `stride`-th of its beams and the cells of `cells` (of
/// `sample_of`). The beams keep the footprint that they have in the whole run. Returns its figures, the counts those of
/// the sample. Deterministic but for times.
RunFigures simulate_sample(const Scene& scene, const Tracer& tracer, const Plan& plan, const CoverageGrid& cells,
                           std::uint64_t stride, const std::atomic<bool>* stop = nullptr);

}  // namespace grimaldi
