#pragma once
// The points of a sequence between two ends: images for faces, the minimum of the path length (which is convex) for
// edges.

#include <array>
#include <cstdint>
#include <span>

#include "core/vector.h"
#include "propagation/sequence.h"
#include "scenes/scene.h"

namespace grimaldi {

struct SmallObjects;

/// How a path passes one edge, in lengths and angles that mirrors do not change.
struct EdgePassage {
  std::uint32_t wedge = no_index;
  double along = 0;            ///< of the diffraction point from the wedge's start, m; may lie beyond its ends
  double s_in = 0, s_out = 0;  ///< distances to the source or edge before and to the edge or receiver after, m
  double sin_beta = 1;         ///< of the angle between ray and edge
  double phi_in = 0,
         phi_out = 0;  ///< φ', φ: azimuths of where the wave comes from and goes to, rad, 0 … exterior angle
  /// Of the paths over the ends of the edge, m; the points on the edges next to it are where that path is shortest.
  double detour_start = 0, detour_end = 0;
  bool inside = true;  ///< the diffraction point lies on the edge
};

/// A path found: points[0] = source, points[count−1] = receiver, between them one point per interaction.
struct PathGeometry {
  std::array<Vec3, max_depth + 2> points;
  std::size_t count = 0;
  double length = 0;  ///< of the whole path through the diffraction points, m
  std::array<EdgePassage, max_edges> edges;
  std::size_t edge_count = 0;
};

/// One sequence from one source, unfolded: what comes before a face is mirrored in it, so that the path to any receiver
/// is a straight line, or one that breaks at edges only.
class UnfoldedSequence {
 public:
  /// `objects`: openings among them send their waves everywhere (shines_through); they stay alive as long as this.
  UnfoldedSequence(const Scene& scene, const Vec3& source, std::span<const Interaction> interactions,
                   const SmallObjects* objects = nullptr);

  /// False for a sequence that no path can have: an edge next to a face of its own, one interaction twice in a row, too
  /// many edges.
  bool possible() const { return possible_; }

  /// Points, lengths and angles of the path to `receiver`. False if there is none: a mirror's point lies behind it or
  /// outside its bounding box, an azimuth inside the solid, a diffraction point beyond an end that stands on a face or
  /// so far beyond the edge's end that v_V ≥ 3 there at `wavelength` (m; but of the one edge of an opening that shines
  /// through), two edges passed within 1 mm of each other (where they meet), or two other vertices of the path nearer
  /// than 1 µm. Visibility is not asked here. Method: one edge in closed form (the two half-planes through the edge
  /// unfolded); more by Newton on the length, which is convex, until the step is below 1e-12 of the length. Newton
  /// starts from the last solution of this object, so that neighbouring receivers cost one or two steps; the solution
  /// itself is the same to 1e-9 m.
  bool solve(const Vec3& receiver, double wavelength, PathGeometry& geometry) {
    return solve(receiver, wavelength, geometry, false);
  }

  /// Newton for the next receiver starts from these places along the edges, m (of two and more).
  void begin_at(std::span<const double> along);

  /// The same with every face taken as the whole of its plane.
  bool solve_in_planes(const Vec3& receiver, double wavelength, PathGeometry& geometry) {
    return solve(receiver, wavelength, geometry, true);
  }

 private:
  struct UnfoldedEdge {
    std::uint32_t wedge;
    std::size_t position;  ///< in the sequence
    Vec3 start, direction, along0, normal0, normaln;
    Vec3 point(double t) const { return start + t * direction; }
  };
  bool fermat_points(const Vec3& receiver, std::array<double, max_edges>& along);
  void look_from(double along1, double along2);
  bool two_fermat_points(const Vec3& receiver, double& along1, double& along2);
  bool descend(const Vec3& receiver, double& along1, double& along2);
  /// Of edge i of the unfolded way over all edges, both ends of the path included.
  bool passage(std::size_t i, std::span<const Vec3> way, double along, double wavelength, EdgePassage& out) const;
  bool solve(const Vec3& receiver, double wavelength, PathGeometry& geometry, bool in_planes);
  bool mirror_points(std::size_t first, std::size_t last, PathGeometry& geometry, bool in_planes) const;

  const Scene* scene_;
  const SmallObjects* objects_;
  std::span<const Interaction> interactions_;
  Vec3 source_, image_;
  std::array<UnfoldedEdge, max_edges> edges_;
  std::size_t edge_count_ = 0;
  bool possible_ = true;
  /// Two edges as seen from a point on each, near the path: t counts from there. The squared distance of their points
  /// is apart² + t₁² + t₂² − 2 cosine t₁t₂ + 2 offset2 t₂ − 2 offset1 t₁.
  struct {
    double from1, from2;  ///< of those points along their edges, m
    double cosine, offset1, offset2, apart2;
    double source_along, source_off;  ///< axial and radial coordinates of the image about the first edge
  } pair_{};
  std::array<double, max_edges> last_{};  ///< where Newton ended
  bool has_last_ = false;
};

/// Where the shortest way from a to b over the line start + t direction crosses it: t, m.
/// Formula: (z_a r_b + z_b r_a)/(r_a + r_b), axial and radial coordinates about the line (its two half-planes
/// unfolded).
double crossing(const Vec3& start, const Vec3& direction, const Vec3& a, const Vec3& b);

/// True if the straight way from `image` to `to`, on the other side of the patch's plane, crosses its bounding box and
/// 1 cm about it: the mirror's point may lie on the patch.
bool crosses_box(const Patch& patch, const Vec3& image, const Vec3& to);

/// `point` mirrored in the plane of `patch`.
Vec3 mirrored(const Vec3& point, const Patch& patch);

}  // namespace grimaldi
