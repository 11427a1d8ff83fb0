#pragma once
// From the cells where a sequence was found to all cells that it reaches: growing by neighbours until it no longer
// arrives.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/effort.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// A sequence that arrives in a cell.
struct Pair {
  std::uint32_t cell, sequence;
  std::uint64_t visible;    ///< sub-points (bits) where it arrives; a path with an edge is asked at edges' points alone
  std::uint32_t passes;     ///< passes (bits) that found the patch of cells that this one belongs to
  float power;              ///< about its mean power over the cell at the first band, 1 or m⁻²
  std::uint64_t dense = 0;  ///< dense sub-points (bits) where it arrives, if it was asked there
  bool refined = false;     ///< of a path with an edge: its power is that over the dense points, not the coarse ones
};

/// The order of pairs: by cell, then sequence.
inline bool comes_before(const Pair& a, const Pair& b) {
  return a.cell != b.cell ? a.cell < b.cell : a.sequence < b.sequence;
}

struct Grown {
  std::vector<Pair> pairs;           ///< sorted by cell, then sequence
  std::vector<BlockedPath> blocked;  ///< of the last growth: paths with room for one more edge
  std::vector<double> known;         ///< per cell, mean power so far at the first band
  std::uint64_t shadow_rays = 0;
};

/// Grows sequences from the seeds of `discovered` from number `first_seed` on (sorted by sequence, then cell) and adds
/// them to `grown`, strongest first by the seeds' estimate, in stages of 10 dB: a stage knows the power that the ones
/// before it brought to each cell (`Effort::negligible_share`). In the first growth the empty sequence asks every
/// cell (a plan without the direct wave: to note where it is blocked). Cells
/// wholly inside a solid are not asked. Independent of the number of threads.
void grow(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, const CoverageGrid& grid,
          const Effort& effort, const Discovered& discovered, std::size_t first_seed, Grown& grown,
          const std::function<void(double)>& progress, const std::atomic<bool>* stop);

}  // namespace grimaldi
