#pragma once
// What surrounds an edge: the surfaces that touch it, by azimuth, and the sectors between them that are free.

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scenes/edge_table.h"
#include "scenes/surroundings.h"

namespace grimaldi {

/// A sector of free space about a point of an edge, between two surfaces (one surface, twice, about a free rim).
struct Sector {
  double from, to;  ///< azimuths in the frame of the section, rad; from < to ≤ from + 2π
  std::uint32_t triangle0, trianglen;
  double angle() const { return to - from; }
};

/// Sections across one edge. Azimuth 0 is `across`, π/2 is `up`.
class EdgeSection {
 public:
  EdgeSection(const Surroundings& surroundings, const EdgeTable& table, const Edge& edge);

  Vec3 start, direction;  ///< m; unit, from the edge's vertex0 to vertex1
  Vec3 across;            ///< unit, into the edge's first triangle
  Vec3 up;                ///< direction × across
  double length;          ///< m

  /// Angle of the side to which the first triangle's normal points, rad, of an edge of two triangles. Where these lie
  /// upon each other (within 0.1°), rounding would decide between 0 and 2π: it is 0 if a solid is beside them (two
  /// walls back to back), else 2π (a plate without thickness).
  double opening() const;
  /// Looks up which surfaces other than the edge's own come within `contact_distance`. To be called before what
  /// follows.
  void look_around();
  /// Places along the edge, m, ascending from 0 to `length`, between which the same surfaces are near.
  const std::vector<double>& breaks() const { return breaks_; }
  /// True if surfaces other than the edge's own are near at `t` m from the start.
  bool has_others(double t) const;
  /// True if all surfaces that touch the edge at `t` leave it in the direction of its first triangle, within
  /// `tolerance` rad.
  bool is_one_sided(double t, double tolerance) const;
  /// The free sectors of more than `least` rad at `t`, ascending. Their bounds are the surfaces that cross the circle
  /// of radius `contact_distance` about the point, with the direction in which each leaves it; a sector is free if
  /// neither bound turns the inside of a solid to it and its middle is not inside another. A surface alone leaves 2π
  /// free.
  void find_sectors(double t, double least, std::vector<Sector>& sectors) const;

 private:
  enum class Side : std::uint8_t { entering, sheet, leaving };  ///< a solid, as the azimuth grows
  struct Face {
    double place;      ///< azimuth on the circle, within [0, 2π) up to rounding
    double direction;  ///< azimuth of the surface away from the point, within π of `place`
    Side side;
    std::uint32_t triangle;
  };
  struct Neighbour {
    std::uint32_t triangle;
    double from, to;  ///< m along the edge
  };
  Vec3 in_frame(const Vec3& point) const;
  Face make_face(double place, double direction, std::uint32_t triangle) const;
  std::vector<Face> faces_at(double t) const;
  void add_crossings(double t, std::uint32_t triangle, std::vector<Face>& faces) const;

  const Surroundings& surroundings_;
  std::uint32_t vertex0_, vertex1_;
  std::vector<Face> own_;
  std::vector<Neighbour> neighbours_;
  std::vector<double> breaks_;
};

}  // namespace grimaldi
