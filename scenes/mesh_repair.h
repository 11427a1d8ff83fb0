#pragma once
// From the meshes of a description to one clean soup of triangles over the whole scene.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"
#include "scenes/description.h"

namespace grimaldi {

struct Defects {
  std::size_t degenerate = 0;          ///< triangles dropped: two corners welded, or height below 1e-6 m
  std::size_t duplicate = 0;           ///< triangles dropped: same three corners as an earlier one, in any winding
  std::size_t non_manifold_edges = 0;  ///< edges of three and more triangles
  std::size_t holes = 0;               ///< boundary loops (OpenMesh, per component)
  std::size_t flipped = 0;             ///< triangles whose winding was reversed
};

struct RepairedMesh {
  std::vector<Vec3> vertices;                           ///< welded over the whole scene, across meshes and materials
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< outward winding where an inside is known
  std::vector<std::uint32_t> triangle_mesh;             ///< index of the mesh in the description
  std::vector<std::array<std::uint32_t, 2>> artificial_edges;
  Defects defects;
};

/// Welds vertices nearer than `weld_distance` m (each to the first of its cluster, in the order of the file; the result
/// does not depend on threads), drops degenerate and duplicate triangles, orients each component (pieces joined by
/// edges of exactly two triangles, see scenes/piece.h) consistently with outward normals: by the sign of the volume
/// under it for what has an inside (closed, or open only at its foot), upward for a sheet that is nearly flat and
/// horizontal (ground), else as the file has it by majority of area. A closed piece inside another counts as a solid of
/// its own, not as a hollow. Source: CGAL's polygon soup (duplicates) and OpenMesh (boundary loops); the
/// orientation is our own, since CGAL's doubles the vertices where more than two triangles meet.
/// Valid: finite coordinates, indices within the mesh, as the readers guarantee.
RepairedMesh repair(const SceneDescription& description, double weld_distance = 0.01);

}  // namespace grimaldi
