// Boundary elements against exact wedges, the circle, theorems, and a table of another program.

#include "validation/boundary_elements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/constants.h"
#include "core/contract.h"
#include "tests/validation/rows.h"
#include "validation/bessel.h"
#include "validation/cases/thin_screens.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Point = PolygonBody::Point;
constexpr double k = 2 * pi;  // lengths in wavelengths

/// from ≤ x ≤ from + width, y ≤ top.
PolygonBody endless_block(double from, double width, double top = 0) {
  return {{{from + width, top}, {from, top}}, true, {0, -1}, {0, -1}};
}

double level(Complex field) { return 20 * std::log10(std::abs(field)); }

TEST(BoundaryElements, ExactWedge) {
  // A face along +x and one at the exterior angle nπ from it, both endless: nothing is cut off. Measured 2e-6: panels
  // of 4^-10 wavelengths at the corner, where the field behaves like their length to the power 2/n.
  for (const double n : {1.25, 1.5, 5.0 / 3}) {
    const BoundaryElements wedge({{{{0, 0}}, true, {1, 0}, {std::cos(n * pi), std::sin(n * pi)}}}, k, {.reach = 8});
    for (const double in : {0.4, 1.9}) {
      std::vector<double> azimuths;
      for (double phi = 0.3; phi < n * pi - 0.1; phi += 0.31) azimuths.push_back(phi);
      std::vector<Point> receivers;
      for (const double rho : {0.2, 3.0})
        for (const double phi : azimuths) receivers.push_back({rho * std::cos(phi), rho * std::sin(phi)});
      const auto fields = wedge.line_source({5 * std::cos(in), 5 * std::sin(in)}, receivers);
      const double free = std::abs(line_source_free_field(k, {0, 0}, {8, 0}));
      for (std::size_t i = 0; i < fields.size(); ++i) {
        const double phi = azimuths[i % azimuths.size()], rho = i < azimuths.size() ? 0.2 : 3.0;
        const WedgeField exact = wedge_line_source(n, rho * k, 5 * k, phi, in);
        EXPECT_LE(std::abs(fields[i].soft - exact.soft), 1e-5 * free) << n << ' ' << in << ' ' << rho << ' ' << phi;
        EXPECT_LE(std::abs(fields[i].hard - exact.hard), 1e-5 * free) << n << ' ' << in << ' ' << rho << ' ' << phi;
      }
    }
  }
}

/// Total fields of a unit plane wave towards +x about a circle of radius a, at (ρ, φ).
/// Formula: Σ ε_m (−j)^m [J_m(kρ) − c_m H_m(kρ)] cos mφ, c_m = J_m/H_m (soft), J_m'/H_m' (hard) at ka.
WedgeField circle(double ka, double k_rho, double phi) {
  WedgeField field{};
  for (int m = 0; m < ka + 40; ++m) {
    const auto slope = [&](const auto& f) { return m == 0 ? -f(1) : 0.5 * (f(m - 1) - f(m + 1)); };
    const auto j = [&](int n) { return bessel_j(n, ka); };
    const auto h = [&](int n) { return hankel2(n, ka); };
    const Complex angular = (m == 0 ? 1.0 : 2.0) * std::pow(Complex(0, -1), m) * std::cos(m * phi);
    const Complex outgoing = hankel2(m, k_rho);
    field.soft += angular * (bessel_j(m, k_rho) - j(m) / h(m) * outgoing);
    field.hard += angular * (bessel_j(m, k_rho) - slope(j) / slope(h) * outgoing);
  }
  return field;
}

TEST(BoundaryElements, CircleAtResonancesOfItsInside) {
  // A polygon of the circle's area departs from it by a²-weighted (π/N)²/6 = 4e-4 of its radius and less on average;
  // ka = zeros of J0, J1, J0', where equations without inner points have no answer: there it would be of order 1.
  constexpr int sides = 64;
  for (const double ka : {2.404825557695773, 3.831705970207512, 5.135622301840683, 1.7}) {
    const double radius = ka / k * std::sqrt(2 * pi / sides / std::sin(2 * pi / sides));
    PolygonBody polygon;
    for (int i = 0; i < sides; ++i)
      polygon.corners.push_back(
          {radius * std::cos(2 * pi * (i + 0.5) / sides), radius * std::sin(2 * pi * (i + 0.5) / sides)});
    const BoundaryElements elements({polygon}, k, {.levels = 0});
    std::vector<Point> receivers;
    for (double phi = 0.1; phi < pi; phi += 0.4) receivers.push_back({2 * std::cos(phi), 2 * std::sin(phi)});
    const auto fields = elements.plane_wave(0, receivers);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const WedgeField exact = circle(ka, 2 * k, 0.1 + 0.4 * double(i));
      EXPECT_LE(std::abs(fields[i].soft - exact.soft), 1e-3) << ka << ' ' << i;
      EXPECT_LE(std::abs(fields[i].hard - exact.hard), 1e-3) << ka << ' ' << i;
    }
  }
}

TEST(BoundaryElements, OpticalTheorem) {
  // u_s → f e^{−jkr}/√r; ∫ |f|² dφ = −√(8π/k) Re(e^{−jπ/4} f(forward)) for bodies that take no power. f from the field
  // at r = 2000: its next term is 1/(8kr) times what f varies by over an angle 1/(k·size), 2e-3.
  const PolygonBody house{{{-1, 0}, {1.3, -0.2}, {1.3, 1.1}, {0.2, 1.9}, {-1, 1.1}}, false, {}, {}};
  const PolygonBody other{{{2.1, 0}, {2.6, 0}, {2.6, 0.7}}, false, {}, {}};
  const BoundaryElements elements({house, other}, k, {.levels = 6});
  constexpr double r = 2000, azimuth = 0.3;
  constexpr int directions = 240;  // the far field's highest harmonic is 2·k·size = 50
  std::vector<Point> receivers;
  for (int i = 0; i < directions; ++i) {
    const double phi = azimuth + 2 * pi * i / directions;
    receivers.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  const auto fields = elements.plane_wave(azimuth, receivers);
  for (const bool soft : {true, false}) {
    double scattered = 0;
    Complex forward;
    for (int i = 0; i < directions; ++i) {
      const Point& p = receivers[std::size_t(i)];
      const Complex incident = std::polar(1.0, -k * (p.x * std::cos(azimuth) + p.y * std::sin(azimuth)));
      const WedgeField& field = fields[std::size_t(i)];
      const Complex f = ((soft ? field.soft : field.hard) - incident) * std::sqrt(r) * std::polar(1.0, k * r);
      scattered += std::norm(f) * 2 * pi / directions;
      if (i == 0) forward = f;
    }
    const double extinguished = -std::sqrt(8 * pi / k) * (std::polar(1.0, -pi / 4) * forward).real();
    EXPECT_NEAR(scattered / extinguished, 1, 2e-3) << soft;
  }
}

TEST(BoundaryElements, ReciprocityOverTwoRoofs) {
  const BoundaryElements elements({endless_block(0, 1.7), endless_block(5, 2, 1.2)}, k, {.reach = 8});
  for (const auto& [a, b] : {std::pair{Point{-4, 2}, Point{9, -1.5}}, {Point{-3, -2}, Point{3.5, -3}}}) {
    const WedgeField there = elements.line_source(a, {b}).front(), back = elements.line_source(b, {a}).front();
    const double free = std::abs(line_source_free_field(k, a, b));
    EXPECT_LE(std::abs(there.soft - back.soft), 1e-5 * free);
    EXPECT_LE(std::abs(there.hard - back.hard), 1e-5 * free);
  }
}

TEST(BoundaryElements, AnotherMeshTheSameField) {
  // Finer panels, more of them at corners, endless sides that leave the real axis elsewhere.
  const std::vector<PolygonBody> bodies = {endless_block(0, 1), endless_block(4.3, 1)};
  const BoundaryElements coarse(bodies, k, {.reach = 6}), fine(bodies, k, {.panel = 0.6, .levels = 12, .reach = 8});
  const std::vector<Point> receivers = {{-3, -2}, {2.5, 1}, {2.5, -4}, {9, -3}};
  const auto a = coarse.line_source({-4, 0.5}, receivers), b = fine.line_source({-4, 0.5}, receivers);
  const double free = std::abs(line_source_free_field(k, {-4, 0}, {9, 0}));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    EXPECT_LE(std::abs(a[i].soft - b[i].soft), 2e-5 * free) << i;
    EXPECT_LE(std::abs(a[i].hard - b[i].hard), 2e-5 * free) << i;
  }
}

TEST(BoundaryElements, ThickScreen) {
  // The table says of itself: 0.1 dB above −40 dB where its spread is below 0.05, else 0.3 dB. Soft levels keep that.
  // Its hard levels do not keep reciprocity (TS104 and TS113 exchange source and receiver: −17.43 and −17.17 dB, here
  // −17.29 dB both ways), so they are held to 0.1 dB in the median and 0.5 dB each.
  GRIMALDI_ROWS_OR_SKIP(rows, "radio/thick_screen.csv");
  std::map<double, std::unique_ptr<BoundaryElements>> screens;
  Worst worst_soft, worst_hard;
  std::vector<double> hard_errors;
  for (const Row& row : rows) {
    const double w = number(row, 1);
    if (w > 10) continue;  // 30 wavelengths take as long as all others
    auto& screen = screens[w];
    if (!screen) screen = std::make_unique<BoundaryElements>(std::vector{endless_block(0, w)}, k);
    const Point source{number(row, 2), number(row, 3)}, receiver{number(row, 4), number(row, 5)};
    const Complex free = line_source_free_field(k, source, receiver);
    const WedgeField field = screen->line_source(source, {receiver}).front();
    if (const double table = number(row, 10); table > -40)
      worst_soft.add(std::abs(level(field.soft / free) - table), number(row, 12) < 0.05 ? 0.1 : 0.3, row[0]);
    if (const double table = number(row, 11); table > -40) {
      hard_errors.push_back(std::abs(level(field.hard / free) - table));
      worst_hard.add(hard_errors.back(), 0.5, row[0]);
    }
  }
  worst_soft.expect_within_tolerance(100);
  worst_hard.expect_within_tolerance(100);
  std::sort(hard_errors.begin(), hard_errors.end());
  EXPECT_LE(hard_errors[hard_errors.size() / 2], 0.1);
}

TEST(BoundaryElements, ThinScreens) {
  // The rows of width 3 again, with fewer levels at the corners: 1e-4 of the field, 0.01 dB at −20 dB.
  for (const Screen screen : {Screen::strip, Screen::slit}) {
    std::vector<Point> receivers;
    std::vector<const ThinScreenRow*> rows;
    for (const ThinScreenRow& row : thin_screens)
      if (row.screen == screen && row.width == 3 && row.zs == 9)
        rows.push_back(&row), receivers.push_back({row.x, row.z});
    std::vector<WedgeField> fields[2];
    for (const int i : {0, 1}) {
      const double t = i == 0 ? 0.01 : 0.005, h = 1.5;
      std::vector<PolygonBody> bodies;
      if (screen == Screen::strip)
        bodies = {{{{-t, -h}, {t, -h}, {t, h}, {-t, h}}, false, {}, {}}};
      else
        bodies = {{{{t, -h}, {-t, -h}}, true, {0, -1}, {0, -1}}, {{{-t, h}, {t, h}}, true, {0, 1}, {0, 1}}};
      fields[i] = BoundaryElements(bodies, k, {.levels = 6, .reach = 12}).line_source({-40, 9}, receivers);
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Complex free = line_source_free_field(k, {-40, 9}, receivers[r]);
      const auto compare = [&](Complex coarse, Complex fine, double row) {
        if (row > -20) {
          EXPECT_NEAR(level((2.0 * fine - coarse) / free), row, 0.01) << r;
        }
      };
      compare(fields[0][r].soft, fields[1][r].soft, rows[r]->soft);
      compare(fields[0][r].hard, fields[1][r].hard, rows[r]->hard);
    }
  }
}

TEST(BoundaryElements, Refuses) {
  const PolygonBody square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, false, {}, {}};
  PolygonBody turned = square;
  std::reverse(turned.corners.begin(), turned.corners.end());
  EXPECT_THROW(BoundaryElements({square}, 0), InputErrors);
  EXPECT_THROW(BoundaryElements({turned}, k), InputErrors);
  EXPECT_THROW(BoundaryElements({}, k), InputErrors);
  EXPECT_THROW(BoundaryElements({{{{0, 0}, {1, 0}}, false, {}, {}}}, k), InputErrors);
  const BoundaryElements small({square}, k);
  EXPECT_THROW(small.line_source({0.5, 0.5}, {{2, 2}}), InputErrors);
  EXPECT_THROW(small.line_source({2, 2}, {{0.5, 0.5}}), InputErrors);
  const BoundaryElements endless({endless_block(0, 1)}, k, {.reach = 2});
  EXPECT_THROW(endless.plane_wave(0, {{2, 2}}), InputErrors);
}

}  // namespace
}  // namespace grimaldi
