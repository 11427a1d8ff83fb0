// What antennas radiate: energy, gains, nulls, and which way the field points.

#include "propagation/antenna.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

Vec3 direction_of(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

double gain(const Antenna& antenna, const Vec3& direction) { return norm2(radiated_field(antenna, direction)); }

/// ∫ gain dΩ by the midpoint rule in cos θ and azimuth, 800 × 800.
double radiated_power(const Antenna& antenna) {
  constexpr int n = 800;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += gain(antenna, direction_of(std::acos(-1 + (2 * i + 1.0) / n), 2 * pi * (j + 0.5) / n));
  return sum * 4 * pi / (n * n);
}

// An antenna spreads its power and adds none: the gain's mean over the sphere is 1. Midpoint rule on a bounded pattern
// with a kink in its slope at the nulls: 1e-5; the half-wave directivity is printed with ten digits.
TEST(Antenna, GainIntegratesToFullSphere) {
  for (const AntennaPattern pattern : {AntennaPattern::isotropic, AntennaPattern::dipole, AntennaPattern::short_dipole})
    for (const Polarisation polarisation : {Polarisation::vertical, Polarisation::horizontal})
      for (const double tilt : {0.0, 25.0}) {
        const double power = radiated_power({pattern, polarisation, 35, tilt});
        EXPECT_NEAR(power / (4 * pi), 1, 1e-5) << int(pattern) << " " << int(polarisation) << " " << tilt;
      }
}

// Balanis, Antenna Theory: half-wave dipole 2.15 dBi (1.643), short dipole 1.76 dBi (1.5).
TEST(Antenna, LargestGain) {
  EXPECT_NEAR(10 * std::log10(gain({AntennaPattern::dipole, Polarisation::vertical, 0, 0}, {1, 0, 0})), 2.15, 0.005);
  EXPECT_NEAR(10 * std::log10(gain({AntennaPattern::short_dipole, Polarisation::vertical, 0, 0}, {1, 0, 0})), 1.76,
              0.005);
  EXPECT_NEAR(gain({AntennaPattern::short_dipole, Polarisation::vertical, 0, 0}, direction_of(pi / 6, 1)), 1.5 / 4,
              1e-15);
  // The half-wave pattern at 60° from the rod: [cos(π/4)/sin 60°]² = 2/3 of the largest.
  EXPECT_NEAR(gain({AntennaPattern::dipole, Polarisation::vertical, 0, 0}, direction_of(pi / 3, 1)),
              1.6409223769 * 2 / 3, 1e-9);
}

TEST(Antenna, NothingAlongTheRod) {
  for (const AntennaPattern pattern : {AntennaPattern::dipole, AntennaPattern::short_dipole}) {
    EXPECT_LT(gain({pattern, Polarisation::vertical, 0, 0}, {0, 0, 1}), 1e-18);
    EXPECT_LT(gain({pattern, Polarisation::vertical, 0, 0}, {0, 0, -1}), 1e-18);
    // Horizontal, looking north: the rod lies east-west.
    EXPECT_LT(gain({pattern, Polarisation::horizontal, 0, 0}, {1, 0, 0}), 1e-18);
    EXPECT_LT(gain({pattern, Polarisation::horizontal, 90, 0}, {0, 1, 0}), 1e-18);
  }
}

// Tilted down by 20° to the east: the largest gain stays in the plane across the rod, 20° below the horizon in front.
TEST(Antenna, TiltPointsTheFrontDown) {
  const Antenna antenna{AntennaPattern::dipole, Polarisation::vertical, 90, 20};
  const double t = 20 * pi / 180;
  EXPECT_NEAR(gain(antenna, {std::cos(t), 0, -std::sin(t)}), 1.6409223769, 1e-12);
  EXPECT_LT(gain(antenna, {std::cos(t), 0, std::sin(t)}), 1.5);
  EXPECT_LT(gain(antenna, {std::sin(t), 0, std::cos(t)}), 1e-18);  // the rod
}

// Fields are transverse; the isotropic V field lies along growing θ, H along growing azimuth; the frame is
// right-handed.
TEST(Antenna, FieldsAreTransverse) {
  for (const double polar : {0.0, 0.3, 1.2, 2.0, 3.0, pi})
    for (const double azimuth : {0.0, 0.7, 2.0, 4.0, 6.0}) {
      const Vec3 direction = direction_of(polar, azimuth);
      const PolarFrame frame = polar_frame(direction);
      EXPECT_LT(norm(cross(frame.theta, frame.phi) - direction), 1e-15);
      EXPECT_NEAR(norm(frame.theta), 1, 1e-15);
      for (const AntennaPattern pattern :
           {AntennaPattern::isotropic, AntennaPattern::dipole, AntennaPattern::short_dipole})
        for (const Polarisation polarisation : {Polarisation::vertical, Polarisation::horizontal})
          EXPECT_LT(std::abs(dot(radiated_field({pattern, polarisation, 20, 10}, direction), direction)), 2e-15);
      EXPECT_EQ(radiated_field({AntennaPattern::isotropic, Polarisation::vertical, 20, 10}, direction), frame.theta);
      EXPECT_EQ(radiated_field({AntennaPattern::isotropic, Polarisation::horizontal, 20, 10}, direction), frame.phi);
    }
  // A vertical dipole is vertically polarised everywhere: the same sign as the isotropic antenna.
  const Vec3 out = direction_of(1, 2);
  EXPECT_GT(dot(radiated_field({AntennaPattern::dipole, Polarisation::vertical, 0, 0}, out), polar_frame(out).theta),
            1);
}

}  // namespace
}  // namespace grimaldi
