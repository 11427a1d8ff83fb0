#include "core/bands.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/contract.h"

namespace grimaldi {
namespace {

// Preferred numbers of IEC 61260-1:2014, annex E; the first band of each list has the index n given.
constexpr int first_octave = -5;
constexpr std::array<double, 10> octave_nominals = {31.5, 63, 125, 250, 500, 1000, 2000, 4000, 8000, 16000};
constexpr int first_third = -16;
constexpr std::array<double, 30> third_nominals = {25,   31.5, 40,   50,   63,   80,   100,   125,   160,   200,
                                                   250,  315,  400,  500,  630,  800,  1000,  1250,  1600,  2000,
                                                   2500, 3150, 4000, 5000, 6300, 8000, 10000, 12500, 16000, 20000};

// f = 1000·10^(thirds/10) Hz
double exact_frequency(int thirds) { return 1000.0 * std::pow(10.0, thirds / 10.0); }

std::vector<double> bands(std::span<const double> nominals, int first, int thirds_per_band, double from, double to) {
  GRIMALDI_EXPECT(from > 0 && from <= to);
  constexpr double slack = 1.05;  // neighbours differ by 1.26 at least, so no band slips in that was not meant
  std::vector<double> found;
  for (std::size_t i = 0; i < nominals.size(); ++i)
    if (nominals[i] * slack >= from && nominals[i] <= to * slack)
      found.push_back(exact_frequency((first + static_cast<int>(i)) * thirds_per_band));
  return found;
}

}  // namespace

std::vector<double> octave_bands(double from, double to) { return bands(octave_nominals, first_octave, 3, from, to); }

std::vector<double> third_octave_bands(double from, double to) {
  return bands(third_nominals, first_third, 1, from, to);
}

double nominal_frequency(double frequency) {
  for (std::size_t i = 0; i < third_nominals.size(); ++i) {  // every octave is a third-octave too
    const double exact = exact_frequency(first_third + static_cast<int>(i));
    if (std::fabs(frequency - exact) <= 0.01 * exact) return third_nominals[i];
  }
  return frequency;
}

}  // namespace grimaldi
