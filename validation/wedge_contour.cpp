#include "validation/wedge_contour.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/constants.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};
const Complex down = std::polar(1.0, -pi / 4);

constexpr double gaussian_reach = 6.3;  // e^{−6.3²} = 6e-18

/// kR at t = jδ.
double distance_at(const WedgePath& path, double delta) {
  const double sine = std::sin(delta / 2);
  return std::sqrt(std::max(0.0, path.apex * path.apex - 4 * path.product * sine * sine));
}

/// Im s at the pole t = jδ, |δ| < π: on the ray e^{3jπ/4} (δ > 0) or against it.
double pole_height(const WedgePath& path, double delta) {
  const double sine = std::sin(delta / 2);
  if (path.plane) return std::sqrt(path.apex) * sine;
  return sine * std::sqrt(2 * path.product / (path.apex + distance_at(path, delta)));
}

struct Descent {
  Complex t, slope;  // t(s), dt/ds
};

// Each root keeps its argument between ±π along the line, so their product is the analytic cosh, where the root of the
// product 1 + sinh² would change its sign.
Descent descent(const WedgePath& path, Complex s) {
  const Complex s2 = j * s * s;
  Complex sinh, cosh, slope;  // of t/2; d sinh/ds
  if (path.plane) {
    slope = down / std::sqrt(2 * path.apex);
    sinh = slope * s;
    cosh = std::sqrt(1.0 - s2 / (2 * path.apex));
  } else {
    const double nearest = distance_at(path, pi);
    const Complex root = std::sqrt(2 * path.apex - s2), scale = down / (2 * std::sqrt(path.product));
    sinh = scale * s * root;
    slope = scale * 2.0 * (path.apex - s2) / root;
    cosh = std::sqrt(path.apex + nearest - s2) * std::sqrt(4 * path.product / (path.apex + nearest) - s2) /
           (2 * std::sqrt(path.product));
  }
  const Complex half = std::abs(sinh) < 0.5 ? std::asinh(sinh)
                       : s.real() > 0       ? std::log(cosh + sinh)
                                            : -std::log(cosh - sinh);
  return {2.0 * half, 2.0 * slope / cosh};
}

/// One of the two cotangents: −(1/4πn) ∫ wave cot((π+ψ+jt)/2n) dt along Im s = height.
class Half {
 public:
  Half(double n, double psi, const WedgePath& path) : n_(n), psi_(psi), path_(path) {
    // The branch point t = ±jπ bounds the strip in which the line may move.
    strip_ = pole_height(path, pi);
    scale_ = std::min(1.0, strip_);
    std::vector<double> poles;
    for (double delta = lowest(); delta < pi; delta += 2 * pi * n_)
      if (delta > -pi) poles.push_back(pole_height(path_, delta));
    double best = -1;
    constexpr int steps = 18;
    for (int i = -steps; i <= steps; ++i) {
      const double height = std::min(0.9, strip_ / 2) * i / steps;
      double nearest = strip_ - std::fabs(height);
      for (const double pole : poles) nearest = std::min(nearest, std::fabs(pole - height));
      // The real axis is the better line where the distances are alike: no e^{height²}.
      if (i == 0) nearest *= 1.0001;
      if (nearest > best) best = nearest, height_ = height;
    }
  }

  /// Whether the image at θ (= ψ + 2πnN) belongs to the sum, as far as this cotangent knows.
  bool lit(double theta) const {
    const double delta = pi + theta;
    if (delta >= pi) return true;
    if (delta <= -pi) return false;
    return pole_height(path_, delta) > height_;
  }

  Complex integral() const {
    const auto integrand = [&](double x) {
      const Complex s{scale_ * std::sinh(x), height_};
      const Descent at = descent(path_, s);
      return std::exp(-s * s) * path_.amplitude(s * s) * at.slope * scale_ * std::cosh(x) / std::tan(argument(at.t));
    };
    const Integral line = integrate_line(integrand, std::asinh(gaussian_reach / scale_), 0, 0.2);
    if (!std::isfinite(line.error)) throw std::runtime_error("the diffraction integral of a wedge does not settle");
    return -std::polar(1 / (4 * pi * n_), -path_.apex) * line.value;
  }

 private:
  // The smallest δ = π + ψ + 2πnN that is above −π.
  double lowest() const { return pi + psi_ - 2 * pi * n_ * std::floor((2 * pi + psi_) / (2 * pi * n_)); }
  // (π + ψ + jt)/2n less the multiple of π that keeps the sine's digits.
  Complex argument(Complex t) const {
    const double whole = pi + psi_, turns = std::round(whole / (2 * pi * n_));
    return (whole - turns * 2 * pi * n_ + j * t) / (2 * n_);
  }

  double n_, psi_;
  const WedgePath& path_;
  double strip_, scale_, height_ = 0;
};

}  // namespace

Complex wedge_contour(double n, double psi, const WedgePath& path) {
  const Half forth(n, psi, path), back(n, -psi, path);
  Complex sum = 0;
  const int most = static_cast<int>(std::ceil((2 * pi + std::fabs(psi)) / (2 * pi * n)));
  for (int i = -most; i <= most; ++i) {
    const double theta = psi + 2 * pi * n * i;
    if (forth.lit(theta) && back.lit(-theta)) sum += path.image(theta);
  }
  return sum + forth.integral() + back.integral();
}

}  // namespace grimaldi
