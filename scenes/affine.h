#pragma once
// Affine maps of space: where a file puts a mesh.

#include <array>

#include "core/vector.h"
#include "scenes/description.h"

namespace grimaldi {

/// p → A p + t; each row holds a row of A, then its entry of t.
struct Affine {
  std::array<std::array<double, 4>, 3> row = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3 operator()(const Vec3& point) const;
  /// det A; negative if the map mirrors.
  double determinant() const;
};

/// The map that does `first`, then `next`.
Affine then(const Affine& first, const Affine& next);

/// Turns by `angle` rad about the unit vector `axis`, counter-clockwise as seen from its tip (Rodrigues' formula).
Affine rotation(const Vec3& axis, double angle);

/// Maps the vertices of the mesh; a mirroring map also reverses the winding, so that fronts stay fronts.
void transform(MeshDescription& mesh, const Affine& map);

/// Index of the first vertex with a NaN or infinite coordinate, or the number of vertices.
std::size_t first_not_finite(const MeshDescription& mesh);

}  // namespace grimaldi
