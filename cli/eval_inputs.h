#pragma once
// Inputs and results that several functions of `grimaldi eval` share.

#include <complex>
#include <initializer_list>
#include <vector>

#include "cli/eval_function.h"
#include "core/constants.h"

namespace grimaldi {

/// Radians of one degree.
inline constexpr double degree = pi / 180;

EvalInput any_number(const char* name, const char* meaning);
/// Above 0.
EvalInput positive(const char* name, const char* meaning, double high = std::numeric_limits<double>::infinity());
EvalInput within(const char* name, const char* meaning, double low, double high);
EvalInput word(const char* name, const char* meaning);
/// `n` of a wedge, above `low`, at most 2.
EvalInput exterior_angle(double low = 0);

/// Columns `first` and `first` + 1 as φ and φ', which must lie in 0 … `exterior`; faults where they do not. An angle
/// that is beyond the last face by its rounding is put on it. `unit` for messages, e.g. "degrees".
struct WedgeAngles {
  double phi = 0, phip = 0;
  bool good = true;
};
WedgeAngles wedge_angles(const EvalRow& row, double exterior, std::size_t phi_input, std::size_t phip_input,
                         const char* unit);

/// Real and imaginary parts one after the other.
std::vector<double> flat(std::initializer_list<std::complex<double>> list);

}  // namespace grimaldi
