#pragma once
// The scene that a request names.

#include "core/contract.h"
#include "propagation/plan_file.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Reads the request's file or makes its built-in scene, and builds it with the request's materials. After an error in
/// the scene (those of the request do not count) it may have no triangles; it can be held against a plan only if it has
/// some. Errors and warnings to `diagnostics`: as `read_scene_file`, `canonical_scene` and `build_scene` say them, and
/// a warning for a material of the request that no face of the scene has.
Scene make_scene(const PlanDescription& request, Diagnostics& diagnostics);

}  // namespace grimaldi
