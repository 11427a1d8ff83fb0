#include "scenes/wedge_sector.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

// Surfaces this near on the circle (10 nm apart at 1 cm; coordinates of 1e6 m round to 0.1 nm) are taken as one place,
// rad.
constexpr double same_place = 1e-6;
constexpr double same_break = 1e-6;  // m
// A surface that only meets an end of the edge comes within reach for about the contact distance; up to this
// length (a slope of 11° against the edge) it belongs to the corner and does not shorten the edge, m.
constexpr double corner_reach = 5 * contact_distance;

// Two triangles of one edge that lie upon each other: vertices rounded to 0.1 mm, faces from 6 cm, rad.
constexpr double folded = 0.1 * pi / 180;

/// `azimuth` plus the multiple of 2π that brings it within π of `centre`.
double near_to(double azimuth, double centre) { return azimuth - 2 * pi * std::round((azimuth - centre) / (2 * pi)); }

/// The range of t (third coordinate) of the part of a triangle in the frame within |x|, |y| ≤ reach, 0 ≤ t ≤ length.
/// False if there is none.
bool clip(const std::array<Vec3, 3>& corners, double reach, double length, double& from, double& to) {
  std::array<Vec3, 9> polygon, clipped;
  std::size_t count = 3;
  std::copy(corners.begin(), corners.end(), polygon.begin());
  const auto cut = [&](auto inside) {  // keeps inside(p) ≥ 0, which is linear in p
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % count];
      const double ia = inside(a), ib = inside(b);
      if (ia >= 0) clipped[kept++] = a;
      if ((ia >= 0) != (ib >= 0)) clipped[kept++] = a + ia / (ia - ib) * (b - a);
    }
    polygon = clipped;
    count = kept;
  };
  cut([&](const Vec3& p) { return reach - p.x; });
  cut([&](const Vec3& p) { return reach + p.x; });
  cut([&](const Vec3& p) { return reach - p.y; });
  cut([&](const Vec3& p) { return reach + p.y; });
  cut([&](const Vec3& p) { return p.z; });
  cut([&](const Vec3& p) { return length - p.z; });
  if (count == 0) return false;
  from = to = polygon[0].z;
  for (std::size_t i = 1; i < count; ++i) {
    from = std::min(from, polygon[i].z);
    to = std::max(to, polygon[i].z);
  }
  return true;
}

}  // namespace

EdgeSection::EdgeSection(const Surroundings& surroundings, const EdgeTable& table, const Edge& edge)
    : surroundings_(surroundings), vertex0_(edge.vertex0), vertex1_(edge.vertex1) {
  const Surroundings& s = surroundings_;
  start = s.vertices[edge.vertex0];
  const Vec3 along = s.vertices[edge.vertex1] - start;
  length = norm(along);
  direction = along / length;
  for (std::uint32_t i = edge.begin; i < edge.end; ++i) {
    const EdgeUse& use = table.uses[i];
    // In the triangle's plane and across the edge: more exact than from the third corner, which may be far along the
    // edge.
    const Vec3 in_face = normalized(cross(s.normal[use.triangle], direction)) * (use.forward ? 1.0 : -1.0);
    if (i == edge.begin) {
      across = in_face;
      up = cross(direction, across);
    }
    double azimuth = i == edge.begin ? 0 : std::atan2(dot(in_face, up), dot(in_face, across));
    if (azimuth < 0) azimuth += 2 * pi;
    own_.push_back(make_face(azimuth, azimuth, use.triangle));
  }
  // Two triangles of opposite winding: no inside is known here.
  if (edge.valence() == 2 && table.uses[edge.begin].forward == table.uses[edge.begin + 1].forward) {
    own_[0].side = own_[1].side = Side::sheet;
  }
}

Vec3 EdgeSection::in_frame(const Vec3& point) const {
  const Vec3 p = point - start;
  return {dot(p, across), dot(p, up), dot(p, direction)};
}

EdgeSection::Face EdgeSection::make_face(double place, double direction_azimuth, std::uint32_t triangle) const {
  Face face{place, direction_azimuth, Side::sheet, triangle};
  if (surroundings_.solid[triangle]) {
    const Vec3& n = surroundings_.normal[triangle];
    face.side = dot(n, up) * std::cos(place) > dot(n, across) * std::sin(place) ? Side::leaving : Side::entering;
  }
  return face;
}

double EdgeSection::opening() const {
  const double place = own_[1].place;
  if (std::min(place, 2 * pi - place) < folded) {
    const Vec3 beside = start + 0.5 * length * direction + contact_distance * across;
    const Vec3 aside = contact_distance * up;
    return surroundings_.is_inside(beside + aside) || surroundings_.is_inside(beside - aside) ? 0 : 2 * pi;
  }
  return dot(surroundings_.normal[own_[0].triangle], up) > 0 ? place : 2 * pi - place;
}

void EdgeSection::look_around() {
  thread_local std::vector<std::uint32_t> near;
  const Surroundings& s = surroundings_;
  const Vec3 end = s.vertices[vertex1_];
  const Vec3 margin{contact_distance, contact_distance, contact_distance};
  const Vec3 low{std::min(start.x, end.x), std::min(start.y, end.y), std::min(start.z, end.z)};
  const Vec3 high{std::max(start.x, end.x), std::max(start.y, end.y), std::max(start.z, end.z)};
  s.tree.find(low - margin, high + margin, near);

  breaks_ = {0, length};
  for (const std::uint32_t triangle : near) {
    const auto& t = s.triangles[triangle];
    if (std::any_of(own_.begin(), own_.end(), [&](const Face& f) { return f.triangle == triangle; })) continue;
    Neighbour n{triangle, 0, 0};
    if (!clip({in_frame(s.vertices[t[0]]), in_frame(s.vertices[t[1]]), in_frame(s.vertices[t[2]])}, contact_distance,
              length, n.from, n.to)) {
      continue;
    }
    const bool at_end =
        std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v == vertex0_ || v == vertex1_; });
    if (at_end && n.to - n.from < corner_reach) continue;
    neighbours_.push_back(n);
    breaks_.push_back(n.from);
    breaks_.push_back(n.to);
  }
  std::sort(breaks_.begin(), breaks_.end());
  // Breaks that differ by rounding alone are one; the ends stay exact.
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), [](double a, double b) { return b - a < same_break; }),
                breaks_.end());
  breaks_.back() = length;
}

bool EdgeSection::has_others(double t) const {
  return std::any_of(neighbours_.begin(), neighbours_.end(),
                     [&](const Neighbour& n) { return n.from <= t && t <= n.to; });
}

void EdgeSection::add_crossings(double t, std::uint32_t triangle, std::vector<Face>& faces) const {
  const auto& corners = surroundings_.triangles[triangle];
  std::array<Vec3, 2> ends;  // of the line in which the triangle cuts the plane at t
  std::size_t count = 0;
  for (int k = 0; k < 3; ++k) {
    // From the lower vertex index, so that neighbours find the same point on their common side.
    const std::uint32_t v = corners[k], w = corners[(k + 1) % 3];
    const Vec3 a = in_frame(surroundings_.vertices[std::min(v, w)]),
               b = in_frame(surroundings_.vertices[std::max(v, w)]);
    if ((a.z >= t) != (b.z >= t) && count < 2) ends[count++] = a + (t - a.z) / (b.z - a.z) * (b - a);
  }
  if (count < 2) return;

  const Vec3 &p = ends[0], q = ends[1] - ends[0];
  const double a = q.x * q.x + q.y * q.y, b = p.x * q.x + p.y * q.y;
  const double c = p.x * p.x + p.y * p.y - contact_distance * contact_distance;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return;
  for (const double sign : {-1.0, 1.0}) {  // the line enters the circle at −, leaves it at +
    const double at = (-b + sign * std::sqrt(discriminant)) / a;
    if (!(at >= 0 && at < 1)) continue;
    double place = std::atan2(p.y + at * q.y, p.x + at * q.x);
    if (place < 0) place += 2 * pi;
    if (place > 2 * pi - same_place) place -= 2 * pi;
    faces.push_back(make_face(place, near_to(std::atan2(sign * q.y, sign * q.x), place), triangle));
  }
}

std::vector<EdgeSection::Face> EdgeSection::faces_at(double t) const {
  std::vector<Face> faces = own_;
  for (Face& face : faces) {
    if (face.place > 2 * pi - same_place) face.place -= 2 * pi, face.direction -= 2 * pi;
  }
  for (const Neighbour& n : neighbours_) {
    if (n.from <= t && t <= n.to) add_crossings(t, n.triangle, faces);
  }
  return faces;
}

bool EdgeSection::is_one_sided(double t, double tolerance) const {
  const std::vector<Face> faces = faces_at(t);
  return std::all_of(faces.begin(), faces.end(),
                     [&](const Face& f) { return std::abs(near_to(f.direction, 0)) < tolerance; });
}

void EdgeSection::find_sectors(double t, double least, std::vector<Sector>& sectors) const {
  std::vector<Face> faces = faces_at(t);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.place != b.place ? a.place < b.place : a.triangle < b.triangle;
  });
  // At one place solids are entered first: walls back to back leave no gap, a plate without thickness is left on both
  // sides.
  for (std::size_t i = 1; i < faces.size(); ++i) {
    for (std::size_t j = i;
         j > 0 && faces[j].place - faces[j - 1].place < same_place && faces[j].side < faces[j - 1].side; --j) {
      std::swap(faces[j], faces[j - 1]);
    }
  }

  sectors.clear();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face &first = faces[i], &last = faces[(i + 1) % faces.size()];
    const double turn = i + 1 == faces.size() ? 2 * pi : 0;
    Sector sector{first.direction, std::min(last.direction + turn, first.direction + 2 * pi), first.triangle,
                  last.triangle};
    if (sector.angle() <= least) continue;
    if (faces.size() > 1 && (first.side == Side::entering || last.side == Side::leaving)) continue;
    const double middle = 0.5 * (first.place + last.place + turn);
    const Vec3 out = std::cos(middle) * across + std::sin(middle) * up;
    if (!surroundings_.is_inside(start + t * direction + contact_distance * out)) sectors.push_back(sector);
  }
}

}  // namespace grimaldi
