#pragma once
// Growing and leading around in turns, until no new path is found.

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "propagation/both_ends.h"
#include "propagation/composite.h"
#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/grow.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// Grows the seeds of `discovered` from number `first_seed` on, leads what is blocked around what blocks it (paths of
/// at most `most_edges` edges), grows what that found, and so on. Blocked paths of `most_edges` edges stay in
/// `discovered`; the others are used up.
void grow_and_lead_around(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                          const CoverageGrid& grid, const Effort& effort, std::size_t first_seed, int most_edges,
                          Discovered& discovered, Grown& grown, const std::function<void(double)>& progress,
                          const std::atomic<bool>* stop);

/// The sequences, beyond the known ones, that lead around what blocks those on their way to one point, where the
/// `arrivals` are the paths by the known ones, and those over edges beside free legs (`add_near_edges`) of all these,
/// largest `power_bound` first: a wave that nearly vanishes (along a soft face) may have a neighbour that does not.
/// Those of what both ends, the point's `from_receiver` among them, see too (`add_from_both_ends`). `shadow_rays` grows
/// by the rays asked.
SequenceTable search_for_point(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                               const EndView& from_transmitter, const EndView& from_receiver,
                               std::span<const Arrival> arrivals, const SequenceTable& known,
                               std::uint64_t& shadow_rays, const std::atomic<bool>* stop);

}  // namespace grimaldi
