#include "propagation/laws/reflection.h"

#include <cmath>

#include "core/contract.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// √(η − sin²θ) on the sheet of decaying waves (negative imaginary part).
Complex refracted_cosine(Complex permittivity, double cos_incidence) {
  // η − sin²θ in the form that keeps the digits of a small cosine.
  const double x = (permittivity.real() - 1) + cos_incidence * cos_incidence, y = permittivity.imag();
  const double square = x * x + y * y;
  if (square < 1e-150 || square > 1e150) {  // the ends of the numbers' range
    const Complex root = std::sqrt(Complex(x, y));
    return root.imag() > 0 ? -root : root;
  }
  // The part that adds up first; the other from their product y/2.
  const double larger = std::sqrt(0.5 * (std::sqrt(square) + std::abs(x))), smaller = 0.5 * y / larger;
  if (x >= 0) return y > 0 ? Complex(-larger, -smaller) : Complex(larger, smaller);
  return {-smaller, -larger};
}

/// a/b by conj(b), but for denominators whose square leaves the range of numbers (films thinner than 1e-75 λ).
Complex quotient(Complex a, Complex b) {
  const double square = std::norm(b);
  return square > 1e-150 && square < 1e150 ? a * std::conj(b) / square : a / b;
}

ReflectionCoefficients interface_reflection(Complex permittivity, double cos_incidence, Complex root) {
  if (permittivity == 1.0) return {0.0, 0.0};  // no interface, at grazing incidence too
  return {(cos_incidence - root) / (cos_incidence + root),
          (permittivity * cos_incidence - root) / (permittivity * cos_incidence + root)};
}

/// The wave inside a slab.
struct SlabPasses {
  Complex root;       ///< √(η − sin²θ)
  Complex exponent;   ///< −j2q: there and back
  Complex one_minus;  ///< 1 − e^{−j2q}
};

SlabPasses passes(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  const Complex root = refracted_cosine(permittivity, cos_incidence);
  // e^{−j2q} = e^{a}(cos b + j sin b) with a ≤ 0; 1 − e^{−j2q} = −expm1(a) + e^a(2 sin²(b/2) − j sin b).
  const Complex exponent = Complex(0, -2) * (wavenumber * thickness * root);
  const double gone = std::expm1(exponent.real()), half = exponent.imag() / 2;
  const double sine = std::sin(half), cosine = std::cos(half);
  return {root, exponent, Complex(-gone + 2 * (1 + gone) * sine * sine, -2 * (1 + gone) * sine * cosine)};
}

/// R and what goes through for one polarisation, x = cos θ or η cos θ: R' = (x − q)/(x + q) in
/// R'(1 − e^{−j2q})/(1 − R'² e^{−j2q}), the denominator written (1 − R'²) + R'²(1 − e^{−j2q}), all times (x + q)².
struct SlabWave {
  Complex apart, sum, cross, below;

  SlabWave(Complex x, const SlabPasses& slab)
      : apart(x - slab.root),
        sum(x + slab.root),
        cross(4.0 * x * slab.root),
        below(cross + apart * apart * slab.one_minus) {}
  Complex reflected(const SlabPasses& slab) const { return quotient(apart * sum * slab.one_minus, below); }
  Complex transmitted(Complex once) const { return quotient(cross * once, below); }
};

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
  if (permittivity == 1.0 || slab.one_minus == 0.0) return {0.0, 0.0};  // no slab, or no thickness
  return {SlabWave(cos_incidence, slab).reflected(slab), SlabWave(permittivity * cos_incidence, slab).reflected(slab)};
}

SlabCoefficients slab_coefficients(Complex permittivity, double thickness, double wavenumber, double cos_incidence) {
  GRIMALDI_EXPECT(thickness >= 0 && wavenumber > 0);
  if (std::isinf(thickness)) return {half_space_reflection(permittivity, cos_incidence), {0.0, 0.0}};
  const SlabPasses slab = passes(permittivity, thickness, wavenumber, cos_incidence);
  const Complex once = std::exp(0.5 * slab.exponent);
  if (permittivity == 1.0 || slab.one_minus == 0.0) return {{0.0, 0.0}, {once, once}};
  const SlabWave te(cos_incidence, slab), tm(permittivity * cos_incidence, slab);
  return {{te.reflected(slab), tm.reflected(slab)}, {te.transmitted(once), tm.transmitted(once)}};
}

double wall_reflection(double absorption) {
  GRIMALDI_EXPECT(absorption >= 0 && absorption <= 1);
  return std::sqrt(1 - absorption);
}

}  // namespace grimaldi
