#pragma once
// Straight edges at which waves diffract, found over the whole scene, across materials and objects.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/patch.h"

namespace grimaldi {

inline constexpr std::uint32_t no_index = 0xffffffffu;

/// A straight edge between two faces (or the free rim of a thin screen) with its exterior sector.
/// Frame: azimuth φ about the edge is measured from face 0 through the exterior: φ = atan2(p·normal0, p·along0) in [0,
/// 2π); face 0 at φ = 0, face n at φ = exterior_angle. (along0, normal0, direction) is right-handed.
struct Wedge {
  Vec3 start;                    ///< first end, m
  Vec3 direction;                ///< unit vector along the edge
  double length;                 ///< m
  Vec3 along0;                   ///< unit, in face 0, perpendicular to the edge, away from it
  Vec3 normal0;                  ///< unit, normal of face 0 into the exterior
  double exterior_angle;         ///< rad, nπ; 2π for a free rim
  std::uint32_t patch0, patchn;  ///< faces (equal for a free rim)
  std::uint32_t material0, materialn;
  std::uint32_t vertex_start, vertex_end;  ///< corners at its ends: welded vertices where another wedge ends too;
                                           ///< no_index where it ends alone
  /// That end stands upright on a face: mirrored in it the edge goes on, and no wave leaves the end.
  bool stands_at_start = false, stands_at_end = false;
  bool free_rim = false;
  double sin_exterior = 0, cos_exterior = 1, sin_half = 0, cos_half = -1;  ///< of the exterior angle and of its half
  Vec3 normaln() const {
    return sin_exterior * along0 - cos_exterior * normal0;
  }                                                                         ///< unit, of face n, into the exterior
  Vec3 bisector() const { return cos_half * along0 + sin_half * normal0; }  ///< unit, of the exterior
  Vec3 end() const { return start + length * direction; }
  Vec3 point(double t) const { return start + t * direction; }  ///< t in m
};

/// Count and length, m, of a class of edges.
struct EdgeTally {
  std::size_t count = 0;
  double length = 0;
};

struct WedgeReport {
  /// Edges of exactly two triangles, exterior angle above 185°, one material; as full wedges.
  EdgeTally within_material;
  EdgeTally across_materials;  ///< the same between two materials
  EdgeTally free_rims;         ///< edges of one triangle that lie on no other face and do not end the ground
  EdgeTally concave;           ///< edges of exactly two triangles, exterior angle below 175°
  EdgeTally higher;            ///< edges of three and more triangles
  EdgeTally filled;            ///< length of the above wedges whose exterior is partly filled by another solid
  EdgeTally propagating;       ///< what `wedges` holds
};

struct Wedges {
  std::vector<Wedge> wedges;  ///< the edges that diffract: exterior (free) angle above 185°, not artificial
  WedgeReport report;
  /// Wedges at the rim of each triangle: triangle_wedge[triangle_wedge_begin[t] … triangle_wedge_begin[t+1]).
  std::vector<std::uint32_t> triangle_wedge_begin, triangle_wedge;
};

/// Finds them. Method: own sorted edge table over the welded vertices, any valence.
///
/// * Two triangles, coplanar (|exterior − 180°| ≤ 5°): no wedge; exterior < 175°: concave, counted; > 185°: wedge.
///   Two that lie upon each other (within 0.1°): exterior 0 if a solid is beside them (party walls), else 2π (a plate
///   without thickness).
/// * Three and more triangles: half-faces sorted around the edge by angle; sectors between neighbours that are exterior
///   on both sides (by the faces' outward normals) are wedges of that sector if above 185°. Of sheets, which have no
///   inside, both sides are exterior; so also at edges of two triangles.
/// * One triangle: a free rim (half-plane, exterior 2π) unless it lies on another face (T-junction, the foot of a wall
///   on the ground) within 1 cm for that part of its length, or is artificial, or ends the ground (a level sheet
///   with something above it that lies lowest or spans half of the scene: the file ends there, not the world). Where it
///   lies on another face, the free sectors between both are wedges if above 185° (a roof on walls cut elsewhere).
/// * A wedge whose exterior sector is partly filled by another solid (party wall, flush façade; sampled along the edge
///   every 0.5 m and wherever a surface begins or ends, changes refined to 1 mm) is cut into pieces, each with the
///   sector that is free (faces, patches and materials those that bound the free sector); a piece below 185° is left
///   out, and so is what lies inside a solid or below ground.
/// * Collinear pieces of one edge (same line to 1 mm, same two patches, abutting) are merged into one; so is an edge
///   found twice, on two solids that touch.
///
/// Artificial edges are counted nowhere. The report counts before the filling is looked at, and before merging for
/// `count`; lengths are sums over edges. The order of `wedges` depends on the scene alone.
/// Valid: triangles without repeated corners and with area, as `repair` leaves them, wound outward.
Wedges find_wedges(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const std::vector<std::uint32_t>& triangle_material, const Patches& patches,
                   const std::vector<std::array<std::uint32_t, 2>>& artificial_edges);

}  // namespace grimaldi
