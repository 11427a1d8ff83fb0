#include "propagation/coverage_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"

namespace grimaldi {
namespace {

constexpr int raster = 8;  ///< points a side of a crossed cell
constexpr std::uint32_t sub_point_stream = 3;

struct GaussPoint {
  double position;  ///< in (−1, 1)
  double weight;    ///< of an interval of length 2
};

/// Gauss-Legendre points by Newton on P_n. Source: Abramowitz & Stegun 25.4.29.
std::vector<GaussPoint> gauss_legendre(int n) {
  std::vector<GaussPoint> points;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    points.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

/// Cells that the plan of a triangle's edge crosses.
std::vector<std::uint8_t> crossed_cells(const Scene& scene, const GridLayout& grid) {
  std::vector<std::uint8_t> crossed(grid.size(), 0);
  const auto cell_of = [](double x, std::size_t n) {
    return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, double(n) - 1));
  };
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    if (scene.triangle_is_ground[t]) continue;
    const auto& corners = scene.triangles[t];
    const Vec3 p[3] = {scene.vertices[corners[0]], scene.vertices[corners[1]], scene.vertices[corners[2]]};
    if (std::max({p[0].z, p[1].z, p[2].z}) < grid.z) continue;  // nothing of it lies above the receivers
    for (int side = 0; side < 3; ++side) {
      double x0 = (p[side].x - grid.x0) / grid.cell, y0 = (p[side].y - grid.y0) / grid.cell;
      double x1 = (p[(side + 1) % 3].x - grid.x0) / grid.cell, y1 = (p[(side + 1) % 3].y - grid.y0) / grid.cell;
      if (y0 > y1) std::swap(x0, x1), std::swap(y0, y1);
      if (y1 < 0 || y0 >= double(grid.ny)) continue;
      for (std::size_t row = cell_of(y0, grid.ny); row <= cell_of(y1, grid.ny); ++row) {
        // The part of the side within the row, grown by a hair for points on the rows' common line.
        const double low = std::max(y0, double(row)), high = std::min(y1, double(row) + 1);
        const double ta = y1 > y0 ? std::clamp((low - y0) / (y1 - y0), 0.0, 1.0) : 0;
        const double tb = y1 > y0 ? std::clamp((high - y0) / (y1 - y0), 0.0, 1.0) : 1;
        const double xa = x0 + ta * (x1 - x0), xb = x0 + tb * (x1 - x0);
        const double west = std::min(xa, xb), east = std::max(xa, xb);
        if (east < 0 || west >= double(grid.nx)) continue;
        for (std::size_t column = cell_of(west, grid.nx); column <= cell_of(east, grid.nx); ++column)
          crossed[row * grid.nx + column] = 1;
      }
    }
  }
  return crossed;
}

struct CellPoints {
  double inside_fraction = 0;
  std::vector<SubPoint> points;
};

/// Points a side of both sets; 0 edge points where nothing diffracts.
struct PointCounts {
  int fine, edge;
};

CellPoints crossed_cell(const Tracer& tracer, const GridLayout& grid, std::size_t cell, PointCounts counts,
                        std::uint64_t seed) {
  const Vec3 corner = grid.centre(cell) - Vec3{0.5 * grid.cell, 0.5 * grid.cell, 0};
  std::array<bool, raster * raster> outdoor{};
  int outdoors = 0;
  for (int j = 0; j < raster; ++j)
    for (int i = 0; i < raster; ++i) {
      const Vec3 point = corner + grid.cell / raster * Vec3{i + 0.5, j + 0.5, 0};
      outdoors += outdoor[static_cast<std::size_t>(j * raster + i)] = !tracer.inside_solid(point);
    }
  CellPoints result;
  result.inside_fraction = 1 - double(outdoors) / (raster * raster);
  if (outdoors == raster * raster) return result;
  for (const bool edge : {false, true}) {
    const int n = edge ? counts.edge : counts.fine;
    for (int part = 0; part < n * n; ++part) {
      std::vector<Vec3> points;
      for (int j = 0; j < raster; ++j)
        for (int i = 0; i < raster; ++i)
          if (outdoor[static_cast<std::size_t>(j * raster + i)] && (j * n / raster) * n + i * n / raster == part)
            points.push_back(corner + grid.cell / raster * Vec3{i + 0.5, j + 0.5, 0});
      if (points.empty()) continue;
      const double u = uniform4(seed, sub_point_stream, cell, static_cast<std::uint32_t>(2 * part + edge))[0];
      const double weight = double(points.size()) / outdoors;
      result.points.push_back(
          {points[static_cast<std::size_t>(u * double(points.size()))], edge ? 0 : weight, edge ? weight : 0});
    }
  }
  return result;
}

}  // namespace

int sub_points_a_side(double rays) {
  return std::clamp(static_cast<int>(std::lround(4 * std::cbrt(rays / 1e6))), 2, 6);
}

int edge_sub_points_a_side(double rays) { return std::max(2, sub_points_a_side(rays) / 2); }

CoverageGrid make_coverage_grid(const Scene& scene, const Tracer& tracer, const Plan& plan) {
  CoverageGrid grid;
  grid.layout = plan.grid;
  const bool edges = plan.request.diffraction && plan.request.max_diffractions > 0 && plan.request.depth > 0;
  const PointCounts counts{sub_points_a_side(plan.request.rays), edges ? edge_sub_points_a_side(plan.request.rays) : 0};
  const std::vector<GaussPoint> fine = gauss_legendre(counts.fine), coarse = gauss_legendre(counts.edge);
  const std::vector<std::uint8_t> crossed = crossed_cells(scene, plan.grid);
  constexpr std::size_t block_size = 1024;
  const std::size_t cells = plan.grid.size(), blocks = (cells + block_size - 1) / block_size;
  std::vector<std::vector<CellPoints>> found(blocks);
  for_each_block(blocks, plan.request.threads, [&](std::size_t block, unsigned) {
    for (std::size_t cell = block * block_size; cell < std::min(cells, (block + 1) * block_size); ++cell) {
      CellPoints& here = found[block].emplace_back();
      if (crossed[cell]) {
        here = crossed_cell(tracer, plan.grid, cell, counts, plan.request.seed);
        if (here.inside_fraction > 0) continue;
      }
      const Vec3 centre = plan.grid.centre(cell);
      if (!crossed[cell] && tracer.inside_solid(centre)) {
        here.inside_fraction = 1;
        continue;
      }
      for (const auto* gauss : {&fine, &coarse})
        for (const GaussPoint& v : *gauss)
          for (const GaussPoint& u : *gauss) {
            const double weight = 0.25 * u.weight * v.weight;
            here.points.push_back({centre + 0.5 * plan.grid.cell * Vec3{u.position, v.position, 0},
                                   gauss == &fine ? weight : 0, gauss == &fine ? 0 : weight});
          }
    }
  });
  grid.begins.push_back(0);
  for (const auto& block : found)
    for (const CellPoints& cell : block) {
      grid.inside_fraction.push_back(cell.inside_fraction);
      grid.sub_points.insert(grid.sub_points.end(), cell.points.begin(), cell.points.end());
      grid.begins.push_back(grid.sub_points.size());
    }
  return grid;
}

}  // namespace grimaldi
