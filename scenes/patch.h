#pragma once
// Coplanar pieces of surface: what a specular reflection sees as one mirror.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"

namespace grimaldi {

/// A flat piece of one material. Points x of it satisfy dot(normal, x) = offset to within 1 mm (usually the rounding of
/// the file).
struct Patch {
  Vec3 normal;    ///< unit; outward where an inside is known
  double offset;  ///< m
  std::uint32_t material;
  double area;     ///< m²
  Vec3 low, high;  ///< bounding box
};

struct Patches {
  std::vector<Patch> patches;
  std::vector<std::uint32_t> triangle_patch;  ///< patch of each triangle
};

/// Triangles of one material that lie in one plane (every vertex of the smaller within 1 mm of the plane of the larger,
/// normals within 0.2° or opposite with the same tolerance) and touch or overlap (share a welded vertex, or their boxes
/// grown by 1 mm meet and they overlap in the plane) form one patch, so that surfaces laid upon each other count once.
/// The id of a patch is the rank of its smallest triangle index: it depends on the scene alone. The plane is that of
/// the patch's largest triangle, refined by the area-weighted vertices of all. A patch whose vertices leave the plane
/// by more than 2 mm (drift along a curve) is cut into its triangles.
Patches find_patches(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                     const std::vector<std::uint32_t>& triangle_material);

}  // namespace grimaldi
