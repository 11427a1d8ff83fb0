#pragma once
// Reference: the exact field of a perfectly reflecting infinite wedge. exp(+jωt).
//
// Faces at φ = 0 and φ = nπ, free space between them; n = 2 half-plane, 3/2 corner of a house, 1 plane, below 1 an
// interior corner. In every function
//   n             0.05 … 2
//   phi, phip     rad, 0 … nπ (1e-9 rad over an end is taken as the end): on a face and on a boundary as elsewhere
//   Throws        InputErrors for an angle outside the free space, n outside its range, a negative distance, a number
//                 that is not finite, a receiver at the source.

#include "validation/wedge_field.h"

namespace grimaldi {

/// How a field of a wedge is found: automatic takes the better one; the others are there to check each other.
enum class WedgeMethod { automatic, series, contour };

/// Plane wave e^{jkρ cos(φ−φ')}, arriving from φ', of amplitude 1 at the edge.
/// Formula: series u = (1/n) Σ ε_m j^{m/n} J_{m/n}(kρ) [cos(m(φ−φ')/n) ∓ cos(m(φ+φ')/n)]; contour = geometrical optics
/// and Sommerfeld's integral on the path of steepest descent, moved past near poles (validation/wedge_contour.h).
/// Source: Bowman, Senior & Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes (1969), ch. 6.
/// Inputs: k_rho = kρ, 0 … 1e6 rad (automatic: series to 20, contour beyond).
/// Returns: over the incident amplitude at the edge; on the edge soft 0, hard 2/n.
/// Error: 1e-13 + 1e-15·kρ absolute (held by WedgeSeries.PlaneWave*).
WedgeField wedge_plane_wave(double n, double k_rho, double phi, double phip,
                            WedgeMethod method = WedgeMethod::automatic);

/// Line source parallel to the edge, free field −(j/4) H0^(2)(k|r − r_s|).
/// Formula: series u = −(j/4)(1/n) Σ ε_m J_{m/n}(kρ<) H_{m/n}^(2)(kρ>) [cos(m(φ−φ')/n) ∓ cos(m(φ+φ')/n)]; contour =
/// images and MacDonald's integral.   Source: as above, 6.2.
/// Inputs: k_rho ≥ 0, k_rho_s ≥ 0 (rad), either the larger, not both 0.
/// Returns: in the unit of the free field above (dimensionless).
/// Error: 1e-13 + 1e-16·k(ρ + ρ_s) absolute (held by WedgeSeries.LineSource*).
WedgeField wedge_line_source(double n, double k_rho, double k_rho_s, double phi, double phip,
                             WedgeMethod method = WedgeMethod::automatic);

/// A point about an edge on the z axis: m, rad, m.
struct EdgePoint {
  double rho, phi, z;
};

/// Point source, free field e^{−jkR}/R.
/// Formula: images e^{−jkR}/R and MacDonald's integral of e^{−jkR}/R on its path of steepest descent.
/// Source: as above, 6.3; check in the tests by Biot-Tolstoy-Medwin, Svensson et al., JASA 106 (1999) 2331.
/// Inputs: k > 0 (rad/m), points with ρ ≥ 0; either may be called the source.
/// Returns: 1/m.
/// Error: (1e-13 + 1e-15·kR) /R, R the length of the path over the edge (held by WedgeSeries.PointSource*); 1e-16/d at
/// a distance d ≪ R from source or image.
WedgeField wedge_point_source(double n, double k, const EdgePoint& source, const EdgePoint& receiver);

}  // namespace grimaldi
