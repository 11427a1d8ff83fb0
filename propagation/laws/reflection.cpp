#include "propagation/laws/reflection.h"

#include <cmath>

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
  ReflectionCoefficients face;  ///< R' of its faces
  Complex exponent;             ///< −j2q: there and back
  Complex one_minus;            ///< 1 − e^{−j2q}

  /// 1 − R'² e^{−j2q}
  Complex summed(Complex r) const { return (1.0 - r) * (1.0 + r) + r * r * one_minus; }
  Complex reflected(Complex r) const { return r * one_minus / summed(r); }
};

SlabPasses passes(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  const Complex root = refracted_cosine(permittivity, cos_incidence);
  // e^{−j2q} = e^{a}(cos b + j sin b) with a ≤ 0; 1 − e^{−j2q} = −expm1(a) + e^a(2 sin²(b/2) − j sin b).
  const Complex exponent = Complex(0, -2) * (wavenumber * thickness * root);
  const double decay = std::exp(exponent.real());
  const double half_sine = std::sin(exponent.imag() / 2);
  const Complex one_minus(-std::expm1(exponent.real()) + 2 * decay * half_sine * half_sine,
                          -decay * std::sin(exponent.imag()));
  return {interface_reflection(permittivity, cos_incidence, root), exponent, one_minus};
}

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
  return {slab.reflected(slab.face.te), slab.reflected(slab.face.tm)};
}

SlabCoefficients slab_coefficients(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  GRIMALDI_EXPECT(thickness >= 0 && wavenumber > 0);
  if (std::isinf(thickness)) return {half_space_reflection(permittivity, cos_incidence), {0.0, 0.0}};
  const SlabPasses slab = passes(permittivity, thickness, wavenumber, cos_incidence);
  if (slab.one_minus == 0.0) return {{0.0, 0.0}, {1.0, 1.0}};
  const Complex through = std::exp(0.5 * slab.exponent);
  const auto transmitted = [&](Complex r) { return (1.0 - r) * (1.0 + r) * through / slab.summed(r); };
  return {{slab.reflected(slab.face.te), slab.reflected(slab.face.tm)},
          {transmitted(slab.face.te), transmitted(slab.face.tm)}};
}

double wall_reflection(double absorption) {
  GRIMALDI_EXPECT(absorption >= 0 && absorption <= 1);
  return std::sqrt(1 - absorption);
}

}  // namespace grimaldi
