#include "propagation/laws/aperture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Twice the area, > 0 if wound counterclockwise.
double turned_area(const std::array<PlanePoint, 3>& u) {
  return (u[1][0] - u[0][0]) * (u[2][1] - u[0][1]) - (u[1][1] - u[0][1]) * (u[2][0] - u[0][0]);
}

double area(const AmplitudeTriangle& t) { return 0.5 * std::abs(turned_area(t.corner)); }

double edge_length(const PublishedEdge& edge) {
  return std::hypot(edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]);
}

}  // namespace

AmplitudeTriangle TriangleAperture::triangle(std::size_t i) const {
  const auto& [a, b, c] = triangles[i];
  return {{vertices[a], vertices[b], vertices[c]}, {amplitudes[a], amplitudes[b], amplitudes[c]}};
}

Complex aperture_field(const TriangleAperture& aperture, double wavenumber, const PlanePoint& xi) {
  Complex sum = 0;
  for (std::size_t i = 0; i < aperture.triangles.size(); ++i)
    sum += triangle_transform(aperture.triangle(i), {wavenumber * xi[0], wavenumber * xi[1]});
  return wavenumber / (2 * pi) * sum;
}

void aperture_field(const TriangleAperture& aperture, double wavenumber, std::span<const PlanePoint> xi,
                    std::span<Complex> field) {
  GRIMALDI_EXPECT(xi.size() == field.size());
  constexpr std::size_t block = 64;
  std::array<PlanePoint, block> kappa;
  std::array<Complex, block> part;
  for (std::size_t begin = 0; begin < xi.size(); begin += block) {
    const std::size_t count = std::min(block, xi.size() - begin);
    const std::span<Complex> here = field.subspan(begin, count);
    for (std::size_t i = 0; i < count; ++i) kappa[i] = {wavenumber * xi[begin + i][0], wavenumber * xi[begin + i][1]};
    std::fill(here.begin(), here.end(), Complex{});
    for (std::size_t t = 0; t < aperture.triangles.size(); ++t) {
      triangle_transform(aperture.triangle(t), std::span(kappa).first(count), std::span(part).first(count));
      for (std::size_t i = 0; i < count; ++i) here[i] += part[i];
    }
    for (Complex& value : here) value *= wavenumber / (2 * pi);
  }
}

std::vector<PublishedEdge> boundary_edges(const TriangleAperture& aperture) {
  std::vector<std::pair<std::size_t, std::size_t>> sides;
  for (std::size_t i = 0; i < aperture.triangles.size(); ++i) {
    auto [a, b, c] = aperture.triangles[i];
    if (turned_area(aperture.triangle(i).corner) < 0) std::swap(b, c);
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<PublishedEdge> edges;
  for (const auto& [from, to] : sides)
    if (!std::binary_search(sides.begin(), sides.end(), std::pair{to, from}))
      edges.push_back(
          {aperture.vertices[from], aperture.vertices[to], aperture.amplitudes[from], aperture.amplitudes[to]});
  return edges;
}

double aperture_power(const TriangleAperture& aperture) {
  double power = 0;
  for (std::size_t i = 0; i < aperture.triangles.size(); ++i) {
    const AmplitudeTriangle t = aperture.triangle(i);
    const auto& [a, b, c] = t.amplitude;
    // Re Σ_{j≤l} φ_j φ_l* = ½ (|φ1|² + |φ2|² + |φ3|² + |φ1 + φ2 + φ3|²), a sum without cancellation.
    power += area(t) / 12 * (std::norm(a) + std::norm(b) + std::norm(c) + std::norm(a + b + c));
  }
  return power;
}

ApertureMoments aperture_moments(const TriangleAperture& aperture) {
  ApertureMoments m{};
  for (std::size_t n = 0; n < aperture.triangles.size(); ++n) {
    const AmplitudeTriangle t = aperture.triangle(n);
    const double s = area(t);
    const Complex p = t.amplitude[0] + t.amplitude[1] + t.amplitude[2];
    m.zeroth += s / 3 * p;
    for (std::size_t i = 0; i < 3; ++i) {
      const PlanePoint& u = t.corner[i];
      for (std::size_t x = 0; x < 2; ++x) m.first[x] += s / 12 * (p + t.amplitude[i]) * u[x];
      for (std::size_t j = 0; j < 3; ++j) {
        const PlanePoint& v = t.corner[j];
        const Complex weight = s / 60 * (i == j ? 2.0 : 1.0) * (p + t.amplitude[i] + t.amplitude[j]);
        m.second[0] += weight * u[0] * v[0];
        m.second[1] += weight * u[0] * v[1];
        m.second[2] += weight * u[1] * v[1];
      }
    }
  }
  return m;
}

CentralLobe central_lobe(const TriangleAperture& aperture, double wavenumber) {
  const ApertureMoments m = aperture_moments(aperture);
  const double size = std::norm(m.zeroth);
  GRIMALDI_EXPECT(size > 0);
  CentralLobe lobe;
  lobe.peak = wavenumber * wavenumber / (4 * pi * pi) * size;
  const auto curvature = [&](std::size_t second, std::size_t x, std::size_t y) {
    return 2 * wavenumber * wavenumber *
           ((m.second[second] / m.zeroth).real() - (m.first[x] * std::conj(m.first[y])).real() / size);
  };
  lobe.inverse_covariance = {curvature(0, 0, 0), curvature(1, 0, 1), curvature(2, 1, 1)};
  double length = 0, power = 0;
  for (const PublishedEdge& edge : boundary_edges(aperture)) {
    length += published_edge_power(edge) * edge_length(edge);
    power += published_edge_power(edge);
  }
  const double sigma = std::sqrt(3.0) / (wavenumber * (length / power));
  const auto& [xx, xy, yy] = lobe.inverse_covariance;
  const double a = xx + 1 / (sigma * sigma), c = yy + 1 / (sigma * sigma), determinant = a * c - xy * xy;
  lobe.power = a > 0 && determinant > 0 ? 2 * pi / std::sqrt(determinant) * lobe.peak : 0;
  return lobe;
}

double diffracted_share(const TriangleAperture& aperture, double wavenumber) {
  return std::max(0.0, 1 - central_lobe(aperture, wavenumber).power / aperture_power(aperture));
}

double sampling_quality(const TriangleAperture& aperture, double wavenumber) {
  double edges = 0;
  for (const PublishedEdge& edge : boundary_edges(aperture)) edges += published_edge_power(edge);
  return diffracted_share(aperture, wavenumber) * aperture_power(aperture) / edges;
}

}  // namespace grimaldi
