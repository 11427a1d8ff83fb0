#include "core/bands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace grimaldi {
namespace {

// 4 ulp: pow is good to one, the products here add the rest.
constexpr double rounding = 1e-15;

TEST(Bands, OctavesAreExactMidBandFrequencies) {
  const auto f = octave_bands(63, 8000);
  ASSERT_EQ(f.size(), 8u);
  // IEC 61260-1:2014, annex E: 10^1.8 = 63.0957…, 10^3.9 = 7943.28…
  EXPECT_NEAR(f.front(), 63.09573444801933, 63.1 * rounding);
  EXPECT_NEAR(f.back(), 7943.282347242815, 7943.3 * rounding);
  EXPECT_EQ(f[4], 1000.0);
  const double ratio = std::pow(10.0, 0.3);
  for (std::size_t i = 1; i < f.size(); ++i) EXPECT_NEAR(f[i] / f[i - 1], ratio, ratio * rounding);
}

TEST(Bands, ThirdsHoldTheOctaves) {
  const auto thirds = third_octave_bands(25, 20000);
  const auto octaves = octave_bands(31.5, 16000);
  ASSERT_EQ(thirds.size(), 30u);
  ASSERT_EQ(octaves.size(), 10u);
  for (std::size_t i = 0; i < octaves.size(); ++i) EXPECT_EQ(octaves[i], thirds[3 * i + 1]);
}

TEST(Bands, LimitsMayBeNominalOrExactOrALittleOff) {
  EXPECT_EQ(octave_bands(125, 125).size(), 1u);
  EXPECT_EQ(octave_bands(125.89254, 251.18864).size(), 2u);
  EXPECT_EQ(octave_bands(65, 240).size(), 3u);  // 5 % slack: 63, 125, 250
  EXPECT_TRUE(octave_bands(70, 110).empty());
  EXPECT_TRUE(octave_bands(1e6, 1e9).empty());
  EXPECT_EQ(third_octave_bands(1, 1e9).size(), 30u);
}

TEST(Bands, NominalOfEveryThirdOctave) {
  const double nominal[] = {25,   31.5, 40,   50,   63,   80,   100,   125,   160,   200,
                            250,  315,  400,  500,  630,  800,  1000,  1250,  1600,  2000,
                            2500, 3150, 4000, 5000, 6300, 8000, 10000, 12500, 16000, 20000};
  const auto f = third_octave_bands(25, 20000);
  ASSERT_EQ(f.size(), std::size(nominal));
  for (std::size_t i = 0; i < f.size(); ++i) {
    EXPECT_EQ(nominal_frequency(f[i]), nominal[i]);
    EXPECT_EQ(nominal_frequency(nominal[i]), nominal[i]);
  }
}

TEST(Bands, OtherFrequenciesStayAsTheyAre) {
  for (const double f : {3.5e9, 1100.0, 20.0, 445.0}) EXPECT_EQ(nominal_frequency(f), f);
}

}  // namespace
}  // namespace grimaldi
