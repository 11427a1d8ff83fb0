// The law of one straight edge: its anchors in closed form, and against quadrature.

#include "propagation/laws/free_space_diffraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "core/constants.h"
#include "core/special_functions.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// ∫_a^b f by Gauss-Legendre of eight points on `pieces` equal pieces: exact to rounding for what is smooth over a
/// piece.
template <class F>
auto integral(F f, double a, double b, int pieces) {
  // Abramowitz & Stegun, table 25.4, n = 8.
  constexpr double node[] = {0.183434642495649805, 0.525532409916328986, 0.796666477413626740, 0.960289856497536232};
  constexpr double weight[] = {0.362683783378361983, 0.313706645877887287, 0.222381034453374471, 0.101228536290376259};
  decltype(f(a)) sum = 0;
  const double half = 0.5 * (b - a) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double middle = a + (2 * i + 1) * half;
    for (int j = 0; j < 4; ++j) sum += weight[j] * half * (f(middle - node[j] * half) + f(middle + node[j] * half));
  }
  return sum;
}

double power(double v) { return std::norm(edge_wave(v, true)); }

TEST(FreeSpaceDiffraction, HalfTheFieldAtTheBoundary) {
  EXPECT_LT(std::abs(edge_wave(0, true) - 0.5), 1e-16);  // an ulp
  EXPECT_LT(std::abs(edge_wave(0, false) + 0.5), 1e-16);
  EXPECT_NEAR(10 * std::log10(power(0)), -6.0206, 1e-4);  // printed with four digits
}

// U e^{−jπv²/2} = ½ − (1+j)/2 ∫_0^v e^{−jπu²/2} du, the Fresnel knife edge.
TEST(FreeSpaceDiffraction, FieldAgainstQuadrature) {
  for (const double v : {0.01, 0.3, 0.8, 1.5, 2.5, 4.0, 7.0}) {
    const Complex fresnel = integral([](double u) { return std::polar(1.0, -pi * u * u / 2); }, 0, v, 400);
    const Complex field = 0.5 - Complex(0.5, 0.5) * fresnel;
    // Rounding of a sum of 3200 terms of size v/3200.
    EXPECT_LT(std::abs(edge_wave(v, true) * std::polar(1.0, -pi * v * v / 2) - field), 2e-14 * (1 + v)) << v;
    EXPECT_EQ(edge_wave(v, false), -edge_wave(v, true));
  }
}

// Far from the boundary: U → e^{…}/(√2 π v) with a relative remainder of 3/(π v²)² · ½ in power.
TEST(FreeSpaceDiffraction, FarFromTheBoundary) {
  for (const double v : {10.0, 100.0, 1e4, 1e8})
    EXPECT_NEAR(std::abs(edge_wave(v, true)) * std::sqrt(2.0) * pi * v, 1, 3 / std::pow(pi * v * v, 2) + 1e-14) << v;
}

// ∫_0^∞ |E|² dv = 1/(2π); beyond V the asymptote 1/(2π²V) with a relative remainder of order V^−4.
TEST(FreeSpaceDiffraction, TotalPowerInV) {
  const double end = 50;
  const double total = integral(power, 0, end, 2000) + 1 / (2 * pi * pi * end);
  EXPECT_NEAR(2 * pi * total, 1, 1e-9);
}

// The header promises 1e-10 up to v = 1e3.
TEST(FreeSpaceDiffraction, TailAgainstQuadrature) {
  EXPECT_EQ(edge_tail(0), 1);
  double sum = 0, from = 0;
  for (const double v : {1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0, 1000.0}) {
    sum += integral(power, from, v, 4000);
    from = v;
    EXPECT_NEAR(edge_tail(v), 1 - 2 * pi * sum, 1e-10) << v;
  }
}

// It is a tail: it falls, its slope is −2π|U|².
TEST(FreeSpaceDiffraction, TailFallsByTheLaw) {
  for (const double v : {0.1, 0.7, 2.0, 9.0}) {
    const double h = 1e-4;
    // Central difference: h² × third derivative (below 10) = 1e-7, and rounding 1e-16/h = 1e-12.
    EXPECT_NEAR((edge_tail(v + h) - edge_tail(v - h)) / (2 * h), -2 * pi * power(v), 1e-7) << v;
  }
}

TEST(FreeSpaceDiffraction, TailInverse) {
  EXPECT_LT(edge_tail_inverse(1), 1e-15);  // a few ulp of 1 over the slope
  double before = 0;
  for (const double u : {0.999999, 0.9, 0.5, 0.1, 1e-2, 1e-4, 1e-6, 1e-8}) {
    const double v = edge_tail_inverse(u);
    EXPECT_NEAR(edge_tail(v), u, 1e-12) << u;
    EXPECT_GT(v, before) << u;
    before = v;
  }
  for (const double v : {0.01, 0.4, 3.0, 40.0})
    // 1e-12 of the tail over its slope, 2π|U|² = 1/(πv²) at most.
    EXPECT_NEAR(edge_tail_inverse(edge_tail(v)), v, 2e-12 * (1 + pi * v * v)) << v;
}

// Power into the shadow per unit length of edge = irradiance × 0.11254 r_F sin β, r_F = √(λL).
TEST(FreeSpaceDiffraction, ShadowPowerOfAnEdge) {
  for (const double sin_beta : {1.0, 0.6}) {
    const double length = 50, wavelength = 5e-5;  // L/λ = 1e6
    const auto density = [&](double e) { return edge_power_density(length, wavelength, sin_beta, e); };
    // The lobe is 1e-3 rad wide: pieces that grow from there.
    double shadow = 0, from = 0;
    for (double to = 1e-4; from < pi; to *= 2) {
      shadow += integral(density, from, std::min(to, pi), 100);
      from = std::min(to, pi);
    }
    // Five digits are printed; the rest of the order √(λ/L)/sin β comes from 2 sin(ε/2) < ε.
    EXPECT_NEAR(shadow / (sin_beta * std::sqrt(wavelength * length)), 0.11254, 1e-5) << sin_beta;
  }
}

// v against the detour over the edge, 2√(δ/λ): equal for a receiver near the boundary.
TEST(FreeSpaceDiffraction, ParameterIsTheDetour) {
  const double before = 100, behind = 30, wavelength = 0.3;
  const double effective = before * behind / (before + behind);
  for (const double epsilon : {1e-3, 1e-2, 0.1}) {
    const double direct = std::sqrt(before * before + behind * behind + 2 * before * behind * std::cos(epsilon));
    const double detour = 4 * before * behind * std::pow(std::sin(epsilon / 2), 2) / (before + behind + direct);
    const double v = fresnel_parameter(effective, wavelength, 1, epsilon);
    // δ = 2L sin²(ε/2)·2S/(S + R): the second factor is 1 + ε² L/(4 S) at most.
    EXPECT_NEAR(2 * std::sqrt(detour / wavelength) / v, 1, epsilon * epsilon) << epsilon;
  }
  EXPECT_EQ(fresnel_parameter(effective, wavelength, 1, 4), fresnel_parameter(effective, wavelength, 1, pi));
  EXPECT_EQ(fresnel_parameter(effective, wavelength, 1, -0.2), fresnel_parameter(effective, wavelength, 1, 0.2));
  EXPECT_NEAR(fresnel_parameter(effective, wavelength, 0.25, 0.2),
              0.25 * fresnel_parameter(effective, wavelength, 1, 0.2), 1e-15);
}

// The product of an edge's and an end's wave is shared by the two edges of a corner, which exchange both arguments.
// Nothing goes to a term on its boundary, all to an edge whose diffraction point is the corner. Rounding: 1e-15.
TEST(EdgeEnds, SharesOfACorner) {
  for (const double v : {1e-9, 0.02, 1.0, 7.5})
    for (const double v_end : {1e-7, 0.3, 1.0, 40.0})
      EXPECT_NEAR(edge_end_share(v, v_end) + edge_end_share(v_end, v), 1, 1e-15) << v << " " << v_end;
  EXPECT_EQ(edge_end_share(0, 0.5), 0);
  EXPECT_EQ(edge_end_share(0.5, 0), 1);
  EXPECT_EQ(edge_end_share(0, 0), 0.5);
}

// Across an end of an edge nothing jumps: 1 + UV(inside) = UV(outside) = ½ at the end, and two ends of one detour
// cancel.
TEST(FreeSpaceDiffraction, EndsOfAnEdge) {
  const double wavelength = 0.1, k = 2 * pi / wavelength;
  EXPECT_LT(std::abs(1.0 + edge_end_wave(0, wavelength, k, true) - 0.5), 1e-15);
  EXPECT_LT(std::abs(edge_end_wave(0, wavelength, k, false) - 0.5), 1e-15);
  for (const double detour : {1e-4, 1e-2, 1.0}) {
    EXPECT_EQ(edge_end_wave(detour, wavelength, k, true), -edge_end_wave(detour, wavelength, k, false));
    // The end's wave is the knife edge of the detour: v_V = 2√(δ/λ), kδ = πv²/2.
    const Complex knife = knife_edge(2 * std::sqrt(detour / wavelength));
    EXPECT_LT(std::abs(edge_end_wave(detour, wavelength, k, false) - knife), 1e-13) << detour;
  }
}

// 2 ulp of v move the wave by as much of itself, at most.
TEST(EdgeWave, ManyAtOnce) {
  std::vector<double> distance, sine, turn;
  for (int i = 0; i < 777; ++i) {
    distance.push_back(0.01 * std::pow(1.02, i));
    sine.push_back(0.05 + 0.95 * ((i * 37) % 100) / 100.0);
    turn.push_back(i % 50 == 0 ? 0 : (i % 2 == 0 ? 1 : -1) * 4e-6 * std::pow(1.02, i));
  }
  std::vector<std::complex<double>> waves(turn.size());
  edge_waves(distance, 0.1, sine, turn, waves);
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const auto one = edge_wave(fresnel_parameter(distance[i], 0.1, sine[i], turn[i]), turn[i] >= 0);
    EXPECT_LE(std::abs(waves[i] - one), 2e-15 * std::abs(one)) << i;
  }
}

}  // namespace
}  // namespace grimaldi
