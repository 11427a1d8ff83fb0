#include "propagation/laws/triangle_transform.h"

#include <algorithm>
#include <cmath>

#include "core/contract.h"
#include "core/sine_cosine.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Complex numbers that a loop over them keeps in registers.
struct Pair {
  double re, im;
};
inline Pair operator+(Pair a, Pair b) { return {a.re + b.re, a.im + b.im}; }
inline Pair operator-(Pair a, Pair b) { return {a.re - b.re, a.im - b.im}; }
inline Pair operator*(Pair a, Pair b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
inline Pair operator*(double s, Pair a) { return {s * a.re, s * a.im}; }
inline Pair conjugate(Pair a) { return {a.re, -a.im}; }
inline Pair choose(bool first, Pair a, Pair b) { return {first ? a.re : b.re, first ? a.im : b.im}; }

// What the loops over directions call is written without branches and inlined, so that the compiler packs them.

/// Phases within this of each other: power series.
constexpr double close = 2;

/// The triangle as the loops want it: sides from corner 0, amplitudes times 2|S|.
struct Prepared {
  double x0, y0, x1, y1, x2, y2;
  std::array<Pair, 3> amplitude;
};

/// Twice the area, to 1e-15 of itself however thin the triangle: differences and products with their rounding errors.
double twice_area_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  struct Difference {
    double value, error;
    Difference(double from, double to) : value(to - from), error(0) {
      const double back = to - value;
      error = (to - (value + back)) + (back - from);
    }
  };
  const Difference x1(a[0], b[0]), y1(a[1], b[1]), x2(a[0], c[0]), y2(a[1], c[1]);
  const double p = x1.value * y2.value, q = y1.value * x2.value;
  const double rounding = std::fma(x1.value, y2.value, -p) - std::fma(y1.value, x2.value, -q);
  const double differences = (x1.value * y2.error + x1.error * y2.value) - (y1.value * x2.error + y1.error * x2.value);
  return std::fabs((p - q) + (rounding + differences));
}

Prepared prepare(const AmplitudeTriangle& t) {
  const auto& [a, b, c] = t.corner;
  Prepared p{a[0], a[1], b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1], {}};
  const double twice_area = twice_area_of(a, b, c);
  for (std::size_t i = 0; i < 3; ++i) p.amplitude[i] = twice_area * Pair{t.amplitude[i].real(), t.amplitude[i].imag()};
  return p;
}

/// −(a x + b y), rounded once or twice where the products cancel.
inline double minus_dot(double a, double b, double x, double y) {
  const double product = b * y;
  return -(std::fma(a, x, product) + std::fma(b, y, -product));
}

/// exp[0, iΔ], exp[0, 0, iΔ] and e^{iΔ}, Δ ≥ 0.
struct Differences {
  Pair first, second, turn;
};

[[gnu::always_inline]] inline Differences differences(double delta) {
  const auto [s, c] = sine_cosine(0.5 * delta);
  const bool apart = delta > 0;
  const double sinc = (apart ? s : 1) / (apart ? 0.5 * delta : 1);
  const double square = delta * delta;
  // (Δ − sin Δ)/Δ², by its series below 1 (next term Δ¹⁷/19! = 8e-18).
  const double series =
      delta *
      (1.0 / 6 -
       square * (1.0 / 120 -
                 square * (1.0 / 5040 -
                           square * (1.0 / 362880 -
                                     square * (1.0 / 39916800 -
                                               square * (1.0 / 6227020800 - square * (1.0 / 1307674368000 -
                                                                                      square / 355687428096000)))))));
  const double direct = (delta - 2 * s * c) / (apart ? square : 1);
  return {{c * sinc, s * sinc}, {0.5 * sinc * sinc, delta < 1 ? series : direct}, {1 - 2 * s * s, 2 * s * c}};
}

/// A sum that is to be turned by a phase.
struct Sum {
  Pair value;
  double phase;
};

/// Σ_j φ_j exp[z₁, z₂, z₃, z_j] for phases 0, d1, d2 that lie apart, by differences from the outermost phases inwards.
[[gnu::always_inline]] inline Sum by_differences(const std::array<Pair, 3>& amplitude, double d1, double d2) {
  // Sorted a ≤ b ≤ c with their amplitudes.
  double a = 0, b = d1, c = d2;
  Pair fa = amplitude[0], fb = amplitude[1], fc = amplitude[2];
  const auto sort = [](double& x, double& y, Pair& fx, Pair& fy) {
    const bool swap = y < x;
    const double low = swap ? y : x, high = swap ? x : y;
    const Pair f_low = choose(swap, fy, fx), f_high = choose(swap, fx, fy);
    x = low, y = high, fx = f_low, fy = f_high;
  };
  sort(a, b, fa, fb);
  sort(b, c, fb, fc);
  sort(a, b, fa, fb);
  const Differences p = differences(b - a), q = differences(c - b);
  const double scale = 1 / (c - a);  // and 1/i below
  const auto over = [scale](Pair x) { return Pair{scale * x.im, -scale * x.re}; };
  const Pair abc = over(p.turn * q.first - p.first);
  const Pair at_a = over(abc - p.second);
  const Pair at_b = over(p.turn * (q.second - conjugate(p.second)));
  const Pair at_c = over(p.turn * (q.turn * conjugate(q.second)) - abc);
  return {fa * at_a + fb * at_b + fc * at_c, a};
}

/// The same for phases within `close` of each other: exp[z…] = Σ_p i^p G_p/(p+3)!, G_p the complete homogeneous
/// polynomials of the phases from their mean. |w| ≤ 4/3: the first term left out is (4/3)²¹/(6·21!) = 1e-18.
[[gnu::always_inline]] inline Sum by_series(const std::array<Pair, 3>& amplitude, double d1, double d2) {
  constexpr int terms = 21;
  const double mean = (d1 + d2) / 3;
  const double w[3] = {-mean, d1 - mean, d2 - mean};
  const double e2 = w[0] * w[1] + w[0] * w[2] + w[1] * w[2], e3 = w[0] * w[1] * w[2];
  double h0 = 0, h1 = 0, h2 = 1;  // H_{p−2}, H_{p−1}, H_p of the three phases, whose sum is 0
  double g[3] = {1, 1, 1}, even[3] = {1.0 / 6, 1.0 / 6, 1.0 / 6}, odd[3] = {0, 0, 0};
  double factorial = 1.0 / 6;
#pragma GCC unroll 32
  for (int p = 1; p < terms; ++p) {
    factorial /= p + 3;
    const double h = -e2 * h1 + e3 * h0;
    h0 = h1, h1 = h2, h2 = h;
    const double sign = (p & 2) != 0 ? -factorial : factorial;
    for (int j = 0; j < 3; ++j) {
      g[j] = h + w[j] * g[j];
      if ((p & 1) != 0)
        odd[j] += sign * g[j];
      else
        even[j] += sign * g[j];
    }
  }
  Pair sum{0, 0};
  for (std::size_t j = 0; j < 3; ++j) sum = sum + amplitude[j] * Pair{even[j], odd[j]};
  return {sum, mean};
}

struct Phases {
  double base, d1, d2, spread;
};

[[gnu::always_inline]] inline Phases phases(const Prepared& t, double kx, double ky) {
  const double d1 = minus_dot(kx, ky, t.x1, t.y1), d2 = minus_dot(kx, ky, t.x2, t.y2);
  const double high = std::max(std::max(d1, d2), 0.0), low = std::min(std::min(d1, d2), 0.0);
  return {minus_dot(kx, ky, t.x0, t.y0), d1, d2, high - low};
}

[[gnu::always_inline]] inline Pair turned(const Sum& sum, double base) {
  const auto [s, c] = sine_cosine(base + sum.phase);
  return sum.value * Pair{c, s};
}

}  // namespace

Complex triangle_transform(const AmplitudeTriangle& triangle, const PlanePoint& kappa) {
  const Prepared t = prepare(triangle);
  const Phases p = phases(t, kappa[0], kappa[1]);
  const Pair value =
      turned(p.spread < close ? by_series(t.amplitude, p.d1, p.d2) : by_differences(t.amplitude, p.d1, p.d2), p.base);
  return {value.re, value.im};
}

void triangle_transform(const AmplitudeTriangle& triangle, std::span<const PlanePoint> kappa,
                        std::span<Complex> transform) {
  GRIMALDI_EXPECT(kappa.size() == transform.size());
  constexpr std::size_t block = 64;
  const Prepared t = prepare(triangle);
  std::array<double, block> base, d1, d2, spread, re, im;
  for (std::size_t begin = 0; begin < kappa.size(); begin += block) {
    const std::size_t count = std::min(block, kappa.size() - begin);
    bool any_close = false;
    for (std::size_t i = 0; i < count; ++i) {
      const Phases p = phases(t, kappa[begin + i][0], kappa[begin + i][1]);
      base[i] = p.base, d1[i] = p.d1, d2[i] = p.d2, spread[i] = p.spread;
    }
    for (std::size_t i = 0; i < count; ++i) any_close |= spread[i] < close;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair value = turned(by_differences(t.amplitude, d1[i], d2[i]), base[i]);
      re[i] = value.re, im[i] = value.im;
    }
    if (any_close)
      for (std::size_t i = 0; i < count; ++i) {
        const Pair value = turned(by_series(t.amplitude, d1[i], d2[i]), base[i]);
        re[i] = spread[i] < close ? value.re : re[i];
        im[i] = spread[i] < close ? value.im : im[i];
      }
    for (std::size_t i = 0; i < count; ++i) transform[begin + i] = {re[i], im[i]};
  }
}

}  // namespace grimaldi
