#pragma once
// A run that ends when its map is accurate enough or its time is up.

#include <chrono>

#include "propagation/simulation.h"

namespace grimaldi {

/// Runs `plan` with the rays that its accuracy or its time asks for; a plan with neither is simulated as it is.
///
/// Rounds: a whole run each, of more rays from 62,500 on, every one a function of (scene, plan, seed, its rays). With
/// an accuracy the rounds end when 95 % of the pairs (transmitter, cell) that are reached, first band, have a standard
/// error 10 lg(1 + error/gain) below it; the next round has the rays that the last error asks for by 1/√rays, 2 to 16
/// times as many. With a time they end when no round of twice the rays would be done at `start` + time less a tenth
/// (for the files); how long one takes is told from the two before. A round that is not done by then is given up. What
/// the last whole round found is the result, and `plan.request.rays` its rays: with these in place of the budget a run
/// gives the same bits. The first round is always ended. No more than 6.4e7 rays.
/// Result.figures.rounds tells what was run, Result.figures.ended_by why it ended; that an accuracy was not reached is
/// a warning.
Result simulate_within_budget(const Scene& scene, const Tracer& tracer, Plan& plan,
                              std::chrono::steady_clock::time_point start, const ProgressReport& progress = {},
                              const std::atomic<bool>* stop = nullptr);

}  // namespace grimaldi
