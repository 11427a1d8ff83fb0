// The section [wave].

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/bands.h"
#include "core/medium.h"
#include "propagation/plan_sections.h"

namespace grimaldi {
namespace {

// Humidity and temperature within the stated range of the formulas for sound; pressure as in ISO 9613-1, below 200 kPa.
void read_air(ScenarioReader& reader, const ScenarioNode& wave, Air& air) {
  reader.read(wave, "temperature", Dimension::temperature, {223.15, 323.15}, air.temperature);
  reader.read(wave, "humidity", Dimension::number, {0, 1}, air.relative_humidity);
  reader.read(wave, "pressure", Dimension::pressure, {0, 200e3, true}, air.pressure);
}

std::vector<double> bands_in(ScenarioReader& reader, const ScenarioNode& node, bool thirds) {
  if (node.kind != ScenarioNode::Kind::table) {
    reader.fault(node, "wrong kind of value", "a table is needed", "write { from = \"63Hz\", to = \"8kHz\" }");
    return {};
  }
  reader.check_keys(node, {"from", "to"});
  double from = 0, to = 0;
  reader.read(node, "from", Dimension::frequency, positive, from);
  reader.read(node, "to", Dimension::frequency, positive, to);
  for (const char* key : {"from", "to"})
    if (node.find(key) == nullptr)
      reader.missing(node, key, "bands need both ends", "write { from = \"63Hz\", to = \"8kHz\" }");
  if (from <= 0 || to <= 0) return {};
  if (from > to) {
    reader.fault(node, "out of range",
                 fmt::format("from ({}) lies above to ({})", format_frequency(from), format_frequency(to)),
                 "exchange them");
    return {};
  }
  std::vector<double> bands = thirds ? third_octave_bands(from, to) : octave_bands(from, to);
  if (bands.empty())
    reader.fault(node, "no band", fmt::format("no band lies in {} … {}", format_frequency(from), format_frequency(to)),
                 thirds ? "third-octaves run from 25 Hz to 20 kHz" : "octaves run from 31.5 Hz to 16 kHz");
  return bands;
}

std::vector<double> read_frequencies(ScenarioReader& reader, const ScenarioNode& wave, const PlanDescription& plan) {
  std::vector<const ScenarioNode*> given;
  for (const char* key : {"frequency", "wavelength", "octaves", "third_octaves"})
    if (const ScenarioNode* node = wave.find(key)) given.push_back(node);
  if (given.empty()) {
    reader.missing(wave, "frequency", "a run needs a frequency",
                   "set wave.frequency = \"3.5GHz\", or give --frequency 3.5GHz");
    return {};
  }
  if (given.size() > 1) {
    for (std::size_t i = 1; i < given.size(); ++i)
      reader.fault(*given[i], "more than one kind of frequency", fmt::format("{} is given too", given[0]->path),
                   "keep one of frequency, wavelength, octaves, third_octaves");
    return {};
  }
  const ScenarioNode& node = *given.front();
  std::vector<double> values;
  if (node.key == "frequency") {
    values = reader.numbers(node, Dimension::frequency, positive);
  } else if (node.key == "wavelength") {
    values = reader.numbers(node, Dimension::length, positive);
    for (double& value : values) value = wave_speed(plan.kind, plan.air) / value;
  } else {
    values = bands_in(reader, node, node.key == "third_octaves");
  }
  for (const double value : values) {
    if (!std::isfinite(value)) {  // a wavelength so short that its frequency is no double
      reader.fault(node, "out of range", "the frequency of this wavelength is not finite");
      return {};
    }
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
  if (twin != sorted.end()) {
    reader.fault(node, "given twice", format_frequency(*twin) + " stands twice in the list", "leave one out");
    return {};
  }
  return values;
}

}  // namespace

std::vector<std::size_t> read_wave_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  const ScenarioNode* wave = reader.table(root, "wave");
  if (wave == nullptr) {
    if (root.find("wave") == nullptr)
      reader.missing(root, "wave", "a run needs a frequency",
                     "set wave.frequency = \"3.5GHz\", or give --frequency 3.5GHz");
    return {};
  }
  const std::size_t faults_before = reader.error_count();
  reader.check_keys(
      *wave, {"kind", "frequency", "wavelength", "octaves", "third_octaves", "temperature", "humidity", "pressure"});
  reader.read<WaveKind>(*wave, "kind", {{"radio", WaveKind::radio}, {"acoustic", WaveKind::acoustic}}, plan.kind);
  read_air(reader, *wave, plan.air);
  const std::vector<double> given = read_frequencies(reader, *wave, plan);
  // Of another wave than the one meant the materials and the powers would be judged wrongly: then not at all.
  if (reader.error_count() > faults_before) return {};
  std::vector<std::size_t> order(given.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return given[a] < given[b]; });
  for (const std::size_t i : order) plan.frequency.push_back(given[i]);
  return order;
}

}  // namespace grimaldi
