#pragma once
// The waves that the edges of found paths bound: where one arrives the other must be asked for.

#include <atomic>
#include <functional>
#include <span>

#include "propagation/composite.h"
#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/grow.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// Calls act(interactions) for each wave whose lit side a path passes within v = 1.5 of its boundary at an edge: the
/// path without that edge, or with a face of the edge in its place. Unless something else stands in its way that wave
/// arrives, and the edge's is but what it lacks: of a face of half a metre, 400 m away, the four edges alone
/// are 30 dB too strong in the face's mirror direction. Beams meet such a face by luck.
/// Inputs: a path that arrives. v at the first band.
void each_bounded_wave(const Scene& scene, const Plan& plan, std::span<const Interaction> interactions,
                       const PathGeometry& geometry, const std::function<void(std::span<const Interaction>)>& act);

/// Those of the arrivals at one point that bring 1/1000 of the power or more, which `known` does not have.
SequenceTable bounded_waves(const Scene& scene, const Plan& plan, std::span<const Arrival> arrivals,
                            const std::function<bool(SequenceHash)>& known);

/// Those of the pairs that bring 1/100 of their cell's power or more, at its dense points, where no pair of the cell
/// has them: asked there, what arrives joins `discovered` and `grown`. A mirror's spot may lie between the cell's other
/// points. Nothing is done where the grid has no dense points.
void add_bounded_waves(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                       const CoverageGrid& grid, Discovered& discovered, Grown& grown, const std::atomic<bool>* stop);

}  // namespace grimaldi
