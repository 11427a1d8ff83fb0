#include "validation/rayleigh_sommerfeld.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/aperture_quadrature.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

// e^{−jx}.
Complex delayed(double x) { return {std::cos(x), -std::sin(x)}; }

void check(double k, const Vec3& point) {
  Diagnostics faults;
  if (!(k > 0 && std::isfinite(k)))
    faults.error({}, 0, "k", fmt::format("wavenumber {} is not allowed", k), "it must be finite and above 0");
  if (!is_finite(point)) faults.error({}, 0, "x, y, z", "a coordinate is not finite");
  if (!(point.z > 0))
    faults.error({}, 0, "z", fmt::format("z = {} is not behind the screen", point.z),
                 "the wave comes from z < 0, the screen is z = 0");
  faults.throw_if_errors();
}

/// The integrand of the rim at the distance R of a rim point, over r² and without e^{−jkz}: z(e^{−jkR}/R −
/// e^{−jkz}/z)/r² or (e^{−jkR} − e^{−jkz})/r². R − z = r²/(R + z) is never formed by a difference.
struct Rim {
  double k, z;
  RayleighSommerfeld kind;

  Complex operator()(double r2, double R) const {
    const double delay = r2 / (R + z), half = k * delay / 2;
    const Complex step = -j * (k * sinc(half)) * delayed(half);  // (e^{−jk delay} − 1)/delay
    return kind == RayleighSommerfeld::first ? (z * step - 1.0) / (R * (R + z)) : step / (R + z);
  }
};

/// ∫ du over one edge, s = ρ sinh u from the foot of the point on its line. Panels on which u moves by less than 1
/// and the phase by less than 10 rad: 16 nodes leave less than 1e-16 of it.
Complex over_panels(const Rim& rim, double d, double rho, double u1, double u2) {
  const double R1 = rho * std::cosh(u1), R2 = rho * std::cosh(u2);
  if (u2 - u1 > 1 || rim.k * std::fabs(R2 - R1) > 10) {
    const double middle = (u1 + u2) / 2;
    return over_panels(rim, d, rho, u1, middle) + over_panels(rim, d, rho, middle, u2);
  }
  const double half = (u2 - u1) / 2, centre = (u1 + u2) / 2;
  Complex sum = 0;
  for (const QuadratureNode& node : gauss_legendre(16)) {
    const double u = centre + half * node.x, s = rho * std::sinh(u), R = std::hypot(rho, s);
    sum += node.weight * R * rim(d * d + s * s, R);
  }
  return half * sum;
}

Complex over_edge(const Rim& rim, const Aperture::Point& a, const Aperture::Point& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return 0;
  const double d = (a.x * b.y - a.y * b.x) / length;
  if (d == 0) return 0;
  const double s1 = (a.x * (b.x - a.x) + a.y * (b.y - a.y)) / length, s2 = s1 + length, rho = std::hypot(d, rim.z);
  const double u1 = std::asinh(s1 / rho), u2 = std::asinh(s2 / rho);
  if (u1 < 0 && u2 > 0) return d * (over_panels(rim, d, rho, u1, 0) + over_panels(rim, d, rho, 0, u2));
  return d * over_panels(rim, d, rho, u1, u2);
}

/// The rim of a disc seen from the distance b of its axis: an even periodic function of the angle, so the trapezoidal
/// rule converges geometrically.
Complex over_circle(const Rim& rim, double a, double b) {
  const auto f = [&](double angle) {
    const double lift = 2 * a * b * std::pow(std::sin(angle / 2), 2);
    const double r2 = (a - b) * (a - b) + 2 * lift, R = std::sqrt(r2 + rim.z * rim.z);
    return (a * (a - b) + lift) * rim(r2, R);
  };
  const double swing = rim.k * (std::hypot(a + b, rim.z) - std::hypot(a - b, rim.z));
  int count = 16 + static_cast<int>(std::min(swing, 1e6));
  Complex sum = (f(0) + f(pi)) / 2.0;
  double modulus = std::abs(sum);
  const auto add = [&](double angle) {
    const Complex value = f(angle);
    sum += value;
    modulus += std::abs(value);
  };
  for (int i = 1; i < count; ++i) add(pi * i / count);
  for (Complex value = sum * (2 * pi / count);;) {
    for (int i = 0; i < count; ++i) add(pi * (i + 0.5) / count);
    count *= 2;
    const Complex better = sum * (2 * pi / count);
    if (std::abs(better - value) <= 1e-15 * modulus * (2 * pi / count) * 4 || count > 4000000) return better;
    value = better;
  }
}

}  // namespace

Complex rayleigh_sommerfeld(const Aperture& aperture, double k, const Vec3& point, RayleighSommerfeld kind) {
  check(k, point);
  const Rim rim{k, point.z, kind};
  Complex sum = 0;
  for (const Aperture::Loop& loop : aperture.loops)
    for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++)
      sum +=
          over_edge(rim, {loop[last].x - point.x, loop[last].y - point.y}, {loop[i].x - point.x, loop[i].y - point.y});
  for (const auto& [radius, sign] : aperture.discs)
    sum += static_cast<double>(sign) * over_circle(rim, radius, std::hypot(point.x, point.y));
  return -delayed(k * point.z) * sum / (2 * pi);
}

Complex rayleigh_sommerfeld_on_axis(double radius, double k, double z, RayleighSommerfeld kind) {
  check(k, {0, 0, z});
  const double R = std::hypot(z, radius);
  const double weight = kind == RayleighSommerfeld::first ? z / R : 1;
  return delayed(k * z) - weight * delayed(k * R);
}

Complex rayleigh_sommerfeld_direct(const Aperture& aperture, double k, const Vec3& point,
                                   const std::function<Complex(double, double)>& incident, RayleighSommerfeld kind) {
  check(k, point);
  double largest = 0;
  const auto integrand = [&](double x, double y) {
    const Complex u = incident(x, y);
    largest = std::max(largest, std::abs(u));
    const double R = std::sqrt((x - point.x) * (x - point.x) + (y - point.y) * (y - point.y) + point.z * point.z);
    const Complex kernel = kind == RayleighSommerfeld::first ? point.z / R * (j * k + 1 / R) : j * k;
    return kernel * u * delayed(k * R) / (2 * pi * R);
  };
  const int panels = 1 + static_cast<int>(k * extent(aperture) / 8);
  integrand(0, 0);
  return integrate_over(aperture, integrand, {0, 0}, panels, 2e-13 * std::max(largest, 1e-300)).value;
}

}  // namespace grimaldi
