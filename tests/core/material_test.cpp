#include "core/material.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "core/constants.h"
#include "core/p2040.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {
namespace {

double conductivity(std::complex<double> permittivity, double frequency) {
  return -permittivity.imag() * vacuum_permittivity * 2 * pi * frequency;
}

TEST(Material, KeysLoseCaseBlanksAndPrefixes) {
  for (const char* name :
       {"ITU Concrete", "mat-itu_concrete", "itu_concrete", "concrete", " Concrete\t", "mat-Concrete"})
    EXPECT_EQ(material_key(name), "concrete") << name;
  EXPECT_EQ(material_key("Very  Dry Ground"), "very_dry_ground");
  EXPECT_EQ(material_key("mat-"), "mat-");  // nothing would be left
  EXPECT_EQ(material_key(""), "");
}

TEST(Material, Table3OfP2040) {
  const auto rows = reference_rows("radio/p2040_parameters.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p2040_parameters.csv";
  int compared = 0;
  for (const auto& row : rows) {
    if (row[1].rfind("P.2040-3", 0) != 0) continue;
    const Material& material = built_in_materials().at(material_key(row[2]));
    const double from = std::stod(row[3]), to = std::stod(row[4]);
    bool found = false;
    for (const PermittivityRange& range : material.radio) {
      if (range.from_GHz != from) continue;
      found = true;  // the table is definitional: exact
      EXPECT_EQ(range.to_GHz, to) << row[2];
      EXPECT_EQ(range.a, std::stod(row[5])) << row[2];
      EXPECT_EQ(range.b, std::stod(row[6])) << row[2];
      EXPECT_EQ(range.c, std::stod(row[7])) << row[2];
      EXPECT_EQ(range.d, std::stod(row[8])) << row[2];
    }
    EXPECT_TRUE(found) << row[2] << " from " << row[3] << " GHz";
    ++compared;
  }
  EXPECT_EQ(compared, 16);
  std::size_t ranges = 0;
  for (const auto& [key, material] : built_in_materials()) {
    EXPECT_EQ(key, material.name);
    EXPECT_EQ(key, material_key(key));
    ranges += material.radio.size();
  }
  EXPECT_EQ(built_in_materials().size(), 15u);
  EXPECT_EQ(ranges, 17u);  // the 16 rows and vacuum
}

TEST(Material, PublishedPermittivities) {
  const auto rows = reference_rows("radio/p2040_permittivity_published.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p2040_permittivity_published.csv";
  int compared = 0;
  for (const auto& row : rows) {
    if (row[1] != "P.2040-3") continue;
    Diagnostics diagnostics;
    const double f = 1e9 * std::stod(row[3]);
    const auto here = relative_permittivity(built_in_materials().at(material_key(row[2])), f, diagnostics);
    // Five digits are printed: half a unit of the last is at most 5e-5 of the value.
    EXPECT_NEAR(here.real(), std::stod(row[4]), 5e-5 * std::stod(row[4])) << row[2];
    EXPECT_NEAR(conductivity(here, f), std::stod(row[5]), 5e-5 * std::stod(row[5])) << row[2];
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

// Every version's table against the file, row by row, in the middle of the range; where ranges of a material overlap,
// the row with the lowest lower end and then the lowest upper end is the one that counts.
TEST(Material, VersionsOfP2040) {
  const auto rows = reference_rows("radio/p2040_parameters.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p2040_parameters.csv";
  int compared = 0, hidden = 0;
  for (const auto& row : rows) {
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const std::optional<int> version = p2040_version(row[1]);
    ASSERT_TRUE(version) << row[1];
    const Material& material = p2040_materials(*version).at(material_key(row[2]));
    for (const double share : {0.0, 0.37, 1.0}) {
      const double low = std::max(number(3), 1e-3), high = std::min(number(4), 1000.0);
      const double f = low * std::pow(high / low, share);
      const bool overruled = std::any_of(rows.begin(), rows.end(), [&](const auto& other) {
        if (other[1] != row[1] || other[2] != row[2]) return false;
        const double from = std::stod(other[3]), to = std::stod(other[4]);
        return from <= f && f <= to && (from < number(3) || (from == number(3) && to < number(4)));
      });
      if (overruled) {
        ++hidden;
        continue;
      }
      Diagnostics diagnostics;
      const auto here = relative_permittivity(material, f * 1e9, diagnostics);
      EXPECT_TRUE(diagnostics.all().empty()) << row[0];
      EXPECT_NEAR(here.real() / (number(5) * std::pow(f, number(6))), 1, 1e-14) << row[0];
      EXPECT_NEAR(conductivity(here, f * 1e9), number(7) * std::pow(f, number(8)),
                  1e-14 * number(7) * std::pow(f, number(8)))
          << row[0];
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(hidden, 10);
}

TEST(Material, PublishedPermittivitiesOfAllVersions) {
  const auto rows = reference_rows("radio/p2040_permittivity_published.csv");
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/radio/p2040_permittivity_published.csv";
  for (const auto& row : rows) {
    const std::optional<int> version = p2040_version(row[1]);
    ASSERT_TRUE(version) << row[1];
    Diagnostics diagnostics;
    const double f = 1e9 * std::stod(row[3]);
    const auto& table = p2040_materials(*version);
    ASSERT_TRUE(table.contains(material_key(row[2]))) << row[2];
    const auto here = relative_permittivity(table.at(material_key(row[2])), f, diagnostics);
    // Five digits are printed.
    EXPECT_NEAR(here.real(), std::stod(row[4]), 5e-5 * std::stod(row[4])) << row[0];
    EXPECT_NEAR(conductivity(here, f), std::stod(row[5]), 5e-5 * std::stod(row[5]) + 1e-12) << row[0];
  }
}

TEST(Material, NamesOfVersions) {
  EXPECT_EQ(p2040_version("P.2040-3"), 3);
  EXPECT_EQ(p2040_version(" p2040-1 "), 1);
  for (const char* name : {"", "P.2040", "P.2040-5", "P.2040-33", "P.676-3", "3"})
    EXPECT_FALSE(p2040_version(name)) << name;
  EXPECT_EQ(p2040_materials(2).at("glass").radio.size(), 2u);
  // The table of a run is version 3.
  for (const auto& [key, material] : p2040_materials(3))
    EXPECT_EQ(material.radio.size(), built_in_materials().at(key).radio.size());
}

TEST(Material, LossesAreNegativeImaginary) {
  Diagnostics diagnostics;
  // P.2040's own form of (9): η = ε' − j 17.98 σ/f; the constant has four digits.
  const auto eta = relative_permittivity(built_in_materials().at("concrete"), 1e9, diagnostics);
  EXPECT_EQ(eta.real(), 5.24);
  EXPECT_NEAR(eta.imag(), -17.98 * 0.0462, 0.005 * 0.0462);
  EXPECT_TRUE(diagnostics.all().empty());
}

TEST(Material, OutsideEveryRangeTheNearestIsExtrapolatedWithAWarning) {
  const Material& glass = built_in_materials().at("glass");
  for (const auto& [f, a, c, d] :
       {std::array{140e9, 6.31, 0.0036, 1.3394},  // 1.4 above the first, 1.57 below the second
        std::array{200e9, 5.79, 0.0004, 1.658},   // nearer to the second
        std::array{0.05e9, 6.31, 0.0036, 1.3394}}) {
    Diagnostics diagnostics;
    const auto eta = relative_permittivity(glass, f, diagnostics);
    EXPECT_EQ(eta.real(), a);
    const double sigma = c * std::pow(f / 1e9, d);
    EXPECT_NEAR(conductivity(eta, f), sigma, 1e-14 * sigma);  // rounding of five operations
    ASSERT_EQ(diagnostics.all().size(), 1u);
    const Diagnostic& warning = diagnostics.all()[0];
    EXPECT_EQ(warning.severity, Severity::warning);
    EXPECT_EQ(warning.option, "material.glass");
    EXPECT_NE(warning.suggestion.find("relative permittivity"), std::string::npos);
  }
  Diagnostics inside;
  relative_permittivity(glass, 0.1e9, inside);  // the ends belong to the range
  relative_permittivity(glass, 100e9, inside);
  relative_permittivity(glass, 450e9, inside);
  EXPECT_TRUE(inside.all().empty());
}

TEST(Material, TablesOverrideAndAreLinearInTheLogarithm) {
  Material material = built_in_materials().at("concrete");
  material.permittivity = Spectrum{{1e9, 100e9}, {4, 8}};
  material.conductivity = Spectrum{{1e9}, {0.5}};
  Diagnostics diagnostics;
  const auto eta = relative_permittivity(material, 10e9, diagnostics);
  EXPECT_NEAR(eta.real(), 6, 1e-14);  // half way in log f; rounding of the logarithms
  EXPECT_NEAR(conductivity(eta, 10e9), 0.5, 1e-15);
  EXPECT_EQ(relative_permittivity(material, 1e9, diagnostics).real(), 4);
  EXPECT_EQ(relative_permittivity(material, 100e9, diagnostics).real(), 8);
  EXPECT_TRUE(diagnostics.all().empty());
  EXPECT_EQ(relative_permittivity(material, 101e9, diagnostics).real(), 8);  // the nearest end, and an error
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::error);
  EXPECT_NE(to_string(diagnostics.all()[0]).find("101 GHz"), std::string::npos);
}

TEST(Material, OverriddenConstantsNeedNoRange) {
  Material material = built_in_materials().at("concrete");
  material.permittivity = Spectrum{{1e9}, {5}};
  material.conductivity = Spectrum{{1e9}, {0.1}};
  Diagnostics diagnostics;
  relative_permittivity(material, 500e9, diagnostics);  // outside P.2040, yet nothing of P.2040 is used
  EXPECT_TRUE(diagnostics.all().empty());
  material.conductivity.reset();
  relative_permittivity(material, 500e9, diagnostics);  // now its conductivity is
  EXPECT_EQ(diagnostics.all().size(), 1u);
}

TEST(Material, WhatIsNotKnownIsSaid) {
  Material material;
  material.name = "jelly";
  Diagnostics nothing;
  const auto eta = relative_permittivity(material, 1e9, nothing);
  EXPECT_TRUE(nothing.has_errors());
  EXPECT_TRUE(std::isfinite(eta.real()) && std::isfinite(eta.imag()));
  material.permittivity = Spectrum{{1e9}, {3}};
  Diagnostics lossless;
  EXPECT_EQ(relative_permittivity(material, 1e9, lossless), std::complex<double>(3, 0));
  ASSERT_EQ(lossless.all().size(), 1u);
  EXPECT_FALSE(lossless.has_errors());
  material.permittivity = Spectrum{{1e9, 2e9}, {3}};
  Diagnostics uneven;
  relative_permittivity(material, 1e9, uneven);
  EXPECT_TRUE(uneven.has_errors());
}

TEST(Material, AbsorptionOfTheBuiltInTable) {
  Diagnostics diagnostics;
  const Material& concrete = built_in_materials().at("concrete");
  EXPECT_EQ(absorption_coefficient(concrete, octave_bands(125, 125).front(), diagnostics), 0.02);
  EXPECT_EQ(absorption_coefficient(concrete, 1000, diagnostics), 0.03);
  EXPECT_EQ(absorption_coefficient(concrete, octave_bands(4000, 4000).front(), diagnostics), 0.07);
  // Half way in log f between 2 kHz (0.04) and 4 kHz (0.07); the logarithms round.
  EXPECT_NEAR(absorption_coefficient(concrete, 1000 * std::pow(10.0, 0.45), diagnostics), 0.055, 1e-15);
  EXPECT_TRUE(diagnostics.all().empty());
  for (const auto& [key, material] : built_in_materials()) {
    if (!material.absorption) continue;
    ASSERT_EQ(material.absorption->frequency.size(), material.absorption->value.size()) << key;
    ASSERT_EQ(material.absorption->value.size(), 8u) << key;
    for (const double alpha : material.absorption->value) EXPECT_TRUE(alpha >= 0 && alpha <= 1) << key;
  }
}

TEST(Material, AbsorptionReachesHalfAnOctaveBeyondItsTable) {
  const Material& concrete = built_in_materials().at("concrete");
  Diagnostics near;
  EXPECT_EQ(absorption_coefficient(concrete, 50, near), 0.02);
  EXPECT_EQ(absorption_coefficient(concrete, 11000, near), 0.07);
  EXPECT_TRUE(near.all().empty());
  for (const double f : {44.0, 16000.0}) {
    Diagnostics far;
    absorption_coefficient(concrete, f, far);
    EXPECT_TRUE(far.has_errors()) << f;
  }
}

TEST(Material, ConstantOrUnknownAbsorption) {
  Material material;
  material.name = "curtain";
  Diagnostics unknown;
  EXPECT_EQ(absorption_coefficient(material, 1000, unknown), 0.05);
  ASSERT_EQ(unknown.all().size(), 1u);
  EXPECT_FALSE(unknown.has_errors());
  material.absorption = Spectrum{{1000}, {0.4}};
  Diagnostics constant;
  EXPECT_EQ(absorption_coefficient(material, 20, constant), 0.4);
  EXPECT_EQ(absorption_coefficient(material, 20000, constant), 0.4);
  EXPECT_TRUE(constant.all().empty());
}

}  // namespace
}  // namespace grimaldi
