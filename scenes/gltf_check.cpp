#include "scenes/gltf_check.h"

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/file_contents.h"

namespace grimaldi {
namespace {

using nlohmann::json;

constexpr int deepest_json = 64;           // glTF itself needs about ten; extras may hold more
constexpr std::size_t deepest_node = 500;  // assimp walks nodes by recursion: far from the end of an 8 MB stack
constexpr std::uint64_t most_values = 100'000'000;

struct Fault {
  std::string problem, why, suggestion;
};

// A whole number of the JSON, `missing` if it is not there.
std::uint64_t whole(const json& object, const char* key, std::optional<std::uint64_t> missing = std::nullopt) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (missing) return *missing;
    throw Fault{std::string("\"") + key + "\" is missing", {}, {}};
  }
  // 2⁵³: beyond it sums below could wrap, and no file is that long.
  if (!found->is_number_integer() || *found < 0 || *found > std::int64_t{1} << 53) {
    throw Fault{std::string("\"") + key + "\" is not a whole number from 0", found->dump().substr(0, 40), {}};
  }
  return found->get<std::uint64_t>();
}

// A member that is an array of objects; an empty array if it is not there.
const json& objects(const json& parent, const char* key) {
  static const json none = json::array();
  const auto found = parent.find(key);
  if (found == parent.end()) return none;
  if (!found->is_array()) throw Fault{std::string("\"") + key + "\" is not an array", {}, {}};
  for (const json& entry : *found) {
    if (!entry.is_object()) throw Fault{std::string("an entry of \"") + key + "\" is not an object", {}, {}};
  }
  return *found;
}

const json& entry(const json& array, std::uint64_t index, const char* what) {
  if (index >= array.size()) {
    throw Fault{std::string("a reference to ") + what + " " + std::to_string(index),
                "there are " + std::to_string(array.size()),
                {}};
  }
  return array[index];
}

// The indices in an array member, each below `size`.
std::vector<std::size_t> indices(const json& object, const char* key, std::size_t size) {
  std::vector<std::size_t> list;
  const auto found = object.find(key);
  if (found == object.end()) return list;
  if (!found->is_array()) throw Fault{std::string("\"") + key + "\" is not an array", {}, {}};
  for (const json& value : *found) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size) {
      throw Fault{std::string("\"") + key + "\" names a node that is not there", value.dump().substr(0, 40), {}};
    }
    list.push_back(value.get<std::size_t>());
  }
  return list;
}

struct Parts {
  std::string_view text;                // the JSON
  std::optional<std::uint64_t> binary;  // bytes of the binary chunk of a .glb
};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Parts parts_of(std::string_view bytes) {
  if (bytes.substr(0, 4) != "glTF") return {bytes, std::nullopt};
  constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  if (bytes.size() < 20 || word_at(bytes, 4) != 2) {
    throw Fault{"not a binary glTF of version 2", {}, "export it as glTF 2.0"};
  }
  const std::uint64_t length = word_at(bytes, 12);
  if (word_at(bytes, 8) > bytes.size() || length > bytes.size() - 20 || word_at(bytes, 16) != json_chunk) {
    throw Fault{"the file is shorter than its header says", std::to_string(bytes.size()) + " bytes are there",
                "the file is cut off: export it again"};
  }
  Parts parts{bytes.substr(20, length), std::nullopt};
  const std::uint64_t next = 20 + length;
  if (bytes.size() - next >= 8 && word_at(bytes, next + 4) == binary_chunk) {
    parts.binary = word_at(bytes, next);
    if (*parts.binary > bytes.size() - next - 8) {
      throw Fault{"the binary chunk is shorter than it says", {}, "the file is cut off: export it again"};
    }
  }
  return parts;
}

// assimp's own JSON parser recurses. Brackets in texts do not count.
void check_nesting(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') {
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == ']' || c == '}')) {
      --depth;
    } else if (!quoted && (c == '[' || c == '{') && ++depth > deepest_json) {
      throw Fault{"JSON nested too deeply", "more than " + std::to_string(deepest_json) + " levels", {}};
    }
  }
}

json parse(std::string_view text) {
  check_nesting(text);
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::exception& error) {
    throw Fault{"not well-formed JSON", std::string(error.what()).substr(0, 200), "export the file again"};
  }
}

// Bytes that are really there for a buffer.
std::uint64_t bytes_there(const json& buffer, std::size_t index, const Parts& parts,
                          const std::filesystem::path& folder) {
  const auto found = buffer.find("uri");
  if (found == buffer.end()) {
    if (index == 0 && parts.binary) return *parts.binary;
    throw Fault{
        "buffer " + std::to_string(index) + " has no data", "it has no uri and is not the file's binary chunk", {}};
  }
  if (!found->is_string()) throw Fault{"a uri that is not a text", {}, {}};
  const std::string uri = found->get<std::string>();
  if (uri.rfind("data:", 0) == 0) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) throw Fault{"a data uri that is not base64", {}, "export the file again"};
    std::size_t end = uri.size();
    while (end > comma + 8 && uri[end - 1] == '=') --end;
    return (end - comma - 8) * 3 / 4;
  }
  std::error_code error;
  std::filesystem::path beside = folder / uri;
  if (!std::filesystem::exists(beside, error)) beside = folder / percent_decoded(uri);
  if (const std::optional<FileFault> fault = file_fault(beside)) {
    throw Fault{"buffer " + beside.string() + ": " + fault->problem, fault->why, fault->suggestion};
  }
  const std::uintmax_t size = std::filesystem::file_size(beside, error);
  return error ? 0 : size;
}

void check_buffers(const json& root, const Parts& parts, const std::filesystem::path& folder) {
  const json& buffers = objects(root, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::uint64_t there = bytes_there(buffers[i], i, parts, folder);
    if (whole(buffers[i], "byteLength") > there) {
      throw Fault{"buffer " + std::to_string(i) + " is shorter than it says",
                  std::to_string(there) + " bytes are there", "the file is cut off: export it again"};
    }
  }
  for (const json& view : objects(root, "bufferViews")) {
    const json& buffer = entry(buffers, whole(view, "buffer"), "buffer");
    if (whole(view, "byteOffset", 0) + whole(view, "byteLength") > whole(buffer, "byteLength")) {
      throw Fault{"a buffer view beyond the end of its buffer", {}, "export the file again"};
    }
  }
}

std::uint64_t component_size(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      throw Fault{"unknown componentType " + std::to_string(type), {}, {}};
  }
}

std::uint64_t components(const json& accessor) {
  static constexpr std::pair<std::string_view, std::uint64_t> known[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const auto type = accessor.find("type");
  if (type != accessor.end() && type->is_string()) {
    for (const auto& [name, count] : known) {
      if (name == type->get_ref<const std::string&>()) return count;
    }
  }
  throw Fault{"an accessor without a known type", {}, {}};
}

void check_accessors(const json& root) {
  const json& views = objects(root, "bufferViews");
  for (const json& accessor : objects(root, "accessors")) {
    if (accessor.contains("sparse"))
      throw Fault{"sparse data", "it is not read", "export the file without sparse accessors"};
    const std::uint64_t size = component_size(whole(accessor, "componentType")) * components(accessor);
    const std::uint64_t count = whole(accessor, "count");
    if (!accessor.contains("bufferView")) throw Fault{"an accessor without buffer view", "it holds no data", {}};
    const json& view = entry(views, whole(accessor, "bufferView"), "buffer view");
    const std::uint64_t stride = whole(view, "byteStride", size);
    const std::uint64_t offset = whole(accessor, "byteOffset", 0), length = whole(view, "byteLength");
    if (stride < size || stride > 252 + 4) throw Fault{"a bad byteStride", std::to_string(stride), {}};
    // count and length are below 2⁵³ and the stride below 2⁹, so: divide instead of multiplying.
    if (count > 0 && (offset + size > length || count - 1 > (length - offset - size) / stride)) {
      throw Fault{"an accessor beyond the end of its buffer view",
                  std::to_string(count) + " entries in " + std::to_string(length) + " bytes", "export the file again"};
    }
  }
}

// Entries of all accessors that a set of attributes names; each must have as many as the vertices, if there are any.
std::uint64_t attribute_values(const json& accessors, const json& attributes, std::optional<std::uint64_t> vertices) {
  if (!attributes.is_object()) throw Fault{"attributes that are not an object", {}, {}};
  std::uint64_t values = 0;
  for (const auto& [name, ignored] : attributes.items()) {
    const std::uint64_t count = whole(entry(accessors, whole(attributes, name.c_str()), "accessor"), "count");
    if (count != vertices.value_or(count)) {
      throw Fault{"an attribute " + name.substr(0, 40) + " of another length than the vertices",
                  std::to_string(count) + " instead of " + std::to_string(*vertices), "export the file again"};
    }
    values += count;
  }
  return values;
}

std::uint64_t primitive_values(const json& accessors, const json& primitive) {
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object()) throw Fault{"a primitive without attributes", {}, {}};
  std::optional<std::uint64_t> vertices;
  if (attributes->contains("POSITION")) {
    const json& position = entry(accessors, whole(*attributes, "POSITION"), "accessor");
    if (whole(position, "componentType") != 5126 || components(position) != 3) {
      throw Fault{"positions that are not three floats", {}, "export it without quantisation"};
    }
    vertices = whole(position, "count");
  }
  std::uint64_t values = attribute_values(accessors, *attributes, vertices);
  for (const json& target : objects(primitive, "targets")) values += attribute_values(accessors, target, vertices);
  if (primitive.contains("indices")) {
    const json& list = entry(accessors, whole(primitive, "indices"), "accessor");
    const std::uint64_t type = whole(list, "componentType");
    if (components(list) != 1 || (type != 5121 && type != 5123 && type != 5125)) {
      throw Fault{"indices that are not unsigned whole numbers", {}, "export the file again"};
    }
    values += whole(list, "count");
  }
  return values;
}

void check_meshes(const json& root) {
  const json& accessors = objects(root, "accessors");
  // assimp trusts the bones of a skin, and a mesh that bends has no one shape.
  if (!objects(root, "skins").empty())
    throw Fault{"skinned meshes", "they are not read", "apply the armature before export"};
  std::uint64_t values = 0;
  for (const json& mesh : objects(root, "meshes")) {
    for (const json& primitive : objects(mesh, "primitives")) {
      values += primitive_values(accessors, primitive);
      if (values > most_values) {
        throw Fault{"too many vertices and indices",
                    "more than " + std::to_string(most_values) + " in all primitives together",
                    "cut the scene into parts"};
      }
    }
  }
}

void check_nodes(const json& root) {
  const json& nodes = objects(root, "nodes");
  std::vector<std::vector<std::size_t>> children;
  std::vector<int> parents(nodes.size(), 0);
  for (const json& node : nodes) {
    children.push_back(indices(node, "children", nodes.size()));
    for (const std::size_t child : children.back()) {
      if (++parents[child] > 1)
        throw Fault{"node " + std::to_string(child) + " has two parents", "nodes must form trees", {}};
    }
  }
  // Level by level from the roots; what no root reaches lies on a circle, which nothing draws unless a scene names it.
  std::vector<std::size_t> level;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (parents[i] == 0) level.push_back(i);
  }
  std::size_t reached = 0;
  for (std::size_t depth = 1; !level.empty(); ++depth) {
    if (depth > deepest_node)
      throw Fault{"nodes nested too deeply", "more than " + std::to_string(deepest_node) + " levels", {}};
    reached += level.size();
    std::vector<std::size_t> below;
    for (const std::size_t node : level) below.insert(below.end(), children[node].begin(), children[node].end());
    level = std::move(below);
  }
  if (reached != nodes.size()) throw Fault{"nodes that contain themselves", "nodes must form trees", {}};
  for (const json& scene : objects(root, "scenes")) {
    std::vector<bool> named(nodes.size(), false);
    for (const std::size_t node : indices(scene, "nodes", nodes.size())) {
      if (named[node] || parents[node] > 0) {
        throw Fault{"node " + std::to_string(node) + " has two places in a scene", "nodes must form trees", {}};
      }
      named[node] = true;
    }
  }
}

void check_version(const json& root) {
  if (!root.is_object()) throw Fault{"not a glTF file", "its JSON is not an object", {}};
  const auto asset = root.find("asset");
  const std::string version =
      asset != root.end() && asset->is_object() && asset->contains("version") && (*asset)["version"].is_string()
          ? (*asset)["version"].get<std::string>()
          : std::string();
  if (version.rfind("2.", 0) != 0) {
    throw Fault{"not glTF of version 2",
                version.empty() ? "it names no version" : "it says version " + version.substr(0, 20),
                "export it as glTF 2.0"};
  }
  if (const auto needed = root.find("extensionsRequired"); needed != root.end() && needed->is_array()) {
    for (const char* const name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"}) {
      for (const json& one : *needed) {
        if (one == name)
          throw Fault{std::string("needs the extension ") + name, "it is not read", "export it without compression"};
      }
    }
  }
}

}  // namespace

std::string percent_decoded(std::string_view name) {
  const auto digit = [&](std::size_t at) {
    const char c = name[at];
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string decoded;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '%' && i + 2 < name.size() && digit(i + 1) >= 0 && digit(i + 2) >= 0) {
      decoded += static_cast<char>(digit(i + 1) * 16 + digit(i + 2));
      i += 2;
    } else {
      decoded += name[i];
    }
  }
  return decoded;
}

bool gltf_is_sound(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::optional<std::string> contents = read_file_contents(file, diagnostics);
  if (!contents) return false;
  try {
    const Parts parts = parts_of(*contents);
    const json root = parse(parts.text);
    check_version(root);
    check_buffers(root, parts, file.parent_path());
    check_accessors(root);
    check_meshes(root);
    check_nodes(root);
    return true;
  } catch (const Fault& fault) {
    diagnostics.error(file.string(), 0, {}, fault.problem, fault.why, fault.suggestion);
  }
  return false;
}

}  // namespace grimaldi
