#include "validation/rayleigh_sommerfeld.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

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

/// The integrand of the rim, over r² (so that dθ becomes the cross product of r and ds).
class Rim {
 public:
  Rim(double k, const Vec3& point, RayleighSommerfeld kind, bool far)
      : k_(k), z_(point.z), kind_(kind), far_(far), centre_(norm(point)) {}

  bool far() const { return far_; }
  double k() const { return k_; }
  double z() const { return z_; }
  /// The phase common to all points of the rim, taken out.
  double common_phase() const { return k_ * (far_ ? centre_ : z_); }

  /// At the distance R of a rim point, r of its foot, with R² − (distance of the origin)².
  /// Near: z(e^{−jkR}/R − e^{−jkz}/z)/r² or (e^{−jkR} − e^{−jkz})/r², in which R − z = r²/(R + z) is no difference.
  /// Far beside the opening: the terms of z, which then cancel over the rim, are left out.
  Complex operator()(double r2, double R, double excess) const {
    const bool first = kind_ == RayleighSommerfeld::first;
    if (far_) return (first ? z_ / R : 1) / r2 * delayed(k_ * excess / (R + centre_));
    const double delay = r2 / (R + z_), half = k_ * delay / 2;
    const Complex step = -j * (k_ * sinc(half)) * delayed(half);  // (e^{−jk delay} − 1)/delay
    return first ? (z_ * step - 1.0) / (R * (R + z_)) : step / (R + z_);
  }

 private:
  double k_, z_;
  RayleighSommerfeld kind_;
  bool far_;
  double centre_;
};

/// One edge of a loop, seen from the foot of the point.
class Edge {
 public:
  Edge(const Aperture::Point& from, const Aperture::Point& to, const Vec3& foot)
      : from_(from), length_(std::hypot(to.x - from.x, to.y - from.y)) {
    const double px = from.x - foot.x, py = from.y - foot.y;
    ex_ = (to.x - from.x) / length_;
    ey_ = (to.y - from.y) / length_;
    d_ = px * ey_ - py * ex_;
    s_ = px * ex_ + py * ey_;
    twice_ = {px - foot.x, py - foot.y};
  }

  Complex integral(const Rim& rim) const {
    if (!(length_ > 0) || d_ == 0) return 0;
    return d_ * (rim.far() ? along(rim) : graded(rim));
  }

 private:
  // Panels on which the phase moves by less than 10 rad: 16 nodes leave less than 1e-16 of it.
  static constexpr double most_phase = 10;
  static constexpr int nodes = 16;

  /// Far beside the opening nothing but the phase varies.
  Complex along(const Rim& rim) const {
    const int panels = 1 + static_cast<int>(rim.k() * length_ / most_phase);
    const double half = length_ / (2 * panels);
    Complex sum = 0;
    for (int i = 0; i < panels; ++i)
      for (const QuadratureNode& node : gauss_legendre(nodes)) {
        const double t = half * (2 * i + 1 + node.x), s = s_ + t, r2 = d_ * d_ + s * s;
        const double x = from_.x + t * ex_, y = from_.y + t * ey_;
        const double excess = x * (twice_.x + t * ex_) + y * (twice_.y + t * ey_);
        sum += node.weight * rim(r2, std::sqrt(r2 + rim.z() * rim.z()), excess);
      }
    return half * sum;
  }

  /// s = ρ sinh u from the foot of the point on the line of the edge: nothing is sharp in u.
  Complex graded(const Rim& rim) const {
    const double rho = std::hypot(d_, rim.z());
    const double from = std::asinh(s_ / rho), to = std::asinh((s_ + length_) / rho);
    if (from < 0 && to > 0) return panel(rim, rho, from, 0) + panel(rim, rho, 0, to);
    return panel(rim, rho, from, to);
  }
  Complex panel(const Rim& rim, double rho, double from, double to) const {
    const double centre = (from + to) / 2, half = (to - from) / 2;
    if (to - from > 1 || rim.k() * rho * std::fabs(std::cosh(to) - std::cosh(from)) > most_phase)
      return panel(rim, rho, from, centre) + panel(rim, rho, centre, to);
    Complex sum = 0;
    for (const QuadratureNode& node : gauss_legendre(nodes)) {
      const double s = rho * std::sinh(centre + half * node.x), R = std::hypot(rho, s);
      sum += node.weight * R * rim(d_ * d_ + s * s, R, 0);
    }
    return half * sum;
  }

  Aperture::Point from_;
  double length_, ex_, ey_;
  double d_, s_;  // distance of the foot from the line of the edge; of the first corner from there, along the edge
  Aperture::Point twice_;  // first corner less twice the foot
};

/// The rim of a disc seen from the distance b of its axis: an even periodic function of the angle, so the trapezoidal
/// rule converges geometrically.
Complex over_circle(const Rim& rim, double a, double b) {
  const auto f = [&](double angle) {
    const double lift = 2 * a * b * std::pow(std::sin(angle / 2), 2);
    const double r2 = (a - b) * (a - b) + 2 * lift, R = std::sqrt(r2 + rim.z() * rim.z());
    return (a * (a - b) + lift) * rim(r2, R, a * (a - 2 * b) + 2 * lift);
  };
  const double swing = rim.k() * (std::hypot(a + b, rim.z()) - std::hypot(a - b, rim.z()));
  int count = 16 + static_cast<int>(std::min(swing, 1e6));
  Complex sum = (f(0) + f(pi)) / 2.0;
  double modulus = std::abs(sum);
  const auto add = [&](double angle) {
    const Complex value = f(angle);
    sum += value;
    modulus += std::abs(value);
  };
  for (int i = 1; i < count; ++i) add(pi * i / count);
  Complex value = sum * (2 * pi / count);
  for (;;) {
    for (int i = 0; i < count; ++i) add(pi * (i + 0.5) / count);
    count *= 2;
    const Complex better = sum * (2 * pi / count);
    const double change = std::abs(better - value);
    value = better;
    // What is left is the square of the change: each doubling squares the error.
    if (change <= 1e-12 * modulus * (2 * pi / count)) return value;
    if (count > 4000000) throw std::runtime_error("the field behind a disc does not settle; the point is too close");
  }
}

}  // namespace

Complex rayleigh_sommerfeld(const Aperture& aperture, double k, const Vec3& point, RayleighSommerfeld kind) {
  check(k, point);
  const double aside = std::hypot(point.x, point.y);
  const Rim rim(k, point, kind, aside > 2 * extent(aperture));
  Complex sum = 0;
  for (const Aperture::Loop& loop : aperture.loops)
    for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++)
      sum += Edge(loop[last], loop[i], point).integral(rim);
  for (const auto& [radius, sign] : aperture.discs) sum += static_cast<double>(sign) * over_circle(rim, radius, aside);
  return -delayed(rim.common_phase()) * sum / (2 * pi);
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
  const auto integrand = [&](double x, double y) {
    const double R = std::sqrt((x - point.x) * (x - point.x) + (y - point.y) * (y - point.y) + point.z * point.z);
    const Complex kernel = kind == RayleighSommerfeld::first ? point.z / R * (j * k + 1 / R) : j * k;
    return kernel * incident(x, y) * delayed(k * R) / (2 * pi * R);
  };
  const int panels = 1 + static_cast<int>(k * extent(aperture) / 8);
  return integrate_over(aperture, integrand, {0, 0}, panels, 5e-14).value;
}

}  // namespace grimaldi
