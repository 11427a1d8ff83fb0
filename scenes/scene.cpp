#include "scenes/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

namespace grimaldi {
namespace {

/// The materials of a scene, made as they are asked for.
class MaterialTable {
 public:
  MaterialTable(const SceneDescription& description, const MaterialChoice& choice, Diagnostics& diagnostics)
      : description_(description), choice_(choice), diagnostics_(diagnostics) {
    for (const auto& [key, material] : built_in_materials()) known_.insert(key);
    for (const auto& [key, material] : choice.overrides) known_.insert(key);
    for (const auto& [key, given] : description.materials) {
      if (given.relative_permittivity || !given.based_on.empty()) known_.insert(key);
    }
  }

  /// The index of the material of faces that the file calls `key` (nothing: the file names none).
  std::uint32_t index_of(const std::string& key) {
    const std::string own = key.empty() ? material_key(choice_.default_material) : key;
    seen_.insert(own);
    auto replaced = choice_.replace.find(own);
    if (replaced == choice_.replace.end()) replaced = choice_.replace.find("*");
    const std::string wanted = replaced == choice_.replace.end() ? own : material_key(replaced->second);
    if (const auto found = index_.find(wanted); found != index_.end()) return found->second;
    const auto index = static_cast<std::uint32_t>(materials_.size());
    index_[wanted] = index;
    materials_.push_back(make(wanted, own));
    return index;
  }

  /// Warns of replacements that met no face.
  void report_unused() const {
    for (const auto& [from, to] : choice_.replace) {
      if (from == "*" || seen_.contains(from)) continue;
      diagnostics_.warning(description_.name, 0, "",
                           fmt::format("nothing to replace: no face has the material \"{}\"", from), "",
                           did_you_mean(from, {seen_.begin(), seen_.end()}));
    }
  }

  std::vector<Material> take() { return std::move(materials_); }

 private:
  Material make(const std::string& key, const std::string& own) {
    if (const auto given = choice_.overrides.find(key); given != choice_.overrides.end()) {
      Material material = given->second;
      material.name = key;
      return material;
    }
    const auto given = description_.materials.find(key);
    const bool said = given != description_.materials.end();
    const std::string& base = said && !given->second.based_on.empty() ? given->second.based_on : key;
    const auto changed = choice_.overrides.find(base);
    const auto built_in = built_in_materials().find(base);
    Material material;
    if (changed != choice_.overrides.end()) {
      material = changed->second;
    } else if (built_in != built_in_materials().end()) {
      material = built_in->second;
    } else if (!said || !given->second.relative_permittivity) {
      diagnostics_.error(description_.name, 0, "", fmt::format("unknown material \"{}\"", base),
                         key != own    ? fmt::format("it replaces \"{}\"", own)
                         : base != key ? fmt::format("\"{}\" is based on it", key)
                                       : "neither the scenario nor the program's table has it, and the file gives no "
                                         "numbers",
                         did_you_mean(base, {known_.begin(), known_.end()}));
      material = built_in_materials().at("concrete");  // in its place, so that no other fault follows from this one
    }
    material.name = key;
    if (said) refine(material, given->second);
    return material;
  }

  /// What the file says goes over the table. A spectrum of one point holds at every frequency; which, does not matter.
  void refine(Material& material, const MaterialDescription& given) {
    constexpr double any_frequency = 1e9;
    const auto check = [&](std::optional<double> value, double least, bool open, std::string_view what) {
      if (!value || (open ? *value > least : *value >= least)) return value.has_value();
      diagnostics_.error(description_.name, 0, "", fmt::format("material \"{}\": {} {}", material.name, what, *value),
                         fmt::format("it must be {} {}", open ? "greater than" : "at least", least));
      return false;
    };
    if (check(given.thickness, 0, true, "thickness (m)")) material.thickness = *given.thickness;
    if (check(given.relative_permittivity, 1, false, "relative permittivity")) {
      material.permittivity = Spectrum{{any_frequency}, {*given.relative_permittivity}};
      if (!given.conductivity && material.radio.empty()) material.conductivity = Spectrum{{any_frequency}, {0.0}};
    }
    if (check(given.conductivity, 0, false, "conductivity (S/m)")) {
      material.conductivity = Spectrum{{any_frequency}, {*given.conductivity}};
    }
  }

  const SceneDescription& description_;
  const MaterialChoice& choice_;
  Diagnostics& diagnostics_;
  std::set<std::string> known_, seen_;
  std::map<std::string, std::uint32_t> index_;
  std::vector<Material> materials_;
};

/// FNV-1a, 64 bits. Source: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm",
/// draft-eastlake-fnv.
class Fingerprint {
 public:
  template <typename T>
  void add(T value) {
    for (const auto byte : std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value)) {
      hash_ = (hash_ ^ byte) * 0x100000001b3ull;
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }  // + 0.0 makes one zero of two
  void add(const Vec3& p) { add(p.x), add(p.y), add(p.z); }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) add(static_cast<std::uint8_t>(c));
  }
  void add(const std::optional<Spectrum>& spectrum) {
    add(static_cast<std::uint64_t>(spectrum ? spectrum->value.size() : 0));
    if (!spectrum) return;
    for (const double f : spectrum->frequency) add(f);
    for (const double v : spectrum->value) add(v);
  }
  void add(const Material& m) {
    add(m.name);
    for (const PermittivityRange& r : m.radio) {
      for (const double v : {r.a, r.b, r.c, r.d, r.from_GHz, r.to_GHz}) add(v);
    }
    add(m.permittivity);
    add(m.conductivity);
    add(m.thickness);
    add(m.absorption);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

std::uint64_t fingerprint(const Scene& scene) {
  Fingerprint print;
  print.add(static_cast<std::uint64_t>(scene.vertices.size()));
  for (const Vec3& p : scene.vertices) print.add(p);
  print.add(static_cast<std::uint64_t>(scene.triangles.size()));
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    for (const std::uint32_t v : scene.triangles[i]) print.add(v);
    print.add(scene.triangle_material[i]);
  }
  for (const Material& m : scene.materials) print.add(m);
  for (const Wedge& w : scene.wedges.wedges) print.add(w.start), print.add(w.length);  // edges may be artificial
  return print.value();
}

// Beyond it single precision, which rays are traced in, comes to its end: products of four lengths must stay below
// 1e38.
constexpr double farthest = 1e8;  // m

/// The greatest coordinate, m.
double reach_of(const std::vector<Vec3>& vertices) {
  double reach = 0;
  for (const Vec3& p : vertices) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return reach;
}

void measure(Scene& scene) {
  constexpr double lowest_plane = 0.01;  // m; see Scene::triangle_is_ground
  constexpr double vertical = 0.9998;    // cosine of 1°
  scene.low = scene.high = scene.vertices.front();
  for (const Vec3& p : scene.vertices) {
    scene.low = {std::min(scene.low.x, p.x), std::min(scene.low.y, p.y), std::min(scene.low.z, p.z)};
    scene.high = {std::max(scene.high.x, p.x), std::max(scene.high.y, p.y), std::max(scene.high.z, p.z)};
  }
  scene.ground = scene.low.z;
  for (const auto& t : scene.triangles) {
    const Vec3 &a = scene.vertices[t[0]], &b = scene.vertices[t[1]], &c = scene.vertices[t[2]];
    const Vec3 twice = cross(b - a, c - a);
    const bool low = std::max({a.z, b.z, c.z}) <= scene.ground + lowest_plane;
    scene.triangle_is_ground.push_back(low && twice.z >= vertical * norm(twice) ? 1 : 0);
  }
}

void report_rims(const std::string& file, const OpenRims& rims, Diagnostics& diagnostics) {
  if (rims.count == 0) return;
  diagnostics.warning(file, 0, "",
                      fmt::format("{} open rim{}, {:.1f} m", rims.count, rims.count == 1 ? "" : "s", rims.length),
                      "edges of sheets and of holes, neither on the ground nor at the foot of a solid",
                      "if a surface is missing there, mend the mesh");
}

void report_defects(const std::string& file, const Defects& defects, Diagnostics& diagnostics) {
  const auto warn = [&](std::size_t count, std::string_view what, std::string why) {
    if (count > 0) diagnostics.warning(file, 0, "", fmt::format("{} {}", count, what), std::move(why));
  };
  warn(defects.degenerate, "degenerate triangles left out", "corners within 1 cm of each other, or no height");
  warn(defects.duplicate, "duplicate triangles left out", "the same three corners as an earlier one");
  warn(defects.flipped, "triangles turned round", "their normal pointed inward, or against their neighbours'");
  warn(defects.non_manifold_edges, "edges of three and more triangles",
       "the sectors between them are judged one by one");
}

}  // namespace

Scene build_scene(const SceneDescription& description, const MaterialChoice& choice, Diagnostics& diagnostics) {
  Scene scene;
  scene.name = description.name;
  RepairedMesh mesh = repair(description);
  scene.defects = mesh.defects;
  if (mesh.triangles.empty()) {
    diagnostics.error(description.name, 0, "", "the scene has no triangles",
                      mesh.defects.degenerate > 0
                          ? fmt::format("all {} are degenerate: corners within 1 cm of each other, or no height",
                                        mesh.defects.degenerate)
                          : "",
                      mesh.defects.degenerate > 0 ? "are the coordinates in metres?" : "");
    return scene;
  }
  if (const double reach = reach_of(mesh.vertices); reach > farthest) {
    diagnostics.error(description.name, 0, "", fmt::format("a vertex lies {:.3g} m away", reach),
                      fmt::format("a scene reaches {:g} m at the most, 2.5 times round the Earth", farthest),
                      "are the coordinates in metres?");
    return scene;
  }
  scene.vertices = std::move(mesh.vertices);
  scene.triangles = std::move(mesh.triangles);

  MaterialTable table(description, choice, diagnostics);
  std::size_t unnamed = 0;
  constexpr auto unset = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> mesh_material(description.meshes.size(), unset);
  for (const std::uint32_t m : mesh.triangle_mesh) {
    const std::string& key = description.meshes[m].material;
    if (mesh_material[m] == unset) mesh_material[m] = table.index_of(key);
    scene.triangle_material.push_back(mesh_material[m]);
    unnamed += key.empty() ? 1 : 0;
  }
  table.report_unused();
  scene.materials = table.take();
  if (unnamed > 0) {
    diagnostics.warning(description.name, 0, "", fmt::format("{} triangles without a material", unnamed), "",
                        fmt::format("\"{}\" is used", scene.materials[table.index_of("")].name));
  }
  report_defects(description.name, scene.defects, diagnostics);

  measure(scene);
  scene.patches = find_patches(scene.vertices, scene.triangles, scene.triangle_material);
  scene.wedges =
      find_wedges(scene.vertices, scene.triangles, scene.triangle_material, scene.patches, mesh.artificial_edges);
  // Without a free rim there is no open one: most scenes are spared the search.
  if (scene.wedges.report.free_rims.count > 0)
    scene.open_rims = find_open_rims(scene.vertices, scene.triangles, mesh.artificial_edges);
  report_rims(description.name, scene.open_rims, diagnostics);
  scene.fingerprint = fingerprint(scene);
  return scene;
}

}  // namespace grimaldi
