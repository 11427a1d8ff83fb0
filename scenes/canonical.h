#pragma once
// Scenes by formula: no file needed.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/contract.h"
#include "scenes/description.h"

namespace grimaldi {

/// Parameters of a built-in scene by name, SI units, e.g. {"width", 20}. Missing ones take the documented default.
using CanonicalParameters = std::map<std::string, double>;

/// One parameter of a built-in scene: what may be said of it. Both ends of the range are allowed.
struct CanonicalParameter {
  std::string_view name;
  std::string_view unit;  ///< "m", "deg", "1" for a number of things
  double value;           ///< default
  double low, high;       ///< range
  bool whole = false;     ///< must be a whole number
};

/// The names: demo-city, half-plane, strip, slit, wedge, box, street-canyon.
const std::vector<std::string>& canonical_names();

/// The parameters of the built-in scene `name` in the order of the table below; none for demo-city and for a name that
/// is not one of `canonical_names`.
std::vector<CanonicalParameter> canonical_parameters(const std::string& name);

/// The scene of that name. Lengths in m, z up, one coordinate frame: x east, y north.
///
/// name           parameter       default  range        meaning
/// half-plane     length          4000     1 … 20000    along y, from −length/2 to length/2
///                depth           4000     1 … 20000    downward, from z = −depth to 0
/// strip          width           1        0.05 … 1000  |z| ≤ width/2
///                length          4000     1 … 20000    along y, centred
/// slit           width           1        0.05 … 1000  the opening, |z| < width/2
///                length          4000     1 … 20000    along y, centred
///                depth           2000     1 … 20000    of each of the two screens
/// wedge          interior_angle  90       1 … 174.9    degrees of the solid at its edge
///                length          4000     1 … 20000    along y, centred
///                depth           2000     1 … 20000    of each of the two faces, measured along the face
/// box            width           10       0.1 … 1000   along x, from 0
///                length          12       0.1 … 1000   along y, from 0
///                height          8        0.1 … 1000   along z, from 0
///                thick           0        0 … 100      of the walls; below 0.05 only 0 is allowed (no outer shell)
/// street-canyon  height          20       1 … 500      of all buildings
///                depth           15       1 … 500      of all buildings, along y
///                length          60       1 … 1000     of all buildings, along x
///                width           20       1 … 500      of the street, |y| < width/2
///                count           4        1 … 100      buildings in each row, a whole number
///                gap             15       0.5 … 500    side street between two neighbours of a row
///                margin          50       1 … 10000    of the ground beyond the buildings, on all four sides
/// demo-city      none: see scenes/demo_city.h
///
/// Lower ends of ranges: 0.05 m = 5 weld distances of `repair`, so that the two sides of a thing stay two; 1° keeps the
/// faces of the wedge apart from one patch (0.2°). 174.9° keeps its exterior angle above 185°, where an edge counts as
/// diffracting.
///
/// half-plane     Metal. Screen in the plane x = 0, z ≤ 0, normal +x. Its one edge is x = z = 0; the two sides and
///                the bottom are artificial.
/// strip          Metal. Screen in x = 0, normal +x. Its edges are z = ±width/2; the two ends are artificial.
/// slit           Metal. Two screens in x = 0, normal +x: −depth − width/2 ≤ z ≤ −width/2 and its mirror image. Their
///                edges are z = ±width/2; the ends and the outer edges are artificial.
/// wedge          Metal. Closed solid with outward normals, symmetric about the plane x = 0; its edge x = z = 0 is the
///                top, its base lies at z = −depth cos(interior_angle/2). All edges but the top are artificial.
/// box            Concrete. Closed room, six faces with normals inward; if thick > 0 an outer shell at that distance,
///                normals outward. All edges are artificial. (`repair` turns every closed surface outward: the inward
///                normals are in this description only.)
/// street-canyon  Two rows of box buildings on either side of a street along x, centred on the origin, on a ground at
///                z = 0. Ground concrete, walls brick, roofs metal; for each building a mesh of walls and one of the
///                roof, "north 1 walls", "north 1 roof" … from west to east. Buildings have outward normals and no
///                floor; the rim of the ground is artificial.
///
/// Screens and the faces of the wedge are cut into pieces of at most 200 m both ways, with a vertex at the origin
/// (half-plane, wedge), so that single-precision ray tracers stay within 200 m × 2⁻²⁴ = 12 µm near it; the base and the
/// ends of the wedge are cut along one way only. Grounds are cut into cells of at most 150 m.
///
/// Errors to `diagnostics` (then the scene has no meshes): an unknown name or parameter (did you mean), a value that is
/// not finite, out of range, or not whole where it must be.
SceneDescription canonical_scene(const std::string& name, const CanonicalParameters& parameters,
                                 Diagnostics& diagnostics);

}  // namespace grimaldi
