#pragma once
// The field that a path brings: closed form, per band and polarisation.

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "propagation/edge_chain.h"
#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"

namespace grimaldi {

/// Fields of a path for all bands: `field[band]` = h as {V, H} of the receiver's polar frame (sound: {p, 0}); |h|² =
/// path gain. In free space h = λ/4π e^{−jkr}/r for radio, 1/√(4π) e^{−jkr}/r (1/m) for sound. Formula: faces by their
/// coefficients and Jones vectors; an edge by the model of the plan. `utd`: the four terms of Kouyoumjian & Pathak,
/// faces always on. `fsd`: the free-space diffraction law (three black edges: incident wave and its images in both
/// faces; the incident one alone where the run has no reflection; the images by the faces' Fresnel dyadics for
/// the way there and the way back, by `face_share`), weight of its ends T = H + Σ w UV for each term, w by
/// `edge_end_share`; over two edges, where a term of the other edge has an argument b below 2, U(b) UV becomes
/// `end_and_edge_wave` and w that of the arguments that term and end have without the other edge (a fade from 1 on).
/// Spreading of the whole chain of edges (`edge_chain`). Neighbouring edges: each pair of their terms by the
/// double-edge wave, faces between them or not; of three and more by MomentSteps or RowSteps (`is_row`).
/// Two edges of one face, along which the wave goes: half of the sum over all pairs, with the face's coefficient for
/// that way at both edges: over a rigid face the wave counts once, of a soft one what is left is the coupling of the
/// slopes. A way to or from an edge meets a face by `met_cosines`. Source: the half, Kouyoumjian & Pathak. Air:
/// attenuation of the plan over the whole length.
void path_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                std::span<const Interaction> interactions, const PathGeometry& geometry,
                std::span<std::array<std::complex<double>, 2>> field);

/// A bound on Σ|h|² over both polarisations at the first band, cheap to have: spreading and edges, faces taken as
/// lossless. Terms of edges by double_edge_bound, ends |T| ≤ 1.5. The antenna's gain is taken as at most 1.65.
double power_bound(const Scene& scene, const Plan& plan, std::span<const Interaction> interactions,
                   const PathGeometry& geometry);

}  // namespace grimaldi
