#pragma once
// Every path of at most two interactions between two points, by trying all faces and all edges. What it checks is the
// engine's search: which sequences there are. One given sequence is solved (fermat), asked for its shadow rays
// (connect) and evaluated (field) as the engine does it.

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/vector.h"
#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// A path that arrives.
struct ExhaustivePath {
  std::array<Interaction, 2> held{};
  std::size_t count = 0;
  PathGeometry geometry;
  std::span<const Interaction> interactions() const { return {held.data(), count}; }
};

/// Method: no ray is launched and nothing is left out by strength or distance. Faces: images of both ends; a pair is
/// passed over where the straight way misses a face's box. Edges: those of which an end sees a part, by the shadows
/// that all triangles cast on the edge from that end; all pairs of these. What is left is solved and asked for its
/// shadow rays.   Cost: P² + P (W_t + W_r) + W_t W_r tries for P patches and W_t, W_r edges in view of the ends.
class ExhaustiveSearch {
 public:
  /// `wavelength` m: up to where an edge's wave is kept beyond its ends.
  ExhaustiveSearch(const Scene& scene, const Tracer& tracer, const Vec3& transmitter, double wavelength);

  /// All of them, the direct one first.
  std::vector<ExhaustivePath> paths_to(const Vec3& receiver) const;

  /// The wedges of which `eye` sees a part, ascending.
  std::vector<std::uint32_t> edges_in_view(const Vec3& eye) const;

 private:
  std::vector<Vec3> images_of(const Vec3& point) const;

  const Scene& scene_;
  const Tracer& tracer_;
  const Vec3 transmitter_;
  const double wavelength_;
  std::vector<Vec3> transmitter_images_;         ///< per patch
  std::vector<std::uint32_t> transmitter_view_;  ///< wedges
};

/// The engine's paths of at most two interactions against the search, over many receivers.
struct ExhaustiveComparison {
  struct Class {
    std::string name;                ///< D, R, RR, E, RE, ER, EE: R a face, E an edge, from the transmitter on
    std::vector<double> difference;  ///< per receiver where the search has such a path: engine less search, dB;
                                     ///< −100 where the engine has none
    std::size_t engine_paths = 0, all_paths = 0;
  };
  std::vector<Class> classes;
  std::vector<double> share;  ///< per receiver reached: power of the engine's paths over that of all
  std::vector<double> delay;  ///< of the strongest path, engine less search, s
  std::vector<Vec3> places;   ///< of these receivers
};

/// Runs the engine for `request` (one transmitter, one band; depth 2) and the search for its receivers. Powers are sums
/// over the paths, both polarisations, without cross terms. Throws InputErrors for what make_plan refuses.
ExhaustiveComparison compare_with_exhaustive_search(const Scene& scene, PlanDescription request);

/// `count` points 1.5 m above the ground, outside all solids, within |x − centre|, |y − centre| < `half` m of (0, 0);
/// the same for the same seed.
std::vector<Vec3> street_points(const Scene& scene, double half, std::size_t count, std::uint64_t seed);

}  // namespace grimaldi
