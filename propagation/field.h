#pragma once
// The field that a path brings: closed form, per band and polarisation.

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"

namespace grimaldi {

/// The three boundaries of an edge's wave: incident shadow, reflection at face 0, at face n.
enum class Boundary { incident, face0, facen };

/// Fields of a path for all bands: `field[band]` = h as {V, H} of the receiver's polar frame (sound: {p, 0}); |h|² =
/// path gain. In free space h = λ/4π e^{−jkr}/r for radio, 1/√(4π) e^{−jkr}/r (1/m) for sound. Formula: faces by their
/// coefficients and Jones vectors; an edge by the model of the plan. `utd`: the four terms of Kouyoumjian & Pathak,
/// faces always on. `fsd`: the free-space diffraction law (three black edges: incident wave and its images in both
/// faces; the incident one alone where the run has no reflection; the images by the faces' Fresnel dyadics, the mean of
/// the way there and the way back), weight of its ends T = H + Σ w UV with w = ½ at an end that another wedge shares
/// and 1 at one that none shares, amplitude √L √(ρe/(s(s+ρe))) with the astigmatic radii of the wave that arrives
/// (Kouyoumjian & Pathak 1974, eqs. 31 to 35). Air: attenuation of the plan over the whole length.
void path_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                std::span<const Interaction> interactions, const PathGeometry& geometry,
                std::span<std::array<std::complex<double>, 2>> field);

/// A bound on Σ|h|² over both polarisations at the first band, cheap to have: spreading and edges, faces taken as
/// lossless. |U| ≤ min(½, 1/(√2 π v)) for each of an edge's three terms, ends |T| ≤ 1.5. The antenna's gain is taken as
/// at most 1.65.
double power_bound(const Scene& scene, const Plan& plan, const PathGeometry& geometry);

/// Fresnel-Kirchhoff parameter of the passage `edge` (index in geometry.edges) at a boundary, at `wavelength` m; v ≥ 0.
double boundary_parameter(const Scene& scene, const PathGeometry& geometry, std::size_t edge, Boundary boundary,
                          double wavelength);

}  // namespace grimaldi
