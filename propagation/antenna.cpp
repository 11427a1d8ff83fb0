#include "propagation/antenna.h"

#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

/// The direction in which a dipole's rod points.
Vec3 dipole_axis(const Antenna& antenna) {
  const double azimuth = antenna.azimuth * pi / 180, tilt = antenna.tilt * pi / 180;
  const Vec3 front{std::sin(azimuth), std::cos(azimuth), 0};
  if (antenna.polarisation == Polarisation::horizontal) return {std::cos(azimuth), -std::sin(azimuth), 0};
  return std::cos(tilt) * Vec3{0, 0, 1} + std::sin(tilt) * front;
}

}  // namespace

PolarFrame polar_frame(const Vec3& direction) {
  const double radial = std::hypot(direction.x, direction.y);
  const double c = radial > 0 ? direction.x / radial : 1, s = radial > 0 ? direction.y / radial : 0;
  return {{direction.z * c, direction.z * s, -radial}, {-s, c, 0}};
}

Vec3 radiated_field(const Antenna& antenna, const Vec3& direction) {
  if (antenna.pattern == AntennaPattern::isotropic) {
    const PolarFrame frame = polar_frame(direction);
    return antenna.polarisation == Polarisation::horizontal ? frame.phi : frame.theta;
  }
  const Vec3 axis = dipole_axis(antenna);
  const double cosine = dot(axis, direction);
  const Vec3 across = cosine * direction - axis;  // sin ϑ times the unit vector of growing ϑ
  if (antenna.pattern == AntennaPattern::short_dipole) return std::sqrt(1.5) * across;
  const double sine2 = norm2(across);
  constexpr double half_wave_directivity = 1.6409223769;
  if (sine2 < 1e-20) return {};  // along the rod: the pattern's null
  return std::sqrt(half_wave_directivity) * std::cos(0.5 * pi * cosine) / sine2 * across;
}

}  // namespace grimaldi
