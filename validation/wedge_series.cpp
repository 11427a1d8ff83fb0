#include "validation/wedge_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/bessel.h"
#include "validation/quadrature.h"
#include "validation/wedge_contour.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

constexpr double slack = 1e-9;          // rad; what degrees lose on their way to radians is a millionth of it
constexpr double negligible = 1e-18;    // a term of a series
constexpr double series_to = 20;        // kρ up to which the series is quicker than the contour
constexpr double steepest_ratio = 0.7;  // of the two radii, up to which the series of a line source falls off quickly

// ---- what may be asked

class Faults {
 public:
  void wedge(double n) {
    if (!(n >= 0.05 && n <= 2))
      list_.error({}, 0, "n", fmt::format("n = {:.12g} is no wedge here", n),
                  "the exterior angle nπ goes from 9 to 360°: n from 0.05 to 2");
  }
  void angle(const char* name, double n, double phi) {
    if (!(phi >= -slack && phi <= n * pi + slack))
      list_.error({}, 0, name, fmt::format("{:.12g}° is outside the free space of the wedge", phi * 180 / pi),
                  fmt::format("angles go from 0 at one face to {:.12g}° at the other", n * 180));
  }
  void distance(const char* name, double value) {
    if (!(value >= 0 && std::isfinite(value)))
      list_.error({}, 0, name, fmt::format("{} is no distance", value), "it must be finite and at least 0");
  }
  void other(const char* name, std::string problem, std::string why) {
    list_.error({}, 0, name, std::move(problem), std::move(why));
  }
  void finish() const { list_.throw_if_errors(); }

 private:
  Diagnostics list_;
};

double within_faces(double n, double phi) { return std::clamp(phi, 0.0, n * pi); }

// ---- the two ways

/// U(φ−φ') ∓ U(φ+φ').
template <class Wave>
WedgeField combined(double n, double phi, double phip, const Wave& wave) {
  const Complex incident = wave(phi - phip), reflected = wave(phi + phip);
  const bool on_face = phi == 0 || phi == n * pi || phip == 0 || phip == n * pi;
  return {on_face ? 0.0 : incident - reflected, incident + reflected};
}

/// (1/n) Σ ε_m c_m [cos(m(φ−φ')/n) ∓ cos(m(φ+φ')/n)], until |c_m| is negligible beyond the order `turning`, where the
/// coefficients begin to fall off.
template <class Coefficient>
WedgeField series(double n, double phi, double phip, double turning, const Coefficient& coefficient) {
  Complex soft = 0, hard = 0;
  for (int m = 0;; ++m) {
    const double order = m / n;
    const Complex c = (m == 0 ? 1.0 : 2.0) / n * coefficient(order);
    if (order > turning && !(std::abs(c) > negligible)) break;
    // cos a ∓ cos b as products: soft vanishes on the faces to the last digit.
    soft += c * 2.0 * std::sin(order * phi) * std::sin(order * phip);
    hard += c * 2.0 * std::cos(order * phi) * std::cos(order * phip);
  }
  const bool on_face = phi == n * pi || phip == n * pi;
  return {on_face ? 0.0 : soft, hard};
}

/// e^{jz} H_0^(2)(z), −π < arg z < π/2.
/// Formula: 2j/√(2πw) (1/√π) ∫ e^{−τ²} (1 + τ²/2w)^{−1/2} dτ, w = jz, the path of steepest descent of ∫ e^{−jz cosh v}
/// dv.
Complex scaled_hankel(Complex z) {
  const Complex w = j * z;
  const double scale = std::min(1.0, std::sqrt(std::abs(w)));
  const Integral line = integrate_line(
      [&](double x) {
        const double tau = scale * std::sinh(x);
        return std::exp(-tau * tau) * scale * std::cosh(x) / std::sqrt(1.0 + tau * tau / (2.0 * w));
      },
      std::asinh(6.3 / scale), 0, 0.2);
  return j * std::sqrt(2.0) / (pi * std::sqrt(w)) * line.value;
}

}  // namespace

WedgeField wedge_plane_wave(double n, double k_rho, double phi, double phip, WedgeMethod method) {
  Faults faults;
  faults.wedge(n);
  faults.distance("k_rho", k_rho);
  faults.angle("phi", n, phi);
  faults.angle("phip", n, phip);
  faults.finish();
  phi = within_faces(n, phi);
  phip = within_faces(n, phip);
  if (k_rho == 0) return {0, 2 / n};
  if (method == WedgeMethod::automatic) method = k_rho <= series_to ? WedgeMethod::series : WedgeMethod::contour;
  if (method == WedgeMethod::series)
    return series(n, phi, phip, k_rho, [&](double order) {
      return std::polar(1.0, pi / 2 * std::fmod(order, 4.0)) * bessel_j(order, k_rho);
    });
  const WedgePath path{true, k_rho, 0, [](Complex) { return Complex(1); },
                       [=](double theta) { return std::polar(1.0, k_rho * std::cos(theta)); }};
  return combined(n, phi, phip, [&](double psi) { return wedge_contour(n, psi, path); });
}

WedgeField wedge_line_source(double n, double k_rho, double k_rho_s, double phi, double phip, WedgeMethod method) {
  Faults faults;
  faults.wedge(n);
  faults.distance("k_rho", k_rho);
  faults.distance("k_rho_s", k_rho_s);
  faults.angle("phi", n, phi);
  faults.angle("phip", n, phip);
  if (k_rho == k_rho_s && (k_rho == 0 || std::fabs(phi - phip) <= slack))
    faults.other("k_rho", "the receiver lies on the line source", "the field is infinite there");
  faults.finish();
  phi = within_faces(n, phi);
  phip = within_faces(n, phip);
  const double nearer = std::min(k_rho, k_rho_s), farther = std::max(k_rho, k_rho_s), apex = nearer + farther;
  const Complex line = -j / 4.0;
  if (nearer == 0) return {0, line * 2.0 / n * hankel2(0, farther)};
  if (method == WedgeMethod::automatic)
    method = nearer <= steepest_ratio * farther && farther >= 1 && nearer <= 3 * series_to ? WedgeMethod::series
                                                                                           : WedgeMethod::contour;
  if (method == WedgeMethod::series)
    return series(n, phi, phip, nearer,
                  [&](double order) { return line * bessel_j(order, nearer) * hankel2(order, farther); });
  const WedgePath path{false, apex, nearer * farther, [=](Complex s2) { return line * scaled_hankel(apex - j * s2); },
                       [=](double theta) {
                         const double gap = farther - nearer, sine = std::sin(theta / 2);
                         return line * hankel2(0, std::sqrt(gap * gap + 4 * nearer * farther * sine * sine));
                       }};
  return combined(n, phi, phip, [&](double psi) { return wedge_contour(n, psi, path); });
}

WedgeField wedge_point_source(double n, double k, const EdgePoint& source, const EdgePoint& receiver) {
  Faults faults;
  faults.wedge(n);
  if (!(k > 0 && std::isfinite(k)))
    faults.other("k", fmt::format("wavenumber {} is not allowed", k), "it must be finite and above 0");
  faults.distance("rho_s", source.rho);
  faults.distance("rho", receiver.rho);
  faults.angle("phi_s", n, source.phi);
  faults.angle("phi", n, receiver.phi);
  if (!std::isfinite(source.z)) faults.other("z_s", "the coordinate is not finite", {});
  if (!std::isfinite(receiver.z)) faults.other("z", "the coordinate is not finite", {});
  const bool on_edge = source.rho == 0 || receiver.rho == 0;
  if (source.rho == receiver.rho && source.z == receiver.z &&
      (source.rho == 0 || std::fabs(source.phi - receiver.phi) <= slack))
    faults.other("rho", "the receiver lies at the source", "the field is infinite there");
  faults.finish();
  const double phi = within_faces(n, receiver.phi), phip = within_faces(n, source.phi);
  const double across = source.rho + receiver.rho, along = receiver.z - source.z, gap = source.rho - receiver.rho;
  const double apex = k * std::hypot(across, along), product = k * k * source.rho * receiver.rho;
  if (on_edge) return {0, 2 / n * k * std::polar(1 / apex, -apex)};
  const WedgePath path{false, apex, product, [=](Complex s2) { return k / (apex - j * s2); },
                       [=](double theta) {
                         const double sine = std::sin(theta / 2);
                         const double R =
                             std::sqrt(gap * gap + along * along + 4 * source.rho * receiver.rho * sine * sine);
                         return std::polar(1 / R, -k * R);
                       }};
  return combined(n, phi, phip, [&](double psi) { return wedge_contour(n, psi, path); });
}

}  // namespace grimaldi
