#include "propagation/launcher.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/random.h"

namespace grimaldi {
namespace {

constexpr std::uint32_t launch_stream = 1;

/// The even bits of `x`, packed.
std::uint32_t even_bits(std::uint64_t x) {
  x &= 0x5555555555555555u;
  x = (x | (x >> 1)) & 0x3333333333333333u;
  x = (x | (x >> 2)) & 0x0f0f0f0f0f0f0f0fu;
  x = (x | (x >> 4)) & 0x00ff00ff00ff00ffu;
  x = (x | (x >> 8)) & 0x0000ffff0000ffffu;
  x = (x | (x >> 16)) & 0x00000000ffffffffu;
  return static_cast<std::uint32_t>(x);
}

double wrapped(double x) { return x - std::floor(x); }

}  // namespace

Vec3 equal_area_direction(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  const double signed_distance = 1 - (std::abs(a) + std::abs(b));
  const double r = 1 - std::abs(signed_distance);
  const double azimuth = (r == 0 ? 1 : (std::abs(b) - std::abs(a)) / r + 1) * pi / 4;
  const double z = std::copysign(1 - r * r, signed_distance);
  const double radial = r * std::sqrt(std::max(0.0, 2 - r * r));
  return {std::copysign(std::cos(azimuth), a) * radial, std::copysign(std::sin(azimuth), b) * radial, z};
}

Launcher::Launcher(std::uint64_t seed, std::uint32_t pass, std::uint64_t count) : count_(count) {
  const auto draw = uniform4(seed, launch_stream, pass, 0);
  shift_ = draw[0];
  shift_u_ = draw[1];
  shift_v_ = draw[2];
}

Vec3 Launcher::direction(std::uint64_t index) const {
  const double along = (static_cast<double>(index) + shift_) / static_cast<double>(count_);
  const auto code = static_cast<std::uint64_t>(std::min(along, 1 - 0x1p-53) * 0x1p53) << 11;
  const double u = wrapped(even_bits(code >> 1) * 0x1p-32 + shift_u_);
  const double v = wrapped(even_bits(code) * 0x1p-32 + shift_v_);
  const Vec3 direction = equal_area_direction(u, v);
  return direction / norm(direction);
}

}  // namespace grimaldi
