#pragma once
// glTF files held against themselves and made plain before assimp, which trusts their numbers, reads them.

#include <filesystem>
#include <optional>
#include <string>

#include "core/contract.h"

namespace grimaldi {

/// A binary glTF (.glb, version 2, all in one) with what `file` (.gltf or .glb, with the buffers beside it) says of
/// shape and material: the nodes of its scene with their transforms, the meshes with positions and indices, the names
/// of the materials. Cameras, lights, textures, animations, normals and the like are left out. Error to `diagnostics`,
/// and nothing returned: JSON nested more than 64 deep; a buffer shorter than it says or not there; a view beyond its
/// buffer, an accessor beyond its view; positions that are not three floats; an index out of range; corners that make
/// no whole triangles; nodes that form no trees or are nested more than 500 deep; more than 10⁸ vertices and indices
/// together; what is not read: compressed, quantised or sparse data, skins, instancing, glTF 1. Source: Khronos,
/// glTF 2.0 Specification (2021), sections 3.5 to 3.7 and 4.4.
std::optional<std::string> plain_gltf(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace grimaldi
