#pragma once
// Physical constants, each once, with its source.

#include <numbers>

namespace grimaldi {

inline constexpr double pi = std::numbers::pi;
/// Speed of light in vacuum, m/s. Exact (SI, 1983).
inline constexpr double speed_of_light = 299792458.0;
/// Permittivity of vacuum, F/m. CODATA 2018.
inline constexpr double vacuum_permittivity = 8.8541878128e-12;

}  // namespace grimaldi
