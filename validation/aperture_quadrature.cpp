#include "validation/aperture_quadrature.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/constants.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Function = std::function<Complex(double, double)>;

constexpr int nodes = 16, most_halvings = 6;

// Value and ∫|f|.
struct Sum {
  Complex value = 0;
  double modulus = 0;
  void add(double weight, const Sum& part) {
    value += weight * part.value;
    modulus += std::fabs(weight) * part.modulus;
  }
};

// ∫∫ over the unit square in panels × panels products.
template <class Integrand>
Sum over_square(int panels, const Integrand& f) {
  const auto& rule = gauss_legendre(nodes);
  const double half = 0.5 / panels;
  Sum sum;
  for (int i = 0; i < panels; ++i)
    for (const QuadratureNode& across : rule)
      for (int j = 0; j < panels; ++j)
        for (const QuadratureNode& along : rule) {
          const Complex value = f(half * (2 * i + 1 + across.x), half * (2 * j + 1 + along.x));
          sum.add(half * half * across.weight * along.weight, {value, std::abs(value)});
        }
  return sum;
}

Sum over_triangle(int panels, const Function& f, const Aperture::Point& c, const Aperture::Point& a,
                  const Aperture::Point& b) {
  return over_square(panels, [&](double u, double v) {
    return u * f(c.x + u * ((a.x - c.x) + v * (b.x - a.x)), c.y + u * ((a.y - c.y) + v * (b.y - a.y)));
  });
}

Sum over_disc(int panels, const Function& f, double radius) {
  return over_square(panels, [&](double u, double v) {
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
    Sum sum;
    for (const Aperture::Loop& loop : aperture.loops)
      for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++) {
        const Aperture::Point &a = loop[last], &b = loop[i];
        const double twice = (a.x - apex.x) * (b.y - apex.y) - (b.x - apex.x) * (a.y - apex.y);
        if (twice != 0) sum.add(twice, over_triangle(count, counted, apex, a, b));
      }
    for (const Aperture::Disc& disc : aperture.discs)
      sum.add(disc.sign * 2 * pi * disc.radius * disc.radius, over_disc(count, counted, disc.radius));
    return sum;
  };
  Complex value = at(panels).value;
  for (int halving = 0; halving < most_halvings; ++halving) {
    panels *= 2;
    const Sum better = at(panels);
    const double error = std::abs(better.value - value);
    value = better.value;
    if (error <= tolerance * better.modulus) return {value, error, evaluations};
  }
  throw std::runtime_error("the integral over an aperture does not settle; its integrand varies too fast");
}

}  // namespace grimaldi
