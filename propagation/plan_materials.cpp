// The sections [[material]], and their tables over frequency.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "propagation/plan_sections.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;
using Kind = ScenarioNode::Kind;

// A table of a material has some tens of rows; what is larger than this many characters is another kind of file.
constexpr std::size_t largest_table = 4u << 20;
// Faults of a table told before the rest is left out: one wrong separator spoils every row.
constexpr int most_faults = 5;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  for (auto& cell : cells) {
    const auto first = cell.find_first_not_of(" \t\"");
    cell = first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t\"") - first + 1);
  }
  return cells;
}

// Hz per unit of the column if `name` heads a column of frequencies ("frequency_GHz", "f_Hz", "frequency (MHz)"), else
// 0.
double frequency_unit(const std::string& name) {
  std::string word;
  for (const char c : name)
    if (std::string_view(" _()[]/").find(c) == std::string_view::npos)
      word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  for (const auto& [unit, hertz] : {std::pair{"ghz", 1e9}, {"mhz", 1e6}, {"khz", 1e3}, {"hz", 1.0}, {"", 1.0}})
    if (word == std::string("frequency") + unit || (*unit != 0 && word == std::string("f") + unit)) return hertz;
  return 0;
}

// Reads the CSV file: a header line, then rows of ascending frequency.
void read_table(const fs::path& file, Diagnostics& diagnostics, Material& material) {
  std::ifstream stream(file);
  const std::string name = file.string();
  std::string line;
  std::size_t characters = 0;
  int number = 0, faults = 0, column_f = -1, column_e = -1, column_s = -1;
  double hertz = 1;
  Spectrum permittivity, conductivity;
  const auto fault = [&](std::string problem, std::string why, std::string suggestion = {}) {
    if (++faults <= most_faults)
      diagnostics.error(name, number, material.name, std::move(problem), std::move(why), std::move(suggestion));
  };
  while (std::getline(stream, line)) {
    ++number;
    characters += line.size() + 1;
    if (characters > largest_table) return fault("not a table", "it is larger than 4 MiB");
    if (line.find_first_not_of(" \t\r,") == std::string::npos || line.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (column_f < 0) {
      for (int i = 0; i < static_cast<int>(cells.size()); ++i) {
        const std::string& cell = cells[static_cast<std::size_t>(i)];
        if (const double unit = frequency_unit(cell); unit > 0) column_f = i, hertz = unit;
        if (cell == "relative_permittivity") column_e = i;
        if (cell == "conductivity" || cell == "conductivity_S/m") column_s = i;
      }
      if (column_f < 0 || column_e < 0 || column_s < 0)
        return fault("columns missing", "the first line names them",
                     "columns: frequency_Hz or frequency_GHz, relative_permittivity, conductivity (S/m)");
      continue;
    }
    double values[3];
    bool right = true;
    int place = 0;
    for (const int column : {column_f, column_e, column_s}) {
      const std::string cell = column < static_cast<int>(cells.size()) ? cells[static_cast<std::size_t>(column)] : "";
      double& value = values[place++];
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
        fault("not a number", fmt::format("\"{}\" in column {}", cell, column + 1));
        right = false;
      }
    }
    if (!right) continue;
    const double frequency = values[0] * hertz;
    if (!(frequency > 0) || !std::isfinite(frequency) || values[1] < 1 || values[2] < 0) {
      fault("out of range",
            "frequency must be greater than 0, relative permittivity at least 1, conductivity at least 0");
    } else if (!permittivity.frequency.empty() && frequency <= permittivity.frequency.back()) {
      fault("not ascending", "each row needs a greater frequency than the one before");
    } else {
      permittivity.frequency.push_back(frequency);
      permittivity.value.push_back(values[1]);
      conductivity.frequency.push_back(frequency);
      conductivity.value.push_back(values[2]);
    }
  }
  if (stream.bad() || number == 0) return fault("cannot be read", "the table is empty or not readable");
  if (permittivity.frequency.empty() && faults == 0) return fault("no rows", "the table has no values");
  if (faults > most_faults)
    diagnostics.error(name, 0, material.name, fmt::format("{} more faults in this table", faults - most_faults));
  material.permittivity = std::move(permittivity);
  material.conductivity = std::move(conductivity);
}

void read_table_key(ScenarioReader& reader, ScenarioNode& node, const fs::path& folder, Material& material) {
  const auto name = reader.text(node);
  if (!name) return;
  const fs::path file = (folder / *name).lexically_normal();
  std::error_code fault;
  if (!fs::exists(file, fault)) return reader.fault(node, "no such file", file.string());
  if (fs::is_directory(file, fault)) return reader.fault(node, "not a file", file.string() + " is a folder");
  node.kind = Kind::text;
  node.text = fs::absolute(file).lexically_normal().string();
  read_table(file, reader.diagnostics(), material);
}

void read_absorption(ScenarioReader& reader, const ScenarioNode& node, Material& material) {
  constexpr NumberRange share{0, 1};
  if (node.kind == Kind::list) {
    reader.fault(node, "wrong kind of value", "absorption is one number, or a table of bands and values",
                 "write { bands = [\"125Hz\", \"250Hz\"], values = [0.02, 0.03] }");
    return;
  }
  if (node.kind != Kind::table) {
    // One point: constant over frequency, so its place does not matter.
    if (const auto value = reader.number(node, Dimension::number, share))
      material.absorption = Spectrum{{1000.0}, {*value}};
    return;
  }
  reader.check_keys(node, {"bands", "values"});
  Spectrum spectrum;
  for (const char* key : {"bands", "values"})
    if (node.find(key) == nullptr) reader.missing(node, key, "absorption over frequency needs bands and values", "");
  if (const ScenarioNode* bands = node.find("bands"))
    spectrum.frequency = reader.numbers(*bands, Dimension::frequency, positive);
  if (const ScenarioNode* values = node.find("values"))
    spectrum.value = reader.numbers(*values, Dimension::number, share);
  if (spectrum.frequency.empty() || spectrum.value.empty()) return;
  if (spectrum.frequency.size() != spectrum.value.size()) {
    reader.fault(node, "wrong count of numbers",
                 fmt::format("{} bands, {} values", spectrum.frequency.size(), spectrum.value.size()),
                 "give one value per band");
  } else if (std::adjacent_find(spectrum.frequency.begin(), spectrum.frequency.end(), std::greater_equal<>()) !=
             spectrum.frequency.end()) {
    reader.fault(*node.find("bands"), "not ascending", "each band must lie above the one before");
  } else {
    material.absorption = std::move(spectrum);
  }
}

void read_thickness(ScenarioReader& reader, const ScenarioNode& node, Material& material) {
  const bool infinite = (node.kind == Kind::real && std::isinf(node.real) && node.real > 0) ||
                        (node.kind == Kind::text && node.text == "inf");
  if (infinite) {
    material.thickness = std::numeric_limits<double>::infinity();
  } else if (const auto value = reader.number(node, Dimension::length, positive)) {
    material.thickness = *value;
  }
}

}  // namespace

void read_materials(ScenarioReader& reader, ScenarioNode& root, const fs::path& folder, PlanDescription& plan) {
  const auto members = reader.tables(root, "material");  // tells the faults of kind
  if (members.empty()) return;
  for (ScenarioNode& member : root.find("material")->children) {
    if (member.kind != Kind::table) continue;
    const std::size_t faults_before = reader.error_count();
    reader.check_keys(member, {"name", "relative_permittivity", "conductivity", "thickness", "table", "absorption"},
                      {"scattering", "flow_resistivity"});
    const ScenarioNode* name_node = member.find("name");
    if (name_node == nullptr) {
      reader.missing(member, "name", "a mesh names its material", "set name = \"concrete\"");
      continue;
    }
    const auto name = reader.text(*name_node);
    if (!name) continue;
    const std::string key = material_key(*name);
    if (key.empty()) {
      reader.fault(*name_node, "not a name", fmt::format("nothing is left of \"{}\" without its prefix", *name));
      continue;
    }
    if (plan.materials.contains(key)) {
      reader.fault(*name_node, "name given twice", fmt::format("another [[material]] is \"{}\" too", key),
                   "join the two");
      continue;
    }
    const auto& known = built_in_materials();
    const auto built_in = known.find(key);
    Material material;
    if (built_in != known.end()) material = built_in->second;
    material.name = key;
    const auto constant = [&](const char* of, Dimension dimension, const NumberRange& range,
                              std::optional<Spectrum>& target) {
      if (const ScenarioNode* node = member.find(of))
        if (const auto value = reader.number(*node, dimension, range)) target = Spectrum{{1e9}, {*value}};
    };
    constant("relative_permittivity", Dimension::number, {1}, material.permittivity);
    constant("conductivity", Dimension::conductivity, {0}, material.conductivity);
    if (const ScenarioNode* thickness = member.find("thickness")) read_thickness(reader, *thickness, material);
    if (const ScenarioNode* absorption = member.find("absorption")) read_absorption(reader, *absorption, material);
    if (ScenarioNode* table = member.find("table")) {
      if (member.find("relative_permittivity") != nullptr || member.find("conductivity") != nullptr)
        reader.fault(*table, "two sources of one value",
                     "relative_permittivity or conductivity is given beside the table",
                     "keep the table or the numbers");
      read_table_key(reader, *table, folder, material);
    }
    if (member.find("conductivity") != nullptr && !material.permittivity && material.radio.empty())
      reader.missing(member, "relative_permittivity", "conductivity alone is no material", "give both");
    if (reader.error_count() > faults_before) {
      // What its values would have covered is not known: nothing more is to be said of it.
      material.permittivity = material.conductivity = Spectrum{{1e9}, {1.0}};
      material.absorption = Spectrum{{1000.0}, {0.0}};
    }
    plan.materials[key] = std::move(material);
  }
}

}  // namespace grimaldi
