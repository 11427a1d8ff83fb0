#pragma once
// A plane opening in an opaque screen, as the references of apertures take it.

#include <vector>

namespace grimaldi {

/// The opening = the union of loops and discs, which do not overlap, less those of sign −1, which lie inside others.
/// Lengths in any one unit (that of 1/k).
struct Aperture {
  struct Point {
    double x, y;
  };
  /// A simple polygon, counter-clockwise (clockwise: a hole). The last point is joined to the first.
  using Loop = std::vector<Point>;
  /// A disc about the origin.
  struct Disc {
    double radius;
    int sign = 1;
  };
  std::vector<Loop> loops;
  std::vector<Disc> discs;
};

/// Area of the opening, unit².   Error: a few ulp of the sum of the areas of its parts.
double area(const Aperture& aperture);
/// Signed area of one loop, > 0 when it runs counter-clockwise.
double area(const Aperture::Loop& loop);
/// Whether the point lies in the opening; points on the rim may fall either way.
bool contains(const Aperture& aperture, const Aperture::Point& point);
/// Largest distance of a point of the rim from the origin, unit of length.
double extent(const Aperture& aperture);

}  // namespace grimaldi
