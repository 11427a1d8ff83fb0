#pragma once
// grimaldi scene: what the program sees in a scene.

#include <string>

#include "cli/arguments.h"
#include "core/contract.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The scene as one JSON object, keys by contract; besides: name, ground, patches, open_rims, filled, propagating,
/// warnings.
std::string scene_json(const Scene& scene, const std::vector<Diagnostic>& warnings);

/// The same for people, as a table.
std::string scene_table(const Scene& scene);

/// Reads the scene of `arguments.input` (a built-in name or a file), with options that set keys of [scene] and
/// [[material]], and prints it. Returns the exit code 0; throws
/// InputErrors.
int scene_verb(const Arguments& arguments);

}  // namespace grimaldi
