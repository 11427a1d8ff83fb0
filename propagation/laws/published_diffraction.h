#pragma once
// The free-space diffraction BSDF as its authors published it, for comparison only: Steinberg, Ramamoorthi, Bitterli,
// Mollazainali, d'Eon, Pharr, "A Free-Space Diffraction BSDF", ACM Trans. Graph. 43(4), 2024, with its supplemental,
// equations S…. exp(−iωt), as there.
//
// A launched ray carries a Gaussian footprint; where it hits an obstacle, the silhouette edges inside the footprint
// diffract it. Followed here: the formulas with their errors of print mended, and without the depth phase of S1.13,
// which sends oblique edges off Keller's cone. Behind an edge this method errs by several decibels
// (published_half_plane_level): the law of free_space_diffraction.h is the one to use.

#include <array>
#include <complex>
#include <limits>
#include <vector>

#include "propagation/laws/triangle_transform.h"

namespace grimaldi {

/// g1(x) = (cos(x/2) − sinc(x/2))/x, odd; by a nested series for |x| < 2, where the difference cancels. Error ≤ 2e-16.
double edge_g1(double x);

/// g2(x) = sinc(x/2), sinc x = sin x/x, even. Error ≤ 2e-16.
double edge_g2(double x);

/// α1(ζ) = ζy/(2π ζ² ζx) (cos(ζx/2) − sinc(ζx/2)), S2.20. Returns 0 on both axes' limits of it: at ζx = 0 and at ζ = 0
/// (which has no limit of its own: −sin t cos t/24π along angle t). Error ≤ 2e-15 of its value (nested series for |ζx|
/// < 2).
double alpha1(double zeta_x, double zeta_y);

/// α2(ζ) = ζy/(2π ζ²) sinc(ζx/2), S2.21. Returns 0 at ζ = 0, beside which it grows as 1/ζ. Error ≤ 2e-15 of its value,
/// but for the phase of the sine near its zeros.
double alpha2(double zeta_x, double zeta_y);

/// A straight piece of silhouette in the plane across the ray, the aperture on its left; amplitudes of the footprint at
/// its ends, 1/m for unit power.
struct PublishedEdge {
  PlanePoint start, end;
  std::complex<double> start_amplitude, end_amplitude;
};

/// R ψ_j(ξ), the wave of one edge with its central lobe: k e² exp(−ikξ·v)[(a − b) α1(ζ) + i (a + b)/2 α2(ζ)], S2.19.
/// The edges of an aperture add up to its field where the amplitude is constant; else a pole 1/ξ is left at ξ = 0.
std::complex<double> whole_edge_wave(double wavenumber, const PublishedEdge& edge, const PlanePoint& xi);

/// R ψ̂_j(ξ), the wave of one edge without its central lobe: √(1 − χ) k e² exp(−ikξ·v)[(a − b) α1(ζ) + i (a + b)/2
/// α2(ζ)], S2.19 and S2.26, χ = exp(−ζ²/6). ζ = k(e·ξ, e m·ξ), m = (e_y, −e_x)/e. |R ψ̂|² cos θ = power per solid angle
/// over the footprint's. Inputs: wavenumber rad/m; xi = direction cosines across the ray. Returns sr^−½ for a footprint
/// of unit power.
std::complex<double> published_edge_wave(double wavenumber, const PublishedEdge& edge, const PlanePoint& xi);

/// Power of one edge without its central lobe over the footprint's, e²(|a − b|² I1 + |(a + b)/2|² I2), S2.33.
/// I1 = 0.004612658839610051, I2 = 0.12458996032251083 (S2.36 prints them 1.9 % and 7.8 % low), I12 = 0.  Paraxial.
double published_edge_power(const PublishedEdge& edge);

/// Footprint of a ray: |φ|² a Gaussian of standard deviation sigma (m) and power 1; the silhouette inside 3√2 sigma of
/// its centre is cut into `pieces` of equal length, since the amplitude is linear along each: 12 are half the
/// amplitude's standard deviation (√2 sigma) long each, well inside the one that the authors allow. What the lobes take
/// away, and so the power that is left, depends on them: some 3 dB for twice the number.
struct PublishedFootprint {
  double sigma = 0;
  int pieces = 12;
};

/// Standard deviation of the footprint over the wavelength, as published.
inline constexpr double published_sigma_wavelengths = 25;

/// Share of the footprint's power on an obstacle whose straight silhouette is at `distance` (m, < 0 if the centre
/// misses it): Φ(distance/sigma).
double power_on_obstacle(const PublishedFootprint& footprint, double distance);

/// One hit near one straight silhouette, and how it sends power on. Axes across the ray: along the edge, and from the
/// hit towards it.
class PublishedScattering {
 public:
  /// Inputs: wavenumber rad/m; distance of the hit from the silhouette, m ≥ 0; the silhouette's ends from the foot of
  /// the hit, m along it.
  PublishedScattering(const PublishedFootprint& footprint, double wavenumber, double distance,
                      double from = -std::numeric_limits<double>::infinity(),
                      double to = std::numeric_limits<double>::infinity());

  /// The silhouette's pieces inside the footprint, the obstacle (as the aperture) on their left.
  const std::vector<PublishedEdge>& edges() const { return edges_; }

  /// Diffracted power per d²ξ (so per cos θ dΩ), weight 1/P_A: |Σ R ψ̂_j(ξ)|²/P_A, 1/sr.
  double operator()(const PlanePoint& xi) const;

  /// A direction from a law of the pattern's widths: Cauchy of 1/(2k sigma) along the edge and of √6/(k e) towards it,
  /// e the length of a piece; one in seven uniform in d²ξ. May lie outside the unit disc: no power goes there. Inputs:
  /// uniform numbers in (0, 1).
  PlanePoint draw(double choice, double u, double v) const;

  /// Density of draw per d²ξ.
  double density(const PlanePoint& xi) const;

 private:
  double wavenumber_, share_, width_along_, width_towards_;
  std::vector<PublishedEdge> edges_;
};

/// Expectation, over all launched rays, of the published estimate behind a half-plane, over free space: rays that hit
/// it, each connected from its hit. Geometry: source at distance `before` from the edge, at the edge's height, receiver
/// `behind` the screen's plane and `below` the edge, both across the edge, m > 0. Method: midpoints in the hit's
/// position (steps across, steps along; the latter in sinh), error below 0.01 dB with the defaults.  Returns a ratio of
/// powers.
double published_half_plane_level(const PublishedFootprint& footprint, double wavelength, double before, double behind,
                                  double below, int steps_across = 3000, int steps_along = 400);

}  // namespace grimaldi
