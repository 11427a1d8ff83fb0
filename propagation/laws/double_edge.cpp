#include "propagation/laws/double_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/constants.h"
#include "core/contract.h"
#include "core/sine_cosine.h"
#include "core/special_functions.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Complex edge(double q) { return 0.5 * faddeeva_on_ray(q); }

const double inverse_root = 1 / std::sqrt(8 * pi);  // e^{−jπ/4}/(2√π) = (1−j)/√(8π)
constexpr double far_argument = 30;                 // from here series in 1/q: their last term is 420/(4q²)² = 3e-5

constexpr std::size_t nodes = 10;

// Positive half of the Gauss-Legendre rule of 20 nodes: their squares, and the weights.
constexpr std::array<double, nodes> node_square = {
    0.005856308436795615, 0.0518863939803237, 0.13965624074297703, 0.2609850936822264, 0.4045642847657475,
    0.5570113146004433,   0.7041172924000904, 0.8321716520870234,  0.9292418765798955, 0.9863044145193488};
constexpr std::array<double, nodes> node_weight = {
    0.15275338713072578, 0.14917298647260366, 0.14209610931838187, 0.13168863844917653, 0.11819453196151825,
    0.10193011981724026, 0.08327674157670467, 0.06267204833410944, 0.04060142980038622, 0.017614007139153273};

// Gauss-Laguerre rule.
constexpr std::array<double, nodes> decay_node = {
    0.1377934705404926, 0.729454549503171,  1.8083429017403159, 3.4014336978548996, 5.552496140063804,
    8.330152746764497,  11.843785837900066, 16.279257831378104, 21.99658581198076,  29.92069701227389};
constexpr std::array<double, nodes> decay_weight = {
    0.3084411157650173,    0.4011199291552761,     0.2180682876118096,    0.062087456098677773,  0.0095015169751811,
    0.0007530083885875384, 2.8259233495995642e-05, 4.249313984962698e-07, 1.839564823979633e-09, 9.91182721960906e-13};

/// Up to this y by the finite integral: the rule's error is J₂₀(y²/2) = 5e-12 there, and 2.41⁻⁴⁰ for the pole.
constexpr double finite_limit = 3;

/// g(x, y) for x ≥ y ≥ 0, x > 0; ux = U(x).
Complex steep(double x, double y, Complex ux) {
  double re = 0, im = 0;
  if (y <= finite_limit) {
    // e^{jy²} [½U(x) − (x/2π) ∫₀^y e^{−jt²}/(x²+t²) dt].
    const double y2 = y * y, x2 = x * x;
    std::array<double, nodes> c, s;
    for (std::size_t i = 0; i < nodes; ++i) {
      const SineCosine turn = sine_cosine(y2 * (1 - node_square[i]));
      const double size = node_weight[i] / (x2 + y2 * node_square[i]);
      c[i] = size * turn.cosine;
      s[i] = size * turn.sine;
    }
    for (std::size_t i = 0; i < nodes; ++i) re += c[i], im += s[i];
    const double scale = x * y / (2 * pi);
    const SineCosine turn = sine_cosine(y2);
    return 0.5 * times(ux, {turn.cosine, turn.sine}) - Complex(scale * re, scale * im);
  }
  // −(jx/4π) ∫₀^∞ e^{−σ}/((r²−jσ)√(y²−jσ)) dσ, r² = x²+y²; the nearest singularity −jy² makes an error of
  // e^{−4√(n/2) y} = 2e-12.
  const double y2 = y * y, r2 = x * x + y2;
  std::array<double, nodes> a, b;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double t = decay_node[i];
    // √(y²−jt) = p − jt/2p; its product with r² − jt has the square (r⁴+t²)√(y⁴+t²).
    const double size = std::sqrt(y2 * y2 + t * t), p = std::sqrt(0.5 * (size + y2)), h = 0.5 * t / p;
    const double scale = decay_weight[i] / ((r2 * r2 + t * t) * size);
    a[i] = scale * (r2 * p - t * h);
    b[i] = scale * (r2 * h + t * p);
  }
  for (std::size_t i = 0; i < nodes; ++i) re += a[i], im += b[i];
  const double scale = x / (4 * pi);
  return {scale * im, -scale * re};
}

/// g(x, y), y ≥ 0, uy = U(y); odd in x.
Complex generalised_fresnel(double x, double y, Complex uy) {
  const double size = std::fabs(x);
  if (size == 0) return 0;
  const Complex ux = edge(size);
  const Complex value = size >= y ? steep(size, y, ux) : times(ux, uy) - steep(y, size, uy);
  return x > 0 ? value : -value;
}

/// √(1−w²) U₂ for both edges dark.
Complex orthant(double q1, Complex u1, double q2, Complex u2, double w, double root) {
  // At the corner itself g depends on the direction from which it is reached: the share of the quadrant.
  if (q1 + q2 < 1e-100) return 0.25 + std::asin(w) / (2 * pi);
  return generalised_fresnel((q1 + w * q2) / root, q2, u2) + generalised_fresnel((q2 + w * q1) / root, q1, u1);
}

/// I₂ and I₃ of I_n = √(j/π) ∫₀^∞ tⁿ e^{−jt²−2jqt} dt, I₀ = U(q): I_{n+1} = −q I_n − (jn/2) I_{n−1}.
std::array<Complex, 2> further_integrals(const EdgeWave& edge_wave) {
  const double q = edge_wave.argument;
  const Complex u = edge_wave.wave, one = edge_wave.slope;
  if (q > far_argument) {
    // e^{jπ/4}/√π n!/(2jq)^{n+1} Σ (n+2m)!/(n! m!) (j/4q²)^m, and 1/(2jq) = −jh.
    const double h = 0.5 / q, y = h * h;
    const Complex second(1 - 180 * y * y, 12 * y), third(1 - 420 * y * y, 20 * y);
    const double scale = 2 * inverse_root * y;
    return {times({-2 * h * scale, 2 * h * scale}, second), times({6 * y * scale, 6 * y * scale}, third)};
  }
  const Complex two = -q * one + Complex(0.5 * u.imag(), -0.5 * u.real());
  return {two, -q * two + Complex(one.imag(), -one.real())};
}

constexpr double least_argument = 0.7;

}  // namespace

double edge_coupling(double before, double between, double behind) {
  GRIMALDI_EXPECT(before > 0 && between > 0 && behind > 0);
  return 1 / std::sqrt((1 + between / before) * (1 + between / behind));
}

Complex double_edge_wave(double q1, bool dark1, double q2, bool dark2, double coupling) {
  GRIMALDI_EXPECT(q1 >= 0 && q2 >= 0 && std::abs(coupling) < 1);
  const double root = std::sqrt((1 - coupling) * (1 + coupling));
  const bool same = dark1 == dark2;
  const Complex wave = orthant(q1, edge(q1), q2, edge(q2), same ? coupling : -coupling, root) / root;
  return same ? wave : -wave;
}

Complex end_and_edge_wave(double end, bool end_dark, double other, bool other_dark, double coupling) {
  const double root = std::sqrt((1 - coupling) * (1 + coupling));
  const double a = end_dark ? end : -end, b = other_dark ? other : -other;
  const double seen = root * b - coupling * a, alone = root * a + coupling * b;
  const bool seen_dark = seen > 0;
  const Complex wave = root * double_edge_wave(end, end_dark, std::fabs(seen), seen_dark, coupling);
  if (seen_dark == other_dark) return wave;
  const SineCosine turn = sine_cosine(seen * seen);
  const Complex single = times(edge(std::fabs(alone)), {turn.cosine, turn.sine});
  return (alone > 0) == other_dark ? wave + single : wave - single;
}

EdgeWave make_edge_wave(double q, Complex u) {
  if (q <= far_argument) return {q, u, Complex(inverse_root, -inverse_root) - q * u};
  const double h = 0.5 / q, y = h * h, scale = -2 * inverse_root * y;
  return {q, u, times({scale, scale}, {1 - y * y * (60 - 15120 * y * y), y * (6 - 840 * y * y)})};
}

EdgeWave make_edge_wave(double q) { return make_edge_wave(q, edge(q)); }

Complex double_edge_excess(const EdgeWave& first, const EdgeWave& second, double coupling) {
  GRIMALDI_EXPECT(std::abs(coupling) < 1);
  const double q1 = first.argument, q2 = second.argument;
  const double strength = std::abs(coupling), size = std::max(q1, least_argument) * std::max(q2, least_argument);
  const Complex step(0, 2 * coupling);
  if (strength < 0.008 * size) return times(step, times(first.slope, second.slope));
  if (strength < 0.04 * size) {
    const auto a = further_integrals(first), b = further_integrals(second);
    const Complex later = times(a[0], b[0]) + times(step, times(a[1], b[1])) * (1.0 / 3);
    return times(step, times(first.slope, second.slope) + 0.5 * times(step, later));
  }
  const double root = std::sqrt((1 - coupling) * (1 + coupling));
  return orthant(q1, first.wave, q2, second.wave, coupling, root) / root - times(first.wave, second.wave);
}

DoubleEdgeMoments double_edge_moments(const EdgeWave& first, const EdgeWave& second, double coupling) {
  GRIMALDI_EXPECT(std::abs(coupling) < 1);
  const double q1 = first.argument, q2 = second.argument;
  const double strength = std::abs(coupling), size = std::max(q1, least_argument) * std::max(q2, least_argument);
  if (strength < 0.04 * size) {
    const Complex step(0, 2 * coupling), half = 0.5 * times(step, step);
    const auto a = further_integrals(first), b = further_integrals(second);
    // The third term of a moment, in I₄, is left out.
    return {double_edge_excess(first, second, coupling),
            times(step, times(a[0], second.slope)) + times(half, times(a[1], b[0])),
            times(step, times(first.slope, b[0])) + times(half, times(a[0], b[1])),
            times(step, times(a[0], b[0])) + times(half, times(a[1], b[1]))};
  }
  const double rest = (1 - coupling) * (1 + coupling), root = std::sqrt(rest);
  const Complex whole = orthant(q1, first.wave, q2, second.wave, coupling, root) / root;
  const Complex unit(inverse_root, -inverse_root);
  const auto moment = [&](const EdgeWave& of, const EdgeWave& other) {
    return (times(unit, other.wave + coupling * of.wave) - (of.argument + coupling * other.argument) * whole) / rest;
  };
  const Complex moment1 = moment(first, second), moment2 = moment(second, first);
  const Complex both =
      (times(unit, second.slope) + times({0, -0.5 * coupling}, whole) - (q1 + coupling * q2) * moment2) / rest;
  return {whole - times(first.wave, second.wave), moment1 - times(first.slope, second.wave),
          moment2 - times(first.wave, second.slope), both - times(first.slope, second.slope)};
}

Complex second_moment(const EdgeWave& wave) { return further_integrals(wave)[0]; }

double double_edge_share(double coupling) {
  GRIMALDI_EXPECT(std::abs(coupling) < 1);
  const double w = std::abs(coupling);
  return std::sqrt((0.25 + std::asin(w) / (2 * pi)) / std::sqrt((1 - w) * (1 + w)));
}

double double_edge_bound(double argument, double share) {
  constexpr double tail = 0.3;  // |U| ≤ 1/(2√π q) = 0.282/q
  return share * argument > tail ? tail / argument : share;
}

}  // namespace grimaldi
