#include "cli/prediction.h"

#include <fmt/format.h>

#include "propagation/cost.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

constexpr double least_seconds = 5;  // a shorter run is over before its prediction is read

}  // namespace

std::optional<Prediction> predict(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                  const Arguments& arguments, const std::atomic<bool>* stop) {
  if (plan.request.time || plan.request.accuracy) {
    if (!arguments.predict) return std::nullopt;
    Diagnostics diagnostics;
    diagnostics.error(arguments.input, 0, "--predict", "no rays given",
                      "a run with a budget of time or accuracy finds out on its way how many it needs", "give --rays");
    diagnostics.throw_if_errors();
  }
  return predict_cost(scene, tracer, plan, arguments.predict ? 0 : least_seconds, stop);
}

std::string prediction_text(const Prediction& predicted) {
  return fmt::format("{:.2g} s, {:.0f} MB (told within {:.2g} s)", predicted.seconds,
                     double(predicted.memory_bytes) / 1e6, predicted.pilot_seconds);
}

int tell(const std::optional<Prediction>& predicted, const Arguments& arguments) {
  if (!predicted) {
    fmt::print(stderr, "error: interrupted (nothing was predicted)\n");
    return 1;
  }
  if (arguments.json) {
    fmt::print("{}", prediction_json(*predicted));
  } else {
    fmt::print("predicted   {}\n", prediction_text(*predicted));
  }
  return 0;
}

}  // namespace grimaldi
