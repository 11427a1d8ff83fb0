#include "cli/compare_verb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>

#include "cli/comparison.h"
#include "cli/comparison_page.h"
#include "cli/difference_picture.h"
#include "cli/interruption.h"
#include "cli/map_picture.h"
#include "cli/messages.h"
#include "cli/output_folder.h"
#include "cli/plan_words.h"
#include "cli/prediction.h"
#include "cli/progress.h"
#include "cli/scene_request.h"
#include "cli/version.h"
#include "propagation/budget.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<const char*, 2> models = {"fsd", "utd"};
const std::vector<std::string> model_files = {"result.h5", "coverage.png", "summary.json"};

void check_request(const PlanDescription& request, const std::string& input, Diagnostics& diagnostics) {
  // A scenario that could not be read has said so already.
  if (diagnostics.has_errors()) return;
  if (request.diffraction_model == DiffractionModel::fsd_published)
    diagnostics.error(input, 0, "propagation.diffraction", "fsd-published is not compared",
                      "compare runs fsd and utd, and nothing else",
                      "leave the key out, or run grimaldi coverage with it");
  if (!request.diffraction)
    diagnostics.error(input, 0, "propagation.mechanisms", "no diffraction",
                      "without it both theories give the same map", "add \"diffraction\"");
  if (!request.coverage && request.receivers.empty())
    diagnostics.error(input, 0, "coverage", "missing", "a comparison needs a map or receivers",
                      "add [coverage] with a cell_size, or give --cell-size 5");
}

/// The request with one theory; its text says so too, so that a stored result runs again as it was.
PlanDescription request_of(const Arguments& arguments, const char* model, Diagnostics& diagnostics) {
  std::vector<PlanOption> options = arguments.options;
  if (model) options.push_back({"compare", "propagation.diffraction", model});
  PlanDescription request = read_plan(arguments.input, options, diagnostics);
  request.threads = arguments.threads;
  return request;
}

struct Run {
  Plan plan;
  Result result;
  std::string summary;
};

/// Folders of the comparison and of both theories.
struct Folders {
  OutputFolder all;
  std::array<OutputFolder, 2> model;

  explicit Folders(const std::filesystem::path& path)
      : all(path, {"compare.json", "difference.png", "report.html"}),
        model{OutputFolder(path / models[0], model_files), OutputFolder(path / models[1], model_files)} {}

  void check(bool overwrite, Diagnostics& diagnostics) const {
    Diagnostics own;
    all.check(overwrite, own);
    // What is wrong with the folder need not be said of those in it again.
    if (!own.has_errors())
      for (const OutputFolder& folder : model) folder.check(overwrite, own);
    for (const Diagnostic& fault : own.all()) diagnostics.add(fault);
  }
  void create() {
    all.create();
    for (OutputFolder& folder : model) folder.create();
  }
  void remove_if_empty() {
    for (OutputFolder& folder : model) folder.remove_if_empty();
    all.remove_if_empty();
  }
};

Result timed(const Scene& scene, const Tracer& tracer, Plan& plan, const ProgressReport& report,
             const std::atomic<bool>* stop) {
  const Clock::time_point start = Clock::now();
  const std::clock_t cpu = std::clock();
  Result result = simulate_within_budget(scene, tracer, plan, start, report, stop);
  result.figures.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.figures.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  return result;
}

/// Two runs in turn; nothing if nothing is known of one of them.
std::optional<Prediction> one_after_the_other(const std::array<std::optional<Prediction>, 2>& runs) {
  if (!runs[0] || !runs[1]) return std::nullopt;
  return Prediction{runs[0]->seconds + runs[1]->seconds, runs[0]->cpu_seconds + runs[1]->cpu_seconds,
                    std::max(runs[0]->memory_bytes, runs[1]->memory_bytes),
                    runs[0]->pilot_seconds + runs[1]->pilot_seconds};
}

std::string table(const Plan& plan, const Comparison& comparison) {
  std::string text = fmt::format("{:<14}{:>8}{:>11}{:>11}{:>11}{:>9}  {}\n", "FSD - UTD", "cells", "median", "|median|",
                                 "95 % below", "> noise", "believe");
  const auto row = [&](const char* name, const DifferenceFigures& f, const std::string& believe) {
    if (f.cells == 0) return;
    text += fmt::format("{:<14}{:>8}{:>8.2f} dB{:>8.2f} dB{:>8.2f} dB{:>9}  {}\n", name, f.cells, f.median,
                        f.median_abs, f.p95_abs,
                        std::isfinite(f.beyond_noise) ? fmt::format("{:.1f} %", 100 * f.beyond_noise) : "", believe);
  };
  row("all", comparison.first().all, "");
  for (std::size_t r = 0; r < region_count; ++r)
    row(region_names[r], comparison.first().regions[r], comparison.beliefs[r].model);
  for (std::size_t m = 0; m < mechanism_count; ++m) row(mechanism_names[m], comparison.first().mechanisms[m], "");
  if (comparison.bands.size() > 1) {
    text += fmt::format("\nThe above at {}; all cells in each band:\n", frequency_words(plan, 0));
    for (std::size_t b = 0; b < comparison.bands.size(); ++b)
      row(frequency_words(plan, b).c_str(), comparison.bands[b].all, "");
  }
  return text;
}

}  // namespace

int compare_verb(const Arguments& arguments) {
  Interruption interruption;
  Diagnostics diagnostics;
  PlanDescription request = request_of(arguments, nullptr, diagnostics);
  check_request(request, arguments.input, diagnostics);
  if (!request.coverage) request.coverage = CoverageRequest{};
  Folders folders(arguments.output.empty() ? default_output_folder(arguments.input) : arguments.output);
  if (!arguments.predict) folders.check(arguments.overwrite, diagnostics);
  const Scene scene = make_scene(request, diagnostics);
  if (scene.triangles.empty()) diagnostics.throw_if_errors();
  const Tracer tracer(scene);
  make_plan(request, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  std::array<Run, 2> runs;
  for (std::size_t m = 0; m < models.size(); ++m) {
    Diagnostics told;  // the same warnings again
    PlanDescription one = request_of(arguments, models[m], told);
    if (!one.coverage) one.coverage = CoverageRequest{};
    runs[m].plan = make_plan(one, scene, tracer, told);
    told.throw_if_errors();
    // Half of the time for each; the second has the beams of the first.
    if (runs[m].plan.request.time) *runs[m].plan.request.time /= 2;
  }

  std::vector<Diagnostic> warnings = warnings_of(diagnostics);
  const std::size_t shown = arguments.quiet ? 0 : print_warnings(warnings, 0);
  std::optional<Progress> progress;
  if (!arguments.quiet && (arguments.progress || stderr_is_terminal())) progress.emplace(stderr_is_terminal());

  interruption.begin_run();
  if (progress) progress->show("predict", 0);
  std::array<std::optional<Prediction>, 2> predicted;
  for (std::size_t m = 0; m < models.size(); ++m)
    predicted[m] = predict(scene, tracer, runs[m].plan, arguments, interruption.flag());
  const std::optional<Prediction> both = one_after_the_other(predicted);
  if (arguments.predict) return tell(both, arguments);
  if (progress) progress->clear();
  if (both && progress) fmt::print(stderr, "predicted {}\n", prediction_text(*both));
  const auto interrupted = [&] {
    progress.reset();
    folders.remove_if_empty();
    fmt::print(stderr, "error: interrupted (nothing was written)\n");
    return 1;
  };
  folders.create();
  std::optional<Comparison> compared;
  try {
    for (std::size_t m = 0; m < models.size(); ++m) {
      ProgressReport report;
      if (m > 0) {
        runs[m].plan.request.rays = runs[0].plan.request.rays;
        runs[m].plan.request.accuracy = runs[m].plan.request.time = std::nullopt;
      }
      if (progress) {
        const auto show = [&progress, m](const std::string& stage, double share) {
          progress->show(std::string(models[m]) + ": " + stage, share);
        };
        show("discover", 0);
        report = show;
      }
      runs[m].result = timed(scene, tracer, runs[m].plan, report, interruption.flag());
      runs[m].result.figures.predicted = predicted[m];
      if (runs[m].result.interrupted || interruption.happened()) return interrupted();
    }
    if (progress) progress->show("compare", 0);
    compared = compare_results(
        scene, tracer, runs[0].plan, runs[0].result, runs[1].result,
        [&progress](double share) {
          if (progress) progress->show("compare", share);
        },
        interruption.flag());
    if (!compared || interruption.happened()) return interrupted();
  } catch (...) {
    folders.remove_if_empty();
    throw;
  }
  // Two theories and the comparison: three parts of the writing.
  const auto writing = [&progress](std::size_t done) {
    if (progress) progress->show("write", double(done) / 3);
  };

  // From here on every file is written to its end; a second signal still kills. An older compare.json goes first, so
  // that it never stands beside newer maps; the new one comes last.
  folders.all.remove_stale({});
  ComparisonPictures pictures;
  std::array<std::string*, 2> picture = {&pictures.fsd, &pictures.utd};
  std::vector<Diagnostic> told = warnings;
  for (std::size_t m = 0; m < models.size(); ++m) {
    writing(m);
    auto& [plan, result, summary] = runs[m];
    for (const Diagnostic& warning : result.warnings)  // both runs may say the same
      if (std::none_of(told.begin(), told.end(),
                       [&](const Diagnostic& one) { return to_string(one) == to_string(warning); }))
        told.push_back(warning);
    result.warnings.insert(result.warnings.begin(), warnings.begin(), warnings.end());
    const OutputFolder& folder = folders.model[m];
    write_result(folder.file("result.h5"), scene, plan, result, program_version());
    *picture[m] = coverage_picture(scene, plan, result).canvas.png();
    write_text(folder.file("coverage.png"), *picture[m]);
    summary = summary_json(plan, result, model_files);
    write_text(folder.file("summary.json"), summary);
    folder.remove_stale(model_files);
  }
  const Plan& plan = runs[0].plan;
  const Result &fsd = runs[0].result, &utd = runs[1].result;
  const Comparison& comparison = *compared;
  writing(2);
  const std::vector<std::string> words = comparison_words(plan, comparison, fsd, utd);
  pictures.difference = difference_picture(scene, plan, fsd, utd, comparison).png();
  write_text(folders.all.file("difference.png"), pictures.difference);
  write_text(folders.all.file("report.html"), comparison_page(scene, plan, comparison, fsd, utd, pictures));
  const std::string json = comparison_json(comparison, runs[0].summary, runs[1].summary, words);
  write_text(folders.all.file("compare.json"), json);
  progress.reset();

  if (!arguments.quiet) print_rest(told, print_warnings(told, shown), "fsd/summary.json and utd/summary.json");
  if (arguments.json) {
    fmt::print("{}", json);
  } else if (!arguments.quiet) {
    fmt::print("{}\n", table(plan, comparison));
    for (const std::string& sentence : words) fmt::print("{}\n", sentence);
    fmt::print("\n{}\n", folders.all.file("report.html").string());
  }
  return 0;
}

}  // namespace grimaldi
