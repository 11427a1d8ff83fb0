#include "propagation/plan_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

namespace grimaldi {
namespace {

using Kind = ScenarioNode::Kind;

// The lists of tables of a scenario, and what a member is called if the user gives only its number.
bool is_list_key(const std::string& key) { return key == "transmitter" || key == "receiver" || key == "material"; }

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (auto& part : parts)
    if (part == "polarization") part = "polarisation";
  if (parts.front() == "source") parts.front() = "transmitter";
  return parts;
}

std::optional<std::size_t> number_of(const std::string& text) {
  std::size_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

ScenarioNode new_node(Kind kind, const std::string& key, const std::string& path, const std::string& option) {
  ScenarioNode node;
  node.kind = kind;
  node.key = key;
  node.path = path;
  node.option = option;
  return node;
}

// Lays one option over the tree; a fault ends it.
class Layer {
 public:
  Layer(ScenarioNode& root, const PlanOption& option, Diagnostics& diagnostics)
      : root_(root), option_(option), diagnostics_(diagnostics) {}

  void lay() {
    const std::vector<std::string> parts = parts_of(option_.key);
    if (parts.size() > static_cast<std::size_t>(deepest_key))
      return fault("not a key", fmt::format("a key of more than {} parts", deepest_key),
                   "write e.g. --set coverage.cell_size=5");
    if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); }))
      return fault("not a key", "\"" + option_.key + "\" has an empty part", "write e.g. --set coverage.cell_size=5");
    if (!is_utf8(option_.key) || !is_utf8(option_.value))
      return fault("not UTF-8", "texts of a scenario are UTF-8", "");
    remove_alternatives(parts);
    std::size_t next = 0;
    ScenarioNode* node = &root_;
    if (is_list_key(parts.front())) {
      if (parts.size() < 3 && !(parts.size() == 2 && number_of(parts[1])))
        return fault("not a key", parts.front() + " is a list of tables",
                     fmt::format("name a member and its key, e.g. --set {}.0.name=…", parts.front()));
      if (parts.size() < 3)
        return fault("not a key", parts.front() + "." + parts[1] + " is a table",
                     "name the key in it that is to be set");
      node = member_of_list(parts[0], parts[1]);
      if (node == nullptr) return;
      next = 2;
    }
    for (; next + 1 < parts.size(); ++next) {
      ScenarioNode* child = node->find(parts[next]);
      if (child == nullptr) {
        node->children.push_back(new_node(Kind::table, parts[next], path_below(*node, parts[next]), option_.option));
        child = &node->children.back();
      }
      if (child->kind != Kind::table)
        return fault("not a key",
                     fmt::format("{} is {}, it has no \"{}\"", child->path, describe(child->kind), parts[next + 1]),
                     "");
      node = child;
    }
    set(*node, parts[next]);
  }

 private:
  void fault(std::string problem, std::string why, std::string suggestion) {
    diagnostics_.error("", 0, option_.option, std::move(problem), std::move(why), std::move(suggestion));
  }

  static std::string path_below(const ScenarioNode& node, const std::string& key) {
    return node.path.empty() ? key : node.path + "." + key;
  }

  void set_option(ScenarioNode& node) const {
    node.option = option_.option;
    for (auto& child : node.children) set_option(child);
  }

  void set(ScenarioNode& table, const std::string& key) {
    ScenarioNode value = parse_option_value(option_.value);
    set_option(value);
    value.key = key;
    value.path = path_below(table, key);
    if (ScenarioNode* old = table.find(key)) {
      *old = std::move(value);
    } else {
      table.children.push_back(std::move(value));
    }
  }

  // The member `name` (number or name) of the list `key`, added if it may be; nullptr after a fault.
  ScenarioNode* member_of_list(const std::string& key, const std::string& name) {
    ScenarioNode* list = root_.find(key);
    if (list == nullptr) {
      root_.children.push_back(new_node(Kind::list, key, key, option_.option));
      list = &root_.children.back();
    }
    if (list->kind != Kind::list) return nullptr;  // the reader of the section says so
    std::vector<std::string> names;
    bool from_file = false;
    for (auto& member : list->children) {
      const ScenarioNode* text = member.find("name");
      if (text != nullptr && text->kind == Kind::text) {
        if (text->text == name && member.kind == Kind::table) return &member;
        names.push_back(text->text);
      }
      from_file = from_file || member.option.empty();
    }
    const std::optional<std::size_t> number = number_of(name);
    if (number && *number < list->children.size()) {
      ScenarioNode& member = list->children[*number];
      return member.kind == Kind::table ? &member : nullptr;
    }
    if (number && *number > list->children.size()) {
      fault("no such member", fmt::format("there are {} in the list {}, counted from 0", list->children.size(), key),
            fmt::format("{}.{} would add one", key, list->children.size()));
      return nullptr;
    }
    if (!number && from_file && key != "material") {
      fault("no such member", fmt::format("no {} is named \"{}\"", key, name), did_you_mean(name, names));
      return nullptr;
    }
    ScenarioNode member = new_node(Kind::table, "", key + "." + name, option_.option);
    if (!number) {
      member.children.push_back(new_node(Kind::text, "name", member.path + ".name", option_.option));
      member.children.back().text = name;
    }
    list->children.push_back(std::move(member));
    return &list->children.back();
  }

  // Takes away what the file (not another option) says in the place of the key.
  void remove_alternatives(const std::vector<std::string>& parts) {
    static const std::vector<std::string> scenes = {"file", "builtin", "parameters"};
    static const std::vector<std::string> waves = {"frequency", "wavelength", "octaves", "third_octaves"};
    if (parts.size() < 2) return;
    const auto& group = parts[0] == "wave" ? waves : scenes;
    if (parts[0] != "wave" && parts[0] != "scene") return;
    if (parts[1] == "parameters" || std::find(group.begin(), group.end(), parts[1]) == group.end()) return;
    ScenarioNode* section = root_.find(parts[0]);
    if (section == nullptr) return;
    std::erase_if(section->children, [&](const ScenarioNode& child) {
      return child.option.empty() && child.key != parts[1] &&
             std::find(group.begin(), group.end(), child.key) != group.end();
    });
  }

  ScenarioNode& root_;
  const PlanOption& option_;
  Diagnostics& diagnostics_;
};

void rename_polarization(ScenarioNode& node) {
  if (node.key == "polarization") node.key = "polarisation";
  for (auto& child : node.children) rename_polarization(child);
}

}  // namespace

void normalise_scenario(ScenarioNode& root) {
  rename_polarization(root);
  for (auto& child : root.children) {
    if (child.kind != Kind::table || !(is_list_key(child.key) || child.key == "source")) continue;
    ScenarioNode list = new_node(Kind::list, child.key, child.path, "");
    list.line = child.line;
    ScenarioNode member = std::move(child);
    member.key.clear();
    list.children.push_back(std::move(member));
    child = std::move(list);
  }
  ScenarioNode* sources = root.find("source");
  if (sources == nullptr || sources->kind != Kind::list) return;
  ScenarioNode* transmitters = root.find("transmitter");
  if (transmitters == nullptr) {
    sources->key = "transmitter";
  } else if (transmitters->kind == Kind::list) {
    std::move(sources->children.begin(), sources->children.end(), std::back_inserter(transmitters->children));
    std::erase_if(root.children, [](const ScenarioNode& child) { return child.key == "source"; });
  }
}

void lay_options(ScenarioNode& root, const std::vector<PlanOption>& options, Diagnostics& diagnostics) {
  for (const auto& option : options) Layer(root, option, diagnostics).lay();
}

}  // namespace grimaldi
