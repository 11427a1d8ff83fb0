#include "scenes/piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grimaldi {
namespace {

constexpr double foot_share = 0.6;       // of the rim that is foot; see the header
constexpr double level_share = 0.9;      // of the area that is horizontal
constexpr double foot_steepness = 0.71;  // sine of the steepest foot, 45°
constexpr double folded = 0.9962;        // cosine of 5°
constexpr double foot_rise = 0.17;       // sine of the least rise of a surface from its foot, 10°
// Volume over area × height below which a closed surface is taken for two sheets back to back. A house has 0.05 and
// more, rounding 1e-10.
constexpr double least_fullness = 1e-6;

struct Measure {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  double area = 0, projected = 0, projected_size = 0, volume = 0;
  double rim = 0, foot = 0;
};

Vec3 doubled_area(const std::vector<Vec3>& vertices, const std::array<std::uint32_t, 3>& t) {
  return cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
}

/// Across the edge into the triangle, in its plane; not normalised.
Vec3 into_face(const std::vector<Vec3>& vertices, const Edge& edge, const EdgeUse& use) {
  const Vec3 along = normalized(vertices[edge.vertex1] - vertices[edge.vertex0]);
  const Vec3 to_third = vertices[use.third] - vertices[edge.vertex0];
  return to_third - dot(to_third, along) * along;
}

bool is_foot(const std::vector<Vec3>& vertices, const Edge& edge, const EdgeUse& use) {
  const double rise = std::abs(vertices[edge.vertex1].z - vertices[edge.vertex0].z);
  if (rise > foot_steepness * distance(vertices[edge.vertex0], vertices[edge.vertex1])) return false;
  const Vec3 up_face = into_face(vertices, edge, use);
  return up_face.z > foot_rise * norm(up_face);
}

/// Union-find over triangles that keeps whether each is wound against the smallest of its set.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  struct Root {
    std::uint32_t first;
    std::uint8_t turned;
  };
  Root find(std::uint32_t i) {
    std::uint8_t turned = 0;
    std::uint32_t root = i;
    for (; parent_[root] != root; root = parent_[root]) turned ^= turned_[root];
    std::uint8_t rest = turned;
    while (parent_[i] != root && i != root) {  // shortens the way for the next time
      const std::uint32_t next = parent_[i];
      const std::uint8_t own = turned_[i];
      parent_[i] = root;
      turned_[i] = rest;
      rest ^= own;
      i = next;
    }
    return {root, turned};
  }
  void unite(std::uint32_t a, std::uint32_t b, bool turned) {
    const Root ra = find(a), rb = find(b);
    if (ra.first == rb.first) return;
    const std::uint32_t low = std::min(ra.first, rb.first), high = std::max(ra.first, rb.first);
    parent_[high] = low;
    turned_[high] = ra.turned ^ rb.turned ^ (turned ? 1 : 0);
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;
};

void number_pieces(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const EdgeTable& table, Pieces& pieces) {
  Joined joined(triangles.size());
  // What the file winds alike first: of a surface that cannot be wound consistently, most stays as it is.
  for (const bool turned : {false, true}) {
    for (const Edge& edge : table.edges) {
      if (edge.valence() != 2) continue;
      const EdgeUse &a = table.uses[edge.begin], &b = table.uses[edge.begin + 1];
      if ((a.forward == b.forward) == turned && !is_touch(vertices, table, edge)) {
        joined.unite(a.triangle, b.triangle, turned);
      }
    }
  }
  pieces.triangle_piece.resize(triangles.size());
  pieces.triangle_turned.resize(triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto [first, turned] = joined.find(i);
    pieces.triangle_piece[i] = first == i ? count++ : pieces.triangle_piece[first];
    pieces.triangle_turned[i] = turned;
  }
  pieces.kind.assign(count, PieceKind::sheet);
  pieces.outward.assign(count, 0);
}

}  // namespace

bool is_touch(const std::vector<Vec3>& vertices, const EdgeTable& table, const Edge& edge) {
  if (edge.valence() != 2) return false;
  const EdgeUse &a = table.uses[edge.begin], &b = table.uses[edge.begin + 1];
  if (a.forward != b.forward) return false;
  const Vec3 in_a = into_face(vertices, edge, a), in_b = into_face(vertices, edge, b);
  return dot(in_a, in_b) > folded * norm(in_a) * norm(in_b);
}

Pieces find_pieces(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const EdgeTable& table) {
  Pieces pieces;
  number_pieces(vertices, triangles, table, pieces);

  std::vector<Measure> measures(pieces.kind.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Measure& m = measures[pieces.triangle_piece[i]];
    for (const std::uint32_t v : triangles[i]) {
      m.low = std::min(m.low, vertices[v].z);
      m.high = std::max(m.high, vertices[v].z);
    }
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    Measure& m = measures[pieces.triangle_piece[i]];
    const Vec3 twice = doubled_area(vertices, t);
    const double upward = (pieces.triangle_turned[i] ? -0.5 : 0.5) * twice.z;
    m.area += 0.5 * norm(twice);
    m.projected += upward;
    m.projected_size += std::abs(upward);
    const double height = ((vertices[t[0]].z - m.low) + (vertices[t[1]].z - m.low) + (vertices[t[2]].z - m.low)) / 3;
    m.volume += upward * height;
  }
  for (const Edge& edge : table.edges) {
    if (edge.valence() != 1 && !is_touch(vertices, table, edge)) continue;
    const double length = distance(vertices[edge.vertex0], vertices[edge.vertex1]);
    for (std::uint32_t i = edge.begin; i < edge.end; ++i) {
      Measure& m = measures[pieces.triangle_piece[table.uses[i].triangle]];
      m.rim += length;
      if (is_foot(vertices, edge, table.uses[i])) m.foot += length;
    }
  }

  for (std::size_t p = 0; p < measures.size(); ++p) {
    const Measure& m = measures[p];
    if (m.foot >= foot_share * m.rim && std::abs(m.volume) > least_fullness * m.area * (m.high - m.low)) {
      pieces.kind[p] = PieceKind::solid;
      pieces.outward[p] = m.volume > 0 ? 1 : -1;
    } else if (m.projected_size >= level_share * m.area && m.projected != 0) {
      pieces.kind[p] = PieceKind::level;
      pieces.outward[p] = m.projected > 0 ? 1 : -1;
    }
  }
  return pieces;
}

}  // namespace grimaldi
