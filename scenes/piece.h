#pragma once
// Connected pieces of surface: which way they are wound, and which of them have an inside.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/edge_table.h"

namespace grimaldi {

enum class PieceKind : std::uint8_t {
  solid,  ///< has an inside: closed, or open only at its foot
  level,  ///< a sheet that is nearly flat and horizontal
  sheet,  ///< anything else: both sides are outside
};

/// True if an edge of two triangles is no join but two rims that touch: wound alike and folded onto each other (within
/// 5°), as the party walls of two houses without floors that share the line of their feet.
bool is_touch(const std::vector<Vec3>& vertices, const EdgeTable& table, const Edge& edge);

/// Pieces joined by edges of exactly two triangles that do not merely touch. A piece's number is the rank of its
/// smallest triangle.
struct Pieces {
  std::vector<std::uint32_t> triangle_piece;
  /// Wound against the piece's smallest triangle, as far as a consistent winding exists.
  std::vector<std::uint8_t> triangle_turned;
  std::vector<PieceKind> kind;
  /// +1: the smallest triangle's normal points outward (upward for level), −1: inward, 0: not known.
  std::vector<std::int8_t> outward;
};

/// Finds the pieces and judges them.
/// Has an inside: the volume that the surface encloses above the piece's lowest point, ∫ (z − z_low) n_z dS (it needs
/// no floor; walls add nothing), is not zero, and no less than 0.6 of its free rim (edges of one triangle, and touches)
/// is foot: less steep than 45°, with the surface rising from it by more than 10°. A fence or a tube has at most half
/// of its rim as foot, a canopy none; houses with holes have more (in Munich and Paris 0.68 and up).
/// Level: horizontal projection at least 0.9 of the area (slopes up to 25°).
/// `outward` is the sign of that volume or projection.
Pieces find_pieces(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const EdgeTable& table);

}  // namespace grimaldi
