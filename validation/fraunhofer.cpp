#include "validation/fraunhofer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/constants.h"
#include "validation/aperture_quadrature.h"
#include "validation/bessel.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr Complex j{0, 1};

double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

// exp[ja, jb] = (e^{ja} − e^{jb})/(ja − jb).
Complex divided_difference(double a, double b) { return sinc((a - b) / 2) * std::polar(1.0, (a + b) / 2); }

// exp[ja, jb, jc]. Where the three lie together, its Taylor series Σ h_i/(i + 2)! with h_i the complete symmetric
// polynomials of the distances to their mean.
Complex divided_difference(double a, double b, double c) {
  std::array<double, 3> z = {a, b, c};
  std::sort(z.begin(), z.end());
  const double width = z[2] - z[0];
  if (width > 1) return (divided_difference(z[1], z[2]) - divided_difference(z[0], z[1])) / (j * width);
  const double mean = z[0] + (z[1] - z[0] + width) / 3;
  const Complex p = j * (z[0] - mean), q = j * (z[1] - mean), r = j * (z[2] - mean);
  const Complex pairs = p * q + q * r + r * p, triple = p * q * r;
  Complex before = 0, last = 0, current = 1, sum = 0.5;  // h_{−2}, h_{−1}, h_0; the mean makes h_1 = 0
  double factorial = 2;
  for (int i = 1; i <= 16; ++i) {  // (2/3)^16/18! = 2e-19
    const Complex next = -pairs * last + triple * before;
    before = last;
    last = current;
    current = next;
    factorial *= i + 2;
    sum += current / factorial;
  }
  return std::polar(1.0, mean) * sum;
}

Aperture::Point mean_corner(const Aperture::Loop& loop) {
  Aperture::Point mean{0, 0};
  for (const Aperture::Point& p : loop) mean.x += p.x, mean.y += p.y;
  const auto count = static_cast<double>(loop.size());
  return {mean.x / count, mean.y / count};
}

Complex of_loop(const Aperture::Loop& loop, double kx, double ky) {
  const Aperture::Point c = mean_corner(loop);
  const auto phase = [&](const Aperture::Point& p) { return kx * (p.x - c.x) + ky * (p.y - c.y); };
  Complex sum = 0;
  for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++) {
    const Aperture::Point &a = loop[last], &b = loop[i];
    const double twice_area = (a.x - c.x) * (b.y - c.y) - (b.x - c.x) * (a.y - c.y);
    sum += twice_area * divided_difference(0, phase(a), phase(b));
  }
  return std::polar(1.0, kx * c.x + ky * c.y) * sum;
}

// J1(x)/x.
double jinc(double x) { return std::fabs(x) < 1e-4 ? 0.5 - x * x / 16 : bessel_j(1, x) / x; }

}  // namespace

Complex fraunhofer_integral(const Aperture& aperture, double kx, double ky) {
  Complex sum = 0;
  for (const Aperture::Loop& loop : aperture.loops) sum += of_loop(loop, kx, ky);
  const double q = std::hypot(kx, ky);
  for (const auto& [radius, sign] : aperture.discs) sum += sign * 2 * pi * radius * radius * jinc(q * radius);
  return sum;
}

Complex fraunhofer_integral(const Aperture& aperture, const std::function<Complex(double, double)>& amplitude,
                            double kx, double ky) {
  const auto integrand = [&](double x, double y) { return amplitude(x, y) * std::polar(1.0, kx * x + ky * y); };
  // A panel takes 8 rad; the amplitude's own variation is found by halving.
  const int panels = 1 + static_cast<int>(std::hypot(kx, ky) * extent(aperture) / 8);
  const Aperture::Point apex = aperture.loops.empty() ? Aperture::Point{0, 0} : mean_corner(aperture.loops.front());
  return integrate_over(aperture, integrand, apex, panels, 5e-14).value;
}

double airy_intensity(double x) {
  const double amplitude = 2 * jinc(std::fabs(x));
  return amplitude * amplitude;
}

double airy_encircled_energy(double x) {
  if (std::fabs(x) < 1e-3) return x * x / 4;
  const double j0 = bessel_j(0, std::fabs(x)), j1 = bessel_j(1, std::fabs(x));
  return (1 - j0) * (1 + j0) - j1 * j1;
}

double slit_intensity(double x) { return sinc(x) * sinc(x); }

}  // namespace grimaldi
