#include "validation/half_plane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/fresnel_integral.h"

namespace grimaldi {
namespace {

constexpr double slack = 1e-9;  // rad; what degrees lose on their way to radians is a millionth of it

std::complex<double> branch(double k_rho, double psi) {
  return std::polar(1.0, k_rho * std::cos(psi)) * fresnel_tail(-std::sqrt(2 * k_rho) * std::cos(psi / 2));
}

}  // namespace

WedgeField half_plane_plane_wave(double k_rho, double phi, double phip) {
  Diagnostics faults;
  if (!(k_rho >= 0 && std::isfinite(k_rho)))
    faults.error({}, 0, "k_rho", fmt::format("{} is no distance", k_rho), "it must be finite and at least 0");
  const auto check = [&](const char* name, double angle) {
    if (!(angle >= -slack && angle <= 2 * pi + slack))
      faults.error({}, 0, name, fmt::format("{:.12g}° is outside the space about the half-plane", angle * 180 / pi),
                   "angles go from 0 to 360° about the edge");
  };
  check("phi", phi);
  check("phip", phip);
  faults.throw_if_errors();
  phi = std::clamp(phi, 0.0, 2 * pi);
  phip = std::clamp(phip, 0.0, 2 * pi);
  const std::complex<double> incident = branch(k_rho, phi - phip), reflected = branch(k_rho, phi + phip);
  const bool on_face = phi == 0 || phi == 2 * pi;
  return {on_face ? 0.0 : incident - reflected, incident + reflected};
}

}  // namespace grimaldi
