#include "propagation/laws/reflection.h"

#include <cmath>
#include <utility>

#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// √(η − sin²θ) on the sheet of decaying waves (negative imaginary part).
Complex refracted_cosine(Complex permittivity, double cos_incidence) {
  // η − sin²θ in the form that keeps the digits of a small cosine.
  const Complex root = std::sqrt((permittivity - 1.0) + cos_incidence * cos_incidence);
  return root.imag() > 0 ? -root : root;
}

ReflectionCoefficients interface_reflection(Complex permittivity, double cos_incidence, Complex root) {
  if (permittivity == 1.0) return {0.0, 0.0};  // no interface, at grazing incidence too
  return {(cos_incidence - root) / (cos_incidence + root),
          (permittivity * cos_incidence - root) / (permittivity * cos_incidence + root)};
}

/// The wave inside a slab.
struct SlabPasses {
  ReflectionCoefficients face;     ///< R' of its faces
  ReflectionCoefficients through;  ///< 1 − R'², which keeps its digits where R' → ±1
  Complex exponent;                ///< −j2q: there and back
  Complex one_minus;               ///< 1 − e^{−j2q}
};

SlabPasses passes(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  const Complex root = refracted_cosine(permittivity, cos_incidence);
  // e^{−j2q} = e^{a}(cos b + j sin b) with a ≤ 0; 1 − e^{−j2q} = −expm1(a) + e^a(2 sin²(b/2) − j sin b).
  const Complex exponent = Complex(0, -2) * (wavenumber * thickness * root);
  const double decay = std::exp(exponent.real());
  const double half_sine = std::sin(exponent.imag() / 2);
  const Complex one_minus(-std::expm1(exponent.real()) + 2 * decay * half_sine * half_sine,
                          -decay * std::sin(exponent.imag()));
  // 1 − ((x − q)/(x + q))² = 4xq/(x + q)², x = cos θ or η cos θ.
  const auto through = [&](Complex x) {
    const Complex sum = x + root;
    return permittivity == 1.0 ? Complex(1) : 4.0 * (x / sum) * (root / sum);
  };
  return {interface_reflection(permittivity, cos_incidence, root),
          {through(cos_incidence), through(permittivity * cos_incidence)},
          exponent,
          one_minus};
}

/// R = R'(1 − e^{−j2q})/(1 − R'² e^{−j2q}), the denominator written (1 − R'²) + R'²(1 − e^{−j2q}).
Complex summed(Complex r, Complex through, Complex one_minus) { return through + r * r * one_minus; }

}  // namespace

ReflectionCoefficients half_space_reflection(Complex permittivity, double cos_incidence) {
  GRIMALDI_EXPECT(cos_incidence >= 0 && cos_incidence <= 1);
  return interface_reflection(permittivity, cos_incidence, refracted_cosine(permittivity, cos_incidence));
}

ReflectionCoefficients half_space_transmission(Complex permittivity, double cos_incidence) {
  GRIMALDI_EXPECT(cos_incidence >= 0 && cos_incidence <= 1);
  if (permittivity == 1.0) return {1.0, 1.0};
  const Complex root = refracted_cosine(permittivity, cos_incidence);
  // √η on the sheet of root, so that both agree at normal incidence.
  return {2 * cos_incidence / (cos_incidence + root),
          2.0 * refracted_cosine(permittivity, 1) * cos_incidence / (permittivity * cos_incidence + root)};
}

ReflectionCoefficients slab_reflection(Complex permittivity, double thickness, double wavenumber,
                                       double cos_incidence) {
  GRIMALDI_EXPECT(thickness >= 0 && wavenumber > 0);
  if (std::isinf(thickness)) return half_space_reflection(permittivity, cos_incidence);
  const SlabPasses slab = passes(permittivity, thickness, wavenumber, cos_incidence);
  if (slab.one_minus == 0.0) return {0.0, 0.0};  // no thickness
  const auto reflected = [&](Complex r, Complex through) {
    return r * slab.one_minus / summed(r, through, slab.one_minus);
  };
  return {reflected(slab.face.te, slab.through.te), reflected(slab.face.tm, slab.through.tm)};
}

SlabCoefficients slab_coefficients(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  GRIMALDI_EXPECT(thickness >= 0 && wavenumber > 0);
  if (std::isinf(thickness)) return {half_space_reflection(permittivity, cos_incidence), {0.0, 0.0}};
  const SlabPasses slab = passes(permittivity, thickness, wavenumber, cos_incidence);
  const Complex once = std::exp(0.5 * slab.exponent);
  if (slab.one_minus == 0.0) return {{0.0, 0.0}, {once, once}};
  const auto both = [&](Complex r, Complex through) {
    const Complex sum = summed(r, through, slab.one_minus);
    return std::pair{r * slab.one_minus / sum, through * once / sum};
  };
  const auto te = both(slab.face.te, slab.through.te), tm = both(slab.face.tm, slab.through.tm);
  return {{te.first, tm.first}, {te.second, tm.second}};
}

double wall_reflection(double absorption) {
  GRIMALDI_EXPECT(absorption >= 0 && absorption <= 1);
  return std::sqrt(1 - absorption);
}

}  // namespace grimaldi
