#pragma once
// Beams aimed at pairs: from each edge that the transmitter sees to every face and edge, through each face to every
// edge.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "propagation/both_ends.h"
#include "propagation/plan.h"
#include "propagation/walker.h"

namespace grimaldi {

/// What launched beams meet by chance, and miss where one of the two is narrow or far, these ask for by name: a path
/// over an edge and a face is one of few in many cells of a street.
///
/// Method: one point of each triangle (of each wedge) is tried against each edge in view of the transmitter: the beam
/// leaves where the shortest way to the point passes the edge, if that is a place in view. Likewise one point of each
/// wedge against each face in view: the beam meets the face where the image shows the point. What leaves then goes on
/// as every beam does. With 1.25e5 rays and more every pair is asked, in round(rays/1e6) rounds with other points; with
/// fewer rays as many in proportion.
class AimedPairs {
 public:
  /// Of all pairs every `stride`-th is asked. Shadow rays of the transmitter's view are added to `rays`.
  AimedPairs(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, std::uint64_t stride,
             std::uint64_t& rays);

  /// Of all pairs, whether each is asked: then what they find is no matter of chance.
  bool all() const { return stride_ == 1; }

  /// The beams are dealt to blocks by their first edge or face.
  std::size_t blocks() const { return view_.edges().size() + view_.mirrors().size(); }
  void walk_block(std::size_t block, Walker& walker) const;

  /// A number of the block's edge or face that the others in view do not change.
  std::uint64_t row_of(std::size_t block, std::uint64_t round = 0) const;

 private:
  void walk_edge(std::size_t number, Walker& walker) const;
  void walk_mirror(std::size_t number, Walker& walker) const;

  const Scene& scene_;
  const Vec3 source_;
  const bool second_edges_;
  const std::uint64_t rounds_, stride_;
  const EndView view_;
};

}  // namespace grimaldi
