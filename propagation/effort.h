#pragma once
// How thorough a run is: what its number of rays buys besides rays.

#include "propagation/plan_file.h"

namespace grimaldi {

/// A map's error shall fall as 1/√rays at least, so every choice that trades it for time follows the number of rays.
/// Measured in the demo city, depth 2, against 1.6e7 rays, two seeds: 68 % of the cells within 0.92, 0.49, 0.27, 0.07
/// dB for 6.25e4, 2.5e5, 1e6, 4e6 rays (the last shares its dense points with the truth). With m = rays/1e6:
struct Effort {
  /// Coarse sub-points along a cell's side: 2 √m, 2 to 5; 0 where nothing diffracts. The error of weak paths and of
  /// their cross terms falls with them.
  int coarse_points;
  /// Dense sub-points along a cell's side: 5 m^¼, rounded up, at most 8; 0 where that is not two more than the coarse
  /// ones. The error of strong paths, which light a part of the cell, falls with them.
  int dense_points;
  /// Share of a cell's power from which a path is asked at the dense points: 2 %/√m, at most 10 %.
  double strong_share;
  /// Share of a cell's power from stronger sequences below which one sequence of two and more interactions with an edge
  /// is left out of the cell (and does not grow through it): 0.14 %/m, 5e-5 to 1 %. In Etoile a street point has some
  /// 2,000 pairs of edges, of which those below −30 dB carry 0.1 dB together.
  double negligible_share;
  /// Ways around a blocked leg whose path is asked for: 40 √m, 6 to 160 (a sixth of them for a third edge and more); of
  /// those that are free, and of those that something else blocks, as many are kept: 20 m, 1 to 40.
  int detours_tried, detours_kept;
};

/// The effort of a run. Inputs: a valid description.
Effort effort_of(const PlanDescription& request);

/// The effort of the search for one receiver: that of 1e6 rays at least, and 0.1 % at most is left out. Receivers are
/// few, and a way that matters may not come and go with the place: with one way kept of several as good, the level
/// steps by 2 dB around a house (case walks/around-a-house).
Effort effort_at_a_point(const PlanDescription& request);

}  // namespace grimaldi
