#include "cli/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <mutex>

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

/// One band of a map, all transmitters together.
class SummedMap {
 public:
  SummedMap(const Plan& plan, const CoverageMap& map, const ShownQuantity& quantity, std::size_t band)
      : map_(map), weight_(quantity.weight), band_(band), bands_(plan.bands()), cells_(plan.grid.size()) {
    GRIMALDI_EXPECT(map.path_gain.size() == weight_.size() * bands_ * cells_);
  }
  double gain(std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t) sum += share(t, cell);
    return sum;
  }
  double variance(std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t) {
      const double error = weight_[t] * map_.standard_error[(t * bands_ + band_) * cells_ + cell];
      sum += error * error;
    }
    return sum;
  }
  double layer(Mechanism mechanism, std::size_t cell) const {
    double sum = 0;
    for (std::size_t t = 0; t < weight_.size(); ++t)
      sum += weight_[t] *
             map_.mechanism_gain[((t * mechanism_count + std::size_t(mechanism)) * bands_ + band_) * cells_ + cell];
    return sum;
  }
  /// The transmitter that brings most.
  std::size_t strongest(std::size_t cell) const {
    std::size_t best = 0;
    for (std::size_t t = 1; t < weight_.size(); ++t)
      if (share(t, cell) > share(best, cell)) best = t;
    return best;
  }

 private:
  double share(std::size_t t, std::size_t cell) const {
    return weight_[t] * map_.path_gain[(t * bands_ + band_) * cells_ + cell];
  }

  const CoverageMap& map_;
  const std::vector<double>& weight_;
  std::size_t band_, bands_, cells_;
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

/// Both maps in one band.
struct BandMaps {
  ShownQuantity quantity;
  SummedMap fsd, utd;

  BandMaps(const Plan& plan, const Result& of_fsd, const Result& of_utd, std::size_t band)
      : quantity(shown_quantity(plan, band)),
        fsd(plan, *of_fsd.coverage, quantity, band),
        utd(plan, *of_utd.coverage, quantity, band) {}
  BandMaps(const BandMaps&) = delete;  // the maps refer to the quantity
  BandMaps& operator=(const BandMaps&) = delete;
};

Comparison::Sort sort_of(double fsd, double utd) {
  using Sort = Comparison::Sort;
  if (std::isnan(fsd) || std::isnan(utd)) return Sort::inside;
  if (fsd > 0 && utd > 0) return Sort::both;
  if (fsd > 0) return Sort::only_fsd;
  return utd > 0 ? Sort::only_utd : Sort::neither;
}

/// Regions of the cells that both reach, lit elsewhere; band by band. The detour over an edge is the same in all bands,
/// v goes with the root of the frequency: asked once, at the lowest.
std::vector<std::vector<Region>> regions_of(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                            const CoverageMap& map, const std::deque<BandMaps>& maps,
                                            const std::function<void(double)>& progress,
                                            const std::atomic<bool>* stop) {
  const std::size_t bands = maps.size();
  const double lowest = *std::min_element(plan.wavenumber.begin(), plan.wavenumber.end());
  const ShadowDepth depth(scene, tracer, 2 * pi / lowest);
  std::vector<std::vector<Region>> regions(bands, std::vector<Region>(plan.grid.size(), Region::lit));
  std::mutex mutex;  // guards the two below
  std::size_t rows_done = 0;
  const auto tell = [&] {
    const std::lock_guard lock(mutex);
    ++rows_done;
    if (progress) progress(double(rows_done) / double(plan.grid.ny));
  };
  for_each_block(
      plan.grid.ny, plan.request.threads,
      [&](std::size_t row, unsigned) {
        for (std::size_t cell = row * plan.grid.nx; cell < (row + 1) * plan.grid.nx; ++cell) {
          std::optional<std::size_t> asked;  // the transmitter that v is of
          double v = 0;
          for (std::size_t band = 0; band < bands; ++band) {
            if (sort_of(maps[band].fsd.gain(cell), maps[band].utd.gain(cell)) != Comparison::Sort::both) continue;
            const std::size_t strongest = maps[band].fsd.strongest(cell);
            if (asked != strongest) {
              asked = strongest;
              v = depth(plan.request.transmitters[strongest].position, outdoor_point(plan, tracer, map, cell),
                        transition_v, shadow_v);
            }
            regions[band][cell] = region_of(v * std::sqrt(plan.wavenumber[band] / lowest));
          }
        }
        tell();
      },
      stop);
  return regions;
}

ReceiverFigures receiver_figures(const Plan& plan, const ShownQuantity& quantity, std::size_t band,
                                 const ReceiverProfile& profile) {
  double power = 0, first = 0, second = 0;  // moments of the delay
  for (std::size_t t = 0; t < quantity.weight.size(); ++t) {
    const std::size_t at = t * plan.bands() + band;
    const double p = quantity.weight[t] * profile.total[at];
    const double mean = profile.mean_delay[at], spread = profile.rms_delay_spread[at];
    if (!(p > 0) || !std::isfinite(mean) || !std::isfinite(spread)) continue;
    power += p;
    first += p * mean;
    second += p * (mean * mean + spread * spread);
  }
  if (!(power > 0)) return {nothing, nothing};
  if (quantity.weight.size() == 1) return {decibels(power), profile.rms_delay_spread[band]};
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
      "Deep behind solid wedges FSD errs by 4 to 25 dB (soft). Over a flat roof UTD errs by 0.1 dB in the median, "
      "over two roofs by 0.25 dB at one point in ten (paths of depth 6, at receivers), FSD by 1.8 to 4.3 dB (soft) or "
      "0.4 dB (hard)."};
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

/// One item a line; `indent` begins the line of the closing bracket.
std::string joined(const std::vector<std::string>& items, char open, char close, const std::string& indent) {
  if (items.empty()) return {open, close};
  return fmt::format("{}\n{}  {}\n{}{}", open, indent, fmt::join(items, ",\n  " + indent), indent, close);
}

/// What compare.json says of a band: difference_dB … profiles, each on a line that begins with `indent`.
std::string band_members(const Comparison& comparison, const BandComparison& band, const std::string& indent) {
  std::vector<std::string> regions, mechanisms, profiles;
  for (std::size_t r = 0; r < region_count; ++r)
    regions.push_back(fmt::format(R"({{"name": {}, {}, "believe": {}, "why": {}}})", quoted(region_names[r]),
                                  members(band.regions[r]), quoted(comparison.beliefs[r].model),
                                  quoted(comparison.beliefs[r].why)));
  for (std::size_t m = 0; m < mechanism_count; ++m)
    if (band.mechanisms[m].cells > 0)
      mechanisms.push_back(fmt::format(R"({}: {{{}}})", quoted(mechanism_names[m]), members(band.mechanisms[m])));
  for (std::size_t r = 0; r < comparison.receivers.size(); ++r) {
    const ReceiverFigures &f = band.fsd[r], &u = band.utd[r];
    profiles.push_back(
        fmt::format(R"({}: {{{}, "fsd": {{{}}}, "utd": {{{}}}}})", quoted(comparison.receivers[r]),
                    members(ReceiverFigures{f.level_dB - u.level_dB, f.delay_spread_s - u.delay_spread_s}), members(f),
                    members(u)));
  }
  const std::vector<std::string> lines = {fmt::format(R"("difference_dB": {{{}}})", members(band.all)),
                                          fmt::format(R"("only_fsd_cells": {})", band.only_fsd),
                                          fmt::format(R"("only_utd_cells": {})", band.only_utd),
                                          R"("regions": )" + joined(regions, '[', ']', indent),
                                          R"("mechanisms": )" + joined(mechanisms, '{', '}', indent),
                                          R"("profiles": )" + joined(profiles, '{', '}', indent)};
  return indent + fmt::format("{}", fmt::join(lines, ",\n" + indent));
}

/// The cells of one band; neither its frequency nor the receivers.
BandComparison compare_cells(const BandMaps& maps, const std::vector<Region>& region) {
  const auto& [quantity, a, b] = maps;
  BandComparison result;
  Gathered all;
  std::array<Gathered, region_count> regions;
  std::array<Gathered, mechanism_count> mechanisms;
  for (std::size_t cell = 0; cell < region.size(); ++cell) {
    const double of_fsd = a.gain(cell), of_utd = b.gain(cell);
    const Comparison::Sort sort = sort_of(of_fsd, of_utd);
    if (sort == Comparison::Sort::inside) continue;
    for (std::size_t m = 0; m < mechanism_count; ++m) {
      const double f = a.layer(Mechanism(m), cell), u = b.layer(Mechanism(m), cell);
      if (f > 0 && u > 0) mechanisms[m].add(decibels(f / u), false);
    }
    result.only_fsd += sort == Comparison::Sort::only_fsd;
    result.only_utd += sort == Comparison::Sort::only_utd;
    if (sort != Comparison::Sort::both) continue;
    const double difference = decibels(of_fsd / of_utd);
    const bool beyond = std::abs(difference) > same_level &&
                        std::abs(of_fsd - of_utd) > 2 * std::sqrt(a.variance(cell) + b.variance(cell));
    all.add(difference, beyond);
    regions[std::size_t(region[cell])].add(difference, beyond);
  }
  result.all = all.figures();
  for (std::size_t r = 0; r < region_count; ++r) result.regions[r] = regions[r].figures();
  for (std::size_t m = 0; m < mechanism_count; ++m)
    result.mechanisms[m] = mechanisms[m].figures(), result.mechanisms[m].beyond_noise = nothing;
  return result;
}

}  // namespace

std::optional<Comparison> compare_results(const Scene& scene, const Tracer& tracer, const Plan& plan, const Result& fsd,
                                          const Result& utd, const std::function<void(double)>& progress,
                                          const std::atomic<bool>* stop) {
  GRIMALDI_EXPECT(fsd.coverage && utd.coverage && fsd.profiles.size() == utd.profiles.size() && plan.bands() > 0);
  std::deque<BandMaps> maps;  // its members never move
  for (std::size_t band = 0; band < plan.bands(); ++band) maps.emplace_back(plan, fsd, utd, band);
  const auto regions = regions_of(scene, tracer, plan, *fsd.coverage, maps, progress, stop);
  if (stop != nullptr && stop->load()) return std::nullopt;
  Comparison result;
  for (std::size_t cell = 0; cell < plan.grid.size(); ++cell) {
    const double of_fsd = maps.front().fsd.gain(cell), of_utd = maps.front().utd.gain(cell);
    result.sort.push_back(sort_of(of_fsd, of_utd));
    result.difference_dB.push_back(result.sort.back() == Comparison::Sort::both ? decibels(of_fsd / of_utd) : nothing);
  }
  result.region = regions.front();
  for (std::size_t band = 0; band < plan.bands(); ++band) {
    BandComparison& one = result.bands.emplace_back(compare_cells(maps[band], regions[band]));
    one.frequency = plan.frequency[band];
    for (std::size_t r = 0; r < fsd.profiles.size(); ++r) {
      one.fsd.push_back(receiver_figures(plan, maps[band].quantity, band, fsd.profiles[r]));
      one.utd.push_back(receiver_figures(plan, maps[band].quantity, band, utd.profiles[r]));
    }
  }
  for (const ReceiverProfile& profile : fsd.profiles) result.receivers.push_back(profile.name);
  result.solid = mostly_solid(scene);
  for (std::size_t r = 0; r < region_count; ++r) result.beliefs[r] = belief(Region(r), result.solid);
  return result;
}

std::string comparison_json(const Comparison& comparison, const std::string& fsd_summary,
                            const std::string& utd_summary, const std::vector<std::string>& words) {
  std::vector<std::string> bands, sentences;
  for (const BandComparison& band : comparison.bands)
    bands.push_back(fmt::format("{{\n      \"frequency_Hz\": {},\n{}\n    }}", number(band.frequency),
                                band_members(comparison, band, "      ")));
  for (const std::string& sentence : words) sentences.push_back(quoted(sentence));
  return fmt::format(R"({{
  "models": {{
    "fsd": {},
    "utd": {}
  }},
{},
  "bands": {},
  "words": {}
}}
)",
                     nested(fsd_summary), nested(utd_summary), band_members(comparison, comparison.first(), "  "),
                     joined(bands, '[', ']', "  "), joined(sentences, '[', ']', "  "));
}

}  // namespace grimaldi
