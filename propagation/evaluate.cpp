#include "propagation/evaluate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/composite.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/object_wave.h"
#include "propagation/sample.h"
#include "propagation/ties.h"

namespace grimaldi {
namespace {

constexpr auto diffraction_layer = static_cast<std::size_t>(Mechanism::diffraction);
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Cross terms over one set of points, and the power of the paths that have them.
struct CrossTerms {
  double interference = 0, power = 0;  ///< Σ w I, Σ w |h|²
};

/// What the points of one set bring.
struct PointSums {
  double mean = 0, square = 0;  ///< Σ w x, Σ w x²
  void add(double weight, double x) {
    mean += weight * x;
    square += weight * x * x;
  }
};

/// Sums of one cell and band.
struct CellSums {
  std::array<double, mechanism_count> layers{};
  double delay = 0, delay2 = 0, power = 0;  ///< power-weighted moments of the delay about the straight way's
  double strong = 0;                        ///< the part of `power` that strong paths bring
  PointSums fine, coarse, dense;
  CrossTerms all, few, many;      ///< of all paths and of the strong ones at coarse points, of these at dense ones
  std::array<double, 32> lone{};  ///< gain that one pass alone found
};

/// True for the paths whose cross terms are known at the dense points.
bool is_strong(const Pair& pair) { return pair.dense != 0; }

class CellEvaluator {
 public:
  CellEvaluator(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                const CoverageGrid& grid, const Discovered& discovered, CoverageMap& map)
      : scene_(scene),
        plan_(plan),
        hair_(tie_hair(tracer.surface_gap())),
        transmitter_(transmitter),
        grid_(grid),
        discovered_(discovered),
        map_(map),
        wavelength_(2 * pi / plan.wavenumber.front()),
        composite_(scene, plan),
        sums_(plan.bands()),
        interference_(plan.bands()) {}

  void evaluate(std::size_t cell, std::span<const Pair> pairs) {
    const auto points = grid_.of(cell);
    if (points.empty()) return;
    std::fill(sums_.begin(), sums_.end(), CellSums{});
    models_ = {};
    const Transmitter& transmitter = plan_.request.transmitters[transmitter_];
    // Delays are summed about the straight line's, so that their variance keeps its digits.
    const double reference_delay = distance(transmitter.position, grid_.layout.centre(cell)) / plan_.speed;
    unfolded_.clear();
    sequences_.clear();
    for (const Pair& pair : pairs) {
      unfolded_.emplace_back(scene_, transmitter.position, discovered_.sequences[pair.sequence], &plan_.small_objects);
      sequences_.push_back(pair.sequence);
    }
    at_point_.resize(plan_.bands());
    for (std::size_t i = 0; i < points.size(); ++i) at_fine_or_coarse(cell, pairs, i, reference_delay);
    for (std::size_t i = 0; i < grid_.dense_of(cell).size(); ++i) at_dense(cell, pairs, i, reference_delay);
    store(cell, pairs, points, reference_delay);
  }

 private:
  /// What comes without an edge, at a fine point; over edges, with all cross terms, at a coarse one.
  void at_fine_or_coarse(std::size_t cell, std::span<const Pair> pairs, std::size_t i, double reference_delay) {
    const SubPoint& point = grid_.of(cell)[i];
    const bool coarse = point.edge_weight > 0;
    const Vec3 place = grid_.layout.centre(cell) + point.offset;
    start_point();
    // The strong paths first, so that they are a span of their own.
    for (const bool strong_ones : {true, false})
      for (std::size_t p = 0; p < pairs.size(); ++p)
        if (is_strong(pairs[p]) == strong_ones && (pairs[p].visible >> i & 1)) arrive(place, p);
    settle(place, pairs, [](const Pair&) { return true; });
    find_fields();
    std::size_t strong = 0;
    for (std::size_t a = 0; a < arrived_; ++a) {
      const Pair& pair = pairs[arrivals_[a].number];
      strong += is_strong(pair);
      if (has_edge(pair) == coarse && !pair.refined)
        add(pair, arrivals_[a], coarse ? point.edge_weight : point.weight, reference_delay);
    }
    if (coarse) {
      cross_terms(arrived_, point.edge_weight, &CellSums::all, 1);
      cross_terms(strong, point.edge_weight, &CellSums::few, -1);
    }
    for (std::size_t band = 0; band < plan_.bands(); ++band)
      (coarse ? sums_[band].coarse : sums_[band].fine).add(coarse ? point.edge_weight : point.weight, at_point_[band]);
  }

  /// The strong paths and their cross terms at a dense point.
  void at_dense(std::size_t cell, std::span<const Pair> pairs, std::size_t i, double reference_delay) {
    const SubPoint& point = grid_.dense_of(cell)[i];
    const Vec3 place = grid_.layout.centre(cell) + point.offset;
    start_point();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].dense >> i & 1) arrive(place, p);
    settle(place, pairs, is_strong);
    find_fields();
    for (std::size_t a = 0; a < arrived_; ++a) {
      if (const Pair& pair = pairs[arrivals_[a].number]; pair.refined)
        add(pair, arrivals_[a], point.edge_weight, reference_delay);
    }
    cross_terms(arrived_, point.edge_weight, &CellSums::many, 1);
    for (std::size_t band = 0; band < plan_.bands(); ++band) sums_[band].dense.add(point.edge_weight, at_point_[band]);
  }

  void start_point() {
    arrived_ = 0;
    std::fill(at_point_.begin(), at_point_.end(), 0.0);
  }

  /// Cross terms of the first `count` arrivals into a cell's sums and, times `sign`, into those of the point.
  void cross_terms(std::size_t count, double weight, CrossTerms CellSums::*into, double sign) {
    if (count == 0) return;
    const std::span<const Arrival> arrivals(arrivals_.data(), count);
    const Polarisation polarisation = plan_.request.coverage->polarisation;
    composite_.interference(arrivals, polarisation, interference_, grid_.layout.cell * std::sqrt(weight));
    for (std::size_t band = 0; band < plan_.bands(); ++band) {
      CrossTerms& terms = sums_[band].*into;
      terms.interference += weight * interference_[band];
      for (const Arrival& arrival : arrivals) terms.power += weight * received_power(arrival.field[band], polarisation);
      at_point_[band] += sign * interference_[band];
    }
  }

  /// Solves pair number p for a point; if it gets there it is the next of `arrivals_`.
  bool arrive(const Vec3& point, std::size_t p) {
    if (arrivals_.size() <= arrived_) arrivals_.emplace_back();
    if (!solve(point, p, arrivals_[arrived_])) return false;
    ++arrived_;
    return true;
  }

  bool solve(const Vec3& point, std::size_t p, Arrival& arrival) {
    if (!unfolded_[p].solve(point, wavelength_, arrival.geometry)) return false;
    const std::uint32_t sequence = sequences_[p];
    arrival.number = p;
    arrival.hash = discovered_.sequences.hash(sequence);
    arrival.interactions = discovered_.sequences[sequence];
    return true;
  }

  /// What arrives on a shadow boundary, among the pairs that `counts`; strong ones stay first.
  template <typename Counts>
  void settle(const Vec3& point, std::span<const Pair> pairs, const Counts& counts) {
    const auto here = arrivals_.begin() + static_cast<std::ptrdiff_t>(arrived_);
    if (std::none_of(arrivals_.begin(), here, [&](const Arrival& a) { return has_tie(scene_, plan_, hair_, a); }))
      return;
    std::vector<Arrival> settled(arrivals_.begin(), here);
    settle_ties(scene_, plan_, hair_, settled, [&](SequenceHash name, Arrival& arrival) {
      const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& one) {
        return discovered_.sequences.hash(one.sequence) == name && counts(one);
      });
      return pair != pairs.end() && solve(point, static_cast<std::size_t>(pair - pairs.begin()), arrival);
    });
    std::stable_sort(settled.begin(), settled.end(), [&](const Arrival& a, const Arrival& b) {
      return is_strong(pairs[a.number]) > is_strong(pairs[b.number]);
    });
    arrived_ = settled.size();
    arrivals_ = std::move(settled);
  }

  void find_fields() {
    const Transmitter& transmitter = plan_.request.transmitters[transmitter_];
    const std::span<Arrival> arrivals(arrivals_.data(), arrived_);
    for (Arrival& arrival : arrivals) {
      arrival.field.resize(plan_.bands());
      path_field(scene_, plan_, transmitter, arrival.interactions, arrival.geometry, arrival.field);
    }
    object_fields(scene_, plan_, transmitter, arrivals);
  }

  bool has_edge(const Pair& pair) const { return count_edges(discovered_.sequences[pair.sequence]) > 0; }

  /// The power of an arrival into the sums of the cell and of the point.
  void add(const Pair& pair, const Arrival& arrival, double weight, double reference_delay) {
    const auto layer = static_cast<std::size_t>(mechanism_of(arrival.interactions));
    const double delay = arrival.geometry.length / plan_.speed - reference_delay;
    for (std::size_t band = 0; band < plan_.bands(); ++band) {
      const double here = received_power(arrival.field[band], plan_.request.coverage->polarisation);
      const double power = weight * here;
      at_point_[band] += here;
      CellSums& sums = sums_[band];
      sums.layers[layer] += power;
      if (band == 0 && layer == diffraction_layer) add_models(arrival, power);
      sums.power += power;
      if (is_strong(pair)) sums.strong += power;
      sums.delay += power * delay;
      sums.delay2 += power * delay * delay;
      if (std::has_single_bit(pair.passes)) sums.lone[std::countr_zero(pair.passes)] += power;
    }
  }

  void add_models(const Arrival& arrival, double power) {
    const auto shares = model_shares(scene_, plan_, plan_.request.transmitters[transmitter_].position, arrival);
    for (std::size_t m = 0; m < edge_model_count; ++m) models_[m] += shares[m] * power;
  }

  /// The cross terms of a cell: of the strong paths from the dense points, of the others from the coarse ones. Each set
  /// gives their ratio to the power of the same paths at the same points, times the power as it is known best.
  static double interference(const CellSums& sums) {
    const auto ratio = [](double power, double known) { return known > 0 ? power / known : 0; };
    const double coarse = ratio(sums.power, sums.all.power);
    const double both = ratio(sums.strong, sums.many.power) * sums.many.interference +
                        coarse * (sums.all.interference - sums.few.interference);
    // The two sets together may come out below −power, where the waves cancel; the coarse points alone cannot.
    return both > -sums.power ? both : coarse * sums.all.interference;
  }

  /// True if the fine points are no smooth quadrature: the cell is crossed, or a path without an edge ends inside it.
  bool broken(std::size_t cell, std::span<const Pair> pairs, std::span<const SubPoint> points) const {
    if (grid_.inside_fraction[cell] > 0) return true;
    std::uint64_t fine = 0;
    for (std::size_t i = 0; i < points.size(); ++i) fine |= std::uint64_t(points[i].weight > 0) << i;
    for (const Pair& pair : pairs)
      if (count_edges(discovered_.sequences[pair.sequence]) == 0 && (pair.visible & fine) != fine) return true;
    return false;
  }

  void store(std::size_t cell, std::span<const Pair> pairs, std::span<const SubPoint> points, double reference_delay) {
    double edge_points = 0, fine_points = 0;
    const auto dense_points = static_cast<double>(grid_.dense_of(cell).size());
    for (const SubPoint& point : points) edge_points += point.edge_weight > 0, fine_points += point.weight > 0;
    const bool fine_counts = broken(cell, pairs, points);
    const std::size_t cells = grid_.layout.size(), bands = plan_.bands();
    for (std::size_t m = 0; m < edge_model_count; ++m)
      map_.model_gain[(transmitter_ * edge_model_count + m) * cells + cell] = models_[m];
    for (std::size_t band = 0; band < bands; ++band) {
      CellSums& sums = sums_[band];
      sums.layers[static_cast<std::size_t>(Mechanism::interference)] = interference(sums);
      const std::size_t at = (transmitter_ * bands + band) * cells + cell;
      double gain = 0;
      for (std::size_t m = 0; m < mechanism_count; ++m) {
        map_.mechanism_gain[((transmitter_ * mechanism_count + m) * bands + band) * cells + cell] = sums.layers[m];
        gain += sums.layers[m];
      }
      const double passes = plan_.request.passes;
      double lone = 0, squares = 0;
      for (int i = 0; i < plan_.request.passes; ++i) lone += sums.lone[static_cast<std::size_t>(i)];
      for (int i = 0; i < plan_.request.passes; ++i) {
        const double off = sums.lone[static_cast<std::size_t>(i)] - lone / passes;
        squares += off * off;
      }
      // Of few points the spread itself is uncertain: 2 of these errors cover 95 % as Student's distribution has it.
      const auto spread = [](const PointSums& set, double n) {
        if (n < 1) return 0.0;
        constexpr double half_quantile[] = {6.35, 6.35, 2.15, 1.59, 1.39, 1.29, 1.22, 1.18, 1.15};
        const double student = n < 10 ? half_quantile[static_cast<std::size_t>(n) - 1] : 1.0;
        return student * student * std::max(0.0, set.square - set.mean * set.mean) / std::max(1.0, n - 1);
      };
      const double variance = spread(sums.coarse, edge_points) + spread(sums.dense, dense_points) +
                              (fine_counts ? spread(sums.fine, fine_points) : 0);
      map_.path_gain[at] = gain;
      map_.standard_error[at] = std::sqrt((passes - 1) / passes * squares + variance);
      map_.bias[at] = gain > 0 ? (passes - 1) / passes * std::min(1.0, lone / gain) : 0;  // a share as yet
      if (sums.power > 0) {
        const double mean = sums.delay / sums.power;
        map_.mean_delay[at] = reference_delay + mean;
        map_.rms_delay_spread[at] = std::sqrt(std::max(0.0, sums.delay2 / sums.power - mean * mean));
      }
    }
  }

  const Scene& scene_;
  const Plan& plan_;
  const double hair_;
  const std::size_t transmitter_;
  const CoverageGrid& grid_;
  const Discovered& discovered_;
  CoverageMap& map_;
  const double wavelength_;
  CompositeSum composite_;
  std::vector<CellSums> sums_;
  std::array<double, edge_model_count> models_{};  ///< power of diffraction at the first band
  std::vector<double> interference_, at_point_;
  std::vector<UnfoldedSequence> unfolded_;  ///< of the cell's pairs
  std::vector<std::uint32_t> sequences_;    ///< of the same
  std::vector<Arrival> arrivals_;           ///< at the point in hand; the first `arrived_` count
  std::size_t arrived_ = 0;
};

/// From the share g of each cell's gain that one pass alone found to the gain that none has found: g/(1 − g) of the
/// cell's gain, with its own share or the mean over the cells within `pooled_cells`, whichever is larger.
void estimate_missing(const GridLayout& layout, std::span<const double> gain, std::span<double> bias) {
  constexpr std::size_t pooled_cells = 5;
  constexpr double largest_share = 0.95;
  // Running sums along x, then y.
  const auto summed = [&](std::vector<double> values) {
    const auto along = [&](std::size_t lines, std::size_t line_step, std::size_t count, std::size_t step) {
      std::vector<double> before(count + 1);
      for (std::size_t line = 0; line < lines; ++line) {
        double* const first = values.data() + line * line_step;
        for (std::size_t i = 0; i < count; ++i) before[i + 1] = before[i] + first[i * step];
        for (std::size_t i = 0; i < count; ++i)
          first[i * step] = before[std::min(count, i + pooled_cells + 1)] - before[i - std::min(i, pooled_cells)];
      }
    };
    along(layout.ny, layout.nx, layout.nx, 1);
    along(layout.nx, 1, layout.ny, layout.nx);
    return values;
  };
  std::vector<double> shares(bias.begin(), bias.end()), reached(bias.size(), 0);
  for (std::size_t i = 0; i < bias.size(); ++i) {
    if (gain[i] > 0)
      reached[i] = 1;
    else
      shares[i] = 0;
  }
  const std::vector<double> share_sum = summed(shares), count = summed(reached);
  for (std::size_t i = 0; i < bias.size(); ++i) {
    if (!(gain[i] > 0)) continue;
    const double g = std::clamp(std::max(shares[i], share_sum[i] / count[i]), 0.0, largest_share);
    // Running sums leave a rounding error where all shares are 0.
    bias[i] = g > 1e-12 ? gain[i] * g / (1 - g) : 0;
  }
}

}  // namespace

CoverageMap empty_map(const Plan& plan, const CoverageGrid& grid) {
  const std::size_t cells = grid.layout.size(), transmitters = plan.request.transmitters.size(), bands = plan.bands();
  CoverageMap map;
  map.inside_fraction = grid.inside_fraction;
  const auto filled = [&](std::size_t repeats, double outdoors) {
    std::vector<double> values(repeats * cells, outdoors);
    for (std::size_t r = 0; r < repeats; ++r)
      for (std::size_t c = 0; c < cells; ++c)
        if (grid.of(c).empty()) values[r * cells + c] = not_a_number;
    return values;
  };
  map.path_gain = filled(transmitters * bands, 0);
  map.standard_error = map.path_gain;
  map.bias = map.path_gain;
  map.mechanism_gain = filled(transmitters * mechanism_count * bands, 0);
  map.model_gain = filled(transmitters * edge_model_count, 0);
  map.mean_delay = filled(transmitters * bands, not_a_number);
  map.rms_delay_spread = map.mean_delay;
  map.detection_limit = filled(transmitters, 0);
  return map;
}

void evaluate(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
              const CoverageGrid& grid, const Discovered& discovered, const std::vector<Pair>& pairs, CoverageMap& map,
              const std::function<void(double)>& progress, const std::atomic<bool>* stop) {
  const std::size_t cells = grid.layout.size();
  const unsigned threads = plan.request.threads ? plan.request.threads : hardware_threads();
  std::vector<std::size_t> begins(cells + 1, 0);
  for (const Pair& pair : pairs) ++begins[pair.cell + 1];
  for (std::size_t c = 0; c < cells; ++c) begins[c + 1] += begins[c];
  std::vector<CellEvaluator> evaluators;
  for (unsigned i = 0; i < threads; ++i)
    evaluators.emplace_back(scene, tracer, plan, transmitter, grid, discovered, map);
  constexpr std::size_t tile = 64;
  const std::size_t tiles = (cells + tile - 1) / tile;
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  for_each_block(
      tiles, threads,
      [&](std::size_t block, unsigned thread) {
        for (std::size_t cell = block * tile; cell < std::min(cells, (block + 1) * tile); ++cell)
          evaluators[thread].evaluate(cell, {pairs.data() + begins[cell], pairs.data() + begins[cell + 1]});
        const std::size_t now = ++done;
        if (progress && now % 64 == 0) {
          const std::lock_guard lock(reporting);
          progress(double(now) / double(tiles));
        }
      },
      stop);
  for (std::size_t band = 0; band < plan.bands(); ++band) {
    const std::size_t at = (transmitter * plan.bands() + band) * cells;
    estimate_missing(grid.layout, {map.path_gain.data() + at, cells}, {map.bias.data() + at, cells});
  }
  // Detection limit: geometry and the number of rays alone.
  const Vec3 source = plan.request.transmitters[transmitter].position;
  const double wavelength = 2 * pi / plan.wavenumber.front();
  const double unit = plan.request.kind == WaveKind::radio ? std::pow(wavelength / (4 * pi), 2) : 1 / (4 * pi);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (grid.of(cell).empty()) continue;
    const Vec3 way = grid.layout.centre(cell) - source;
    const double cosine = std::max(std::abs(way.z) / norm(way), 1e-3);
    map.detection_limit[transmitter * cells + cell] =
        3 * unit * 4 * pi / (plan.request.rays * grid.layout.cell * grid.layout.cell * cosine);
  }
}

void add_sampled_diffraction(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                             const CoverageGrid& grid, CoverageMap& map, const std::atomic<bool>* stop) {
  const std::size_t cells = grid.layout.size(), bands = plan.bands();
  for (std::size_t band = 0; band < bands; ++band) {
    const SampledLayer layer = sample_diffraction(scene, tracer, plan, transmitter, grid,
                                                  static_cast<std::uint64_t>(plan.request.rays), band, {}, stop);
    if (stop && *stop) return;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      if (grid.of(cell).empty()) continue;
      const std::size_t at = (transmitter * bands + band) * cells + cell;
      map.mechanism_gain[((transmitter * mechanism_count + diffraction_layer) * bands + band) * cells + cell] +=
          layer.gain[cell];
      if (band == 0)
        map.model_gain[(transmitter * edge_model_count + std::size_t(EdgeModel::published)) * cells + cell] +=
            layer.gain[cell];
      map.path_gain[at] += layer.gain[cell];
      map.standard_error[at] = std::hypot(map.standard_error[at], layer.standard_error[cell]);
    }
  }
}

}  // namespace grimaldi
