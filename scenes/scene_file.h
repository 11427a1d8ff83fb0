#pragma once
// One door for every file that holds a scene: the ending of the name chooses the reader.

#include <filesystem>
#include <string>
#include <vector>

#include "core/contract.h"
#include "scenes/description.h"

namespace grimaldi {

/// Reads .xml (Mitsuba/Sionna), .ply, .obj, .stl, .glb, .gltf. Coordinates as the file has them, taken as metres,
/// z up; glTF (y up by its standard) is turned to z up: (x, y, z) → (x, −z, y).
/// Faults go to `diagnostics` (file not there or not readable, unknown ending with the known ones named, malformed, NaN
/// or infinite vertex with its mesh and index, index out of range, zero triangles in the whole scene). Never throws for
/// bad content, never crashes, allocates no more than a small multiple of the file's size.
SceneDescription read_scene_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The endings that `read_scene_file` knows, with the dot.
const std::vector<std::string>& scene_file_endings();

}  // namespace grimaldi
