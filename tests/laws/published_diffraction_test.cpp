// The published form of the free-space diffraction BSDF: its functions against high-precision values, its power against
// quadrature, its level behind an edge.

#include "propagation/laws/published_diffraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/constants.h"
#include "core/special_functions.h"

namespace grimaldi {
namespace {

// Reference: decimal arithmetic of 80 digits on the exact values of the doubles.
TEST(PublishedKernels, AlphasToTheLastDigits) {
  const double rows[][4] = {
      {1e-08, 2.0, -6.63145596216230561342e-11, 7.95774715459476655634e-2},
      {0.001, -0.001, 6.63145579637590808321e-3, -7.95774682302197265933e+1},
      {0.5, 0.3, -5.81479567952574977434e-3, 1.38972575491281842021e-1},
      {1.999, 1e-06, -5.99517502441701304603e-9, 3.35205692352248421830e-8},
      {2.001, 5.0, -4.13318063285522785099e-3, 2.30830732114817463276e-2},
      {-7.25, 3.5, 8.97634828972061816926e-4, -1.10201213869391103906e-3},
      {40.5, -1000.0, -4.74178314299715590785e-7, -7.73305378676233312423e-6},
      {1234.5, 0.75, 4.52221237852222908725e-12, 1.26555529164197762362e-10},
      {3e-160, 4e-160, -0.48 / (24 * pi), 2.54647908947032540124e+158},
  };
  // 1e-13 is what is promised to users of these kernels; a handful of roundings give some 1e-15.
  for (const auto& r : rows) {
    EXPECT_NEAR(alpha1(r[0], r[1]) / r[2], 1, 1e-13) << r[0] << " " << r[1];
    EXPECT_NEAR(alpha2(r[0], r[1]) / r[3], 1, 1e-13) << r[0] << " " << r[1];
  }
  EXPECT_EQ(alpha1(0, 0), 0);
  EXPECT_EQ(alpha1(0, 1), 0);
  EXPECT_DOUBLE_EQ(alpha2(0, 3), 1 / (6 * pi));
}

// ∫|ψ̂|² over all directions (R = 1, k e = 1) by midpoints in polar coordinates, out to ζ = 400. Beyond, the pattern is
// a blade about the edge's normal: (1/πZ)|(a + b)/2|² + (1/12πZ)|a − b|² (∫sinc²(x/2) dx = 2π, ∫g1² dx = π/6), right to
// 1/Z of it; so 2e-5 of the whole, and as much for the midpoints.
TEST(PublishedKernels, PowerOfAnEdge) {
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, std::pair{1.0, -1.0}, std::pair{0.7, 0.2}}) {
    const PublishedEdge edge{{-0.5, 0}, {0.5, 0}, a, b};
    constexpr int rings = 8000, spokes = 720;
    const double reach = 400;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
      // Rings are dense at small ζ: ζ = reach s².
      const double s = (i + 0.5) / rings, zeta = reach * s * s, step = 2 * reach * s / rings;
      for (int j = 0; j < spokes; ++j) {
        const double angle = 0.5 * pi * (j + 0.5) / spokes;
        for (const double sign : {1.0, -1.0})
          sum += 2 * std::norm(published_edge_wave(1, edge, {zeta * std::cos(angle), sign * zeta * std::sin(angle)})) *
                 zeta * step * 0.5 * pi / spokes;
      }
    }
    sum += ((a + b) * (a + b) / 4 + (a - b) * (a - b) / 12) / (pi * reach);
    EXPECT_NEAR(sum / published_edge_power(edge), 1, 1e-4) << a << " " << b;
  }
}

// A polygon's edges add up to the reference's psih (R = 1), the field with the lobes removed, and their powers to its
// sumPj.
TEST(PublishedKernels, PolygonsOfTheReferenceFile) {
  const std::filesystem::path file = std::filesystem::path(GRIMALDI_SHARED) / "reference" / "fsd_vectors.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs ../shared/reference/fsd_vectors.csv";
  std::ifstream stream(file);
  int rows = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("id,", 0) == 0) continue;
    std::vector<std::string> fields;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
    ASSERT_EQ(fields.size(), 19u) << line;
    const auto numbers = [](const std::string& text) {
      std::istringstream words(text);
      std::vector<double> list;
      for (double x = 0; words >> x;) list.push_back(x);
      return list;
    };
    const double k = std::stod(fields[4]);
    const PlanePoint xi{std::stod(fields[5]), std::stod(fields[6])};
    const auto places = numbers(fields[8]), amplitudes = numbers(fields[9]), corners = numbers(fields[10]);
    const auto place = [&](std::size_t i) { return PlanePoint{places[2 * i], places[2 * i + 1]}; };
    std::set<std::pair<std::size_t, std::size_t>> sides;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
      std::array<std::size_t, 3> c;
      for (std::size_t i = 0; i < 3; ++i) c[i] = static_cast<std::size_t>(corners[t + i]);
      const auto p = place(c[0]), q = place(c[1]), r = place(c[2]);
      if ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) < 0) std::swap(c[1], c[2]);
      for (std::size_t i = 0; i < 3; ++i) sides.insert({c[i], c[(i + 1) % 3]});
    }
    std::complex<double> sum = 0;
    double power = 0, scale = 0, size = 0;
    for (const double place_part : places) size = std::max(size, std::abs(place_part));
    for (const auto& [from, to] : sides) {
      if (sides.contains({to, from})) continue;
      const PublishedEdge edge{place(from),
                               place(to),
                               {amplitudes[2 * from], amplitudes[2 * from + 1]},
                               {amplitudes[2 * to], amplitudes[2 * to + 1]}};
      const auto wave = published_edge_wave(k, edge, xi);
      sum += wave;
      scale += std::abs(wave);
      power += published_edge_power(edge);
    }
    const std::complex<double> expected{std::stod(fields[15]), std::stod(fields[16])};
    // Rounding of the phases (k ξ·v up to 4e6 rad: half an ulp of each of its two terms) and of terms that cancel.
    EXPECT_LE(std::abs(sum - expected), (1e-13 + 2.2e-16 * k * size * std::hypot(xi[0], xi[1])) * scale + 1e-300)
        << "row " << fields[0];
    EXPECT_NEAR(power / std::stod(fields[18]), 1, 1e-12) << "row " << fields[0];
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

/// Depth below the edge at which the path over it has v.
double depth_for(double v, double before, double behind, double wavelength) {
  double low = 0, high = behind;
  for (int i = 0; i < 100; ++i) {
    const double z = 0.5 * (low + high);
    (before + std::hypot(behind, z) - std::hypot(before + behind, z) < v * v * wavelength / 4 ? low : high) = z;
  }
  return low;
}

double level_error(double sigma, int pieces, double v, double before, double behind, double wavelength) {
  const double level = published_half_plane_level({sigma, pieces}, wavelength, before, behind,
                                                  depth_for(v, before, behind, wavelength), 800, 120);
  return 10 * std::log10(level / std::norm(knife_edge(v)));
}

// The weight 1/P_A of rays that hit integrates to ln 2 = −1.59 dB in deep shadow, where the lobes are gone: v = 60, at
// a wavelength so short that angles are small (0.03 rad). Pieces of length e lose e²/(12 σ_a²) of the power, σ_a = √2
// sigma (linear amplitude for a Gaussian): 0.09 dB for 12, 0.02 dB for 24. The mean hit lies 0.65 sigma within, so that
// a footprint of ½ r_F sees v smaller by 0.46: 1.5 %, 0.07 dB more power, which the tolerance allows for.
TEST(PublishedLevel, DeepShadowIsTooDarkByLnTwo) {
  const double wavelength = 3e-5, zone = std::sqrt(wavelength * 50);
  for (const int pieces : {12, 24}) {
    const double length = 6.0 / pieces, expected = 10 * std::log10(std::log(2.0) * (1 - length * length / 12));
    const double error = level_error(0.5 * zone, pieces, 60, 100, 100, wavelength);
    EXPECT_NEAR(error, expected, 0.09) << pieces;
    std::printf("deep shadow, %d pieces: %.3f dB (ln 2 and linear pieces: %.3f dB)\n", pieces, error, expected);
  }
}

// The published footprint of 25 λ: its errors are no fault of this code, they are the method. Held here so that they
// are seen: too dark near the boundary by more than 3 dB, too bright in the shadow by more than 4 dB; twice the pieces,
// less power.
TEST(PublishedLevel, ErrsBySeveralDecibels) {
  struct Case {
    const char* name;
    double before, behind, wavelength;
  };
  for (const Case& c :
       {Case{"1 GHz 100/100 m", 100, 100, 0.299792458}, Case{"1 GHz 1000/100 m", 1000, 100, 0.299792458},
        Case{"500 Hz sound 20/20 m", 20, 20, 343.2 / 500}}) {
    const double sigma = published_sigma_wavelengths * c.wavelength;
    std::printf("%-20s", c.name);
    for (const double v : {0.05, 0.3, 0.8, 1.5, 2.5, 4.0}) {
      const double error = level_error(sigma, 12, v, c.before, c.behind, c.wavelength);
      std::printf("  v %.2f %+6.2f dB", v, error);
      if (v == 0.05) {
        EXPECT_LT(error, -3) << c.name;
      } else if (v == 4) {
        EXPECT_GT(error, 4) << c.name;
        EXPECT_LT(level_error(sigma, 24, v, c.before, c.behind, c.wavelength), error) << c.name;
      }
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace grimaldi
