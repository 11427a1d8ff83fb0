#pragma once
// OBJ files as text: held against themselves and made plain before assimp reads them.

#include <optional>
#include <string>
#include <string_view>

#include "core/contract.h"

namespace grimaldi {

/// The lines of `text`, the contents of the OBJ `file` (its name, for messages), that tell of shape and material: v, f,
/// l, p, o, g and usemtl, one on a line, words between single blanks, corners as positive vertex indices. assimp loses
/// indented lines, stumbles over comments behind a face, opens whatever mtllib names, and gives the faces before the
/// first usemtl the next material: so mtllib is left out and a first usemtl `no_material` added.
/// Error to `diagnostics` with the line at fault, and nothing returned: a vertex without three finite numbers; a corner
/// that names a vertex, texture point or normal that is not there (1 … count, or −1 … −(count so far)).
/// Source: Wavefront, Object Files (.obj), Advanced Visualizer manual, appendix B.
std::optional<std::string> plain_obj(std::string_view text, const std::string& no_material, const std::string& file,
                                     Diagnostics& diagnostics);

}  // namespace grimaldi
