#include "scenes/mitsuba_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/material.h"
#include "scenes/affine.h"
#include "scenes/file_contents.h"
#include "scenes/mesh_file.h"

namespace grimaldi {
namespace {

constexpr int deepest_nesting = 64;
// A message for each of two thousand missing meshes helps nobody.
constexpr int most_missing_meshes = 10;

// Finite numbers between blanks and commas; nothing if a word is no such number.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view between = " \t\r\n,";
  for (std::size_t at = text.find_first_not_of(between); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, at), text.size());
    std::string_view word = text.substr(at, end - at);
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || stop != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    numbers.push_back(value);
    at = text.find_first_not_of(between, end);
  }
  return numbers;
}

bool is(const pugi::xml_node& node, const char* tag) { return std::strcmp(node.name(), tag) == 0; }

// Elements that are read, or passed over because they say nothing of where a surface is or what it is made of.
bool is_known_element(const pugi::xml_node& node) {
  static const std::set<std::string_view> tags = {"integrator", "sensor",  "camera",  "emitter", "sampler", "film",
                                                  "rfilter",    "texture", "medium",  "volume",  "phase",   "spectrum",
                                                  "rgb",        "string",  "integer", "float",   "boolean", "point",
                                                  "vector",     "default", "bsdf",    "shape",   "alias"};
  return tags.contains(node.name());
}

class MitsubaReader {
 public:
  MitsubaReader(const std::filesystem::path& file, Diagnostics& diagnostics)
      : path_(file), file_(file.string()), diagnostics_(diagnostics) {}

  SceneDescription read() {
    scene_.name = file_;
    const std::optional<std::string> contents = read_file_contents(path_, diagnostics_);
    if (!contents || !parse(*contents)) return std::move(scene_);
    const pugi::xml_node root = document_.document_element();
    for (const pugi::xml_node node : root.children()) read_declaration(node);
    for (const pugi::xml_node node : root.children("bsdf")) materials_.emplace(text(node, "id"), read_bsdf(node));
    for (const pugi::xml_node node : root.children("alias")) {
      if (const auto found = materials_.find(text(node, "id")); found != materials_.end()) {
        materials_.emplace(text(node, "as"), std::string(found->second));
      }
    }
    for (const pugi::xml_node node : root.children("shape")) read_shape(node);
    if (missing_meshes_ > most_missing_meshes) {
      error(0, {}, std::to_string(missing_meshes_ - most_missing_meshes) + " more meshes are not there");
    }
    for (const auto& [kind, seen] : passed_over_) {
      diagnostics_.warning(file_, seen.first_line, {}, kind + " is passed over",
                           std::to_string(seen.count) + " in this file; what it would add is missing from the scene",
                           "known shapes: ply, obj");
    }
    return std::move(scene_);
  }

 private:
  struct Seen {
    int first_line = 0, count = 0;
  };

  void error(int line, std::string option, std::string problem, std::string why = {}, std::string suggestion = {}) {
    diagnostics_.error(file_, line, std::move(option), std::move(problem), std::move(why), std::move(suggestion));
  }
  void pass_over(const pugi::xml_node& node, std::string kind) {
    Seen& seen = passed_over_[std::move(kind)];
    if (seen.count++ == 0) seen.first_line = line_of(node);
  }

  // --- XML ---------------------------------------------------------------------------------------------------------

  bool parse(const std::string& contents) {
    for (std::size_t i = 0; i < contents.size(); ++i) {
      if (contents[i] == '\n') line_ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
    if (contents.find('\0') != std::string::npos) {
      error(0, {}, "not a text in UTF-8", "it holds zero bytes", "save the file as UTF-8");
      return false;
    }
    const pugi::xml_parse_result result =
        document_.load_buffer(contents.data(), contents.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      error(line_at(result.offset), {}, "not well-formed XML", result.description(), "check the element at this line");
      return false;
    }
    const pugi::xml_node root = document_.document_element();
    if (!is(root, "scene")) {
      error(line_of(root), {}, "not a Mitsuba scene",
            "the outermost element is <" + std::string(root.name()).substr(0, 40) + ">",
            "a Mitsuba or Sionna scene starts with <scene>");
      return false;
    }
    return nesting_is_fair();
  }

  // Walks without recursion, so that no depth can exhaust the stack. (pugixml itself parses and frees without
  // recursion.)
  bool nesting_is_fair() {
    int depth = 0;
    for (pugi::xml_node node = document_.first_child(); node;) {
      if (depth > deepest_nesting) {
        error(line_of(node), {}, "elements nested too deeply",
              "more than " + std::to_string(deepest_nesting) + " levels", "a scene needs five");
        return false;
      }
      if (node.first_child()) {
        node = node.first_child();
        ++depth;
        continue;
      }
      while (node && !node.next_sibling()) {
        node = node.parent();
        --depth;
      }
      if (node) node = node.next_sibling();
    }
    return true;
  }

  int line_at(std::ptrdiff_t offset) const {
    return 1 + static_cast<int>(std::lower_bound(line_ends_.begin(), line_ends_.end(), offset) - line_ends_.begin());
  }
  int line_of(const pugi::xml_node& node) const { return node.offset_debug() < 0 ? 0 : line_at(node.offset_debug()); }

  // The value of an attribute with $name replaced by its <default>; the longest name that fits wins.
  std::string text(const pugi::xml_node& node, const char* attribute) {
    const std::string raw = node.attribute(attribute).value();
    std::string value;
    for (std::size_t at = 0; at < raw.size();) {
      const std::size_t dollar = std::min(raw.find('$', at), raw.size());
      value.append(raw, at, dollar - at);
      at = dollar;
      if (at == raw.size()) break;
      std::size_t end = at + 1;
      while (end < raw.size() && (std::isalnum(static_cast<unsigned char>(raw[end])) != 0 || raw[end] == '_')) ++end;
      auto found = defaults_.end();
      std::size_t length = end - at - 1;
      for (; length > 0 && found == defaults_.end(); --length) found = defaults_.find(raw.substr(at + 1, length));
      if (found == defaults_.end()) {
        std::vector<std::string> known;
        for (const auto& [name, ignored] : defaults_) known.push_back(name);
        const std::string name = raw.substr(at + 1, end - at - 1);
        if (no_value_.emplace(node.offset_debug(), name).second) {
          error(line_of(node), {}, "$" + name + " has no value", "no <default name=\"" + name + "\"> in this file",
                known.empty() ? "add a <default>" : did_you_mean(name, known));
        }
        value.append(raw, at, end - at);
        at = end;
        continue;
      }
      value += found->second;
      at += found->first.size() + 1;
    }
    return value;
  }

  // The child <tag name="name" value="…"/>.
  pugi::xml_node parameter(const pugi::xml_node& node, const char* tag, const char* name) const {
    for (const pugi::xml_node child : node.children(tag)) {
      if (std::strcmp(child.attribute("name").value(), name) == 0) return child;
    }
    return {};
  }

  // The number of <float> or <integer> `name`, which must be above or equal to `least`; an error if it is not one.
  std::optional<double> number(const pugi::xml_node& node, const char* name, double least, bool least_allowed) {
    pugi::xml_node child = parameter(node, "float", name);
    if (!child) child = parameter(node, "integer", name);
    if (!child) return std::nullopt;
    const std::string value = text(child, "value");
    const auto read = numbers_in(value);
    if (read && read->size() == 1 && (read->front() > least || (least_allowed && read->front() == least)))
      return read->front();
    error(line_of(child), name, "bad value \"" + value.substr(0, 40) + "\"",
          std::string("a number ") + (least_allowed ? "from " : "above ") + std::to_string(static_cast<int>(least)) +
              " is needed");
    return std::nullopt;
  }

  // --- elements ----------------------------------------------------------------------------------------------------

  void read_declaration(const pugi::xml_node& node) {
    if (node.type() != pugi::node_element) return;
    if (!is_known_element(node)) pass_over(node, "element <" + std::string(node.name()).substr(0, 40) + ">");
    if (is(node, "default")) {
      // The first value counts, as in Mitsuba: a later <default> does not replace it.
      defaults_.emplace(node.attribute("name").value(), text(node, "value"));
      return;
    }
    const std::string id = text(node, "id");
    if (id.empty()) return;
    if (!ids_.emplace(id).second && is(node, "bsdf")) {
      error(line_of(node), "id", "a second element with the id \"" + id + "\"",
            "references to it have no single meaning", "give each its own id");
    }
  }

  // The bsdf itself or the first one inside it that describes a radio material.
  pugi::xml_node radio_material_in(const pugi::xml_node& node) {
    const std::string type = text(node, "type");
    if (type == "itu-radio-material" || type == "radio-material") return node;
    for (const pugi::xml_node child : node.children("bsdf")) {  // nesting is at most 64 deep
      if (const pugi::xml_node found = radio_material_in(child)) return found;
    }
    return {};
  }

  // Returns the key of the material that the bsdf names and notes what the file says of it.
  std::string read_bsdf(const pugi::xml_node& bsdf) {
    const std::string id_key = material_key(text(bsdf, "id"));
    const pugi::xml_node radio = radio_material_in(bsdf);
    if (!radio) return id_key;
    MaterialDescription said;
    std::string key = id_key;
    said.thickness = number(radio, "thickness", 0, false);
    if (text(radio, "type") == "itu-radio-material") {
      const pugi::xml_node type = parameter(radio, "string", "type");
      key = type ? material_key(text(type, "value")) : std::string();
      if (key.empty()) {
        error(line_of(radio), "type", "an itu-radio-material without type", "the type names the material",
              "add <string name=\"type\" value=\"concrete\"/>");
        return id_key;
      }
      said.based_on = key;
    } else {
      // Sionna's values where the file gives none: vacuum.
      said.relative_permittivity = number(radio, "relative_permittivity", 0, false).value_or(1);
      said.conductivity = number(radio, "conductivity", 0, true).value_or(0);
    }
    for (const char* const unused : {"scattering_coefficient", "xpd_coefficient"}) {
      if (const pugi::xml_node child = parameter(radio, "float", unused);
          child && text(child, "value").find_first_not_of("0. ") != std::string::npos) {
        pass_over(child, std::string("material parameter ") + unused);
      }
    }
    return note_material(key, id_key, said, line_of(radio));
  }

  // Two materials of one kind that differ (glass of 4 mm, glass of 1 cm) need two keys: the second goes by its id.
  std::string note_material(const std::string& key, const std::string& id_key, const MaterialDescription& said,
                            int line) {
    std::vector<std::string> keys = {key, id_key};
    for (std::size_t i = 0;; ++i) {
      if (i == keys.size()) keys.push_back(key + "_" + std::to_string(i));
      if (keys[i].empty()) continue;
      const auto [place, fresh] = scene_.materials.emplace(keys[i], said);
      if (!fresh && !(place->second == said)) continue;
      if (i > 0 && fresh) {
        diagnostics_.warning(file_, line, {}, "a second material \"" + key + "\" with other values",
                             "it goes by the name \"" + keys[i] + "\"");
      }
      return keys[i];
    }
  }

  void read_shape(const pugi::xml_node& shape) {
    const std::string type = text(shape, "type");
    if (type != "ply" && type != "obj") {
      pass_over(shape, type.empty() ? "a shape without type" : "shape of type \"" + type.substr(0, 40) + "\"");
      return;
    }
    for (const pugi::xml_node child : shape.children()) {
      if (child.type() == pugi::node_element && !is(child, "transform") && !is(child, "ref") &&
          !is_known_element(child)) {
        pass_over(child, "element <" + std::string(child.name()).substr(0, 40) + "> of a shape");
      }
    }
    const std::string id = text(shape, "id");
    const std::string material = material_of(shape);
    const Affine to_world = read_transform(shape);
    const pugi::xml_node filename = parameter(shape, "string", "filename");
    if (!filename || text(filename, "value").empty()) {
      error(line_of(shape), "filename", "shape \"" + id + "\" names no file", {},
            "add <string name=\"filename\" value=\"meshes/….ply\"/>");
      return;
    }
    const std::filesystem::path mesh_file = path_.parent_path() / text(filename, "value");
    if (missing_meshes_ >= most_missing_meshes) {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(mesh_file, ignored)) {
        ++missing_meshes_;
        return;
      }
    }
    if (const std::optional<FileFault> fault = file_fault(mesh_file)) {
      ++missing_meshes_;
      error(line_of(filename), "filename", "mesh " + mesh_file.string() + ": " + fault->problem, fault->why,
            fault->suggestion);
      return;
    }
    std::vector<MeshDescription> meshes;
    if (type == "ply") {
      meshes.push_back(read_ply(mesh_file, diagnostics_));
    } else {
      meshes = read_with_assimp(mesh_file, diagnostics_);
    }
    for (MeshDescription& mesh : meshes) {
      if (!id.empty()) mesh.name = meshes.size() == 1 ? id : id + "/" + mesh.name;
      if (!material.empty()) mesh.material = material;
      place(mesh, to_world, line_of(shape));
      scene_.meshes.push_back(std::move(mesh));
    }
  }

  void place(MeshDescription& mesh, const Affine& to_world, int line) {
    transform(mesh, to_world);
    const std::size_t bad = first_not_finite(mesh);
    if (bad == mesh.vertices.size()) return;
    error(line, "to_world",
          "vertex " + std::to_string(bad) + " of mesh \"" + mesh.name + "\" is infinite once transformed",
          "the product exceeds what a double holds", "check the transform");
    mesh.vertices.clear();
    mesh.triangles.clear();
  }

  // Key of the material that the shape refers to or holds; empty: none.
  std::string material_of(const pugi::xml_node& shape) {
    if (const pugi::xml_node own = shape.child("bsdf")) return read_bsdf(own);
    for (const pugi::xml_node ref : shape.children("ref")) {
      const std::string id = text(ref, "id");
      if (const auto found = materials_.find(id); found != materials_.end()) return found->second;
      const std::string_view role = ref.attribute("name").value();
      if (role != "bsdf" && ids_.contains(id)) continue;  // a medium, an emitter …
      std::vector<std::string> known;
      for (const auto& [name, ignored] : materials_) known.push_back(name);
      error(line_of(ref), "ref", "no bsdf has the id \"" + id + "\"", "the shape's material is not known",
            known.empty() ? "add the <bsdf>" : did_you_mean(id, known));
    }
    return {};
  }

  Affine read_transform(const pugi::xml_node& shape) {
    Affine total;
    for (const pugi::xml_node transform : shape.children("transform")) {
      const std::string name = text(transform, "name");
      if (name != "to_world" && name != "toWorld") {
        pass_over(transform, "transform \"" + name.substr(0, 40) + "\"");
        continue;
      }
      for (const pugi::xml_node step : transform.children()) {
        if (step.type() == pugi::node_element) total = then(total, read_step(step));
      }
    }
    return total;
  }

  // Three numbers from value="…" (`single` allows one for all) or from x, y, z; those not given are `missing`.
  std::optional<Vec3> triple(const pugi::xml_node& node, double missing, bool single) {
    std::array<double, 3> xyz = {missing, missing, missing};
    const auto bad = [&](const std::string& value) {
      error(line_of(node), node.name(), "bad numbers \"" + value.substr(0, 60) + "\"",
            std::string(single ? "one or " : "") + "three finite numbers are needed");
      return std::nullopt;
    };
    if (node.attribute("value")) {
      const std::string value = text(node, "value");
      const auto read = numbers_in(value);
      if (!read || !(read->size() == 3 || (single && read->size() == 1))) return bad(value);
      for (std::size_t i = 0; i < 3; ++i) xyz[i] = (*read)[read->size() == 1 ? 0 : i];
      return Vec3{xyz[0], xyz[1], xyz[2]};
    }
    const char* const names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      if (!node.attribute(names[i])) continue;
      const std::string value = text(node, names[i]);
      const auto read = numbers_in(value);
      if (!read || read->size() != 1) return bad(value);
      xyz[i] = read->front();
    }
    return Vec3{xyz[0], xyz[1], xyz[2]};
  }

  Affine read_step(const pugi::xml_node& step) {
    Affine map;
    if (is(step, "translate")) {
      if (const auto by = triple(step, 0, false)) map.row = {{{1, 0, 0, by->x}, {0, 1, 0, by->y}, {0, 0, 1, by->z}}};
    } else if (is(step, "scale")) {
      if (const auto by = triple(step, 1, true)) map.row = {{{by->x, 0, 0, 0}, {0, by->y, 0, 0}, {0, 0, by->z, 0}}};
    } else if (is(step, "rotate")) {
      const auto axis = triple(step, 0, false);
      const std::string value = text(step, "angle");
      const auto angle = numbers_in(value);
      if (!angle || angle->size() != 1) {
        error(line_of(step), "rotate", "bad angle \"" + value.substr(0, 40) + "\"", "one number of degrees is needed");
      } else if (axis && !(norm(*axis) > 0 && std::isfinite(norm(*axis)))) {
        error(line_of(step), "rotate", "an axis without direction",
              "x, y and z are all 0, or beyond what a double holds", "for a turn about the vertical write z=\"1\"");
      } else if (axis) {
        map = rotation(normalized(*axis), angle->front() * std::numbers::pi / 180);
      }
    } else if (is(step, "matrix")) {
      const auto entries = numbers_in(text(step, "value"));
      if (!entries || entries->size() != 16) {
        error(
            line_of(step), "matrix", "a matrix without 16 numbers",
            entries ? "it has " + std::to_string(entries->size()) : std::string("one of its words is no finite number"),
            "write four rows of four");
      } else if (const auto& e = *entries; e[12] != 0 || e[13] != 0 || e[14] != 0 || e[15] != 1) {
        error(line_of(step), "matrix", "the last row of the matrix is not 0 0 0 1",
              "only affine maps keep planes and lengths in hand", "are its rows and columns exchanged?");
      } else {
        for (int i = 0; i < 12; ++i) map.row[i / 4][i % 4] = e[i];
      }
    } else {
      error(line_of(step), "to_world", "unknown step <" + std::string(step.name()).substr(0, 40) + ">",
            "without it the mesh would lie in the wrong place",
            did_you_mean(std::string(step.name()).substr(0, 40), {"translate", "rotate", "scale", "matrix"}));
    }
    return map;
  }

  const std::filesystem::path& path_;
  const std::string file_;
  Diagnostics& diagnostics_;
  SceneDescription scene_;
  pugi::xml_document document_;
  std::vector<std::ptrdiff_t> line_ends_;
  std::map<std::string, std::string> defaults_;
  std::map<std::string, std::string> materials_;  // id of a bsdf → key of its material
  std::set<std::string> ids_;
  std::set<std::pair<std::ptrdiff_t, std::string>> no_value_;  // $names already reported, by element
  std::map<std::string, Seen> passed_over_;
  int missing_meshes_ = 0;
};

}  // namespace

SceneDescription read_mitsuba(const std::filesystem::path& file, Diagnostics& diagnostics) {
  return MitsubaReader(file, diagnostics).read();
}

}  // namespace grimaldi
