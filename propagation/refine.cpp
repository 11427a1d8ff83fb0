#include "propagation/refine.h"

#include <algorithm>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/connect.h"
#include "propagation/effort.h"
#include "propagation/fermat.h"

namespace grimaldi {
namespace {

constexpr double strong_next_door = 0.2;
constexpr std::size_t cells_per_block = 64;

/// What a block of cells adds.
struct Added {
  std::vector<Pair> pairs;
  std::uint64_t shadow_rays = 0;
};

class Refiner {
 public:
  Refiner(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, const CoverageGrid& grid,
          const Discovered& discovered, Grown& grown)
      : scene_(scene),
        tracer_(tracer),
        small_objects_(plan.small_objects),
        source_(plan.request.transmitters[transmitter].position),
        wavelength_(2 * pi / plan.wavenumber.front()),
        strong_share_(effort_of(plan.request).strong_share),
        grid_(grid),
        discovered_(discovered),
        grown_(grown),
        begins_(grid.layout.size() + 1, 0),
        has_edge_(discovered.sequences.size()) {
    for (const Pair& pair : grown.pairs) ++begins_[pair.cell + 1];
    for (std::size_t c = 0; c < grid.layout.size(); ++c) begins_[c + 1] += begins_[c];
    for (std::size_t s = 0; s < has_edge_.size(); ++s) has_edge_[s] = count_edges(discovered.sequences[s]) > 0;
  }

  void cell(std::uint32_t cell, PathGeometry& geometry, Added& added) {
    if (grid_.dense_of(cell).empty()) return;
    const double power = grown_.known[cell];
    for (std::size_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
      Pair& pair = grown_.pairs[i];
      if (pair.power < strong_share_ * power) continue;
      pair.refined = has_edge_[pair.sequence];
      pair.dense = ask(cell, pair.sequence, geometry, added.shadow_rays);
    }
    const std::size_t first_added = added.pairs.size();
    grid_.layout.each_near(cell, [&](std::size_t neighbour) {
      if (neighbour == cell) return;
      for (std::size_t i = begins_[neighbour]; i < begins_[neighbour + 1]; ++i) {
        const Pair& pair = grown_.pairs[i];
        if (!has_edge_[pair.sequence] || pair.power < strong_next_door * power) continue;
        const Pair wanted{cell, pair.sequence, 0, pair.passes, pair.power};
        if (std::binary_search(grown_.pairs.data() + begins_[cell], grown_.pairs.data() + begins_[cell + 1], wanted,
                               comes_before))
          continue;
        const auto same = [&](const Pair& p) { return p.sequence == pair.sequence; };
        if (std::any_of(added.pairs.begin() + std::ptrdiff_t(first_added), added.pairs.end(), same)) continue;
        added.pairs.push_back(wanted);
        added.pairs.back().refined = true;
        added.pairs.back().dense = ask(cell, pair.sequence, geometry, added.shadow_rays);
      }
    });
    added.pairs.erase(std::remove_if(added.pairs.begin() + std::ptrdiff_t(first_added), added.pairs.end(),
                                     [](const Pair& pair) { return pair.dense == 0; }),
                      added.pairs.end());
  }

 private:
  std::uint64_t ask(std::uint32_t cell, std::uint32_t sequence, PathGeometry& geometry,
                    std::uint64_t& shadow_rays) const {
    const auto interactions = discovered_.sequences[sequence];
    const auto points = grid_.dense_of(cell);
    const Vec3 centre = grid_.layout.centre(cell);
    UnfoldedSequence unfolded(scene_, source_, interactions, &small_objects_);
    std::uint64_t arrives = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (unfolded.solve(centre + points[i].offset, wavelength_, geometry) &&
          connected(scene_, tracer_, interactions, geometry, shadow_rays))
        arrives |= std::uint64_t(1) << i;
    return arrives;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const SmallObjects& small_objects_;
  const Vec3 source_;
  const double wavelength_, strong_share_;
  const CoverageGrid& grid_;
  const Discovered& discovered_;
  Grown& grown_;
  std::vector<std::size_t> begins_;
  std::vector<std::uint8_t> has_edge_;
};

}  // namespace

void refine(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
            const CoverageGrid& grid, const Discovered& discovered, Grown& grown, const std::atomic<bool>* stop) {
  if (grid.dense_ranges.empty() || grown.pairs.empty()) return;
  Refiner refiner(scene, tracer, plan, transmitter, grid, discovered, grown);
  const unsigned threads = plan.request.threads ? plan.request.threads : hardware_threads();
  const std::size_t cells = grid.layout.size(), blocks = (cells + cells_per_block - 1) / cells_per_block;
  std::vector<PathGeometry> geometry(threads);
  std::vector<Added> added(blocks);
  for_each_block(
      blocks, threads,
      [&](std::size_t block, unsigned thread) {
        for (std::size_t cell = block * cells_per_block; cell < std::min(cells, (block + 1) * cells_per_block); ++cell)
          refiner.cell(static_cast<std::uint32_t>(cell), geometry[thread], added[block]);
      },
      stop);
  for (const Added& block : added) {
    grown.pairs.insert(grown.pairs.end(), block.pairs.begin(), block.pairs.end());
    grown.shadow_rays += block.shadow_rays;
  }
  std::sort(grown.pairs.begin(), grown.pairs.end(), comes_before);
}

}  // namespace grimaldi
