#include "validation/rayleigh_sommerfeld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/aperture_shape.h"
#include "validation/fraunhofer.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};
constexpr double k = 2 * pi;  // lengths in wavelengths
constexpr RayleighSommerfeld kinds[] = {RayleighSommerfeld::first, RayleighSommerfeld::second};

const std::vector<std::pair<const char*, const char*>> shapes = {
    {"rect", "wx=4;wy=2"},
    {"triangle", "circumradius=2.5;first vertex on +x"},
    {"star5", "circumradius=4;inner=1.52786404500042;first vertex on +x"},
    {"double_slit", "width=0.5;height=3;centre_spacing=2"},
    {"polygon", "vertices=0 0 2 0 2 1 1 1 1 3 0 3"},
    {"circle", "radius=2"},
    {"annulus", "outer=2;inner=1.5"},
};

Complex one(double, double) { return 1; }

TEST(RayleighSommerfeld, AgainstTheIntegralOverTheOpening) {
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    for (const RayleighSommerfeld kind : kinds)
      for (const Vec3& point : {Vec3{0.1, 0.2, 0.6}, Vec3{2, 1, 3}, Vec3{-6, 2, 2}, Vec3{0.4, -0.25, 60}})
        // The bound of the second reference; the rim itself is good to 1e-13.
        EXPECT_LE(std::abs(rayleigh_sommerfeld(aperture, k, point, kind) -
                           rayleigh_sommerfeld_direct(aperture, k, point, one, kind)),
                  1e-12)
            << shape << " z = " << point.z;
  }
}

TEST(RayleighSommerfeld, AxisOfADisc) {
  for (const double radius : {0.5, 2.0, 10.0})
    for (const double z : {0.01, 0.3, 4.0, 50.0, 400.0})
      for (const RayleighSommerfeld kind : kinds) {
        Aperture disc;
        disc.discs = {{radius, 1}};
        const Complex axis = rayleigh_sommerfeld_on_axis(radius, k, z, kind);
        // 1e-16 of the phase k·R ≤ 2600.
        EXPECT_LE(std::abs(rayleigh_sommerfeld(disc, k, {0, 0, z}, kind) - axis), 1e-15 * (1 + k * (z + radius)));
        // Off the axis by δ the field moves by (kδ)² at most.
        EXPECT_LE(std::abs(rayleigh_sommerfeld(disc, k, {1e-7, 0, z}, kind) - axis), 1e-12 * (1 + 1 / (z * z)));
      }
}

TEST(RayleighSommerfeld, FarFieldIsFraunhofer) {
  // u → (jkz/2πR²) e^{−jkR} I(kx/R, ky/R). Left: kD²/2R of phase over the opening, D ≤ 4, relative to the field on the
  // axis.
  const double R = 1e9;
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    for (const Vec3& s : {Vec3{0, 0, 1}, normalized(Vec3{0.1, -0.2, 1}), normalized(Vec3{-0.5, 0.3, 0.5})}) {
      const Complex far = j * k * s.z / (2 * pi * R) * fraunhofer_integral(aperture, k * s.x, k * s.y);
      // The phase of 6e9 rad is good to 1e-6 and common to both ways: it is taken out.
      Complex near = rayleigh_sommerfeld(aperture, k, R * s);
      const double scale = k * s.z / (2 * pi * R) * area(aperture);
      EXPECT_LE(std::fabs(std::abs(near) - std::abs(far)), 2e-6 * scale) << shape;
      // Second kind: without the obliquity.
      near = rayleigh_sommerfeld(aperture, k, R * s, RayleighSommerfeld::second);
      EXPECT_LE(std::fabs(std::abs(near) - std::abs(far) / s.z), 2e-6 * scale / s.z) << shape;
    }
  }
  // With the phase, at a distance that keeps it: kD²/2R = 1e-4.
  const Aperture small = aperture_shape("rect", "wx=1;wy=0.6");
  const Vec3 point = 3e4 * normalized(Vec3{0.1, -0.2, 1});
  const double distance = norm(point);
  const Complex far = j * k * point.z / (2 * pi * distance * distance) * std::polar(1.0, -k * distance) *
                      fraunhofer_integral(small, k * point.x / distance, k * point.y / distance);
  EXPECT_LE(std::abs(rayleigh_sommerfeld(small, k, point) - far), 2e-4 * std::abs(far));
}

TEST(RayleighSommerfeld, CloseToTheScreen) {
  // Behind a wide opening at z → 0: 1 inside, 1/2 at the rim, 1/4 at a corner, 0 outside. What is left is O(√z) of the
  // rim wave within a wavelength, and 1/√(k·distance) of the others: the rims are 40 wavelengths away.
  const Aperture wide = aperture_shape("square", "w=80");
  const double z = 1e-6;
  const auto field = [&](double x, double y) { return rayleigh_sommerfeld(wide, k, {x, y, z}); };
  EXPECT_NEAR(std::abs(field(0, 0)), 1, 1e-4);
  EXPECT_NEAR(std::abs(field(40, 0)), 0.5, 1e-4);
  EXPECT_NEAR(std::abs(field(40, -40)), 0.25, 1e-4);
  EXPECT_NEAR(std::abs(field(41, 0)), 0, 1e-4);
}

TEST(RayleighSommerfeld, ContinuousOverTheRim) {
  // A point above the rim or over a corner is no case of its own.
  for (const auto& [shape, params] : shapes) {
    const Aperture aperture = aperture_shape(shape, params);
    std::vector<Aperture::Point> rim = {{2, 0}};
    if (!aperture.loops.empty())
      rim = {aperture.loops[0][0],
             {(aperture.loops[0][0].x + aperture.loops[0][1].x) / 2,
              (aperture.loops[0][0].y + aperture.loops[0][1].y) / 2}};
    for (const auto& [x, y] : rim)
      for (const double z : {0.05, 1.0}) {
        const Complex there = rayleigh_sommerfeld(aperture, k, {x, y, z});
        for (const double step : {1e-9, 1e-13})
          for (const auto& [dx, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
            // The slope is at most 1/(πz) + k.
            EXPECT_LE(std::abs(rayleigh_sommerfeld(aperture, k, {x + dx * step, y + dy * step, z}) - there),
                      step * (1 / z + 2 * k) + 1e-13)
                << shape;
      }
  }
}

TEST(RayleighSommerfeld, Babinet) {
  // An opening cut in parts: the parts' fields add up. A ring, its hole and what lies outside make the free wave.
  const Vec3 point{0.7, -0.4, 2.5};
  const auto value = [&](const char* shape, const char* params) {
    return rayleigh_sommerfeld(aperture_shape(shape, params), k, point);
  };
  EXPECT_LE(
      std::abs(value("annulus", "outer=2;inner=0.7") + value("circle", "radius=0.7") - value("circle", "radius=2")),
      1e-14);
  EXPECT_LE(std::abs(value("polygon", "vertices=-1 -1 1 -1 1 1") + value("polygon", "vertices=-1 -1 1 1 -1 1") -
                     value("square", "w=2")),
            1e-14);
  // A square hole, drawn clockwise, in a square.
  Aperture frame = aperture_shape("square", "w=4");
  frame.loops.push_back({{-1, -1}, {-1, 1}, {1, 1}, {1, -1}});
  EXPECT_LE(std::abs(rayleigh_sommerfeld(frame, k, point) + value("square", "w=2") - value("square", "w=4")), 1e-14);
}

TEST(RayleighSommerfeld, PolygonOfManyCornersIsADisc) {
  // The defect of a regular polygon is of order N⁻²; two of them extrapolate to N⁻⁴.
  const Aperture disc = aperture_shape("circle", "radius=2");
  const Aperture coarse = aperture_shape("regular_polygon", "N=1000;circumradius=2");
  const Aperture fine = aperture_shape("regular_polygon", "N=2000;circumradius=2");
  for (const Vec3& point : {Vec3{0, 0, 3}, Vec3{1.9, 0, 1}, Vec3{0.7, 0, 30}, Vec3{5, 0, 6}}) {
    const Complex limit = (4.0 * rayleigh_sommerfeld(fine, k, point) - rayleigh_sommerfeld(coarse, k, point)) / 3.0;
    EXPECT_LE(std::abs(limit - rayleigh_sommerfeld(disc, k, point)), 1e-9) << point.x;
  }
}

TEST(RayleighSommerfeld, PointSourceOnTheAxis) {
  // The mean of the two kinds is Kirchhoff's field; for a point source at the distance h before a disc it is closed on
  // the axis: e^{−jk(h+z)}/(h+z) − ½ a²(h+z)/(SR(SR − hz + a²)) e^{−jk(S+R)} (Maggi and Rubinowicz).
  const double a = 2;
  const Aperture disc = aperture_shape("circle", "radius=2");
  for (const auto& [h, z] : {std::pair{3.0, 5.0}, {10.0, 2.0}, {40.0, 60.0}}) {
    const double height = h;
    const auto reach = [&](double x, double y) { return std::sqrt(x * x + y * y + height * height); };
    const auto field = [&](double x, double y) { return std::polar(1 / reach(x, y), -k * reach(x, y)); };
    // −∂u/∂z over jk.
    const auto slope = [&](double x, double y) {
      const double S = reach(x, y);
      return field(x, y) * (height / S) * (1.0 + 1.0 / (j * k * S));
    };
    const Vec3 point{0, 0, z};
    const Complex kirchhoff = 0.5 * (rayleigh_sommerfeld_direct(disc, k, point, field, RayleighSommerfeld::first) +
                                     rayleigh_sommerfeld_direct(disc, k, point, slope, RayleighSommerfeld::second));
    const double S = std::hypot(h, a), R = std::hypot(z, a);
    const Complex truth = std::polar(1 / (h + z), -k * (h + z)) -
                          0.5 * a * a * (h + z) / (S * R * (S * R - h * z + a * a)) * std::polar(1.0, -k * (S + R));
    EXPECT_LE(std::abs(kirchhoff - truth), 1e-12) << h;
  }
}

TEST(RayleighSommerfeld, Refuses) {
  const Aperture disc = aperture_shape("circle", "radius=2");
  EXPECT_THROW(rayleigh_sommerfeld(disc, k, {0, 0, 0}), InputErrors);
  EXPECT_THROW(rayleigh_sommerfeld(disc, k, {0, 0, -1}), InputErrors);
  EXPECT_THROW(rayleigh_sommerfeld(disc, 0, {0, 0, 1}), InputErrors);
  EXPECT_THROW(rayleigh_sommerfeld(disc, k, {0, std::nan(""), 1}), InputErrors);
  EXPECT_THROW(rayleigh_sommerfeld_on_axis(2, k, -1), InputErrors);
}

}  // namespace
}  // namespace grimaldi
