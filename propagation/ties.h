#pragma once
// Points on a shadow boundary to within the rounding of rays: which waves arrive there, decided in double precision.

#include <functional>
#include <span>
#include <vector>

#include "propagation/composite.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"

namespace grimaldi {

/// Takes out of the paths that arrive at a point, and adds to them, what rays in single precision cannot tell.
///
/// A ray near an edge errs: it is rounded, and starts off another edge that it leaves. The wave that the edge bounds
/// (the sequence without it, or with a face of it in its place) then comes and goes elsewhere than the edge's term
/// changes its sign. So where a path passes an edge so near a boundary, `is_dark` of that term decides whether the
/// bounded wave arrives: all edges that bound it must say so. What stands in the way besides is known: the path over
/// the edge goes the same way and arrives. From most edges to fewest, so that two edges in a row on one line are
/// settled too; a path taken out still hides what its edge bounds.
///
/// Inputs: `hair` (m, see `tie_hair`); `arrivals` with geometry; `find` solves the sequence of a name into an arrival,
/// false where there is no such path.   Returns: true if `arrivals` changed; what is new comes last.
/// Valid: the boundaries of edges that are passed between their ends.
/// Error: 1e-9 rad of azimuth (double-edges/screens/MK03 and MK18, wedges/engine/all-round/on-the-boundary).
bool settle_ties(const Scene& scene, const Plan& plan, double hair, std::vector<Arrival>& arrivals,
                 const std::function<bool(SequenceHash, Arrival&)>& find);

/// True if a path passes an edge within a hair of a boundary.
bool has_tie(const Scene& scene, const Plan& plan, double hair, const Arrival& arrival);

/// How far a ray may err at an edge, across the ray, for a tracer's `surface_gap`: 3 gaps off another edge, 1 by
/// rounding, and some. m.
constexpr double tie_hair(double surface_gap) { return 6 * surface_gap; }

}  // namespace grimaldi
