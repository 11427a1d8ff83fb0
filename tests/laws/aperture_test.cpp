// Powers, moments and central lobe of apertures against quadrature and differences of the field.

#include "propagation/laws/aperture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/constants.h"
#include "tests/laws/fsd_rows.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

// A quadrilateral of two triangles, wound differently, off the origin, with complex amplitudes.
TriangleAperture quadrilateral() {
  return {{{0.1, -0.3}, {1.3, 0.2}, {0.9, 1.1}, {-0.2, 0.7}},
          {{1.0, 0.2}, {0.7, -0.4}, {0.9, 0.5}, {0.3, 0.6}},
          {{0, 1, 2}, {0, 3, 2}}};
}

// PA and sumPj of the file have 17 digits; its psie and psih are the sums over edges with and without their lobes.
// Phases k ξ·v up to 4e6 rad round by half an ulp of each of their two terms.
TEST(Aperture, PowersAndEdgesOfTheReference) {
  const auto rows = fsd_rows();
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/fsd_vectors.csv";
  for (const FsdRow& row : rows) {
    EXPECT_NEAR(aperture_power(row.aperture) / row.power, 1, 1e-14) << row.id;
    double power = 0, scale = 0, reach = 0;
    Complex whole = 0, removed = 0;
    for (const PublishedEdge& edge : boundary_edges(row.aperture)) {
      power += published_edge_power(edge);
      whole += whole_edge_wave(row.wavenumber, edge, row.xi);
      removed += published_edge_wave(row.wavenumber, edge, row.xi);
      scale += std::abs(whole_edge_wave(row.wavenumber, edge, row.xi));
    }
    for (const PlanePoint& u : row.aperture.vertices) reach = std::max({reach, std::abs(u[0]), std::abs(u[1])});
    const double bound = (1e-13 + 2.2e-16 * row.wavenumber * reach * std::hypot(row.xi[0], row.xi[1])) * scale;
    EXPECT_NEAR(power / row.edge_power, 1, 1e-14) << row.id;
    // At ξ = 0 the edges have their pole.
    if (row.xi != PlanePoint{0, 0}) {
      EXPECT_LE(std::abs(whole - row.edges), bound + 1e-300) << row.id;
    }
    EXPECT_LE(std::abs(removed - row.lobes_removed), bound + 1e-300) << row.id;
  }
}

// Where the amplitude is constant the edges are the field: two forms with nothing in common but the aperture. The edge
// form loses digits as 1/(kξL)², here ≥ 1.
TEST(Aperture, ConstantAmplitudeIsTheSumOfItsEdges) {
  TriangleAperture aperture = quadrilateral();
  std::fill(aperture.amplitudes.begin(), aperture.amplitudes.end(), Complex(0.6, -0.8));
  for (const double k : {30.0, 200.0})
    for (const PlanePoint& xi : {PlanePoint{0.1, 0.02}, PlanePoint{-0.3, 0.4}, PlanePoint{0.0, 0.1}}) {
      Complex sum = 0;
      for (const PublishedEdge& edge : boundary_edges(aperture)) sum += whole_edge_wave(k, edge, xi);
      EXPECT_LT(std::abs(sum - aperture_field(aperture, k, xi)), 1e-14 * k) << k << " " << xi[0];
    }
}

// ∫|ψ|² d²ξ = ∫|φ|² d²q (S1.4). The square of a transform of bounded support: its sum over a grid finer than 2π over
// twice the support is the integral, but for what lies outside the grid, 2/(πκ) of the edges' blades: 0.5 % at κ = 600.
TEST(Aperture, PowerIsThatOfTheField) {
  const TriangleAperture aperture = quadrilateral();
  const double step = 1.5, reach = 600;
  const int count = static_cast<int>(reach / step);
  std::vector<PlanePoint> xi;
  std::vector<Complex> field;
  double sum = 0;
  for (int i = -count; i <= count; ++i) {
    xi.clear();
    for (int j = -count; j <= count; ++j) xi.push_back({i * step, j * step});
    field.resize(xi.size());
    aperture_field(aperture, 1, xi, field);
    for (const Complex& value : field) sum += std::norm(value) * step * step;
  }
  EXPECT_NEAR(sum / aperture_power(aperture), 1, 1e-2);
  EXPECT_LT(sum, aperture_power(aperture) * (1 + 1e-6));
}

// Σ₀⁻¹ |ψ(0)|² = −Hessian of |ψ|² at 0, by differences of the field: with h = 1e-3/k the error is h² of the fourth
// derivatives, 1e-6, and rounding 1e-15/h².
TEST(Aperture, CentralLobeIsTheCurvatureOfTheField) {
  const TriangleAperture aperture = quadrilateral();
  const double k = 40, h = 1e-3 / k;
  const CentralLobe lobe = central_lobe(aperture, k);
  const auto power = [&](double x, double y) { return std::norm(aperture_field(aperture, k, {x, y})); };
  EXPECT_NEAR(lobe.peak / power(0, 0), 1, 1e-14);
  const double xx = -(power(h, 0) - 2 * power(0, 0) + power(-h, 0)) / (h * h * lobe.peak);
  const double yy = -(power(0, h) - 2 * power(0, 0) + power(0, -h)) / (h * h * lobe.peak);
  const double xy = -(power(h, h) - power(h, -h) - power(-h, h) + power(-h, -h)) / (4 * h * h * lobe.peak);
  EXPECT_NEAR(lobe.inverse_covariance[0] / xx, 1, 1e-5);
  EXPECT_NEAR(lobe.inverse_covariance[1] / xy, 1, 1e-5);
  EXPECT_NEAR(lobe.inverse_covariance[2] / yy, 1, 1e-5);
}

// B.16 is the integral of B.14: a Gaussian of Σ₀⁻¹ + σ_ξ⁻² (midpoints over ±8 standard deviations: 1e-10).
TEST(Aperture, PowerOfTheCentralLobeIsItsIntegral) {
  const TriangleAperture aperture = quadrilateral();
  const double k = 40;
  const CentralLobe lobe = central_lobe(aperture, k);
  double length = 0, weight = 0;
  for (const PublishedEdge& e : boundary_edges(aperture)) {
    length += published_edge_power(e) * std::hypot(e.end[0] - e.start[0], e.end[1] - e.start[1]);
    weight += published_edge_power(e);
  }
  const double sigma = std::sqrt(3.0) * weight / (k * length);
  const auto& [xx, xy, yy] = lobe.inverse_covariance;
  constexpr int count = 400;
  const double step = 16 * sigma / count;
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double x = (i + 0.5) * step - 8 * sigma, y = (j + 0.5) * step - 8 * sigma;
      sum += std::exp(-0.5 * (xx * x * x + 2 * xy * x * y + yy * y * y + (x * x + y * y) / (sigma * sigma)));
    }
  EXPECT_NEAR(lobe.power / (sum * step * step * lobe.peak), 1, 1e-9);
}

// The moments do not care how the aperture is cut, where the origin lies (Σ₀⁻¹), nor how long a metre is (shares).
TEST(Aperture, SharesDoNotDependOnOriginAndUnit) {
  const TriangleAperture aperture = quadrilateral();
  TriangleAperture moved = aperture, larger = aperture;
  for (PlanePoint& u : moved.vertices) u[0] += 3, u[1] -= 5;
  for (PlanePoint& u : larger.vertices) u[0] *= 7, u[1] *= 7;
  const CentralLobe a = central_lobe(aperture, 20), b = central_lobe(moved, 20);
  // M2/M0 and |M1/M0|² cancel by (5.8/0.5)².
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a.inverse_covariance[i], b.inverse_covariance[i], 1e-12 * a.inverse_covariance[0]);
  EXPECT_NEAR(diffracted_share(aperture, 20), diffracted_share(larger, 20.0 / 7), 1e-13);
  EXPECT_NEAR(sampling_quality(aperture, 20), sampling_quality(larger, 20.0 / 7), 1e-12);
  EXPECT_GT(diffracted_share(aperture, 20), 0);
  EXPECT_LT(diffracted_share(aperture, 20), 1);
}

// Cutting the boundary's edges in two halves the sum of their own powers, about (S3): 2 (e/2)² (|mean|² I2), so the
// quality doubles up to the change of the lobe. The diffracted share follows σ_ξ.
TEST(Aperture, QualityGrowsWithTheNumberOfEdges) {
  const TriangleAperture square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {1, 1, 1, 1}, {{0, 1, 2}, {0, 2, 3}}};
  const TriangleAperture cut{{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0.5, 1}, {0, 1}, {0, 0.5}, {0.5, 0.5}},
                             std::vector<Complex>(9, 1.0),
                             {{0, 1, 8}, {1, 2, 8}, {2, 3, 8}, {3, 4, 8}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 0, 8}}};
  double whole = 0, halves = 0;
  for (const PublishedEdge& e : boundary_edges(square)) whole += published_edge_power(e);
  for (const PublishedEdge& e : boundary_edges(cut)) halves += published_edge_power(e);
  EXPECT_NEAR(halves / whole, 0.5, 1e-14);
  EXPECT_NEAR(aperture_power(cut) / aperture_power(square), 1, 1e-14);
  const double ratio = sampling_quality(cut, 30) / sampling_quality(square, 30);
  EXPECT_NEAR(ratio, 2 * diffracted_share(cut, 30) / diffracted_share(square, 30), 1e-12);
}

TEST(Aperture, ManyDirectionsAtOnce) {
  const TriangleAperture aperture = quadrilateral();
  std::vector<PlanePoint> xi;
  for (int i = 0; i < 150; ++i) xi.push_back({0.006 * i - 0.4, 0.3 - 0.002 * i});
  std::vector<Complex> field(xi.size());
  aperture_field(aperture, 200, xi, field);
  // Sums of the same terms; one product of the sum more or less.
  for (std::size_t i = 0; i < xi.size(); ++i)
    EXPECT_LE(std::abs(field[i] - aperture_field(aperture, 200, xi[i])), 1e-15 * 200) << i;
}

}  // namespace
}  // namespace grimaldi
