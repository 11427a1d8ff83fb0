#pragma once
// Which part of an edge a point cannot see: the shadows that triangles cast on it.

#include <cstddef>
#include <utility>
#include <vector>

#include "core/vector.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The shadow on one wedge, seen from one point, as shares of its length from its start.
class EdgeShadow {
 public:
  /// `gap` m: rays see the edge 3 gaps out along its bisector, and meet nothing within a gap of their ends
  /// (Tracer::surface_gap).
  EdgeShadow(const Wedge& wedge, const Vec3& eye, double gap);

  /// True if the point lies inside the wedge's solid or the way to it runs along the edge: nothing can be said then.
  bool hidden_by_itself() const { return inside_; }
  bool end_on() const { return end_on_; }

  /// Adds the shadow of a triangle of `scene`. What lies within 4 gaps of either end of the way casts none, so that
  /// never more is dark than rays say. Formula: the triangle cut by the plane of eye and edge, each point of the cut
  /// seen from the eye at the share β/(α + β) of the edge (α and β its coordinates along the ways to the edge's ends).
  void add(const Scene& scene, std::size_t triangle);

  bool all_dark() const { return !dark_.empty() && dark_[0].first <= 0 && dark_[0].second >= 1; }
  bool is_dark(double share) const;
  /// The dark parts, disjoint and ascending.
  const std::vector<std::pair<double, double>>& dark() const { return dark_; }

 private:
  void add_dark(double from, double to);

  Vec3 eye_, start_, end_, normal_;  ///< the ends from the eye, and their product
  double size_ = 0, near_ = 0;
  bool inside_ = false, end_on_ = false;
  std::vector<std::pair<double, double>> dark_;
};

}  // namespace grimaldi
