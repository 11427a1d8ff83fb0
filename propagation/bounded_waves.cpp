#include "propagation/bounded_waves.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/connect.h"
#include "propagation/edge_chain.h"
#include "propagation/fermat.h"
#include "propagation/field.h"

namespace grimaldi {
namespace {

constexpr double nearby = 1.5;  ///< v
constexpr double strong_at_a_point = 1e-3, strong_in_a_cell = 1e-2;
constexpr std::size_t cells_per_block = 64;

}  // namespace

void each_bounded_wave(const Scene& scene, const Plan& plan, std::span<const Interaction> interactions,
                       const PathGeometry& geometry, const std::function<void(std::span<const Interaction>)>& act) {
  const double longest = 2 * pi / plan.wavenumber.front();
  std::vector<Interaction> bounded;
  const EdgePlaces places(interactions);
  for (std::size_t e = 0; e < geometry.edge_count; ++e) {
    const EdgePassage& passage = geometry.edges[e];
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    for (const auto& [boundary, face] : BoundedWaves(wedge, plan.request.reflection)) {
      if (is_dark(wedge, passage, beyond_boundary(wedge, passage, boundary)) ||
          boundary_parameter(scene, passage, boundary, longest) > nearby)
        continue;
      bounded.assign(interactions.begin(), interactions.end());
      const auto at = bounded.begin() + static_cast<std::ptrdiff_t>(places[e]);
      if (face == no_interaction)
        bounded.erase(at);
      else
        *at = face;
      const auto reflections = static_cast<int>(bounded.size() - count_edges(bounded));
      if (reflections <= plan.request.max_reflections) act(bounded);
    }
  }
}

SequenceTable bounded_waves(const Scene& scene, const Plan& plan, std::span<const Arrival> arrivals,
                            const std::function<bool(SequenceHash)>& known) {
  double power = 0;
  for (const Arrival& arrival : arrivals) power += received_power(arrival.field[0], Polarisation::both);
  SequenceTable found;
  for (const Arrival& arrival : arrivals) {
    if (received_power(arrival.field[0], Polarisation::both) < strong_at_a_point * power) continue;
    each_bounded_wave(scene, plan, arrival.interactions, arrival.geometry, [&](std::span<const Interaction> bounded) {
      const SequenceHash name = hash_of(bounded);
      if (!known(name)) found.enter(name, bounded);
    });
  }
  return found;
}

void add_bounded_waves(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                       const CoverageGrid& grid, Discovered& discovered, Grown& grown, const std::atomic<bool>* stop) {
  if (grid.dense_ranges.empty()) return;
  const std::size_t cells = grid.layout.size(), blocks = (cells + cells_per_block - 1) / cells_per_block;
  const Vec3& source = plan.request.transmitters[transmitter].position;
  const double wavelength = 2 * pi / plan.wavenumber.front();
  std::vector<std::size_t> begins(cells + 1, 0);
  for (const Pair& pair : grown.pairs) ++begins[pair.cell + 1];
  for (std::size_t c = 0; c < cells; ++c) begins[c + 1] += begins[c];
  /// A wave asked for in one cell.
  struct Wanted {
    Pair pair;
    int blocked = 0;  ///< points at which something stood in its way
  };
  struct Found {
    SequenceTable sequences;
    std::vector<Pair> pairs;
    std::uint64_t shadow_rays = 0;
  };
  std::vector<Found> found(blocks);
  const auto search = [&](std::uint32_t cell, Found& here) {
    const std::span<const Pair> pairs(grown.pairs.data() + begins[cell], grown.pairs.data() + begins[cell + 1]);
    const auto known = [&](SequenceHash name) {
      const Pair wanted{cell, discovered.sequences.find(name), 0, 0, 0};
      return wanted.sequence != SequenceTable::no_sequence &&
             std::binary_search(pairs.begin(), pairs.end(), wanted, comes_before);
    };
    std::vector<Wanted> waves;
    PathGeometry geometry, bounded_geometry;
    const auto ask = [&](const Pair& pair, std::span<const Interaction> bounded, std::size_t point) {
      const SequenceHash name = hash_of(bounded);
      if (bounded.empty() || known(name)) return;
      const std::uint32_t sequence = here.sequences.enter(name, bounded);
      auto wave =
          std::find_if(waves.begin(), waves.end(), [&](const Wanted& w) { return w.pair.sequence == sequence; });
      if (wave == waves.end()) wave = waves.insert(waves.end(), {{cell, sequence, 0, pair.passes, 0, 0, true}});
      const std::uint64_t bit = std::uint64_t(1) << point;
      if ((wave->pair.dense & bit) != 0 || (wave->pair.dense == 0 && wave->blocked == 2)) return;
      UnfoldedSequence unfolded(scene, source, bounded, &plan.small_objects);
      const Vec3 place = grid.layout.centre(cell) + grid.dense_of(cell)[point].offset;
      if (!unfolded.solve(place, wavelength, bounded_geometry)) return;
      if (connected(scene, tracer, bounded, bounded_geometry, here.shadow_rays))
        wave->pair.dense |= bit;
      else
        ++wave->blocked;
    };
    for (const Pair& pair : pairs) {
      if (!pair.refined || !(pair.power > strong_in_a_cell * grown.known[cell])) continue;
      const auto interactions = discovered.sequences[pair.sequence];
      UnfoldedSequence unfolded(scene, source, interactions, &plan.small_objects);
      for (std::uint64_t left = pair.dense; left != 0; left &= left - 1) {
        const auto point = static_cast<std::size_t>(std::countr_zero(left));
        if (!unfolded.solve(grid.layout.centre(cell) + grid.dense_of(cell)[point].offset, wavelength, geometry))
          continue;
        each_bounded_wave(scene, plan, interactions, geometry,
                          [&](std::span<const Interaction> bounded) { ask(pair, bounded, point); });
      }
    }
    for (const Wanted& wave : waves)
      if (wave.pair.dense != 0) here.pairs.push_back(wave.pair);
  };
  for_each_block(
      blocks, plan.request.threads,
      [&](std::size_t block, unsigned) {
        for (std::size_t cell = block * cells_per_block; cell < std::min(cells, (block + 1) * cells_per_block); ++cell)
          search(static_cast<std::uint32_t>(cell), found[block]);
      },
      stop);
  for (const Found& block : found) {
    grown.shadow_rays += block.shadow_rays;
    for (Pair pair : block.pairs) {
      pair.sequence = discovered.sequences.enter(block.sequences.hash(pair.sequence), block.sequences[pair.sequence]);
      grown.pairs.push_back(pair);
    }
  }
  std::sort(grown.pairs.begin(), grown.pairs.end(), comes_before);
}

}  // namespace grimaldi
