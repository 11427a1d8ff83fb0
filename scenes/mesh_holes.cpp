#include "scenes/mesh_holes.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "scenes/surroundings.h"
#include "scenes/wedge_sector.h"

namespace grimaldi {
namespace {

using Surface = OpenMesh::TriMesh_ArrayKernelT<>;

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  a = root(parent, a);
  b = root(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

/// Less steep than 45°, and the surface rises from it: what `find_pieces` takes for a foot.
bool is_foot(const EdgeSection& section) {
  constexpr double steepest = 0.71, least_rise = 0.17;  // sines of 45° and 10°
  return std::abs(section.direction.z) <= steepest && section.across.z > least_rise;
}

/// Metres of the edge along which no other surface touches it, or only its own in the direction of its face.
double open_length(EdgeSection& section) {
  constexpr double same_angle = 0.5 * pi / 180;  // vertices 1 cm off on a face one metre wide
  section.look_around();
  double length = 0;
  const auto& breaks = section.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i] + breaks[i + 1]);
    if (!section.has_others(middle) || section.is_one_sided(middle, same_angle)) length += breaks[i + 1] - breaks[i];
  }
  return length;
}

}  // namespace

std::size_t count_holes(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                        const EdgeTable& table) {
  // Corner 3 t + k of triangle t; corners of one vertex that hang together over manifold edges become one vertex.
  const auto corner = [&](std::uint32_t triangle, std::uint32_t vertex) {
    const auto& t = triangles[triangle];
    return 3 * triangle + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
  };
  std::vector<std::uint32_t> parent(3 * triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<std::uint8_t> single(3 * triangles.size(),
                                   0);  // the side from corner 3 t + k to the next has one triangle
  for (const Edge& edge : table.edges) {
    const EdgeUse& a = table.uses[edge.begin];
    if (edge.valence() == 1) single[corner(a.triangle, a.forward ? edge.vertex0 : edge.vertex1)] = 1;
    if (edge.valence() != 2) continue;
    const EdgeUse& b = table.uses[edge.begin + 1];
    if (a.forward == b.forward) continue;
    unite(parent, corner(a.triangle, edge.vertex0), corner(b.triangle, edge.vertex0));
    unite(parent, corner(a.triangle, edge.vertex1), corner(b.triangle, edge.vertex1));
  }
  // The sheets of a cut may still hang together at both of its ends: then the later triangles stand alone.
  std::vector<std::uint8_t> alone(triangles.size(), 0);
  for (const Edge& edge : table.edges) {
    for (std::uint32_t i = edge.begin + 1; i < edge.end; ++i) {
      const EdgeUse& later = table.uses[i];
      if (edge.valence() == 2 && table.uses[edge.begin].forward != later.forward) break;
      for (std::uint32_t j = edge.begin; j < i; ++j) {
        const EdgeUse& use = table.uses[j];
        if (root(parent, corner(use.triangle, edge.vertex0)) == root(parent, corner(later.triangle, edge.vertex0)) &&
            root(parent, corner(use.triangle, edge.vertex1)) == root(parent, corner(later.triangle, edge.vertex1))) {
          alone[later.triangle] = 1;
        }
      }
    }
  }

  Surface surface;
  std::vector<Surface::VertexHandle> shared(3 * triangles.size()), corners_of(3 * triangles.size());
  std::vector<std::uint32_t> face_triangle;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t own = 3 * t + k;
      Surface::VertexHandle& handle = alone[t] ? corners_of[own] : shared[root(parent, own)];
      if (!handle.is_valid()) {
        const Vec3& p = vertices[triangles[t][k]];
        handle = surface.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      }
      corners_of[own] = handle;
    }
    if (surface.add_face(corners_of[3 * t], corners_of[3 * t + 1], corners_of[3 * t + 2]).is_valid()) {
      face_triangle.push_back(t);
    }
  }

  std::vector<std::uint8_t> seen(surface.n_halfedges(), 0);
  std::size_t holes = 0;
  for (const auto start : surface.halfedges()) {
    if (!surface.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) continue;
    bool open = false;
    Surface::HalfedgeHandle side = start;
    do {
      seen[static_cast<std::size_t>(side.idx())] = 1;
      const auto inner = surface.opposite_halfedge_handle(side);
      const std::uint32_t t = face_triangle[static_cast<std::size_t>(surface.face_handle(inner).idx())];
      const auto from = surface.from_vertex_handle(inner);
      for (std::uint32_t k = 0; k < 3; ++k) open = open || (single[3 * t + k] != 0 && corners_of[3 * t + k] == from);
      side = surface.next_halfedge_handle(side);
    } while (side != start);
    holes += open ? 1 : 0;
  }
  return holes;
}

OpenRims find_open_rims(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                        const std::vector<std::array<std::uint32_t, 2>>& artificial_edges) {
  std::vector<std::array<std::uint32_t, 2>> artificial;
  for (const auto& [a, b] : artificial_edges) artificial.push_back({std::min(a, b), std::max(a, b)});
  std::sort(artificial.begin(), artificial.end());
  const EdgeTable table = make_edge_table(vertices.size(), triangles);
  const Surroundings surroundings(vertices, triangles, table);
  OpenRims rims;
  std::vector<std::uint32_t> parent(vertices.size()), ends;
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Edge& edge : table.edges) {
    if (edge.valence() != 1) continue;
    const std::uint32_t triangle = table.uses[edge.begin].triangle;
    if (surroundings.ground[triangle]) continue;
    if (std::binary_search(artificial.begin(), artificial.end(), std::array{edge.vertex0, edge.vertex1})) continue;
    EdgeSection section(surroundings, table, edge);
    if (surroundings.solid[triangle] && is_foot(section)) continue;
    const double length = open_length(section);
    if (length <= contact_distance) continue;
    rims.length += length;
    unite(parent, edge.vertex0, edge.vertex1);
    ends.push_back(edge.vertex0);
  }
  for (std::uint32_t& end : ends) end = root(parent, end);
  std::sort(ends.begin(), ends.end());
  rims.count = static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
  return rims;
}

}  // namespace grimaldi
