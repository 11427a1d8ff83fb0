#include "propagation/laws/edge_sampling.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "core/special_functions.h"
#include "propagation/laws/free_space_diffraction.h"

namespace grimaldi {
namespace {

/// Share of the draws that is uniform over the exterior: where the terms' sum exceeds the lobes (products of terms far
/// from both boundaries).
constexpr double uniform_share = 0.25;
/// A side of a boundary that holds less of ∫|U|² than this is left to the uniform part: it could not be told from
/// rounding.
constexpr double least_share = 1e-6;

}  // namespace

std::array<double, 3> turns_beyond_boundaries(const EdgeSector& sector, double phi) {
  const double sum = phi + sector.phi_in;
  return {std::min(std::abs(phi - sector.phi_in) - pi, pi),
          std::min((sector.free_rim ? std::min(sum, 4 * pi - sum) : sum) - pi, pi),
          std::min(2 * sector.exterior_angle - sum - pi, pi)};
}

std::array<std::complex<double>, 3> sector_waves(const EdgeSector& sector, double effective_distance, double wavelength,
                                                 double sin_beta, double phi) {
  const auto turns = turns_beyond_boundaries(sector, phi);
  std::array<std::complex<double>, 3> waves{};
  const std::size_t count = !sector.faces ? 1 : sector.free_rim ? 2 : 3;
  for (std::size_t i = 0; i < count; ++i)
    waves[i] = edge_wave(fresnel_parameter(effective_distance, wavelength, sin_beta, turns[i]), turns[i] >= 0);
  return waves;
}

AzimuthLaw::AzimuthLaw(const EdgeSector& sector, double provisional_distance, double wavelength, double sin_beta)
    : exterior_angle_(sector.exterior_angle), slope_(std::sqrt(2 * provisional_distance / wavelength) * sin_beta) {
  GRIMALDI_EXPECT(provisional_distance > 0 && wavelength > 0 && sin_beta > 0);
  const auto add = [&](double boundary) {
    if (boundary < 0 || boundary > exterior_angle_) return;
    for (const double sign : {1.0, -1.0}) {
      const double reach = std::min(pi, sign > 0 ? exterior_angle_ - boundary : boundary);
      const double tail = reach > 0 ? edge_tail(parameter(reach)) : 1;
      if (1 - tail > least_share) lobes_[count_++] = {boundary, sign, reach, tail};
    }
  };
  add(sector.phi_in + pi);
  add(sector.phi_in - pi);
  if (!sector.faces) return;
  add(pi - sector.phi_in);
  add(sector.free_rim ? 3 * pi - sector.phi_in : 2 * sector.exterior_angle - sector.phi_in - pi);
}

double AzimuthLaw::parameter(double epsilon) const { return 2 * slope_ * std::sin(0.5 * epsilon); }

double AzimuthLaw::draw(double choice, double position) const {
  if (choice < uniform_share || count_ == 0) return position * exterior_angle_;
  const double rest = (choice - uniform_share) / (1 - uniform_share);
  const Lobe& lobe = lobes_[std::min(count_ - 1, static_cast<std::size_t>(rest * double(count_)))];
  const double v = edge_tail_inverse(lobe.tail + position * (1 - lobe.tail));
  const double epsilon = 2 * std::asin(std::min(1.0, v / (2 * slope_)));
  return std::clamp(lobe.boundary + lobe.sign * std::min(epsilon, lobe.reach), 0.0, exterior_angle_);
}

double AzimuthLaw::density(double phi) const {
  double lobes = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Lobe& lobe = lobes_[i];
    const double epsilon = lobe.sign * (phi - lobe.boundary);
    if (epsilon < 0 || epsilon > lobe.reach) continue;
    // −d edge_tail/dv = 2π|U|², dv/dε = slope cos(ε/2).
    lobes +=
        2 * pi * std::norm(edge_wave(parameter(epsilon), true)) * slope_ * std::cos(0.5 * epsilon) / (1 - lobe.tail);
  }
  const double uniform = count_ == 0 ? 1 : uniform_share;
  return uniform / exterior_angle_ + (count_ == 0 ? 0 : (1 - uniform_share) / double(count_) * lobes);
}

}  // namespace grimaldi
