#include "scenes/edge_table.h"

#include <algorithm>

#include "core/contract.h"

namespace grimaldi {

EdgeTable make_edge_table(std::size_t vertex_count, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Side {
    std::uint32_t vertex1;
    EdgeUse use;
  };
  // Sorted by the lower vertex by counting, then by the higher one within each vertex.
  std::vector<std::uint32_t> begin(vertex_count + 1, 0);
  for (const auto& t : triangles) {
    GRIMALDI_EXPECT(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    for (int k = 0; k < 3; ++k) ++begin[std::min(t[k], t[(k + 1) % 3]) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<Side> sides(3 * triangles.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3], c = triangles[i][(k + 2) % 3];
      sides[next[std::min(a, b)]++] = {std::max(a, b), {i, c, a < b}};
    }
  }

  EdgeTable table;
  table.edges.reserve(sides.size() / 2 + 1);
  table.uses.reserve(sides.size());
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const auto first = sides.begin() + begin[v], last = sides.begin() + begin[v + 1];
    std::stable_sort(first, last, [](const Side& a, const Side& b) { return a.vertex1 < b.vertex1; });
    for (auto side = first; side != last; ++side) {
      const auto index = static_cast<std::uint32_t>(table.uses.size());
      if (side == first || side->vertex1 != (side - 1)->vertex1) {
        table.edges.push_back({v, side->vertex1, index, index});
      }
      table.uses.push_back(side->use);
      ++table.edges.back().end;
    }
  }
  return table;
}

}  // namespace grimaldi
