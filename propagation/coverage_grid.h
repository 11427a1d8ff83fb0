#pragma once
// The cells of a map and the points inside them that are asked.

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// A point inside a cell and the share of the cell's outdoor area that it stands for. There are two sets, each of which
/// adds up to 1 over a cell: a fine one for direct and reflected waves, which end at sharp boundaries, and one of half
/// as many points a side for edges' waves and what interferes with them, which are smooth but costly.
struct SubPoint {
  Vec3 position;
  double weight;       ///< for paths without an edge; 0 at points of the other set
  double edge_weight;  ///< for paths with an edge and for interference; 0 at points of the other set
};

/// Sub-points of one cell at the most: visibility is kept as bits.
inline constexpr std::size_t max_sub_points = 64;

struct CoverageGrid {
  GridLayout layout;
  std::vector<double> inside_fraction;  ///< per cell
  std::vector<SubPoint>
      sub_points;  ///< of all cells; none for a cell wholly inside; edges' points only if the plan has diffraction
  std::vector<std::uint64_t> begins;  ///< per cell, and one more
  std::span<const SubPoint> of(std::size_t cell) const {
    return {sub_points.data() + begins[cell], sub_points.data() + begins[cell + 1]};
  }
};

/// Fine sub-points along a cell's side for a run of `rays`: 4 (rays/1e6)^⅓, at least 2, at most 6. A boundary through a
/// cell is then met with an error that falls as n^−3/2, so as the root of the rays.
int sub_points_a_side(double rays);

/// The same for edges' waves: half as many, at least 2.
int edge_sub_points_a_side(double rays);

/// A cell that no wall or roof edge crosses in plan is outdoors or inside as a whole: n × n Gauss-Legendre points, so
/// that the mean of a smooth gain has an error of the order (cell/distance)^(2n). A cell that is crossed is asked at 8
/// × 8 points for its inside fraction; for each set, each of n × n parts of it that has outdoor ones gives one of them
/// (drawn from the seed), weighted by their number.
CoverageGrid make_coverage_grid(const Scene& scene, const Tracer& tracer, const Plan& plan);

}  // namespace grimaldi
