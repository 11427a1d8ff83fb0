// The measured validity map: which theory to trust, over Fresnel number and length of edge.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/cases/families.h"
#include "validation/cases/opening.h"

namespace grimaldi {
namespace {

constexpr int columns = 25, rows = 17;  // lg N from −2 to 1.5; lg of the edge in wavelengths from 0 to 2
constexpr double least_n = -2, most_n = 1.5, least_edge = 0, most_edge = 2;
constexpr int directions = 256;
constexpr double top_of_scale = 3;  // dB

double fresnel_number_at(int column) { return std::pow(10, least_n + (most_n - least_n) * (column + 0.5) / columns); }
double edge_at(int row) { return std::pow(10, least_edge + (most_edge - least_edge) * (row + 0.5) / rows); }

/// Median errors, dB, row by row.
struct Map {
  std::vector<double> polygon, edges, cones;
};

Map measured(const std::string& name) {
  Map map;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Opening unit = opening(name, 1);
      const double size = edge_at(row) / unit.shortest;
      const Opening shape = opening(name, size);
      std::array<std::vector<double>, 4> levels;
      for (const Vec3& point : observation_points(shape, distance_of(size, fresnel_number_at(column)), directions)) {
        levels[0].push_back(std::norm(true_field(shape, point)));
        levels[1].push_back(std::norm(polygon_field(shape, point)));
        levels[2].push_back(std::norm(connected_field(shape, point)));
        levels[3].push_back(std::norm(connected_field(shape, point, EdgeEnds::none)));
      }
      map.polygon.push_back(pattern_error(levels[1], levels[0]).median);
      map.edges.push_back(pattern_error(levels[2], levels[0]).median);
      // A hole in the pattern has no level: shown as the top of the scale and more.
      map.cones.push_back(std::min(pattern_error(levels[3], levels[0]).median, 100.0));
    }
  return map;
}

/// The largest Fresnel number up to which a row of the map stays below `limit`, 0 if it never does.
double holds_up_to(const std::vector<double>& map, int row, double limit) {
  double up_to = 0;
  for (int column = 0; column < columns && map[std::size_t(row * columns + column)] <= limit; ++column)
    up_to = fresnel_number_at(column);
  return up_to;
}
/// The smallest Fresnel number from which on it stays below `limit`; infinity if it never does.
double holds_from(const std::vector<double>& map, int row, double limit) {
  double from = std::numeric_limits<double>::infinity();
  for (int column = columns - 1; column >= 0 && map[std::size_t(row * columns + column)] <= limit; --column)
    from = fresnel_number_at(column);
  return from;
}
/// The Fresnel number from which on edges are nearer to the truth than the polygon form.
double crossing(const Map& map, int row) {
  double from = std::numeric_limits<double>::infinity();
  for (int column = columns - 1; column >= 0; --column) {
    const auto i = std::size_t(row * columns + column);
    if (map.edges[i] > map.polygon[i]) break;
    from = fresnel_number_at(column);
  }
  return from;
}

int row_of(double edge) { return std::clamp(int(std::log10(edge) / (most_edge - least_edge) * rows), 0, rows - 1); }

/// "up to N = 0.11", "from N = 0.3 on", "nowhere", "everywhere".
std::string up_to(double n) {
  return n == 0 ? "nowhere" : n > 0.9 * std::pow(10, most_n) ? "everywhere" : fmt::format("up to N = {:.2g}", n);
}
std::string from(double n) {
  return std::isinf(n)                     ? "nowhere"
         : n < 1.3 * std::pow(10, least_n) ? "everywhere"
                                           : fmt::format("from N = {:.2g} on", n);
}

Figure map_figure(const std::string& name, const Map& map) {
  const bool squares = name == "square";
  RasterRow row;
  row.title = squares ? "Error behind a square opening" : "Error behind a triangular opening";
  row.x_name = "Fresnel number N = (D/2)²/λz";
  row.y_name = "length of edge over λ";
  row.scale_name = "median |error|, dB";
  row.panels = {{"Polygon form of the BSDF (far field)", columns, map.polygon},
                {"Connected edges (repaired BSDF = UTD)", columns, map.edges}};
  row.left = least_n, row.right = most_n, row.bottom = least_edge, row.top = most_edge;
  row.low = 0, row.high = top_of_scale;
  row.x_decades = row.y_decades = true;
  if (!squares) row.panels.push_back({"UTD without waves of ends", columns, map.cones});
  return {"validity-map-" + name,
          squares
              ? "Validity map, right-angled corners: the polygon form is a far field and holds to the left; edges "
                "whose ends have their waves hold everywhere but for openings of about a wavelength."
              : "Validity map, corners of 60°: edges hold to the right, where each acts alone; to the left the wave of "
                "a corner is not the product of its edges' ends, and without those waves the pattern has holes.",
          row};
}

Outcome run_map(const std::string& name, double edge, const std::function<double(const Map&, int)>& error) {
  const Map map = measured(name);
  const int row = row_of(edge);
  Outcome outcome{error(map, row), {}, {map_figure(name, map)}};
  for (const double length : {1.5, 3.0, 10.0, 30.0, 80.0}) {
    const int r = row_of(length);
    outcome.note += fmt::format(
        "{}edges of {:.2g} λ: polygon form within 0.1 dB {}, 0.5 dB {}, 1 dB {}; edges within 0.5 dB {}, 1 dB {}; "
        "edges "
        "the better {}",
        outcome.note.empty() ? "" : ". ", edge_at(r), up_to(holds_up_to(map.polygon, r, 0.1)),
        up_to(holds_up_to(map.polygon, r, 0.5)), up_to(holds_up_to(map.polygon, r, 1)),
        from(holds_from(map.edges, r, 0.5)), from(holds_from(map.edges, r, 1)), from(crossing(map, r)));
  }
  return outcome;
}

/// lg of the ratio of the crossing to 0.3, which the choice of `auto` rests on.
double crossing_error(const Map& map, int row) { return std::abs(std::log10(crossing(map, row) / 0.3)); }

/// Share of the directions that count in which UTD without waves of ends has nothing, 20 dB below the truth or less.
Outcome holes() {
  const Opening shape = opening("triangle", 10);
  double most = 0, empty = 0, all = 0;
  const std::vector<Vec3> points = observation_points(shape, distance_of(10, 0.1), 2048);
  for (const Vec3& point : points) most = std::max(most, std::norm(true_field(shape, point)));
  for (const Vec3& point : points) {
    const double truth = std::norm(true_field(shape, point));
    if (truth < 0.01 * most) continue;
    ++all;
    empty += std::norm(connected_field(shape, point, EdgeEnds::none)) < 0.01 * truth;
  }
  return {empty / all, fmt::format("{:.0f} of {:.0f} directions", empty, all), {}};
}

}  // namespace

Cases validity_cases() {
  Case squares{
      "validity/square",
      "validity map behind squares: largest error of the connected edges, edges of 10 wavelengths, all N of the map",
      "Rayleigh-Sommerfeld integral, first kind",
      "dB",
      0.6,
      "right-angled corners: paraxially exact; 0.6 dB for obliquity and for points nearer than a wavelength",
      0,
      [] {
        return run_map("square", 10, [](const Map& map, int row) {
          const auto begin = map.edges.begin() + row * columns;
          return *std::max_element(begin, begin + columns);
        });
      }};
  Case triangles{
      "validity/triangle",
      "validity map behind triangles: distance (decades) from N = 0.3 of the Fresnel number from which on edges "
      "are nearer to the truth than the polygon form, edges of 10 wavelengths",
      "Rayleigh-Sommerfeld integral, first kind",
      "1",
      0.5,
      "the far field leaves out the phase pi N, edges the waves of corners once the opening lies in one "
      "Fresnel zone: both meet between N = 0.1 and 1",
      0,
      [] { return run_map("triangle", 10, crossing_error); }};
  Case without_ends{
      "validity/holes",
      "UTD without waves of ends, triangle of 10 wavelengths, N = 0.1: share of the directions with a hole",
      "Rayleigh-Sommerfeld integral, first kind",
      "1",
      0.95,
      "a fact: between the strips of its edges there is nothing; half the directions and more",
      0.5,
      holes};
  return {squares, triangles, without_ends};
}

}  // namespace grimaldi
