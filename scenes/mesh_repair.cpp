#include "scenes/mesh_repair.h"

#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/contract.h"
#include "scenes/edge_table.h"
#include "scenes/mesh_holes.h"
#include "scenes/piece.h"

namespace grimaldi {
namespace {

constexpr auto none = std::numeric_limits<std::uint32_t>::max();
constexpr double least_height = 1e-6;  // m, of a triangle; see Defects::degenerate

/// Welds points as they come: a hash table of cells twice the weld distance wide, each a list of the points kept in it.
class Welder {
 public:
  Welder(std::size_t expected, double weld_distance) : distance_(weld_distance) {
    first_.assign(std::bit_ceil(2 * expected + 16), none);
  }

  /// The number of the first point kept nearer than the weld distance; `point` itself is kept if there is none.
  std::uint32_t weld(const Vec3& point) {
    // A ball of the weld distance meets the cells next to the half of its own in which it lies: eight in all.
    const Cell own = cell(point);
    const Vec3 scaled = point / (2 * distance_);
    const auto side = [](double x) { return x - std::floor(x) < 0.5 ? -1.0 : 1.0; };
    const Cell step{side(scaled.x), side(scaled.y), side(scaled.z)};
    std::uint32_t best = none;
    for (int corner = 0; corner < 8; ++corner) {
      const Cell c{own[0] + (corner & 1 ? step[0] : 0), own[1] + (corner & 2 ? step[1] : 0),
                   own[2] + (corner & 4 ? step[2] : 0)};
      for (std::uint32_t i = first_[slot(c)]; i != none; i = next_[i]) {
        if (i < best && norm2(points_[i] - point) < distance_ * distance_) best = i;
      }
    }
    if (best != none) return best;
    const auto added = static_cast<std::uint32_t>(points_.size());
    std::uint32_t& head = first_[slot(own)];
    points_.push_back(point);
    next_.push_back(head);
    head = added;
    return added;
  }

  std::vector<Vec3>& points() { return points_; }

 private:
  using Cell = std::array<double, 3>;  // whole numbers; double since a file may hold any finite coordinate
  Cell cell(const Vec3& p) const {
    const double width = 2 * distance_;
    return {std::floor(p.x / width), std::floor(p.y / width), std::floor(p.z / width)};
  }
  /// Different cells may share a slot: the distance decides, not the cell.
  std::size_t slot(const Cell& c) const {
    std::uint64_t h = 0;
    for (const double i : c) {
      h = (h ^ std::bit_cast<std::uint64_t>(i + 0.0)) * 0x9e3779b97f4a7c15ull;  // + 0.0 makes one zero of two
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h) & (first_.size() - 1);
  }

  double distance_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> first_, next_;
};

/// A triangle that keeps its number while CGAL moves it about.
struct Face : std::array<std::uint32_t, 3> {
  std::uint32_t number = 0;
};

bool is_degenerate(const std::vector<Vec3>& vertices, const std::array<std::uint32_t, 3>& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  const Vec3 a = vertices[t[1]] - vertices[t[0]], b = vertices[t[2]] - vertices[t[0]], c = b - a;
  const double longest = std::sqrt(std::max({norm2(a), norm2(b), norm2(c)}));
  return norm(cross(a, b)) < least_height * longest;
}

void weld(const SceneDescription& description, double weld_distance, RepairedMesh& mesh) {
  std::size_t vertex_count = 0, triangle_count = 0;
  for (const MeshDescription& m : description.meshes) {
    vertex_count += m.vertices.size();
    triangle_count += m.triangles.size();
  }
  mesh.triangles.reserve(triangle_count);
  mesh.triangle_mesh.reserve(triangle_count);
  Welder welder(vertex_count, weld_distance);
  std::vector<std::uint32_t> welded;
  for (std::uint32_t i = 0; i < description.meshes.size(); ++i) {
    const MeshDescription& m = description.meshes[i];
    welded.clear();
    for (const Vec3& p : m.vertices) {
      GRIMALDI_EXPECT(is_finite(p));
      welded.push_back(welder.weld(p));
    }
    for (const auto& t : m.triangles) {
      const std::array<std::uint32_t, 3> corners{welded[t[0]], welded[t[1]], welded[t[2]]};
      if (is_degenerate(welder.points(), corners)) {
        ++mesh.defects.degenerate;
      } else {
        mesh.triangles.push_back(corners);
        mesh.triangle_mesh.push_back(i);
      }
    }
    for (const auto& e : m.artificial_edges) {
      const std::uint32_t a = std::min(welded[e[0]], welded[e[1]]), b = std::max(welded[e[0]], welded[e[1]]);
      if (a != b) mesh.artificial_edges.push_back({a, b});
    }
  }
  mesh.vertices = std::move(welder.points());
}

void drop_duplicates(RepairedMesh& mesh) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  std::vector<Face> faces(mesh.triangles.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    static_cast<std::array<std::uint32_t, 3>&>(faces[i]) = mesh.triangles[i];
    faces[i].number = i;
  }
  // Of each group the first one stays (a test holds this); the order is put right below.
  mesh.defects.duplicate = CGAL::Polygon_mesh_processing::merge_duplicate_polygons_in_polygon_soup(points, faces);
  if (mesh.defects.duplicate == 0) return;
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.number < b.number; });
  for (std::size_t i = 0; i < faces.size(); ++i) {
    mesh.triangles[i] = mesh.triangles[faces[i].number];
    mesh.triangle_mesh[i] = mesh.triangle_mesh[faces[i].number];
  }
  mesh.triangles.resize(faces.size());
  mesh.triangle_mesh.resize(faces.size());
}

/// Leaves out vertices that no triangle uses; the order of the others stays.
void drop_unused_vertices(RepairedMesh& mesh) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), none);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) number[v] = 0;
  }
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == none) continue;
    mesh.vertices[count] = mesh.vertices[v];
    number[v] = count++;
  }
  mesh.vertices.resize(count);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = number[v];
  }
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& e : mesh.artificial_edges) {
    if (number[e[0]] != none && number[e[1]] != none) edges.push_back({number[e[0]], number[e[1]]});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  mesh.artificial_edges = std::move(edges);
}

/// True for the triangles to be reversed.
std::vector<std::uint8_t> find_reversed(const RepairedMesh& mesh, const Pieces& pieces) {
  std::vector<double> kept(pieces.kind.size(), 0);  // area wound as the smallest triangle less area wound against it
  std::vector<std::uint8_t> reversed(mesh.triangles.size());
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const double area =
        norm(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    kept[pieces.triangle_piece[i]] += pieces.triangle_turned[i] ? -area : area;
  }
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    const std::uint32_t p = pieces.triangle_piece[i];
    const bool inward = pieces.outward[p] != 0 ? pieces.outward[p] < 0 : kept[p] < 0;
    reversed[i] = (pieces.triangle_turned[i] != 0) != inward;
  }
  return reversed;
}

}  // namespace

RepairedMesh repair(const SceneDescription& description, double weld_distance) {
  RepairedMesh mesh;
  weld(description, weld_distance, mesh);
  drop_duplicates(mesh);
  drop_unused_vertices(mesh);

  EdgeTable table = make_edge_table(mesh.vertices.size(), mesh.triangles);
  const std::vector<std::uint8_t> reversed = find_reversed(mesh, find_pieces(mesh.vertices, mesh.triangles, table));
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    if (!reversed[i]) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    ++mesh.defects.flipped;
  }
  for (EdgeUse& use : table.uses) use.forward = use.forward != (reversed[use.triangle] != 0);
  for (const Edge& edge : table.edges) mesh.defects.non_manifold_edges += edge.valence() > 2 ? 1 : 0;
  mesh.defects.holes = count_holes(mesh.vertices, mesh.triangles, table);
  return mesh;
}

}  // namespace grimaldi
