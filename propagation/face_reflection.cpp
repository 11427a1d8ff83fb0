#include "propagation/face_reflection.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace grimaldi {

ReflectionCoefficients face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                       double cos_incidence) {
  const FaceMaterial& face = plan.materials[material];
  if (plan.request.kind == WaveKind::radio) return face.slab[band](cos_incidence);
  const double factor = wall_reflection(face.absorption[band]);
  return {factor, factor};
}

MetCosines met_cosines(const Plan& plan, std::uint32_t material, std::size_t band, double cos_incidence, double way) {
  const double c = std::min(cos_incidence, 1.0), width = std::min(1.0, 1 / std::sqrt(plan.wavenumber[band] * way));
  if (plan.request.kind != WaveKind::radio || c >= width) return {c, c};
  const ReflectionCoefficients r = face_reflection(plan, material, band, width);
  const auto least = [&](std::complex<double> coefficient) {
    const std::complex<double> sum = 1.0 + coefficient;
    return width / (1 + std::abs((1.0 - coefficient) / (sum == 0.0 ? 1e-300 : sum)));
  };
  return {std::max(c, least(r.te)), std::max(c, least(r.tm))};
}

ReflectionCoefficients face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                       const MetCosines& met) {
  const ReflectionCoefficients r = face_reflection(plan, material, band, met.te);
  if (met.tm == met.te) return r;
  return {r.te, face_reflection(plan, material, band, met.tm).tm};
}

ReflectanceTable::ReflectanceTable(const Plan& plan) : values_(plan.materials.size() * (steps + 1)) {
  for (std::size_t material = 0; material < plan.materials.size(); ++material)
    for (std::size_t i = 0; i <= steps; ++i) {
      const auto r = face_reflection(plan, static_cast<std::uint32_t>(material), 0, double(i) / steps);
      values_[material * (steps + 1) + i] = 0.5 * (std::norm(r.te) + std::norm(r.tm));
    }
}

}  // namespace grimaldi
