#pragma once
// What the built-in scenes are made of: flat sheets, and buildings over a footprint.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "scenes/description.h"

namespace grimaldi {

/// A point of the plan, m.
struct PlanPoint {
  double x = 0, y = 0;
  friend constexpr bool operator==(const PlanPoint&, const PlanPoint&) = default;
};

/// A building with vertical walls that stands on z = 0 and has no floor.
struct Building {
  std::string name;
  std::vector<PlanPoint> outline;  ///< simple polygon, counter-clockwise, no three neighbours in line
  std::vector<PlanPoint>
      courtyard;      ///< open to the sky; empty, or as many points as `outline`, convex, parallel side by side
  double height = 0;  ///< of the eaves, m, > 0
  double rise = 0;    ///< of the ridge above the eaves, m; > 0 only over a rectangle: ridge along its longer side
  std::string wall_material, roof_material;
};

/// Area of the polygon, m², positive if counter-clockwise. Shoelace formula.
double signed_area(const std::vector<PlanPoint>& polygon);

/// The triangles that fill a simple polygon, by the numbers of its corners, counter-clockwise: ear clipping (Meisters
/// 1975: a simple polygon has at least two ears), shortest diagonal first. Inputs: corners counter-clockwise, no three
/// neighbours in line. Returns: corners − 2 triangles; none if the outline is not simple.
std::vector<std::array<std::uint32_t, 3>> fill(const std::vector<PlanPoint>& outline);

/// Appends two meshes, "NAME walls" (gables included) and "NAME roof", with outward normals. Corners that the two share
/// have the same bits, so the pair is closed but for its foot: every edge above z = 0 has two triangles. A flat roof of
/// a simple outline is cut by ear clipping, shortest diagonal first. Expects what `Building` says.
void append_building(const Building& building, SceneDescription& scene);

/// Which sides of a sheet are cuts through something that goes on: their edges are marked as artificial.
struct SheetCuts {
  bool low_u = false, high_u = false, low_v = false, high_v = false;
};

/// Appends the flat sheet of points origin + u a + v b for u and v in the grids `us`, `vs` (increasing, at least two
/// values each): two triangles for each cell, normal along a × b.
void append_sheet(const std::vector<double>& us, const std::vector<double>& vs, const Vec3& origin, const Vec3& a,
                  const Vec3& b, const SheetCuts& cuts, MeshDescription& mesh);

/// The fewest equal pieces of at most `longest` m between `from` and `to`: their ends, `from` and `to` exact. Expects
/// from < to.
std::vector<double> equal_cuts(double from, double to, double longest);

/// The same between −half and half, symmetric to the last bit and with 0 among them.
std::vector<double> symmetric_cuts(double half, double longest);

/// The ground mesh over low … high at z = 0, normal up, in cells of at most 150 m; its rim is artificial.
MeshDescription ground_sheet(const PlanPoint& low, const PlanPoint& high, const std::string& material);

}  // namespace grimaldi
