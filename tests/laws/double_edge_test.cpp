// The wave over two edges against quadrature of the double integral, and against what must hold for it.

#include "propagation/laws/double_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "core/special_functions.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

struct Node {
  double x, weight;
};

/// Gauss-Legendre rule of 16 nodes on [-1, 1], by Newton on the polynomial.
std::vector<Node> legendre() {
  constexpr int n = 16;
  std::vector<Node> nodes;
  for (int i = 0; i < n; ++i) {
    double z = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double p = 1, before = 0;
      for (int j = 0; j < n; ++j) {
        const double older = before;
        before = p;
        p = ((2 * j + 1) * z * before - j * older) / (j + 1);
      }
      slope = n * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    nodes.push_back({z, 2 / ((1 - z * z) * slope * slope)});
  }
  return nodes;
}

/// √(1−w²) U₂ by the double integral on rays rotated by −45°, with no special function.
Complex by_quadrature(double q1, double q2, double w) {
  static const std::vector<Node> nodes = legendre();
  const double root = std::sqrt(1 - w * w), end = 6.5 / std::sqrt(1 - std::abs(w));
  const int panels = static_cast<int>(std::ceil(end * 1.5 + 3));
  const Complex turn = std::polar(1.0, pi / 4);
  std::vector<Node> ray;
  for (int p = 0; p < panels; ++p)
    for (const Node& node : nodes)
      ray.push_back({end * (p + 0.5 * (1 + node.x)) / panels, 0.5 * end / panels * node.weight});
  std::vector<Complex> second;
  for (const Node& b : ray) second.push_back(b.weight * std::exp(-2.0 * turn * q2 * b.x));
  Complex sum = 0;
  for (const Node& a : ray) {
    Complex inner = 0;
    for (std::size_t i = 0; i < ray.size(); ++i)
      inner += second[i] * std::exp(-a.x * a.x - ray[i].x * ray[i].x + 2 * w * a.x * ray[i].x);
    sum += a.weight * std::exp(-2.0 * turn * q1 * a.x) * inner;
  }
  return root / pi * sum;
}

Complex edge(double q) { return 0.5 * faddeeva_on_ray(q); }

/// Arguments from 0 over the transition regions to far outside, couplings up to 0.999 of either sign.
struct Draw {
  double q1, q2, w;
};
Draw draw(std::uint64_t i) {
  const auto u = uniform4(11, 1, i, 0);
  const double w = 1 - std::pow(10, -3 * u[2]);
  return {i % 7 == 0 ? 0 : std::pow(10, -3 + 5 * u[0]), i % 11 == 0 ? 0 : std::pow(10, -3 + 5 * u[1]),
          u[3] < 0.5 ? -w : w};
}

TEST(DoubleEdge, AgainstQuadrature) {
  // The rule leaves 1e-14 of smooth panels; the tail beyond `end` is e^{-42}.
  double worst = 0;
  for (const double w : {-0.97, -0.8, -0.3, 0.0, 0.2, 0.5, 0.7, 0.9, 0.97})
    for (const double q1 : {0.0, 0.01, 0.4, 1.1, 2.9, 3.1, 7.0})
      for (const double q2 : {0.0, 0.003, 0.7, 2.2, 5.0}) {
        const double root = std::sqrt(1 - w * w);
        worst = std::max(worst, std::abs(root * double_edge_wave(q1, true, q2, true, w) - by_quadrature(q1, q2, w)));
      }
  EXPECT_LT(worst, 1e-11);
}

TEST(DoubleEdge, QuadrantAtTheCorner) {
  // Both edges on the straight line: |E/E0| = 1/4 + asin(√(d1 d3/((d1+d2)(d2+d3))))/2π. Rounding.
  for (const std::array<double, 3>& d : {std::array{1.0, 1.0, 1.0}, {1000.0, 500.0, 1000.0}, {100.0, 1.0, 100.0}}) {
    const double w = edge_coupling(d[0], d[1], d[2]);
    EXPECT_NEAR(w, std::sqrt(d[0] * d[2] / ((d[0] + d[1]) * (d[1] + d[2]))), 1e-15);
    const Complex field = std::sqrt(1 - w * w) * double_edge_wave(0, true, 0, true, w);
    EXPECT_NEAR(std::abs(field), 0.25 + std::asin(w) / (2 * pi), 1e-14);
    // The rule takes over from the corner's own value without a step.
    EXPECT_NEAR(std::abs(double_edge_wave(1e-9, true, 1e-9, true, w) - double_edge_wave(0, true, 0, true, w)), 0,
                1e-8 / (1 - w * w));
  }
}

TEST(DoubleEdge, ExchangeOfTheEdges) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Draw d = draw(i);
    EXPECT_LT(std::abs(double_edge_wave(d.q1, true, d.q2, false, d.w) - double_edge_wave(d.q2, false, d.q1, true, d.w)),
              1e-12);
  }
}

TEST(DoubleEdge, GoesOverToTheProduct) {
  // The first term left out is |w|/(2 q1 q2) of the product.
  for (const double w : {-0.9, 0.3, 0.9})
    for (const double q1 : {5.0, 40.0, 300.0})
      for (const double q2 : {5.0, 40.0, 300.0}) {
        const Complex product = edge(q1) * edge(q2), wave = double_edge_wave(q1, true, q2, true, w);
        EXPECT_LT(std::abs(wave - product), 0.55 * std::abs(w) / (q1 * q2) * std::abs(product) + 1e-11 / (1 - w * w));
      }
  EXPECT_LT(std::abs(double_edge_wave(0.3, true, 1.2, true, 0) - edge(0.3) * edge(1.2)), 1e-14);
}

TEST(DoubleEdge, JumpIsTheWaveOfTheOtherEdge) {
  // Across q1 = 0: what the single wave of edge 2 loses there. The law's own error, twice.
  for (const double w : {-0.95, -0.5, 0.1, 0.7, 0.99})
    for (const double q2 : {0.0, 0.02, 0.5, 2.0, 9.0, 80.0})
      for (const bool dark2 : {true, false}) {
        const double root = std::sqrt(1 - w * w);
        const Complex jump =
            root * (double_edge_wave(0, true, q2, dark2, w) - double_edge_wave(0, false, q2, dark2, w));
        EXPECT_LT(std::abs(jump - (dark2 ? 1.0 : -1.0) * edge(q2 / root)), 2e-11) << w << " " << q2;
      }
}

TEST(DoubleEdge, EndBesideAnEdge) {
  for (const double w : {-0.9, -0.3, 0.2, 0.7})
    for (const double a : {0.01, 0.6, 2.0, 7.0})
      for (const bool dark : {true, false}) {
        const double root = std::sqrt(1 - w * w), sign = dark ? 1 : -1;
        // Where the path over both edges changes sign: the end's wave of the path that ends there.
        const Complex jump = end_and_edge_wave(a, dark, 0, true, w) - end_and_edge_wave(a, dark, 0, false, w);
        EXPECT_LT(std::abs(jump - sign * edge(root * a) * std::polar(1.0, w * w * a * a)), 2e-11) << w << " " << a;
        // Nothing where the way over the end itself passes the boundary (a change of the place by 1e-9).
        const double there = w * sign * a / root;
        const Complex step = end_and_edge_wave(a, dark, std::abs(there * (1 + 1e-9)), there > 0, w) -
                             end_and_edge_wave(a, dark, std::abs(there * (1 - 1e-9)), there > 0, w);
        EXPECT_LT(std::abs(step), 1e-7) << w << " " << a;
        EXPECT_LT(std::abs(end_and_edge_wave(a, dark, 1.3, false, 0) + sign * edge(a) * edge(1.3)), 1e-14);
      }
}

TEST(DoubleEdge, ExcessAgainstTheWave) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Draw d = draw(i);
    const Complex product = edge(d.q1) * edge(d.q2);
    const Complex excess = double_edge_excess(make_edge_wave(d.q1), make_edge_wave(d.q2), d.w);
    const Complex wave = double_edge_wave(d.q1, true, d.q2, true, d.w);
    EXPECT_LE(std::abs(excess - (wave - product)), 1e-4 * std::abs(product) + 1e-11 / (1 - d.w * d.w))
        << d.q1 << " " << d.q2 << " " << d.w;
  }
}

TEST(DoubleEdge, ExcessOfOppositeSigns) {
  // A soft face takes the difference of both signs of w: it keeps its digits where the product cancels.
  for (const double q1 : {3.0, 12.0, 29.0, 31.0})
    for (const double q2 : {2.0, 14.0, 28.0, 33.0})
      for (const double w : {0.3, 0.9}) {
        const EdgeWave a = make_edge_wave(q1), b = make_edge_wave(q2);
        const Complex odd = double_edge_excess(a, b, w) - double_edge_excess(a, b, -w);
        const Complex truth = double_edge_wave(q1, true, q2, true, w) - double_edge_wave(q1, true, q2, true, -w);
        EXPECT_LE(std::abs(odd - truth), 1e-3 * std::abs(truth) + 4e-11 / (1 - w * w)) << q1 << " " << q2 << " " << w;
      }
}

TEST(DoubleEdge, SlopeIsTheDerivative) {
  // (j/2) dU/dq by central differences: h² of the third derivative (below 4) and 1e-16/h of rounding.
  constexpr double h = 1e-5;
  for (const double q : {0.1, 1.0, 5.0, 29.9}) {
    const Complex slope = Complex(0, 0.5) * (edge(q + h) - edge(q - h)) / (2 * h);
    EXPECT_LT(std::abs(make_edge_wave(q).slope - slope), 1e-9);
  }
  // Series and recurrence agree where one takes over from the other.
  const Complex below = make_edge_wave(30).slope, above = make_edge_wave(std::nextafter(30, 31)).slope;
  EXPECT_LT(std::abs(above - below), 1e-11 * std::abs(below));
}

TEST(DoubleEdge, Moments) {
  // 2j t under the integral is minus the derivative by q: central differences of the wave, h² of its third derivative
  // and 1e-11/h² of its error; series and closed form alike.
  constexpr double h = 1e-3;
  for (const double w : {-0.8, -0.3, -0.02, 0.004, 0.1, 0.5, 0.9})
    for (const double q1 : {0.01, 0.6, 1.3, 4.0})
      for (const double q2 : {0.02, 0.8, 2.5}) {
        const auto excess = [&](double a, double b) {
          return double_edge_wave(a, true, b, true, w) - edge(a) * edge(b);
        };
        const Complex first = Complex(0, 0.5) * (excess(q1 + h, q2) - excess(q1 - h, q2)) / (2 * h);
        const Complex second = Complex(0, 0.5) * (excess(q1, q2 + h) - excess(q1, q2 - h)) / (2 * h);
        const Complex both =
            -0.25 *
            (excess(q1 + h, q2 + h) - excess(q1 + h, q2 - h) - excess(q1 - h, q2 + h) + excess(q1 - h, q2 - h)) /
            (4 * h * h);
        const auto moments = double_edge_moments(make_edge_wave(q1), make_edge_wave(q2), w);
        const double rounding = 2e-4 / (1 - w * w);
        EXPECT_LE(std::abs(moments.first - first), 3e-3 * std::abs(first) + rounding * h)
            << q1 << " " << q2 << " " << w;
        EXPECT_LE(std::abs(moments.second - second), 3e-3 * std::abs(second) + rounding * h)
            << q1 << " " << q2 << " " << w;
        EXPECT_LE(std::abs(moments.both - both), 3e-3 * std::abs(both) + rounding) << q1 << " " << q2 << " " << w;
      }
}

TEST(DoubleEdge, Bound) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Draw d = draw(i);
    const double share = double_edge_share(d.w);
    const double bound = double_edge_bound(d.q1, share) * double_edge_bound(d.q2, share);
    const Complex excess = double_edge_excess(make_edge_wave(d.q1), make_edge_wave(d.q2), d.w);
    for (const double t : {0.0, 0.3, 1.0})
      EXPECT_LE(std::abs(t * edge(d.q1) * edge(d.q2) + excess), bound * (1 + 1e-6) + 1e-11 / (1 - d.w * d.w));
  }
}

}  // namespace
}  // namespace grimaldi
