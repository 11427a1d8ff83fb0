#include "core/p2040.h"

#include <array>
#include <cctype>
#include <limits>
#include <span>

#include "core/contract.h"

namespace grimaldi {
namespace {

struct RadioRow {
  std::string_view name;
  PermittivityRange range;  // a, b, c, d, from, to in GHz
};

constexpr double infinite = std::numeric_limits<double>::infinity();

// Table 3 of each version; ranges of a material in the order in which they win.

// P.2040-1 (07/2015).
constexpr RadioRow version_1[] = {
    {"vacuum", {1, 0, 0, 0, 0.001, 100}},
    {"concrete", {5.31, 0, 0.0326, 0.8095, 1, 100}},
    {"brick", {3.75, 0, 0.038, 0, 1, 10}},
    {"plasterboard", {2.94, 0, 0.0116, 0.7076, 1, 100}},
    {"wood", {1.99, 0, 0.0047, 1.0718, 0.001, 100}},
    {"glass", {6.27, 0, 0.0043, 1.1925, 0.1, 100}},
    {"ceiling_board", {1.5, 0, 0.0005, 1.1634, 1, 100}},
    {"chipboard", {2.58, 0, 0.0217, 0.78, 1, 100}},
    {"floorboard", {3.66, 0, 0.0044, 1.3515, 50, 100}},
    {"metal", {1, 0, 10000000.0, 0, 1, 100}},
    {"very_dry_ground", {3, 0, 0.00015, 2.52, 1, 10}},
    {"medium_dry_ground", {15, -0.1, 0.035, 1.63, 1, 10}},
    {"wet_ground", {30, -0.4, 0.15, 1.3, 1, 10}},
};

// P.2040-3 (08/2023), and P.2040-2 (09/2021).
constexpr RadioRow version_3[] = {
    {"vacuum", {1, 0, 0, 0, 0.001, 100}},
    {"concrete", {5.24, 0, 0.0462, 0.7822, 1, 100}},
    {"brick", {3.91, 0, 0.0238, 0.16, 1, 40}},
    {"plasterboard", {2.73, 0, 0.0085, 0.9395, 1, 100}},
    {"wood", {1.99, 0, 0.0047, 1.0718, 0.001, 100}},
    {"glass", {6.31, 0, 0.0036, 1.3394, 0.1, 100}},
    {"glass", {5.79, 0, 0.0004, 1.658, 220, 450}},
    {"ceiling_board", {1.48, 0, 0.0011, 1.075, 1, 100}},
    {"ceiling_board", {1.52, 0, 0.0029, 1.029, 220, 450}},
    {"chipboard", {2.58, 0, 0.0217, 0.78, 1, 100}},
    {"plywood", {2.71, 0, 0.33, 0, 1, 40}},
    {"marble", {7.074, 0, 0.0055, 0.9262, 1, 60}},
    {"floorboard", {3.66, 0, 0.0044, 1.3515, 50, 100}},
    {"metal", {1, 0, 10000000.0, 0, 1, 100}},
    {"very_dry_ground", {3, 0, 0.00015, 2.52, 1, 10}},
    {"medium_dry_ground", {15, -0.1, 0.035, 1.63, 1, 10}},
    {"wet_ground", {30, -0.4, 0.15, 1.3, 1, 10}},
};

// P.2040-4.
constexpr RadioRow version_4[] = {
    {"vacuum", {1, 0, 0, 0, 0, infinite}},
    {"concrete", {5.24, 0, 0.0462, 0.7822, 1, 100}},
    {"concrete", {5.17, 0, 0.0145, 1.09, 110, 330}},
    {"brick", {3.75, 0, 0.038, 0, 1, 10}},
    {"brick", {3.91, 0, 0.0238, 0.16, 1, 40}},
    {"brick", {3.95, 0, 0.0022, 1.33, 100, 400}},
    {"plasterboard", {2.94, 0, 0.0116, 0.7076, 1, 100}},
    {"plasterboard", {2.73, 0, 0.0084, 0.94, 100, 400}},
    {"wood", {1.99, 0, 0.0047, 1.0718, 0.001, 100}},
    {"wood", {1.63, 0, 0.0076, 1.002, 100, 400}},
    {"glass", {6.27, 0, 0.0043, 1.1925, 0.1, 100}},
    {"glass", {6.7, 0, 0.0042, 1.15, 100, 400}},
    {"glass", {6.01, 0, 0.04, 0.81, 220, 450}},
    {"clear_acrylic", {2.57, 0, 0.0049, 1.0601, 1, 40}},
    {"ceiling_board", {1.48, 0, 0.0011, 1.1278, 1, 100}},
    {"ceiling_board", {1.58, 0, 0.0014, 1.07, 100, 400}},
    {"chipboard", {2.58, 0, 0.0217, 0.78, 1, 100}},
    {"chipboard", {2.16, 0, 0.0023, 1.359, 100, 200}},
    {"plywood", {2.71, 0, 0.33, 0, 1, 40}},
    {"plywood", {2.17, 0, 0.0063, 1.045, 100, 400}},
    {"plywood", {1.94, 0, 0.0067, 0.9982, 110, 330}},
    {"marble", {7.074, 0, 0.0055, 0.9262, 1, 60}},
    {"marble", {8.62, 0, 0.0027, 1.15, 100, 400}},
    {"marble", {7.94, 0, 0.0001, 1.733, 110, 330}},
    {"floorboard", {3.66, 0, 0.0044, 1.3515, 50, 100}},
    {"floorboard", {3.1575, 0, 0.001675, 1.32775, 100, 400}},
    {"floorboard", {5.27, 0, 2.22e-17, 7.3413, 220, 300}},
    {"floorboard", {5.27, 0, 0.0003, 2.0298, 300, 400}},
    {"floorboard", {5.27, 0, 49.8726, 0, 400, 450}},
    {"vinyl_tile", {3.62, 0, 0.0051, 0.8422, 1, 40}},
    {"carpet_tile", {2.08, 0, 0.0009, 0.82, 1, 40}},
    {"asphalt_concrete", {4.83, 0, 0.0108, 1.3969, 1, 40}},
    {"metal", {1, 0, 10000000.0, 0, 1, 100}},
    {"very_dry_ground", {3, 0, 0.00015, 2.52, 1, 10}},
    {"medium_dry_ground", {15, -0.1, 0.035, 1.63, 1, 10}},
    {"wet_ground", {30, -0.4, 0.15, 1.3, 1, 10}},
};

std::map<std::string, Material> table_of(std::span<const RadioRow> rows) {
  std::map<std::string, Material> table;
  for (const RadioRow& row : rows) {
    Material& material = table[std::string(row.name)];
    material.name = row.name;
    material.radio.push_back(row.range);
  }
  return table;
}

}  // namespace

std::optional<int> p2040_version(std::string_view name) {
  std::string letters;
  for (const char c : name.substr(0, name.find('(')))
    if (c != '.' && std::isspace(static_cast<unsigned char>(c)) == 0)
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (letters.size() != 7 || letters.compare(0, 6, "P2040-") != 0 || letters[6] < '1' || letters[6] > '4') return {};
  return letters[6] - '0';
}

const std::map<std::string, Material>& p2040_materials(int version) {
  GRIMALDI_EXPECT(version >= 1 && version <= 4);
  static const std::array<std::map<std::string, Material>, 3> tables = {table_of(version_1), table_of(version_3),
                                                                        table_of(version_4)};
  return tables[version == 1 ? 0 : version == 4 ? 2 : 1];
}

}  // namespace grimaldi
