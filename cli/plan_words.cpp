#include "cli/plan_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/axes.h"
#include "core/medium.h"
#include "core/quantity.h"

namespace grimaldi {
namespace {

/// A level with as many decimals as it needs, at most two.
std::string level_text(double level) {
  int decimals = 0;
  while (decimals < 2 &&
         std::abs(level - std::round(level * std::pow(10, decimals)) / std::pow(10, decimals)) > 0.005) {
    ++decimals;
  }
  return number_text(level, decimals);
}

/// Power of a transmitter in the first band, or nothing if it has none.
std::string power_words(const Plan& plan, const Transmitter& transmitter) {
  if (transmitter.power.empty()) return {};
  return fmt::format(" ({} {})", level_text(transmitter.power.front()),
                     plan.request.kind == WaveKind::radio ? "dBm" : "dB re 1 pW");
}

std::string model_words(DiffractionModel model) {
  switch (model) {
    case DiffractionModel::fsd:
      return "FSD";
    case DiffractionModel::fsd_published:
      return "FSD as published";
    case DiffractionModel::utd:
      return "UTD";
    case DiffractionModel::automatic:
      return "FSD or UTD, automatic";
  }
  return {};
}

}  // namespace

std::string scene_words(const Scene& scene) {
  const std::string file = std::filesystem::path(scene.name).filename().string();
  return file.empty() ? scene.name : file;
}

std::string frequency_words(const Plan& plan, std::size_t band) {
  const double frequency = plan.frequency[band];
  return format_frequency(plan.request.kind == WaveKind::acoustic ? nominal_frequency(frequency) : frequency);
}

std::string band_words(const Plan& plan) {
  if (plan.frequency.empty()) return {};
  std::string words = frequency_words(plan, 0);
  if (plan.bands() > 1) words += fmt::format(" (first of {} bands)", plan.bands());
  return words;
}

std::string transmitter_words(const Plan& plan) {
  const std::string noun = plan.request.kind == WaveKind::radio ? "transmitter" : "source";
  const std::vector<Transmitter>& all = plan.request.transmitters;
  if (all.size() == 1) return noun + " " + all.front().name + power_words(plan, all.front());
  std::string words = fmt::format("sum of {} {}s:", all.size(), noun);
  constexpr std::size_t named = 5;
  for (std::size_t i = 0; i < std::min(all.size(), named); ++i) words += (i == 0 ? " " : ", ") + all[i].name;
  if (all.size() > named) words += fmt::format(" and {} more", all.size() - named);
  return words;
}

std::vector<std::string> method_words(const Plan& plan) {
  const PlanDescription& request = plan.request;
  std::vector<std::string> mechanisms;
  if (request.direct) mechanisms.push_back("direct");
  if (request.reflection) mechanisms.push_back("reflection");
  if (request.diffraction) mechanisms.push_back("diffraction (" + model_words(request.diffraction_model) + ")");
  return {fmt::format("{}", fmt::join(mechanisms, ", ")), fmt::format("depth {}", request.depth),
          number_text(request.rays, 0) + " rays" + (request.transmitters.size() > 1 ? " each" : "")};
}

double ShownQuantity::decibels(std::size_t transmitter, double gain) const {
  return 10 * std::log10(weight[transmitter] * gain);
}

ShownQuantity shown_quantity(const Plan& plan, std::size_t band) {
  const std::vector<Transmitter>& all = plan.request.transmitters;
  if (plan.request.kind == WaveKind::radio) return {"path gain", "dB", std::vector<double>(all.size(), 1.0)};
  ShownQuantity level{"sound pressure level", "dB re 20 µPa", {}};
  const double impedance = characteristic_impedance(plan.request.air) / 400;
  for (const Transmitter& source : all) {
    if (source.power.empty()) return {"path gain", "dB re 1 m⁻²", std::vector<double>(all.size(), 1.0)};
    level.weight.push_back(std::pow(10, source.power[std::min(band, source.power.size() - 1)] / 10) * impedance);
  }
  return level;
}

}  // namespace grimaldi
