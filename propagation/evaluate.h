#pragma once
// The map: every sequence that arrives in a cell, evaluated at the cell's sub-points and summed.

#include <atomic>
#include <functional>

#include "propagation/coverage_grid.h"
#include "propagation/discover.h"
#include "propagation/grow.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// A map of NaN (wholly inside) and 0 for the plan's transmitters, bands and cells.
CoverageMap empty_map(const Plan& plan, const CoverageGrid& grid);

/// Fills transmitter `transmitter` of `map`.
/// * path_gain = Σ w_i Σ_paths |h|² + interference over the cell's sub-points i: fine ones for paths without an edge,
///   dense ones for the refined paths, coarse ones for the others. Interference: of the paths that the dense points
///   know, from those; what the other paths add to it from the coarse points; each as its ratio to the power of the
///   same paths at the same points. Layers by `mechanism_of`; delays weighted by the power of the paths.
/// * standard_error² = passes + sub-points. Passes (jackknife, one of B left out): with u_i the gain that pass i alone
///   found, (B−1)/B Σ(u_i − ū)². Sub-points: what each set of points of edges brings, interference included, adds its
///   variance over the n points/(n − 1); what comes without an edge does so where a wall crosses the cell or such a
///   path ends inside it (elsewhere the quadrature is exact). Of few points with Student's factor, so that 2 standard
///   errors cover 95 %.
/// * bias: what no pass has found yet, as Good and Turing estimate it: with the share g = (B−1)/B Σ u_i/gain that one
///   pass alone found, gain · g/(1 − g). g of the cell or its mean over the 11 × 11 cells around, whichever is larger
///   (a cell's own few paths say little of what it lacks), at most 0.95. Source: Good, Biometrika 40 (1953).
/// * detection_limit = 3·(4π/(N A cos θ))·(λ/4π)² (sound: 1/4π for (λ/4π)²), N rays, cell area A, θ the angle of the
///   straight line from the transmitter to the cell's normal: a lossless path of that gain that fills the cell is
///   crossed by 3 beams in the mean, so it is missed with a chance of e^{−3} = 5 %.
/// Tiles of cells, each owned by one thread; sums in the order of the sequences: the same bits on any number of
/// threads.
void evaluate(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
              const CoverageGrid& grid, const Discovered& discovered, const std::vector<Pair>& pairs, CoverageMap& map,
              const std::function<void(double)>& progress, const std::atomic<bool>* stop);

/// The diffraction layer of transmitter `transmitter` by the sampled estimator instead (the model fsd-published, which
/// has no closed form at a point): its gain joins layer and path_gain, its error the standard error in squares; nothing
/// of it interferes. As many samples as the plan has rays; paths with one edge. `map` holds the run without
/// diffraction.
void add_sampled_diffraction(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                             const CoverageGrid& grid, CoverageMap& map, const std::atomic<bool>* stop);

}  // namespace grimaldi
