#pragma once
// Apertures by name: the columns `shape` and `params` of the reference files.

#include <string>
#include <string_view>
#include <vector>

#include "validation/aperture.h"

namespace grimaldi {

/// The aperture of that name, centred on the origin.
/// Inputs: `params` = key=value pairs between semicolons, numbers in the unit of length, angles in rad; blanks around
/// keys and values are allowed. Upper and lower case count in keys (R and r differ).
///
/// shape                            params
/// rect                             wx, wy: full widths
/// square                           w
/// circle, circle_on_axis,
///   circle_off_axis                radius
/// annulus                          outer, inner
/// regular_polygon                  N (3 … 10000), circumradius, first_vertex_angle_rad (0)
/// triangle, pentagon, hexagon,
///   heptagon, octagon              the same without N
/// star_polygon                     N (≥ 2 tips), R, r (or circumradius, inner), first_outer_vertex_angle_rad (0)
/// starN, e.g. star5                the same without N
/// double_slit                      width (along x), height (along y), centre_spacing (along x)
/// polygon                          vertices = x y x y …, between blanks; either sense of rotation
///
/// The words "first vertex on +x" among the params say that the angle of the first vertex is 0.
/// Throws: InputErrors (option "shape" or "params") for an unknown shape, an unknown, missing, double or broken key,
/// a length that is not > 0, inner ≥ outer, slits that overlap, a polygon without area: all faults at once.
Aperture aperture_shape(std::string_view shape, std::string_view params);

/// The names of the table above; starN stands as star5.
const std::vector<std::string>& aperture_shape_names();

}  // namespace grimaldi
