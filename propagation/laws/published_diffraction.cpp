#include "propagation/laws/published_diffraction.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "core/vector.h"

namespace grimaldi {
namespace {

double sinc(double x) { return std::abs(x) < 1e-8 ? 1 : std::sin(x) / x; }

/// y/(x² + y²) without overflow or underflow.
double over_square(double x, double y) {
  const double scale = std::max(std::abs(x), std::abs(y));
  if (scale == 0) return 0;
  const double a = x / scale, b = y / scale;
  return b / (a * a + b * b) / scale;
}

/// ζ = k(e·ξ, e m·ξ), S2.22.
PlanePoint canonical_direction(double wavenumber, const PublishedEdge& edge, const PlanePoint& xi) {
  const double ex = edge.end[0] - edge.start[0], ey = edge.end[1] - edge.start[1];
  return {wavenumber * (ex * xi[0] + ey * xi[1]), wavenumber * (ey * xi[0] - ex * xi[1])};
}

/// Half the length of the silhouette that is taken, over sigma: three standard deviations of the amplitude.
const double reach = 3 * std::sqrt(2.0);

constexpr double uniform_share = 1.0 / 7;

}  // namespace

double edge_g1(double x) {
  const double u = 0.5 * x, square = u * u;
  if (std::abs(u) >= 1) return (std::cos(u) - sinc(u)) / x;
  double nested = 1;
  for (const double divisor : {304.0, 238.0, 180.0, 130.0, 88.0, 54.0, 28.0, 10.0})
    nested = 1 - square / divisor * nested;
  return -u / 6 * nested;
}

double edge_g2(double x) { return sinc(0.5 * x); }

double alpha1(double zeta_x, double zeta_y) { return over_square(zeta_x, zeta_y) * edge_g1(zeta_x) / (2 * pi); }

double alpha2(double zeta_x, double zeta_y) { return over_square(zeta_x, zeta_y) * edge_g2(zeta_x) / (2 * pi); }

std::complex<double> whole_edge_wave(double wavenumber, const PublishedEdge& edge, const PlanePoint& xi) {
  const double ex = edge.end[0] - edge.start[0], ey = edge.end[1] - edge.start[1];
  const PlanePoint zeta = canonical_direction(wavenumber, edge, xi);
  const double middle = 0.5 * ((edge.start[0] + edge.end[0]) * xi[0] + (edge.start[1] + edge.end[1]) * xi[1]);
  const std::complex<double> a = edge.start_amplitude, b = edge.end_amplitude, i{0, 1};
  const std::complex<double> shape = (a - b) * alpha1(zeta[0], zeta[1]) + 0.5 * i * (a + b) * alpha2(zeta[0], zeta[1]);
  return wavenumber * (ex * ex + ey * ey) * std::polar(1.0, -std::remainder(wavenumber * middle, 2 * pi)) * shape;
}

std::complex<double> published_edge_wave(double wavenumber, const PublishedEdge& edge, const PlanePoint& xi) {
  const PlanePoint zeta = canonical_direction(wavenumber, edge, xi);
  const double without_lobe = std::sqrt(-std::expm1(-(zeta[0] * zeta[0] + zeta[1] * zeta[1]) / 6));
  return without_lobe * whole_edge_wave(wavenumber, edge, xi);
}

double published_edge_power(const PublishedEdge& edge) {
  constexpr double integral1 = 0.004612658839610051, integral2 = 0.12458996032251083;
  const double ex = edge.end[0] - edge.start[0], ey = edge.end[1] - edge.start[1];
  const std::complex<double> difference = edge.start_amplitude - edge.end_amplitude;
  const std::complex<double> mean = 0.5 * (edge.start_amplitude + edge.end_amplitude);
  return (ex * ex + ey * ey) * (std::norm(difference) * integral1 + std::norm(mean) * integral2);
}

double power_on_obstacle(const PublishedFootprint& footprint, double distance) {
  return 0.5 * std::erfc(-distance / (std::sqrt(2.0) * footprint.sigma));
}

PublishedScattering::PublishedScattering(const PublishedFootprint& footprint, double wavenumber, double distance,
                                         double from, double to)
    : wavenumber_(wavenumber),
      share_(power_on_obstacle(footprint, distance)),
      width_along_(0.5 / (wavenumber * footprint.sigma)) {
  GRIMALDI_EXPECT(footprint.sigma > 0 && footprint.pieces > 0 && wavenumber > 0);
  const double half = reach * footprint.sigma, length = 2 * half / footprint.pieces;
  const double peak = 1 / (std::sqrt(2 * pi) * footprint.sigma);
  width_towards_ = std::sqrt(6.0) / (wavenumber * length);
  const auto amplitude = [&](double along) {
    return peak * std::exp(-(along * along + distance * distance) / (4 * footprint.sigma * footprint.sigma));
  };
  // From the far end backwards: the obstacle is on the left.
  for (int i = 0; i < footprint.pieces; ++i) {
    const double start = std::min(half - i * length, to), end = std::max(half - (i + 1) * length, from);
    if (start > end) edges_.push_back({{start, distance}, {end, distance}, amplitude(start), amplitude(end)});
  }
}

double PublishedScattering::operator()(const PlanePoint& xi) const {
  std::complex<double> sum = 0;
  for (const PublishedEdge& edge : edges_) sum += published_edge_wave(wavenumber_, edge, xi);
  return std::norm(sum) / share_;
}

PlanePoint PublishedScattering::draw(double choice, double u, double v) const {
  if (choice < uniform_share) {
    const double radius = std::sqrt(u);
    return {radius * std::cos(2 * pi * v), radius * std::sin(2 * pi * v)};
  }
  return {width_along_ * std::tan(pi * (u - 0.5)), width_towards_ * std::tan(pi * (v - 0.5))};
}

double PublishedScattering::density(const PlanePoint& xi) const {
  const auto cauchy = [](double x, double width) { return width / (pi * (x * x + width * width)); };
  const double uniform = xi[0] * xi[0] + xi[1] * xi[1] < 1 ? uniform_share / pi : 0;
  return uniform + (1 - uniform_share) * cauchy(xi[0], width_along_) * cauchy(xi[1], width_towards_);
}

double published_half_plane_level(const PublishedFootprint& footprint, double wavelength, double before, double behind,
                                  double below, int steps_across, int steps_along) {
  const double wavenumber = 2 * pi / wavelength, sigma = footprint.sigma;
  const Vec3 source{-before, 0, 0}, receiver{behind, 0, -below}, edge{0, 1, 0};
  // The pattern is L λ/(4π sigma) wide along the edge, with tails as slow as 1/y⁴ from the linear pieces' ends.
  const double width = before * behind / (before + behind) / (wavenumber * sigma);
  const double last = std::asinh(2 * (before + behind) / width);
  const double deepest = 7 * sigma;
  double sum = 0;
  for (int i = 0; i < steps_across; ++i) {
    const double depth = (i + 0.5) * deepest / steps_across;
    for (int j = 0; j < steps_along; ++j) {
      const double t = last * (2 * (j + 0.5) / steps_along - 1);
      const Vec3 hit{0, width * std::sinh(t), -depth};
      const double s_in = distance(source, hit), s_out = distance(hit, receiver);
      const Vec3 in = (hit - source) / s_in, out = (receiver - hit) / s_out;
      const double cosine = dot(in, out);
      if (cosine <= 0) continue;
      // Across the ray: along the edge, and from the hit towards it.
      const Vec3 along = normalized(edge - dot(edge, in) * in), towards = cross(along, in);
      const double up = towards.z > 0 ? 1 : -1, gap = std::abs(dot(hit, towards));
      const double density =

          PublishedScattering(footprint, wavenumber, gap)({dot(out, along), up * dot(out, towards)}) * cosine;
      const double irradiance = before / (s_in * s_in * s_in);  // over that of unit flux per steradian
      sum += irradiance * density / (s_out * s_out) * width * std::cosh(t);
    }
  }
  const double cell = deepest / steps_across * 2 * last / steps_along;
  return sum * cell * norm2(receiver - source);
}

}  // namespace grimaldi
