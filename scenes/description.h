#pragma once
// Exactly what a scene file says, before anything is welded, repaired or judged.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"

namespace grimaldi {

/// What a scene file says of a material, e.g. Sionna's itu-radio-material. Names are normalised by `material_key`.
struct MaterialDescription {
  std::optional<double> thickness;              ///< m
  std::optional<double> relative_permittivity;  ///< of a material defined by numbers
  std::optional<double> conductivity;           ///< S/m
  /// Key of the built-in material that gives everything this one does not say; empty: the material's own key.
  std::string based_on{};
  friend bool operator==(const MaterialDescription&, const MaterialDescription&) = default;
};

struct MeshDescription {
  std::string name;
  std::string file;                                     ///< where it came from, for messages
  std::string material;                                 ///< key of the material; empty: the file names none
  std::vector<Vec3> vertices;                           ///< local east-north-up metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices, in the file's winding
  /// Index pairs of edges that do not diffract (the cut ends of a canonical shape that stands for an infinite one).
  std::vector<std::array<std::uint32_t, 2>> artificial_edges;
};

struct SceneDescription {
  std::string name;  ///< the file, or the name of the built-in scene
  std::vector<MeshDescription> meshes;
  std::map<std::string, MaterialDescription> materials;  ///< by key
};

}  // namespace grimaldi
