// Faces, slabs, gases, rain and air against closed forms and printed values.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/constants.h"
#include "core/material.h"
#include "core/medium.h"
#include "core/p2040.h"
#include "core/radio_attenuation.h"
#include "propagation/laws/reflection.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Long = std::complex<long double>;

Outcome normal_incidence() {
  Outcome outcome;
  for (const Complex permittivity : {Complex(1.5, 0), Complex(5.24, -0.3), Complex(80, -20), Complex(1, -1e7)}) {
    const Complex root = std::sqrt(permittivity);
    const ReflectionCoefficients r = half_space_reflection(permittivity, 1);
    outcome.error = std::max(
        {outcome.error, std::abs(r.te - (1.0 - root) / (1.0 + root)), std::abs(r.tm - (root - 1.0) / (root + 1.0))});
  }
  return outcome;
}

Outcome brewster() {
  Outcome outcome;
  for (const double permittivity : {1.1, 2.25, 5.24, 80.0})
    outcome.error =
        std::max(outcome.error, std::abs(half_space_reflection(permittivity, 1 / std::sqrt(1 + permittivity)).tm));
  return outcome;
}

/// One slab by matching tangential fields at both faces, in long double: a transfer matrix.
Outcome slab_by_matrix() {
  Outcome outcome;
  const long double k = 2 * std::numbers::pi_v<long double> / 0.1L;
  for (const Complex permittivity : {Complex(2.5, 0), Complex(5.24, -0.3), Complex(30, -10)})
    for (const double thickness : {0.001, 0.02, 0.11})
      for (double angle = 0; angle < 1.55; angle += 0.1) {
        const Long eta(permittivity.real(), permittivity.imag());
        const long double cosine = std::cos((long double)angle), sine2 = 1 - cosine * cosine;
        const Long inside = std::sqrt(eta - sine2), q = k * (long double)thickness * inside;
        const Long c = std::cos(q), s = std::sin(q), unit(0, 1);
        const SlabCoefficients ours =
            slab_coefficients(permittivity, thickness, double(k), double(std::cos((long double)angle)));
        const auto compare = [&](const Long& outer, const Long& inner, double sign, Complex r, Complex t) {
          const Long b = c + unit * s * (outer / inner), d = unit * s * inner + c * outer;  // at the entry
          const Long reflection = (outer * b - d) / (outer * b + d), transmission = 2.0L * outer / (outer * b + d);
          const Complex exact_r(double(reflection.real()), double(reflection.imag()));
          const Complex exact_t(double(transmission.real()), double(transmission.imag()));
          outcome.error = std::max({outcome.error, std::abs(r - sign * exact_r), std::abs(t - exact_t)});
        };
        compare(Long(cosine), inside, 1, ours.reflection.te, ours.transmission.te);
        compare(1.0L / Long(cosine), eta / inside, -1, ours.reflection.tm, ours.transmission.tm);
      }
  return outcome;
}

Outcome permittivities() {
  // Recommendation ITU-R P.2040-3, Table 3, and equation (29): ε'' = 17.98 σ/f, f in GHz (17.98 printed to four
  // digits).
  const struct {
    const char* name;
    double a, b, c, d;
  } rows[] = {{"concrete", 5.24, 0, 0.0462, 0.7822},
              {"brick", 3.91, 0, 0.0238, 0.16},
              {"glass", 6.31, 0, 0.0036, 1.3394},
              {"wood", 1.99, 0, 0.0047, 1.0718}};
  Outcome outcome;
  for (const auto& row : rows)
    for (const double f : {1.0, 3.5, 28.0}) {
      Diagnostics diagnostics;
      const Complex ours = relative_permittivity(p2040_materials(3).at(row.name), f * 1e9, diagnostics);
      const Complex printed(row.a * std::pow(f, row.b), -17.98 * row.c * std::pow(f, row.d) / f);
      outcome.error = std::max(outcome.error, std::abs(ours - printed) / std::abs(printed));
    }
  return outcome;
}

/// Recommendation ITU-R P.838-3, Table 5: k and α of horizontal and vertical polarisation.
Outcome rain() {
  const struct {
    double f, k_h, alpha_h, k_v, alpha_v;
  } rows[] = {{10, 0.01217, 1.2571, 0.01129, 1.2156},
              {20, 0.09164, 1.0568, 0.09611, 0.9847},
              {40, 0.4431, 0.8673, 0.4274, 0.8421}};
  Outcome outcome;
  for (const auto& row : rows) {
    const RainLaw h = rain_law(row.f, 0, 0), v = rain_law(row.f, 0, pi / 2);
    outcome.error = std::max({outcome.error, std::abs(h.k / row.k_h - 1), std::abs(h.alpha / row.alpha_h - 1),
                              std::abs(v.k / row.k_v - 1), std::abs(v.alpha / row.alpha_v - 1)});
  }
  return outcome;
}

/// Recommendation ITU-R P.676-12, the validation examples of Study Group 3 (CG-3M3J-13-ValEx), dB/km at 1013.25 hPa of
/// dry air, 288.15 K, 7.5 g/m³: dry air and vapour. P.676-13 has the same lines.
Outcome gases() {
  const struct {
    double f, dry, vapour;
  } rows[] = {{8, 0.007843794, 0.003572123},   {24, 0.014636083, 0.158525061},  {60, 14.6234748, 0.154841841},
              {116, 0.402453686, 0.582526138}, {144, 0.016471368, 0.977295188}, {184, 0.012775319, 27.02483793}};
  Outcome outcome;
  for (const auto& row : rows) {
    const GasAttenuation ours = gas_attenuation(row.f, {1013.25, 288.15, 7.5});
    const double error = std::max(std::abs(ours.dry / row.dry - 1), std::abs(ours.vapour / row.vapour - 1));
    if (!(error <= outcome.error)) outcome.error = error, outcome.note = fmt::format("largest at {:g} GHz", row.f);
  }
  return outcome;
}

/// ISO 9613-1:1993, Table 1, dB/km at 101.325 kPa, three digits.
Outcome air() {
  const struct {
    double celsius, percent, nominal, value;
  } rows[] = {{-20, 10, 50, 0.589}, {-20, 50, 1000, 9.14}, {-20, 100, 10000, 47.0}, {0, 50, 1000, 6.83},
              {0, 20, 2000, 34.6},  {5, 50, 1000, 5.08},   {10, 50, 4000, 46.7},    {15, 50, 1000, 4.16},
              {20, 50, 1000, 4.66}, {25, 50, 1000, 5.68},  {25, 100, 2000, 11.4},   {30, 50, 4000, 24.5},
              {40, 50, 1000, 9.52}, {45, 50, 800, 7.16},   {10, 10, 1000, 21.6},    {20, 80, 5000, 30.6}};
  Outcome outcome;
  for (const auto& row : rows) {
    // Exact mid-band frequency: 1000·10^(m/10).
    const double exact = 1000 * std::pow(10, std::round(10 * std::log10(row.nominal / 1000)) / 10);
    const double ours = 1000 * sound_attenuation({row.celsius + 273.15, row.percent / 100, 101325}, exact);
    const double error = std::abs(ours / row.value - 1);
    if (!(error <= outcome.error))
      outcome.error = error,
      outcome.note = fmt::format("largest at {:g} degC, {:g} %, {:g} Hz: {:.4g} against {:g} dB/km", row.celsius,
                                 row.percent, row.nominal, ours, row.value);
  }
  return outcome;
}

Outcome sound_walls() {
  Outcome outcome;
  for (double absorption = 0; absorption <= 1; absorption += 0.125)
    outcome.error = std::max(outcome.error, std::abs(std::pow(wall_reflection(absorption), 2) + absorption - 1));
  return outcome;
}

}  // namespace

Cases material_cases() {
  return {
      {"materials/half-space/normal", "reflection at normal incidence, largest |error|", "closed form", "1", 1e-15,
       "a few ulp", 0, normal_incidence},
      {"materials/half-space/brewster", "parallel polarisation at Brewster's angle, largest |R|", "0", "1", 1e-15,
       "rounding of the angle", 0, brewster},
      {"materials/slab/matrix", "reflection and transmission of a slab, largest |error| of 576",
       "transfer matrix in long double", "1", 1e-12, "1e-13 of the kernel; phases of up to 50 rad", 0, slab_by_matrix},
      {"materials/p2040", "complex permittivities of P.2040-3, largest relative error",
       "Table 3 with the printed 17.98", "1", 3e-4, "17.98 is printed to four digits", 0, permittivities},
      {"materials/rain", "k and alpha of P.838-3, largest relative error", "Table 5", "1", 5e-4, "four printed digits",
       0, rain},
      {"materials/gases", "dry air and vapour by P.676-13, largest relative error", "validation examples of P.676-12",
       "1", 1e-6, "nine printed digits; the lines of both versions are the same", 0, gases},
      {"materials/air", "sound absorption at exact mid-band frequencies, largest relative error of 16",
       "ISO 9613-1:1993, Table 1", "1", 0.005, "half a unit of the third printed digit", 0, air},
      {"materials/sound-walls", "power reflected and absorbed, largest difference from 1", "1", "1", 1e-15, "rounding",
       0, sound_walls},
  };
}

}  // namespace grimaldi
