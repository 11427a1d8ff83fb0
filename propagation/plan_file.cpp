#include "propagation/plan_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "propagation/plan_options.h"
#include "propagation/plan_sections.h"
#include "propagation/scenario_reader.h"
#include "propagation/scenario_tree.h"
#include "propagation/sequence.h"
#include "scenes/canonical.h"
#include "scenes/file_contents.h"
#include "scenes/scene_file.h"

namespace grimaldi {
namespace {

using Kind = ScenarioNode::Kind;
namespace fs = std::filesystem;

// A scenario is a page or two of text; what is larger than this is another kind of file.
constexpr std::uintmax_t largest_scenario = 16u << 20;

std::optional<std::string> contents_of(const fs::path& file, Diagnostics& diagnostics) {
  std::error_code fault;
  const fs::file_status status = fs::status(file, fault);
  const auto refuse = [&](const char* problem, std::string why, const char* suggestion) {
    diagnostics.error(file.string(), 0, "", problem, std::move(why), suggestion);
    return std::nullopt;
  };
  if (!fs::exists(status))
    return refuse("no such file", "", "name a scenario (a TOML file), or give --scene, --frequency and --tx");
  if (fs::is_directory(status)) return refuse("not a file", "it is a folder", "name the scenario in it");
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) {
    // One byte more than the limit tells that there is more; a pipe has no size to ask for.
    text.resize(largest_scenario + 1);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) return refuse("cannot be read", "", "look at the permissions of the file");
  if (text.size() > largest_scenario) return refuse("not a scenario", "it is larger than 16 MiB", "");
  return text;
}

bool ends_with_one_of(const std::string& name, const std::vector<std::string>& endings) {
  std::string lower = name;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::any_of(endings.begin(), endings.end(),
                     [&](const std::string& ending) { return lower.ends_with(ending); });
}

void read_builtin_parameters(ScenarioReader& reader, const ScenarioNode& scene, PlanDescription& plan) {
  const ScenarioNode* parameters = reader.table(scene, "parameters");
  if (parameters == nullptr) return;
  if (scene.find("builtin") == nullptr)
    reader.fault(*parameters, "no built-in scene", "parameters belong to a built-in scene", "set scene.builtin");
  for (const auto& child : parameters->children) {
    // A parameter is a plain number, a length or an angle; which one, the scene's formula knows.
    Diagnostics trial;
    ScenarioReader quiet(reader.file(), trial);
    std::optional<double> value;
    if (child.kind != Kind::list && child.kind != Kind::table) {
      value = quiet.number(child, Dimension::length);
      if (!value) value = quiet.number(child, Dimension::angle);
      if (!value) value = quiet.number(child, Dimension::number);
    }
    if (!value) value = reader.number(child, Dimension::length);
    if (value) plan.builtin_parameters[child.key] = *value;
  }
}

void read_origin(ScenarioReader& reader, const ScenarioNode& scene, PlanDescription& plan) {
  const ScenarioNode* node = reader.table(scene, "origin");
  if (node == nullptr) return;
  reader.check_keys(*node, {"latitude", "longitude", "height", "bearing"});
  Origin origin;
  for (const char* key : {"latitude", "longitude"})
    if (node->find(key) == nullptr) reader.missing(*node, key, "an origin needs latitude and longitude in degrees", "");
  reader.read(*node, "latitude", Dimension::angle, {-90, 90}, origin.latitude);
  reader.read(*node, "longitude", Dimension::angle, {-180, 180}, origin.longitude);
  reader.read(*node, "height", Dimension::length, {}, origin.height);
  reader.read(*node, "bearing", Dimension::angle, {-360, 360}, origin.bearing);
  plan.origin = origin;
}

void read_scene_file_key(ScenarioReader& reader, ScenarioNode& node, const fs::path& folder, PlanDescription& plan) {
  static const std::vector<std::string> later = {".osm", ".osm.pbf", ".geojson", ".shp", ".gpkg"};
  const auto name = reader.text(node);
  if (!name) return;
  if (ends_with_one_of(*name, later))
    return reader.not_in_this_version(node, *name, fmt::format("known: {}", fmt::join(scene_file_endings(), ", ")));
  const fs::path file = (folder / *name).lexically_normal();
  std::error_code unknown;
  if (fs::is_directory(file, unknown))
    return reader.fault(node, "not a file", file.string() + " is a folder", "name the scene in it");
  if (const auto fault = file_fault(file)) {
    // A name without an ending may be that of a built-in scene, misspelt.
    const std::string built_in = file.has_extension() ? "" : did_you_mean(*name, canonical_names());
    return reader.fault(node, fault->problem, file.string() + ": " + fault->why,
                        built_in.starts_with("did you mean") ? built_in : fault->suggestion);
  }
  plan.scene_file = file;
  node.kind = Kind::text;
  node.text = fs::absolute(file).lexically_normal().string();
}

}  // namespace

void read_scene_section(ScenarioReader& reader, ScenarioNode& root, const fs::path& folder, PlanDescription& plan) {
  const char* how = "set scene.file = \"city.xml\" or scene.builtin = \"demo-city\", or give --scene";
  if (root.find("scene") == nullptr) return reader.missing(root, "scene", "a run needs a scene", how);
  if (reader.table(root, "scene") == nullptr) return;
  ScenarioNode& scene = *root.find("scene");
  reader.check_keys(scene, {"file", "builtin", "parameters", "material", "replace_materials", "origin"}, {"terrain"});
  ScenarioNode* file = scene.find("file");
  const ScenarioNode* builtin = scene.find("builtin");
  if (file != nullptr && builtin != nullptr) {
    reader.fault(*builtin, "two scenes", "scene.file and scene.builtin are both given", "keep one of them");
  } else if (file != nullptr) {
    read_scene_file_key(reader, *file, folder, plan);
  } else if (builtin != nullptr) {
    if (const auto name = reader.text(*builtin)) {
      const auto& names = canonical_names();
      if (std::find(names.begin(), names.end(), *name) == names.end()) {
        reader.fault(*builtin, "no such built-in scene", *name, did_you_mean(*name, names));
      } else {
        plan.builtin = *name;
      }
    }
  } else {
    reader.missing(scene, "file", "a run needs a scene", how);
  }
  read_builtin_parameters(reader, scene, plan);
  if (const ScenarioNode* node = scene.find("material"))
    if (const auto name = reader.text(*node)) plan.default_material = material_key(*name);
  if (const ScenarioNode* replace = reader.table(scene, "replace_materials"))
    for (const auto& child : replace->children)
      if (const auto name = reader.text(child))
        plan.replace_materials[child.key == "*" ? "*" : material_key(child.key)] = material_key(*name);
  read_origin(reader, scene, plan);
}

void read_propagation_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  const ScenarioNode* section = reader.table(root, "propagation");
  if (section == nullptr) return;
  reader.check_keys(*section, {"depth", "max_reflections", "max_diffractions", "mechanisms", "diffraction"});
  reader.read(*section, "depth", 0, static_cast<std::int64_t>(max_depth), plan.depth);
  reader.read(*section, "max_reflections", 0, 1000, plan.max_reflections);
  reader.read(*section, "max_diffractions", 0, 1000, plan.max_diffractions);
  using enum DiffractionModel;
  reader.read<DiffractionModel>(*section, "diffraction",
                                {{"fsd", fsd}, {"fsd-published", fsd_published}, {"utd", utd}, {"auto", automatic}},
                                plan.diffraction_model);
  const ScenarioNode* mechanisms = section->find("mechanisms");
  if (mechanisms == nullptr) return;
  plan.direct = plan.reflection = plan.diffraction = false;
  const auto take = [&](const ScenarioNode& node) {
    bool* const switches[] = {&plan.direct, &plan.reflection, &plan.diffraction};
    const auto index = reader.word(node, {"direct", "reflection", "diffraction"}, {"transmission", "scattering"});
    if (index) *switches[*index] = true;
  };
  if (mechanisms->kind == Kind::list) {
    if (mechanisms->children.empty())
      reader.fault(*mechanisms, "empty list", "no mechanism, no path", "leave the key out for all");
    for (const auto& child : mechanisms->children) take(child);
  } else {
    take(*mechanisms);
  }
}

void read_budget_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  const ScenarioNode* section = reader.table(root, "budget");
  if (section == nullptr) return;
  reader.check_keys(*section, {"rays", "accuracy", "time", "seed", "passes"});
  // A run of 1e12 rays takes weeks; what is more is a slip of the pen.
  reader.read(*section, "rays", Dimension::number, {1, 1e12}, plan.rays);
  const auto optional = [&](const char* key, Dimension dimension, const NumberRange& range,
                            std::optional<double>& target) {
    const ScenarioNode* node = section->find(key);
    if (node == nullptr) return;
    double value = range.low;
    reader.read(*section, key, dimension, range, value);
    target = value;
    if (section->find("rays") != nullptr)
      reader.fault(*node, "two budgets", "rays is given too", fmt::format("leave out rays or {}", key));
  };
  optional("accuracy", Dimension::ratio, {0.01, 100}, plan.accuracy);
  optional("time", Dimension::time, {1, 1e7}, plan.time);
  if (const ScenarioNode* seed = section->find("seed"))
    if (const auto value = reader.integer(*seed, 0, std::numeric_limits<std::int64_t>::max()))
      plan.seed = static_cast<std::uint64_t>(*value);
  // Two passes are the fewest that tell an error; the mask of the passes that found a path has 32 places.
  reader.read(*section, "passes", 2, 32, plan.passes);
}

PlanDescription read_scene_request(const std::string& scene, const std::vector<PlanOption>& options,
                                   Diagnostics& diagnostics) {
  PlanDescription plan;
  const auto& names = canonical_names();
  const bool built_in = std::find(names.begin(), names.end(), scene) != names.end();
  ScenarioNode root;
  lay_options(root, {{scene, built_in ? "scene.builtin" : "scene.file", scene}}, diagnostics);
  lay_options(root, options, diagnostics);
  ScenarioReader reader("", diagnostics);
  reader.check_keys(root, {"scene", "material"});
  read_scene_section(reader, root, {}, plan);
  read_materials(reader, root, {}, plan);
  return plan;
}

PlanDescription read_plan(const fs::path& file, const std::vector<PlanOption>& options, Diagnostics& diagnostics) {
  PlanDescription plan;
  plan.scenario_file = file;
  std::optional<ScenarioNode> root = ScenarioNode{};
  if (!file.empty()) {
    const auto text = contents_of(file, diagnostics);
    if (!text) return plan;
    if (ends_with_one_of(file.string(), scene_file_endings())) {
      diagnostics.error(file.string(), 0, "", "not a scenario", "it is a scene",
                        fmt::format("give it as --scene {}", file.string()));
      return plan;
    }
    root = parse_scenario(*text, file.string(), diagnostics);
    if (!root) return plan;
  }
  normalise_scenario(*root);
  lay_options(*root, options, diagnostics);

  ScenarioReader reader(file.string(), diagnostics);
  reader.check_keys(*root, {"scene", "wave", "transmitter", "source", "coverage", "receiver", "profile", "propagation",
                            "material", "budget"});
  const fs::path folder = file.parent_path();
  read_scene_section(reader, *root, folder, plan);
  const std::vector<std::size_t> user_order = read_wave_section(reader, *root, plan);
  read_transmitters(reader, *root, user_order, plan);
  read_receivers(reader, *root, plan);
  read_coverage_section(reader, *root, plan);
  read_profile_section(reader, *root, plan);
  read_propagation_section(reader, *root, plan);
  read_budget_section(reader, *root, plan);
  read_materials(reader, *root, folder, plan);
  plan.text = scenario_text(*root);
  return plan;
}

}  // namespace grimaldi
