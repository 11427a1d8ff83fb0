#include "scenes/surroundings.h"

#include <algorithm>
#include <limits>

#include "scenes/piece.h"

namespace grimaldi {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How often the triangle's outline, seen from above, runs round the point, counterclockwise +1: half-open, and each
/// side is judged from its lower vertex index, so that of triangles that share sides exactly one has the point.
int turns_around(const Surroundings& s, std::uint32_t triangle, const Vec3& point) {
  const auto& t = s.triangles[triangle];
  int turns = 0;
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t from = t[k], to = t[(k + 1) % 3];
    const bool from_low = s.vertices[from].y <= point.y, to_low = s.vertices[to].y <= point.y;
    if (from_low == to_low) continue;
    const Vec3 &a = s.vertices[std::min(from, to)], &b = s.vertices[std::max(from, to)];
    const double side = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);  // > 0: left of a → b
    const bool left_of_upward = (b.y > a.y) == (side > 0);
    if (left_of_upward) turns += from_low ? 1 : -1;
  }
  return turns;
}

}  // namespace

Surroundings::Surroundings(const std::vector<Vec3>& all_vertices,
                           const std::vector<std::array<std::uint32_t, 3>>& all_triangles, const EdgeTable& table)
    : vertices(all_vertices), triangles(all_triangles), tree(all_vertices, all_triangles) {
  const Pieces pieces = find_pieces(vertices, triangles, table);
  Vec3 low{infinity, infinity, infinity}, high = -low;
  struct Extent {
    double low = infinity, high = -infinity, projected = 0;
  };
  std::vector<Extent> extent(pieces.kind.size());
  normal.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const Vec3 twice = cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
    normal.push_back(normalized(twice));
    Extent& e = extent[pieces.triangle_piece[i]];
    e.projected += 0.5 * std::abs(twice.z);
    for (const std::uint32_t v : t) {
      const Vec3& p = vertices[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      e.low = std::min(e.low, p.z);
      e.high = std::max(e.high, p.z);
    }
  }
  const double span = (high.x - low.x) * (high.y - low.y);
  solid.resize(triangles.size());
  ground.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t p = pieces.triangle_piece[i];
    const Extent& e = extent[p];
    foot.push_back(e.low);
    // A piece wound inward, and the triangles that no winding of a one-sided piece can set right, bound no solid here.
    solid[i] = pieces.kind[p] == PieceKind::solid && (pieces.outward[p] > 0) == (pieces.triangle_turned[i] == 0);
    ground[i] = pieces.kind[p] == PieceKind::level && high.z > e.high + contact_distance &&
                (e.low < low.z + contact_distance || e.projected > 0.5 * span);
  }
}

bool Surroundings::is_inside(const Vec3& point) const {
  thread_local std::vector<std::uint32_t> above;
  tree.find(point, {point.x, point.y, infinity}, above);
  int cover = 0;
  for (const std::uint32_t t : above) {
    if (!ground[t] && (!solid[t] || point.z < foot[t])) continue;
    const int turns = turns_around(*this, t, point);
    if (turns == 0) continue;
    // The surface is above the point if the point is on the lower side of its plane.
    if (dot(normal[t], point - vertices[triangles[t][0]]) * turns < 0) cover += turns;
  }
  return cover > 0;
}

}  // namespace grimaldi
