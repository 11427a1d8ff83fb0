#include "propagation/laws/free_space_diffraction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "core/sine_cosine.h"
#include "core/special_functions.h"

namespace grimaldi {

double fresnel_parameter(double effective_distance, double wavelength, double sin_beta, double epsilon) {
  GRIMALDI_EXPECT(effective_distance >= 0 && wavelength > 0);
  const double turn = std::min(std::abs(epsilon), pi);
  return 2 * std::sqrt(2 * effective_distance / wavelength) * sin_beta * sine_cosine(turn / 2).sine;
}

std::complex<double> edge_wave(double v, bool shadow) {
  return (shadow ? 0.5 : -0.5) * faddeeva_on_ray(std::sqrt(pi / 2) * v);
}

void edge_waves(std::span<const double> effective_distance, double wavelength, std::span<const double> sin_beta,
                std::span<const double> epsilon, std::span<std::complex<double>> waves) {
  GRIMALDI_EXPECT(effective_distance.size() == waves.size() && sin_beta.size() == waves.size() &&
                  epsilon.size() == waves.size() && wavelength > 0);
  constexpr std::size_t block = 64;
  std::array<double, block> argument;
  for (std::size_t begin = 0; begin < waves.size(); begin += block) {
    const std::size_t count = std::min(block, waves.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      // √(π/2) v, v = 2 √(2L/λ) sin β sin(ε/2).
      const double turn = std::min(std::fabs(epsilon[begin + i]), pi);
      argument[i] = 2 * std::sqrt(pi * effective_distance[begin + i] / wavelength) * sin_beta[begin + i] *
                    sine_cosine(0.5 * turn).sine;
    }
    faddeeva_on_ray(std::span(argument).first(count), waves.subspan(begin, count));
    for (std::size_t i = 0; i < count; ++i) waves[begin + i] *= epsilon[begin + i] >= 0 ? 0.5 : -0.5;
  }
}

std::complex<double> edge_end_wave(double detour, double wavelength, double wavenumber, bool inside) {
  const double v = 2 * std::sqrt(std::max(detour, 0.0) / wavelength);
  const SineCosine turn = sine_cosine(-wavenumber * detour);
  return edge_wave(v, !inside) * std::complex<double>(turn.cosine, turn.sine);
}

double edge_end_share(double v, double v_end) {
  const double sum = v * v + v_end * v_end;
  return sum > 0 ? v * v / sum : 0.5;
}

double edge_power_density(double effective_distance, double wavelength, double sin_beta, double epsilon) {
  return effective_distance * sin_beta * sin_beta *
         std::norm(edge_wave(fresnel_parameter(effective_distance, wavelength, sin_beta, epsilon), true));
}

double edge_tail(double v) {
  // w(e^{3jπ/4}√(π/2)v) = (f + g) − j(f − g) with the auxiliary Fresnel functions (A&S 7.3.9, 7.3.10, 7.3.22).
  const std::complex<double> w = faddeeva_on_ray(std::sqrt(pi / 2) * v);
  const double f = 0.5 * (w.real() - w.imag());
  const double g = 0.5 * (w.real() + w.imag());
  return 2 * f - pi * v * (f * f + g * g);
}

double edge_tail_inverse(double u) {
  GRIMALDI_EXPECT(u > 0 && u <= 1);
  double low = 0, high = 1;
  while (edge_tail(high) > u) high *= 2;
  double v = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i) {
    const double excess = edge_tail(v) - u;
    if (std::abs(excess) <= 1e-12) break;
    (excess > 0 ? low : high) = v;
    const std::complex<double> w = faddeeva_on_ray(std::sqrt(pi / 2) * v);
    const double slope = -0.5 * pi * std::norm(w);  // −π(f² + g²), |w|² = 2(f² + g²)
    v -= excess / slope;
    if (!(v > low && v < high)) v = 0.5 * (low + high);
  }
  return v;
}

}  // namespace grimaldi
