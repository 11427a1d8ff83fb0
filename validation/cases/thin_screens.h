#pragma once
// Levels behind thin, perfectly conducting screens.

namespace grimaldi {

enum class Screen { strip, slit };

/// A line source at (−40, zs) before a strip |z| < width/2, or a slit of that width, in the plane x = 0; a receiver at
/// (x, z) behind it; lengths in wavelengths. Levels over the free field, dB: soft (E along the edges), hard (E across
/// them, sound at a rigid screen).
/// Source: `BoundaryElements`, screens of thickness 0.02 and 0.01 wavelengths, fields extrapolated to none.
/// Error: 0.01 dB down to −20 dB (held by BoundaryElements.ThinScreens).
struct ThinScreenRow {
  Screen screen;
  double width, zs, x, z, soft, hard;
};
inline constexpr ThinScreenRow thin_screens[] = {
    {Screen::strip, 3, 0, 20, -5.5, 0.933, 1.082},       {Screen::strip, 3, 0, 20, -2.75, -7.646, -7.900},
    {Screen::strip, 3, 0, 20, -1, -6.679, -5.586},       {Screen::strip, 3, 0, 20, 0.5, -5.793, -4.661},
    {Screen::strip, 3, 0, 20, 1.75, -8.739, -8.011},     {Screen::strip, 3, 0, 20, 3.5, -3.916, -3.855},
    {Screen::strip, 3, 0, 20, 5, 0.455, 0.732},          {Screen::strip, 3, 0, 20, 7.5, 0.992, 0.462},
    {Screen::strip, 3, 0, 80, -12.1, -0.683, -0.758},    {Screen::strip, 3, 0, 80, -6.05, -6.192, -5.913},
    {Screen::strip, 3, 0, 80, -2.2, -4.278, -3.626},     {Screen::strip, 3, 0, 80, 1.1, -3.969, -3.306},
    {Screen::strip, 3, 0, 80, 3.85, -5.072, -4.483},     {Screen::strip, 3, 0, 80, 7.7, -5.930, -6.043},
    {Screen::strip, 3, 0, 80, 11, -2.015, -2.175},       {Screen::strip, 3, 0, 80, 16.5, 2.042, 2.072},
    {Screen::strip, 3, 9, 20, -5.5, -6.265, -5.053},     {Screen::strip, 3, 9, 20, -2.75, -8.429, -7.713},
    {Screen::strip, 3, 9, 20, -1, -4.055, -4.154},       {Screen::strip, 3, 9, 20, 0.5, 0.431, 0.705},
    {Screen::strip, 3, 9, 20, 1.75, 0.973, 0.519},       {Screen::strip, 3, 9, 20, 3.5, 1.082, 1.164},
    {Screen::strip, 3, 9, 20, 5, -1.652, -1.538},        {Screen::strip, 3, 9, 20, 7.5, 0.219, -0.185},
    {Screen::strip, 3, 9, 80, -12.1, -5.903, -5.656},    {Screen::strip, 3, 9, 80, -6.05, -0.995, -1.180},
    {Screen::strip, 3, 9, 80, -2.2, 1.918, 1.977},       {Screen::strip, 3, 9, 80, 1.1, 1.423, 1.239},
    {Screen::strip, 3, 9, 80, 3.85, -0.415, -0.737},     {Screen::strip, 3, 9, 80, 7.7, -0.521, 0.027},
    {Screen::strip, 3, 9, 80, 11, 0.187, -0.318},        {Screen::strip, 3, 9, 80, 16.5, -0.831, -0.508},
    {Screen::strip, 10, 0, 20, -13.2, 1.384, 1.408},     {Screen::strip, 10, 0, 20, -6.6, -7.833, -6.539},
    {Screen::strip, 10, 0, 20, -2.4, -14.817, -12.021},  {Screen::strip, 10, 0, 20, 1.2, -24.037, -21.796},
    {Screen::strip, 10, 0, 20, 4.2, -11.711, -9.394},    {Screen::strip, 10, 0, 20, 8.4, -3.727, -2.973},
    {Screen::strip, 10, 0, 20, 12, 1.236, 0.650},        {Screen::strip, 10, 0, 20, 18, 0.614, 0.369},
    {Screen::strip, 10, 0, 80, -19.8, -2.952, -3.132},   {Screen::strip, 10, 0, 80, -9.9, -10.560, -9.689},
    {Screen::strip, 10, 0, 80, -3.6, -22.622, -22.219},  {Screen::strip, 10, 0, 80, 1.8, -13.381, -11.791},
    {Screen::strip, 10, 0, 80, 6.3, -11.077, -9.792},    {Screen::strip, 10, 0, 80, 12.6, -9.158, -8.967},
    {Screen::strip, 10, 0, 80, 18, -4.324, -4.301},      {Screen::strip, 10, 0, 80, 27, 1.023, 0.657},
    {Screen::strip, 10, 9, 20, -13.2, -4.238, -4.508},   {Screen::strip, 10, 9, 20, -6.6, -13.896, -11.132},
    {Screen::strip, 10, 9, 20, -2.4, -13.703, -10.795},  {Screen::strip, 10, 9, 20, 1.2, -9.783, -8.234},
    {Screen::strip, 10, 9, 20, 4.2, -3.784, -3.778},     {Screen::strip, 10, 9, 20, 8.4, 1.072, 0.515},
    {Screen::strip, 10, 9, 20, 12, 0.836, 0.414},        {Screen::strip, 10, 9, 20, 18, 0.636, 0.172},
    {Screen::strip, 10, 9, 80, -19.8, -12.932, -11.314}, {Screen::strip, 10, 9, 80, -9.9, -9.003, -7.691},
    {Screen::strip, 10, 9, 80, -3.6, -5.956, -5.265},    {Screen::strip, 10, 9, 80, 1.8, -2.872, -2.999},
    {Screen::strip, 10, 9, 80, 6.3, 0.319, 0.135},       {Screen::strip, 10, 9, 80, 12.6, 0.917, 0.585},
    {Screen::strip, 10, 9, 80, 18, -1.489, -1.401},      {Screen::strip, 10, 9, 80, 27, -0.937, -0.774},
    {Screen::slit, 3, 0, 20, -5.5, -14.023, -12.742},    {Screen::slit, 3, 0, 20, -2.75, -4.345, -4.433},
    {Screen::slit, 3, 0, 20, -1, -2.121, -2.297},        {Screen::slit, 3, 0, 20, 0.5, -1.877, -2.060},
    {Screen::slit, 3, 0, 20, 1.75, -2.804, -2.957},      {Screen::slit, 3, 0, 20, 3.5, -6.043, -6.028},
    {Screen::slit, 3, 0, 20, 5, -11.363, -10.703},       {Screen::slit, 3, 0, 20, 7.5, -24.661, -18.406},
    {Screen::slit, 3, 0, 80, -12.1, -7.879, -7.902},     {Screen::slit, 3, 0, 80, -6.05, -5.531, -5.570},
    {Screen::slit, 3, 0, 80, -2.2, -4.884, -4.922},      {Screen::slit, 3, 0, 80, 1.1, -4.811, -4.849},
    {Screen::slit, 3, 0, 80, 3.85, -5.086, -5.125},      {Screen::slit, 3, 0, 80, 7.7, -6.002, -6.039},
    {Screen::slit, 3, 0, 80, 11, -7.319, -7.348},        {Screen::slit, 3, 0, 80, 16.5, -10.850, -10.804},
    {Screen::slit, 3, 9, 20, -5.5, -2.305, -2.616},      {Screen::slit, 3, 9, 20, -2.75, -2.629, -3.057},
    {Screen::slit, 3, 9, 20, -1, -5.768, -5.955},        {Screen::slit, 3, 9, 20, 0.5, -11.730, -10.814},
    {Screen::slit, 3, 9, 20, 1.75, -23.417, -16.516},    {Screen::slit, 3, 9, 20, 3.5, -17.014, -16.358},
    {Screen::slit, 3, 9, 20, 5, -14.298, -14.754},       {Screen::slit, 3, 9, 20, 7.5, -18.484, -17.924},
    {Screen::slit, 3, 9, 80, -12.1, -5.403, -5.691},     {Screen::slit, 3, 9, 80, -6.05, -7.554, -7.798},
    {Screen::slit, 3, 9, 80, -2.2, -10.126, -10.219},    {Screen::slit, 3, 9, 80, 1.1, -13.505, -13.244},
    {Screen::slit, 3, 9, 80, 3.85, -17.811, -16.723},    {Screen::slit, 3, 9, 80, 7.7, -32.009, -23.045},
    {Screen::slit, 3, 9, 80, 11, -26.697, -23.618},      {Screen::slit, 3, 9, 80, 16.5, -18.624, -19.047},
    {Screen::slit, 10, 0, 20, -13.2, -14.206, -14.035},  {Screen::slit, 10, 0, 20, -6.6, -4.356, -4.009},
    {Screen::slit, 10, 0, 20, -2.4, 1.706, 1.305},       {Screen::slit, 10, 0, 20, 1.2, 0.494, 0.336},
    {Screen::slit, 10, 0, 20, 4.2, 0.839, 0.499},        {Screen::slit, 10, 0, 20, 8.4, -9.573, -8.120},
    {Screen::slit, 10, 0, 20, 12, -18.832, -14.734},     {Screen::slit, 10, 0, 20, 18, -18.450, -18.022},
    {Screen::slit, 10, 0, 80, -19.8, -7.990, -8.025},    {Screen::slit, 10, 0, 80, -9.9, -1.101, -1.308},
    {Screen::slit, 10, 0, 80, -3.6, 0.592, 0.536},       {Screen::slit, 10, 0, 80, 1.8, 1.883, 1.608},
    {Screen::slit, 10, 0, 80, 6.3, -0.843, -0.740},      {Screen::slit, 10, 0, 80, 12.6, -3.807, -3.698},
    {Screen::slit, 10, 0, 80, 18, -8.113, -7.806},       {Screen::slit, 10, 0, 80, 27, -14.876, -13.799},
    {Screen::slit, 10, 9, 20, -13.2, -7.709, -7.600},    {Screen::slit, 10, 9, 20, -6.6, 2.126, 1.597},
    {Screen::slit, 10, 9, 20, -2.4, 2.066, 1.540},       {Screen::slit, 10, 9, 20, 1.2, -3.254, -2.644},
    {Screen::slit, 10, 9, 20, 4.2, -8.859, -8.200},      {Screen::slit, 10, 9, 20, 8.4, -22.821, -16.341},
    {Screen::slit, 10, 9, 20, 12, -21.013, -18.534},     {Screen::slit, 10, 9, 20, 18, -25.732, -22.204},
    {Screen::slit, 10, 9, 80, -19.8, 2.069, 1.760},      {Screen::slit, 10, 9, 80, -9.9, -1.210, -1.242},
    {Screen::slit, 10, 9, 80, -3.6, -6.787, -6.030},     {Screen::slit, 10, 9, 80, 1.8, -8.108, -8.063},
    {Screen::slit, 10, 9, 80, 6.3, -17.289, -14.210},    {Screen::slit, 10, 9, 80, 12.6, -16.489, -15.274},
    {Screen::slit, 10, 9, 80, 18, -16.503, -16.086},     {Screen::slit, 10, 9, 80, 27, -19.129, -18.555},
};

}  // namespace grimaldi
