#pragma once
// The cells of a map and the points inside them that are asked.

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"
#include "propagation/plan.h"

namespace grimaldi {

/// A point inside a cell and the share of the cell's outdoor area that it stands for. There are two sets, each of which
/// adds up to 1 over a cell: a fine one for direct and reflected waves, which end at sharp boundaries, and a coarse one
/// for edges' waves and what interferes with them, which are smooth but costly.
struct SubPoint {
  Vec3 offset;         ///< from the cell's centre, m
  double weight;       ///< for paths without an edge; 0 at points of the other set
  double edge_weight;  ///< for paths with an edge and for interference; 0 at points of the other set
};

/// Sub-points of one cell at the most: visibility is kept as bits.
inline constexpr std::size_t max_sub_points = 64;

struct CoverageGrid {
  GridLayout layout;
  std::vector<double> inside_fraction;  ///< per cell
  std::vector<SubPoint> sub_points;     ///< first those that all cells wholly outdoors share
  std::vector<SubPoint> dense_points;   ///< the same of a third set (edge_weight), for the strong paths over edges
  struct Range {
    std::uint32_t first, count;
  };
  std::vector<Range> ranges, dense_ranges;  ///< per cell; count 0 for a cell wholly inside; dense: none, or per cell
  std::span<const SubPoint> of(std::size_t cell) const {
    return {sub_points.data() + ranges[cell].first, ranges[cell].count};
  }
  std::span<const SubPoint> dense_of(std::size_t cell) const {
    if (dense_ranges.empty()) return {};
    return {dense_points.data() + dense_ranges[cell].first, dense_ranges[cell].count};
  }
};

/// Fine sub-points along a cell's side.
inline constexpr int sub_points_a_side = 6;

/// A cell's inside fraction is taken at 8 × 8 points: inside where an odd number of surfaces, ground excluded, lies
/// straight above (all triangles scanned row by row with one fill rule, so that a point above a common edge counts
/// once). A cell wholly outdoors has n × n Gauss-Legendre points, so that the mean of a smooth gain has an error of the
/// order (cell/distance)^(2n). In any other, for each set, each of n × n parts that has outdoor points gives one of
/// them (drawn from the seed), weighted by their number.
CoverageGrid make_coverage_grid(const Scene& scene, const Plan& plan);

}  // namespace grimaldi
