#pragma once
// Wedges that are pieces of one straight edge become one.

#include <vector>

#include "scenes/wedge.h"

namespace grimaldi {

/// A wedge along one edge of the mesh, with the triangles at whose rim it lies.
struct WedgePiece {
  Wedge wedge;
  std::vector<std::uint32_t> triangles;
};

/// Merges pieces of one line between the same patches with the same sector (within 0.5°): those within 1 mm of the line
/// of the longest that abut or overlap (within 1 mm), and those within `contact_distance` that lie alongside it (the
/// same edge found on two solids that touch). Faces are put in the order patch0 ≤ patchn first. The result is ordered
/// by the first piece of each.
std::vector<WedgePiece> merge_pieces(std::vector<WedgePiece> pieces);

}  // namespace grimaldi
