#pragma once
// Where sampled power starts: edges as the transmitter and its images shine on them, and a point drawn on one.

#include <cstdint>
#include <vector>

#include "propagation/laws/edge_sampling.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The transmitter or its image in one patch after the other.
struct Lamp {
  Vec3 position;
  std::vector<std::uint32_t> patches;  ///< in the order of the wave
  std::vector<Vec3> images;            ///< transmitter, its image in the first patch …; the last is `position`
};

/// One wedge as one lamp shines on it.
struct LitEdge {
  std::uint32_t lamp, wedge;
  EdgeSector sector;
  double axial, radial;         ///< of the lamp in the wedge's frame, m from its start
  double angle_from, angle_to;  ///< atan((t − axial)/radial) at the ends of the sampled part
  double probability, cumulative;
};

/// A point of an edge's line and how the lamp reaches it.
struct EdgePoint {
  double along = 0;  ///< m from the wedge's start; beyond its ends too
  Vec3 point;
  double s_in = 0, sin_beta = 1;  ///< distance to the lamp, m; of the angle between ray and edge
  double density = 0;  ///< probability density of the draw per m of edge, the choice of the edge included, 1/m
};

/// The point `point` of `wedge` as rays see it: moved out of the solid along the bisector of its exterior.
Vec3 outside_of_edge(const Tracer& tracer, const Wedge& wedge, const Vec3& point);

/// All edges that the transmitter or its images of up to `before` reflections may light, with probabilities in
/// proportion to a bound of their power, ∫ I sin β √(λ s') dt ≤ √λ/4π (θ₁ − θ₀)/√min s', θ the angle at the lamp.
/// Entries: patches^before × wedges at the most.
class LitEdges {
 public:
  /// `end_parameter`: the edges' lines are drawn from beyond their ends up to this v_V (0: not at all).
  LitEdges(const Scene& scene, const Plan& plan, const Transmitter& transmitter, double wavelength, int before,
           double end_parameter);

  bool empty() const { return edges_.empty(); }
  const Lamp& lamp(const LitEdge& edge) const { return lamps_[edge.lamp]; }

  /// The edge that the uniform number u names.
  const LitEdge& choose(double u) const;

  /// A point on `edge`, its angle at the lamp uniform: p(t) = p(edge) ρ/(s'² (θ₁ − θ₀)). u uniform in (0, 1).
  EdgePoint draw_point(const LitEdge& edge, double u) const;

 private:
  void add_lamps(const Vec3& transmitter, int before);
  bool lights(const Lamp& lamp, const Wedge& wedge, LitEdge& lit) const;
  double beyond_end(double towards, double radial) const;

  const Scene& scene_;
  const bool faces_;
  const double wavelength_, end_parameter_;
  std::vector<Lamp> lamps_;
  std::vector<LitEdge> edges_;
};

}  // namespace grimaldi
