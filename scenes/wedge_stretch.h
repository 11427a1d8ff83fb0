#pragma once
// How the free sectors change along an edge.

#include <vector>

#include "core/constants.h"
#include "scenes/patch.h"
#include "scenes/wedge_sector.h"

namespace grimaldi {

/// Flat within this, rad about 180°: no wedge, no concave edge.
inline constexpr double flat_tolerance = 5 * pi / 180;

/// A stretch of an edge along which the free sectors of more than 185° do not change.
struct Stretch {
  double from, to;                       ///< m
  std::vector<Sector> sectors;           ///< those of its longest part
  std::vector<std::uint32_t> triangles;  ///< that bound them anywhere along it
};

/// The stretches of an edge, from 0 to its length. Where only the edge's own surfaces are near one sample decides; else
/// samples lie at most 0.5 m apart and in every interval between `breaks`, a change is narrowed to 1 mm and put on a
/// break within 1 mm. Stretches shorter than 25 mm (what a surface that merely crosses the edge leaves) go to their
/// longer neighbour.
std::vector<Stretch> find_stretches(EdgeSection& section, const Patches& patches);

}  // namespace grimaldi
