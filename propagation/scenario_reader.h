#pragma once
// Typed look-ups in a scenario: each tells its fault with the place of the value and goes on.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/contract.h"
#include "core/quantity.h"
#include "propagation/scenario_tree.h"

namespace grimaldi {

/// The values that a number may take, ends included unless `above` (then greater than `low`).
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;
};

/// Positive numbers.
inline constexpr NumberRange positive{0, std::numeric_limits<double>::infinity(), true};

class ScenarioReader {
 public:
  ScenarioReader(std::string file, Diagnostics& diagnostics) : file_(std::move(file)), diagnostics_(diagnostics) {}

  /// An error or warning at `node`: its line and path in the file, or the option that set it.
  void fault(const ScenarioNode& node, std::string problem, std::string why = {}, std::string suggestion = {});
  void warn(const ScenarioNode& node, std::string problem, std::string why = {}, std::string suggestion = {});
  /// The error that the key `key` of `table` is missing.
  void missing(const ScenarioNode& table, const std::string& key, std::string why, std::string suggestion);
  /// The error "not in this version".
  void not_in_this_version(const ScenarioNode& node, std::string why = {}, std::string suggestion = {});

  /// Errors for keys of `table` that are not among `known` (did you mean), are given twice, or are among `later`.
  void check_keys(const ScenarioNode& table, const std::vector<std::string>& known,
                  const std::vector<std::string>& later = {});

  /// The tables of the section `key`: nullptr (or empty) if it is not there or of the wrong kind, which is an error.
  const ScenarioNode* table(const ScenarioNode& root, std::string_view key);
  std::vector<const ScenarioNode*> tables(const ScenarioNode& root, std::string_view key);

  /// A number with or without unit, in the unit of `dimension`. Nothing after a fault: wrong kind, not finite, unit,
  /// range.
  std::optional<double> number(const ScenarioNode& node, Dimension dimension, const NumberRange& range = {});
  /// One number, or a list of them. Empty after a fault.
  std::vector<double> numbers(const ScenarioNode& node, Dimension dimension, const NumberRange& range = {});
  /// Exactly `count` numbers; `what` names them for messages, e.g. "east, north, up". Empty after a fault.
  std::vector<double> numbers(const ScenarioNode& node, Dimension dimension, std::size_t count, const std::string& what,
                              const NumberRange& range = {});
  /// A whole number (1e6 and "1e6" are whole).
  std::optional<std::int64_t> integer(const ScenarioNode& node, std::int64_t low, std::int64_t high);
  /// A text; nothing after a fault (wrong kind, empty).
  std::optional<std::string> text(const ScenarioNode& node);
  /// One text, or a list of them.
  std::vector<std::string> texts(const ScenarioNode& node);

  /// Sets `target` from the key if the key is there and right.
  void read(const ScenarioNode& table, std::string_view key, Dimension dimension, const NumberRange& range,
            double& target);
  void read(const ScenarioNode& table, std::string_view key, std::int64_t low, std::int64_t high, int& target);
  /// The same for one word of a closed choice; `later` are words that the contract names and this version lacks.
  template <class Choice>
  void read(const ScenarioNode& table, std::string_view key, const std::vector<std::pair<std::string, Choice>>& choices,
            Choice& target, const std::vector<std::string>& later = {}) {
    const ScenarioNode* node = table.find(key);
    if (node == nullptr) return;
    std::vector<std::string> words;
    for (const auto& choice : choices) words.push_back(choice.first);
    if (const auto index = word(*node, words, later)) target = choices[*index].second;
  }

  const std::string& file() const { return file_; }
  /// Errors told so far, those of other readers of the same list included.
  std::size_t error_count() const;
  Diagnostics& diagnostics() { return diagnostics_; }
  /// The place of the node's text among `words`.
  std::optional<std::size_t> word(const ScenarioNode& node, const std::vector<std::string>& words,
                                  const std::vector<std::string>& later = {});

 private:
  void add(Severity severity, const ScenarioNode& node, std::string problem, std::string why, std::string suggestion);

  std::string file_;
  Diagnostics& diagnostics_;
};

}  // namespace grimaldi
