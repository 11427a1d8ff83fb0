#include "propagation/scenario_tree.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

namespace grimaldi {
namespace {

using Kind = ScenarioNode::Kind;

// The line of the first key of more than `deepest_key` parts, 0 if there is none: dots are counted outside quotes and
// comments, between the marks that end a key.
int line_of_too_deep_key(std::string_view text) {
  int line = 1, dots = 0;
  char quote = 0;
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      ++line, dots = 0, quote = 0, comment = false;
    } else if (comment) {
      continue;
    } else if (quote != 0) {
      if (c == '\\' && quote == '"') {
        ++i;
      } else if (c == quote) {
        quote = 0;
      }
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else if (c == '.') {
      if (++dots > deepest_key) return line;
    } else if (std::string_view("=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
  }
  return 0;
}

ScenarioNode convert(const toml::node& source, const std::string& path) {
  ScenarioNode node;
  node.path = path;
  node.line = static_cast<int>(source.source().begin.line);
  const std::string prefix = path.empty() ? "" : path + ".";
  if (const toml::table* table = source.as_table()) {
    node.kind = Kind::table;
    // toml++ sorts by name; the order of the file is that of the keys' places.
    std::vector<std::pair<const toml::key*, const toml::node*>> members;
    for (const auto& [key, value] : *table) members.emplace_back(&key, &value);
    std::stable_sort(members.begin(), members.end(),
                     [](const auto& a, const auto& b) { return a.first->source().begin < b.first->source().begin; });
    for (const auto& [key, value] : members) {
      node.children.push_back(convert(*value, prefix + std::string(key->str())));
      node.children.back().key = key->str();
    }
  } else if (const toml::array* list = source.as_array()) {
    node.kind = Kind::list;
    for (std::size_t i = 0; i < list->size(); ++i)
      node.children.push_back(convert((*list)[i], prefix + std::to_string(i)));
  } else if (const auto* text = source.as_string()) {
    node.kind = Kind::text;
    node.text = text->get();
  } else if (const auto* integer = source.as_integer()) {
    node.kind = Kind::integer;
    node.integer = integer->get();
  } else if (const auto* real = source.as_floating_point()) {
    node.kind = Kind::real;
    node.real = real->get();
  } else if (const auto* boolean = source.as_boolean()) {
    node.kind = Kind::boolean;
    node.boolean = boolean->get();
  } else {
    node.kind = Kind::date;
  }
  return node;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// The pieces between the commas that lie outside quotes and brackets.
std::vector<std::string_view> pieces_of(std::string_view text) {
  std::vector<std::string_view> pieces;
  int depth = 0;
  char quote = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      pieces.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  if (!trimmed(text.substr(begin)).empty()) pieces.push_back(text.substr(begin));
  return pieces;
}

ScenarioNode option_value(std::string_view value, int depth) {
  ScenarioNode node;
  if (line_of_too_deep_key(value) == 0) {
    try {
      const toml::table table = toml::parse("value = " + std::string(value));
      if (table.size() == 1) node = convert(table.begin()->second, "");
    } catch (const toml::parse_error&) {
      node.kind = Kind::date;  // not TOML: bare text, below
    }
  }
  const std::string_view inner = trimmed(value);
  if (node.kind == Kind::date || (node.kind == Kind::table && (inner.empty() || inner.front() != '{'))) {
    node = {};
    if (depth < deepest_key && inner.size() >= 2 && inner.front() == '[' && inner.back() == ']') {
      node.kind = Kind::list;
      for (const auto piece : pieces_of(inner.substr(1, inner.size() - 2)))
        node.children.push_back(option_value(piece, depth + 1));
    } else {
      node.kind = Kind::text;
      node.text = inner;
    }
  }
  if (node.kind == Kind::integer || node.kind == Kind::real || node.kind == Kind::boolean) node.text = inner;
  return node;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string real_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);  // shortest text that reads back to the same bits
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string inline_text(const ScenarioNode& node) {
  switch (node.kind) {
    case Kind::integer:
      return std::to_string(node.integer);
    case Kind::real:
      return real_text(node.real);
    case Kind::boolean:
      return node.boolean ? "true" : "false";
    case Kind::text:
    case Kind::date:
      return quoted(node.text);
    case Kind::list: {
      std::vector<std::string> parts;
      for (const auto& child : node.children) parts.push_back(inline_text(child));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    }
    case Kind::table:
      break;
  }
  if (node.children.empty()) return "{}";
  std::vector<std::string> parts;
  for (const auto& child : node.children) parts.push_back(key_text(child.key) + " = " + inline_text(child));
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

// What an option gave has no line; its scalars carry their text.
void finish_option(ScenarioNode& node) {
  node.line = 0;
  if (node.text.empty() && (node.kind == Kind::integer || node.kind == Kind::real || node.kind == Kind::boolean))
    node.text = inline_text(node);
  for (auto& child : node.children) finish_option(child);
}

bool is_list_of_tables(const ScenarioNode& node) {
  return node.kind == Kind::list && !node.children.empty() &&
         std::all_of(node.children.begin(), node.children.end(), [](const auto& c) { return c.kind == Kind::table; });
}

std::string lines_of(const ScenarioNode& table) {
  std::string out;
  for (const auto& child : table.children) out += key_text(child.key) + " = " + inline_text(child) + "\n";
  return out;
}

}  // namespace

const ScenarioNode* ScenarioNode::find(std::string_view name) const {
  for (const auto& child : children)
    if (child.key == name) return &child;
  return nullptr;
}

ScenarioNode* ScenarioNode::find(std::string_view name) {
  return const_cast<ScenarioNode*>(static_cast<const ScenarioNode*>(this)->find(name));
}

std::string describe(ScenarioNode::Kind kind) {
  switch (kind) {
    case Kind::table:
      return "a table";
    case Kind::list:
      return "a list";
    case Kind::text:
      return "a text";
    case Kind::integer:
    case Kind::real:
      return "a number";
    case Kind::boolean:
      return "true or false";
    case Kind::date:
      break;
  }
  return "a date or time";
}

std::optional<ScenarioNode> parse_scenario(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (const int line = line_of_too_deep_key(text); line > 0) {
    diagnostics.error(file, line, "", "not a scenario", fmt::format("a key of more than {} parts", deepest_key));
    return std::nullopt;
  }
  try {
    ScenarioNode root = convert(toml::parse(text), "");
    root.line = 0;  // what is missing in the whole has no line
    return root;
  } catch (const toml::parse_error& fault) {
    diagnostics.error(file, static_cast<int>(fault.source().begin.line), "", "not valid TOML",
                      fmt::format("column {}: {}", fault.source().begin.column, fault.description()),
                      "texts and numbers with units stand in quotes, e.g. frequency = \"3.5GHz\"");
    return std::nullopt;
  }
}

bool is_utf8(std::string_view text) {
  try {
    return toml::parse("value = " + quoted(text)).size() == 1;
  } catch (const toml::parse_error&) {
    return false;  // quoted text has no other way to be wrong
  }
}

ScenarioNode parse_option_value(std::string_view value) {
  ScenarioNode node = option_value(value, 0);
  finish_option(node);
  return node;
}

std::string scenario_text(const ScenarioNode& root) {
  std::string out;
  for (const auto& child : root.children)
    if (child.kind != Kind::table && !is_list_of_tables(child))
      out += key_text(child.key) + " = " + inline_text(child) + "\n";
  for (const auto& child : root.children) {
    const std::string key = key_text(child.key);
    if (child.kind == Kind::table) {
      out += fmt::format("{}[{}]\n{}", out.empty() ? "" : "\n", key, lines_of(child));
    } else if (is_list_of_tables(child)) {
      for (const auto& member : child.children)
        out += fmt::format("{}[[{}]]\n{}", out.empty() ? "" : "\n", key, lines_of(member));
    }
  }
  return out;
}

}  // namespace grimaldi
