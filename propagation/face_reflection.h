#pragma once
// Reflection at the faces of a plan: fields for connections, a table of powers for the walk.

#include <vector>

#include "propagation/laws/reflection.h"
#include "propagation/plan.h"

namespace grimaldi {

/// Coefficients of a face's material at band `band`: slab for radio (by its table, 1e-10), √(1 − α) twice for sound.
/// cos_incidence 0 … 1.
ReflectionCoefficients face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                       double cos_incidence);

/// Cosines at which a face is met, by the coefficient of either polarisation.
struct MetCosines {
  double te, tm;
};

/// The cosines for a way of length `way` (m) along the face to or from an edge: a wave of some width, that meets the
/// face at no less than c = c₀/(1 + |β|/c₀), c₀ = 1/√(k way), β = c₀ (1 − r)/(1 + r) the face's admittance for that
/// polarisation: a wave along metal goes on as along a perfect conductor where its numerical distance k way |β|²/2 is
/// small, and dies along other faces where it is great. Source: Sommerfeld's attenuation function, |F| ≈ 1 and
/// 1/(2|w|²) at either end. Sound: its faces do not depend on the angle.
MetCosines met_cosines(const Plan& plan, std::uint32_t material, std::size_t band, double cos_incidence, double way);

/// Coefficients at these cosines.
ReflectionCoefficients face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                       const MetCosines& met);

/// Share of the power that a face reflects at the first band, mean of both polarisations, read off a table over the
/// cosine (256 steps, linear). For the flux ledger only; |error| below 1 % of the power.
class ReflectanceTable {
 public:
  explicit ReflectanceTable(const Plan& plan);
  double operator()(std::uint32_t material, double cos_incidence) const {
    const double x = cos_incidence * steps;
    const auto i = static_cast<std::size_t>(x) < steps ? static_cast<std::size_t>(x) : steps - 1;
    const double* row = values_.data() + material * (steps + 1);
    return row[i] + (x - double(i)) * (row[i + 1] - row[i]);
  }

 private:
  static constexpr std::size_t steps = 256;
  std::vector<double> values_;
};

}  // namespace grimaldi
