#pragma once
// How many open rims a soup of triangles has.

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

}  // namespace grimaldi
