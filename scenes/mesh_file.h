#pragma once
// Meshes in PLY, OBJ, STL and glTF.

#include <filesystem>
#include <vector>

#include "core/contract.h"
#include "scenes/description.h"

namespace grimaldi {

/// PLY, ascii and binary of both byte orders, coordinates float or double (kept in double); polygons are cut into fans;
/// other properties and elements are passed over. One mesh. The header's counts are held against the size of the
/// file before anything is allocated.
/// Faults to `diagnostics`: as `read_scene_file`. Warnings: no faces, faces of fewer than three corners (passed over),
/// polygons that are not convex (a fan covers some area twice), bytes after the last element. Returns a mesh without
/// triangles if the file is not usable.
MeshDescription read_ply(const std::filesystem::path& file, Diagnostics& diagnostics);

/// OBJ, STL and glTF (.glb, .gltf) through assimp; one mesh per object and material, material named as in the file
/// (`material_key` of it; a material library named by mtllib is not opened). glTF nodes are applied and z is up.
/// OBJ and glTF are held against themselves and made plain first (plain_obj.h, plain_gltf.h): assimp meets sound files.
/// Warnings: no faces, points and lines (passed over).
/// assimp keeps coordinates in single precision: a warning says so (with the loss in metres) when a coordinate exceeds
/// 1e4 m.
std::vector<MeshDescription> read_with_assimp(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace grimaldi
