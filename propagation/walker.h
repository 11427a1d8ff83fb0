#pragma once
// One thread's beams: each is taken from birth to death, with all that leaves the edges that it meets.

#include <cstdint>
#include <memory>
#include <vector>

#include "propagation/discover.h"
#include "propagation/face_reflection.h"
#include "propagation/patch_rims.h"
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

  /// A beam from `origin` over the wedge, `along` m from its start, towards `target` (a point on its Keller cone).
  void walk_over_edge(const Vec3& origin, std::uint32_t wedge_index, double along, const Vec3& target,
                      std::uint64_t beam_number);

  /// The same towards a point of another wedge, at the share of its length: what leaves that one.
  void walk_to_second_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint32_t second,
                           double share, std::uint64_t beam_number);

  /// A beam from `origin` by the patch to the wedge, at the share of its length: what leaves the wedge.
  void walk_by_mirror(const Vec3& origin, std::uint32_t patch, std::uint32_t wedge_index, double share,
                      std::uint64_t beam_number);

 private:
  class Walk;
  std::unique_ptr<Walk> walk_;
};

}  // namespace grimaldi
