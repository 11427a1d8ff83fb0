#include "propagation/laws/utd.h"

#include <algorithm>
#include <cmath>

#include "core/contract.h"
#include "core/sine_cosine.h"
#include "core/special_functions.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// What a term is but for the Faddeeva function: its real factor and its argument.
struct Factor {
  double size, argument;
};

inline Factor factor_of(double inverse_2n, double n, double phase_distance, double turn) {
  const double angle = std::fabs(turn);
  const double half = std::fabs(sine_cosine(0.5 * angle).sine);
  const SineCosine part = sine_cosine(angle * inverse_2n);
  const double ratio = angle > 0 ? half / part.sine : n;
  return {inverse_2n * part.cosine * ratio, std::sqrt(2 * phase_distance) * half};
}

/// Directions at once: few enough for the stack, enough for the loops.
constexpr std::size_t block = 64;

}  // namespace

std::array<double, 4> wedge_turns(double exterior_angle, double phi_in, double phi, double half_turn) {
  GRIMALDI_EXPECT(exterior_angle > 0 && half_turn > 0);
  const double period = 2 * exterior_angle;
  const auto turn = [&](double beta, double sign) {
    const double image = period * std::nearbyint((beta + sign * half_turn) / period);
    return -(half_turn + sign * (beta - image));
  };
  const double difference = phi - phi_in, sum = phi + phi_in;
  return {turn(difference, 1), turn(difference, -1), turn(sum, 1), turn(sum, -1)};
}

WedgeFactors wedge_factors(double n, double phase_distance, double turn) {
  GRIMALDI_EXPECT(n > 0 && phase_distance >= 0);
  const double angle = std::fabs(turn);
  const double half = std::fabs(sine_cosine(0.5 * angle).sine);
  const SineCosine part = sine_cosine(angle * (0.5 / n));
  const double ratio = angle > 0 ? half / (n * part.sine) : 1;
  return {std::sqrt(2 * phase_distance) * half, ratio * part.cosine, ratio * ratio};
}

Complex wedge_wave(double n, double phase_distance, double turn, bool dark) {
  GRIMALDI_EXPECT(n > 0 && phase_distance >= 0);
  const Factor factor = factor_of(0.5 / n, n, phase_distance, turn);
  return (dark ? factor.size : -factor.size) * faddeeva_on_ray(factor.argument);
}

void wedge_waves(double n, std::span<const double> phase_distance, std::span<const double> turn,
                 std::span<Complex> waves, BoundarySide side) {
  GRIMALDI_EXPECT(n > 0 && phase_distance.size() == turn.size() && turn.size() == waves.size());
  const double inverse_2n = 0.5 / n, at_zero = side == BoundarySide::dark ? 1 : -1;
  for (std::size_t begin = 0; begin < turn.size(); begin += block) {
    const std::size_t count = std::min(block, turn.size() - begin);
    std::array<double, block> size, argument;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = turn[begin + i];
      const Factor factor = factor_of(inverse_2n, n, phase_distance[begin + i], angle);
      size[i] = angle > 0 ? factor.size : angle < 0 ? -factor.size : at_zero * factor.size;
      argument[i] = factor.argument;
    }
    faddeeva_on_ray(std::span(argument).first(count), waves.subspan(begin, count));
    for (std::size_t i = 0; i < count; ++i) waves[begin + i] *= size[i];
  }
}

WedgeTerms wedge_waves(double exterior_angle, double phi_in, double phi, const std::array<double, 4>& phase_distance,
                       BoundarySide side) {
  const std::array<double, 4> turns = wedge_turns(exterior_angle, phi_in, phi);
  WedgeTerms waves;
  for (std::size_t i = 0; i < 4; ++i)
    waves.term[i] = wedge_wave(exterior_angle / pi, phase_distance[i], turns[i],
                               turns[i] > 0 || (turns[i] == 0 && side == BoundarySide::dark));
  return waves;
}

WedgeTerms utd_coefficients(double exterior_angle, double phi_in, double phi, double sin_beta, double wavenumber,
                            const std::array<double, 4>& distance, BoundarySide side) {
  GRIMALDI_EXPECT(sin_beta > 0 && wavenumber > 0);
  std::array<double, 4> phase_distance;
  for (std::size_t i = 0; i < 4; ++i) phase_distance[i] = wavenumber * distance[i];
  WedgeTerms terms = wedge_waves(exterior_angle, phi_in, phi, phase_distance, side);
  for (std::size_t i = 0; i < 4; ++i) terms.term[i] *= std::sqrt(distance[i]) / sin_beta;
  return terms;
}

void utd_coefficients(double exterior_angle, std::span<const double> phi_in, std::span<const double> phi,
                      std::span<const double> sin_beta, double wavenumber, std::span<const double> distance,
                      std::span<WedgeTerms> coefficients, BoundarySide side) {
  constexpr std::size_t directions = block / 4;
  std::array<double, block> turn, phase_distance, scale;
  std::array<Complex, block> wave;
  for (std::size_t begin = 0; begin < phi.size(); begin += directions) {
    const std::size_t count = std::min(directions, phi.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<double, 4> turns = wedge_turns(exterior_angle, phi_in[begin + i], phi[begin + i]);
      const double length = distance[begin + i];
      for (std::size_t j = 0; j < 4; ++j) {
        turn[4 * i + j] = turns[j];
        phase_distance[4 * i + j] = wavenumber * length;
        scale[4 * i + j] = std::sqrt(length) / sin_beta[begin + i];
      }
    }
    wedge_waves(exterior_angle / pi, std::span(phase_distance).first(4 * count), std::span(turn).first(4 * count),
                std::span(wave).first(4 * count), side);
    for (std::size_t i = 0; i < 4 * count; ++i) coefficients[begin + i / 4].term[i % 4] = scale[i] * wave[i];
  }
}

double image_angle(double exterior_angle, double azimuth) {
  return std::clamp(std::min(azimuth, exterior_angle - azimuth), 0.0, 0.5 * pi);
}

double face_share(double in, double out) {
  const double whole = in * in + out * out;
  return whole > 0 ? out * out / whole : 0.5;
}

FaceReflections reciprocal_face_reflections(const WedgeFace& face_0, const WedgeFace& face_n, double exterior_angle,
                                            double phi_in, double phi, double sin_beta, double wavenumber) {
  const double angle = std::min(image_angle(exterior_angle, phi_in), image_angle(exterior_angle, phi));
  const double cosine = std::min(1.0, sin_beta * std::sin(angle));
  const auto at = [&](const WedgeFace& face) {
    return slab_reflection(face.permittivity, face.thickness, wavenumber, cosine);
  };
  return {at(face_0), at(face_n)};
}

WedgeTotal utd_plane_wave(double exterior_angle, double k_rho, double phi_in, double phi, double half_turn,
                          BoundarySide side) {
  GRIMALDI_EXPECT(k_rho > 0);
  const double n = exterior_angle / half_turn, radians = pi / half_turn, period = 2 * exterior_angle;
  const std::array<double, 4> turns = wedge_turns(exterior_angle, phi_in, phi, half_turn);
  const bool lit_at_zero = side == BoundarySide::lit;
  // The incident field at the edge is 1 and L = ρ, so the waves decay as they stand: D e^{−jkρ}/√ρ = U e^{−jkρ}.
  const auto family = [&](double beta, double before, double behind) {
    const auto diffracted = [&](double turn) {
      return wedge_wave(n, k_rho, radians * turn, turn > 0 || (turn == 0 && !lit_at_zero));
    };
    Complex geometrical = 0;
    // Images at β = N·2nπ light the half turn to either side of them. The nearest boundary on each side is the one
    // whose term changes sign there, so it is asked for its own sign.
    const double nearest_before = std::nearbyint((beta + half_turn) / period);
    const double nearest_behind = std::nearbyint((beta - half_turn) / period);
    const auto lit = [&](double turn) { return turn < 0 || (turn == 0 && lit_at_zero); };
    for (double image = std::floor((beta - half_turn) / period) - 1; image <= (beta + half_turn) / period + 1;
         ++image) {
      const double offset = beta - period * image;
      const bool above = image == nearest_before ? lit(before) : offset > -half_turn;
      const bool below = image == nearest_behind ? lit(behind) : offset < half_turn;
      if (above && below) geometrical += std::polar(1.0, k_rho * std::cos(radians * offset));
    }
    return geometrical + (diffracted(before) + diffracted(behind)) * std::polar(1.0, -k_rho);
  };
  const Complex incident = family(phi - phi_in, turns[0], turns[1]),
                reflected = family(phi + phi_in, turns[2], turns[3]);
  return {incident - reflected, incident + reflected};
}

}  // namespace grimaldi
