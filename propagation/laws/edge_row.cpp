#include "propagation/laws/edge_row.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "core/contract.h"
#include "core/gauss_legendre.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Computed once for all rules.
const std::vector<GaussPoint>& rule_of(std::size_t n) {
  static const std::vector<std::vector<GaussPoint>> rules = [] {
    std::vector<std::vector<GaussPoint>> made(most_row_nodes + 1);
    for (std::size_t i = 1; i <= most_row_nodes; ++i) made[i] = gauss_legendre_points(static_cast<int>(i));
    return made;
  }();
  return rules[n];
}

constexpr double reach = 3.5;  ///< in widths: e^{−12}
constexpr double least_nodes = 8;

double extent_of(double argument, double width) {
  const double decay = 0.5 * argument * width;
  return reach * width / std::sqrt(1 + decay * decay);
}

}  // namespace

bool row_fits(double width) { return std::ceil(least_nodes + extent_of(0, width)) <= double(most_row_nodes); }

RowAperture row_aperture(double argument, double width) {
  GRIMALDI_EXPECT(argument >= 0 && row_fits(width));
  const double extent = extent_of(argument, width);
  RowAperture aperture;
  aperture.count = static_cast<std::size_t>(std::ceil(least_nodes + extent));
  const std::vector<GaussPoint>& rule = rule_of(aperture.count);
  const Complex decay = -2 * argument * std::polar(1.0, 0.25 * pi);
  for (std::size_t i = 0; i < aperture.count; ++i) {
    aperture.place[i] = 0.5 * extent * (1 + rule[i].position);
    aperture.weight[i] = 0.5 * extent * rule[i].weight / std::sqrt(pi) * std::exp(decay * aperture.place[i]);
  }
  return aperture;
}

void row_rests(std::span<const double> couplings, std::span<double> rests) {
  GRIMALDI_EXPECT(rests.size() == couplings.size() + 1);
  rests.back() = 1;
  for (std::size_t i = couplings.size(); i-- > 0;) {
    rests[i] = 1 - couplings[i] * couplings[i] / rests[i + 1];
    // Couplings held to below 1 by rounding may take the last digits of a chain of near edges.
    rests[i] = std::max(rests[i], 1e-12);
  }
}

void row_kernel(const RowAperture& from, const RowAperture& to, const RowLink& link, double plain, double slope,
                std::span<double> kernel) {
  GRIMALDI_EXPECT(kernel.size() >= from.count * to.count);
  const double root = std::sqrt(link.rest), onward = link.coupling / root, alone = plain - slope;
  std::array<double, most_row_nodes> fades, carried;
  for (std::size_t k = 0; k < from.count; ++k) {
    carried[k] = onward * from.place[k];
    fades[k] = alone * std::exp(-carried[k] * carried[k]);
  }
  for (std::size_t l = 0; l < to.count; ++l) {
    const double here = root * to.place[l], fade = std::exp(-here * here);
    double* row = kernel.data() + l * from.count;
    for (std::size_t k = 0; k < from.count; ++k) {
      const double apart = here - carried[k];
      row[k] = fade * fades[k] + slope * std::exp(-apart * apart);
    }
  }
}

Complex edge_row_wave(std::span<const double> arguments, std::span<const bool> dark, std::span<const double> couplings,
                      std::span<const double> widths) {
  const std::size_t n = arguments.size();
  GRIMALDI_EXPECT(n > 0 && dark.size() == n && couplings.size() + 1 == n && widths.size() == n);
  std::vector<double> rests(n), kernel(most_row_nodes * most_row_nodes);
  row_rests(couplings, rests);
  RowAperture here = row_aperture(arguments[0], widths[0]);
  std::vector<Complex> wave(here.count);
  for (std::size_t k = 0; k < here.count; ++k)
    wave[k] = here.weight[k] * std::exp(-rests[0] * here.place[k] * here.place[k]);
  for (std::size_t i = 1; i < n; ++i) {
    const RowAperture next = row_aperture(arguments[i], widths[i]);
    row_kernel(here, next, {dark[i - 1] == dark[i] ? couplings[i - 1] : -couplings[i - 1], rests[i]}, 1, 1, kernel);
    std::vector<Complex> passed(next.count);
    for (std::size_t l = 0; l < next.count; ++l) {
      for (std::size_t k = 0; k < here.count; ++k) passed[l] += kernel[l * here.count + k] * wave[k];
      passed[l] *= next.weight[l];
    }
    wave = std::move(passed);
    here = next;
  }
  Complex sum = 0;
  for (const Complex& part : wave) sum += part;
  return std::count(dark.begin(), dark.end(), false) % 2 == 0 ? sum : -sum;
}

}  // namespace grimaldi
