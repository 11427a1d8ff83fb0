#include "propagation/laws/published_sampling.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

using Uniform = std::function<double()>;

/// f ≤ top and f ≤ tail/x³ for x > 0.
struct Envelope {
  double top, tail;
};

// Largest g1²K is 0.020133 at x = 3.185, largest x³ g1²K 1.77492 at 5.489; g2²K ≤ K(0) = 1.44721 and ≤ (4/x²) π/(2x).
constexpr Envelope varying{0.02014, 1.77493}, constant{1.447203, 2 * pi};
// Powers of the two parts, S2.34: 4π² I = ∫ g²K over both signs.
constexpr double integral1 = 0.004612658839610051, integral2 = 0.12458996032251083;

/// x > 0 with density ∝ f.
template <class Function>
double draw_below(const Envelope& envelope, const Function& f, const Uniform& uniform) {
  const double knee = std::cbrt(envelope.tail / envelope.top);
  while (true) {
    // The envelope holds top·knee up to its knee and half of that beyond.
    const double u = 1.5 * uniform();
    const double x = u < 1 ? knee * u : knee / std::sqrt(2 * (1.5 - u));
    const double bound = x < knee ? envelope.top : envelope.tail / (x * x * x);
    if (uniform() * bound < f(x)) return x;
  }
}

/// ζy with density ∝ ζy²/ζ⁴ (1 − e^{−ζ²/6}).
double draw_across(double x, const Uniform& uniform) {
  while (true) {
    double y = 0;
    if (x < 0.96) {  // below min(1/6, 1/ζy²): accepted at 0.89 … 0.62
      const double u = uniform(), knee = std::sqrt(6.0);
      y = u < 0.5 ? 2 * u * knee : knee / (2 * (1 - u));
      const double square = x * x + y * y;
      const double ratio = y * y / (square * square) * -std::expm1(-square / 6) / std::min(1.0 / 6, 1 / (y * y));
      if (uniform() < ratio) return uniform() < 0.5 ? -y : y;
    } else {  // ζy²/ζ⁴ first: ζy = ζx tan θ, θ ~ sin²θ as the angle of a point on the 3-sphere to an axis
      const double cosine = std::max(1e-150, std::sqrt(uniform()) * std::abs(std::cos(2 * pi * uniform())));
      y = x * std::sqrt((1 - cosine) * (1 + cosine)) / cosine;
      if (uniform() < -std::expm1(-(x * x + y * y) / 6)) return uniform() < 0.5 ? -y : y;
    }
  }
}

}  // namespace

double lobe_integral(double x) {
  GRIMALDI_EXPECT(x >= 0);
  const double s = x / std::sqrt(6.0);
  if (x < 1e-8) return 2 * std::sqrt(pi / 6);
  return pi / (2 * x) * std::erf(s) - pi * x / 6 * std::erfc(s) + std::sqrt(pi / 6) * std::exp(-s * s);
}

PublishedEdgeLaw::PublishedEdgeLaw(double wavenumber, const PublishedEdge& edge)
    : wavenumber_(wavenumber),
      power_(published_edge_power(edge)),
      edge_(edge),
      difference_(edge.start_amplitude - edge.end_amplitude),
      mean_(0.5 * (edge.start_amplitude + edge.end_amplitude)) {
  GRIMALDI_EXPECT(wavenumber > 0 && power_ > 0);
  const double one = std::norm(difference_) * integral1, other = std::norm(mean_) * integral2;
  varying_share_ = one / (one + other);
}

PlanePoint PublishedEdgeLaw::draw(const Uniform& uniform) const {
  const bool varies = uniform() < varying_share_;
  const auto intensity = [](double (*g)(double)) { return [g](double x) { return g(x) * g(x) * lobe_integral(x); }; };
  double x =
      varies ? draw_below(varying, intensity(edge_g1), uniform) : draw_below(constant, intensity(edge_g2), uniform);
  const double y = draw_across(x, uniform);
  const std::complex<double> odd = difference_ * edge_g1(x), even = std::complex<double>(0, 1) * mean_ * edge_g2(x);
  const double right = std::norm(even + odd), left = std::norm(even - odd);
  if (uniform() * (right + left) >= right) x = -x;
  // ζ = k(e·ξ, e m·ξ) turned back: e and e m are orthogonal, of length e.
  const double ex = edge_.end[0] - edge_.start[0], ey = edge_.end[1] - edge_.start[1];
  const double scale = 1 / (wavenumber_ * (ex * ex + ey * ey));
  return {scale * (ex * x + ey * y), scale * (ey * x - ex * y)};
}

double PublishedEdgeLaw::density(const PlanePoint& xi) const {
  return std::norm(published_edge_wave(wavenumber_, edge_, xi)) / power_;
}

}  // namespace grimaldi
