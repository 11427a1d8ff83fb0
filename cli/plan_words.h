#pragma once
// A plan in words and in decibels: what the titles of the pictures say, and what their scales show.

#include <string>
#include <vector>

#include "propagation/plan.h"
#include "scenes/scene.h"

namespace grimaldi {

/// What separates the parts of a title.
inline constexpr const char* title_separator = " · ";

/// The file's name without its folder, or the name of the built-in scene.
std::string scene_words(const Scene& scene);

/// The first band, e.g. "3.5 GHz", "500 Hz (first of 7 bands)".
std::string band_words(const Plan& plan);

/// "transmitter mast (44 dBm)", "sum of 3 transmitters: a, b, c"; "source" for sound; at most five names.
std::string transmitter_words(const Plan& plan);

/// Parts such as "direct, reflection, diffraction (FSD)", "depth 3", "1 000 000 rays".
std::vector<std::string> method_words(const Plan& plan);

/// "3.5 GHz"; of sound the nominal frequency, "1 kHz".
std::string frequency_words(const Plan& plan, std::size_t band);

/// What a picture shows of a gain: the path gain itself (radio), or the sound pressure level (sound)
/// L_p = L_W + 10 lg(gain · 1 m²) + 10 lg(ρc / 400 Pa·s/m), L_W the source's sound power level in the band.
/// Sound of a source that has no power is shown as path gain.
struct ShownQuantity {
  std::string name;            ///< "path gain", "sound pressure level"
  std::string unit;            ///< "dB", "dB re 1 m⁻²", "dB re 20 µPa"
  std::vector<double> weight;  ///< per transmitter: the shown value is 10 lg Σ weight·gain
  double decibels(std::size_t transmitter, double gain) const;  ///< requires gain > 0
};
ShownQuantity shown_quantity(const Plan& plan, std::size_t band = 0);

}  // namespace grimaldi
