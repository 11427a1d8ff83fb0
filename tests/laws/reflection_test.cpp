// Reflection at a plane face against independent coefficients and against what must hold for any face.

#include "propagation/laws/reflection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "core/constants.h"
#include "core/contract.h"
#include "core/material.h"
#include "core/p2040.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();

double cosine(double degrees) { return std::cos(degrees * pi / 180); }

/// √(η − sin²θ), the cosine in the material times its index, of a lossless material.
double lossless_root(double permittivity, double c) { return std::sqrt((permittivity - 1) + c * c); }

// The reference holds to 1e-12; for metal (|η| ~ 1e7 to 1e8) to 1e-9, as its header says.
TEST(Reflection, HalfSpaceAgainstReference) {
  const auto rows = reference_rows("radio/fresnel_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/fresnel_coefficients.csv";
  double worst = 0;
  for (const auto& row : rows) {
    const Complex eta(std::stod(row[4]), std::stod(row[5]));
    const auto r = half_space_reflection(eta, cosine(std::stod(row[6])));
    const double error = std::max(std::abs(r.te - Complex(std::stod(row[7]), std::stod(row[8]))),
                                  std::abs(r.tm - Complex(std::stod(row[9]), std::stod(row[10]))));
    EXPECT_LT(error, row[1] == "metal" ? 1e-9 : 1e-12) << row[0];
    if (row[1] != "metal") worst = std::max(worst, error);
  }
  std::printf("half-space: %zu rows, largest error %.1e (metal apart)\n", rows.size(), worst);
}

// 1e-12 by the reference's header. Materials through the table, so the table is held too.
TEST(Reflection, SlabAgainstReference) {
  const auto rows = reference_rows("radio/slab_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/slab_coefficients.csv";
  int compared = 0;
  double worst = 0;
  for (const auto& row : rows) {
    if (row[2] != "P.2040-3") continue;  // the table is that of P.2040-3
    Diagnostics diagnostics;
    const double frequency = std::stod(row[3]) * 1e9;
    const Complex eta = relative_permittivity(built_in_materials().at(material_key(row[1])), frequency, diagnostics);
    const auto r =
        slab_reflection(eta, std::stod(row[4]), 2 * pi * frequency / speed_of_light, cosine(std::stod(row[5])));
    const double error = std::max(std::abs(r.te - Complex(std::stod(row[6]), std::stod(row[7]))),
                                  std::abs(r.tm - Complex(std::stod(row[8]), std::stod(row[9]))));
    worst = std::max(worst, error);
    ++compared;
    EXPECT_LT(error, 1e-12) << row[0];
  }
  std::printf("slab: %d rows, largest error %.1e\n", compared, worst);
  EXPECT_GT(compared, 40);
}

// 1e-12, metal 1e-9, by the header of the file.
TEST(Reflection, TransmissionIntoAHalfSpaceAgainstReference) {
  const auto rows = reference_rows("radio/fresnel_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/fresnel_coefficients.csv";
  for (const auto& row : rows) {
    const Complex eta(std::stod(row[4]), std::stod(row[5]));
    const auto t = half_space_transmission(eta, cosine(std::stod(row[6])));
    const double error = std::max(std::abs(t.te - Complex(std::stod(row[11]), std::stod(row[12]))),
                                  std::abs(t.tm - Complex(std::stod(row[13]), std::stod(row[14]))));
    EXPECT_LT(error, row[1] == "metal" ? 1e-9 : 1e-12) << row[0];
  }
}

TEST(Reflection, WholeSlabAgainstReference) {
  const auto rows = reference_rows("radio/slab_coefficients.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/slab_coefficients.csv";
  double worst = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    Diagnostics diagnostics;
    const double frequency = number(3) * 1e9;
    const auto version = p2040_version(row[2]);
    ASSERT_TRUE(version) << row[2];
    const Complex eta =
        relative_permittivity(p2040_materials(*version).at(material_key(row[1])), frequency, diagnostics);
    const auto s = slab_coefficients(eta, number(4), 2 * pi * frequency / speed_of_light, cosine(number(5)));
    const Complex here[] = {s.reflection.te, s.reflection.tm, s.transmission.te, s.transmission.tm};
    for (std::size_t i = 0; i < 4; ++i) {
      const double error = std::abs(here[i] - Complex(number(6 + 2 * i), number(7 + 2 * i)));
      EXPECT_LT(error, 1e-12) << row[0];
      worst = std::max(worst, error);
    }
  }
  std::printf("whole slab: %zu rows, largest error %.1e\n", rows.size(), worst);
}

// A lossless slab gives back all it takes; a lossy one less; without thickness or contrast it is not there; T + … of a
// face: 1 + R_TE = T_TE (tangential E is continuous).
TEST(Reflection, TransmissionTheorems) {
  for (const double c : {1e-3, 0.3, 0.9, 1.0})
    for (const double d : {0.0, 1e-9, 0.003, 0.2}) {
      const auto lossless = slab_coefficients({4.5, 0}, d, 73, c), lossy = slab_coefficients({4.5, -0.3}, d, 73, c);
      EXPECT_NEAR(std::norm(lossless.reflection.te) + std::norm(lossless.transmission.te), 1, 1e-12) << c << " " << d;
      EXPECT_NEAR(std::norm(lossless.reflection.tm) + std::norm(lossless.transmission.tm), 1, 1e-12) << c << " " << d;
      EXPECT_LE(std::norm(lossy.reflection.te) + std::norm(lossy.transmission.te), 1 + 1e-12);
      EXPECT_LE(std::norm(lossy.reflection.tm) + std::norm(lossy.transmission.tm), 1 + 1e-12);
      const auto only = slab_reflection({4.5, -0.3}, d, 73, c);
      EXPECT_LT(std::abs(only.te - lossy.reflection.te), 1e-15);
      EXPECT_LT(std::abs(only.tm - lossy.reflection.tm), 1e-15);
      const auto r = half_space_reflection({4.5, -0.3}, c), t = half_space_transmission({4.5, -0.3}, c);
      EXPECT_LT(std::abs(1.0 + r.te - t.te), 1e-15);
      EXPECT_LT(std::abs((1.0 + r.tm) / std::sqrt(Complex(4.5, -0.3)) - t.tm), 1e-15);
    }
  // Grazing a film of a nanometre: the faces send all back, so it does too.
  for (const double d : {1e-9, 1e-3, 1.0}) {
    const auto grazing = slab_coefficients({5.24, -0.6}, d, 59, 0);
    EXPECT_LT(std::abs(grazing.reflection.te + 1.0) + std::abs(grazing.reflection.tm + 1.0), 1e-15) << d;
    EXPECT_EQ(grazing.transmission.te, Complex(0));
  }
  const auto none = slab_coefficients({4.5, -0.3}, 0, 73, 0.5), air = slab_coefficients({1, 0}, 0.2, 73, 0.5);
  EXPECT_EQ(none.transmission.te, Complex(1));
  EXPECT_EQ(none.reflection.tm, Complex(0));
  EXPECT_LT(std::abs(air.transmission.te - std::polar(1.0, -73 * 0.2 * 0.5)), 1e-14);
  EXPECT_EQ(slab_coefficients({4.5, -0.3}, infinite, 73, 0.5).transmission.te, Complex(0));
  EXPECT_EQ(slab_coefficients({1, -1e8}, 1, 73, 0.5).transmission.tm, Complex(0));  // e^{−10⁵}
}

TEST(Reflection, BrewsterAngleAgainstReference) {
  const auto rows = reference_rows("radio/brewster.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/brewster.csv";
  for (const auto& row : rows) {
    const double permittivity = std::stod(row[2]), angle = std::stod(row[4]);
    if (row[1] == "brewster_lossless") {
      // The angle is printed with 16 digits: 1e-13 of a coefficient whose slope is of order 1 a radian.
      EXPECT_LT(std::abs(half_space_reflection(permittivity, cosine(angle)).tm), 1e-13) << row[0];
      const auto normal = half_space_reflection(permittivity, 1),
                 half = half_space_reflection(permittivity, cosine(45));
      EXPECT_LT(std::abs(normal.te - std::stod(row[5])), 1e-14) << row[0];
      EXPECT_LT(std::abs(half.te - std::stod(row[6])), 1e-14) << row[0];
      EXPECT_LT(std::abs(half.tm - std::stod(row[7])), 1e-14) << row[0];
      continue;
    }
    // "0.0462 S/m @ 1 GHz"; the minimum of |R_TM| is printed with 12 digits.
    double conductivity = 0, gigahertz = 0;
    ASSERT_EQ(std::sscanf(row[3].c_str(), "%lf S/m @ %lf GHz", &conductivity, &gigahertz), 2) << row[3];
    const Complex eta(permittivity, -conductivity / (vacuum_permittivity * 2 * pi * gigahertz * 1e9));
    const auto magnitude = [&](double degrees) { return std::abs(half_space_reflection(eta, cosine(degrees)).tm); };
    EXPECT_NEAR(magnitude(angle), std::stod(row[5]), 1e-10) << row[0];
    EXPECT_LT(magnitude(angle), magnitude(angle - 0.01)) << row[0];
    EXPECT_LT(magnitude(angle), magnitude(angle + 0.01)) << row[0];
  }
}

// What a lossless face does not reflect goes on: power through the face, by the tangential fields that continue.
TEST(Reflection, LosslessHalfSpaceKeepsEnergy) {
  for (const double permittivity : {1.5, 5.24, 30.0, 1e4})
    for (const double c : {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-9}) {
      const auto r = half_space_reflection(permittivity, c);
      const double root = lossless_root(permittivity, c);
      // TE: E goes on as 1 + R, flux Re(root)|E|²; TM: H goes on as 1 + R in this sign, flux (root/ε)|H|². Both over
      // cos θ.
      EXPECT_NEAR(std::norm(r.te) * c + root * std::norm(1.0 + r.te), c, 1e-14 * (1 + root))
          << permittivity << " " << c;
      EXPECT_NEAR(std::norm(r.tm) * c + root / permittivity * std::norm(1.0 + r.tm), c, 1e-14 * (1 + root))
          << permittivity << " " << c;
    }
}

// A slab without loss: |R|² + |T|² = 1, T from the face's own coefficient by P.2040-3, equation (43).
TEST(Reflection, LosslessSlabKeepsEnergy) {
  for (const double permittivity : {1.5, 5.24, 30.0})
    for (const double c : {1.0, 0.7, 0.2, 0.01})
      for (const double phase : {1e-6, 0.1, 1.0, 1.6, 3.0, 50.0}) {
        const double k = 73, d = phase / (k * lossless_root(permittivity, c));
        const auto slab = slab_reflection(permittivity, d, k, c);
        const auto face = half_space_reflection(permittivity, c);
        const Complex once = std::polar(1.0, -phase);
        for (const auto& [r, f] : {std::pair{slab.te, face.te}, std::pair{slab.tm, face.tm}}) {
          const Complex t = (1.0 - f * f) * once / (1.0 - f * f * once * once);
          // Near grazing and near a half wave 1 − f² e^{−2jq} is a small difference: 1e-16 over its size.
          const double lost = 1e-14 / std::abs(1.0 - f * f * once * once);
          EXPECT_NEAR(std::norm(r) + std::norm(t), 1, 1e-13 + lost) << permittivity << " " << c << " " << phase;
        }
      }
}

// A face of air is no face, at any angle: q = √(η − 1 + cos²θ) = cos θ to the last ulp.
TEST(Reflection, VacuumReflectsNothing) {
  for (const double c : {1.0, 0.5, 1e-3, 1e-6, 1e-9}) {
    const auto r = half_space_reflection(1, c);
    EXPECT_LT(std::abs(r.te), 1e-15) << c;
    EXPECT_LT(std::abs(r.tm), 1e-15) << c;
  }
}

TEST(Reflection, SlabOfNoThicknessReflectsNothing) {
  for (const double c : {1.0, 0.5, 1e-3}) {
    const auto r = slab_reflection({5.24, -0.4}, 0, 73, c);
    EXPECT_EQ(r.te, 0.0);
    EXPECT_EQ(r.tm, 0.0);
  }
  // A thin slab reflects in proportion to its thickness: no digit is lost on the way to zero. Relative deviation from
  // proportion: of the order k d |η|/cos θ = 1e-7 at the thicker one.
  const auto thin = slab_reflection({5.24, -0.4}, 1e-10, 73, 0.5),
             thinner = slab_reflection({5.24, -0.4}, 1e-14, 73, 0.5);
  EXPECT_LT(std::abs(thinner.te * 1e4 / thin.te - 1.0), 1e-6);
  EXPECT_LT(std::abs(thinner.tm * 1e4 / thin.tm - 1.0), 1e-6);
}

// Half a wavelength inside: what the back returns cancels what the front reflects.
TEST(Reflection, HalfWaveSlabIsTransparent) {
  for (const double permittivity : {1.5, 5.24, 30.0})
    for (const double c : {1.0, 0.7, 0.3})
      for (const int halves : {1, 2, 7}) {
        const double k = 73, d = halves * pi / (k * lossless_root(permittivity, c));
        const auto r = slab_reflection(permittivity, d, k, c);
        // e^{−2jq} is 1 to a few ulp of 2q; the resonance raises that by 1/(1 − R'²) < 20 here.
        EXPECT_LT(std::abs(r.te), 1e-12) << permittivity << " " << c;
        EXPECT_LT(std::abs(r.tm), 1e-12) << permittivity << " " << c;
        // A quarter of a wave less, it reflects the most: (η_eff − 1)/(η_eff + 1) with R' = (1 − x)/(1 + x), R = 2R'/(1
        // + R'²).
        const auto most = slab_reflection(permittivity, d - d / (2 * halves), k, c),
                   face = half_space_reflection(permittivity, c);
        EXPECT_LT(std::abs(most.te - 2.0 * face.te / (1.0 + face.te * face.te)), 1e-12);
      }
}

TEST(Reflection, ThickSlabIsAHalfSpace) {
  const Complex eta(5.24, -0.4);
  for (const double c : {1.0, 0.5, 0.01}) {
    const auto half = half_space_reflection(eta, c);
    // 20 m: the way back is weaker by e^{−2·73·20·0.087} = 1e-110.
    for (const double d : {20.0, infinite}) {
      const auto slab = slab_reflection(eta, d, 73, c);
      EXPECT_LT(std::abs(slab.te - half.te), 1e-15) << c;
      EXPECT_LT(std::abs(slab.tm - half.tm), 1e-15) << c;
    }
  }
}

// At grazing incidence every face reflects −1 in both polarisations; R + 1 vanishes like cos θ, without a jump at 0.
TEST(Reflection, GrazingIncidence) {
  for (const Complex eta : {Complex(5.24, -0.4), Complex(2, 0), Complex(1, -1e6)}) {
    for (const double d : {0.1, infinite}) {
      const auto at = slab_reflection(eta, d, 73, 0);
      EXPECT_LT(std::abs(at.te + 1.0), 1e-15);
      EXPECT_LT(std::abs(at.tm + 1.0), 1e-15);
    }
    // R_TE + 1 = 2c/(c + q), R_TM + 1 = 2ηc/(ηc + q): exact forms, no cancellation.
    const double c = 1e-8;
    const Complex q = std::sqrt(eta - 1.0);
    const auto near = half_space_reflection(eta, c);
    EXPECT_LT(std::abs(near.te + 1.0 - 2 * c / (c + q)), 1e-15);
    EXPECT_LT(std::abs(near.tm + 1.0 - 2.0 * eta * c / (eta * c + q)), 2e-15);
  }
}

TEST(Reflection, NormalIncidenceAndConductor) {
  const auto normal = slab_reflection({5.24, -0.4}, 0.1, 73, 1);
  EXPECT_LT(std::abs(normal.te + normal.tm), 1e-15);  // one wave, two signs by convention
  const auto conductor = half_space_reflection({1, -1e16}, 0.4);
  EXPECT_LT(std::abs(conductor.te + 1.0), 2e-8);  // R + 1 ~ 2 cos θ/√η
  EXPECT_LT(std::abs(conductor.tm - 1.0), 6e-8);
}

TEST(Reflection, WallsOfSound) {
  EXPECT_EQ(wall_reflection(0), 1);
  EXPECT_EQ(wall_reflection(1), 0);
  EXPECT_EQ(wall_reflection(0.75), 0.5);
}

}  // namespace
}  // namespace grimaldi
