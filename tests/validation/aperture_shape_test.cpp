#include "validation/aperture_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

TEST(ApertureShape, Areas) {
  const auto expect_area = [](const char* shape, const char* params, double truth) {
    // Closed forms; the sum over corners rounds like a few ulp.
    EXPECT_NEAR(area(aperture_shape(shape, params)), truth, 1e-14 * truth) << shape;
  };
  const auto regular = [](int n, double R) { return 0.5 * n * R * R * std::sin(2 * pi / n); };
  const auto star = [](int n, double R, double r) { return n * R * r * std::sin(pi / n); };
  expect_area("rect", "wx=2;wy=0.5", 1);
  expect_area("square", "w=3", 9);
  expect_area("circle", "radius=1.5", pi * 2.25);
  expect_area("circle_on_axis", "radius=2", pi * 4);
  expect_area("circle_off_axis", "radius=2", pi * 4);
  expect_area("annulus", "outer=1.5;inner=1.4", pi * (2.25 - 1.96));
  expect_area("regular_polygon", "N=7;circumradius=2;first_vertex_angle_rad=0.2", regular(7, 2));
  expect_area("triangle", "circumradius=2.5;first vertex on +x", regular(3, 2.5));
  expect_area("hexagon", "circumradius=3;first vertex on +x", regular(6, 3));
  expect_area("octagon", " circumradius = 3 ", regular(8, 3));
  expect_area("star_polygon", "N=5;R=1;r=0.381966011250105;first_outer_vertex_angle_rad=0.1",
              star(5, 1, 0.381966011250105));
  expect_area("star5", "circumradius=4;inner=1.52786404500042;first vertex on +x", star(5, 4, 1.52786404500042));
  expect_area("star8", "R=4;r=1.5", star(8, 4, 1.5));
  expect_area("double_slit", "width=0.2;height=1;centre_spacing=1", 0.4);
  expect_area("polygon", "vertices=0 0 2 0 2 1 0 1", 2);
  expect_area("polygon", "vertices=0 0 0 1 2 1 2 0", 2);  // either sense of rotation
}

TEST(ApertureShape, Orientation) {
  const Aperture hexagon = aperture_shape("hexagon", "circumradius=3;first vertex on +x");
  EXPECT_DOUBLE_EQ(hexagon.loops.at(0).at(0).x, 3);
  EXPECT_NEAR(hexagon.loops.at(0).at(1).y, 3 * std::sin(pi / 3), 1e-15);
  const Aperture turned = aperture_shape("regular_polygon", "N=6;circumradius=3;first_vertex_angle_rad=0.2");
  EXPECT_NEAR(turned.loops.at(0).at(0).y, 3 * std::sin(0.2), 1e-15);
}

TEST(ApertureShape, Contains) {
  const Aperture ring = aperture_shape("annulus", "outer=2;inner=1");
  EXPECT_TRUE(contains(ring, {0, 1.5}));
  EXPECT_FALSE(contains(ring, {0.5, 0}));
  EXPECT_FALSE(contains(ring, {3, 0}));
  const Aperture slits = aperture_shape("double_slit", "width=0.2;height=1;centre_spacing=1");
  EXPECT_TRUE(contains(slits, {0.5, 0.4}));
  EXPECT_TRUE(contains(slits, {-0.45, 0}));
  EXPECT_FALSE(contains(slits, {0, 0}));
}

TEST(ApertureShape, Refuses) {
  const auto expect_fault = [](const char* shape, const char* params, const std::string& word) {
    try {
      aperture_shape(shape, params);
      ADD_FAILURE() << shape << " " << params;
    } catch (const InputErrors& errors) {
      EXPECT_NE(std::string(errors.what()).find(word), std::string::npos) << errors.what();
    }
  };
  expect_fault("cicle", "radius=1", "did you mean circle?");
  expect_fault("", "", "unknown shape");
  expect_fault("circle", "", "radius is missing");
  expect_fault("circle", "radius=0", "no length");
  expect_fault("circle", "radius=nan", "not a finite number");
  expect_fault("circle", "radius=1m", "not a finite number");
  expect_fault("circle", "radius=1;radius=2", "given twice");
  expect_fault("circle", "radius", "no key=value");
  expect_fault("rect", "wx=1;wy=1;wz=1", "unknown key \"wz\"");
  expect_fault("annulus", "outer=1;inner=1", "not below");
  expect_fault("regular_polygon", "N=2;circumradius=1", "whole number");
  expect_fault("regular_polygon", "N=5.5;circumradius=1", "whole number");
  expect_fault("star1", "R=2;r=1", "whole number");
  expect_fault("starry", "R=2;r=1", "unknown shape");
  expect_fault("star5", "R=1;r=2", "not below");
  expect_fault("double_slit", "width=2;height=1;centre_spacing=1", "overlap");
  expect_fault("polygon", "vertices=0 0 1 0 1", "no polygon");
  expect_fault("polygon", "vertices=0 0 1 0 2 0", "no area");
  try {
    aperture_shape("rect", "wx=-1;wz=1");
    ADD_FAILURE();
  } catch (const InputErrors& errors) {
    EXPECT_EQ(errors.diagnostics().size(), 3u);  // wx, the missing wy, the unknown wz
  }
}

}  // namespace
}  // namespace grimaldi
