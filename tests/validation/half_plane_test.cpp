#include "validation/half_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

double difference(const WedgeField& a, const WedgeField& b) {
  return std::max(std::abs(a.soft - b.soft), std::abs(a.hard - b.hard));
}

TEST(HalfPlane, IsTheWedgeOfNoThickness) {
  // The two share nothing but complex numbers: a Fresnel integral here, a contour and a series there.
  for (const double k_rho : {1e-3, 0.01, 0.3, 1.0, 6.28, 25.0, 100.0, 1e3, 1e4, 1e5})
    for (const double phip : {0.0, 0.17, 1.0, pi / 2, 2.4, pi, 4.0})
      for (const double phi :
           {0.0, 0.3, pi - phip, pi - phip + 1e-6, 2.0, pi, pi + phip, pi + phip - 1e-3, 5.5, 2 * pi}) {
        if (phi < 0 || phi > 2 * pi) continue;
        // Both turn k_rho by angles that are good to 4e-16: 1e-15·k_rho.
        EXPECT_LE(difference(half_plane_plane_wave(k_rho, phi, phip), wedge_plane_wave(2, k_rho, phi, phip)),
                  2e-14 + 1e-15 * k_rho)
            << k_rho << " " << phi << " " << phip;
      }
}

TEST(HalfPlane, Babinet) {
  // Behind a screen: the field of the hard screen and that of the soft complementary screen add up to the incident
  // wave. The complement lies at φ = π; about it the source stands at φ' + π, the receiver at φ − π.
  for (const double k_rho : {0.1, 3.0, 47.0})
    for (const double phip : {0.2, 1.3, 2.9})
      for (const double phi : {3.2, 4.0, 4.9, 6.2}) {
        const Complex incident = std::polar(1.0, k_rho * std::cos(phi - phip));
        const Complex sum =
            half_plane_plane_wave(k_rho, phi, phip).hard + half_plane_plane_wave(k_rho, phi - pi, phip + pi).soft;
        EXPECT_LE(std::abs(sum - incident), 5e-15 + 1e-15 * k_rho);
      }
}

TEST(HalfPlane, Faces) {
  for (const double k_rho : {0.5, 30.0})
    for (const double face : {0.0, 2 * pi}) {
      EXPECT_EQ(half_plane_plane_wave(k_rho, face, 1.1).soft, 0.0);
      // ∂u/∂φ of the hard field vanishes on the face: what is left is second order, |∂²u/∂φ²| h²/2 ≤ (2 kρ)² h².
      const double h = 1e-5, inside = face == 0 ? h : face - h;
      EXPECT_LE(std::abs(half_plane_plane_wave(k_rho, inside, 1.1).hard - half_plane_plane_wave(k_rho, face, 1.1).hard),
                (1 + 4 * k_rho * k_rho) * h * h);
    }
}

TEST(HalfPlane, Edge) {
  const WedgeField edge = half_plane_plane_wave(0, 1, 2);
  EXPECT_LE(std::abs(edge.soft), 1e-15);
  EXPECT_LE(std::abs(edge.hard - 1.0), 2e-15);
}

// Whole degrees are exact angles: the phases of symmetric directions are then the same bits, in radians they are not.
TEST(HalfPlane, DegreesKeepTheirDigits) {
  for (const double k_rho : {905.0, 4744.0})
    for (const double phi : {17.0, 133.0, 347.0})
      for (const double phip : {4.0, 84.0, 236.0}) {
        const WedgeField degrees = half_plane_plane_wave(k_rho, phi, phip, 180);
        const WedgeField radians = half_plane_plane_wave(k_rho, phi * pi / 180, phip * pi / 180);
        EXPECT_LT(std::abs(degrees.hard - radians.hard), 1e-15 + 1.7e-15 * k_rho);
        const WedgeField mirrored = half_plane_plane_wave(k_rho, 360 - phi, 360 - phip, 180);
        EXPECT_EQ(degrees.hard, mirrored.hard);
      }
}

TEST(HalfPlane, RefusesAnglesOutsideTheCircle) {
  EXPECT_THROW(half_plane_plane_wave(1, -0.1, 1), InputErrors);
  EXPECT_THROW(half_plane_plane_wave(1, 1, 6.3), InputErrors);
  EXPECT_THROW(half_plane_plane_wave(-1, 1, 1), InputErrors);
  EXPECT_THROW(half_plane_plane_wave(1, std::nan(""), 1), InputErrors);
  EXPECT_NO_THROW(half_plane_plane_wave(1, 2 * pi * (1 + 1e-15), 1));
}

}  // namespace
}  // namespace grimaldi
