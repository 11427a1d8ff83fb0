#pragma once
// Patterns behind an opening under several theories, as figures.

#include <complex>
#include <string>
#include <vector>

#include "validation/cases/figure.h"
#include "validation/cases/opening.h"

namespace grimaldi {

/// What may stand side by side; `truth` is the Rayleigh-Sommerfeld integral.
enum class Theory { truth, fraunhofer, polygon, printed, edges, cones };

std::complex<double> field_of(Theory theory, const Opening& opening, const Vec3& point);

/// Level in dB of |field|, at least −300.
double level_of(const std::complex<double>& field);

/// Median error of a theory at that Fresnel number, as pattern_error has it, over 1024 points. dB.
double median_error(Theory theory, const Opening& opening, double fresnel_number);

/// What a figure is called and what it says.
struct PatternWords {
  std::string file, title, caption;
};

/// Patterns on the plane at N, over the peak of the first theory; `reach` times (D/2 + λz/D) to every side.
Figure pattern_figure(const Opening& opening, double fresnel_number, double reach, const std::vector<Theory>& theories,
                      const PatternWords& words);
/// The same along x at y = 0.
Figure cut_figure(const Opening& opening, double fresnel_number, double reach, const std::vector<Theory>& theories,
                  const PatternWords& words);

}  // namespace grimaldi
