#pragma once
// Small meshes for the tests of scenes.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/constants.h"
#include "scenes/description.h"

namespace grimaldi::solids {

using Ring = std::vector<std::array<double, 2>>;

inline MeshDescription empty_mesh(const std::string& material) {
  MeshDescription mesh;
  mesh.name = material;
  mesh.material = material;
  return mesh;
}

/// Vertices of its own for every face, as many files have it.
inline void add_quad(MeshDescription& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
  mesh.triangles.push_back({n, n + 1, n + 2});
  mesh.triangles.push_back({n, n + 2, n + 3});
}

/// The walls of a prism over a counterclockwise ring, normals outward.
inline void add_walls(MeshDescription& mesh, const Ring& ring, double low, double high) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &p = ring[i], &q = ring[(i + 1) % ring.size()];
    add_quad(mesh, {p[0], p[1], low}, {q[0], q[1], low}, {q[0], q[1], high}, {p[0], p[1], high});
  }
}

/// A horizontal fan about the ring's corner `hub`, which must see all others; upward or downward.
inline void add_lid(MeshDescription& mesh, const Ring& ring, double z, bool upward, std::size_t hub = 0) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size()), count = static_cast<std::uint32_t>(ring.size());
  for (const auto& p : ring) mesh.vertices.push_back({p[0], p[1], z});
  const auto h = static_cast<std::uint32_t>(hub);
  for (std::uint32_t k = 1; k + 1 < count; ++k) {
    const std::uint32_t a = n + (h + k) % count, b = n + (h + k + 1) % count;
    if (upward) {
      mesh.triangles.push_back({n + h, a, b});
    } else {
      mesh.triangles.push_back({n + h, b, a});
    }
  }
}

inline Ring rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

inline MeshDescription prism(const Ring& ring, double low, double high, bool floor = true, std::size_t hub = 0,
                             const std::string& material = "concrete") {
  MeshDescription mesh = empty_mesh(material);
  add_walls(mesh, ring, low, high);
  add_lid(mesh, ring, high, true, hub);
  if (floor) add_lid(mesh, ring, low, false, hub);
  return mesh;
}

inline MeshDescription box(const Vec3& low, const Vec3& high, bool floor = true,
                           const std::string& material = "concrete") {
  return prism(rectangle(low.x, low.y, high.x, high.y), low.z, high.z, floor, 0, material);
}

inline MeshDescription ground(double half_width, double z = 0, const std::string& material = "wet_ground") {
  MeshDescription mesh = empty_mesh(material);
  add_lid(mesh, rectangle(-half_width, -half_width, half_width, half_width), z, true);
  return mesh;
}

inline SceneDescription scene(std::vector<MeshDescription> meshes) {
  SceneDescription description;
  description.name = "test";
  description.meshes = std::move(meshes);
  return description;
}

/// Every triangle cut in four at the middles of its sides.
inline SceneDescription subdivided(SceneDescription description) {
  for (MeshDescription& mesh : description.meshes) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& t : mesh.triangles) {
      const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
      for (int k = 0; k < 3; ++k) {
        mesh.vertices.push_back(0.5 * (mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]));
      }
      triangles.insert(triangles.end(), {{t[0], n, n + 2}, {n, t[1], n + 1}, {n + 2, n + 1, t[2]}, {n, n + 1, n + 2}});
    }
    mesh.triangles = triangles;
  }
  return description;
}

/// Turned about the vertical by `degrees`, then moved.
inline SceneDescription moved(SceneDescription description, double degrees, const Vec3& shift) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  for (MeshDescription& mesh : description.meshes) {
    for (Vec3& p : mesh.vertices) p = Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z} + shift;
  }
  return description;
}

}  // namespace grimaldi::solids
