#pragma once
// The surfaces of a scene as the search for wedges asks for them.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/edge_table.h"
#include "scenes/triangle_tree.h"

namespace grimaldi {

/// Surfaces nearer to an edge than this touch it, m: the distance at which vertices are welded.
inline constexpr double contact_distance = 0.01;

/// Keeps references to what it is made of. Triangles without area are not allowed.
struct Surroundings {
  Surroundings(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
               const EdgeTable& table);

  /// True if `point` (m) is inside a solid or below ground: the surfaces on its vertical above it do not cancel (each
  /// counts +1 if it looks up, −1 if down). It needs no floors: a solid that is open at its foot ends at its lowest
  /// point.
  bool is_inside(const Vec3& point) const;

  const std::vector<Vec3>& vertices;
  const std::vector<std::array<std::uint32_t, 3>>& triangles;
  std::vector<Vec3> normal;         ///< unit, by the winding
  std::vector<std::uint8_t> solid;  ///< the triangle has a solid on its inner side
  /// The triangle is ground: of a level sheet with something above it that lies lowest (within 1 cm) or spans half of
  /// the scene. Where it ends the file ends, not the world: its rim does not diffract.
  std::vector<std::uint8_t> ground;
  std::vector<double> foot;  ///< height of the lowest point of the piece to which the triangle belongs, m
  TriangleTree tree;
};

}  // namespace grimaldi
