#pragma once
// The carriers or bands of a run. Geometry is traced once; every law is evaluated per band.

#include <string>
#include <vector>

namespace grimaldi {

enum class WaveKind { radio, acoustic };

/// Exact mid-band frequencies of octaves, f = 1000·10^(3n/10) Hz (IEC 61260-1:2014, base 10), whose nominal frequency
/// (31.5, 63, 125, 250, 500, 1000 … 16000) lies in [from, to] with 5 % slack. from, to in Hz, 0 < from ≤ to.
/// Returns Hz, ascending; empty if no band lies in the range.
std::vector<double> octave_bands(double from, double to);

/// The same for third-octaves, f = 1000·10^(n/10) Hz; nominal 25, 31.5, 40, 50, 63, 80, 100 … 20000.
std::vector<double> third_octave_bands(double from, double to);

/// The nominal frequency (preferred number) of the octave or third-octave band whose exact mid-band frequency is
/// nearest to `frequency` Hz, if it is within 1 %; else `frequency` itself.
double nominal_frequency(double frequency);

}  // namespace grimaldi
