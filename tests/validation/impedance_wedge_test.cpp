// The wedge of impedance faces: the equations that define it, its limits, its theorems.

#include "validation/impedance_wedge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/constants.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};
constexpr double exteriors[] = {0.5, 0.8, 1, 1.25, 4.0 / 3, 1.5, 5.0 / 3, 1.9, 2};
// Brewster angles along the normal, on either side of it (complex for β > 1), near grazing; lossy faces of either kind.
const std::vector<Complex> admittances = {
    1, 0.18, 0.4, 0.999, 1.001, 2, 5.39, 1e-3, {2, 1.5}, {2, -1.5}, {0.1, 0.3}, {0.1, -0.3}, {1e-3, -2}, {40, 30}, 1e3};

Complex reflection(Complex beta, double cosine) { return (cosine - beta) / (cosine + beta); }

/// How far a pair of directions is from the shadow and reflection boundaries of the wedge and of all images.
double from_boundaries(double n, double in, double out) {
  double nearest = 1;
  for (const double angle : {in - out, in + out})
    for (const double turn : {pi, -pi}) nearest = std::min(nearest, std::abs(std::sin((angle - turn) / (2 * n))));
  return nearest;
}

/// Directions of one wedge, at least 1e-3 rad from its faces and 2e-3 n rad from its boundaries.
struct Directions {
  double n, in, out;
  Complex admittance;
};
std::vector<Directions> directions(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Directions> list;
  while (list.size() < std::size_t(count)) {
    const double n = exteriors[list.size() % std::size(exteriors)];
    const double in = n * pi * uniform(random), out = n * pi * uniform(random);
    const double nearest = std::min({in, out, n * pi - in, n * pi - out, from_boundaries(n, in, out)});
    if (nearest > 1e-3) list.push_back({n, in, out, admittances[list.size() % admittances.size()]});
  }
  return list;
}

// Its defining equation. The shift by π leaves a few roundings per step and those of the angle, times the distance from
// the zeros and poles that meet on the right side.
TEST(ImpedanceWedge, MaliuzhinetsEquation) {
  for (const double n : exteriors)
    for (double x = -1.5; x <= 1.5; x += 0.1)
      for (const double y : {0.0, 0.3, -1.2, 4.0, -10.0, 28.0}) {
        const Complex z(x, y);
        const Complex ratio = maliuzhinets(n, z + n * pi) / maliuzhinets(n, z - n * pi);
        EXPECT_LE(std::abs(ratio * std::tan(z / 2.0 + pi / 4) - 1.0), 2e-14 * (1 + std::abs(y))) << n << " " << z;
      }
}

// Both ways to the same value: the other identity, ψ(z + π/2) ψ(z − π/2) over a cosine is the same for every z.
TEST(ImpedanceWedge, MaliuzhinetsShift) {
  for (const double n : exteriors) {
    const Complex at_half = maliuzhinets(n, pi / 2);
    for (const double y : {0.2, -3.0, 15.0})
      for (double x = -0.9; x <= 0.9; x += 0.3) {
        // Both factors by the integral: |Re z| ≤ π/2 holds for neither recursion.
        const Complex z(x * pi / 2, y), low = z - pi / 2, high = z + pi / 2;
        const Complex expected = at_half * at_half * std::cos(z / (2 * n));
        EXPECT_LE(std::abs(maliuzhinets(n, low) * maliuzhinets(n, high) / expected - 1.0), 2e-14 * (1 + std::abs(y)));
        EXPECT_EQ(maliuzhinets(n, -z), maliuzhinets(n, z));
      }
  }
}

// The one right-angled wedge has a closed form: 4/3 cos((z−π)/6) cos((z+π)/6)/cos(z/6).
TEST(ImpedanceWedge, MaliuzhinetsOfARightAngle) {
  EXPECT_EQ(maliuzhinets(1.7, 0), 1.0);
  for (double x = -6; x <= 6; x += 0.37)
    for (const double y : {0.1, 0.9, -2.5, 8.0, -28.0}) {
      const Complex z(x, y);
      const Complex expected = 4.0 / 3 * std::cos((z - pi) / 6.0) * std::cos((z + pi) / 6.0) / std::cos(z / 6.0);
      EXPECT_LE(std::abs(maliuzhinets(1.5, z) / expected - 1.0), 2e-14 * (1 + std::abs(y))) << z;
    }
}

// What defines the spectrum: the boundary condition on either face, the incident wave's pole, no other within the
// wedge's angle but images, and a bounded field at the edge.
TEST(ImpedanceWedge, BoundaryCondition) {
  for (const Directions& d : directions(1, 200)) {
    const ImpedanceWedge wedge(d.n, d.admittance);
    for (const Complex& alpha : {Complex(0.3, 0.2), Complex(2, -1), Complex(1, 3), Complex(3, 0.1)})
      for (const double side : {1.0, -1.0}) {
        const double face = side * d.n * pi / 2;
        const Complex here = (std::sin(alpha) + side * d.admittance) * wedge.spectrum(face + alpha, d.in);
        const Complex there = (-std::sin(alpha) + side * d.admittance) * wedge.spectrum(face - alpha, d.in);
        EXPECT_LE(std::abs(here - there), 1e-12 * std::abs(here)) << d.n << " " << d.admittance << " " << alpha;
      }
  }
}

TEST(ImpedanceWedge, BoundedAtTheEdge) {
  for (const double n : exteriors)
    for (const Complex& admittance : admittances) {
      const ImpedanceWedge wedge(n, admittance);
      // Settles once e^{Im α} ≫ |β| as the field on the edge, e^{−Im α/n} and |β| e^{−Im α} from it.
      const Complex far = wedge.spectrum(0.3 + 11.0 * j, 0.3 * n), farther = wedge.spectrum(0.3 + 15.0 * j, 0.3 * n);
      EXPECT_LE(std::abs(farther / far - 1.0), 20 * std::exp(-11 / n) + 40 * (1 + std::abs(admittance)) * std::exp(-11))
          << n << " " << admittance;
    }
}

/// Mean of (α − α₀) s(α) over a circle about α₀: the residue. The next pole lies at least 0.4 rad away.
Complex residue(const ImpedanceWedge& wedge, double alpha, double phi_in) {
  constexpr int points = 24;
  constexpr double radius = 0.1;  // what is left out is 4^−24 = 4e-15
  Complex sum = 0;
  for (int i = 0; i < points; ++i) {
    const Complex step = std::polar(radius, 2 * pi * i / points);
    sum += step * wedge.spectrum(alpha + step, phi_in);
  }
  return sum / double(points);
}

TEST(ImpedanceWedge, ResiduesAreIncidentAndReflectedWaves) {
  for (const double n : {1.0, 1.5, 2.0})
    for (const Complex& admittance : admittances)
      for (const double from_face : {0.5, 2.3}) {
        const ImpedanceWedge wedge(n, admittance);
        const Complex reflected = reflection(admittance, std::sin(from_face));
        // The face 0 at φ = 0 with the wave from `from_face`, face n with the wave as far from that.
        const double centre = from_face - n * pi / 2;
        const auto off = [&](double alpha, double in, const Complex& expected) {
          return std::abs(residue(wedge, alpha, in) - expected);
        };
        EXPECT_LE(off(centre, from_face, 1.0), 1e-13) << n << " " << admittance;
        EXPECT_LE(off(-n * pi - centre, from_face, reflected), 1e-12) << n << " " << admittance;
        EXPECT_LE(off(n * pi + centre, n * pi - from_face, reflected), 1e-12) << n << " " << admittance;
      }
}

// Next to a boundary d = ∓(wave that ends there)/δ, δ into its shadow. The mean over both sides leaves δ².
TEST(ImpedanceWedge, WavesThatEndAtTheBoundaries) {
  constexpr double step = 1e-5;
  for (const double n : {1.3, 1.5, 2.0})
    for (const Complex& admittance : admittances) {
      const ImpedanceWedge wedge(n, admittance);
      const auto jump = [&](double in, double boundary) {
        return 0.5 * step * (wedge.coefficient(in, boundary + step) - wedge.coefficient(in, boundary - step));
      };
      const double in = 0.6, from_n = n * pi - in;
      EXPECT_LE(std::abs(jump(in, in + pi) + 1.0), 1e-8);
      EXPECT_LE(std::abs(jump(from_n, from_n - pi) - 1.0), 1e-8);
      // δ² |R''|, R'' as large as 4/|β|².
      const double tolerance = 1e-8 + 40 * step * step / std::norm(admittance);
      EXPECT_LE(std::abs(jump(in, pi - in) + reflection(admittance, std::sin(in))), tolerance) << n << admittance;
      EXPECT_LE(std::abs(jump(from_n, 2 * n * pi - pi - from_n) - reflection(admittance, std::sin(in))), tolerance)
          << n << admittance;
    }
}

TEST(ImpedanceWedge, Reciprocity) {
  for (const Directions& d : directions(2, 500)) {
    const ImpedanceWedge wedge(d.n, d.admittance);
    const Complex there = wedge.coefficient(d.in, d.out);
    // The rounding of an angle over the square of the distance from a boundary, where d has a pole, and over β, the
    // distance of the zeros of ψ from its poles for directions near a face.
    const double apart = from_boundaries(d.n, d.in, d.out),
                 tolerance = 1e-13 + 1e-15 / (apart * apart) + 1e-15 / std::abs(d.admittance);
    EXPECT_LE(std::abs(wedge.coefficient(d.out, d.in) - there), tolerance)
        << d.n << " " << d.in << " " << d.out << " " << d.admittance;
    // And the wedge turned round.
    EXPECT_LE(std::abs(wedge.coefficient(d.n * pi - d.in, d.n * pi - d.out) - there), tolerance);
  }
}

// A plane has no edge, and a finite admittance lets no wave run along a face.
TEST(ImpedanceWedge, NoWaveFromAPlaneOrAlongAFace) {
  for (const Directions& d : directions(3, 300)) {
    const ImpedanceWedge plane(1, d.admittance), wedge(d.n, d.admittance);
    const double in = d.in / d.n, out = d.out / d.n;
    if (std::abs(in + out - pi) > 1e-2) {
      EXPECT_LE(std::abs(plane.coefficient(in, out)), 1e-11) << d.admittance;
    }
    for (const double face : {0.0, d.n * pi}) {
      const double apart = from_boundaries(d.n, d.in, face);
      if (apart < 0.01) continue;
      EXPECT_LE(std::abs(wedge.coefficient(d.in, face)),
                1e-14 / (apart * apart * std::min(1.0, std::abs(d.admittance))))
          << d.n << " " << d.in << " " << d.admittance;
    }
  }
}

// β → ∞ and → 0: Keller's coefficients. The difference is of the first order in 1/β (β over the cosines to the faces).
TEST(ImpedanceWedge, SoftAndHardLimits) {
  for (const Directions& d : directions(4, 300)) {
    const double n = d.n, k = 1 / (2 * n);
    const auto cot = [&](double angle) { return k / std::tan(angle * k); };
    const double incident = cot(pi + d.out - d.in) + cot(pi - d.out + d.in);
    const double images = cot(pi + d.out + d.in) + cot(pi - d.out - d.in);
    const double size = 1 + incident * incident + images * images;
    const double cosine = std::sin(std::min({d.in, d.out, n * pi - d.in, n * pi - d.out, pi / 2}));
    for (const double little : {1e-3, 1e-6}) {
      EXPECT_LE(std::abs(ImpedanceWedge(n, 1 / little).coefficient(d.in, d.out) - (incident - images)),
                10 * little * size)
          << n << " " << d.in << " " << d.out;
      EXPECT_LE(std::abs(ImpedanceWedge(n, little).coefficient(d.in, d.out) - (incident + images)),
                10 * little * size / cosine)
          << n << " " << d.in << " " << d.out;
    }
  }
}

}  // namespace
}  // namespace grimaldi
