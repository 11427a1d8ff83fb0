#include "cli/run_verb.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <optional>

#include "cli/interruption.h"
#include "cli/map_picture.h"
#include "cli/messages.h"
#include "cli/output_folder.h"
#include "cli/prediction.h"
#include "cli/profile_picture.h"
#include "cli/progress.h"
#include "cli/run_table.h"
#include "cli/scene_request.h"
#include "cli/version.h"
#include "propagation/budget.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

using Clock = std::chrono::steady_clock;

// The figures of the whole program, not only of its tracing.
void take_program_figures(RunFigures& figures, Clock::time_point start) {
  figures.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return;
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  figures.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  figures.peak_memory_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

PlanDescription read_request(const Arguments& arguments, Diagnostics& diagnostics) {
  PlanDescription request = read_plan(arguments.input, arguments.options, diagnostics);
  request.threads = arguments.threads;
  if (arguments.verb == Verb::coverage) {
    if (!request.coverage) request.coverage = CoverageRequest{};
  } else {
    request.coverage.reset();
    // A scenario that could not be read has said so already.
    if (request.receivers.empty() && !diagnostics.has_errors())
      diagnostics.error(arguments.input, 0, "receiver", "missing", "a profile needs a receiver",
                        "add [[receiver]] with a position, or give --rx 40,-60,1.5");
    if (request.accuracy)
      diagnostics.error(arguments.input, 0, "budget.accuracy", "not for a profile",
                        "the standard error is that of a map's cells", "give rays or time");
  }
  return request;
}

}  // namespace

int run_verb(const Arguments& arguments, Clock::time_point start) {
  Interruption interruption;
  Diagnostics diagnostics;
  const PlanDescription request = read_request(arguments, diagnostics);
  OutputFolder folder(arguments.output.empty() ? default_output_folder(arguments.input) : arguments.output);
  if (!arguments.predict) folder.check(arguments.overwrite, diagnostics);
  const Scene scene = make_scene(request, diagnostics);
  if (scene.triangles.empty()) diagnostics.throw_if_errors();
  // A request with faults is held against the scene too: all faults at once.
  const Tracer tracer(scene);
  Plan plan = make_plan(request, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();

  std::vector<Diagnostic> warnings = warnings_of(diagnostics);
  const std::size_t shown = arguments.quiet ? 0 : print_warnings(warnings, 0);
  std::optional<Progress> progress;
  ProgressReport report;
  if (!arguments.quiet && (arguments.progress || stderr_is_terminal())) {
    progress.emplace(stderr_is_terminal());
    report = [&](const std::string& stage, double share) { progress->show(stage, share); };
  }

  interruption.begin_run();
  if (progress) progress->show("predict", 0);
  const std::optional<Prediction> predicted = predict(scene, tracer, plan, arguments, interruption.flag());
  if (arguments.predict) return tell(predicted, arguments);
  if (progress) progress->clear();
  if (predicted && progress) fmt::print(stderr, "predicted {}\n", prediction_text(*predicted));
  if (progress) progress->show("discover", 0);  // the first stage; its first report comes when a part of it is done
  folder.create();
  Result result;
  try {
    result = simulate_within_budget(scene, tracer, plan, start, report, interruption.flag());
  } catch (...) {
    folder.remove_if_empty();
    throw;
  }
  progress.reset();
  result.figures.predicted = predicted;
  if (result.interrupted || interruption.happened()) {
    folder.remove_if_empty();
    fmt::print(stderr, "error: interrupted (nothing was written)\n");
    return 1;
  }
  // From here on every file is written to its end; a second signal still kills.
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  result.warnings = warnings;
  const std::string picture = arguments.verb == Verb::coverage ? "coverage.png" : "profiles.png";
  const std::vector<std::string> outputs = {"result.h5", picture, "summary.json"};
  take_program_figures(result.figures, start);
  write_result(folder.file("result.h5"), scene, plan, result, program_version());
  folder.remove_stale({"result.h5"});
  if (arguments.verb == Verb::coverage) {
    draw_coverage(folder.file(picture), scene, plan, result);
  } else {
    draw_profiles(folder.file(picture), plan, result);
  }
  take_program_figures(result.figures, start);
  const std::string summary = summary_json(plan, result, outputs);
  write_text(folder.file("summary.json"), summary);

  if (!arguments.quiet) print_rest(warnings, print_warnings(warnings, shown), "summary.json");
  if (arguments.json) {
    fmt::print("{}", summary);
  } else if (!arguments.quiet) {
    fmt::print("{}", run_table(scene, plan, result, folder.path(), outputs));
  }
  return 0;
}

}  // namespace grimaldi
