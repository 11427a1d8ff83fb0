#include "propagation/small_opening.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scenes/shapes.h"

namespace grimaldi {
namespace {

constexpr std::size_t most_corners = 64;
constexpr double flat = 1e-3;  ///< m

struct Box {
  Vec3 low, high;
};

Box box_of(const std::array<Vec3, 3>& corner) {
  const auto& [a, b, c] = corner;
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

Box box_of(const std::vector<ObjectFace>& faces) {
  Box box = box_of(faces.front().corner);
  for (const ObjectFace& face : faces) {
    const Box one = box_of(face.corner);
    box.low = {std::min(box.low.x, one.low.x), std::min(box.low.y, one.low.y), std::min(box.low.z, one.low.z)};
    box.high = {std::max(box.high.x, one.high.x), std::max(box.high.y, one.high.y), std::max(box.high.z, one.high.z)};
  }
  return box;
}

/// The free rims of each patch that end at each corner.
using RimsAtCorner = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>>;

RimsAtCorner rims_at_corners(const Wedges& wedges) {
  RimsAtCorner rims;
  for (std::uint32_t w = 0; w < wedges.wedges.size(); ++w) {
    const Wedge& wedge = wedges.wedges[w];
    if (!wedge.free_rim) continue;
    rims[{wedge.patch0, wedge.vertex_start}].push_back(w);
    rims[{wedge.patch0, wedge.vertex_end}].push_back(w);
  }
  return rims;
}

/// A loop of rims and the corners where each of them begins on the way round.
struct Loop {
  std::vector<std::uint32_t> wedges, vertices;
};

/// The loop that begins with wedge `first`; empty if it does not close, has a corner of other than two rims or too many
/// corners.
Loop loop_from(const Wedges& wedges, const RimsAtCorner& rims, std::uint32_t first) {
  Loop loop;
  std::uint32_t here = first, vertex = wedges.wedges[first].vertex_start;
  do {
    const Wedge& wedge = wedges.wedges[here];
    loop.wedges.push_back(here);
    loop.vertices.push_back(vertex);
    vertex = wedge.vertex_start == vertex ? wedge.vertex_end : wedge.vertex_start;
    if (vertex == no_index || loop.wedges.size() > most_corners) return {};
    const auto& both = rims.at({wedge.patch0, vertex});
    if (both.size() != 2) return {};
    here = both[0] == here ? both[1] : both[0];
  } while (here != first);
  return loop;
}

/// The triangles that fill a loop; none unless it lies in its patch's plane with the surface on its outer side.
std::vector<ObjectFace> filling(const Scene& scene, const Loop& loop) {
  const Wedge& first = scene.wedges.wedges[loop.wedges[0]];
  const Vec3 origin = scene.vertices[loop.vertices[0]], x = first.along0, y = cross(first.normal0, x);
  std::vector<PlanPoint> outline;
  for (const std::uint32_t v : loop.vertices) {
    const Vec3 at = scene.vertices[v] - origin;
    if (std::abs(dot(at, first.normal0)) > flat) return {};
    outline.push_back({dot(at, x), dot(at, y)});
  }
  const bool counter_clockwise = signed_area(outline) > 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlanPoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Vec3& surface = scene.wedges.wedges[loop.wedges[i]].along0;
    // To the left of the way round lies the inside of a counter-clockwise loop.
    const double left = -(b.y - a.y) * dot(surface, x) + (b.x - a.x) * dot(surface, y);
    if ((left > 0) == counter_clockwise) return {};
  }
  std::vector<std::uint32_t> vertices = loop.vertices;
  if (!counter_clockwise) {
    std::reverse(outline.begin(), outline.end());
    std::reverse(vertices.begin(), vertices.end());
  }
  std::vector<ObjectFace> faces;
  for (const auto& [a, b, c] : fill(outline))
    faces.push_back({{scene.vertices[vertices[a]], scene.vertices[vertices[b]], scene.vertices[vertices[c]]},
                     first.material0,
                     first.patch0});
  return faces;
}

}  // namespace

SmallObject measured(ObjectKind kind, std::vector<ObjectFace> faces) {
  const Box box = box_of(faces);
  SmallObject object{0.5 * (box.low + box.high), 0, 0, kind, std::move(faces)};
  for (const ObjectFace& face : object.faces) {
    const auto& [a, b, c] = face.corner;
    object.area += 0.5 * norm(cross(b - a, c - a));
    for (const Vec3& p : face.corner) object.diameter = std::max(object.diameter, 2 * distance(object.centre, p));
  }
  return object;
}

bool stands_free(const Scene& scene, const SmallObject& object, const std::function<bool(std::uint32_t)>& own) {
  constexpr double gap = 0.01;
  const Box box = box_of(object.faces);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    const Box other = box_of({scene.vertices[a], scene.vertices[b], scene.vertices[c]});
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis)
      apart = apart || other.low[axis] > box.high[axis] + gap || other.high[axis] < box.low[axis] - gap;
    if (!apart && !own(t)) return false;
  }
  return true;
}

void add_small_openings(const Scene& scene, double largest, SmallObjects& found) {
  const auto& wedges = scene.wedges.wedges;
  const RimsAtCorner rims = rims_at_corners(scene.wedges);
  std::vector<bool> seen(wedges.size(), false);
  for (std::uint32_t w = 0; w < wedges.size(); ++w) {
    if (seen[w] || !wedges[w].free_rim || wedges[w].length > largest || wedges[w].vertex_start == no_index ||
        found.of_wedge[w] != no_index)
      continue;
    const Loop loop = loop_from(scene.wedges, rims, w);
    for (const std::uint32_t of_loop : loop.wedges) seen[of_loop] = true;
    if (loop.wedges.size() < 3) continue;
    std::vector<ObjectFace> faces = filling(scene, loop);
    if (faces.empty()) continue;
    SmallObject object = measured(ObjectKind::opening, std::move(faces));
    const auto own = [&](std::uint32_t t) { return scene.patches.triangle_patch[t] == object.faces[0].patch; };
    if (object.diameter > largest || !stands_free(scene, object, own)) continue;
    for (const std::uint32_t of_loop : loop.wedges)
      found.of_wedge[of_loop] = static_cast<std::uint32_t>(found.objects.size());
    found.objects.push_back(std::move(object));
  }
}

}  // namespace grimaldi
