#pragma once
// Objects that can scatter as a whole: flat sheets and convex solids that stand free, openings in sheets.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/scene.h"

namespace grimaldi {

/// A triangle of an object; of an opening it has the material and the patch of the sheet around.
struct ObjectFace {
  std::array<Vec3, 3> corner;
  std::uint32_t material, patch;
};

enum class ObjectKind {
  sheet,   ///< flat, open to both sides
  solid,   ///< closed and convex
  opening  ///< a hole in a sheet: what fills it is there in thought only
};

struct SmallObject {
  Vec3 centre;      ///< of its bounding box
  double diameter;  ///< of the sphere about it, m
  double area;      ///< of its triangles, m²
  ObjectKind kind;
  std::vector<ObjectFace> faces;
  bool flat() const { return kind != ObjectKind::solid; }
};

struct SmallObjects {
  std::vector<SmallObject> objects;
  std::vector<std::uint32_t> of_wedge;  ///< object of each wedge of the scene, or no_index; empty: none was sought

  /// Object of an edge, or nullptr.
  const SmallObject* at(std::uint32_t wedge) const {
    return of_wedge.empty() || of_wedge[wedge] == no_index ? nullptr : &objects[of_wedge[wedge]];
  }
};

/// All objects of at most 256 triangles and of diameter `largest` (what is small is a matter of the legs).
/// Method: triangles that share a welded vertex are one component. It is an object if it is flat (all vertices within
/// 1 mm of one plane) with a rim of free rims alone, holes in it allowed, or closed (two triangles at each edge),
/// convex (no vertex more than 1 mm before a triangle's plane) and with all its sharp edges free: the lengths of its
/// wedges add up to those of its edges above 185°, within 1 %; and no triangle
/// of another component has a bounding box within 1 cm of its own. So what stands on the ground or touches a wall is
/// none, nor is a sheet with an artificial rim.
/// What stands on a plane that reflects could be a whole too: with its mirror image it is a free object, and the field
/// is that of the four sequences with and without the plane before and after it, each the wave of the object without
/// its bottom, whose rims cancel between them. It is left to its edges: the four must all be there (three interactions
/// deep, found by an edge each), be one wave in the sums of a map, and count a wave once that the object hides both
/// before and after the plane; and at an absorbing plane (coefficient not ±1) the bottom's rim stays. Its edges err by
/// 2.5 dB behind it (case auto/box-on-the-ground).
/// Where the shadow boundary of something else cuts the object, its edges are taken one by one (object_fields).
/// An opening is a closed loop of free rims of one patch, corner to corner, in its plane to 1 mm, the surface on its
/// outer side, and no triangle but of that patch has a bounding box within 1 cm of its own. Holes in a sheet that is
/// an object are part of that object. A gap that runs to the outer rim of a sheet, or between two sheets, is none.
/// Inputs: a scene as build_scene leaves it; m. Returns: sheets and solids in the order of their first triangles, then
/// openings in the order of their first wedges. Error: none. Throws: nothing.
SmallObjects find_small_objects(const Scene& scene, double largest);

/// True if the straight way from a to b goes through a triangle of the object. Inputs: m. Error: that of rounding at
/// the rims.
bool crosses(const SmallObject& object, const Vec3& a, const Vec3& b);

/// The same for the object's triangles of one patch; patch = no_index: of any.
bool crosses(const SmallObject& object, std::uint32_t patch, const Vec3& a, const Vec3& b);

}  // namespace grimaldi
