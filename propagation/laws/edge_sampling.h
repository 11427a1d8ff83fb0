#pragma once
// The sampled free-space diffraction BSDF: azimuths about an edge are drawn from a law close to the edge's own.
// exp(+jωt).
//
// The power that an edge turns into azimuth ε per unit of its length is dP/(ds dε) = I L sin²β |Σ U(v)|². L = s s'/(s +
// s') is not known before the next vertex is, so azimuths are drawn with L = s', its upper bound, and weighted by the
// true law afterwards.

#include <array>
#include <complex>

namespace grimaldi {

/// The exterior of an edge as an incident wave meets it. Azimuths φ from face 0 through the exterior.
struct EdgeSector {
  double exterior_angle = 0;  ///< rad, nπ
  double phi_in = 0;          ///< φ', azimuth of where the wave comes from, rad, 0 … exterior_angle
  bool free_rim = false;      ///< of a thin screen: one face, nπ = 2π
  bool faces = false;         ///< the faces reflect: images of the incident wave have edge terms too
};

/// Rotation ε beyond each boundary (> 0 on its dark side, at most π) at azimuth φ: of the incident wave, of its image
/// in face 0, of that in face n. Formula: |φ−φ'| − π, φ+φ' − π, 2nπ − φ − φ' − π; the two sides of a free rim are one
/// mirror, min(φ+φ', 4π−φ−φ') − π. Inputs rad.
std::array<double, 3> turns_beyond_boundaries(const EdgeSector& sector, double phi);

/// Edge terms {U_i, U_0, U_n} at azimuth φ; those that the sector lacks are 0. Inputs: L m, λ m, sin β 0 … 1, φ rad.
/// Returns dimensionless, each |U| ≤ ½. Error 1e-14 relative.
std::array<std::complex<double>, 3> sector_waves(const EdgeSector& sector, double effective_distance, double wavelength,
                                                 double sin_beta, double phi);

/// Power per unit length of edge of both sides of a boundary over irradiance × r_F sin β, paraxial: 1/(π√2); one side
/// has half of it, 0.11254. Source: ∫_0^∞ |U(v)|² dv = 1/(2π), dv = √(2L/λ) sin β dε. Valid for L sin²β ≫ λ; error ~
/// 1/(π v(ε = π)) relative.
inline constexpr double boundary_power = 0.22507907903927651;

/// The law from which azimuths are drawn: a mixture of |U(v)|² on either side of each boundary inside the exterior, at
/// L = s', and a uniform part over the exterior. A sample's weight is the true law over density(φ) (balance heuristic).
/// It is bounded: L|U(v(L))|² ≤ s'|U(v(s'))|² for L ≤ s', and far from all boundaries the uniform part bounds it.
class AzimuthLaw {
 public:
  /// Inputs: provisional effective distance s' (m, > 0), λ (m, > 0), sin β (0 … 1, > 0).
  AzimuthLaw(const EdgeSector& sector, double provisional_distance, double wavelength, double sin_beta);

  /// An azimuth in (0, exterior angle), rad. Inputs: two uniform numbers in (0, 1).
  double draw(double choice, double position) const;

  /// Probability density of draw at φ, 1/rad; its integral over the exterior is 1 to 1e-10.
  double density(double phi) const;

 private:
  /// One side of one boundary: ε = 0 … reach from it, upwards or downwards in φ.
  struct Lobe {
    double boundary, sign, reach, tail;  ///< tail: edge_tail at reach
  };
  double parameter(double epsilon) const;

  double exterior_angle_, slope_;  ///< slope = √(2L/λ) sin β, so that v = 2 slope sin(ε/2)
  std::array<Lobe, 8> lobes_;
  std::size_t count_ = 0;
};

}  // namespace grimaldi
