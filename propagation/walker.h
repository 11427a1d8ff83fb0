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

 private:
  class Walk;
  std::unique_ptr<Walk> walk_;
};

}  // namespace grimaldi
