// The sections that say where waves begin and where they are asked for: transmitters, receivers, coverage, profile.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "propagation/plan_sections.h"

namespace grimaldi {
namespace {

constexpr const char* a_position = "east, north, up in metres";
// Farther than twice round the Earth is a slip of the pen, and single precision, which rays are traced in, ends at
// 1e38.
constexpr double farthest = 1e8;  // m

// Sets `position`, to NaN after a fault: no place of its own is then judged against the scene.
void read_position(ScenarioReader& reader, const ScenarioNode& table, const char* option, Vec3& position) {
  const ScenarioNode* node = table.find("position");
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  position = {unknown, unknown, unknown};
  if (node == nullptr) {
    if (table.find("location") == nullptr)
      reader.missing(table, "position", "nothing says where it is",
                     fmt::format("set position = [8.5, 21.0, 27.0], or give {}", option));
    return;
  }
  const std::vector<double> values = reader.numbers(*node, Dimension::length, 3, a_position, {-farthest, farthest});
  if (values.size() == 3) position = {values[0], values[1], values[2]};
}

// The name of the member `index`, by default e.g. "tx1"; a name that another one has is an error.
std::string read_name(ScenarioReader& reader, const ScenarioNode& table, const std::string& otherwise,
                      std::set<std::string>& taken) {
  const ScenarioNode* node = table.find("name");
  std::string name = otherwise;
  if (node != nullptr) {
    const auto given = reader.text(*node);
    if (!given) return name;
    name = *given;
  }
  if (!taken.insert(name).second)
    reader.fault(node != nullptr ? *node : table, "name given twice",
                 fmt::format("another one is named \"{}\" too", name), "names tell results apart: give each its own");
  return name;
}

void read_polarisation(ScenarioReader& reader, const ScenarioNode& table, const PlanDescription& plan,
                       bool both_possible, Polarisation& polarisation) {
  const ScenarioNode* node = table.find("polarisation");
  if (node == nullptr) return;
  if (plan.kind == WaveKind::acoustic) {
    reader.warn(*node, "not used", "sound has no polarisation", "leave it out");
    return;
  }
  using enum Polarisation;
  std::vector<std::pair<std::string, Polarisation>> choices = {{"V", vertical}, {"H", horizontal}};
  if (both_possible) choices.emplace_back("both", both);
  reader.read<Polarisation>(table, "polarisation", choices, polarisation);
}

void read_antenna(ScenarioReader& reader, const ScenarioNode& transmitter, const PlanDescription& plan,
                  Antenna& antenna) {
  const ScenarioNode* node = reader.table(transmitter, "antenna");
  if (node == nullptr) return;
  reader.check_keys(*node, {"pattern", "polarisation", "azimuth", "tilt"});
  using enum AntennaPattern;
  reader.read<AntennaPattern>(*node, "pattern",
                              {{"isotropic", isotropic}, {"dipole", dipole}, {"short-dipole", short_dipole}},
                              antenna.pattern);
  if (plan.kind == WaveKind::acoustic && antenna.pattern != isotropic)
    reader.fault(*node->find("pattern"), "an antenna for sound", "a source of sound radiates equally in all directions",
                 "set pattern = \"isotropic\" or leave it out");
  read_polarisation(reader, *node, plan, false, antenna.polarisation);
  reader.read(*node, "azimuth", Dimension::angle, {-360, 360}, antenna.azimuth);
  reader.read(*node, "tilt", Dimension::angle, {-90, 90}, antenna.tilt);
}

std::vector<double> read_power(ScenarioReader& reader, const ScenarioNode& transmitter,
                               const std::vector<std::size_t>& user_order, const PlanDescription& plan) {
  const bool sound = plan.kind == WaveKind::acoustic;
  const char* right = sound ? "sound_power_level" : "power";
  if (const ScenarioNode* wrong = transmitter.find(sound ? "power" : "sound_power_level"))
    reader.fault(*wrong, "not for this kind of wave",
                 sound ? "power is that of a radio transmitter" : "it is that of a source of sound",
                 fmt::format("give {} instead", right));
  const ScenarioNode* node = transmitter.find(right);
  if (node == nullptr) return {0};
  const std::vector<double> given = reader.numbers(*node, sound ? Dimension::sound_level : Dimension::power_level);
  if (given.size() <= 1 || user_order.empty()) return given.empty() ? std::vector<double>{0} : given;
  if (given.size() != user_order.size()) {
    reader.fault(*node, "wrong count of numbers",
                 fmt::format("one is needed, or one per band ({}), these are {}", user_order.size(), given.size()));
    return {0};
  }
  std::vector<double> power;
  for (const std::size_t place : user_order) power.push_back(given[place]);
  return power;
}

bool is_receiver_name(const std::string& name) {
  const bool letters = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '-';
  });
  return letters && name.find_first_not_of('.') != std::string::npos;  // "." is a group's own name in the result
}

}  // namespace

void read_transmitters(ScenarioReader& reader, const ScenarioNode& root, const std::vector<std::size_t>& user_order,
                       PlanDescription& plan) {
  const auto members = reader.tables(root, "transmitter");
  std::set<std::string> taken;
  for (const ScenarioNode* member : members) {
    reader.check_keys(*member, {"name", "position", "power", "sound_power_level", "antenna"}, {"location"});
    Transmitter transmitter;
    transmitter.name = read_name(reader, *member, fmt::format("tx{}", plan.transmitters.size() + 1), taken);
    read_position(reader, *member, "--tx 8.5,21,27", transmitter.position);
    transmitter.power = read_power(reader, *member, user_order, plan);
    read_antenna(reader, *member, plan, transmitter.antenna);
    plan.transmitters.push_back(std::move(transmitter));
  }
  const ScenarioNode* list = root.find("transmitter");
  const bool empty_list = list != nullptr && list->kind == ScenarioNode::Kind::list && list->children.empty();
  if (members.empty() && (list == nullptr || empty_list))
    reader.missing(root, "transmitter", "a run needs a transmitter",
                   "add [[transmitter]] with a position, or give --tx 8.5,21,27");
}

void read_receivers(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  std::set<std::string> taken;
  for (const ScenarioNode* member : reader.tables(root, "receiver")) {
    reader.check_keys(*member, {"name", "position", "polarisation"}, {"location"});
    Receiver receiver;
    receiver.name = read_name(reader, *member, fmt::format("rx{}", plan.receivers.size() + 1), taken);
    if (!is_receiver_name(receiver.name))
      reader.fault(*member->find("name"), "not a name for a receiver",
                   fmt::format("\"{}\" names a group of the result", receiver.name),
                   "use letters A-Z a-z, digits, _ . -");
    read_position(reader, *member, "--rx 40,-60,1.5", receiver.position);
    read_polarisation(reader, *member, plan, true, receiver.polarisation);
    plan.receivers.push_back(std::move(receiver));
  }
}

void read_coverage_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  const ScenarioNode* section = reader.table(root, "coverage");
  if (section == nullptr) return;
  reader.check_keys(*section, {"height", "cell_size", "area", "polarisation"});
  CoverageRequest coverage;
  const std::size_t faults_before = reader.error_count();
  reader.read(*section, "height", Dimension::length, {0, farthest, true}, coverage.height);
  reader.read(*section, "cell_size", Dimension::length, {0, farthest, true}, coverage.cell_size);
  if (const ScenarioNode* node = section->find("area")) {
    const auto values =
        reader.numbers(*node, Dimension::length, 4, "xmin, ymin, xmax, ymax in metres", {-farthest, farthest});
    if (values.size() == 4) {
      if (values[0] >= values[2] || values[1] >= values[3]) {
        reader.fault(*node, "an empty area",
                     fmt::format("x from {} to {}, y from {} to {}", values[0], values[2], values[1], values[3]),
                     "write [xmin, ymin, xmax, ymax]");
      } else {
        coverage.area = {values[0], values[1], values[2], values[3]};
      }
    }
  }
  read_polarisation(reader, *section, plan, true, coverage.polarisation);
  // Of another grid than the one meant nothing can be said: NaN keeps it from being judged.
  if (reader.error_count() > faults_before) coverage.cell_size = std::numeric_limits<double>::quiet_NaN();
  plan.coverage = coverage;
}

void read_profile_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan) {
  if (plan.kind == WaveKind::acoustic) plan.profile.resolution = 1e-3;
  const ScenarioNode* section = reader.table(root, "profile");
  if (section == nullptr) return;
  reader.check_keys(*section, {"resolution", "dynamic_range", "max_paths"});
  reader.read(*section, "resolution", Dimension::time, positive, plan.profile.resolution);
  reader.read(*section, "dynamic_range", Dimension::ratio, positive, plan.profile.dynamic_range);
  int max_paths = static_cast<int>(plan.profile.max_paths);
  // A million paths of a receiver are more than a run finds.
  reader.read(*section, "max_paths", 1, 1000000, max_paths);
  plan.profile.max_paths = static_cast<std::size_t>(max_paths);
}

}  // namespace grimaldi
