#pragma once
// Arrivals under `auto`: the field of a path, with small objects and openings as wholes, and which model carried it.

#include <array>
#include <complex>
#include <span>
#include <string>

#include "propagation/composite.h"
#include "propagation/edge_model.h"
#include "propagation/field.h"
#include "propagation/small_object.h"

namespace grimaldi {

/// path_field; under `auto`, of a path over one edge of a small object or over two of them in a row, (1 − w) of it and
/// w of the object's wave (over two only in the object's shadow, where it may be that no edge is seen from both ends).
///
/// The wave of a whole object (w = polygon_share, from its middle). With incident wave e^{−jk s'}/s' along i, direction
/// o to the receiver at s, triangles T of unit normals n, x = n·i, y = n·o:
///   black: −(jk/2π) e^{−jk(s'+s)}/(s's) Σ_T b_T a_T ∫_T e^{−jk(i−o)·r} dS,  b = (x+y)²/4(|x|+|y|), twice that on a
///   sheet; faces: +(jk/2π) … Σ c_T R_T a_T ∫_T …,  c = 2|x||y|/(|x|+|y|) where source and receiver see one side of T,
///   else 0.
/// a_T: mean over T of what the distances of its points bring beyond the exponent. Where the object itself cuts off the
/// direct wave, or its face reflects to the receiver, the engine has a wave less or one too many: + direct, − reflected
/// wave (path_field of the sequence without the edge, with the face in its place). So the sum of all arrivals is the
/// incident wave less that through an opening of the object's outline (Babinet), and what the faces send back.
/// An opening's wave is that of a plate of the sheet's material that fills it, sign reversed (Babinet), over one edge
/// alone (a flat rim has every edge in sight of both ends): behind it what comes through less the direct wave where
/// that comes through, before it what the sheet lacks to be whole. Unlike an object's wave, which is little beside the
/// direct one, it may be all there is: paths over its edges reach everywhere (shines_through).
/// Source: Kirchhoff's integral over the object's surface; the flux e^{−jk(i−o)·r}(i+o)/2 has no divergence, so that
/// only the outline counts: in the forward direction the sum over a solid is the integral over its silhouette. b is the
/// mean of the outlines that source and receiver see, weighted so that it is symmetric and continuous; c that of
/// physical optics at the mirror's direction. Transform of a triangle: triangle_transform. Polarisation: E turned as i
/// turns to o; reflected as by the face's plane. Faces before and after the object by mirrors of source and receiver.
/// Inputs: `carries`: true for the one path at a point that brings the object's wave, false for the others; part: times
/// w, 0 … 1. Valid: objects as in small_object.h, nothing else near the straight ways past them.
/// Error: 0.3 dB against Kirchhoff's integral up to N = 0.1, openings 0.45 dB down to 20 dB below their axis (held by
/// the cases `auto`). Reciprocal but for the antennas.
void arrival_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                   std::span<const Interaction> interactions, const PathGeometry& geometry, bool carries, double part,
                   std::span<std::array<std::complex<double>, 2>> field);

/// arrival_field of all arrivals at a point that pass a small object; those of others stay as they are.
/// Paths over edges of one object between the same faces share its wave; the first that may bring it does. Its part is
/// the least clear_share of the paths at the point that pass one more edge, of something else, before or after the
/// object: where what that edge bounds cuts off some of the object's edges, their waves end one by one and those of
/// the paths over both edges change sign with them. The object as a whole cannot follow; its edges do.
/// Inputs: fields and geometry of all that arrives. Valid: the path over both edges is among them (an edge more than
/// the object's own).
void object_fields(const Scene& scene, const Plan& plan, const Transmitter& transmitter, std::span<Arrival> arrivals);

/// Shares of the models in the power of a path with an edge, at the first band; they add up to 1.
/// Formula: of each edge what edge_model.h says, several edges equally; of an object's path `polygon` has w times its
/// part.
std::array<double, edge_model_count> model_shares(const Scene& scene, const Plan& plan, const Vec3& source,
                                                  const Arrival& arrival);

/// For each edge of a path the model with the largest share at the first band, as edge_model_names, by blanks.
std::string model_words(const Scene& scene, const Plan& plan, const Vec3& source, const Arrival& arrival);

}  // namespace grimaldi
