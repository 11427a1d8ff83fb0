#include "validation/aperture_quadrature.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/constants.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Function = std::function<Complex(double, double)>;

constexpr int nodes = 16, most_halvings = 8;

// ∫∫ over the unit square in panels × panels products.
template <class Integrand>
Complex over_square(int panels, const Integrand& f) {
  const auto& rule = gauss_legendre(nodes);
  const double half = 0.5 / panels;
  Complex sum = 0;
  for (int i = 0; i < panels; ++i)
    for (const QuadratureNode& across : rule)
      for (int j = 0; j < panels; ++j)
        for (const QuadratureNode& along : rule)
          sum += across.weight * along.weight * f(half * (2 * i + 1 + across.x), half * (2 * j + 1 + along.x));
  return sum * half * half;
}

Complex over_triangle(int panels, const Function& f, const Aperture::Point& c, const Aperture::Point& a,
                      const Aperture::Point& b) {
  const double twice = (a.x - c.x) * (b.y - c.y) - (b.x - c.x) * (a.y - c.y);
  if (twice == 0) return 0;
  return twice * over_square(panels, [&](double u, double v) {
           return u * f(c.x + u * ((a.x - c.x) + v * (b.x - a.x)), c.y + u * ((a.y - c.y) + v * (b.y - a.y)));
         });
}

Complex over_disc(int panels, const Function& f, double radius) {
  return 2 * pi * radius * radius * over_square(panels, [&](double u, double v) {
           return u * f(radius * u * std::cos(2 * pi * v), radius * u * std::sin(2 * pi * v));
         });
}

}  // namespace

Integral integrate_over(const Aperture& aperture, const Function& f, const Aperture::Point& apex, int panels,
                        double tolerance) {
  int evaluations = 0;
  const Function counted = [&](double x, double y) {
    ++evaluations;
    return f(x, y);
  };
  const auto at = [&](int count) {
    Complex sum = 0;
    for (const Aperture::Loop& loop : aperture.loops)
      for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++)
        sum += over_triangle(count, counted, apex, loop[last], loop[i]);
    for (const Aperture::Disc& disc : aperture.discs)
      sum += static_cast<double>(disc.sign) * over_disc(count, counted, disc.radius);
    return sum;
  };
  Complex value = at(panels);
  for (int halving = 0; halving < most_halvings; ++halving) {
    panels *= 2;
    const Complex better = at(panels);
    const double error = std::abs(better - value);
    value = better;
    if (error <= tolerance) return {value, error, evaluations};
  }
  throw std::runtime_error("the integral over an aperture does not settle; its integrand varies too fast");
}

}  // namespace grimaldi
