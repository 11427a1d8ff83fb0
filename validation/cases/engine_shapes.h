#pragma once
// Solids that the cases put before the engine and that the program has no name for.

#include <vector>

#include "core/vector.h"
#include "scenes/description.h"

namespace grimaldi {

/// A wedge whose edge is the z axis, |z| ≤ half_height; face 0 is y = 0, x ≥ 0, the other one lies at the azimuth nπ,
/// free space between them. Two sheets (n = 2: one) of metal with normals into the free space; all rims but the edge
/// are artificial. So vertical polarisation is the soft case of a perfect conductor, horizontal the hard one. Inputs:
/// n 1.03 … 2; m, > 0.
SceneDescription upright_wedge(double n, double face, double half_height);

/// A building of endless depth: from ≤ x ≤ from + width, z ≤ top. m.
struct DeepBlock {
  double from, width, top;
};

/// Such buildings along y, |y| ≤ half, cut off at z = −depth; metal, open below; rims at the ends and below artificial.
/// Source and receivers in the plane y = 0 see what a line source and its receivers see in two dimensions.
SceneDescription deep_blocks(const std::vector<DeepBlock>& blocks, double depth, double half);

/// A metal plate in the plane x = 0, |y| ≤ wide/2, |z| ≤ high/2, normal +x. m.
SceneDescription upright_plate(double wide, double high);

/// A metal screen in the plane x = 0, |y|, |z| ≤ half, normal +x, with a hole |y| ≤ wide/2, |z| ≤ high/2; its outer rim
/// artificial. m.
SceneDescription upright_screen_with_hole(double half, double wide, double high);

/// A closed metal box, normals outward. m.
SceneDescription closed_box(const Vec3& low, const Vec3& high);

}  // namespace grimaldi
