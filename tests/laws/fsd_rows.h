#pragma once
// Rows of reference/fsd_vectors.csv: polygons of triangles, their fields and powers.

#include <array>
#include <complex>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "propagation/laws/aperture.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {

struct FsdRow {
  std::string id, amplitudes;
  double wavenumber = 0;
  PlanePoint xi{};
  TriangleAperture aperture;
  std::complex<double> exact, edges, lobes_removed;  ///< psi, psie, psih
  double power = 0, edge_power = 0;                  ///< PA, sumPj
  double area = 0, highest = 0;                      ///< Σ|S|, max|φ|
};

/// Empty if the file is not there.
inline std::vector<FsdRow> fsd_rows() {
  std::vector<FsdRow> rows;
  for (const auto& field : reference_rows("fsd_vectors.csv")) {
    if (field.size() != 19) continue;
    const auto numbers = [](const std::string& text) {
      std::istringstream words(text);
      std::vector<double> list;
      for (double x = 0; words >> x;) list.push_back(x);
      return list;
    };
    const auto number = [&](std::size_t i) { return std::stod(field[i]); };
    FsdRow row;
    row.id = field[0], row.amplitudes = field[2], row.wavenumber = number(4), row.xi = {number(5), number(6)};
    const auto places = numbers(field[8]), values = numbers(field[9]), corners = numbers(field[10]);
    for (std::size_t i = 0; i + 1 < places.size(); i += 2) {
      row.aperture.vertices.push_back({places[i], places[i + 1]});
      row.aperture.amplitudes.emplace_back(values[i], values[i + 1]);
      row.highest = std::max(row.highest, std::abs(row.aperture.amplitudes.back()));
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      row.aperture.triangles.push_back(
          {std::size_t(corners[i]), std::size_t(corners[i + 1]), std::size_t(corners[i + 2])});
    for (std::size_t i = 0; i < row.aperture.triangles.size(); ++i) {
      const auto& [a, b, c] = row.aperture.triangle(i).corner;
      row.area += 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    row.exact = {number(11), number(12)};
    row.edges = {number(13), number(14)};
    row.lobes_removed = {number(15), number(16)};
    row.power = number(17), row.edge_power = number(18);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace grimaldi
