#pragma once
// A scenario as a tree of values that know where they were written: file line or option of the command line.
// The one door to toml++.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

/// A key of more parts than this is no key of a scenario; the tree is walked by recursion, so the stack must be kept
/// from it.
inline constexpr int deepest_key = 64;

/// One value of a scenario with all that lies below it.
struct ScenarioNode {
  enum class Kind { table, list, text, integer, real, boolean, date };
  Kind kind = Kind::table;
  std::string key;     ///< its name in the table above; empty for members of a list
  std::string path;    ///< dotted path as the file has it, e.g. "source.0.power"
  int line = 0;        ///< 1-based line of the file; 0 = not from a file
  std::string option;  ///< the option that set it, as the user wrote it; empty = from the file
  std::string text;    ///< content of a string; of any scalar given by an option, what the user wrote
  std::int64_t integer = 0;
  double real = 0;
  bool boolean = false;
  std::vector<ScenarioNode> children;  ///< members of a table or list, in the order of the file

  /// The member `name` of a table, or nullptr.
  const ScenarioNode* find(std::string_view name) const;
  ScenarioNode* find(std::string_view name);
};

/// The kind in words, e.g. "a table", for messages.
std::string describe(ScenarioNode::Kind kind);

/// The tree of the TOML text (UTF-8). Text that is no TOML is an error with `file`, line and column in `diagnostics`;
/// so is a key of more than 64 parts. Returns nothing then.
std::optional<ScenarioNode> parse_scenario(std::string_view text, const std::string& file, Diagnostics& diagnostics);

/// The value of an option: TOML (`30`, `"30dBm"`, `[1, 2, 3]`, `{ from = 63, to = 8000 }`), or bare text that is taken
/// as a string, also within a list (`[8.5m, 21m, 27m]`). `text` of every scalar keeps what the user wrote.
ScenarioNode parse_option_value(std::string_view value);

/// True if the bytes are UTF-8 (as TOML wants it).
bool is_utf8(std::string_view text);

/// The tree as TOML text that `parse_scenario` reads back to the same values (reals with all their digits). `root` is a
/// table.
std::string scenario_text(const ScenarioNode& root);

}  // namespace grimaldi
