#include "propagation/small_object.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/constants.h"
#include "propagation/small_opening.h"

namespace grimaldi {
namespace {

constexpr std::size_t most_triangles = 256;
constexpr double flat = 1e-3;             ///< m
constexpr double sharp = 185 * pi / 180;  ///< exterior angle of a wedge
constexpr double whole = 0.01;            ///< of a length

struct Corners {
  Vec3 a, b, c;
  Vec3 normal() const { return cross(b - a, c - a); }  ///< twice the area
};

Corners corners(const Scene& scene, std::uint32_t triangle) {
  const auto& [a, b, c] = scene.triangles[triangle];
  return {scene.vertices[a], scene.vertices[b], scene.vertices[c]};
}

/// Components by shared vertices, in the order of their first triangles.
std::vector<std::vector<std::uint32_t>> components(const Scene& scene) {
  std::vector<std::uint32_t> root(scene.vertices.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b, c] : scene.triangles) {
    root[find(b)] = find(a);
    root[find(c)] = find(a);
  }
  std::vector<std::uint32_t> number(root.size(), no_index);
  std::vector<std::vector<std::uint32_t>> parts;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    std::uint32_t& part = number[find(scene.triangles[t][0])];
    if (part == no_index) {
      part = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    parts[part].push_back(t);
  }
  return parts;
}

/// Sheet, solid or neither; for both the length of the edges that should diffract.
struct Shape {
  bool sheet = false, solid = false;
  double edges = 0;
};

Shape shape_of(const Scene& scene, const std::vector<std::uint32_t>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> sides;
  for (const std::uint32_t t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = scene.triangles[t][i], b = scene.triangles[t][(i + 1) % 3];
      sides[std::minmax(a, b)].push_back(t);
    }
  Shape shape{true, true, 0};
  for (const std::uint32_t t : triangles) {
    if (!shape.sheet && !shape.solid) return shape;
    const Corners face = corners(scene, t);
    const Vec3 normal = normalized(face.normal());
    for (const std::uint32_t other : triangles)
      for (const std::uint32_t v : scene.triangles[other]) {
        const double before = dot(normal, scene.vertices[v] - face.a);
        if (before > flat) shape.sheet = shape.solid = false;
        if (before < -flat) shape.sheet = false;
      }
  }
  if (shape.sheet) shape.solid = false;
  for (const auto& [ends, faces] : sides) {
    const double length = distance(scene.vertices[ends.first], scene.vertices[ends.second]);
    if (shape.sheet) {
      if (faces.size() > 2) shape.sheet = false;
      if (faces.size() == 1) shape.edges += length;
    } else {
      if (faces.size() != 2) {
        shape.solid = false;
        break;
      }
      const Vec3 n0 = normalized(corners(scene, faces[0]).normal()), n1 = normalized(corners(scene, faces[1]).normal());
      if (std::acos(std::clamp(dot(n0, n1), -1.0, 1.0)) > sharp - pi) shape.edges += length;
    }
  }
  return shape;
}

/// The object of these triangles with its measures.
SmallObject object_of(const Scene& scene, const std::vector<std::uint32_t>& triangles, ObjectKind kind) {
  std::vector<ObjectFace> faces;
  for (const std::uint32_t t : triangles) {
    const Corners face = corners(scene, t);
    faces.push_back({{face.a, face.b, face.c}, scene.triangle_material[t], scene.patches.triangle_patch[t]});
  }
  return measured(kind, std::move(faces));
}

}  // namespace

SmallObjects find_small_objects(const Scene& scene, double largest) {
  SmallObjects found;
  const Wedges& wedges = scene.wedges;
  found.of_wedge.assign(wedges.wedges.size(), no_index);
  constexpr std::uint32_t several = no_index - 1;
  std::vector<std::uint32_t> component_of(wedges.wedges.size(), no_index);
  const auto parts = components(scene);
  for (std::uint32_t part = 0; part < parts.size(); ++part)
    for (const std::uint32_t t : parts[part])
      for (std::uint32_t i = wedges.triangle_wedge_begin[t]; i < wedges.triangle_wedge_begin[t + 1]; ++i) {
        std::uint32_t& component = component_of[wedges.triangle_wedge[i]];
        component = component == no_index || component == part ? part : several;
      }
  std::vector<std::vector<std::uint32_t>> wedges_of(parts.size());
  for (std::uint32_t w = 0; w < component_of.size(); ++w)
    if (component_of[w] < several) wedges_of[component_of[w]].push_back(w);
  for (std::uint32_t part = 0; part < parts.size(); ++part) {
    if (parts[part].size() > most_triangles || wedges_of[part].empty()) continue;
    SmallObject object = object_of(scene, parts[part], ObjectKind::solid);
    if (object.diameter > largest) continue;
    const Shape shape = shape_of(scene, parts[part]);
    if (!shape.sheet && !shape.solid) continue;
    if (shape.sheet) object.kind = ObjectKind::sheet;
    double length = 0;
    bool rims = true;
    for (const std::uint32_t w : wedges_of[part]) {
      length += wedges.wedges[w].length;
      rims = rims && wedges.wedges[w].free_rim == shape.sheet;
    }
    if (!rims || std::abs(length - shape.edges) > whole * shape.edges) continue;
    const auto own = [&](std::uint32_t t) { return std::binary_search(parts[part].begin(), parts[part].end(), t); };
    if (!stands_free(scene, object, own)) continue;
    for (const std::uint32_t w : wedges_of[part]) found.of_wedge[w] = static_cast<std::uint32_t>(found.objects.size());
    found.objects.push_back(std::move(object));
  }
  add_small_openings(scene, largest, found);
  return found;
}

bool crosses(const SmallObject& object, const Vec3& a, const Vec3& b) { return crosses(object, no_index, a, b); }

bool crosses(const SmallObject& object, std::uint32_t patch, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  return std::any_of(object.faces.begin(), object.faces.end(), [&](const ObjectFace& face) {
    if (patch != no_index && face.patch != patch) return false;
    // Signed volumes over the three sides: the line passes inside if they agree; the ends lie on both sides.
    const auto& [p, q, r] = face.corner;
    const Vec3 normal = cross(q - p, r - p);
    if (dot(normal, a - p) * dot(normal, b - p) > 0) return false;
    const double u = dot(way, cross(q - a, r - a)), v = dot(way, cross(r - a, p - a)),
                 w = dot(way, cross(p - a, q - a));
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  });
}

}  // namespace grimaldi
