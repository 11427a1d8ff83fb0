#include "scenes/ply_header.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace grimaldi {
namespace {

// Far above any real header (a hundred properties take 3 kB): what is longer is not a header.
constexpr std::size_t longest_header = 1 << 20;

constexpr std::pair<std::string_view, PlyType> type_names[] = {
    {"char", PlyType::int8},      {"uchar", PlyType::uint8},    {"short", PlyType::int16},
    {"ushort", PlyType::uint16},  {"int", PlyType::int32},      {"uint", PlyType::uint32},
    {"float", PlyType::float32},  {"double", PlyType::float64}, {"int8", PlyType::int8},
    {"uint8", PlyType::uint8},    {"int16", PlyType::int16},    {"uint16", PlyType::uint16},
    {"int32", PlyType::int32},    {"uint32", PlyType::uint32},  {"float32", PlyType::float32},
    {"float64", PlyType::float64}};

std::optional<PlyType> type_named(std::string_view name) {
  for (const auto& [known, type] : type_names) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  constexpr std::string_view blank = " \t\r\v\f";
  for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
    words.emplace_back(line.substr(at, end - at));
    at = line.find_first_not_of(blank, end);
  }
  return words;
}

// Cuts a word of a hostile file to what fits a message, and makes it printable.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return "\"" + text + (word.size() > 40 ? "…\"" : "\"");
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file, Diagnostics& diagnostics)
      : bytes_(bytes), file_(file), diagnostics_(diagnostics) {}

  std::optional<PlyHeader> read() {
    if (bytes_.substr(0, 3) != "ply" || bytes_.size() < 4 ||
        (bytes_[3] != '\n' && bytes_[3] != '\r' && bytes_[3] != ' ')) {
      return fail("not a PLY file", "a PLY file starts with a line \"ply\"", "check the ending of the name");
    }
    // CR alone ends the lines of a file whose first CR is not followed by LF.
    const std::size_t first_end = bytes_.find_first_of("\r\n");
    const bool cr_only =
        first_end != std::string_view::npos && bytes_[first_end] == '\r' && bytes_.substr(first_end, 2) != "\r\n";
    const char line_end = cr_only ? '\r' : '\n';
    const std::string_view head = bytes_.substr(0, longest_header);
    for (std::size_t at = 0;;) {
      const std::size_t end = head.find(line_end, at);
      ++line_;
      if (end == std::string_view::npos) {
        return fail("the header has no end_header", "none in the first " + std::to_string(head.size()) + " bytes",
                    "the file is cut off or not a PLY file");
      }
      const std::vector<std::string> words = words_of(head.substr(at, end - at));
      at = end + 1;
      if (words.empty() || line_ == 1 || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        header_.body = at;
        break;
      }
      if (!statement(words)) return std::nullopt;
    }
    if (!has_format_) return fail("the header has no format", {}, "add \"format binary_little_endian 1.0\" as line 2");
    if (!counts_fit()) return std::nullopt;
    return header_;
  }

 private:
  std::nullopt_t fail(std::string problem, std::string why, std::string suggestion) {
    diagnostics_.error(file_, line_, {}, std::move(problem), std::move(why), std::move(suggestion));
    return std::nullopt;
  }
  bool refuse(std::string problem, std::string why = {}, std::string suggestion = {}) {
    fail(std::move(problem), std::move(why), std::move(suggestion));
    return false;
  }

  bool statement(const std::vector<std::string>& words) {
    if (words[0] == "format") return format(words);
    if (words[0] == "element") return element(words);
    if (words[0] == "property") return property(words);
    return refuse("unknown header line " + shown(words[0]), {},
                  did_you_mean(words[0].substr(0, 40), {"format", "element", "property", "comment", "end_header"}));
  }

  bool format(const std::vector<std::string>& words) {
    if (has_format_) return refuse("a second format line");
    if (words.size() != 3) return refuse("format line with the wrong number of words", "it needs a name and a version");
    if (words[1] == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (words[1] == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (words[1] == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      return refuse("unknown format " + shown(words[1]), {},
                    did_you_mean(words[1].substr(0, 40), {"ascii", "binary_little_endian", "binary_big_endian"}));
    }
    if (words[2] != "1.0") return refuse("unknown PLY version " + shown(words[2]), "only 1.0 exists");
    return has_format_ = true;
  }

  bool element(const std::vector<std::string>& words) {
    if (words.size() != 3) return refuse("element line with the wrong number of words", "it needs a name and a count");
    PlyElement next;
    next.name = words[1];
    const char* const end = words[2].data() + words[2].size();
    const auto [stop, fault] = std::from_chars(words[2].data(), end, next.count);
    if (fault != std::errc() || stop != end) {
      return refuse("bad count " + shown(words[2]) + " of element " + shown(next.name),
                    "a whole number from 0 to 18446744073709551615 is needed");
    }
    for (const PlyElement& known : header_.elements) {
      if (known.name == next.name) return refuse("a second element " + shown(next.name));
    }
    header_.elements.push_back(std::move(next));
    return true;
  }

  bool property(const std::vector<std::string>& words) {
    if (header_.elements.empty()) return refuse("a property before the first element");
    const bool list = words.size() > 1 && words[1] == "list";
    if (words.size() != (list ? 5u : 3u)) {
      return refuse("property line with the wrong number of words",
                    "\"property TYPE NAME\" or \"property list COUNT_TYPE TYPE NAME\"");
    }
    PlyProperty next;
    next.name = words.back();
    for (std::size_t i = list ? 2 : 1; i + 1 < words.size(); ++i) {
      const std::optional<PlyType> type = type_named(words[i]);
      if (!type) {
        return refuse("unknown type " + shown(words[i]), {},
                      did_you_mean(words[i].substr(0, 40),
                                   {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"}));
      }
      if (list && i == 2) {
        next.count_type = type;
      } else {
        next.type = *type;
      }
    }
    if (next.count_type && !is_integer(*next.count_type)) {
      return refuse("the list " + shown(next.name) + " is counted by a " + words[2], "a count is a whole number");
    }
    PlyElement& owner = header_.elements.back();
    for (const PlyProperty& known : owner.properties) {
      if (known.name == next.name) {
        return refuse("a second property " + shown(next.name) + " of element " + shown(owner.name));
      }
    }
    owner.properties.push_back(std::move(next));
    return true;
  }

  // The least that the counts need, against what is there. In a text each value takes a character and a separator,
  // but for the last of the file.
  bool counts_fit() {
    const bool text = header_.format == PlyFormat::ascii;
    const std::uint64_t there = bytes_.size() - header_.body;
    std::uint64_t left = text ? there + 1 : there;
    for (const PlyElement& element : header_.elements) {
      std::uint64_t smallest = 0;
      for (const PlyProperty& property : element.properties) {
        smallest += text ? 2 : size_of(property.count_type.value_or(property.type));
      }
      if (smallest > 0 && element.count > left / smallest) {
        line_ = 0;
        return refuse("the file is shorter than its header says",
                      std::to_string(element.count) + " of element " + shown(element.name) + " need at least " +
                          std::to_string(smallest) + " bytes each; after the header there are " +
                          std::to_string(there) + " bytes",
                      "the file is cut off or its header is wrong: export it again");
      }
      left -= smallest * element.count;
    }
    return true;
  }

  std::string_view bytes_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  PlyHeader header_;
  bool has_format_ = false;
  int line_ = 0;
};

}  // namespace

std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file, Diagnostics& diagnostics) {
  return HeaderReader(bytes, file, diagnostics).read();
}

}  // namespace grimaldi
