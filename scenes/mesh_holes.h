#pragma once
// The open rims of a soup of triangles: all of them, and those that are no part of a city as cities are drawn.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/edge_table.h"

namespace grimaldi {

/// The number of boundary loops that run along at least one edge of a single triangle. The rim of a sheet, the open
/// foot of a building and a hole in a wall are one loop each. Where three and more triangles meet, or two of opposite
/// winding, the surface is cut first (vertices doubled), since OpenMesh knows manifold surfaces only; a loop along such
/// cuts alone does not count.
std::size_t count_holes(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                        const EdgeTable& table);

/// Edges of one triangle at which a surface ends in the open: of sheets (screens, canopies) and of holes in solids.
struct OpenRims {
  std::size_t count = 0;  ///< chains of such edges that hang together
  double length = 0;      ///< m
};

/// Finds them. Not open: an artificial edge (pairs of vertices, in any order), the rim of the ground (where it ends the
/// file ends), the foot of a solid, and what lies on another surface within 1 cm (the rim of a wall on a roof that is
/// cut elsewhere).
OpenRims find_open_rims(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                        const std::vector<std::array<std::uint32_t, 2>>& artificial_edges);

}  // namespace grimaldi
