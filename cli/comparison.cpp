#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/plan_words.h"
#include "cli/shadow_depth.h"
#include "core/blocks.h"
#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double decibels(double ratio) { return 10 * std::log10(ratio); }

/// Nearest rank; NaN of none. Reorders `values`.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return nothing;
  const auto rank = std::size_t(std::max(1.0, std::ceil(share * double(values.size())))) - 1;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
  return values[rank];
}

/// Differences of some cells, and how many of them lie beyond the noise.
struct Gathered {
  std::vector<double> values;
  std::size_t beyond = 0;

  void add(double value, bool beyond_noise) {
    values.push_back(value);
    beyond += beyond_noise;
  }
  DifferenceFigures figures() {
    DifferenceFigures f;
    f.cells = values.size();
    f.beyond_noise = values.empty() ? nothing : double(beyond) / double(values.size());
    f.median = quantile(values, 0.5);
    for (double& value : values) value = std::abs(value);
    f.median_abs = quantile(values, 0.5);
    f.p95_abs = quantile(values, 0.95);
    return f;
  }
};

/// A map's first band, all transmitters together.
class SummedMap {
 public:
  SummedMap(const Plan& plan, const CoverageMap& map, const ShownQuantity& quantity)
      : map_(map), weight_(quantity.weight), bands_(plan.bands()), cells_(plan.grid.size()) {
    GRIMALDI_EXPECT(map.path_gain.size() == weight_.size() * bands_ * cells_);
  }
  double gain(std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t) sum += weight_[t] * map_.path_gain[t * bands_ * cells_ + cell];
    return sum;
  }
  double variance(std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t) {
      const double error = weight_[t] * map_.standard_error[t * bands_ * cells_ + cell];
      sum += error * error;
    }
    return sum;
  }
  double layer(Mechanism mechanism, std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t)
      sum += weight_[t] * map_.mechanism_gain[(t * mechanism_count + std::size_t(mechanism)) * bands_ * cells_ + cell];
    return sum;
  }

 private:
  const CoverageMap& map_;
  const std::vector<double>& weight_;
  std::size_t bands_, cells_;
};

/// A point of the cell that lies outdoors: its centre, or the middle of a quarter.
Vec3 outdoor_point(const Plan& plan, const Tracer& tracer, const CoverageMap& map, std::size_t cell) {
  const Vec3 centre = plan.grid.centre(cell);
  if (!(map.inside_fraction[cell] > 0) || !tracer.inside_solid(centre)) return centre;
  for (const double x : {-0.25, 0.25})
    for (const double y : {-0.25, 0.25}) {
      const Vec3 point = centre + Vec3{x * plan.grid.cell, y * plan.grid.cell, 0};
      if (!tracer.inside_solid(point)) return point;
    }
  return centre;
}

Region region_of(double v) {
  if (v < -transition_v) return Region::lit;
  if (v <= transition_v) return Region::transition;
  return v <= shadow_v ? Region::shadow : Region::deep_shadow;
}

/// Regions of the cells that both reach; lit elsewhere.
std::vector<Region> regions_of(const Scene& scene, const Tracer& tracer, const Plan& plan, const CoverageMap& map,
                               const ShownQuantity& quantity, const std::vector<Comparison::Sort>& sort) {
  const std::size_t cells = plan.grid.size();
  const double wavelength = 2 * pi / plan.wavenumber.front();
  const ShadowDepth depth(scene, tracer, wavelength);
  std::vector<Region> regions(cells, Region::lit);
  for_each_block(plan.grid.ny, plan.request.threads, [&](std::size_t row, unsigned) {
    for (std::size_t cell = row * plan.grid.nx; cell < (row + 1) * plan.grid.nx; ++cell) {
      if (sort[cell] != Comparison::Sort::both) continue;
      std::size_t strongest = 0;
      double most = -1;
      for (std::size_t t = 0; t < quantity.weight.size(); ++t) {
        const double gain = quantity.weight[t] * map.path_gain[t * plan.bands() * cells + cell];
        if (gain > most) most = gain, strongest = t;
      }
      const Vec3& from = plan.request.transmitters[strongest].position;
      const Vec3 to = outdoor_point(plan, tracer, map, cell);
      regions[cell] = region_of(depth(from, to, transition_v, shadow_v));
    }
  });
  return regions;
}

ReceiverFigures receiver_figures(const Plan& plan, const ShownQuantity& quantity, const ReceiverProfile& profile) {
  double power = 0, first = 0, second = 0;  // moments of the delay
  for (std::size_t t = 0; t < quantity.weight.size(); ++t) {
    const std::size_t at = t * plan.bands();
    const double p = quantity.weight[t] * profile.total[at];
    const double mean = profile.mean_delay[at], spread = profile.rms_delay_spread[at];
    if (!(p > 0) || !std::isfinite(mean) || !std::isfinite(spread)) continue;
    power += p;
    first += p * mean;
    second += p * (mean * mean + spread * spread);
  }
  if (!(power > 0)) return {nothing, nothing};
  if (quantity.weight.size() == 1) return {decibels(power), profile.rms_delay_spread.front()};
  const double mean = first / power;
  return {decibels(power), std::sqrt(std::max(0.0, second / power - mean * mean))};
}

bool mostly_solid(const Scene& scene) {
  double solid = 0, thin = 0;
  for (const Wedge& wedge : scene.wedges.wedges) {
    // 1°: a plate without thickness has an exterior of 2π but for rounding.
    const bool screen = wedge.free_rim || wedge.exterior_angle > 2 * pi - pi / 180;
    (screen ? thin : solid) += wedge.length;
  }
  return solid > thin;
}

Belief belief(Region region, bool solid) {
  if (region == Region::lit) return {"either", "The direct wave decides, and it is the same in both."};
  if (!solid) return {"either", "At the edges of thin screens both theories are the same law."};
  if (region == Region::transition)
    return {"utd",
            "Beside the shadow boundary of a soft solid wedge the three black edges of FSD err by up to 2.6 dB, UTD by "
            "0.02 dB."};
  if (region == Region::shadow)
    return {
        "utd",
        "Behind a single solid wedge UTD errs by 0.02 dB, the three black edges of FSD by up to 2.6 dB (soft, within "
        "20 degrees of the boundary), 4 to 25 dB (soft, deeper) or 1.6 dB (hard)."};
  return {
      "utd",
      "Deep behind solid wedges FSD errs by 4 to 25 dB (soft). Where a wave passes two edges of one face neither is to "
      "be trusted."};
}

// What is not finite is null.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

/// `text` in quotes, as JSON has it. Requires text without control characters.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// Members of an object, without its braces.
std::string members(const DifferenceFigures& f) {
  std::string text = fmt::format(R"("cells": {}, "median": {}, "median_abs": {}, "p95_abs": {})", f.cells,
                                 number(f.median), number(f.median_abs), number(f.p95_abs));
  if (std::isfinite(f.beyond_noise)) text += fmt::format(R"(, "beyond_noise": {})", f.beyond_noise);
  return text;
}

std::string members(const ReceiverFigures& f) {
  return fmt::format(R"("level_dB": {}, "delay_spread_s": {})", number(f.level_dB), number(f.delay_spread_s));
}

/// A summary as a member: its lines further in, no line at the end.
std::string nested(std::string summary) {
  while (!summary.empty() && summary.back() == '\n') summary.pop_back();
  std::string out;
  for (const char c : summary) out += c == '\n' ? std::string("\n    ") : std::string(1, c);
  return out;
}

std::string joined(const std::vector<std::string>& lines, char open, char close) {
  if (lines.empty()) return {open, close};
  return fmt::format("{}\n    {}\n  {}", open, fmt::join(lines, ",\n    "), close);
}

}  // namespace

Comparison compare_results(const Scene& scene, const Tracer& tracer, const Plan& plan, const Result& fsd,
                           const Result& utd) {
  GRIMALDI_EXPECT(fsd.coverage && utd.coverage && fsd.profiles.size() == utd.profiles.size());
  const ShownQuantity quantity = shown_quantity(plan);
  const SummedMap a(plan, *fsd.coverage, quantity), b(plan, *utd.coverage, quantity);
  const std::size_t cells = plan.grid.size();
  Comparison result;
  result.sort.assign(cells, Comparison::Sort::neither);
  result.difference_dB.assign(cells, nothing);
  std::vector<bool> beyond_noise(cells, false);
  Gathered all;
  std::array<Gathered, region_count> regions;
  std::array<Gathered, mechanism_count> mechanisms;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double of_fsd = a.gain(cell), of_utd = b.gain(cell);
    if (std::isnan(of_fsd) || std::isnan(of_utd)) {
      result.sort[cell] = Comparison::Sort::inside;
      continue;
    }
    for (std::size_t m = 0; m < mechanism_count; ++m) {
      const double f = a.layer(Mechanism(m), cell), u = b.layer(Mechanism(m), cell);
      if (f > 0 && u > 0) mechanisms[m].add(decibels(f / u), false);
    }
    if (!(of_fsd > 0 && of_utd > 0)) {
      if (of_fsd > 0) result.sort[cell] = Comparison::Sort::only_fsd, ++result.only_fsd;
      if (of_utd > 0) result.sort[cell] = Comparison::Sort::only_utd, ++result.only_utd;
      continue;
    }
    const double difference = decibels(of_fsd / of_utd);
    result.sort[cell] = Comparison::Sort::both;
    result.difference_dB[cell] = difference;
    const bool beyond = std::abs(difference) > same_level &&
                        std::abs(of_fsd - of_utd) > 2 * std::sqrt(a.variance(cell) + b.variance(cell));
    beyond_noise[cell] = beyond;
    all.add(difference, beyond);
  }
  result.region = regions_of(scene, tracer, plan, *fsd.coverage, quantity, result.sort);
  for (std::size_t cell = 0; cell < cells; ++cell)
    if (result.sort[cell] == Comparison::Sort::both)
      regions[std::size_t(result.region[cell])].add(result.difference_dB[cell], beyond_noise[cell]);
  result.all = all.figures();
  result.solid = mostly_solid(scene);
  for (std::size_t r = 0; r < region_count; ++r) {
    result.regions[r] = regions[r].figures();
    result.beliefs[r] = belief(Region(r), result.solid);
  }
  for (std::size_t m = 0; m < mechanism_count; ++m)
    result.mechanisms[m] = mechanisms[m].figures(), result.mechanisms[m].beyond_noise = nothing;
  for (std::size_t r = 0; r < fsd.profiles.size(); ++r) {
    result.receivers.push_back(fsd.profiles[r].name);
    result.fsd.push_back(receiver_figures(plan, quantity, fsd.profiles[r]));
    result.utd.push_back(receiver_figures(plan, quantity, utd.profiles[r]));
  }
  return result;
}

std::string comparison_json(const Comparison& comparison, const std::string& fsd_summary,
                            const std::string& utd_summary, const std::vector<std::string>& words) {
  std::vector<std::string> regions, mechanisms, profiles, sentences;
  for (std::size_t r = 0; r < region_count; ++r)
    regions.push_back(fmt::format(R"({{"name": {}, {}, "believe": {}, "why": {}}})", quoted(region_names[r]),
                                  members(comparison.regions[r]), quoted(comparison.beliefs[r].model),
                                  quoted(comparison.beliefs[r].why)));
  for (std::size_t m = 0; m < mechanism_count; ++m)
    if (comparison.mechanisms[m].cells > 0)
      mechanisms.push_back(fmt::format(R"({}: {{{}}})", quoted(mechanism_names[m]), members(comparison.mechanisms[m])));
  for (std::size_t r = 0; r < comparison.receivers.size(); ++r) {
    const ReceiverFigures &f = comparison.fsd[r], &u = comparison.utd[r];
    profiles.push_back(
        fmt::format(R"({}: {{{}, "fsd": {{{}}}, "utd": {{{}}}}})", quoted(comparison.receivers[r]),
                    members(ReceiverFigures{f.level_dB - u.level_dB, f.delay_spread_s - u.delay_spread_s}), members(f),
                    members(u)));
  }
  for (const std::string& sentence : words) sentences.push_back(quoted(sentence));
  return fmt::format(R"({{
  "models": {{
    "fsd": {},
    "utd": {}
  }},
  "difference_dB": {{{}}},
  "only_fsd_cells": {},
  "only_utd_cells": {},
  "regions": {},
  "mechanisms": {},
  "profiles": {},
  "words": {}
}}
)",
                     nested(fsd_summary), nested(utd_summary), members(comparison.all), comparison.only_fsd,
                     comparison.only_utd, joined(regions, '[', ']'), joined(mechanisms, '{', '}'),
                     joined(profiles, '{', '}'), joined(sentences, '[', ']'));
}

}  // namespace grimaldi
