#include "cli/run_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/prediction.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

// Receivers beyond these are in the picture and the result.
constexpr std::size_t most_receivers = 10;

std::string row(const std::string& title, const std::string& text) { return fmt::format("{:<12}{}\n", title, text); }

std::string short_count(double count) {
  if (count >= 1e9) return fmt::format("{:.2f} G", count / 1e9);
  if (count >= 1e6) return fmt::format("{:.2f} M", count / 1e6);
  return fmt::format("{:.0f}", count);
}

std::string delay_text(double seconds, WaveKind kind) {
  if (!std::isfinite(seconds)) return "-";
  return kind == WaveKind::radio ? fmt::format("{:.1f} ns", 1e9 * seconds) : fmt::format("{:.1f} ms", 1e3 * seconds);
}

std::string map_rows(const Plan& plan, const CoverageMap& map) {
  const MapFigures figures = map_figures(plan, map);
  const double share = figures.asked > 0 ? 100.0 * double(figures.reached) / double(figures.asked) : 0.0;
  std::string text = row("map", fmt::format("{} × {} cells of {:g} m; {} outdoors, {} reached ({:.1f} %)", plan.grid.nx,
                                            plan.grid.ny, plan.grid.cell, figures.asked, figures.reached, share));
  return text +
         row("error", fmt::format("standard error {:.3f} dB in the median, below {:.3f} dB in 95 % (sampling only)",
                                  figures.median_standard_error_dB, figures.p95_standard_error_dB));
}

std::string receiver_rows(const Plan& plan, const Result& result) {
  std::string text;
  std::size_t rows = 0;
  const std::size_t bands = plan.bands();
  for (const auto& profile : result.profiles) {
    for (std::size_t t = 0; t < plan.request.transmitters.size(); ++t) {
      if (++rows > most_receivers) continue;
      const std::size_t at = t * bands;
      const double gain = at < profile.total.size() ? profile.total[at] : 0;
      const std::size_t paths = t < profile.paths.size() ? profile.paths[t].size() : 0;
      const std::string who = fmt::format("{} from {}: ", profile.name, plan.request.transmitters[t].name);
      text += row("receiver",
                  who + (gain > 0 ? fmt::format("{:.2f} dB, {} paths, delay spread {}", 10 * std::log10(gain), paths,
                                                delay_text(profile.rms_delay_spread[at], plan.request.kind))
                                  : "nothing arrived"));
    }
  }
  if (rows > most_receivers) text += row("", fmt::format("and {} more in the result", rows - most_receivers));
  return text;
}

}  // namespace

std::string run_table(const Scene& scene, const Plan& plan, const Result& result, const std::filesystem::path& folder,
                      const std::vector<std::string>& outputs) {
  const RunFigures& run = result.figures;
  std::string text = row("scene", fmt::format("{}: {} triangles, {} wedges", scene.name, scene.triangles.size(),
                                              scene.wedges.wedges.size()));
  text += row("rays", fmt::format("{} in {} passes, {} segments, {} shadow rays", short_count(double(run.rays)),
                                  run.passes, short_count(double(run.segments)), short_count(double(run.shadow_rays))));
  if (!run.rounds.empty())
    text += row("budget", fmt::format("{} rounds, ended by {}", run.rounds.size(),
                                      run.ended_by == BudgetEnd::accuracy ? "the accuracy asked"
                                      : run.ended_by == BudgetEnd::time   ? "the time"
                                                                          : "the most rays"));
  if (result.coverage) text += map_rows(plan, *result.coverage);
  text += receiver_rows(plan, result);
  text += row("time", fmt::format("{:.2f} s, {:.2f} s of it tracing, {} thread{}, {:.0f} MB", run.wall_seconds,
                                  run.trace_seconds, run.threads, run.threads == 1 ? "" : "s",
                                  double(run.peak_memory_bytes) / 1e6));
  if (run.predicted) text += row("predicted", prediction_text(*run.predicted));
  if (!result.warnings.empty()) text += row("warnings", fmt::format("{}", result.warnings.size()));
  text += row("files", fmt::format("{}, {}", (folder / outputs[0]).string(), (folder / outputs[2]).string()));
  return text + row("picture", (folder / outputs[1]).string());
}

}  // namespace grimaldi
