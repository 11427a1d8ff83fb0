// The wedge and the half-plane against the reference files.

#include <algorithm>

#include "tests/validation/rows.h"
#include "validation/half_plane.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

void add(Worst& worst, const WedgeField& field, const Row& row, std::size_t column, double tolerance) {
  worst.add(std::max(std::abs(field.soft - complex_number(row, column)),
                     std::abs(field.hard - complex_number(row, column + 2))),
            tolerance, row[0]);
}

// The tolerances of the files: those of double precision with a margin, the phase k_rho costs 1e-16 of itself.
double plane_wave_tolerance(double k_rho) { return k_rho <= 40 ? 1e-12 : k_rho <= 150 ? 1e-11 : 1e-10; }

TEST(HalfPlane, Reference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/halfplane_sommerfeld.csv");
  Worst worst;
  for (const Row& row : rows) {
    const double k_rho = number(row, 1);
    add(worst, half_plane_plane_wave(k_rho, radians(row, 2), radians(row, 3)), row, 4, k_rho < 1e4 ? 1e-12 : 1e-10);
  }
  worst.expect_within_tolerance(100);
}

TEST(WedgeSeries, PlaneWaveReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/wedge_exact_planewave.csv");
  Worst worst;
  for (const Row& row : rows) {
    const double k_rho = number(row, 3);
    add(worst, wedge_plane_wave(number(row, 1), k_rho, radians(row, 4), radians(row, 5)), row, 7,
        plane_wave_tolerance(k_rho));
  }
  worst.expect_within_tolerance(500);
}

TEST(WedgeSeries, PlaneWaveReferenceByEachMethod) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/wedge_exact_planewave.csv");
  for (const WedgeMethod method : {WedgeMethod::series, WedgeMethod::contour}) {
    SCOPED_TRACE(method == WedgeMethod::series ? "series" : "contour");
    Worst worst;
    for (const Row& row : rows) {
      const double k_rho = number(row, 3);
      if (method == WedgeMethod::series && k_rho > 40) continue;  // slow beyond
      add(worst, wedge_plane_wave(number(row, 1), k_rho, radians(row, 4), radians(row, 5), method), row, 7,
          plane_wave_tolerance(k_rho));
    }
    worst.expect_within_tolerance(300);
  }
}

TEST(WedgeSeries, ExactColumnsNextToUtd) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/utd_vs_exact.csv");
  Worst worst;
  for (const Row& row : rows)
    add(worst, wedge_plane_wave(number(row, 1), number(row, 2), radians(row, 3), radians(row, 4)), row, 9, 1e-12);
  worst.expect_within_tolerance(50);
}

TEST(WedgeSeries, LineSourceReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/wedge_exact_linesource.csv");
  for (const WedgeMethod method : {WedgeMethod::automatic, WedgeMethod::series, WedgeMethod::contour}) {
    SCOPED_TRACE(static_cast<int>(method));
    Worst worst;
    for (const Row& row : rows)
      add(worst,
          wedge_line_source(number(row, 1), number(row, 2), number(row, 3), radians(row, 4), radians(row, 5), method),
          row, 6, 1e-12);
    worst.expect_within_tolerance(100);
  }
}

TEST(WedgeSeries, PointSourceReference) {
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/wedge_exact_pointsource.csv");
  Worst worst;
  for (const Row& row : rows) {
    const EdgePoint source{number(row, 3), number(row, 4), number(row, 5)};
    const EdgePoint receiver{number(row, 6), number(row, 7), number(row, 8)};
    const double over_the_edge = std::hypot(source.rho + receiver.rho, source.z - receiver.z);
    add(worst, wedge_point_source(number(row, 1), number(row, 2), source, receiver), row, 9, 1e-11 / over_the_edge);
  }
  worst.expect_within_tolerance(200);
}

}  // namespace
}  // namespace grimaldi
