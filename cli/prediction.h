#pragma once
// What a run will cost, in words.

#include <atomic>
#include <optional>
#include <string>

#include "cli/arguments.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// What the run of `plan` will cost, as `predict_cost`: told of runs above 5 s, with --predict of all. Nothing for a
/// run with a budget of time or accuracy, whose rays are not known. With --predict and such a budget: InputErrors.
std::optional<Prediction> predict(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                  const Arguments& arguments, const std::atomic<bool>* stop);

/// Time and memory, e.g. "80 s, 600 MB".
std::string prediction_text(const Prediction& predicted);

/// Prints the answer to --predict (with --json as JSON) and returns the exit code: 1 if `predicted` is empty because
/// the user stopped it.
int tell(const std::optional<Prediction>& predicted, const Arguments& arguments);

}  // namespace grimaldi
