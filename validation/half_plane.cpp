#include "validation/half_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/fresnel_integral.h"

namespace grimaldi {
namespace {

constexpr double slack = 1e-9;  // of a radian; what degrees lose on their way to radians is a millionth of it

/// cos of an angle in a unit of which `half_turn` make π, brought within 45° of an axis first: whole degrees lose
/// nothing, others 2e-16.
double cosine(double angle, double half_turn) {
  const double quarter = half_turn / 2, quarters = std::nearbyint(angle / quarter);
  const double rest = std::fma(-quarters, quarter, angle) * (pi / half_turn);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return std::cos(rest);
    case 1:
      return -std::sin(rest);
    case 2:
      return -std::cos(rest);
    default:
      return std::sin(rest);
  }
}

std::complex<double> branch(double k_rho, double psi, double half_turn) {
  return std::polar(1.0, k_rho * cosine(psi, half_turn)) *
         fresnel_tail(-std::sqrt(2 * k_rho) * cosine(psi / 2, half_turn));
}

}  // namespace

WedgeField half_plane_plane_wave(double k_rho, double phi, double phip, double half_turn) {
  Diagnostics faults;
  if (!(k_rho >= 0 && std::isfinite(k_rho)))
    faults.error({}, 0, "k_rho", fmt::format("{} is no distance", k_rho), "it must be finite and at least 0");
  const auto check = [&](const char* name, double angle) {
    const double turns = angle / half_turn;
    if (!(turns >= -slack && turns <= 2 + slack))
      faults.error({}, 0, name, fmt::format("{:.12g}° is outside the space about the half-plane", 180 * turns),
                   "angles go from 0 to 360° about the edge");
  };
  check("phi", phi);
  check("phip", phip);
  faults.throw_if_errors();
  phi = std::clamp(phi, 0.0, 2 * half_turn);
  phip = std::clamp(phip, 0.0, 2 * half_turn);
  const std::complex<double> incident = branch(k_rho, phi - phip, half_turn),
                             reflected = branch(k_rho, phi + phip, half_turn);
  const bool on_face = phi == 0 || phi == 2 * half_turn;
  return {on_face ? 0.0 : incident - reflected, incident + reflected};
}

}  // namespace grimaldi
