#include "scenes/scene_file.h"

#include <algorithm>
#include <exception>

#include "scenes/file_contents.h"
#include "scenes/mesh_file.h"
#include "scenes/mitsuba_file.h"

namespace grimaldi {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

SceneDescription dispatch(const std::filesystem::path& file, const std::string& ending, Diagnostics& diagnostics) {
  if (ending == ".xml") return read_mitsuba(file, diagnostics);
  SceneDescription scene;
  scene.name = file.string();
  if (ending == ".ply") {
    scene.meshes.push_back(read_ply(file, diagnostics));
  } else {
    scene.meshes = read_with_assimp(file, diagnostics);
  }
  return scene;
}

bool has_triangles(const SceneDescription& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                     [](const MeshDescription& mesh) { return !mesh.triangles.empty(); });
}

}  // namespace

const std::vector<std::string>& scene_file_endings() {
  static const std::vector<std::string> endings = {".xml", ".ply", ".obj", ".stl", ".glb", ".gltf"};
  return endings;
}

SceneDescription read_scene_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.name = file.string();
  if (const std::optional<FileFault> fault = file_fault(file)) {
    diagnostics.error(scene.name, 0, {}, fault->problem, fault->why, fault->suggestion);
    return scene;
  }
  const std::string ending = lower_case(file.extension().string());
  const std::vector<std::string>& known = scene_file_endings();
  if (std::find(known.begin(), known.end(), ending) == known.end()) {
    std::string list;
    for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
    diagnostics.error(scene.name, 0, {}, ending.empty() ? "a name without ending" : "unknown ending \"" + ending + "\"",
                      "the ending of the name tells the format", "known: " + list);
    return scene;
  }
  const std::size_t faults_before = diagnostics.all().size();
  try {
    scene = dispatch(file, ending, diagnostics);
  } catch (const std::exception& error) {  // out of memory; the readers report what is wrong in a file themselves
    diagnostics.error(scene.name, 0, {}, "could not be read", error.what());
    return scene;
  }
  const auto& all = diagnostics.all();
  const bool failed = std::any_of(all.begin() + static_cast<std::ptrdiff_t>(faults_before), all.end(),
                                  [](const Diagnostic& one) { return one.severity == Severity::error; });
  if (!failed && !has_triangles(scene)) {
    diagnostics.error(scene.name, 0, {}, "the scene has no triangles", "there is nothing for a wave to meet",
                      "check what was exported");
  }
  return scene;
}

}  // namespace grimaldi
