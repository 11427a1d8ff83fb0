#pragma once
// Uniform theory of diffraction at a straight wedge. exp(+jωt).
//
// The wedge's faces are φ = 0 and φ = nπ, the air lies between them. Four boundaries count: where the incident wave
// ends beside face n and beside face 0, where the wave reflected by face n ends and where that reflected by face 0
// does. Each has one term; terms stand in that order everywhere (D₁ … D₄ of Kouyoumjian and Pathak).
//
// A term is written without its pole: cot and transition function are one product, which is finite and keeps its digits
// at the boundary.

#include <array>
#include <complex>
#include <span>

#include "core/constants.h"
#include "propagation/laws/reflection.h"

namespace grimaldi {

/// The side that a direction exactly on a boundary counts to: lit if the wave that ends there is taken as present.
enum class BoundarySide { lit, dark };

/// Rotation of the outgoing direction beyond each of the four boundaries, > 0 on the dark side.
/// Formula: −(π ± (β − 2πnN±)), N± the whole number nearest (β ± π)/(2πn); β = φ−φ' for the first two, φ+φ' for the
/// others; + first. Source: Kouyoumjian & Pathak, Proc. IEEE 62 (1974), equations (27), (28).
/// Inputs: exterior angle nπ, φ' of where the wave comes from and φ, all in one unit; `half_turn` = π in that unit (180
/// for degrees, in which boundaries at whole degrees are met exactly). 0 < n ≤ 2, 0 ≤ φ, φ' ≤ nπ.
/// Returns: the same unit, each |·| ≤ nπ. Error: 2 ulp of 2π.
std::array<double, 4> wedge_turns(double exterior_angle, double phi_in, double phi, double half_turn = pi);

/// One term over the incident field continued: D = √L/sin β · U.
/// Formula: U = sgn(ε) cos(ε/2n) [sin(|ε|/2)/sin(|ε|/2n)] w(e^{3jπ/4} √(2kL) sin(|ε|/2))/(2n), w = Faddeeva; equal to
/// −e^{−jπ/4}/(2n√(2πkL)) cot(−ε/2n) F(2kL sin²(ε/2)).
/// Source: Kouyoumjian & Pathak, equation (25).
/// Inputs: n 0 … 2; phase distance kL ≥ 0 (L = s s' sin²β/(s+s'), s sin²β for a plane wave), rad; turn ε = rotation
/// beyond the boundary, |ε| ≤ nπ; dark: on which side ε counts (the sign of ε but at 0).
/// Returns: dimensionless, ±½ at the boundary.
/// Error: ≤ 1e-14 of |U| but for |ε| > 0.9 nπ, where cos(ε/2n) goes to 0: 1e-15 absolute there (held by
/// Utd.TermAgainstManyDigits). That of ε itself moves the argument of w by √(kL/2) of it.
std::complex<double> wedge_wave(double n, double phase_distance, double turn, bool dark);

/// A term in its parts: U = ± plain · ½ w(e^{3jπ/4} argument), + on the dark side.
struct WedgeFactors {
  double argument;  ///< √(2kL) |sin(ε/2)|
  double plain;     ///< m cos(ε/2n), m = sin(|ε|/2)/(n sin(|ε|/2n)); 1 at ε = 0
  double slope;     ///< m²: what the derivative by ε has in its place, away from the boundary; 1 at ε = 0
};

/// Formula: plain/sin(ε/2) = cot(ε/2n)/n, whose derivative is that of 1/sin(ε/2) times slope, small angles understood.
/// Inputs and error: those of wedge_wave.
WedgeFactors wedge_factors(double n, double phase_distance, double turn);

/// The same over spans of one length. A turn of 0 counts as `side` says.
void wedge_waves(double n, std::span<const double> phase_distance, std::span<const double> turn,
                 std::span<std::complex<double>> waves, BoundarySide side = BoundarySide::dark);

/// The four terms, as D (√m) or over the incident field continued.
struct WedgeTerms {
  std::array<std::complex<double>, 4> term;

  std::complex<double> soft() const { return (term[0] + term[1]) - (term[2] + term[3]); }
  std::complex<double> hard() const { return (term[0] + term[1]) + (term[2] + term[3]); }
  /// With the faces' reflection coefficients of one polarisation: face n's boundary has the third term, face 0's the
  /// fourth.
  std::complex<double> with_faces(std::complex<double> face_0, std::complex<double> face_n) const {
    return (term[0] + term[1]) + (face_n * term[2] + face_0 * term[3]);
  }
};

/// Terms over the incident field continued, e^{−jk(s+s')}/(s+s') for a point source: the same in kind as sector_waves.
/// Inputs: rad; phase distance kL of each boundary.
WedgeTerms wedge_waves(double exterior_angle, double phi_in, double phi, const std::array<double, 4>& phase_distance,
                       BoundarySide side = BoundarySide::dark);

/// Kouyoumjian-Pathak diffraction coefficients: field = E(Q) D √(s'/(s(s+s'))) e^{−jks}.
/// Inputs: rad; sin β of the incident ray against the edge, 0 … 1, > 0; wavenumber k, rad/m; L of each boundary, m.
/// Returns √m. soft() for E along the edge or the pressure-release wall, hard() for H along the edge or the rigid wall.
WedgeTerms utd_coefficients(double exterior_angle, double phi_in, double phi, double sin_beta, double wavenumber,
                            const std::array<double, 4>& distance, BoundarySide side = BoundarySide::dark);

/// The same for many directions at one wedge; spans of one length; one L for the four boundaries of a direction.
void utd_coefficients(double exterior_angle, std::span<const double> phi_in, std::span<const double> phi,
                      std::span<const double> sin_beta, double wavenumber, std::span<const double> distance,
                      std::span<WedgeTerms> coefficients, BoundarySide side = BoundarySide::dark);

/// Angle χ at which the image wave of an edge meets a face on its way to or from the edge: the azimuth of the way from
/// the nearer of both faces, a right angle at the most. Rule: the image in either face has the coefficient of that face
/// at the smaller χ of the way there and the way back, at the cosine sin β sin χ. It is the same with the ends
/// exchanged, the face's own at its reflection boundary, and along either face both images extinguish the wave of a
/// face that does, as its boundary condition wants. Source: own. Error against the exact wedge of impedance faces
/// (Maliuzhinets), permittivity 30, median in the shadow: right angle 0.3 dB (the mean of both coefficients 2.7,
/// Luebbers' angles 1.2), half-plane 0.25 dB (mean 1.4) (held by the cases wedges/engine/impedance). Inputs: azimuth
/// from either face, rad, 0 … exterior angle. Returns rad.
double image_angle(double exterior_angle, double azimuth);

/// For images of black edges: what an image has of the coefficient for the way to the edge, of cosine `in` to the
/// face's normal; of that for the way from it, of cosine `out`, it has the rest. Formula: out²/(in² + out²).
/// Source: own. The same with the ends exchanged but for the names; one half at the reflection boundary; and along the
/// face the coefficient of the grazing way alone. Error as above: right angle 4.7 dB, half-plane 0.13 dB.
double face_share(double in, double out);

/// A face as a slab in air, for the reflection coefficients of its two boundaries' terms.
struct WedgeFace {
  std::complex<double> permittivity;
  double thickness;  ///< m; infinity: half-space
};
struct FaceReflections {
  ReflectionCoefficients face_0, face_n;
};

/// Coefficients of the faces that leave the diffracted field the same when the ends swap, and that are the faces' own
/// at their reflection boundaries: at the smaller `image_angle` of φ' and φ.
/// Source: after Luebbers, IEEE Trans. AP 32 (1984), whose angles are not reciprocal. te goes with the soft, tm with
/// the hard coefficient.
FaceReflections reciprocal_face_reflections(const WedgeFace& face_0, const WedgeFace& face_n, double exterior_angle,
                                            double phi_in, double phi, double sin_beta, double wavenumber);

/// Soft and hard wedge.
struct WedgeTotal {
  std::complex<double> soft, hard;
};

/// Total field (geometrical optics and diffraction) of the plane wave e^{jkρ cos(φ−φ')} that meets the wedge at right
/// angles. The geometrical part is the sum over all images, so that n < 1, an inner corner, is served.
/// Inputs: angles in the unit of `half_turn`; kρ > 0.   Valid: exact for n = 2 and n = 1/m; else the error of the
/// theory, O(1/kρ^1.5). Error: 1e-15 (1 + kρ) against the formula (held by Utd.TotalFieldOfTheReference).
WedgeTotal utd_plane_wave(double exterior_angle, double k_rho, double phi_in, double phi, double half_turn = pi,
                          BoundarySide side = BoundarySide::dark);

}  // namespace grimaldi
