#pragma once
// Rows of a reference file, their columns by number, and the largest error over them.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "core/constants.h"
#include "tests/core/reference_rows.h"

namespace grimaldi {

using Row = std::vector<std::string>;

/// "3/2" or "1.5".
inline double fraction(const std::string& text) {
  const auto bar = text.find('/');
  return bar == std::string::npos ? std::stod(text) : std::stod(text) / std::stod(text.substr(bar + 1));
}

inline double number(const Row& row, std::size_t column) { return fraction(row.at(column)); }
inline double radians(const Row& row, std::size_t column) { return number(row, column) * pi / 180; }
/// Real part in that column, imaginary part in the next.
inline std::complex<double> complex_number(const Row& row, std::size_t column) {
  return {number(row, column), number(row, column + 1)};
}

/// The largest of many errors, each over its own tolerance, and where it was met.
class Worst {
 public:
  void add(double error, double tolerance, const std::string& where) {
    ++count_;
    if (error > error_ || std::isnan(error)) error_ = error, error_at_ = where;
    if (error / tolerance > share_ || std::isnan(error)) share_ = error / tolerance, where_ = where;
  }
  /// Fails unless all errors lie within their tolerances; `least` rows must have been compared.
  void expect_within_tolerance(int least) const {
    EXPECT_GE(count_, least);
    EXPECT_LE(share_, 1) << "error " << error_ << " at " << error_at_ << "; most of its tolerance at " << where_;
    ::testing::Test::RecordProperty("compared", count_);
    std::ostringstream text;
    text << error_ << " at " << error_at_;
    ::testing::Test::RecordProperty("largest_error", text.str());
  }

 private:
  int count_ = 0;
  double error_ = 0, share_ = 0;
  std::string where_, error_at_;
};

}  // namespace grimaldi

/// The rows of ../shared/reference/NAME, or the test ends as skipped.
#define GRIMALDI_ROWS_OR_SKIP(rows, name) \
  const auto rows = reference_rows(name); \
  if (rows.empty()) GTEST_SKIP() << "needs ../shared/reference/" << (name)
