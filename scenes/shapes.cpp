#include "scenes/shapes.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/contract.h"

namespace grimaldi {
namespace {

using Index = std::uint32_t;

/// Twice the area of the triangle a, b, c; positive if counter-clockwise.
double turn(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance2(const PlanPoint& a, const PlanPoint& b) {
  return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
}

Vec3 lifted(const PlanPoint& p, double z) { return {p.x, p.y, z}; }

Index append_vertex(const Vec3& p, MeshDescription& mesh) {
  mesh.vertices.push_back(p);
  return static_cast<Index>(mesh.vertices.size() - 1);
}

/// The quadrilateral a, b, c, d, counter-clockwise seen from where its normal points.
void append_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, MeshDescription& mesh) {
  const Index i = append_vertex(a, mesh);
  append_vertex(b, mesh);
  append_vertex(c, mesh);
  append_vertex(d, mesh);
  mesh.triangles.push_back({i, i + 1, i + 2});
  mesh.triangles.push_back({i, i + 2, i + 3});
}

/// Walls over a closed line; they face to the right of its direction.
void append_walls(const std::vector<PlanPoint>& line, double height, MeshDescription& mesh) {
  const auto n = static_cast<Index>(line.size());
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const PlanPoint& p : line) {
    mesh.vertices.push_back(lifted(p, 0));
    mesh.vertices.push_back(lifted(p, height));
  }
  for (Index i = 0; i < n; ++i) {
    const Index foot = first + 2 * i, next = first + 2 * ((i + 1) % n);
    mesh.triangles.push_back({foot, next, next + 1});
    mesh.triangles.push_back({foot, next + 1, foot + 1});
  }
}

/// True if the corner `i` of what is left can be cut off: convex, and no other corner in its triangle (rim included: in
/// a simple polygon no corner lies on the two sides, and one on the diagonal forbids it).
bool is_ear(const std::vector<PlanPoint>& outline, const std::vector<Index>& left, std::size_t i) {
  const std::size_t n = left.size();
  const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
  const PlanPoint &a = outline[left[before]], &b = outline[left[i]], &c = outline[left[after]];
  if (turn(a, b, c) <= 0) return false;
  for (std::size_t j = 0; j < n; ++j) {
    if (j == before || j == i || j == after) continue;
    const PlanPoint& p = outline[left[j]];
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

void append_flat_roof(const std::vector<PlanPoint>& outline, double height, MeshDescription& mesh) {
  std::vector<Index> corners;
  for (const PlanPoint& p : outline) corners.push_back(append_vertex(lifted(p, height), mesh));
  const auto roof = fill(outline);
  GRIMALDI_EXPECT(!roof.empty());
  for (const auto& [a, b, c] : roof) mesh.triangles.push_back({corners[a], corners[b], corners[c]});
}

void append_ring_roof(const Building& building, MeshDescription& mesh) {
  const std::size_t n = building.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    append_quad(lifted(building.outline[i], building.height), lifted(building.outline[j], building.height),
                lifted(building.courtyard[j], building.height), lifted(building.courtyard[i], building.height), mesh);
  }
}

void append_gabled_roof(const Building& building, MeshDescription& walls, MeshDescription& roof) {
  GRIMALDI_EXPECT(building.outline.size() == 4 && building.courtyard.empty());
  // Eaves a → b and c → d along the ridge, gables over b → c and d → a.
  const auto& o = building.outline;
  const std::size_t first = distance2(o[0], o[1]) >= distance2(o[1], o[2]) ? 0 : 1;
  const Vec3 a = lifted(o[first], building.height), b = lifted(o[first + 1], building.height);
  const Vec3 c = lifted(o[(first + 2) % 4], building.height), d = lifted(o[(first + 3) % 4], building.height);
  const Vec3 up{0, 0, building.rise};
  const Vec3 ridge_bc = 0.5 * (b + c) + up, ridge_da = 0.5 * (d + a) + up;
  append_quad(a, b, ridge_bc, ridge_da, roof);
  append_quad(c, d, ridge_da, ridge_bc, roof);
  for (const auto& [from, to, top] : {std::array{b, c, ridge_bc}, std::array{d, a, ridge_da}}) {
    const Index i = append_vertex(from, walls);
    append_vertex(to, walls);
    append_vertex(top, walls);
    walls.triangles.push_back({i, i + 1, i + 2});
  }
}

}  // namespace

double signed_area(const std::vector<PlanPoint>& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += turn(polygon[0], polygon[i - 1], polygon[i]);
  return 0.5 * twice;
}

std::vector<std::array<std::uint32_t, 3>> fill(const std::vector<PlanPoint>& outline) {
  std::vector<Index> left(outline.size());
  std::iota(left.begin(), left.end(), Index{0});
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() >= 3) {
    const std::size_t n = left.size();
    std::size_t best = n;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      const double diagonal = distance2(outline[left[(i + n - 1) % n]], outline[left[(i + 1) % n]]);
      if (diagonal < shortest && is_ear(outline, left, i)) {
        best = i;
        shortest = diagonal;
      }
    }
    if (best == n) return {};
    triangles.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

void append_building(const Building& building, SceneDescription& scene) {
  GRIMALDI_EXPECT(building.outline.size() >= 3 && signed_area(building.outline) > 0 && building.height > 0);
  GRIMALDI_EXPECT(building.courtyard.empty() || building.courtyard.size() == building.outline.size());
  MeshDescription walls{building.name + " walls", scene.name, building.wall_material, {}, {}, {}};
  MeshDescription roof{building.name + " roof", scene.name, building.roof_material, {}, {}, {}};
  append_walls(building.outline, building.height, walls);
  if (!building.courtyard.empty()) {
    append_walls({building.courtyard.rbegin(), building.courtyard.rend()}, building.height, walls);
    append_ring_roof(building, roof);
  } else if (building.rise > 0) {
    append_gabled_roof(building, walls, roof);
  } else {
    append_flat_roof(building.outline, building.height, roof);
  }
  scene.meshes.push_back(std::move(walls));
  scene.meshes.push_back(std::move(roof));
}

void append_sheet(const std::vector<double>& us, const std::vector<double>& vs, const Vec3& origin, const Vec3& a,
                  const Vec3& b, const SheetCuts& cuts, MeshDescription& mesh) {
  GRIMALDI_EXPECT(us.size() >= 2 && vs.size() >= 2);
  const auto first = static_cast<Index>(mesh.vertices.size());
  const auto columns = static_cast<Index>(us.size()), rows = static_cast<Index>(vs.size());
  const auto at = [&](Index column, Index row) { return first + row * columns + column; };
  for (double v : vs) {
    for (double u : us) mesh.vertices.push_back(origin + u * a + v * b);
  }
  for (Index row = 0; row + 1 < rows; ++row) {
    for (Index column = 0; column + 1 < columns; ++column) {
      mesh.triangles.push_back({at(column, row), at(column + 1, row), at(column + 1, row + 1)});
      mesh.triangles.push_back({at(column, row), at(column + 1, row + 1), at(column, row + 1)});
    }
  }
  for (Index column = 0; column + 1 < columns; ++column) {
    if (cuts.low_v) mesh.artificial_edges.push_back({at(column, 0), at(column + 1, 0)});
    if (cuts.high_v) mesh.artificial_edges.push_back({at(column, rows - 1), at(column + 1, rows - 1)});
  }
  for (Index row = 0; row + 1 < rows; ++row) {
    if (cuts.low_u) mesh.artificial_edges.push_back({at(0, row), at(0, row + 1)});
    if (cuts.high_u) mesh.artificial_edges.push_back({at(columns - 1, row), at(columns - 1, row + 1)});
  }
}

std::vector<double> equal_cuts(double from, double to, double longest) {
  GRIMALDI_EXPECT(from < to && longest > 0);
  const auto pieces = static_cast<int>(std::ceil((to - from) / longest));
  std::vector<double> ends;
  for (int i = 0; i < pieces; ++i) ends.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
  ends.push_back(to);
  return ends;
}

std::vector<double> symmetric_cuts(double half, double longest) {
  GRIMALDI_EXPECT(half > 0 && longest > 0);
  const auto pieces = static_cast<int>(std::ceil(half / longest));
  std::vector<double> ends;
  for (int i = -pieces; i <= pieces; ++i) ends.push_back(half * (static_cast<double>(i) / pieces));
  return ends;
}

MeshDescription ground_sheet(const PlanPoint& low, const PlanPoint& high, const std::string& material) {
  constexpr double longest_cell = 150;  // m
  MeshDescription ground{"ground", {}, material, {}, {}, {}};
  append_sheet(equal_cuts(low.x, high.x, longest_cell), equal_cuts(low.y, high.y, longest_cell), {}, {1, 0, 0},
               {0, 1, 0}, {true, true, true, true}, ground);
  return ground;
}

}  // namespace grimaldi
