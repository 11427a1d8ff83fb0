#include "validation/knife_edge.h"

#include <fmt/format.h>

#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/fresnel_integral.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

constexpr double largest_parameter = 100;

}  // namespace

std::complex<double> exact_knife_edge(double v) { return fresnel_tail(std::sqrt(pi / 2) * v); }

std::complex<double> exact_double_knife_edge(const DoubleKnifeEdge& edges) {
  Diagnostics faults;
  const auto length = [&](const char* name, double value) {
    if (!(value > 0 && std::isfinite(value)))
      faults.error({}, 0, name, fmt::format("{} is no length", value), "it must be finite and above 0");
  };
  const auto height = [&](const char* name, double value) {
    if (!std::isfinite(value)) faults.error({}, 0, name, "the height of an edge is not finite");
  };
  length("wavelength", edges.wavelength);
  length("d1", edges.d1);
  length("d2", edges.d2);
  length("d3", edges.d3);
  height("h1", edges.h1);
  height("h2", edges.h2);
  faults.throw_if_errors();

  const auto& [wavelength, d1, d2, d3, h1, h2] = edges;
  const double v1 = h1 * std::sqrt(2 / wavelength * (1 / d1 + 1 / (d2 + d3)));
  const double v2 = h2 * std::sqrt(2 / wavelength * (1 / (d1 + d2) + 1 / d3));
  for (const auto& [name, v] : {std::pair{"h1", v1}, {"h2", v2}})
    if (!(std::abs(v) <= largest_parameter))
      faults.error({}, 0, name, fmt::format("its Fresnel parameter over the straight line is {:.4g}", v),
                   fmt::format("digits are kept up to {:g} alone", largest_parameter), "take a lower edge");
  faults.throw_if_errors();
  // tan of the angle whose sine is the correlation: exact where d2 is small against the others.
  const double end = std::atan(std::sqrt(d1 * d3 / (d2 * (d1 + d2 + d3))));
  const double squares = (v1 - v2) * (v1 - v2), product = v1 * v2;
  const auto phase = [&](double theta) {
    const double s = std::sin(theta), c = std::cos(theta);
    return pi / 2 * (squares / (c * c) + 2 * product / (1 + s));
  };
  const double swing = std::fabs(phase(end) - phase(0));
  const Integral orthant = integrate([&](double theta) { return std::polar(1.0, -phase(theta)); }, 0, end, 1e-14,
                                     1 + static_cast<int>(std::fmin(swing / (2 * pi), 1000.0)));
  return exact_knife_edge(v1) * exact_knife_edge(v2) + orthant.value / (2 * pi);
}

double diffraction_loss(std::complex<double> field) { return -20 * std::log10(std::abs(field)); }

}  // namespace grimaldi
