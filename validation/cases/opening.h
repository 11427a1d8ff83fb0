#pragma once
// Openings in a black screen, under the theories that are compared. Unit plane wave e^{−jkz} at normal incidence,
// screen z = 0, λ = 1: all lengths in wavelengths. exp(+jωt).

#include <complex>
#include <string>
#include <vector>

#include "core/vector.h"
#include "propagation/laws/aperture.h"
#include "validation/aperture.h"

namespace grimaldi {

/// One opening as both sides take it: loops for the references and the edges, triangles of amplitude 1 for the BSDF.
struct Opening {
  std::string name;
  double size = 0;            ///< D
  double wide = 0, high = 0;  ///< extents along x and y
  double shortest = 0;        ///< length of the shortest edge
  Aperture aperture;
  TriangleAperture triangles;
};

/// Names of `opening`: square (side D), slit (D × D/5), triangle (circumscribed circle of diameter D), star (5 tips,
/// inner radius 0.4 of the outer), ring (outer polygon of 32 edges, inner one of half its size: the published ring),
/// double-slit (two slits of D/5 × D/2, 4D/5 from centre to centre), circle (polygon of 96 edges).
const std::vector<std::string>& opening_names();

/// The opening of that name and size D.
Opening opening(const std::string& name, double size);

/// Distance behind the screen at which an opening of size D has the Fresnel number N = (D/2)²/(λz).
double distance_of(double size, double fresnel_number);

/// Field behind the opening by Rayleigh and Sommerfeld (first kind): the truth.
std::complex<double> true_field(const Opening& opening, const Vec3& point);

/// The same by the Fraunhofer integral of the references, with the obliquity of the BSDF (√cos θ in amplitude).
std::complex<double> fraunhofer_field(const Opening& opening, const Vec3& point);

/// The same by the polygon form of the BSDF: j ψ* √cos θ e^{−jkR}, R from the origin.
std::complex<double> polygon_field(const Opening& opening, const Vec3& point);

/// Diffracted part by the printed form of the BSDF: the edges without their central lobes, over constant amplitude 1.
std::complex<double> printed_field(const Opening& opening, const Vec3& point);

/// What an edge's ends do.
enum class EdgeEnds {
  waves,  ///< each end has a wave of its own: lines 5 and 6 of the repaired BSDF, which UTD shares
  none    ///< an edge counts where the point of diffraction lies on it: the cones of UTD as in textbooks
};

/// The wave through the opening by connection of its edges, black: [lit] e^{−jkz} + Σ T U e^{−jks}. On a thin screen
/// the incident terms of UTD (n = 2) and the repaired BSDF are the same law; edges of length 0 are left out.
std::complex<double> connected_field(const Opening& opening, const Vec3& point, EdgeEnds ends = EdgeEnds::waves);

/// Points on the plane at distance z, spread evenly (a lattice) over |x| ≤ wide/2 + 3 z/wide, y likewise, at most 60°
/// off the axis.
std::vector<Vec3> observation_points(const Opening& opening, double z, int count);

/// How far a pattern is from the truth.
struct PatternError {
  double median = 0, p90 = 0;  ///< of |10 lg(intensity/truth)|, dB, over the directions that count
  std::size_t directions = 0;  ///< where the truth lies within 20 dB of its peak
};
PatternError pattern_error(const std::vector<double>& intensity, const std::vector<double>& truth);

}  // namespace grimaldi
