#pragma once
// Paths between two points from what each of the two sees: what one end finds, the other finds too.

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "propagation/edge_shadow.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// What one end of paths sees: edges, and faces as mirrors.
class EndView {
 public:
  struct Edge {
    std::uint32_t wedge;
    EdgeShadow shadow;  ///< what is known to be dark; the rest may be in view
  };
  struct Mirror {
    Vec3 image;                        ///< of the end
    std::vector<Interaction> patches;  ///< in the order from the end
  };

  /// Edges: all that are not wholly dark; rays to each find the triangles whose shadows cover it, until they do or what
  /// is left of it has been looked at. Faces: those that beams meet which reflect up to `most_faces` times (0: none),
  /// one to the middle of each triangle and `beams` in all directions. Shadow rays and segments are added to `rays`.
  EndView(const Scene& scene, const Tracer& tracer, const Vec3& eye, int most_faces, std::uint64_t beams,
          std::uint64_t& rays);

  const Vec3& eye() const { return eye_; }
  const std::vector<Edge>& edges() const { return edges_; }
  /// The edge of that wedge, or null.
  const Edge* edge_of(std::uint32_t wedge) const;
  const std::vector<Mirror>& mirrors() const { return mirrors_; }

 private:
  void look_for_edges(const Scene& scene, const Tracer& tracer, std::uint64_t& rays);
  void look_for_faces(const Scene& scene, const Tracer& tracer, int most_faces, std::uint64_t beams,
                      std::uint64_t& rays);
  const Vec3 eye_;
  std::vector<Edge> edges_;  ///< ascending by wedge
  std::vector<Mirror> mirrors_;
};

/// The view from an end of the paths of a plan.
EndView view_from(const Scene& scene, const Tracer& tracer, const Plan& plan, const Vec3& eye, std::uint64_t& rays);

/// Adds to `sequences` those that neither they nor `known` have, of an edge in view of both ends, of mirrors of one end
/// and an edge in view of the other, of an edge in view of either end, and of mirrors of one end and two edges of one
/// face where an edge in view of the other hides the image by its own solid, and returns their numbers. All of these
/// are solved and asked as `add_strongest` does; `power` is what is known and grows by what is found. Exchange of the
/// ends changes only which mirrors the beams met.
std::vector<std::uint32_t> add_from_both_ends(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                              std::size_t transmitter, const EndView& from_transmitter,
                                              const EndView& from_receiver, double& power, const SequenceTable& known,
                                              SequenceTable& sequences, std::uint64_t& shadow_rays,
                                              const std::atomic<bool>* stop);

}  // namespace grimaldi
