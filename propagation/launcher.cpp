#include "propagation/launcher.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

struct Turn {
  double cosine, sine;
};

/// cos and sin of x π/4, |x| ≤ 1: Taylor to y^16, the rest below 5e-17.
Turn eighth_turn(double x) {
  const double y = x * (pi / 4), y2 = y * y;
  double sine = -1.0 / 1307674368000, cosine = 1.0 / 20922789888000;
  for (const double c : {1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0})
    sine = sine * y2 + c;
  for (const double c :
       {-1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -0.5, 1.0})
    cosine = cosine * y2 + c;
  return {cosine, sine * y};
}

}  // namespace

Vec3 equal_area_direction(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  const double signed_distance = 1 - (std::abs(a) + std::abs(b));
  const double r = 1 - std::abs(signed_distance);
  // Azimuth in its quadrant: π/4 more than `turn`.
  const Turn turn = eighth_turn(r == 0 ? 0 : (std::abs(b) - std::abs(a)) / r);
  const double z = std::copysign(1 - r * r, signed_distance);
  const double radial = r * std::sqrt(std::max(0.0, 2 - r * r)) * std::numbers::sqrt2 / 2;
  return {std::copysign(radial * (turn.cosine - turn.sine), a), std::copysign(radial * (turn.cosine + turn.sine), b),
          z};
}

Launcher::Launcher(std::uint64_t seed, std::uint32_t pass, std::uint64_t count) : count_(count) {
  const auto draw = uniform4(seed, launch_stream, pass, 0);
  shift_ = draw[0];
  shift_u_ = draw[1];
  shift_v_ = draw[2];
}

Vec3 Launcher::direction(std::uint64_t index) const {
  const double along = (static_cast<double>(static_cast<std::int64_t>(index)) + shift_) /
                       static_cast<double>(static_cast<std::int64_t>(count_));
  const auto code = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min(along, 1 - 0x1p-53) * 0x1p53)) << 11;
  const double u = wrapped(even_bits(code >> 1) * 0x1p-32 + shift_u_);
  const double v = wrapped(even_bits(code) * 0x1p-32 + shift_v_);
  return equal_area_direction(u, v);  // of length 1 to a few ulp
}

}  // namespace grimaldi
