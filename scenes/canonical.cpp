#include "scenes/canonical.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/constants.h"
#include "scenes/demo_city.h"
#include "scenes/shapes.h"

namespace grimaldi {
namespace {

constexpr double longest_piece = 200;  // m; see the header
constexpr Vec3 east{1, 0, 0}, north{0, 1, 0}, up{0, 0, 1};

/// The checked parameters of one scene: every name of its table has a value.
using Values = std::map<std::string, double>;

void half_plane(const Values& p, SceneDescription& scene) {
  MeshDescription screen{"screen", scene.name, "metal", {}, {}, {}};
  append_sheet(symmetric_cuts(p.at("length") / 2, longest_piece), equal_cuts(-p.at("depth"), 0, longest_piece), {},
               north, up, {true, true, true, false}, screen);
  scene.meshes.push_back(std::move(screen));
}

void strip(const Values& p, SceneDescription& scene) {
  MeshDescription screen{"screen", scene.name, "metal", {}, {}, {}};
  const double half = p.at("width") / 2;
  append_sheet(symmetric_cuts(p.at("length") / 2, longest_piece), equal_cuts(-half, half, longest_piece), {}, north, up,
               {true, true, false, false}, screen);
  scene.meshes.push_back(std::move(screen));
}

void slit(const Values& p, SceneDescription& scene) {
  const double half = p.at("width") / 2, depth = p.at("depth");
  const std::vector<double> along = symmetric_cuts(p.at("length") / 2, longest_piece);
  MeshDescription lower{"lower screen", scene.name, "metal", {}, {}, {}};
  MeshDescription upper{"upper screen", scene.name, "metal", {}, {}, {}};
  append_sheet(along, equal_cuts(-half - depth, -half, longest_piece), {}, north, up, {true, true, true, false}, lower);
  append_sheet(along, equal_cuts(half, half + depth, longest_piece), {}, north, up, {true, true, false, true}, upper);
  scene.meshes.push_back(std::move(lower));
  scene.meshes.push_back(std::move(upper));
}

/// The end of the wedge at `y`: bands between the rows of the two faces, normal along +y if `outward_north`.
void append_wedge_end(const std::vector<double>& rows, double y, double sine, double cosine, bool outward_north,
                      MeshDescription& mesh) {
  const auto append_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (outward_north) std::swap(b, c);
    mesh.triangles.push_back({a, b, c});
  };
  const auto apex = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({0, y, 0});
  for (std::size_t i = 1; i < rows.size(); ++i) {
    mesh.vertices.push_back({-sine * rows[i], y, -cosine * rows[i]});
    mesh.vertices.push_back({sine * rows[i], y, -cosine * rows[i]});
  }
  append_triangle(apex, apex + 1, apex + 2);
  for (std::uint32_t west = apex + 1; west + 2 < mesh.vertices.size(); west += 2) {
    append_triangle(west, west + 2, west + 3);
    append_triangle(west, west + 3, west + 1);
  }
}

void wedge(const Values& p, SceneDescription& scene) {
  const double half_angle = p.at("interior_angle") / 2 * (pi / 180), depth = p.at("depth");
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  const std::vector<double> along = symmetric_cuts(p.at("length") / 2, longest_piece);
  const std::vector<double> down = equal_cuts(0, depth, longest_piece);
  std::vector<double> rising;  // the same rows from the foot to the edge, so that the normal points outward
  std::transform(down.rbegin(), down.rend(), std::back_inserter(rising), [](double r) { return -r; });
  MeshDescription solid{"wedge", scene.name, "metal", {}, {}, {}};
  append_sheet(along, down, {}, north, {-sine, 0, -cosine}, {true, true, false, true}, solid);
  append_sheet(along, rising, {}, north, {-sine, 0, cosine}, {true, true, true, false}, solid);
  append_sheet(along, {-sine * depth, sine * depth}, {0, 0, -cosine * depth}, north, east, {true, true, true, true},
               solid);
  append_wedge_end(down, along.front(), sine, cosine, false, solid);
  append_wedge_end(down, along.back(), sine, cosine, true, solid);
  scene.meshes.push_back(std::move(solid));
}

/// The six faces of a box, normals outward or inward; its twelve edges are artificial.
void append_box(const Vec3& low, const Vec3& high, bool inward, MeshDescription& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  constexpr std::uint32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& face : faces) {
    std::uint32_t a = first + face[0], b = first + face[1], c = first + face[2], d = first + face[3];
    if (inward) std::swap(b, d);
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (std::uint32_t axis : {1u, 2u, 4u}) {
      if (!(i & axis)) mesh.artificial_edges.push_back({first + i, first + (i | axis)});
    }
  }
}

void box(const Values& p, SceneDescription& scene) {
  MeshDescription room{"box", scene.name, "concrete", {}, {}, {}};
  const Vec3 inner{p.at("width"), p.at("length"), p.at("height")};
  const double t = p.at("thick");
  append_box({}, inner, true, room);
  if (t > 0) append_box({-t, -t, -t}, inner + Vec3{t, t, t}, false, room);
  scene.meshes.push_back(std::move(room));
}

void street_canyon(const Values& p, SceneDescription& scene) {
  const double half = p.at("width") / 2, depth = p.at("depth"), length = p.at("length"), gap = p.at("gap");
  const double margin = p.at("margin"), count = p.at("count");
  const double west = -(count * length + (count - 1) * gap) / 2;
  scene.meshes.push_back(
      ground_sheet({west - margin, -half - depth - margin}, {-west + margin, half + depth + margin}, "concrete"));
  scene.meshes.back().file = scene.name;
  for (const auto& [row, low, high] :
       {std::tuple{"north ", half, half + depth}, std::tuple{"south ", -half - depth, -half}}) {
    for (int i = 0; i < count; ++i) {
      const double from = west + i * (length + gap), to = from + length;
      append_building({row + std::to_string(i + 1),
                       {{from, low}, {to, low}, {to, high}, {from, high}},
                       {},
                       p.at("height"),
                       0,
                       "brick",
                       "metal"},
                      scene);
    }
  }
}

struct Entry {
  std::string name;
  std::vector<CanonicalParameter> parameters;
  void (*build)(const Values&, SceneDescription&);
};

const std::vector<Entry>& entries() {
  constexpr CanonicalParameter length{"length", "m", 4000, 1, 20000}, width{"width", "m", 1, 0.05, 1000};
  static const std::vector<Entry> list = {
      {"demo-city", {}, [](const Values&, SceneDescription& scene) { scene = demo_city(); }},
      {"half-plane", {length, {"depth", "m", 4000, 1, 20000}}, half_plane},
      {"strip", {width, length}, strip},
      {"slit", {width, length, {"depth", "m", 2000, 1, 20000}}, slit},
      {"wedge", {{"interior_angle", "deg", 90, 1, 174.9}, length, {"depth", "m", 2000, 1, 20000}}, wedge},
      {"box",
       {{"width", "m", 10, 0.1, 1000},
        {"length", "m", 12, 0.1, 1000},
        {"height", "m", 8, 0.1, 1000},
        {"thick", "m", 0, 0, 100}},
       box},
      {"street-canyon",
       {{"height", "m", 20, 1, 500},
        {"depth", "m", 15, 1, 500},
        {"length", "m", 60, 1, 1000},
        {"width", "m", 20, 1, 500},
        {"count", "1", 4, 1, 100, true},
        {"gap", "m", 15, 0.5, 500},
        {"margin", "m", 50, 1, 10000}},
       street_canyon}};
  return list;
}

const Entry* find_entry(const std::string& name) {
  const auto& list = entries();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Entry& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

/// The shortest text that reads back as the same number.
std::string text(double value) { return fmt::format("{}", value); }

void check_value(const std::string& option, const CanonicalParameter& parameter, double value,
                 Diagnostics& diagnostics) {
  const std::string unit = parameter.unit == "1" ? "" : " " + std::string(parameter.unit);
  const std::string range = "give a value from " + text(parameter.low) + " to " + text(parameter.high) + unit +
                            " (default " + text(parameter.value) + ")";
  if (!std::isfinite(value)) {
    diagnostics.error({}, 0, option, "not a finite number", {}, range);
  } else if (value < parameter.low || value > parameter.high) {
    diagnostics.error({}, 0, option, text(value) + unit + " is out of range", {}, range);
  } else if (parameter.whole && value != std::floor(value)) {
    diagnostics.error({}, 0, option, text(value) + " is not a whole number", "it counts things", range);
  } else if (parameter.name == "thick" && value > 0 && value < 0.05) {
    diagnostics.error({}, 0, option, text(value) + unit + " is too thin for a wall",
                      "vertices nearer than 0.01 m become one", "give 0 for no outer shell, or at least 0.05 m");
  }
}

Values checked_values(const Entry& entry, const CanonicalParameters& given, Diagnostics& diagnostics) {
  Values values;
  std::vector<std::string> known;
  for (const CanonicalParameter& parameter : entry.parameters) {
    values[std::string(parameter.name)] = parameter.value;
    known.emplace_back(parameter.name);
  }
  for (const auto& [key, value] : given) {
    const std::string option = "scene.parameters." + key;
    const auto parameter = std::find_if(entry.parameters.begin(), entry.parameters.end(),
                                        [&](const CanonicalParameter& p) { return p.name == key; });
    if (parameter == entry.parameters.end()) {
      diagnostics.error({}, 0, option, "unknown parameter of " + entry.name, known.empty() ? "it takes none" : "",
                        known.empty() ? "leave it out" : did_you_mean(key, known));
    } else {
      check_value(option, *parameter, value, diagnostics);
      values[key] = value;
    }
  }
  return values;
}

}  // namespace

const std::vector<std::string>& canonical_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Entry& entry : entries()) list.push_back(entry.name);
    return list;
  }();
  return names;
}

std::vector<CanonicalParameter> canonical_parameters(const std::string& name) {
  const Entry* entry = find_entry(name);
  return entry ? entry->parameters : std::vector<CanonicalParameter>{};
}

SceneDescription canonical_scene(const std::string& name, const CanonicalParameters& parameters,
                                 Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.name = name;
  const Entry* entry = find_entry(name);
  if (!entry) {
    diagnostics.error({}, 0, "scene.builtin", "unknown built-in scene \"" + name + "\"", {},
                      did_you_mean(name, canonical_names()));
    return scene;
  }
  Diagnostics own;
  const Values values = checked_values(*entry, parameters, own);
  for (const Diagnostic& diagnostic : own.all()) diagnostics.add(diagnostic);
  if (!own.has_errors()) entry->build(values, scene);
  return scene;
}

}  // namespace grimaldi
