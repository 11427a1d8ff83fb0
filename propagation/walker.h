#pragma once
// One thread's beams: each is taken from birth to death, with all that leaves the edges that it meets.

#include <cstdint>
#include <memory>
#include <vector>

#include "propagation/discover.h"
#include "propagation/face_reflection.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// What one block of beams found; distinct within the block.
struct BlockRecords {
  SequenceTable sequences;
  std::vector<Seed> seeds;  ///< sequences numbered within the block
  FluxLedger flux;
  std::uint64_t segments = 0;
};

/// Wedges at the rims of each patch.
struct PatchRims {
  std::vector<std::uint32_t> begins, wedges;
  explicit PatchRims(const Scene& scene) : begins(scene.patches.patches.size() + 1, 0) {
    const auto each = [&](auto&& act) {
      for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
        const Wedge& wedge = scene.wedges.wedges[w];
        act(wedge.patch0, w);
        if (wedge.patchn != wedge.patch0) act(wedge.patchn, w);
      }
    };
    each([&](std::uint32_t patch, std::uint32_t) { ++begins[patch + 1]; });
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    wedges.resize(begins.back());
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    each([&](std::uint32_t patch, std::uint32_t w) { wedges[next[patch]++] = w; });
  }
  /// The wedge of `patch` that the number u in [0, 1) names; no_index if it has none.
  std::uint32_t pick(std::uint32_t patch, double u) const {
    const std::uint32_t count = begins[patch + 1] - begins[patch];
    return count == 0 ? no_index : wedges[begins[patch] + static_cast<std::uint32_t>(u * count)];
  }
};

/// Walks beams and leaves records of what they met; the rules are those of `discover`. One thread uses one walker.
class Walker {
 public:
  Walker(const Scene& scene, const Tracer& tracer, const Plan& plan, const Search& search,
         const ReflectanceTable& reflectance, const PatchRims& rims);
  ~Walker();
  Walker(Walker&&) noexcept;

  /// From now on records go to `records`; `spacing` of the pass's beams, rad.
  void begin_block(double spacing, BlockRecords& records);

  /// One launched beam with all that grows out of it. `beam_number` names its random numbers.
  void walk(const Vec3& origin, const Vec3& direction, std::uint64_t beam_number);

  /// A beam aimed at the wedge, at the share `along` of its length, straight from the transmitter.
  void walk_to_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint64_t beam_number);

 private:
  class Walk;
  std::unique_ptr<Walk> walk_;
};

}  // namespace grimaldi
