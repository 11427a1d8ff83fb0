#include "propagation/scenario_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

using Kind = ScenarioNode::Kind;

bool contains(const std::vector<std::string>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string range_text(const NumberRange& range) {
  if (range.above && std::isinf(range.high)) return fmt::format("it must be greater than {}", range.low);
  if (std::isinf(range.high)) return fmt::format("it must be at least {}", range.low);
  if (range.above) return fmt::format("it must be greater than {} and at most {}", range.low, range.high);
  return fmt::format("it must lie in {} … {}", range.low, range.high);
}

}  // namespace

void ScenarioReader::add(Severity severity, const ScenarioNode& node, std::string problem, std::string why,
                         std::string suggestion) {
  const bool by_option = !node.option.empty();
  diagnostics_.add({severity, by_option ? "" : file_, by_option ? 0 : node.line, by_option ? node.option : node.path,
                    std::move(problem), std::move(why), std::move(suggestion)});
}

std::size_t ScenarioReader::error_count() const {
  const auto& all = diagnostics_.all();
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const Diagnostic& one) { return one.severity == Severity::error; }));
}

void ScenarioReader::fault(const ScenarioNode& node, std::string problem, std::string why, std::string suggestion) {
  add(Severity::error, node, std::move(problem), std::move(why), std::move(suggestion));
}

void ScenarioReader::warn(const ScenarioNode& node, std::string problem, std::string why, std::string suggestion) {
  add(Severity::warning, node, std::move(problem), std::move(why), std::move(suggestion));
}

void ScenarioReader::missing(const ScenarioNode& table, const std::string& key, std::string why,
                             std::string suggestion) {
  const std::string path = table.path.empty() ? key : table.path + "." + key;
  diagnostics_.error(file_, table.option.empty() ? table.line : 0, path, "missing", std::move(why),
                     std::move(suggestion));
}

void ScenarioReader::not_in_this_version(const ScenarioNode& node, std::string why, std::string suggestion) {
  fault(node, "not in this version", std::move(why), std::move(suggestion));
}

void ScenarioReader::check_keys(const ScenarioNode& table, const std::vector<std::string>& known,
                                const std::vector<std::string>& later) {
  for (std::size_t i = 0; i < table.children.size(); ++i) {
    const ScenarioNode& child = table.children[i];
    const auto same = [&](const ScenarioNode& other) { return other.key == child.key; };
    if (contains(later, child.key)) {
      not_in_this_version(child);
    } else if (!contains(known, child.key)) {
      fault(child, "unknown key", child.option.empty() ? "" : child.path, did_you_mean(child.key, known));
    } else if (std::any_of(table.children.begin(), table.children.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      fault(child, "given twice", "another spelling of this key stands beside it", "keep one of them");
    }
  }
}

const ScenarioNode* ScenarioReader::table(const ScenarioNode& root, std::string_view key) {
  const ScenarioNode* node = root.find(key);
  if (node == nullptr || node->kind == Kind::table) return node;
  fault(*node, "wrong kind of value", fmt::format("a table is needed, this is {}", describe(node->kind)),
        fmt::format("write [{}]", node->path));
  return nullptr;
}

std::vector<const ScenarioNode*> ScenarioReader::tables(const ScenarioNode& root, std::string_view key) {
  std::vector<const ScenarioNode*> list;
  const ScenarioNode* node = root.find(key);
  if (node == nullptr) return list;
  const std::string hint = fmt::format("write [[{}]]", node->path);
  if (node->kind != Kind::list) {
    fault(*node, "wrong kind of value", fmt::format("a list of tables is needed, this is {}", describe(node->kind)),
          hint);
    return list;
  }
  for (const auto& member : node->children) {
    if (member.kind == Kind::table) {
      list.push_back(&member);
    } else {
      fault(member, "wrong kind of value", fmt::format("a table is needed, this is {}", describe(member.kind)), hint);
    }
  }
  return list;
}

std::optional<double> ScenarioReader::number(const ScenarioNode& node, Dimension dimension, const NumberRange& range) {
  std::string written;
  if (node.kind == Kind::text || (node.kind != Kind::list && node.kind != Kind::table && !node.option.empty())) {
    written = node.text;
  } else if (node.kind == Kind::integer) {
    written = std::to_string(node.integer);
  } else if (node.kind == Kind::real) {
    written = fmt::format("{}", node.real);  // reads back to the same bits
  } else {
    fault(node, "wrong kind of value",
          fmt::format("{} is needed, this is {}", describe(dimension), describe(node.kind)));
    return std::nullopt;
  }
  QuantityFault problem;
  const std::optional<double> value = parse_quantity(written, dimension, problem);
  if (!value) {
    fault(node, problem.problem, problem.why, problem.suggestion);
    return std::nullopt;
  }
  if (*value < range.low || *value > range.high || (range.above && *value <= range.low)) {
    fault(node, "out of range", fmt::format("{} is not possible here, {}", written, range_text(range)));
    return std::nullopt;
  }
  return value;
}

std::vector<double> ScenarioReader::numbers(const ScenarioNode& node, Dimension dimension, const NumberRange& range) {
  std::vector<double> values;
  if (node.kind != Kind::list) {
    if (const auto value = number(node, dimension, range)) values.push_back(*value);
    return values;
  }
  bool right = true;
  for (const auto& child : node.children) {
    const auto value = number(child, dimension, range);
    right = right && value;
    if (value) values.push_back(*value);
  }
  if (node.children.empty()) fault(node, "empty list", fmt::format("{} is needed", describe(dimension)));
  if (!right) values.clear();
  return values;
}

std::vector<double> ScenarioReader::numbers(const ScenarioNode& node, Dimension dimension, std::size_t count,
                                            const std::string& what, const NumberRange& range) {
  if (node.kind != Kind::list) {
    fault(node, "wrong kind of value",
          fmt::format("a list of {} numbers ({}) is needed, this is {}", count, what, describe(node.kind)));
    return {};
  }
  if (node.children.size() != count) {
    fault(node, "wrong count of numbers",
          fmt::format("{} are needed ({}), these are {}", count, what, node.children.size()));
    return {};
  }
  return numbers(node, dimension, range);
}

std::optional<std::int64_t> ScenarioReader::integer(const ScenarioNode& node, std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  if (node.kind == Kind::integer) {
    value = node.integer;
  } else {
    const auto real = number(node, Dimension::number);
    if (!real) return std::nullopt;
    // Beyond 2^53 a real no longer tells whole numbers apart.
    if (*real != std::floor(*real) || std::abs(*real) > 9007199254740992.0) {
      fault(node, "not a whole number", fmt::format("{} is not", *real));
      return std::nullopt;
    }
    value = static_cast<std::int64_t>(*real);
  }
  if (value < low || value > high) {
    fault(node, "out of range", fmt::format("{} is not possible here, it must lie in {} … {}", value, low, high));
    return std::nullopt;
  }
  return value;
}

std::optional<std::string> ScenarioReader::text(const ScenarioNode& node) {
  const bool by_option = !node.option.empty() && node.kind != Kind::list && node.kind != Kind::table;
  if (node.kind != Kind::text && !by_option) {
    fault(node, "wrong kind of value", fmt::format("a text is needed, this is {}", describe(node.kind)),
          "put it in quotes");
    return std::nullopt;
  }
  if (node.text.empty() || node.text.find('\0') != std::string::npos) {
    fault(node, node.text.empty() ? "empty text" : "text with a NUL character", "a name is needed here");
    return std::nullopt;
  }
  return node.text;
}

std::vector<std::string> ScenarioReader::texts(const ScenarioNode& node) {
  std::vector<std::string> list;
  if (node.kind != Kind::list) {
    if (auto one = text(node)) list.push_back(std::move(*one));
    return list;
  }
  for (const auto& child : node.children)
    if (auto one = text(child)) list.push_back(std::move(*one));
  return list;
}

void ScenarioReader::read(const ScenarioNode& table, std::string_view key, Dimension dimension,
                          const NumberRange& range, double& target) {
  if (const ScenarioNode* node = table.find(key))
    if (const auto value = number(*node, dimension, range)) target = *value;
}

void ScenarioReader::read(const ScenarioNode& table, std::string_view key, std::int64_t low, std::int64_t high,
                          int& target) {
  if (const ScenarioNode* node = table.find(key))
    if (const auto value = integer(*node, low, high)) target = static_cast<int>(*value);
}

std::optional<std::size_t> ScenarioReader::word(const ScenarioNode& node, const std::vector<std::string>& words,
                                                const std::vector<std::string>& later) {
  const auto given = text(node);
  if (!given) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *given);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  if (contains(later, *given)) {
    not_in_this_version(node, *given, fmt::format("known: {}", fmt::join(words, ", ")));
  } else {
    fault(node, "unknown value", *given, did_you_mean(*given, words));
  }
  return std::nullopt;
}

}  // namespace grimaldi
