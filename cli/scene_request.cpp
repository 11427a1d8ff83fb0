#include "cli/scene_request.h"

#include <algorithm>

#include "scenes/canonical.h"
#include "scenes/scene_file.h"

namespace grimaldi {

Scene make_scene(const PlanDescription& request, Diagnostics& diagnostics) {
  Diagnostics faults;
  SceneDescription description;
  const bool named = !request.builtin.empty() || !request.scene_file.empty();
  if (!request.builtin.empty()) {
    description = canonical_scene(request.builtin, request.builtin_parameters, faults);
  } else if (named) {
    description = read_scene_file(request.scene_file, faults);
  }
  Scene scene;
  // Half a scene would have faults of its own, which are none of the user's.
  const bool whole = named && !faults.has_errors();
  if (whole) {
    const MaterialChoice choice{request.default_material, request.replace_materials, request.materials};
    scene = build_scene(description, choice, faults);
  }
  for (const Diagnostic& fault : faults.all()) diagnostics.add(fault);
  if (!whole) return scene;
  for (const auto& [key, material] : request.materials) {
    const auto same = [&, &name = key](const Material& used) { return used.name == name; };
    if (std::any_of(scene.materials.begin(), scene.materials.end(), same)) continue;
    std::vector<std::string> names;
    for (const auto& used : scene.materials) names.push_back(used.name);
    diagnostics.warning(request.scenario_file.string(), 0, "material." + key, "not used",
                        "no face of the scene is made of it", did_you_mean(key, names));
  }
  return scene;
}

}  // namespace grimaldi
