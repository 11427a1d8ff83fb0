#pragma once
// A scene ready for waves: one soup of triangles, its patches, its wedges. Const after build.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/contract.h"
#include "core/material.h"
#include "core/vector.h"
#include "scenes/description.h"
#include "scenes/mesh_holes.h"
#include "scenes/mesh_repair.h"
#include "scenes/patch.h"
#include "scenes/wedge.h"

namespace grimaldi {

struct Scene {
  std::string name;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_material;  ///< index into materials
  std::vector<Material> materials;               ///< those that occur
  Patches patches;
  Wedges wedges;
  Defects defects;
  OpenRims open_rims;
  Vec3 low, high;                 ///< extent
  double ground = 0;              ///< height of the lowest surface, m (0 for a scene without triangles)
  std::uint64_t fingerprint = 0;  ///< FNV-1a over vertices, triangles, materials: tells scenes apart
  /// True if the triangle is ground (in the lowest plane z = ground within 1 cm, looking straight up, unlike the floor
  /// of a solid): not part of a solid.
  std::vector<std::uint8_t> triangle_is_ground;
};

/// How the user wants the materials of a scene taken.
struct MaterialChoice {
  std::string default_material = "concrete";   ///< for faces that name none
  std::map<std::string, std::string> replace;  ///< key → key; "*" = every other
  std::map<std::string, Material> overrides;   ///< the scenario's [[material]] tables by key
};

/// Repairs, finds patches and wedges, resolves materials: scenario over scene file over built-in table. A material that
/// the file bases on another (MaterialDescription::based_on) takes from that one, as the scenario or the table has it,
/// what the file does not say.
/// Errors to `diagnostics`: unknown material (with did you mean; concrete stands in for it, so that the scene can be
/// held against a plan all the same), no triangles or a vertex beyond 1e8 m (the scene is empty then). Warnings: faces
/// without material, defects found, open rims.
Scene build_scene(const SceneDescription& description, const MaterialChoice& choice, Diagnostics& diagnostics);

}  // namespace grimaldi
