#include "scenes/plain_obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

namespace grimaldi {
namespace {

struct Fault {
  int line;
  std::string problem, why;
};

// Lines of the text, one after the other; a backslash before the line end joins the next line.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  // False at the end. `line` may hold "\\\n" between words, which `next_word` takes as a blank.
  bool next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    number_ += joined_ + 1;
    joined_ = 0;
    const std::size_t start = at_;
    for (;;) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      at_ = end + 1;
      const std::size_t last = end > start && text_[end - 1] == '\r' ? end - 1 : end;
      if (last > start && text_[last - 1] == '\\' && at_ < text_.size()) {
        ++joined_;
        continue;
      }
      line = text_.substr(start, end - start);
      return true;
    }
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0, joined_ = 0;
};

std::string_view next_word(std::string_view& line) {
  constexpr std::string_view blank = " \t\r\n\v\f\\";
  const std::size_t start = std::min(line.find_first_not_of(blank), line.size());
  const std::size_t end = std::min(line.find_first_of(blank, start), line.size());
  const std::string_view word = line.substr(start, end - start);
  line.remove_prefix(end);
  return word;
}

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, '?');
  return "\"" + text + "\"";
}

// Of vertices, texture points and normals.
using Counts = std::array<std::int64_t, 3>;
constexpr std::string_view kinds[] = {"v", "vt", "vn"};

void check_vertex(std::string_view rest, int line, std::int64_t index) {
  for (int axis = 0; axis < 3; ++axis) {
    std::string_view word = next_word(rest);
    const std::string name = "vertex " + std::to_string(index);
    if (word.empty()) throw Fault{line, name + " has fewer than three numbers", {}};
    const std::string_view whole = word;
    if (word[0] == '+') word.remove_prefix(1);
    double value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault == std::errc::result_out_of_range || (fault == std::errc() && !std::isfinite(value))) {
      throw Fault{line, name + " is NaN or infinite", shown(whole)};
    }
    if (fault != std::errc() || stop != word.data() + word.size())
      throw Fault{line, shown(whole) + " is not a number", name};
  }
}

// Index from 1 of the vertex of a corner "7", "7/2", "7//3" or "7/2/3".
std::int64_t vertex_of(const std::string_view corner, int line, const Counts& total, const Counts& so_far) {
  std::int64_t vertex = 0;
  std::string_view rest = corner;
  for (int kind = 0; kind < 3; ++kind) {
    const std::size_t slash = rest.find('/');
    const std::string_view word = rest.substr(0, slash);
    if (!word.empty() || kind == 0) {
      std::int64_t index = 0;
      const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), index);
      if (fault != std::errc() || stop != word.data() + word.size()) {
        throw Fault{line, shown(corner) + " is not a corner of a face", "written as v, v/vt, v//vn or v/vt/vn"};
      }
      if (index == 0 || index > total[kind] || index < -so_far[kind]) {
        throw Fault{line, "a face names a vertex that is not there",
                    std::string(kinds[kind]) + " " + std::to_string(index) + "; the file has " +
                        std::to_string(total[kind]) +
                        (index < 0 ? ", " + std::to_string(so_far[kind]) + " of them so far" : "")};
      }
      if (kind == 0) vertex = index > 0 ? index : so_far[0] + 1 + index;
    }
    if (slash == std::string_view::npos) return vertex;
    rest.remove_prefix(slash + 1);
  }
  throw Fault{line, shown(corner) + " is not a corner of a face", "it has more than three parts"};
}

void append_words(std::string& plain, std::string_view line) {
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) plain.append(" ").append(word);
}

std::string plain_lines(std::string_view text) {
  Counts total{}, so_far{};
  std::string_view line;
  for (Lines lines(text); lines.next(line);) {
    const std::string_view word = next_word(line);
    for (int kind = 0; kind < 3; ++kind) total[kind] += word == kinds[kind];
  }
  std::string plain;
  for (Lines lines(text); lines.next(line);) {
    const std::string_view word = next_word(line);
    for (int kind = 0; kind < 3; ++kind) so_far[kind] += word == kinds[kind];
    if (word == "v") {
      line = line.substr(0, line.find('#'));
      check_vertex(line, lines.number(), so_far[0]);
      append_words(plain.append("v"), line);
    } else if (word == "f" || word == "l" || word == "p") {
      plain.append(word);
      line = line.substr(0, line.find('#'));
      for (std::string_view corner = next_word(line); !corner.empty(); corner = next_word(line)) {
        plain.append(" ").append(std::to_string(vertex_of(corner, lines.number(), total, so_far)));
      }
    } else if (word == "o" || word == "g" || word == "usemtl") {
      append_words(plain.append(word), line);
    } else {
      continue;
    }
    plain += '\n';
  }
  return plain;
}

}  // namespace

std::optional<std::string> plain_obj(std::string_view text, const std::string& no_material, const std::string& file,
                                     Diagnostics& diagnostics) {
  try {
    return "usemtl " + no_material + "\n" + plain_lines(text);
  } catch (const Fault& fault) {
    diagnostics.error(file, fault.line, {}, fault.problem, fault.why, "export the file again");
  }
  return std::nullopt;
}

}  // namespace grimaldi
