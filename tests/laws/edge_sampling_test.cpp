// The law from which azimuths at an edge are drawn: samples follow it, weights give the power of the edge and stay
// bounded.

#include "propagation/laws/edge_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "core/special_functions.h"
#include "propagation/laws/free_space_diffraction.h"
#include "tests/laws/upper_gamma.h"

namespace grimaldi {
namespace {

constexpr std::uint64_t seed = 7;

struct Geometry {
  const char* name;
  EdgeSector sector;
  double distance, wavelength, sin_beta;
};

const Geometry geometries[] = {
    {"black screen, radio", {2 * pi, 1.2, true, false}, 100, 0.3, 1},
    {"black screen, grazing the edge", {2 * pi, 4.0, true, false}, 30, 0.34, 0.1},
    {"hard screen, sound", {2 * pi, 2.0, true, true}, 20, 0.68, 0.8},
    {"roof edge, boundary in the solid", {1.5 * pi, 2.0, false, true}, 40, 0.34, 0.9},
    {"roof edge, one face in shadow", {1.5 * pi, 0.4, false, true}, 40, 0.1, 0.7},
    {"blunt edge near grazing", {1.1 * pi, 1e-3, false, true}, 5, 2, 1},
};

class AzimuthSampling : public testing::TestWithParam<Geometry> {
 protected:
  AzimuthLaw law() const {
    return {GetParam().sector, GetParam().distance, GetParam().wavelength, GetParam().sin_beta};
  }
};

// χ² of 200,000 draws in 64 bins of equal probability. The bins' edges come from the density summed over 400,000 steps,
// which is right to 1e-5 of the whole; the chance of p < 1e-3 in six honest cases is 0.6 %, and the seed is fixed.
TEST_P(AzimuthSampling, DrawsFollowTheDensity) {
  const AzimuthLaw law = this->law();
  const double angle = GetParam().sector.exterior_angle;
  constexpr int steps = 400000, bins = 64, draws = 200000;
  std::vector<double> edges;
  std::vector<double> cumulative(steps + 1, 0);
  for (int i = 0; i < steps; ++i)
    cumulative[i + 1] = cumulative[i] + law.density((i + 0.5) * angle / steps) * angle / steps;
  EXPECT_NEAR(cumulative.back(), 1, 2e-5);
  for (int b = 1; b < bins; ++b) {
    const double target = cumulative.back() * b / bins;
    const auto next = std::lower_bound(cumulative.begin(), cumulative.end(), target);
    const double share = (target - next[-1]) / (next[0] - next[-1]);
    edges.push_back((double(next - cumulative.begin()) - 1 + share) * angle / steps);
  }
  std::vector<int> counts(bins, 0);
  for (int i = 0; i < draws; ++i) {
    const auto u = uniform4(seed, 1, static_cast<std::uint64_t>(i), 0);
    const double phi = law.draw(u[0], u[1]);
    ASSERT_TRUE(phi >= 0 && phi <= angle);
    ++counts[std::upper_bound(edges.begin(), edges.end(), phi) - edges.begin()];
  }
  const double expected = double(draws) / bins;
  double chi2 = 0;
  for (const int count : counts) chi2 += (count - expected) * (count - expected) / expected;
  const double p = upper_gamma(0.5 * (bins - 1), 0.5 * chi2);
  RecordProperty("p", std::to_string(p));
  EXPECT_GT(p, 1e-3) << GetParam().name << " chi2 " << chi2;
  EXPECT_LT(p, 1 - 1e-3) << GetParam().name << " chi2 " << chi2;
}

// Weights L|ΣU|²/density against their mean, for second legs from very short to infinite. Three terms in phase have 9
// times the power of one, which is what the lobes are made for; without the uniform part the ratio has no bound between
// two boundaries.
TEST_P(AzimuthSampling, WeightsAreBounded) {
  const AzimuthLaw law = this->law();
  const Geometry& g = GetParam();
  const double angle = g.sector.exterior_angle;
  const auto power = [&](double distance, double phi) {
    const auto u = sector_waves(g.sector, distance, g.wavelength, g.sin_beta, phi);
    return distance * std::norm(u[0] + u[1] + u[2]);
  };
  constexpr int steps = 200000;
  double mean = 0;
  for (int i = 0; i < steps; ++i) mean += power(g.distance, (i + 0.5) * angle / steps) * angle / steps;
  for (const double share : {1.0, 0.5, 0.1, 1e-3, 1e-6}) {
    double most = 0;
    for (int i = 0; i < steps; ++i) {
      const double phi = (i + 0.5) * angle / steps;
      most = std::max(most, power(share * g.distance, phi) / law.density(phi));
    }
    if (share == 1) std::printf("%s: largest weight %.2f of the mean\n", g.name, most / mean);
    EXPECT_LT(most, 9 * mean) << g.name << " L/s' = " << share;
  }
}

INSTANTIATE_TEST_SUITE_P(Edges, AzimuthSampling, testing::ValuesIn(geometries),
                         [](const auto& p) { return "case" + std::to_string(p.index); });

// The black edge scatters I r_F sin β/(2π√2) = 0.11254 I r_F per unit length into the shadow, and as much takes part on
// the lit side; by samples and weights. v(ε = π) = 2828 here, so what the paraxial integral misses is 1/(π v) = 1e-4 of
// it; four standard errors of 400,000 samples are added.
TEST(EdgePower, ShadowPowerOfABlackEdge) {
  const double wavelength = 1e-4, distance = 100, sin_beta = 0.9;
  const EdgeSector sector{2 * pi, 1.0, true, false};
  const AzimuthLaw law(sector, distance, wavelength, sin_beta);
  const double first_zone = std::sqrt(wavelength * distance);
  constexpr int draws = 400000;
  // A receiver at infinity (L = s') and one as far as the source (L = s'/2, r_F smaller by √2).
  for (const double share : {1.0, 0.5}) {
    double sum[2] = {0, 0}, squares[2] = {0, 0};
    for (int i = 0; i < draws; ++i) {
      const auto u = uniform4(seed, 2, static_cast<std::uint64_t>(i), 0);
      const double phi = law.draw(u[0], u[1]);
      const double effective = share * distance;
      const double weight = effective * sin_beta * sin_beta *
                            std::norm(sector_waves(sector, effective, wavelength, sin_beta, phi)[0]) / law.density(phi);
      const int side = turns_beyond_boundaries(sector, phi)[0] > 0;
      sum[side] += weight / draws;
      squares[side] += weight * weight / draws;
    }
    const double expected = 0.5 * boundary_power * sin_beta * first_zone * std::sqrt(share);
    EXPECT_NEAR(0.5 * boundary_power, 0.11254, 5e-7);
    for (const int side : {0, 1}) {
      const double error = std::sqrt((squares[side] - sum[side] * sum[side]) / draws);
      EXPECT_LT(error, 3e-3 * expected);
      EXPECT_NEAR(sum[side], expected, 4 * error + 2e-4 * expected) << (side ? "shadow" : "lit") << " L/s' = " << share;
      std::printf("power/(I r_F sin beta): %.6f +- %.6f, %s side, L/s' %.1f (exact %.6f)\n",
                  sum[side] / (sin_beta * first_zone * std::sqrt(share)),
                  error / (sin_beta * first_zone * std::sqrt(share)), side ? "dark" : "lit", share,
                  0.5 * boundary_power);
    }
  }
}

// The terms against an independent form: |E(v)| of the knife edge in shadow; sign change at each boundary; the screen's
// two sides are one mirror.
TEST(SectorWaves, AreTheTermsOfTheEdge) {
  const EdgeSector screen{2 * pi, 1.0, true, true}, roof{1.5 * pi, 1.0, false, true};
  for (const double phi : {pi + 1.0 + 1e-3, pi + 1.5, 2 * pi - 0.1}) {
    const double v = 2 * std::sqrt(2 * 50.0 / 0.3) * 0.8 * std::sin(0.5 * (phi - 1.0 - pi));
    const auto u = sector_waves(screen, 50, 0.3, 0.8, phi);
    EXPECT_NEAR(std::abs(u[0]), std::abs(knife_edge(v)), 1e-13);
    EXPECT_EQ(u[2], std::complex<double>(0));
  }
  const auto jump = [](const EdgeSector& sector, double boundary, std::size_t term) {
    return std::abs(sector_waves(sector, 50, 0.3, 0.8, boundary + 1e-9)[term] -
                    sector_waves(sector, 50, 0.3, 0.8, boundary - 1e-9)[term]);
  };
  // A jump of 1, less the slope |dU/dε| < 30 times 2e-9.
  EXPECT_NEAR(jump(screen, pi + 1.0, 0), 1, 1e-6);
  EXPECT_NEAR(jump(screen, pi - 1.0, 1), 1, 1e-6);
  EXPECT_NEAR(jump(roof, pi - 1.0, 1), 1, 1e-6);
  EXPECT_NEAR(jump(EdgeSector{1.5 * pi, 1.2 * pi, false, true}, 0.8 * pi, 2), 1, 1e-6);
  const EdgeSector behind{2 * pi, 2 * pi - 1.0, true, true};
  for (const double phi : {0.5, 2.0, 4.0})
    EXPECT_NEAR(
        std::abs(sector_waves(screen, 50, 0.3, 0.8, phi)[1] - sector_waves(behind, 50, 0.3, 0.8, 2 * pi - phi)[1]), 0,
        1e-12);
}

}  // namespace
}  // namespace grimaldi
