#include "propagation/coverage_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/constants.h"
#include "core/gauss_legendre.h"
#include "core/random.h"
#include "propagation/effort.h"

namespace grimaldi {
namespace {

constexpr int raster = 8;  ///< points a side of a crossed cell
constexpr std::uint32_t sub_point_stream = 3;

/// Where a row of points meets the plan of a triangle's side: x at y, from the lower end, the same for both triangles
/// of the side.
double side_at(Vec3 a, Vec3 b, double y) {
  if (a.y > b.y || (a.y == b.y && a.x > b.x)) std::swap(a, b);
  return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
}

/// Per cell 64 bits, bit 8 j + i for the point of column i and row j: an odd number of surfaces lies straight above it.
class ParityRaster {
 public:
  explicit ParityRaster(const GridLayout& grid) : grid_(grid), bits_(grid.size(), 0), step_(grid.cell / raster) {}

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 corners[3] = {a, b, c};
    const double top = std::max({a.z, b.z, c.z}), bottom = std::min({a.z, b.z, c.z});
    if (top <= grid_.z) return;
    const Vec3 normal = cross(b - a, c - a);
    if (normal.z == 0) return;  // upright: no point lies under it
    const double low = std::min({a.y, b.y, c.y}), high = std::max({a.y, b.y, c.y});
    const auto rows = static_cast<std::int64_t>(grid_.ny * raster);
    for (std::int64_t row = first_point(low - grid_.y0); row < rows; ++row) {
      const double y = grid_.y0 + (double(row) + 0.5) * step_;
      if (y >= high) break;
      double from = 0, to = 0;
      int met = 0;
      for (int side = 0; side < 3; ++side) {
        const Vec3& p = corners[side];
        const Vec3& q = corners[(side + 1) % 3];
        if ((p.y <= y) == (q.y <= y)) continue;
        (met++ == 0 ? from : to) = side_at(p, q, y);
      }
      if (met != 2) continue;
      if (from > to) std::swap(from, to);
      toggle(row, from, to, bottom < grid_.z ? &normal : nullptr, a, y);
    }
  }

  std::uint64_t bits(std::size_t cell) const { return bits_[cell]; }

 private:
  /// Number of the first point at or beyond `distance` from the grid's border, not below 0.
  std::int64_t first_point(double distance) const {
    return std::max<std::int64_t>(0,
                                  static_cast<std::int64_t>(std::ceil(std::clamp(distance / step_ - 0.5, -1.0, 4e9))));
  }

  void toggle(std::int64_t row, double from, double to, const Vec3* normal, const Vec3& on_plane, double y) {
    const auto columns = static_cast<std::int64_t>(grid_.nx * raster);
    const auto cell_row = static_cast<std::size_t>(row / raster) * grid_.nx;
    for (std::int64_t column = first_point(from - grid_.x0); column < columns; ++column) {
      const double x = grid_.x0 + (double(column) + 0.5) * step_;
      if (x >= to) break;
      if (x < from) continue;
      if (normal) {
        const double z = on_plane.z - (normal->x * (x - on_plane.x) + normal->y * (y - on_plane.y)) / normal->z;
        if (z <= grid_.z) continue;
      }
      bits_[cell_row + static_cast<std::size_t>(column / raster)] ^= std::uint64_t(1)
                                                                     << (row % raster * raster + column % raster);
    }
  }

  const GridLayout& grid_;
  std::vector<std::uint64_t> bits_;
  double step_;
};

/// Points of a cell that is partly inside, from the bits of its inside points; set 0 (fine) has weights, 1 (coarse) and
/// 2 (dense) edge weights.
void add_partly_inside(const GridLayout& grid, std::size_t cell, std::uint64_t inside, int n, std::uint32_t set,
                       std::uint64_t seed, std::vector<SubPoint>& out) {
  const double outdoors = 64 - std::popcount(inside);
  for (int part = 0; part < n * n; ++part) {
    std::array<Vec3, raster * raster> points;
    std::size_t count = 0;
    for (int j = 0; j < raster; ++j)
      for (int i = 0; i < raster; ++i)
        if (!(inside >> (j * raster + i) & 1) && (j * n / raster) * n + i * n / raster == part)
          points[count++] = grid.cell / raster * Vec3{i + 0.5 - raster / 2, j + 0.5 - raster / 2, 0};
    if (count == 0) continue;
    const double u = uniform4(seed, sub_point_stream, cell, 3 * static_cast<std::uint32_t>(part) + set)[0];
    const double weight = double(count) / outdoors;
    out.push_back({points[static_cast<std::size_t>(u * double(count))], set == 0 ? weight : 0, set == 0 ? 0 : weight});
  }
}

void add_outdoors(const GridLayout& grid, int n, bool edge, std::vector<SubPoint>& out) {
  const std::vector<GaussPoint> gauss = gauss_legendre_points(n);
  for (const GaussPoint& v : gauss)
    for (const GaussPoint& u : gauss) {
      const double weight = 0.25 * u.weight * v.weight;
      out.push_back({0.5 * grid.cell * Vec3{u.position, v.position, 0}, edge ? 0 : weight, edge ? weight : 0});
    }
}

}  // namespace

CoverageGrid make_coverage_grid(const Scene& scene, const Plan& plan) {
  static_assert(sub_points_a_side * sub_points_a_side + 5 * 5 <= max_sub_points);
  const GridLayout& layout = plan.grid;
  const Effort effort = effort_of(plan.request);
  const int edge_points = effort.coarse_points, dense_points = effort.dense_points;
  ParityRaster parity(layout);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& corners = scene.triangles[t];
    if (!scene.triangle_is_ground[t])
      parity.add(scene.vertices[corners[0]], scene.vertices[corners[1]], scene.vertices[corners[2]]);
  }
  CoverageGrid grid;
  grid.layout = layout;
  add_outdoors(layout, sub_points_a_side, false, grid.sub_points);
  add_outdoors(layout, edge_points, true, grid.sub_points);
  add_outdoors(layout, dense_points, true, grid.dense_points);
  const auto shared = static_cast<std::uint32_t>(grid.sub_points.size());
  const auto shared_dense = static_cast<std::uint32_t>(grid.dense_points.size());
  grid.inside_fraction.reserve(layout.size());
  grid.ranges.reserve(layout.size());
  for (std::size_t cell = 0; cell < layout.size(); ++cell) {
    const std::uint64_t inside = parity.bits(cell);
    grid.inside_fraction.push_back(std::popcount(inside) / 64.0);
    if (inside == 0) {
      grid.ranges.push_back({0, shared});
      if (dense_points > 0) grid.dense_ranges.push_back({0, shared_dense});
      continue;
    }
    const auto first = static_cast<std::uint32_t>(grid.sub_points.size());
    const auto first_dense = static_cast<std::uint32_t>(grid.dense_points.size());
    if (inside != ~std::uint64_t(0)) {
      add_partly_inside(layout, cell, inside, sub_points_a_side, 0, plan.request.seed, grid.sub_points);
      add_partly_inside(layout, cell, inside, edge_points, 1, plan.request.seed, grid.sub_points);
      add_partly_inside(layout, cell, inside, dense_points, 2, plan.request.seed, grid.dense_points);
    }
    grid.ranges.push_back({first, static_cast<std::uint32_t>(grid.sub_points.size()) - first});
    if (dense_points > 0)
      grid.dense_ranges.push_back({first_dense, static_cast<std::uint32_t>(grid.dense_points.size()) - first_dense});
  }
  return grid;
}

}  // namespace grimaldi
