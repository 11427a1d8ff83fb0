#include "validation/fraunhofer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "validation/aperture_shape.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

const std::vector<std::pair<const char*, const char*>> shapes = {
    {"rect", "wx=2;wy=0.5"},
    {"triangle", "circumradius=1.3"},
    {"star_polygon", "N=7;R=1;r=0.3;first_outer_vertex_angle_rad=0.1"},
    {"double_slit", "width=0.2;height=1;centre_spacing=1"},
    {"polygon", "vertices=0 0 2 0 2 1 1 1 1 3 0 3"},
    {"annulus", "outer=1;inner=0.5"},
};

// The edge sum of the textbooks, for k that is neither small nor perpendicular to an edge.
Complex edge_sum(const Aperture& aperture, double kx, double ky) {
  Complex sum = 0;
  for (const Aperture::Loop& loop : aperture.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Aperture::Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      const double ex = b.x - a.x, ey = b.y - a.y, half = (kx * ex + ky * ey) / 2;
      sum += (kx * ey - ky * ex) * std::sin(half) / half * std::polar(1.0, (kx * (a.x + b.x) + ky * (a.y + b.y)) / 2);
    }
  return sum / (j * (kx * kx + ky * ky));
}

TEST(Fraunhofer, EdgeSum) {
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    if (aperture.loops.empty()) continue;
    for (const auto& [kx, ky] : {std::pair{0.9, 0.7}, {3.1, -2.3}, {-17.0, 5.5}, {61.0, 83.0}})
      // The edge sum itself loses 1e-16/q.
      EXPECT_LE(std::abs(fraunhofer_integral(aperture, kx, ky) - edge_sum(aperture, kx, ky)), 1e-14 * area(aperture))
          << shape;
  }
}

TEST(Fraunhofer, AmplitudeOfOne) {
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    for (const auto& [kx, ky] : {std::pair{0.0, 0.0}, {1e-5, 2e-5}, {3.1, -2.3}, {-17.0, 5.5}})
      // The bound of the header for the quadrature.
      EXPECT_LE(std::abs(fraunhofer_integral(aperture, kx, ky) -
                         fraunhofer_integral(
                             aperture, [](double, double) { return Complex(1); }, kx, ky)),
                1e-12 * area(aperture))
          << shape;
  }
}

TEST(Fraunhofer, AmplitudesByDerivatives) {
  // ∫ x e^{jk·r} = −j ∂I/∂kx, by a difference of fourth order: error h⁴/30 of the fifth derivative, rounding 1e-16/h.
  const double kx = 2.2, ky = -1.7, h = 1e-3;
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    const auto at = [&](double step) { return fraunhofer_integral(aperture, kx + step, ky); };
    const Complex slope = (8.0 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    const Complex value = fraunhofer_integral(
        aperture, [](double x, double) { return Complex(x); }, kx, ky);
    EXPECT_LE(std::abs(value + j * slope), 5e-12 * area(aperture)) << shape;
  }
}

TEST(Fraunhofer, ShiftOfASteering) {
  // An amplitude e^{j(ax + by)} moves the pattern.
  const Aperture aperture = aperture_shape("hexagon", "circumradius=1");
  const auto steered = [](double x, double y) { return std::polar(1.0, 4 * x - 2 * y); };
  EXPECT_LE(std::abs(fraunhofer_integral(aperture, steered, 1, 7) - fraunhofer_integral(aperture, 5, 5)),
            1e-12 * area(aperture));
}

TEST(Fraunhofer, SmallWavenumbers) {
  // I = A + j k·∫r − ½∫(k·r)² …: no digit is lost on the way to k = 0, nor along an edge, nor at the change of form.
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    const double A = area(aperture);
    EXPECT_LE(std::abs(fraunhofer_integral(aperture, 0, 0) - A), 2e-15 * A) << shape;
    const Complex first = fraunhofer_integral(
        aperture, [](double x, double y) { return Complex(0.6 * x + 0.8 * y); }, 0, 0);
    for (double q = 1e-12; q < 1e-3; q *= 10)
      EXPECT_LE(std::abs(fraunhofer_integral(aperture, 0.6 * q, 0.8 * q) - (A + j * q * first)),
                (1e-14 + 5 * q * q) * A)
          << shape << " " << q;
    for (const double k : {0.3, 5.0, 40.0}) {
      const double step = 1e-12;
      EXPECT_LE(std::abs(fraunhofer_integral(aperture, k, step) - fraunhofer_integral(aperture, k, 0)), 1e-11 * A);
      EXPECT_LE(std::abs(fraunhofer_integral(aperture, step, k) - fraunhofer_integral(aperture, 0, k)), 1e-11 * A);
    }
  }
}

TEST(Fraunhofer, PolygonOfManyCornersIsADisc) {
  // A regular polygon lacks 2π²/3N² of the disc; two of them extrapolate to the disc up to N⁻⁴.
  const Aperture disc = aperture_shape("circle", "radius=1");
  const Aperture coarse = aperture_shape("regular_polygon", "N=1000;circumradius=1");
  const Aperture fine = aperture_shape("regular_polygon", "N=2000;circumradius=1");
  for (const auto& [kx, ky] : {std::pair{0.0, 0.0}, {2.0, -1.3}, {5.0, 3.0}, {12.7, -9.1}}) {
    const Complex limit = (4.0 * fraunhofer_integral(fine, kx, ky) - fraunhofer_integral(coarse, kx, ky)) / 3.0;
    EXPECT_LE(std::abs(limit - fraunhofer_integral(disc, kx, ky)), 2e-10) << kx;  // (q·size)⁴/N⁴ ~ 1e-11·…
  }
}

TEST(Fraunhofer, Babinet) {
  // Parts of an opening add up: a ring and its hole, a rectangle and its two triangles.
  const double kx = 3.3, ky = -4.1;
  const auto value = [&](const char* shape, const char* params) {
    return fraunhofer_integral(aperture_shape(shape, params), kx, ky);
  };
  EXPECT_LE(
      std::abs(value("annulus", "outer=2;inner=0.7") + value("circle", "radius=0.7") - value("circle", "radius=2")),
      5e-14);
  EXPECT_LE(std::abs(value("polygon", "vertices=-1 -1 1 -1 1 1") + value("polygon", "vertices=-1 -1 1 1 -1 1") -
                     value("square", "w=2")),
            1e-14);
}

TEST(Fraunhofer, AiryPower) {
  // The encircled energy is the integral of the pattern: ∫_0^x 2 J1(t)²/t dt.
  for (const double x : {1e-5, 0.5, 3.8317, 20.0}) {
    const Integral power = integrate([](double t) { return airy_intensity(t) * t / 2; }, 0, x, 1e-14, 8);
    EXPECT_NEAR(power.value.real(), airy_encircled_energy(x), 2e-14) << x;
  }
  EXPECT_EQ(airy_intensity(0), 1);
  EXPECT_EQ(slit_intensity(0), 1);
  EXPECT_EQ(airy_intensity(-2), airy_intensity(2));
}

}  // namespace
}  // namespace grimaldi
