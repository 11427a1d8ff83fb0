// Many edges in a row: against one and two edges, Lee's row of screens, and the law of boundaries.

#include "propagation/laws/edge_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "propagation/laws/double_edge.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Screens with tips at heights h over the line between source and receiver, that distance apart (small against it).
struct Row {
  std::vector<double> arguments, couplings, widths;
  std::unique_ptr<bool[]> dark;
  double amplitude;  ///< of the product of their waves, over the free field

  /// legs: N + 1, heights: N, wavenumber 2π.
  Row(const std::vector<double>& legs, const std::vector<double>& heights)
      : dark(std::make_unique<bool[]>(heights.size())) {
    const std::size_t n = heights.size();
    std::vector<double> before(n);
    double whole = 0;
    for (std::size_t i = 0; i < n; ++i) before[i] = whole += legs[i];
    whole += legs[n];
    // K of a Brownian bridge: second differences.
    std::vector<double> distance(n);
    for (std::size_t i = 0; i < n; ++i) distance[i] = 1 / (1 / legs[i] + 1 / legs[i + 1]);
    double share = whole;
    for (const double leg : legs) share /= leg;
    for (std::size_t i = 0; i < n; ++i) {
      const double here = heights[i], left = i > 0 ? heights[i - 1] : 0, right = i + 1 < n ? heights[i + 1] : 0;
      const double bend = (here - left) / legs[i] + (here - right) / legs[i + 1];
      arguments.push_back(std::sqrt(pi * distance[i]) * std::abs(bend));
      dark[i] = bend >= 0;
      widths.push_back(std::sqrt(before[i] * (whole - before[i]) / whole / distance[i]));
      if (i + 1 < n) couplings.push_back(std::sqrt(distance[i] * distance[i + 1]) / legs[i + 1]);
      share *= distance[i];
    }
    amplitude = std::sqrt(share);
  }
  std::size_t size() const { return arguments.size(); }
  bool fits() const { return std::all_of(widths.begin(), widths.end(), row_fits); }
  Complex wave() const { return edge_row_wave(arguments, std::span(dark.get(), size()), couplings, widths); }
};

Row random_row(std::uint64_t i, std::size_t n) {
  std::vector<double> legs, heights;
  const auto u = uniform4(7, i, n, 0), v = uniform4(7, i, n, 1), h = uniform4(7, i, n, 2);
  for (std::size_t e = 0; e <= n; ++e) legs.push_back(std::pow(10.0, 1 + 2 * (e < 4 ? u[e] : v[e - 4])));
  for (std::size_t e = 0; e < n; ++e) heights.push_back((6 * h[e] - 3) * v[3] * v[3] * v[3]);  // many near grazing
  return {legs, heights};
}

// The decay e^{-2qs} is resolved by eight nodes at the least: 5e-5 at q = 40.
TEST(EdgeRow, OneEdge) {
  for (const double q : {0.0, 0.01, 0.3, 1.0, 3.0, 10.0, 40.0}) {
    const Complex one = make_edge_wave(q).wave;
    const bool dark = true;
    const double width = 1;
    const Complex row = edge_row_wave(std::span(&q, 1), std::span(&dark, 1), {}, std::span(&width, 1));
    EXPECT_LT(std::abs(row - one), 1e-4 * std::abs(one)) << q;
  }
}

// The closed form; legs of 10 to 1000 wavelengths, tips within 3 of the line, many near it. What the nodes and the tail
// beyond 3.5 widths (e^{-12}) leave: 2e-6.
TEST(EdgeRow, TwoEdges) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Row row = random_row(i, 2);
    const Complex two =
        double_edge_wave(row.arguments[0], row.dark[0], row.arguments[1], row.dark[1], row.couplings[0]);
    worst = std::max(worst, std::abs(row.wave() - two) / std::abs(two));
  }
  EXPECT_LT(worst, 1e-5);
}

// All tips on the straight line between the ends and equally far apart: |E/E0| = 1/(N + 1) for N of them (Lee 1978).
// Each edge adds the tail of its aperture: 2e-5 for eight.
TEST(EdgeRow, GrazingScreens) {
  for (std::size_t n = 1; n <= 8; ++n) {
    const Row row(std::vector<double>(n + 1, 50), std::vector<double>(n, 0));
    EXPECT_NEAR(row.amplitude * std::abs(row.wave()) * double(n + 1), 1, 5e-5) << n;
  }
}

// Where a tip is on the line between its neighbours, its row comes or goes as the row without it does: dark less lit is
// the wave over the others. 1e-5 is left, as above.
TEST(EdgeRow, TheJumpAtABoundaryIsTheRowWithoutThatEdge) {
  int compared = 0;
  double worst = 0;
  for (std::uint64_t i = 0; i < 200; ++i)
    for (const std::size_t n : {std::size_t{3}, std::size_t{4}, std::size_t{6}}) {
      const auto u = uniform4(8, i, n, 0), v = uniform4(8, i, n, 1), h = uniform4(8, i, n, 2), g = uniform4(8, i, n, 3);
      const double scale = std::pow(v[3], 3);
      std::vector<double> legs, heights;
      for (std::size_t e = 0; e <= n; ++e) legs.push_back(std::pow(10.0, 1 + 1.7 * (e < 4 ? u[e] : v[e - 4])));
      for (std::size_t e = 0; e < n; ++e) heights.push_back((4 * (e < 4 ? h[e] : g[e - 4]) - 2) * scale);
      const std::size_t middle = 1;
      heights[middle] = (heights[middle - 1] * legs[middle + 1] + heights[middle + 1] * legs[middle]) /
                        (legs[middle] + legs[middle + 1]);
      Row row(legs, heights);
      if (!row.fits()) continue;
      ++compared;
      row.arguments[middle] = 0;
      row.dark[middle] = true;
      const Complex dark = row.wave();
      row.dark[middle] = false;
      const Complex jump = row.amplitude * (dark - row.wave());
      std::vector<double> fewer_legs = legs, fewer = heights;
      fewer_legs[middle] += fewer_legs[middle + 1];
      fewer_legs.erase(fewer_legs.begin() + middle + 1);
      fewer.erase(fewer.begin() + middle);
      const Row without(fewer_legs, fewer);
      if (!without.fits()) continue;
      const Complex expected = without.amplitude * without.wave();
      worst = std::max(worst, std::abs(jump - expected) / std::abs(expected));
    }
  EXPECT_GT(compared, 400);
  EXPECT_LT(worst, 3e-5);
}

TEST(EdgeRow, ExchangeOfTheEnds) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto u = uniform4(9, i, 0, 0), h = uniform4(9, i, 0, 1);
    const std::vector<double> legs{10 + 90 * u[0], 5 + 90 * u[1], 5 + 90 * u[2], 10 + 90 * u[3]};
    const std::vector<double> heights{4 * h[0] - 2, 4 * h[1] - 2, 4 * h[2] - 2};
    const Complex there = Row(legs, heights).wave();
    const Complex back = Row({legs.rbegin(), legs.rend()}, {heights.rbegin(), heights.rend()}).wave();
    EXPECT_LT(std::abs(there - back), 1e-12 * std::abs(there));
  }
}

TEST(EdgeRow, Limits) {
  EXPECT_TRUE(row_fits(11));
  EXPECT_FALSE(row_fits(12));
}

}  // namespace
}  // namespace grimaldi
