#pragma once
// One run, from a scene and a plan to a result.

#include <atomic>
#include <functional>
#include <string>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Told of the progress of a run, from one thread at a time: stage, and share done 0 … 1.
using ProgressReport = std::function<void(const std::string& stage, double share)>;

/// Runs the plan. The result is a function of (scene, plan, seed): the same bits on any number of threads.
/// `stop`, if given, may be set from outside (a signal handler): the run ends soon after with `interrupted` set and no
/// maps. Throws what the blocks throw (out of memory); bad input was reported by make_plan.
Result simulate(const Scene& scene, const Tracer& tracer, const Plan& plan, const ProgressReport& progress = {},
                const std::atomic<bool>* stop = nullptr);

}  // namespace grimaldi
