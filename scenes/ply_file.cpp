#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "scenes/file_contents.h"
#include "scenes/mesh_file.h"
#include "scenes/ply_header.h"

namespace grimaldi {
namespace {

static_assert(std::endian::native == std::endian::little, "BinaryValues swaps the bytes of big-endian files only");

// A fault of the body, on its way to the one place that reports it.
struct BodyFault {
  std::string problem, why;
  int line = 0;  // 0 in a binary file
};

// The values of a binary body, one after the other. Every type fits a double without loss.
template <bool big_endian>
class BinaryValues {
 public:
  explicit BinaryValues(std::string_view bytes) : bytes_(bytes) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>();
      case PlyType::uint8:
        return load<std::uint8_t>();
      case PlyType::int16:
        return load<std::int16_t>();
      case PlyType::uint16:
        return load<std::uint16_t>();
      case PlyType::int32:
        return load<std::int32_t>();
      case PlyType::uint32:
        return load<std::uint32_t>();
      case PlyType::float32:
        return load<float>();
      default:
        return load<double>();
    }
  }
  bool holds(std::uint64_t count, PlyType type) const { return count <= (bytes_.size() - at_) / size_of(type); }
  void skip(std::uint64_t count, PlyType type) {
    if (!holds(count, type)) throw BodyFault{"the file ends in the middle of an element", place()};
    at_ += count * size_of(type);
  }
  int line() const { return 0; }
  std::string place() const { return "byte " + std::to_string(at_) + " of the body"; }
  // How many bytes follow the last element; a text editor's last line end does not count.
  std::size_t left_over() const {
    return bytes_.find_first_not_of("\r\n", at_) == bytes_.npos ? 0 : bytes_.size() - at_;
  }

 private:
  template <typename T>
  T load() {
    if (bytes_.size() - at_ < sizeof(T)) throw BodyFault{"the file ends in the middle of an element", place()};
    char raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[big_endian ? sizeof(T) - 1 - i : i] = bytes_[at_ + i];
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// The values of a text body: words between blanks; where lines end does not matter.
class TextValues {
 public:
  TextValues(std::string_view bytes, std::size_t body) : bytes_(bytes), at_(body) {}

  double next(PlyType type) {
    const std::string_view word = next_word();
    if (word.empty()) throw BodyFault{"the file ends in the middle of an element", {}, line()};
    const char* const end = word.data() + word.size();
    double value = 0;
    const auto [stop, fault] = std::from_chars(word.data() + (word[0] == '+'), end, value);
    const auto [low, high] = range(type);
    if (fault != std::errc() || stop != end ||
        (is_integer(type) && !(value == std::floor(value) && low <= value && value <= high))) {
      throw BodyFault{"\"" + std::string(word.substr(0, 40)) + "\" is not a number of the property's type", {}, line()};
    }
    return value;
  }
  bool holds(std::uint64_t count, PlyType) const { return count <= (bytes_.size() - at_ + 1) / 2; }
  void skip(std::uint64_t count, PlyType type) {
    while (count-- > 0) next(type);
  }
  int line() const {
    const std::string_view read = bytes_.substr(0, at_);
    const char line_end = bytes_.find('\n') == bytes_.npos ? '\r' : '\n';
    int lines = 1;
    for (const char c : read) lines += c == line_end;
    return lines;
  }
  std::size_t left_over() const {
    const std::size_t more = bytes_.find_first_not_of(blank, at_);
    return more == bytes_.npos ? 0 : bytes_.size() - more;
  }

 private:
  static constexpr std::string_view blank = " \t\r\n\v\f";
  static std::pair<double, double> range(PlyType type) {
    constexpr std::pair<double, double> ranges[] = {
        {-128, 127},      {0, 255}, {-32768, 32767}, {0, 65535}, {-2147483648., 2147483647.},
        {0, 4294967295.}, {0, 0},   {0, 0}};
    return ranges[static_cast<int>(type)];
  }
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view next_word() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
    return bytes_.substr(start, at_ - start);
  }
  std::string_view bytes_;
  std::size_t at_;
};

// The triangles that one polygon was cut into.
struct Fan {
  std::size_t first, count;
};

struct Body {
  std::uint64_t not_finite = 0;        // vertices with a NaN or infinite coordinate
  std::uint64_t first_not_finite = 0;  // index of the first of them
  std::uint64_t without_area = 0;      // faces of fewer than three corners
  std::vector<Fan> fans;               // of polygons with more than three corners
  std::size_t left_over = 0;           // bytes after the last element
};

template <typename Values>
std::uint64_t list_count(Values& values, const PlyElement& element, std::uint64_t row, const PlyProperty& property) {
  const double count = values.next(*property.count_type);
  const auto place = [&] { return "list " + property.name + " of " + element.name + " " + std::to_string(row); };
  if (count < 0) throw BodyFault{"a list with a negative count", place(), values.line()};
  const auto whole = static_cast<std::uint64_t>(count);
  if (!values.holds(whole, property.type)) {
    throw BodyFault{"a list is longer than the rest of the file",
                    place() + " promises " + std::to_string(whole) + " values", values.line()};
  }
  return whole;
}

template <typename Values>
void pass_over(Values& values, const PlyElement& element, std::uint64_t row, const PlyProperty& property) {
  values.skip(property.count_type ? list_count(values, element, row, property) : 1, property.type);
}

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, MeshDescription& mesh, Body& body) {
  mesh.vertices.reserve(element.count);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    Vec3 point;
    for (const PlyProperty& property : element.properties) {
      const char name = property.name.size() == 1 ? property.name[0] : ' ';
      if (property.count_type || name < 'x' || name > 'z') {
        pass_over(values, element, row, property);
        continue;
      }
      (name == 'x' ? point.x : name == 'y' ? point.y : point.z) = values.next(property.type);
    }
    if (!is_finite(point) && body.not_finite++ == 0) body.first_not_finite = row;
    mesh.vertices.push_back(point);
  }
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, const PlyProperty& corners, std::uint64_t vertices,
                MeshDescription& mesh, Body& body) {
  const auto index = [&](std::uint64_t row) {
    const double value = values.next(corners.type);
    if (value < 0 || value >= static_cast<double>(vertices)) {
      throw BodyFault{"a face names a vertex that is not there",
                      "face " + std::to_string(row) + " names vertex " +
                          std::to_string(static_cast<std::int64_t>(value)) + ", the file has " +
                          std::to_string(vertices),
                      values.line()};
    }
    return static_cast<std::uint32_t>(value);
  };
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (const PlyProperty& property : element.properties) {
      if (&property != &corners) {
        pass_over(values, element, row, property);
        continue;
      }
      const std::uint64_t count = list_count(values, element, row, property);
      if (count < 3) {
        ++body.without_area;
        values.skip(count, property.type);
        continue;
      }
      if (count > 3) body.fans.push_back({mesh.triangles.size(), count - 2});
      const std::uint32_t first = index(row);
      std::uint32_t before = index(row);
      for (std::uint64_t i = 2; i < count; ++i) {
        const std::uint32_t next = index(row);
        mesh.triangles.push_back({first, before, next});
        before = next;
      }
    }
  }
}

const PlyElement* element_named(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

const PlyProperty* corners_of(const PlyElement& face) {
  for (const PlyProperty& property : face.properties) {
    if ((property.name == "vertex_indices" || property.name == "vertex_index") && property.count_type) return &property;
  }
  return nullptr;
}

template <typename Values>
Body read_body(Values values, const PlyHeader& header, MeshDescription& mesh) {
  Body body;
  const PlyElement* const vertex = element_named(header, "vertex");
  const PlyElement* const face = element_named(header, "face");
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no bytes, however many the header counts
    if (&element == vertex) {
      read_vertices(values, element, mesh, body);
    } else if (&element == face) {
      read_faces(values, element, *corners_of(element), vertex->count, mesh, body);
    } else {
      for (std::uint64_t row = 0; row < element.count; ++row) {
        for (const PlyProperty& property : element.properties) {
          pass_over(values, element, row, property);
        }
      }
    }
  }
  body.left_over = values.left_over();
  return body;
}

// What a header must have for a mesh: an error and false if it has not.
bool describes_mesh(const PlyHeader& header, const std::string& file, Diagnostics& diagnostics) {
  const PlyElement* const vertex = element_named(header, "vertex");
  if (vertex == nullptr) {
    diagnostics.error(file, 0, {}, "the file has no vertices", "its header names no element \"vertex\"");
    return false;
  }
  if (vertex->count > std::numeric_limits<std::uint32_t>::max()) {
    diagnostics.error(file, 0, {}, "too many vertices",
                      std::to_string(vertex->count) + "; at most 4294967295 in one mesh", "cut the mesh into parts");
    return false;
  }
  for (const char* const name : {"x", "y", "z"}) {
    bool found = false;
    for (const PlyProperty& property : vertex->properties) found |= property.name == name && !property.count_type;
    if (!found) {
      diagnostics.error(file, 0, {}, std::string("the vertices have no property ") + name,
                        "a position needs x, y and z");
      return false;
    }
  }
  const PlyElement* const face = element_named(header, "face");
  if (face == nullptr || face->count == 0) {
    diagnostics.warning(file, 0, {}, "the mesh has no faces",
                        "nothing for a wave to meet: points alone are passed over");
    return face == nullptr || corners_of(*face) != nullptr || face->properties.empty();
  }
  const PlyProperty* const corners = corners_of(*face);
  if (corners == nullptr || !is_integer(corners->type)) {
    diagnostics.error(file, 0, {}, "the faces do not say which vertices they join",
                      "a list of whole numbers named vertex_indices is needed");
    return false;
  }
  return true;
}

// A fan cuts a polygon rightly only if its triangles all turn the way the polygon does.
std::size_t badly_cut(const MeshDescription& mesh, const std::vector<Fan>& fans) {
  // Overlaps below this share of the polygon's area come from rounded coordinates and are too small to matter.
  constexpr double smallest_share = 1e-4;
  std::size_t bad = 0;
  for (const Fan& fan : fans) {
    const auto twice_area = [&](std::size_t i) {
      const auto& [a, b, c] = mesh.triangles[fan.first + i];
      return cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    };
    Vec3 sum;
    for (std::size_t i = 0; i < fan.count; ++i) sum += twice_area(i);
    double backwards = 0;
    for (std::size_t i = 0; i < fan.count; ++i) backwards = std::min(backwards, dot(twice_area(i), sum));
    bad += backwards < -smallest_share * norm2(sum);
  }
  return bad;
}

}  // namespace

MeshDescription read_ply(const std::filesystem::path& file, Diagnostics& diagnostics) {
  MeshDescription mesh;
  mesh.name = file.stem().string();
  mesh.file = file.string();
  const std::optional<std::string> contents = read_file_contents(file, diagnostics);
  if (!contents) return mesh;
  const std::optional<PlyHeader> header = read_ply_header(*contents, mesh.file, diagnostics);
  if (!header || !describes_mesh(*header, mesh.file, diagnostics)) return mesh;

  const auto give_up = [&] {
    mesh.vertices.clear();
    mesh.triangles.clear();
    return mesh;
  };
  Body body;
  const std::string_view bytes = std::string_view(*contents).substr(header->body);
  try {
    switch (header->format) {
      case PlyFormat::ascii:
        body = read_body(TextValues(*contents, header->body), *header, mesh);
        break;
      case PlyFormat::little_endian:
        body = read_body(BinaryValues<false>(bytes), *header, mesh);
        break;
      case PlyFormat::big_endian:
        body = read_body(BinaryValues<true>(bytes), *header, mesh);
        break;
    }
  } catch (const BodyFault& fault) {
    diagnostics.error(mesh.file, fault.line, {}, fault.problem, fault.why, "export the file again");
    return give_up();
  }
  if (body.not_finite > 0) {
    diagnostics.error(
        mesh.file, 0, {},
        "vertex " + std::to_string(body.first_not_finite) + " of mesh \"" + mesh.name + "\" is NaN or infinite",
        std::to_string(body.not_finite) + " such vertices, counted from 0", "repair the mesh");
    return give_up();
  }
  if (body.left_over > 0 && header->format == PlyFormat::ascii) {
    diagnostics.error(mesh.file, 0, {}, "the file goes on after its last element",
                      "more numbers than the header says, so none is sure to be in its place", "export the file again");
    return give_up();
  }
  if (body.left_over > 0) {
    diagnostics.warning(mesh.file, 0, {}, "the file goes on after its last element",
                        std::to_string(body.left_over) + " bytes are passed over");
  }
  if (body.without_area > 0) {
    diagnostics.warning(mesh.file, 0, {}, std::to_string(body.without_area) + " faces have fewer than three corners",
                        "they have no area and are passed over");
  }
  if (const std::size_t bad = badly_cut(mesh, body.fans); bad > 0) {
    diagnostics.warning(mesh.file, 0, {}, std::to_string(bad) + " polygons are not convex",
                        "a fan from their first corner covers some area twice", "triangulate the mesh before export");
  }
  return mesh;
}

}  // namespace grimaldi
