#include "propagation/face_reflection.h"

namespace grimaldi {

ReflectionCoefficients face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                       double cos_incidence) {
  const FaceMaterial& face = plan.materials[material];
  if (plan.request.kind == WaveKind::radio) return face.slab[band](cos_incidence);
  const double factor = wall_reflection(face.absorption[band]);
  return {factor, factor};
}

ReflectanceTable::ReflectanceTable(const Plan& plan) : values_(plan.materials.size() * (steps + 1)) {
  for (std::size_t material = 0; material < plan.materials.size(); ++material)
    for (std::size_t i = 0; i <= steps; ++i) {
      const auto r = face_reflection(plan, static_cast<std::uint32_t>(material), 0, double(i) / steps);
      values_[material * (steps + 1) + i] = 0.5 * (std::norm(r.te) + std::norm(r.tm));
    }
}

}  // namespace grimaldi
