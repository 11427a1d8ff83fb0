#include "scenes/plain_gltf.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/file_contents.h"

namespace grimaldi {
namespace {

using nlohmann::json;

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // "JSON", "BIN"
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
  std::string_view text;                   // the JSON
  std::optional<std::string_view> binary;  // the binary chunk of a .glb
};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Parts parts_of(std::string_view bytes) {
  if (bytes.substr(0, 4) != "glTF") return {bytes, std::nullopt};
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
    const std::uint64_t chunk = word_at(bytes, next);
    if (chunk > bytes.size() - next - 8) {
      throw Fault{"the binary chunk is shorter than it says", {}, "the file is cut off: export it again"};
    }
    parts.binary = bytes.substr(next + 8, chunk);
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

std::string base64_decoded(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> value;
  value.fill(64);
  for (std::size_t i = 0; i < digits.size(); ++i)
    value[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::uint8_t six = value[static_cast<unsigned char>(c)];
    if (six > 63) throw Fault{"a data uri that is not base64", "it holds another character", "export the file again"};
    bits = bits << 6 | six;
    if ((held += 6) >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255);
  }
  return bytes;
}

// A name with %20 and its like (RFC 3986, section 2.1) replaced by the bytes they stand for.
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

// The bytes that are really there for a buffer.
std::string bytes_of(const json& buffer, std::size_t index, const Parts& parts, const std::filesystem::path& folder) {
  const auto found = buffer.find("uri");
  if (found == buffer.end()) {
    if (index == 0 && parts.binary) return std::string(*parts.binary);
    throw Fault{
        "buffer " + std::to_string(index) + " has no data", "it has no uri and is not the file's binary chunk", {}};
  }
  if (!found->is_string()) throw Fault{"a uri that is not a text", {}, {}};
  const std::string& uri = found->get_ref<const std::string&>();
  if (uri.rfind("data:", 0) == 0) {
    const std::size_t start = uri.find(";base64,");
    if (start == std::string::npos) throw Fault{"a data uri that is not base64", {}, "export the file again"};
    return base64_decoded(std::string_view(uri).substr(start + 8));
  }
  std::error_code error;
  std::filesystem::path beside = folder / uri;
  if (!std::filesystem::exists(beside, error)) beside = folder / percent_decoded(uri);
  Diagnostics faults;
  if (std::optional<std::string> bytes = read_file_contents(beside, faults)) return *std::move(bytes);
  const Diagnostic& fault = faults.all().front();
  throw Fault{"buffer " + beside.string() + ": " + fault.problem, fault.why, fault.suggestion};
}

std::vector<std::string> read_buffers(const json& root, const Parts& parts, const std::filesystem::path& folder) {
  std::vector<std::string> bytes;
  const json& buffers = objects(root, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    bytes.push_back(bytes_of(buffers[i], i, parts, folder));
    if (whole(buffers[i], "byteLength") > bytes.back().size()) {
      throw Fault{"buffer " + std::to_string(i) + " is shorter than it says",
                  std::to_string(bytes.back().size()) + " bytes are there", "the file is cut off: export it again"};
    }
  }
  return bytes;
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

// Where the entries of an accessor lie, once it is sure that they are there.
struct Entries {
  std::uint64_t buffer, offset, view_offset, view_length, stride, count, size, component;
};

Entries entries_of(const json& root, std::uint64_t index) {
  const json& accessor = entry(objects(root, "accessors"), index, "accessor");
  if (accessor.contains("sparse")) {
    throw Fault{"sparse data", "it is not read", "export the file without sparse accessors"};
  }
  const json& view = entry(objects(root, "bufferViews"), whole(accessor, "bufferView"), "buffer view");
  Entries found{};
  found.buffer = whole(view, "buffer");
  const json& buffer = entry(objects(root, "buffers"), found.buffer, "buffer");
  found.view_offset = whole(view, "byteOffset", 0);
  found.view_length = whole(view, "byteLength");
  if (found.view_offset + found.view_length > whole(buffer, "byteLength")) {
    throw Fault{"a buffer view beyond the end of its buffer", {}, "export the file again"};
  }
  found.component = whole(accessor, "componentType");
  found.size = component_size(found.component) * components(accessor);
  found.stride = whole(view, "byteStride", found.size);
  found.count = whole(accessor, "count");
  found.offset = whole(accessor, "byteOffset", 0);
  if (found.stride < found.size || found.stride > 252) {  // 252: the specification's largest
    throw Fault{"a bad byteStride", std::to_string(found.stride), {}};
  }
  // Count and lengths are below 2⁵³ and the stride below 2⁸, so: divide instead of multiplying.
  if (found.count == 0 || found.offset + found.size > found.view_length ||
      found.count - 1 > (found.view_length - found.offset - found.size) / found.stride) {
    throw Fault{"an accessor beyond the end of its buffer view",
                std::to_string(found.count) + " entries in " + std::to_string(found.view_length) + " bytes",
                "export the file again"};
  }
  return found;
}

// Corners must make whole triangles (lines, points). `mode` as in the specification, table in 5.24.4.
void check_corners(std::uint64_t mode, std::uint64_t corners) {
  constexpr std::uint64_t least[] = {1, 2, 2, 2, 3, 3, 3};
  if (mode > 6) throw Fault{"a primitive of unknown mode " + std::to_string(mode), "0 to 6 are known", {}};
  if (corners < least[mode] || (mode == 1 && corners % 2 != 0) || (mode == 4 && corners % 3 != 0)) {
    throw Fault{"a primitive whose corners make no whole shapes",
                std::to_string(corners) + " corners in mode " + std::to_string(mode), "export the file again"};
  }
}

void check_indices(const Entries& list, const std::string& buffer, std::uint64_t vertices) {
  const char* const first = buffer.data() + list.view_offset + list.offset;
  for (std::uint64_t i = 0; i < list.count; ++i) {
    std::uint32_t index = 0;
    std::memcpy(&index, first + i * list.stride, list.size);  // little-endian, like the machine
    if (index < vertices) continue;
    throw Fault{"a face names a vertex that is not there",
                "index " + std::to_string(i) + " is " + std::to_string(index) + ", the primitive has " +
                    std::to_string(vertices) + " vertices",
                "export the file again"};
  }
}

// The nodes of the scene to show (all that have no parent, if the file has no scene), after a look at all nodes.
std::vector<std::size_t> roots_of(const json& root) {
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
  // Level by level from the tops; what they do not reach lies on a circle.
  std::vector<std::size_t> tops;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (parents[i] == 0) tops.push_back(i);
  }
  std::vector<std::size_t> level = tops;
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
  const json& scenes = objects(root, "scenes");
  if (scenes.empty()) return tops;
  const json& scene = entry(scenes, whole(root, "scene", 0), "scene");
  std::vector<bool> named(nodes.size(), false);
  const std::vector<std::size_t> roots = indices(scene, "nodes", nodes.size());
  for (const std::size_t node : roots) {
    if (named[node] || parents[node] > 0) {
      throw Fault{"node " + std::to_string(node) + " has two places in a scene", "nodes must form trees", {}};
    }
    named[node] = true;
  }
  return roots;
}

// Writes the plain file from what has been checked.
class PlainFile {
 public:
  PlainFile(const json& root, std::vector<std::string> buffers) : root_(root), buffers_(std::move(buffers)) {
    for (const std::string& buffer : buffers_) {
      starts_.push_back(binary_.size());
      binary_ += buffer;
      binary_.resize((binary_.size() + 3) / 4 * 4);  // the specification wants chunks and floats at multiples of four
    }
  }

  std::string write() {
    plain_["asset"]["version"] = "2.0";
    for (const char* const list : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
      plain_[list] = json::array();
    for (const json& material : objects(root_, "materials")) plain_["materials"].push_back(named(material));
    for (const json& mesh : objects(root_, "meshes")) add_mesh(mesh);
    add_nodes();
    for (const char* const list : {"materials", "meshes", "accessors", "bufferViews"}) {
      if (plain_[list].empty()) plain_.erase(list);
    }
    if (!binary_.empty()) plain_["buffers"] = {{{"byteLength", binary_.size()}}};
    return packed();
  }

 private:
  static json named(const json& object) {
    json result = json::object();
    if (const auto name = object.find("name"); name != object.end() && name->is_string()) result["name"] = *name;
    return result;
  }

  // The number of a fresh accessor for the entries.
  std::size_t add_accessor(const Entries& from, const char* type) {
    json view = {
        {"buffer", 0}, {"byteOffset", starts_[from.buffer] + from.view_offset}, {"byteLength", from.view_length}};
    if (from.stride != from.size) view["byteStride"] = from.stride;
    plain_["bufferViews"].push_back(std::move(view));
    plain_["accessors"].push_back({{"bufferView", plain_["bufferViews"].size() - 1},
                                   {"byteOffset", from.offset},
                                   {"componentType", from.component},
                                   {"count", from.count},
                                   {"type", type}});
    return plain_["accessors"].size() - 1;
  }

  json primitive_of(const json& primitive) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
      throw Fault{"a primitive without attributes", {}, {}};
    const Entries positions = entries_of(root_, whole(*attributes, "POSITION"));
    if (positions.component != 5126 || positions.size != 12) {
      throw Fault{"positions that are not three floats", {}, "export it without quantisation"};
    }
    std::uint64_t corners = positions.count;
    values_ += positions.count;
    json result = {{"mode", whole(primitive, "mode", 4)}};
    if (primitive.contains("indices")) {
      const Entries list = entries_of(root_, whole(primitive, "indices"));
      const bool is_unsigned = list.component == 5121 || list.component == 5123 || list.component == 5125;
      if (!is_unsigned || list.size != component_size(list.component)) {
        throw Fault{"indices that are not unsigned whole numbers", {}, "export the file again"};
      }
      corners = list.count;
      values_ += list.count;
      if (values_ <= most_values) check_indices(list, buffers_[list.buffer], positions.count);
      result["indices"] = add_accessor(list, "SCALAR");
    }
    if (values_ > most_values) {
      throw Fault{"too many vertices and indices",
                  "more than " + std::to_string(most_values) + " in all primitives together",
                  "cut the scene into parts"};
    }
    check_corners(result["mode"], corners);
    result["attributes"]["POSITION"] = add_accessor(positions, "VEC3");
    if (primitive.contains("material")) {
      const std::uint64_t material = whole(primitive, "material");
      entry(objects(root_, "materials"), material, "material");
      result["material"] = material;
    }
    return result;
  }

  void add_mesh(const json& mesh) {
    json result = named(mesh);
    for (const json& primitive : objects(mesh, "primitives")) result["primitives"].push_back(primitive_of(primitive));
    new_mesh_.push_back(result.contains("primitives") ? std::optional(plain_["meshes"].size()) : std::nullopt);
    if (new_mesh_.back()) plain_["meshes"].push_back(std::move(result));
  }

  void add_nodes() {
    const json& nodes = objects(root_, "nodes");
    std::vector<std::size_t> roots = roots_of(root_);
    for (const json& node : nodes) {
      json result = named(node);
      if (const auto children = indices(node, "children", nodes.size()); !children.empty())
        result["children"] = children;
      for (const auto& [key, length] :
           {std::pair{"matrix", 16u}, {"translation", 3u}, {"rotation", 4u}, {"scale", 3u}}) {
        const auto numbers = node.find(key);
        if (numbers == node.end()) continue;
        bool good = numbers->is_array() && numbers->size() == length;
        for (std::size_t i = 0; good && i < length; ++i) good = (*numbers)[i].is_number();
        if (!good)
          throw Fault{std::string("\"") + key + "\" of a node is not " + std::to_string(length) + " numbers", {}, {}};
        result[key] = *numbers;
      }
      if (const auto extensions = node.find("extensions");
          extensions != node.end() && extensions->contains("EXT_mesh_gpu_instancing")) {
        throw Fault{"instances of meshes", "EXT_mesh_gpu_instancing is not read", "export each instance as a node"};
      }
      if (node.contains("mesh")) {
        const std::uint64_t mesh = whole(node, "mesh");
        entry(objects(root_, "meshes"), mesh, "mesh");
        if (node.contains("skin")) {
          throw Fault{"a skinned mesh", "a mesh that bends has no one shape", "apply the armature before export"};
        }
        if (new_mesh_[mesh]) result["mesh"] = *new_mesh_[mesh];
      }
      plain_["nodes"].push_back(std::move(result));
    }
    plain_["scene"] = 0;
    plain_["scenes"] = {{{"nodes", roots}}};
  }

  std::string packed() const {
    std::string text = plain_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      throw Fault{"more than 4 GiB", std::to_string(total) + " bytes", "cut the scene into parts"};
    }
    std::string file = "glTF";
    const auto append = [&](std::uint64_t value) {
      const auto word = static_cast<std::uint32_t>(value);
      file.append(reinterpret_cast<const char*>(&word), 4);  // little-endian, like the machine
    };
    append(2), append(total), append(text.size()), append(json_chunk);
    file += text;
    if (!binary_.empty()) {
      append(binary_.size()), append(binary_chunk);
      file += binary_;
    }
    return file;
  }

  const json& root_;
  std::vector<std::string> buffers_;
  std::vector<std::size_t> starts_;  // of each buffer in binary_
  std::string binary_;
  json plain_ = json::object();
  std::uint64_t values_ = 0;                          // vertices and indices so far
  std::vector<std::optional<std::size_t>> new_mesh_;  // number in the plain file; nothing: a mesh without primitives
};

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

std::optional<std::string> plain_gltf(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::optional<std::string> contents = read_file_contents(file, diagnostics);
  if (!contents) return std::nullopt;
  try {
    const Parts parts = parts_of(*contents);
    const json root = parse(parts.text);
    check_version(root);
    return PlainFile(root, read_buffers(root, parts, file.parent_path())).write();
  } catch (const Fault& fault) {
    diagnostics.error(file.string(), 0, {}, fault.problem, fault.why, fault.suggestion);
  } catch (const json::exception& error) {
    diagnostics.error(file.string(), 0, {}, "not a well-formed glTF file", error.what(), "export the file again");
  }
  return std::nullopt;
}

}  // namespace grimaldi
