// Directions of launched beams: even over the sphere, neighbours in number are neighbours in direction.

#include "propagation/launcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/vector.h"

namespace grimaldi {
namespace {

/// Cells of equal area: `bands` equal steps in z times `sectors` in azimuth.
constexpr int bands = 16, sectors = 32;
std::size_t bin_of(const Vec3& d) {
  const int band = std::clamp(static_cast<int>((d.z + 1) / 2 * bands), 0, bands - 1);
  const int sector = std::clamp(static_cast<int>((std::atan2(d.y, d.x) + pi) / (2 * pi) * sectors), 0, sectors - 1);
  return static_cast<std::size_t>(band * sectors + sector);
}

double chi_squared(const std::vector<double>& counts, double expected) {
  double sum = 0;
  for (const double c : counts) sum += (c - expected) * (c - expected) / expected;
  return sum;
}

// One direction a pass of many passes is a draw of its own: Pearson's χ² on equal areas, 511 degrees of freedom. By
// Wilson and Hilferty χ² stays below 617.8 with p = 0.001 and above 418.1 with p = 0.999; the seeds are fixed.
TEST(Launcher, SolidAngleIsUniformOverPasses) {
  constexpr int draws = 51200;
  std::vector<double> counts(bands * sectors, 0);
  for (std::uint32_t pass = 0; pass < draws; ++pass) ++counts[bin_of(Launcher(7, pass, 1000).direction(123))];
  const double chi2 = chi_squared(counts, double(draws) / double(counts.size()));
  const double z = (std::cbrt(chi2 / 511) - (1 - 2 / (9 * 511.0))) / std::sqrt(2 / (9 * 511.0));
  std::printf("chi2 %.1f of 511 degrees, upper p-value %.3f\n", chi2, 0.5 * std::erfc(z / std::sqrt(2.0)));
  EXPECT_LT(chi2, 617.8);
  EXPECT_GT(chi2, 418.1);
}

// Within a pass the beams are a stratified set: much more even than chance. Of n points of a lattice a cell of area A n
// misses or gains those that its rim cuts: some 2 √(16 n/512) at the most, against √(n/512) of a random set; χ² far
// below its degrees of freedom.
TEST(Launcher, OnePassIsMoreEvenThanChance) {
  for (const std::uint64_t count : {10000u, 65536u, 62500u}) {
    std::vector<double> counts(bands * sectors, 0);
    const Launcher launcher(1, 0, count);
    for (std::uint64_t i = 0; i < count; ++i) ++counts[bin_of(launcher.direction(i))];
    const double chi2 = chi_squared(counts, double(count) / double(counts.size()));
    std::printf("%llu beams: chi2 %.1f of 511\n", static_cast<unsigned long long>(count), chi2);
    EXPECT_LT(chi2, 511.0 / 4) << count;
  }
}

// The mean direction is 0 and the mean of d dᵀ is a third of the unit matrix: what a sum over beams must not bias.
TEST(Launcher, NoPreferredDirection) {
  constexpr std::uint64_t count = 62500;
  const Launcher launcher(3, 5, count);
  Vec3 sum, squares;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3 d = launcher.direction(i);
    EXPECT_NEAR(norm(d), 1, 1e-15);
    sum += d;
    squares += Vec3{d.x * d.x, d.y * d.y, d.z * d.z};
  }
  // Strata of side 1/250: an error of the order of (side)^{3/2} … side; 1e-3 is far below chance, 1/√n = 4e-3.
  EXPECT_LT(norm(sum / double(count)), 1e-3);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis] / double(count), 1.0 / 3, 1e-3);
}

// Beams next to each other in number lie next to each other on the sphere: blocks of 64 cover a compact patch. Morton's
// curve jumps now and then; by the median and the mean it does not.
TEST(Launcher, NeighboursInNumberAreNeighboursInDirection) {
  constexpr std::uint64_t count = 62500;
  const double spacing = std::sqrt(4 * pi / double(count));
  const Launcher launcher(1, 2, count);
  std::vector<double> steps;
  for (std::uint64_t i = 1; i < count; ++i)
    steps.push_back(distance(launcher.direction(i), launcher.direction(i - 1)) / spacing);
  double mean = 0;
  for (const double s : steps) mean += s / double(steps.size());
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  const double median = steps[steps.size() / 2];
  std::printf("steps over the spacing: median %.2f, mean %.2f\n", median, mean);
  // The octahedral map stretches a square of area 1 to at most 1 : 2 or so; a step of the curve is 1 or √2 cells, or a
  // jump of 2^k with share 2^−k.
  EXPECT_LT(median, 2);
  EXPECT_LT(mean, 4);
  // Random order would have a mean of 4/3 rad: 94 spacings.
}

// Passes and seeds give other directions, the same arguments the same.
TEST(Launcher, DrawsBySeedAndPass) {
  const Vec3 first = Launcher(1, 0, 100).direction(7);
  EXPECT_EQ(first, Launcher(1, 0, 100).direction(7));
  EXPECT_GT(distance(first, Launcher(2, 0, 100).direction(7)), 1e-6);
  EXPECT_GT(distance(first, Launcher(1, 1, 100).direction(7)), 1e-6);
}

// Off its folds (|2u − 1| + |2v − 1| = 1, or either 0) the map keeps areas: the image of a small square has the same
// solid angle everywhere, 4π du dv.
TEST(Launcher, MapKeepsAreas) {
  constexpr double h = 1e-5;
  for (const double u : {0.07, 0.31, 0.44, 0.63, 0.92})
    for (const double v : {0.11, 0.27, 0.59, 0.86}) {
      const Vec3 du = (equal_area_direction(u + h, v) - equal_area_direction(u - h, v)) / (2 * h);
      const Vec3 dv = (equal_area_direction(u, v + h) - equal_area_direction(u, v - h)) / (2 * h);
      EXPECT_NEAR(norm(cross(du, dv)) / (4 * pi), 1, 1e-6) << u << " " << v;  // h² times derivatives of some 100
    }
}

}  // namespace
}  // namespace grimaldi
