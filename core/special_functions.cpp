#include "core/special_functions.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

// ---- G(t) = w(e^{3jπ/4} t) = e^{jt²} erfc(e^{jπ/4} t) on the real axis ---------------------------------------------
//
// G obeys G' = 2jtG − 2e^{jπ/4}/√π, G(0) = 1, so its Taylor coefficients at t0 follow from G(t0) alone:
//   g₁ = 2j t0 g₀ − 2e^{jπ/4}/√π,   g_{n+1} = 2j (t0 g_n + g_{n−1}) / (n+1).
// The table below holds them at the centres of intervals of 1/8, made by the compiler in extended precision by going
// from centre to centre. The homogeneous solution e^{jt²} has modulus 1, so errors do not grow on the way: 96 steps of
// 6e-20, over |G(12)| = 0.047, stay below 2e-16 with a factor of 100 to spare.

constexpr int intervals_per_unit = 8;
constexpr int table_end = 12;  // from here the asymptotic series below is at full precision
constexpr std::size_t table_size = static_cast<std::size_t>(table_end) * intervals_per_unit;
// Terms kept: |g_n| ≤ 1/Γ(n/2+1) (the value at 0, the largest), so the first left out is (1/16)¹²/720 = 5e-18.
constexpr std::size_t terms = 12;

struct Coefficient {
  double re, im;
};
using TaylorTable = std::array<std::array<Coefficient, terms>, table_size>;

consteval TaylorTable make_table() {
  constexpr long double sqrt_2_over_pi = 0.797884560802865355879892119868763737L;
  constexpr std::size_t more_terms = 28;  // for the steps: (1/8)²⁸/14! = 6e-37
  constexpr long double step = 1.0L / intervals_per_unit;
  struct Long {
    long double re, im;
  };
  const auto expand = [](long double t0, Long value) {
    std::array<Long, more_terms> g{};
    g[0] = value;
    g[1] = {-2 * t0 * value.im - sqrt_2_over_pi, 2 * t0 * value.re - sqrt_2_over_pi};
    for (std::size_t n = 1; n + 1 < more_terms; ++n) {
      const long double scale = 2.0L / static_cast<long double>(n + 1);
      g[n + 1] = {-scale * (t0 * g[n].im + g[n - 1].im), scale * (t0 * g[n].re + g[n - 1].re)};
    }
    return g;
  };
  const auto sum = [](const std::array<Long, more_terms>& g, long double d) {
    Long value{0, 0};
    for (std::size_t n = more_terms; n-- > 0;) value = {value.re * d + g[n].re, value.im * d + g[n].im};
    return value;
  };
  TaylorTable table{};
  Long value = sum(expand(0, {1, 0}), step / 2);
  for (std::size_t i = 0; i < table_size; ++i) {
    const auto g = expand((static_cast<long double>(i) + 0.5L) * step, value);
    for (std::size_t n = 0; n < terms; ++n) table[i][n] = {static_cast<double>(g[n].re), static_cast<double>(g[n].im)};
    value = sum(g, step);
  }
  return table;
}

alignas(64) constexpr TaylorTable taylor_table = make_table();

// 0 ≤ t < table_end. Even and odd powers apart: two short chains instead of a long one.
Complex ray_by_table(double t) {
  const double scaled = t * intervals_per_unit;
  const auto i = static_cast<std::size_t>(scaled);
  const double d = (scaled - (static_cast<double>(i) + 0.5)) * (1.0 / intervals_per_unit);  // exact
  const double dd = d * d;
  const auto& g = taylor_table[i];
  double even_re = g[terms - 2].re, even_im = g[terms - 2].im;
  double odd_re = g[terms - 1].re, odd_im = g[terms - 1].im;
  for (std::size_t n = terms - 2; n > 0; n -= 2) {
    even_re = even_re * dd + g[n - 2].re;
    even_im = even_im * dd + g[n - 2].im;
    odd_re = odd_re * dd + g[n - 1].re;
    odd_im = odd_im * dd + g[n - 1].im;
  }
  return {even_re + d * odd_re, even_im + d * odd_im};
}

// √π e^{jπ/4} t G(t) = Σ (2k−1)!! (jy)^k, y = 1/(2t²), for t ≥ table_end: y ≤ 1/288, the first term left out (k = 10)
// is 1.6e-16 there and less beyond. Source: Abramowitz & Stegun 7.1.23.
Complex ray_asymptotic_factor(double t) {
  const double y = 0.5 / (t * t);  // 0 when t² overflows: then the factor is 1 to all digits
  const double u = y * y;
  const double re = 1.0 - u * (3.0 - u * (105.0 - u * (10395.0 - u * 2027025.0)));
  const double im = y * (1.0 - u * (15.0 - u * (945.0 - u * (135135.0 - u * 34459425.0))));
  return {re, im};
}

Complex ray_by_series(double t) {
  const Complex factor = ray_asymptotic_factor(t);
  const double scale = 1 / (std::sqrt(2 * pi) * t);  // 1/(√π e^{jπ/4} t) = (1 − j) scale
  return {scale * (factor.real() + factor.imag()), scale * (factor.imag() - factor.real())};
}

// ---- w(z) in the closed first quadrant ------------------------------------------------------------------------------
//
// Trapezium or midpoint rule of step h for w(z) = (jz/π) ∫ e^{−t²}/(z²−t²) dt, with the residue of the pole at t = z
// where it counts. Source: Al Azah & Chandler-Wilde, "Computation of the complex error function using modified
// trapezoidal rules", SIAM J. Numer. Anal. 59 (2021); their bound for N = 11 is 2e-15 with
// exact arithmetic.

constexpr int last_node = 11;
constexpr double node_step = 0.511663353973244236;  // √(π/12)

struct Nodes {
  std::array<double, last_node + 1> square, weight;
};

Nodes make_nodes(double shift) {
  Nodes nodes{};
  for (std::size_t k = 0; k <= last_node; ++k) {
    const double t = (static_cast<double>(k) + shift) * node_step;
    nodes.square[k] = t * t;
    nodes.weight[k] = std::exp(-t * t);
  }
  return nodes;
}

// Σ_{k ≥ first} weight_k / (z² − t_k²), times 2jhz/π
Complex node_sum(Complex z, Complex z2, const Nodes& nodes, std::size_t first) {
  double re = 0, im = 0;
  for (std::size_t k = last_node + 1; k-- > first;) {  // small weights first
    const double a = z2.real() - nodes.square[k];
    const double b = z2.imag();
    const double scale = nodes.weight[k] / (a * a + b * b);
    re += a * scale;
    im -= b * scale;
  }
  return Complex{0, 2 * node_step / pi} * z * Complex{re, im};
}

Complex faddeeva_first_quadrant(double x, double y) {
  static const Nodes midpoint_nodes = make_nodes(0.5), trapezium_nodes = make_nodes(0.0);
  // Beyond 1e8 the next term of Laplace's fraction, 1/(2z²), is under half an ulp.
  if (std::hypot(x, y) > 1e8) return Complex{0, 1 / std::sqrt(pi)} / Complex{x, y};
  const Complex z{x, y};
  const Complex z2{(x - y) * (x + y), 2 * x * y};
  // |residue| ≤ 2 exp(y² − x² − 2πy/h); with y ≥ π/h it is below 1e-16 of |w| in the whole sector where it is left out.
  const double pole_free = pi / node_step;
  if (y >= std::fmax(x, pole_free)) return node_sum(z, z2, midpoint_nodes, 0);
  const double cells = x / node_step;
  const double fraction = cells - std::floor(cells);
  const bool trapezium = y < x && fraction >= 0.25 && fraction <= 0.75;  // keeps the pole h/4 away from the nodes
  Complex residue{0, 0};
  if (y < pole_free) {
    // 2e^{−z²}/(1 ± q), q = e^{−2jπz/h}, |q| = e^{2πy/h} ≥ 1: divided by q, so that nothing overflows.
    const double decay = std::exp(-2 * pi * y / node_step);
    const double turn = 2 * pi * fraction;  // the angle of 1/q, less whole turns
    const Complex inverse_q = std::polar(decay, turn);
    const double sign = trapezium ? -1.0 : 1.0;
    residue = 2.0 * std::exp(-z2) * inverse_q / (inverse_q + sign);
  }
  if (!trapezium) return node_sum(z, z2, midpoint_nodes, 0) + residue;
  return node_sum(z, z2, trapezium_nodes, 1) + Complex{0, node_step / pi} / z + residue;
}

}  // namespace

Complex faddeeva(Complex z) {
  GRIMALDI_EXPECT(std::isfinite(z.real()) && std::isfinite(z.imag()));
  const double x = std::fabs(z.real()), y = std::fabs(z.imag());
  Complex w = faddeeva_first_quadrant(x, y);
  const bool below = z.imag() < 0;
  GRIMALDI_EXPECT(!below || std::hypot(x, y) <= 1e150);
  if (below) {  // w(x − jy) = 2exp(−(x − jy)²) − conj(w(x + jy)) = conj(2exp(−(x + jy)²) − w(x + jy))
    w = 2.0 * std::exp(-Complex{(x - y) * (x + y), 2 * x * y}) - w;
    w = std::conj(w);
  }
  return z.real() < 0 ? std::conj(w) : w;  // w(−z*) = w(z)*
}

Complex faddeeva_on_ray(double t) {
  GRIMALDI_EXPECT(t >= 0);
  return t < table_end ? ray_by_table(t) : ray_by_series(t);
}

void faddeeva_on_ray(std::span<const double> t, std::span<Complex> w) {
  GRIMALDI_EXPECT(t.size() == w.size());
  for (std::size_t i = 0; i < t.size(); ++i) w[i] = t[i] < table_end ? ray_by_table(t[i]) : ray_by_series(t[i]);
}

void transition_function(std::span<const double> x, std::span<Complex> f) {
  GRIMALDI_EXPECT(x.size() == f.size());
  for (std::size_t i = 0; i < x.size(); ++i) f[i] = transition_function(x[i]);
}

Complex transition_function(double x) {
  GRIMALDI_EXPECT(x >= 0);
  const double t = std::sqrt(x);
  if (t >= table_end) return ray_asymptotic_factor(t);
  const Complex g = ray_by_table(t);
  const double scale = std::sqrt(pi / 2) * t;  // √(πx) e^{jπ/4} = (1 + j) scale
  return {scale * (g.real() - g.imag()), scale * (g.real() + g.imag())};
}

Complex knife_edge(double v) {
  GRIMALDI_EXPECT(!std::isnan(v));
  const double a = std::fabs(v);
  const double square = a * a;
  // E(v) = ½ erfc(e^{jπ/4} s) = ½ e^{−js²} G(s), s = √(π/2) v ≥ 0, and E(−v) = 1 − E(v).
  Complex field{0, 0};  // where v² overflows, |E| < 1e-154
  if (std::isfinite(square)) {
    // s² = (π/2) v²: v² to twice the digits, whole turns (multiples of 4) taken off exactly, then the nearest quarter.
    const double rest = std::fma(a, a, -square);
    const double turns = square - 4 * std::floor(square / 4) + rest;
    const double quarter = std::nearbyint(turns);
    const double angle = pi / 2 * (turns - quarter);
    const double c = std::cos(angle), s = std::sin(angle);
    const Complex g = 0.5 * faddeeva_on_ray(std::sqrt(pi / 2) * a);
    const Complex turned{g.real() * c + g.imag() * s, g.imag() * c - g.real() * s};
    switch (static_cast<int>(quarter) & 3) {  // times (−j)^quarter
      case 0:
        field = turned;
        break;
      case 1:
        field = {turned.imag(), -turned.real()};
        break;
      case 2:
        field = -turned;
        break;
      default:
        field = {-turned.imag(), turned.real()};
        break;
    }
  }
  return v >= 0 ? field : 1.0 - field;
}

}  // namespace grimaldi
