#pragma once
// Two runs of one scenario, once with FSD and once with UTD, held against each other.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Where a cell lies for the wave of the transmitter that brings it most: the parameter v of the dominant knife edge
/// (cli/shadow_depth.h) between that transmitter and the cell's centre.
/// * lit: v < −2.25: the line is free, and an edge's wave lies more than 20 dB below the direct one;
/// * transition: |v| ≤ 2.25;
/// * shadow: 2.25 < v ≤ 22.5: a single edge leads around, and a knife edge would cost 20 to 40 dB;
/// * deep shadow: a knife edge would cost more, or no single edge sees both ends: two or more have to be passed.
/// Reflections are not asked: in a shadow that a reflection fills both theories say nearly the same.
enum class Region : std::uint8_t { lit, transition, shadow, deep_shadow };
inline constexpr std::size_t region_count = 4;
inline constexpr const char* region_names[region_count] = {"lit", "transition", "shadow", "deep shadow"};
/// Far from its boundary an edge's wave is 1/(√2 π |v|) of the field: 0.1 and 0.01 at these two.
inline constexpr double transition_v = 2.25, shadow_v = 22.5;

/// Half-plane laws of both theories agree to this, dB: less is no disagreement, even where the sampling has no noise.
inline constexpr double same_level = 0.02;

/// Level of FSD less that of UTD over some cells, dB. NaN where there are no cells.
struct DifferenceFigures {
  std::size_t cells = 0;
  double median = 0, median_abs = 0, p95_abs = 0;
  double beyond_noise = 0;  ///< share of the cells (0 … 1) that differ by more than twice their noise and by more than
                            ///< `same_level`; NaN for mechanisms, whose errors are not known
};

/// Whom to believe in a region, as `grimaldi validate` has measured it; `why` in one sentence.
struct Belief {
  std::string model;  ///< "either", "utd"
  std::string why;
};

/// A receiver under one theory. The level is that of ShownQuantity, all transmitters together, one band; the spread
/// that of the sum of their profiles. NaN where nothing arrived.
struct ReceiverFigures {
  double level_dB = 0, delay_spread_s = 0;
};

/// One band of both results.
struct BandComparison {
  double frequency = 0;  ///< Hz
  std::size_t only_fsd = 0, only_utd = 0;
  DifferenceFigures all;
  std::array<DifferenceFigures, region_count> regions;
  std::array<DifferenceFigures, mechanism_count> mechanisms;  ///< over cells where both layers are positive
  std::vector<ReceiverFigures> fsd, utd;                      ///< per receiver
};

struct Comparison {
  enum class Sort : std::uint8_t { inside, neither, only_fsd, only_utd, both };
  // Of the first band, per cell:
  std::vector<Sort> sort;
  std::vector<double> difference_dB;  ///< of cells that both reach; NaN elsewhere
  std::vector<Region> region;         ///< of cells that both reach; lit elsewhere
  std::vector<BandComparison> bands;
  std::array<Belief, region_count> beliefs;
  std::vector<std::string> receivers;
  bool solid = false;  ///< most of the edges' length belongs to solids, not to thin screens

  const BandComparison& first() const { return bands.front(); }
};

/// Compares two results of the same plan, band by band; both must have a coverage map with the shapes of `plan`, which
/// has at least one band. The noise of a cell is √(σ² of FSD + σ² of UTD). Both runs send the same beams and find
/// mostly the same paths, so their errors go together and this is more than the noise of the difference. `progress` is
/// told the share done (0 … 1), by one thread at a time; nothing, if `stop` became true before the end.
std::optional<Comparison> compare_results(const Scene& scene, const Tracer& tracer, const Plan& plan, const Result& fsd,
                                          const Result& utd, const std::function<void(double)>& progress = {},
                                          const std::atomic<bool>* stop = nullptr);

/// The text of compare.json. `fsd_summary` and `utd_summary` are the texts of the two summary.json; `words` goes in as
/// a list.
std::string comparison_json(const Comparison& comparison, const std::string& fsd_summary,
                            const std::string& utd_summary, const std::vector<std::string>& words);

}  // namespace grimaldi
