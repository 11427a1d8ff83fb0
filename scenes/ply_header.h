#pragma once
// The header of a PLY file: which elements follow, how many, and how their properties are stored.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}
constexpr bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    ///< of the value, or of the values of a list
  std::optional<PlyType> count_type;  ///< of the count before a list; nothing: one value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  ///< offset of the first byte after the header
};

/// Reads the header at the start of `bytes`, the whole contents of `file` (its name, for messages).
/// Source: G. Turk, The PLY Polygon File Format, 1994; type names of both generations (float, float32 …); lines end
/// with LF, CR LF or CR; comment and obj_info lines are passed over. Errors to `diagnostics` (then nothing is
/// returned), with the line: no "ply" at the start, no end_header within 1 MiB, unknown format, type or keyword, a list
/// counted by a float, a name given twice, and counts that need more bytes than the file has left. So whoever reserves
/// memory by these counts reserves at most a small multiple of the file's size.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file, Diagnostics& diagnostics);

}  // namespace grimaldi
