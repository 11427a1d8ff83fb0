#pragma once
// Ends of edges that stand upright on a face.

#include <vector>

#include "scenes/surroundings.h"
#include "scenes/wedge.h"

namespace grimaldi {

/// Sets `stands_at_start` and `stands_at_end` of each wedge.
/// Method: an end stands on a face if all of its exterior sector, 3 cm about the edge, lies on triangles within
/// contact_distance of the end and upright to the edge within 2°.
/// Source: own. Such a face mirrors the edge into its own continuation, so that no wave leaves the end.
void find_feet(const Surroundings& surroundings, std::vector<Wedge>& wedges);

}  // namespace grimaldi
