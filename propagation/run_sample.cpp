#include "propagation/run_sample.h"

#include <algorithm>

#include "core/random.h"

namespace grimaldi {
namespace {

constexpr std::uint32_t cell_stream = 11;

}  // namespace

CoverageGrid sample_of(const CoverageGrid& grid, std::size_t block, std::uint64_t seed) {
  const GridLayout& fine = grid.layout;
  CoverageGrid sample;
  sample.layout = fine;
  sample.layout.nx = (fine.nx + block - 1) / block;
  sample.layout.ny = (fine.ny + block - 1) / block;
  sample.layout.cell = double(block) * fine.cell;
  for (std::size_t square = 0; square < sample.layout.size(); ++square) {
    const std::size_t x = square % sample.layout.nx * block, y = square / sample.layout.nx * block;
    const auto draw = uniform4(seed, cell_stream, square, 0);
    const auto within = [block](double u, std::size_t first, std::size_t end) {
      const std::size_t count = std::min(block, end - first);
      return first + std::min(count - 1, static_cast<std::size_t>(u * double(count)));
    };
    const std::size_t cell = within(draw[1], y, fine.ny) * fine.nx + within(draw[0], x, fine.nx);
    const Vec3 shift = fine.centre(cell) - sample.layout.centre(square);
    const auto take = [&](std::span<const SubPoint> from, std::vector<SubPoint>& to,
                          std::vector<CoverageGrid::Range>& ranges) {
      ranges.push_back({static_cast<std::uint32_t>(to.size()), static_cast<std::uint32_t>(from.size())});
      for (SubPoint point : from) {
        point.offset = point.offset + shift;
        to.push_back(point);
      }
    };
    sample.inside_fraction.push_back(grid.inside_fraction[cell]);
    take(grid.of(cell), sample.sub_points, sample.ranges);
    if (!grid.dense_ranges.empty()) take(grid.dense_of(cell), sample.dense_points, sample.dense_ranges);
  }
  return sample;
}

}  // namespace grimaldi
