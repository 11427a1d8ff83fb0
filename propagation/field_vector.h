#pragma once
// The electric field of a ray as a complex vector, and what a mirror does to it.

#include <complex>

#include "core/vector.h"
#include "propagation/laws/reflection.h"

namespace grimaldi {

/// Complex amplitudes along x, y, z. Sound has its pressure in x.
struct ComplexVec3 {
  std::complex<double> x, y, z;
};

/// a u + b v.
inline ComplexVec3 combine(std::complex<double> a, const Vec3& u, std::complex<double> b, const Vec3& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

inline std::complex<double> dot(const ComplexVec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The field behind a mirror, of a ray of direction k (unit) that leaves along k − 2 (k·n) n.
/// Formula: TE across the plane of incidence, TM in it, each times its coefficient.
/// Inputs: field at right angles to k; unit normal; coefficients. Returns: of the same unit, at right angles to the new
/// direction. Valid: any incidence; at normal incidence, where both coefficients are one, any plane serves.
inline ComplexVec3 reflect(const ComplexVec3& field, const Vec3& k, const Vec3& normal,
                           const ReflectionCoefficients& r) {
  const Vec3 k_out = k - 2 * dot(k, normal) * normal;
  Vec3 s = cross(k, normal);
  const double sine = norm(s);
  s = sine > 1e-9 ? s / sine : perpendicular(normal);
  const std::complex<double> te = r.te * dot(field, s), tm = r.tm * dot(field, cross(s, k));
  return combine(te, s, tm, cross(s, k_out));
}

}  // namespace grimaldi
