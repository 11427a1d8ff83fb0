// The exact wedge: its methods against each other, its limits, its theorems.

#include "validation/wedge_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/bessel.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

double difference(const WedgeField& a, const WedgeField& b) {
  return std::max(std::abs(a.soft - b.soft), std::abs(a.hard - b.hard));
}

// Wedges of all kinds, and directions anywhere, on faces and on shadow boundaries.
struct Case {
  double n, phi, phip;
};
std::vector<Case> cases(unsigned seed, int count) {
  const std::vector<double> known = {2, 5.0 / 3, 1.75, 1.5, 4.0 / 3, 1.25, 1.1, 1, 0.75, 2.0 / 3, 0.5, 0.3};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Case> list;
  for (int i = 0; i < count; ++i) {
    const double n = i % 3 == 0 ? 0.2 + 1.8 * uniform(random) : known[static_cast<std::size_t>(i) % known.size()];
    const double phip = n * pi * uniform(random);
    double phi = n * pi * uniform(random);
    const double boundaries[] = {phip + pi, pi - phip, phip - pi, (2 * n - 1) * pi - phip, 0, n * pi};
    if (i % 2 == 1) {
      const double boundary = boundaries[static_cast<std::size_t>(i / 2) % 6];
      if (boundary >= 0 && boundary <= n * pi) phi = boundary;
    }
    list.push_back({n, phi, phip});
  }
  return list;
}

TEST(WedgeSeries, PlaneWaveMethodsAgree) {
  for (const double k_rho : {0.01, 0.2, 1.0, 5.0, 20.0, 60.0, 150.0, 1000.0})
    for (const Case& c : cases(1, k_rho < 100 ? 120 : 24))
      // Kρ terms of the series, each good to 1e-15 and smaller than one; small n weighs the sum by 1/n.
      EXPECT_LE(difference(wedge_plane_wave(c.n, k_rho, c.phi, c.phip, WedgeMethod::series),
                           wedge_plane_wave(c.n, k_rho, c.phi, c.phip, WedgeMethod::contour)),
                (1e-14 + 1e-15 * k_rho) / std::min(c.n, 1.0))
          << c.n << " " << k_rho << " " << c.phi << " " << c.phip;
}

TEST(WedgeSeries, LineSourceMethodsAgree) {
  for (const double k_rho : {0.01, 0.3, 2.0, 12.0, 35.0})
    for (const double k_rho_s : {1.5 * k_rho, 4 * k_rho})
      for (const Case& c : cases(2, 24))
        // The field is |H0|/4 ~ 0.1; see above.
        EXPECT_LE(difference(wedge_line_source(c.n, k_rho, k_rho_s, c.phi, c.phip, WedgeMethod::series),
                             wedge_line_source(c.n, k_rho, k_rho_s, c.phi, c.phip, WedgeMethod::contour)),
                  (2e-15 + 1e-16 * k_rho_s) / std::min(c.n, 1.0))
            << c.n << " " << k_rho << " " << k_rho_s << " " << c.phi << " " << c.phip;
}

// n = 1 is a mirror: incident wave and image, nothing else.
TEST(WedgeSeries, Mirror) {
  const double phi = 1.1, phip = 2.3;
  const auto field = [](Complex incident, Complex image) { return WedgeField{incident - image, incident + image}; };
  const auto plane = [&](double k_rho, double angle) { return std::polar(1.0, k_rho * std::cos(angle)); };
  for (const double k_rho : {0.5, 17.0, 30.0, 400.0})
    EXPECT_LE(
        difference(wedge_plane_wave(1, k_rho, phi, phip), field(plane(k_rho, phi - phip), plane(k_rho, phi + phip))),
        1e-14 + 1e-15 * k_rho);
  const auto apart = [](double a, double b, double angle) {
    return std::sqrt(a * a + b * b - 2 * a * b * std::cos(angle));
  };
  const auto line = [&](double angle) { return -j / 4.0 * hankel2(0, apart(5, 4.5, angle)); };
  EXPECT_LE(difference(wedge_line_source(1, 5, 4.5, phi, phip), field(line(phi - phip), line(phi + phip))), 5e-15);
  const auto point = [&](double angle) {
    const double R = std::hypot(apart(2, 3, angle), 1.5);
    return std::polar(1 / R, -7 * R);
  };
  EXPECT_LE(
      difference(wedge_point_source(1, 7, {3, phip, 0}, {2, phi, 1.5}), field(point(phi - phip), point(phi + phip))),
      1e-14);
}

TEST(WedgeSeries, Reciprocity) {
  for (const Case& c : cases(3, 30)) {
    // The series sorts the radii; the contour sees them alike. Here the angles change places.
    EXPECT_LE(difference(wedge_line_source(c.n, 3, 8, c.phi, c.phip), wedge_line_source(c.n, 8, 3, c.phip, c.phi)),
              1e-14 / std::min(c.n, 1.0));
    const EdgePoint a{2, c.phi, 0.3}, b{0.7, c.phip, -1};
    EXPECT_LE(difference(wedge_point_source(c.n, 9, a, b), wedge_point_source(c.n, 9, b, a)),
              5e-14 / std::min(c.n, 1.0));
  }
}

TEST(WedgeSeries, Faces) {
  for (const double n : {2.0, 5.0 / 3, 1.5, 1.25})
    for (const double face : {0.0, n * pi}) {
      const double h = 1e-5, inside = face == 0 ? h : face - h;
      const auto check = [&](const auto& field, double k_rho, double scale) {
        EXPECT_EQ(field(face).soft, 0.0);
        // Soft rises linearly, |∂u/∂φ| ≤ 2kρ + 2; hard is flat, |∂²u/∂φ²|/2 ≤ (kρ)² + 2kρ + 2.
        EXPECT_LE(std::abs(field(inside).soft), scale * (2 * k_rho + 2) * h);
        EXPECT_LE(std::abs(field(inside).hard - field(face).hard),
                  scale * (k_rho * k_rho + 2 * k_rho + 2) * h * h + 1e-13);
      };
      for (const double k_rho : {1.0, 50.0})
        check([&](double phi) { return wedge_plane_wave(n, k_rho, phi, 1.0); }, k_rho, 1);
      check([&](double phi) { return wedge_line_source(n, 4, 11, phi, 1.0); }, 4, 1);
      check([&](double phi) { return wedge_point_source(n, 5, {2, 1.0, 0}, {1.5, phi, 1}); }, 7.5, 1);
    }
}

TEST(WedgeSeries, ContinuousAcrossBoundaries) {
  // Within 1e-9 rad of a boundary a field moves by no more than its slope, |∂u/∂φ| ≤ 2kρ + 2√kρ.
  for (const double n : {2.0, 5.0 / 3, 1.5})
    for (const double k_rho : {30.0, 1e3, 1e5})
      for (const double boundary : {pi + 0.6, pi - 0.6})
        for (const double step : {1e-9, 1e-15})
          EXPECT_LE(difference(wedge_plane_wave(n, k_rho, boundary - step, 0.6),
                               wedge_plane_wave(n, k_rho, boundary + step, 0.6)),
                    10 * k_rho * step + 1e-15 * k_rho + 1e-14)
              << n << " " << k_rho;
}

TEST(WedgeSeries, SolvesHelmholtz) {
  // u_rr + u_r/r + u_φφ/r² + u = 0 (lengths times k) by differences of sixth order: error h⁶ of the seventh derivative,
  // and rounding 1e-15/h².
  const double n = 5.0 / 3, h = 0.03;
  constexpr double second[] = {-49.0 / 18, 1.5, -0.15, 1.0 / 90}, first[] = {0, 0.75, -0.15, 1.0 / 60};
  const auto check = [&](const auto& field, double r, double phi) {
    for (const bool hard : {false, true}) {
      const auto u = [&](double at_r, double at_phi) {
        const WedgeField f = field(at_r, at_phi);
        return hard ? f.hard : f.soft;
      };
      Complex rr = second[0] * u(r, phi), r1 = 0, across = rr;
      for (int i = 1; i <= 3; ++i) {
        const Complex out = u(r + i * h, phi), in = u(r - i * h, phi);
        rr += second[i] * (out + in);
        r1 += first[i] * (out - in);
        across += second[i] * (u(r, phi + i * h / r) + u(r, phi - i * h / r));
      }
      EXPECT_LE(std::abs((rr + across) / (h * h) + r1 / (h * r) + u(r, phi)), 2e-9);
    }
  };
  for (const double phi : {0.7, pi - 1.0, 3.9, pi + 1.0, 4.7}) {
    check([&](double r, double at) { return wedge_plane_wave(n, r, at, 1.0, WedgeMethod::contour); }, 12, phi);
    check([&](double r, double at) { return wedge_line_source(n, r, 9, at, 1.0, WedgeMethod::contour); }, 5, phi);
  }
}

TEST(WedgeSeries, FarLineSourceIsAPlaneWave) {
  // Over the incident field at the edge. Left: kρ²/2ρ_s of phase, of the wave and its slow change.
  const double k_rho = 6, far = 1e8;
  for (const Case& c : cases(4, 12)) {
    WedgeField line = wedge_line_source(c.n, k_rho, far, c.phi, c.phip);
    const Complex edge = -j / 4.0 * hankel2(0, far);
    line.soft /= edge;
    line.hard /= edge;
    EXPECT_LE(difference(line, wedge_plane_wave(c.n, k_rho, c.phi, c.phip)), 2 * k_rho * k_rho / far + 2e-8) << c.n;
  }
}

TEST(WedgeSeries, FarPointSourceIsAPlaneWave) {
  const double k = 3, rho = 2, far = 1e8;
  for (const Case& c : cases(5, 12)) {
    WedgeField point = wedge_point_source(c.n, k, {far, c.phip, 0}, {rho, c.phi, 0});
    const Complex edge = std::polar(1 / far, -k * far);
    point.soft /= edge;
    point.hard /= edge;
    // kρ²/2ρ_s, and the phase of 3e8 rad, good to 6e-8.
    EXPECT_LE(difference(point, wedge_plane_wave(c.n, k * rho, c.phi, c.phip)), 4e-7) << c.n;
  }
}

TEST(WedgeSeries, PointSourcesInARowAreALineSource) {
  // ∫ e^{−jkR}/R dz = 4π (−j/4) H0^(2). The row ends in a smooth fade, so that its ends send nothing to the receiver:
  // the fade is longer than many Fresnel zones; 1e-9 is what it leaves.
  const double n = 1.5, k = 6, rho = 1.2, rho_s = 0.8, phi = 3.6, phip = 1.0, full = 30, end = 90;
  const auto fade = [&](double z) {
    if (z <= full) return 1.0;
    const double x = (z - full) / (end - full);
    return x >= 1 ? 0.0 : 0.5 * std::erfc(2.2 * (2 * x - 1) / std::sqrt(x * (1 - x) * 4));
  };
  for (const bool hard : {false, true}) {
    const Integral row = integrate(
        [&](double z) {
          const WedgeField u = wedge_point_source(n, k, {rho_s, phip, z}, {rho, phi, 0});
          return 2 * fade(z) * (hard ? u.hard : u.soft);
        },
        0, end, 1e-9, 60);
    const WedgeField line = wedge_line_source(n, k * rho, k * rho_s, phi, phip);
    EXPECT_LE(std::abs(row.value / (4 * pi) - (hard ? line.hard : line.soft)), 1e-8);
  }
}

// Point source by the edge integral of Biot, Tolstoy and Medwin: p = −(ν/4π) ∫ Σβ_i e^{−jk(m+l)}/(ml) dz along the
// edge, turned about the apex so that it decays; with the geometrical waves.
Complex edge_integral(double n, double k, const EdgePoint& s, const EdgePoint& r, bool hard) {
  const double nu = 1 / n, apex = s.z + (r.z - s.z) * s.rho / (s.rho + r.rho);
  const Complex ray = std::polar(1.0, -0.3);
  const double reach = 45 / (2 * k * std::sin(0.3)) + 5;
  const auto beta = [&](Complex eta, double angle) {
    return std::sin(nu * angle) / (std::cosh(nu * eta) - std::cos(nu * angle));
  };
  const auto integrand = [&](double along) {
    const Complex z = apex + along * ray;
    const Complex m = std::sqrt(s.rho * s.rho + (z - s.z) * (z - s.z)),
                  l = std::sqrt(r.rho * r.rho + (z - r.z) * (z - r.z));
    const Complex eta = std::acosh((m * l + (z - s.z) * (z - r.z)) / (s.rho * r.rho));
    const double sign = hard ? 1 : -1;
    const Complex sum = beta(eta, pi + r.phi - s.phi) + beta(eta, pi - r.phi + s.phi) +
                        sign * (beta(eta, pi + r.phi + s.phi) + beta(eta, pi - r.phi - s.phi));
    return ray * sum * std::exp(-j * k * (m + l)) / (m * l);
  };
  const Complex diffracted =
      integrate(integrand, -reach, 0, 1e-13, 8).value + integrate(integrand, 0, reach, 1e-13, 8).value;
  Complex field = -nu / (4 * pi) * diffracted;
  for (const double image : {-1.0, 1.0})
    for (int turn = -3; turn <= 3; ++turn) {
      const double theta = r.phi + image * s.phi + 2 * pi * n * turn;
      if (std::fabs(theta) >= pi) continue;
      const double R =
          std::sqrt(std::pow(r.z - s.z, 2) + s.rho * s.rho + r.rho * r.rho - 2 * s.rho * r.rho * std::cos(theta));
      field += (image < 0 || hard ? 1.0 : -1.0) * std::polar(1 / R, -k * R);
    }
  return field;
}

TEST(WedgeSeries, PointSourceByTheEdgeIntegral) {
  // Two different integrals; 1e-13 is what the quadrature of the second is asked for.
  for (const double n : {2.0, 1.75, 5.0 / 3, 1.5, 4.0 / 3, 1.1})
    for (const double k : {1.0, 9.0, 60.0})
      for (const double phi : {0.2, 1.4, 2.6, 3.3}) {
        const EdgePoint source{1.1, 0.9, 0.4}, receiver{2.3, phi, -0.7};
        const WedgeField field = wedge_point_source(n, k, source, receiver);
        EXPECT_LE(std::abs(field.soft - edge_integral(n, k, source, receiver, false)), 5e-13)
            << n << " " << k << " " << phi;
        EXPECT_LE(std::abs(field.hard - edge_integral(n, k, source, receiver, true)), 5e-13)
            << n << " " << k << " " << phi;
      }
}

TEST(WedgeSeries, OnTheEdge) {
  for (const double n : {2.0, 1.5, 0.5}) {
    // The field next to the edge tends to that on it like (kρ)^{1/n}.
    const double near = 1e-12, rest = 30 * std::pow(near, 1 / n) + 1e-14;
    EXPECT_LE(difference(wedge_plane_wave(n, near, 0.4, 0.7), wedge_plane_wave(n, 0, 0.4, 0.7)), rest);
    EXPECT_LE(difference(wedge_line_source(n, near, 5, 0.4, 0.7), wedge_line_source(n, 0, 5, 0.4, 0.7)), rest);
    EXPECT_LE(difference(wedge_line_source(n, 5, near, 0.4, 0.7), wedge_line_source(n, 5, 0, 0.4, 0.7)), rest);
    EXPECT_LE(difference(wedge_point_source(n, 2, {3, 0.4, 0}, {near, 0.7, 1}),
                         wedge_point_source(n, 2, {3, 0.4, 0}, {0, 0.7, 1})),
              rest);
  }
}

TEST(WedgeSeries, SameDistanceFromTheEdge) {
  // Where the series of a line source falls off slowest, and the branch point of the point source meets R = 0.
  for (const Case& c : cases(6, 24)) {
    if (std::fabs(c.phi - c.phip) < 0.05) continue;
    const WedgeField line = wedge_line_source(c.n, 4, 4, c.phi, c.phip);
    const WedgeField beside = wedge_line_source(c.n, 4, 4 * (1 + 1e-9), c.phi, c.phip);
    EXPECT_LE(difference(line, beside), 1e-6);  // the slope may reach 1/(distance)
    const WedgeField point = wedge_point_source(c.n, 4, {1, c.phip, 0}, {1, c.phi, 0});
    const WedgeField next = wedge_point_source(c.n, 4, {1, c.phip, 0}, {1 + 1e-9, c.phi, 0});
    EXPECT_LE(difference(point, next), 1e-5);  // 1/(distance)²
  }
}

TEST(WedgeSeries, Refuses) {
  EXPECT_THROW(wedge_plane_wave(1.5, 1, 1.5 * pi + 1e-6, 1), InputErrors);
  EXPECT_THROW(wedge_plane_wave(1.5, 1, 1, -1e-6), InputErrors);
  EXPECT_NO_THROW(wedge_plane_wave(5.0 / 3, 1, 300 * pi / 180, 1));
  EXPECT_THROW(wedge_plane_wave(2.1, 1, 1, 1), InputErrors);
  EXPECT_THROW(wedge_plane_wave(0, 1, 1, 1), InputErrors);
  EXPECT_THROW(wedge_plane_wave(1.5, -1, 1, 1), InputErrors);
  EXPECT_THROW(wedge_plane_wave(1.5, std::nan(""), 1, 1), InputErrors);
  EXPECT_THROW(wedge_line_source(1.5, 2, 2, 1, 1), InputErrors);
  EXPECT_THROW(wedge_line_source(1.5, 0, 0, 1, 2), InputErrors);
  EXPECT_THROW(wedge_point_source(1.5, 1, {1, 1, 1}, {1, 1, 1}), InputErrors);
  EXPECT_THROW(wedge_point_source(1.5, 0, {1, 1, 1}, {1, 1, 2}), InputErrors);
  try {
    wedge_plane_wave(1.5, -1, 5, 6);
    FAIL();
  } catch (const InputErrors& errors) {
    EXPECT_EQ(errors.diagnostics().size(), 3u);  // all faults at once
  }
}

}  // namespace
}  // namespace grimaldi
