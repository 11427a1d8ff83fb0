#include "validation/fresnel_integral.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

// Where e^{−u² − √2 x u} has fallen to 1e-18, and panels on which 24 nodes leave nothing of it: over half a panel the
// exponent changes by 7.5 at most.
constexpr double smallest = 41.5;
constexpr int panels = 4, nodes = 24;

}  // namespace

std::complex<double> fresnel_tail(double x) {
  if (x < 0) return 1.0 - fresnel_tail(-x);
  if (std::isinf(x)) return 0;
  const double slope = x / std::sqrt(2.0);
  const double end = smallest / (slope + std::sqrt(slope * slope + smallest));
  const std::complex<double> rate = std::polar(2 * x, pi / 4);
  const double half = end / (2 * panels);
  std::complex<double> sum = 0;
  for (int panel = 0; panel < panels; ++panel)
    for (const QuadratureNode& node : gauss_legendre(nodes)) {
      const double u = half * (2 * panel + 1 + node.x);
      sum += node.weight * std::exp(-u * (u + rate));
    }
  return std::polar(half / std::sqrt(pi), -x * x) * sum;
}

}  // namespace grimaldi
