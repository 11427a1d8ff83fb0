#include "validation/impedance_wedge.h"

#include <cmath>
#include <stdexcept>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// The integral itself, |Re z| ≤ π/2: the integrand falls off as e^{−nπs}, and its pole nearest the real axis is j/n.
Complex maliuzhinets_integral(double n, Complex z) {
  const auto integrand = [&](double s) -> Complex {
    if (s == 0) return z * z / (2 * n * pi);
    const Complex half = std::sinh(0.5 * z * s);
    return 2.0 * half * half / (s * std::cosh(0.5 * pi * s) * std::sinh(n * pi * s));
  };
  const double reach = 40 / (n * pi);  // e^{−40} = 4e-18
  // The integrand is even: half of the line's.
  const Integral line = integrate_line(integrand, reach, 0, 0.25 / n);
  if (!std::isfinite(line.error)) throw std::runtime_error("the integral of Maliuzhinets' function does not settle");
  return std::exp(-0.25 * line.value);
}

/// 2 cos((a + b)/2) sin((a − b)/2): sin a − sin b with the digits of a − b.
Complex sine_difference(Complex a, Complex b) { return 2.0 * std::cos(0.5 * (a + b)) * std::sin(0.5 * (a - b)); }

}  // namespace

Complex maliuzhinets(double n, Complex z) {
  GRIMALDI_EXPECT(n >= 0.5 && n <= 2);
  if (z.real() < 0) z = -z;
  if (z.real() <= 0.5 * pi) return maliuzhinets_integral(n, z);
  const Complex at_half = maliuzhinets_integral(n, 0.5 * pi);
  return at_half * at_half * std::cos((z - 0.5 * pi) / (2 * n)) / maliuzhinets(n, z - pi);
}

ImpedanceWedge::ImpedanceWedge(double n, Complex admittance)
    : n_(n), half_angle_(0.5 * n * pi), complement_(std::acos(admittance)) {
  GRIMALDI_EXPECT(n >= 0.5 && n <= 2 && admittance.real() > 0);
}

Complex ImpedanceWedge::faces(Complex alpha) const {
  const Complex up = alpha + half_angle_, down = alpha - half_angle_;
  return maliuzhinets(n_, up + complement_) * maliuzhinets(n_, up - complement_) *
         maliuzhinets(n_, down + complement_) * maliuzhinets(n_, down - complement_);
}

Complex ImpedanceWedge::spectrum(Complex alpha, double phi_in) const {
  const double in = phi_in - half_angle_;
  return faces(alpha) / faces(in) * std::cos(in / n_) / (n_ * sine_difference(alpha / n_, in / n_));
}

Complex ImpedanceWedge::coefficient(double phi_in, double phi) const {
  const double out = phi - half_angle_;
  return spectrum(out + pi, phi_in) - spectrum(out - pi, phi_in);
}

}  // namespace grimaldi
