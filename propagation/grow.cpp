#include "propagation/grow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/composite.h"
#include "propagation/connect.h"
#include "propagation/effort.h"
#include "propagation/fermat.h"
#include "propagation/object_wave.h"

namespace grimaldi {
namespace {

constexpr std::size_t cells_per_block = 1024;

/// What one thread keeps from sequence to sequence.
struct Workspace {
  std::vector<std::uint32_t> visited;  ///< per cell: number of the growth that visited it last
  std::uint32_t growth = 0;
  std::vector<std::uint32_t> frontier;
  PathGeometry geometry;
  std::vector<std::array<std::complex<double>, 2>> field;
};

struct BlockPairs {
  std::vector<Pair> pairs;
  std::vector<BlockedPath> blocked;
  std::uint64_t shadow_rays = 0;
};

class Grower {
 public:
  Grower(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, const CoverageGrid& grid,
         const Effort& effort, const Discovered& discovered, const std::vector<double>& known)
      : scene_(scene),
        tracer_(tracer),
        plan_(plan),
        transmitter_(plan.request.transmitters[transmitter]),
        grid_(grid),
        discovered_(discovered),
        known_(known),
        wavelength_(2 * pi / plan.wavenumber.front()),
        negligible_share_(effort.negligible_share) {}

  /// One sequence from its seeds [first, last).
  void grow(std::uint32_t sequence, const Seed* first, const Seed* last, Workspace& work, BlockPairs& out) const {
    const auto interactions = discovered_.sequences[sequence];
    UnfoldedSequence unfolded(scene_, transmitter_.position, interactions, &plan_.small_objects);
    if (!unfolded.possible()) return;
    if (work.visited.empty()) work.visited.assign(grid_.layout.size(), 0);
    ++work.growth;
    std::vector<Seed> more;
    if (count_edges(interactions) == 0 && may_be_led_around(interactions)) {
      std::uint32_t passes = 0;
      for (const Seed* seed = first; seed != last; ++seed) passes |= seed->passes;
      more.assign(first, last);
      cells_of_its_mirrors(sequence, work, more);
      for (Seed& seed : more) seed.passes = passes;
      std::stable_sort(more.begin(), more.end(), [](const Seed& a, const Seed& b) { return a.cell < b.cell; });
      first = more.data();
      last = first + more.size();
    }
    for (const Seed* seed = first; seed != last; ++seed) {
      if (work.visited[seed->cell] == work.growth) continue;
      const std::size_t begin = out.pairs.size();
      std::uint32_t passes = 0;
      work.frontier.assign(1, seed->cell);
      work.visited[seed->cell] = work.growth;
      while (!work.frontier.empty()) {
        const std::uint32_t cell = work.frontier.back();
        work.frontier.pop_back();
        Pair pair{cell, sequence, 0, 0, 0};
        const Answer answer = arrive(unfolded, interactions, work, pair, out);
        const bool arrives = answer == Answer::arrives;
        const Seed* here =
            std::lower_bound(seed, last, cell, [](const Seed& s, std::uint32_t c) { return s.cell < c; });
        // A seed at whose cell nothing arrives (a sliver between the sub-points) still lets its neighbours be asked.
        const bool is_seed = here != last && here->cell == cell;
        if (!arrives && !(is_seed && here->crossed && answer == Answer::blocked)) continue;
        if (arrives) out.pairs.push_back(pair);
        if (is_seed) passes |= here->passes;
        ask_neighbours(cell, work);
      }
      for (std::size_t i = begin; i < out.pairs.size(); ++i) out.pairs[i].passes = passes;
    }
  }

  /// Cells, one in each tile of 3 × 3, that a sequence of faces alone would reach if nothing stood in the way.
  void cells_of_its_mirrors(std::uint32_t sequence, Workspace& work, std::vector<Seed>& seeds) const {
    UnfoldedSequence unfolded(scene_, transmitter_.position, discovered_.sequences[sequence], &plan_.small_objects);
    for (std::size_t y = 1; y < grid_.layout.ny; y += 3)
      for (std::size_t x = 1; x < grid_.layout.nx; x += 3) {
        const std::size_t cell = y * grid_.layout.nx + x;
        if (grid_.of(cell).empty()) continue;
        if (unfolded.solve(grid_.layout.centre(cell), wavelength_, work.geometry))
          seeds.push_back({sequence, static_cast<std::uint32_t>(cell), 0, false, 0});
      }
  }

  /// The direct wave in one cell.
  void direct(std::uint32_t cell, Workspace& work, BlockPairs& out) const {
    UnfoldedSequence unfolded(scene_, transmitter_.position, {});
    Pair pair{cell, 0, 0, ~0u, 0};
    if (arrive(unfolded, {}, work, pair, out) == Answer::arrives) out.pairs.push_back(pair);
  }

  /// True if one of every ninth of the cell's points (or of fewer points all) sees the transmitter.
  bool sees_transmitter(std::uint32_t cell, BlockPairs& out) const {
    const auto points = grid_.of(cell);
    const Vec3 centre = grid_.layout.centre(cell);
    const std::size_t step = points.size() < 9 ? 1 : 9;
    for (std::size_t i = step / 2; i < points.size(); i += step) {
      ++out.shadow_rays;
      if (tracer_.visible(transmitter_.position, centre + points[i].offset)) return true;
    }
    return false;
  }

  /// A cell that does not see the transmitter.
  void direct_blocked(std::uint32_t cell, BlockPairs& out) const {
    const auto points = grid_.of(cell);
    if (!points.empty() && may_be_led_around({}))
      out.blocked.push_back(blocked_path({cell, 0, 0, ~0u, 0}, 0, points.size() / 2));
  }

 private:
  enum class Answer { arrives, blocked, negligible };

  bool may_be_led_around(std::span<const Interaction> interactions) const {
    return static_cast<int>(interactions.size()) < plan_.request.depth &&
           static_cast<int>(count_edges(interactions)) < most_edges(plan_.request);
  }

  static BlockedPath blocked_path(const Pair& pair, std::size_t leg, std::size_t point) {
    return {pair.sequence, pair.cell, static_cast<std::uint8_t>(leg), static_cast<std::uint8_t>(point)};
  }

  Answer arrive(UnfoldedSequence& unfolded, std::span<const Interaction> interactions, Workspace& work, Pair& pair,
                BlockPairs& out) const {
    const auto points = grid_.of(pair.cell);
    const Vec3 centre = grid_.layout.centre(pair.cell);
    work.field.resize(plan_.bands());
    const bool edges = count_edges(interactions) > 0;
    const double threshold = edges && interactions.size() >= 2 ? negligible_share_ * known_[pair.cell] : 0;
    bool lead_around = may_be_led_around(interactions);
    double power = 0, strength = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (edges && points[i].edge_weight == 0) continue;
      if (!unfolded.solve(centre + points[i].offset, wavelength_, work.geometry)) continue;
      if (threshold > 0 && power_bound(scene_, plan_, interactions, work.geometry) < threshold) {
        // The bound is smooth: one point speaks for the cell.
        if (pair.visible == 0) return Answer::negligible;
        break;
      }
      if (const auto leg = blocked_leg(scene_, tracer_, interactions, work.geometry, out.shadow_rays)) {
        // One point's way around serves the cell.
        if (lead_around) out.blocked.push_back(blocked_path(pair, *leg, i));
        lead_around = false;
        continue;
      }
      if (pair.visible == 0) {
        // The strength at the first point that sees the path speaks for the cell; `evaluate` takes every point for
        // itself.
        arrival_field(scene_, plan_, transmitter_, interactions, work.geometry, true, 1, work.field);
        strength = received_power(work.field[0], Polarisation::both);
        if (strength < threshold) return Answer::negligible;
      }
      pair.visible |= std::uint64_t(1) << i;
      power += (edges ? points[i].edge_weight : points[i].weight) * strength;
    }
    pair.power = static_cast<float>(power);
    return pair.visible != 0 ? Answer::arrives : Answer::blocked;
  }

  void ask_neighbours(std::uint32_t cell, Workspace& work) const {
    grid_.layout.each_near(cell, [&](std::size_t neighbour) {
      if (work.visited[neighbour] == work.growth) return;
      work.visited[neighbour] = work.growth;
      work.frontier.push_back(static_cast<std::uint32_t>(neighbour));
    });
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Plan& plan_;
  const Transmitter& transmitter_;
  const CoverageGrid& grid_;
  const Discovered& discovered_;
  const std::vector<double>& known_;
  const double wavelength_, negligible_share_;
};

/// Runs work(block, workspace, pairs) over blocks and appends what they found in the order of the blocks.
template <typename Work>
void in_blocks(std::size_t blocks, unsigned threads, std::vector<Workspace>& spaces, const std::atomic<bool>* stop,
               Grown& grown, const Work& work) {
  std::vector<BlockPairs> found(blocks);
  for_each_block(
      blocks, threads, [&](std::size_t block, unsigned thread) { work(block, spaces[thread], found[block]); }, stop);
  for (const BlockPairs& block : found) {
    grown.pairs.insert(grown.pairs.end(), block.pairs.begin(), block.pairs.end());
    grown.blocked.insert(grown.blocked.end(), block.blocked.begin(), block.blocked.end());
    grown.shadow_rays += block.shadow_rays;
  }
}

/// The cells marked and the eight around each.
std::vector<std::uint8_t> with_neighbours(const std::vector<std::uint8_t>& marked, const GridLayout& layout) {
  std::vector<std::uint8_t> all(marked.size(), 0);
  for (std::size_t cell = 0; cell < marked.size(); ++cell)
    if (marked[cell]) layout.each_near(cell, [&](std::size_t near) { all[near] = 1; });
  return all;
}

/// The seeds [first, last) of one sequence, and how strong the beams take it to be: in steps of 10 dB, 0 the strongest.
struct SeededSequence {
  std::size_t first, last;
  int stage;
};

/// All sequences with seeds, strongest stage first, else in their order.
std::vector<SeededSequence> seeded_sequences(const std::vector<Seed>& seeds) {
  std::vector<SeededSequence> found;
  for (std::size_t first = 0, last = 0; first < seeds.size(); first = last) {
    float gain = 0;
    for (; last < seeds.size() && seeds[last].sequence == seeds[first].sequence; ++last)
      gain = std::max(gain, seeds[last].gain);
    found.push_back({first, last, static_cast<int>(-std::log10(std::min(gain, 1.0f)))});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.stage < b.stage; });
  return found;
}

/// The seeds from number `first` on without those whose pairs there are: these pairs were found by their passes too.
std::vector<Seed> unasked(const std::vector<Seed>& seeds, std::size_t first, std::vector<Pair>& pairs) {
  std::vector<Seed> left;
  for (std::size_t i = first; i < seeds.size(); ++i) {
    const Pair wanted{seeds[i].cell, seeds[i].sequence, 0, 0, 0};
    const auto there = std::lower_bound(pairs.begin(), pairs.end(), wanted, comes_before);
    if (there != pairs.end() && !comes_before(wanted, *there))
      there->passes |= seeds[i].passes;
    else
      left.push_back(seeds[i]);
  }
  return left;
}

}  // namespace

void grow(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, const CoverageGrid& grid,
          const Effort& effort, const Discovered& discovered, std::size_t first_seed, Grown& grown,
          const std::function<void(double)>& progress, const std::atomic<bool>* stop) {
  const unsigned threads = plan.request.threads ? plan.request.threads : hardware_threads();
  grown.blocked.clear();
  const bool first_growth = grown.known.empty();
  grown.known.resize(grid.layout.size(), 0);
  std::vector<double>& known = grown.known;
  const Grower grower(scene, tracer, plan, transmitter, grid, effort, discovered, known);
  std::vector<Workspace> spaces(threads);
  const auto learn = [&](std::size_t from) {
    for (std::size_t i = from; i < grown.pairs.size(); ++i) known[grown.pairs[i].cell] += grown.pairs[i].power;
  };
  if (first_growth) {
    // A few points of each cell first; all of them where one of those, or a neighbour's, sees the transmitter.
    const std::size_t cells = grid.layout.size(), blocks = (cells + cells_per_block - 1) / cells_per_block;
    std::vector<std::uint8_t> near(cells, 0);
    const auto each_cell = [&](const auto& act) {
      in_blocks(blocks, threads, spaces, stop, grown, [&](std::size_t block, Workspace& work, BlockPairs& out) {
        for (std::size_t cell = block * cells_per_block; cell < std::min(cells, (block + 1) * cells_per_block); ++cell)
          act(static_cast<std::uint32_t>(cell), work, out);
      });
    };
    each_cell(
        [&](std::uint32_t cell, Workspace&, BlockPairs& out) { near[cell] = grower.sees_transmitter(cell, out); });
    near = with_neighbours(near, grid.layout);
    each_cell([&](std::uint32_t cell, Workspace& work, BlockPairs& out) {
      if (!near[cell])
        grower.direct_blocked(cell, out);
      else if (plan.request.direct)
        grower.direct(cell, work, out);
    });
    learn(0);
  }
  const std::vector<Seed> seeds = unasked(discovered.seeds, first_seed, grown.pairs);
  std::vector<SeededSequence> found = seeded_sequences(seeds);
  for (std::size_t begin = 0, end = 0; begin < found.size() && !(stop && *stop); begin = end) {
    while (end < found.size() && found[end].stage == found[begin].stage) ++end;
    const std::size_t before = grown.pairs.size();
    constexpr std::size_t sequences_per_block = 16;
    in_blocks((end - begin + sequences_per_block - 1) / sequences_per_block, threads, spaces, stop, grown,
              [&](std::size_t block, Workspace& work, BlockPairs& out) {
                const std::size_t first = begin + block * sequences_per_block;
                for (std::size_t i = first; i < std::min(end, first + sequences_per_block); ++i)
                  grower.grow(seeds[found[i].first].sequence, seeds.data() + found[i].first,
                              seeds.data() + found[i].last, work, out);
              });
    learn(before);
    if (progress) progress(double(end) / double(found.size()));
  }
  std::sort(grown.pairs.begin(), grown.pairs.end(), comes_before);
  // A sequence grown again, from another cell, may meet cells that it had reached.
  auto last = grown.pairs.begin();
  for (const Pair& pair : grown.pairs)
    if (last != grown.pairs.begin() && !comes_before(last[-1], pair))
      last[-1].passes |= pair.passes;
    else
      *last++ = pair;
  grown.pairs.erase(last, grown.pairs.end());
}

}  // namespace grimaldi
