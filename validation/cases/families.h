#pragma once
// The families of cases, one source file for each.

#include <vector>

#include "validation/cases/case.h"

namespace grimaldi {

using Cases = std::vector<Case>;

/// Openings (square, slit, triangle, star, ring of 32 edges, double slit, circle as polygon) at Fresnel numbers 10 …
/// 0.01 and sizes of 3, 10 and 30 wavelengths: the polygon form of the free-space diffraction BSDF and the connected
/// edges, each against the Rayleigh-Sommerfeld integral; some obstacles in their place by Babinet.
Cases aperture_cases();
/// Where each of the two theories holds: error over Fresnel number and length of edge, for squares.
Cases validity_cases();
/// Half-plane and wedges of 225°, 270° and 300°, soft and hard: UTD and the three black edges against the exact fields.
Cases wedge_cases();
/// One and two knife edges, and the half-plane as a mesh through the whole engine.
Cases knife_edge_cases();
/// Wedges in the engine against exact fields.
Cases engine_wedge_cases();
/// One edge in the engine, all round it, down to fractions of a wavelength, against the exact field.
Cases engine_corner_cases();
/// Wedges of finite conductivity in the engine against the exact coefficient of impedance faces.
Cases impedance_wedge_cases();
/// A strip, a slit and a rectangular plate in the engine against integrals and boundary elements.
Cases screen_cases();
/// Flat roofs, one and two behind each other, in the engine against boundary elements.
Cases roof_cases();
/// The model `auto` in the engine: small plates and boxes as wholes against integrals, and walks through its fades.
Cases auto_cases();
/// Walks in the engine over boundaries, ends and corners: no jump of the level.
Cases walk_cases();
/// The engine with transmitter and receiver exchanged.
Cases reciprocity_cases();
/// The engine's search for paths of two interactions against one through all faces and edges.
Cases exhaustive_cases();
/// Two edges in the engine: two screens against the double Fresnel integral, a flat roof against boundary elements, and
/// what must not jump.
Cases double_edge_cases();
/// What must be conserved.
Cases energy_cases();
/// The figures of the papers, in the printed and in the repaired form.
Cases published_cases();
/// Faces, slabs, gases, rain and air against closed forms and printed values.
Cases material_cases();
/// What may not change the engine's answer: how a mesh is cut, where the scene lies, what else is asked.
Cases invariance_cases();
/// Kernels at the ends of their domains.
Cases extreme_kernel_cases();
/// The engine at the ends of its domain.
Cases extreme_engine_cases();

}  // namespace grimaldi
