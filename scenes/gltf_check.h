#pragma once
// Holds a glTF file against what its own numbers promise, before assimp, which trusts them, reads it.

#include <filesystem>
#include <string>
#include <string_view>

#include "core/contract.h"

namespace grimaldi {

/// True if `file` (.gltf or .glb, version 2) is sound: JSON nested at most 64 deep; every buffer as long as it says,
/// in the file or beside it; every buffer view within its buffer and every accessor within its view; positions of three
/// floats, attributes as long as them, indices of whole numbers; nodes that form trees at most 500 deep; all primitives
/// together at most 10⁸ vertices and indices. Else false after an error to `diagnostics`, also for what is not read:
/// compressed, quantised or sparse data, skins, glTF 1. (Whether indices are in range is for the reader of the meshes
/// to check.) Source: Khronos, glTF 2.0 Specification (2021), sections 3.5, 3.6 and 4.4.
bool gltf_is_sound(const std::filesystem::path& file, Diagnostics& diagnostics);

/// A name with %20 and its like (RFC 3986, section 2.1) replaced by the bytes they stand for.
std::string percent_decoded(std::string_view name);

}  // namespace grimaldi
