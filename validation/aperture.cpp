#include "validation/aperture.h"

#include <cmath>
#include <cstddef>

#include "core/constants.h"

namespace grimaldi {
namespace {

bool contains(const Aperture::Loop& loop, const Aperture::Point& p) {
  bool inside = false;
  for (std::size_t i = 0, last = loop.size() - 1; i < loop.size(); last = i++) {
    const Aperture::Point &a = loop[last], &b = loop[i];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace

double area(const Aperture::Loop& loop) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    twice +=
        (loop[i].x - loop[0].x) * (loop[i + 1].y - loop[0].y) - (loop[i + 1].x - loop[0].x) * (loop[i].y - loop[0].y);
  return twice / 2;
}

double area(const Aperture& aperture) {
  double sum = 0;
  for (const Aperture::Loop& loop : aperture.loops) sum += area(loop);
  for (const Aperture::Disc& disc : aperture.discs) sum += disc.sign * pi * disc.radius * disc.radius;
  return sum;
}

bool contains(const Aperture& aperture, const Aperture::Point& point) {
  int layers = 0;
  for (const Aperture::Loop& loop : aperture.loops)
    if (contains(loop, point)) layers += area(loop) > 0 ? 1 : -1;
  for (const Aperture::Disc& disc : aperture.discs)
    if (std::hypot(point.x, point.y) < disc.radius) layers += disc.sign;
  return layers > 0;
}

double extent(const Aperture& aperture) {
  double most = 0;
  for (const Aperture::Loop& loop : aperture.loops)
    for (const Aperture::Point& p : loop) most = std::fmax(most, std::hypot(p.x, p.y));
  for (const Aperture::Disc& disc : aperture.discs) most = std::fmax(most, disc.radius);
  return most;
}

}  // namespace grimaldi
