#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "propagation/result_file.h"

namespace grimaldi {
namespace {

double rate(std::uint64_t count, double seconds) { return seconds > 0 ? double(count) / seconds : 0; }

/// Middle value; the mean of the two middle ones of an even number; 0 of none. Reorders `values`.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

nlohmann::ordered_json budget_json(const Plan& plan, const RunFigures& run) {
  nlohmann::ordered_json budget, rounds = nlohmann::ordered_json::array();
  if (plan.request.accuracy) budget["accuracy_dB"] = *plan.request.accuracy;
  if (plan.request.time) budget["time_s"] = *plan.request.time;
  budget["ended_by"] = run.ended_by == BudgetEnd::accuracy ? "accuracy"
                       : run.ended_by == BudgetEnd::time   ? "time"
                                                           : "rays";
  for (const BudgetRound& round : run.rounds)
    rounds.push_back({{"rays", round.rays}, {"seconds", round.seconds}, {"p95_standard_error_dB", round.error_dB}});
  budget["rounds"] = rounds;
  return budget;
}

nlohmann::ordered_json predicted_json(const Prediction& told) {
  return {{"trace_seconds", told.seconds},
          {"cpu_seconds", told.cpu_seconds},
          {"peak_memory_bytes", told.memory_bytes},
          {"seconds_to_predict", told.pilot_seconds}};
}

}  // namespace

MapFigures map_figures(const Plan& plan, const CoverageMap& map) {
  const std::size_t cells = plan.grid.size();
  const std::size_t transmitters = plan.request.transmitters.size();
  const std::size_t bands = plan.bands();
  if (map.path_gain.size() != transmitters * bands * cells || map.standard_error.size() != map.path_gain.size() ||
      map.mechanism_gain.size() != mechanism_count * map.path_gain.size() ||
      map.model_gain.size() != transmitters * edge_model_count * cells)
    throw std::logic_error("map_figures: the map has not the shape of the plan");

  MapFigures figures;
  figures.cells = cells;
  std::vector<double> errors_dB;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    bool asked = false, reached = false;
    for (std::size_t t = 0; t < transmitters; ++t) {
      const std::size_t at = t * bands * cells + cell;
      const double gain = map.path_gain[at];
      asked = asked || !std::isnan(gain);
      if (!(gain > 0)) continue;
      reached = true;
      const double error_dB = 10 * std::log10(1 + map.standard_error[at] / gain);
      if (std::isfinite(error_dB)) errors_dB.push_back(error_dB);
    }
    figures.asked += asked;
    figures.reached += reached;
  }
  figures.median_standard_error_dB = median(errors_dB);
  if (!errors_dB.empty()) {
    const auto at = errors_dB.begin() + std::ptrdiff_t(0.95 * double(errors_dB.size() - 1));
    std::nth_element(errors_dB.begin(), at, errors_dB.end());
    figures.p95_standard_error_dB = *at;
  }
  for (std::size_t t = 0; t < transmitters; ++t)
    for (std::size_t m = 0; m < mechanism_count; ++m)
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const double gain = map.mechanism_gain[(t * mechanism_count + m) * bands * cells + cell];
        if (!std::isnan(gain)) figures.mechanism_power[m] += gain;
      }
  for (std::size_t t = 0; t < transmitters; ++t)
    for (std::size_t m = 0; m < edge_model_count; ++m)
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const double gain = map.model_gain[(t * edge_model_count + m) * cells + cell];
        if (!std::isnan(gain)) figures.model_power[m] += gain;
      }
  return figures;
}

std::string prediction_json(const Prediction& predicted) { return predicted_json(predicted).dump(2) + "\n"; }

std::string summary_json(const Plan& plan, const Result& result, const std::vector<std::string>& outputs) {
  const RunFigures& run = result.figures;
  const MapFigures map = result.coverage ? map_figures(plan, *result.coverage) : MapFigures{};
  nlohmann::ordered_json power, models, flux, summary;
  for (std::size_t m = 0; m < mechanism_count; ++m) power[mechanism_names[m]] = map.mechanism_power[m];
  for (std::size_t m = 0; m < edge_model_count; ++m) models[edge_model_names[m]] = map.model_power[m];
  flux["launched"] = run.flux.launched;
  flux["absorbed"] = run.flux.absorbed;
  flux["escaped"] = run.flux.escaped;
  flux["cut_by_depth"] = run.flux.cut_by_depth;

  summary["wall_seconds"] = run.wall_seconds;
  summary["cpu_seconds"] = run.cpu_seconds;
  summary["trace_seconds"] = run.trace_seconds;
  if (run.predicted) summary["predicted"] = predicted_json(*run.predicted);
  summary["threads"] = run.threads;
  summary["peak_memory_bytes"] = run.peak_memory_bytes;
  summary["rays"] = run.rays;
  summary["rays_per_second"] = rate(run.rays, run.trace_seconds);
  summary["segments"] = run.segments;
  summary["segments_per_second"] = rate(run.segments, run.trace_seconds);
  summary["shadow_rays"] = run.shadow_rays;
  summary["passes"] = run.passes;
  summary["mechanism_power"] = power;
  summary["model_power"] = models;
  summary["cells"] = map.cells;
  summary["cells_asked"] = map.asked;
  summary["cells_reached"] = map.reached;
  summary["median_standard_error_dB"] = map.median_standard_error_dB;
  summary["p95_standard_error_dB"] = map.p95_standard_error_dB;
  if (!run.rounds.empty()) summary["budget"] = budget_json(plan, run);
  summary["flux"] = flux;
  summary["stage_seconds"] = {{"discover", run.discover_seconds},
                              {"merge", run.merge_seconds},
                              {"grow", run.grow_seconds},
                              {"evaluate", run.evaluate_seconds}};
  summary["sequences"] = run.sequences;
  summary["sequence_cell_pairs"] = run.sequence_cell_pairs;
  summary["warnings"] = nlohmann::ordered_json::array();
  for (const Diagnostic& warning : result.warnings) summary["warnings"].push_back(to_string(warning));
  summary["outputs"] = outputs;
  // Names of files need not be UTF-8; what is not becomes U+FFFD, since JSON must be.
  return summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace grimaldi
