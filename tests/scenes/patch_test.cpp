#include "scenes/patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scenes/mesh_repair.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

using solids::box;
using solids::scene;

struct Found {
  RepairedMesh mesh;
  Patches patches;
};

/// Patches with every mesh a material of its own.
Found find(const SceneDescription& description) {
  Found found{repair(description), {}};
  found.patches = find_patches(found.mesh.vertices, found.mesh.triangles, found.mesh.triangle_mesh);
  return found;
}

/// Squares of 10 m in z = 0 … : a shift and a slope (degrees, about y) of the second.
SceneDescription two_squares(const Vec3& shift, double slope = 0) {
  MeshDescription mesh = solids::empty_mesh("wood");
  solids::add_lid(mesh, solids::rectangle(0, 0, 10, 10), 0, true);
  solids::add_lid(mesh, solids::rectangle(0, 0, 10, 10), 0, true);
  for (std::size_t i = 4; i < 8; ++i) {
    mesh.vertices[i].z += std::tan(slope * pi / 180) * mesh.vertices[i].x;
    mesh.vertices[i] += shift;
  }
  return scene({mesh});
}

TEST(Patch, ABoxHasSixWithTheirPlanes) {
  const Found found = find(scene({box({1, 2, 3}, {5, 7, 9})}));
  ASSERT_EQ(found.patches.patches.size(), 6u);
  double area = 0;
  for (const Patch& p : found.patches.patches) {
    area += p.area;
    EXPECT_NEAR(norm(p.normal), 1, 1e-15);
    EXPECT_NEAR(dot(p.normal, 0.5 * (p.low + p.high)), p.offset, 1e-14 * 9);  // rounding of coordinates up to 9
    EXPECT_GT(p.offset - dot(p.normal, {3, 4.5, 6}), 1.9) << "outward: the centre lies behind every face";
  }
  EXPECT_NEAR(area, 2 * (4 * 5 + 5 * 6 + 6 * 4), 1e-12);
  for (std::size_t t = 0; t < found.mesh.triangles.size(); ++t) {
    const Patch& p = found.patches.patches[found.patches.triangle_patch[t]];
    for (const auto v : found.mesh.triangles[t]) EXPECT_NEAR(dot(p.normal, found.mesh.vertices[v]), p.offset, 1e-13);
  }
}

TEST(Patch, NumbersAreRanksOfTheSmallestTriangle) {
  const Found found = find(scene({box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1})}));
  std::uint32_t next = 0;
  for (const std::uint32_t p : found.patches.triangle_patch) {
    ASSERT_LE(p, next);
    next = std::max(next, p + 1);
  }
  EXPECT_EQ(next, found.patches.patches.size());
}

TEST(Patch, CuttingTrianglesInFourChangesNothing) {
  const SceneDescription whole = scene({box({0, 0, 0}, {4, 5, 6}), box({4, 0, 0}, {9, 5, 3})});
  const Found a = find(whole), b = find(solids::subdivided(solids::subdivided(whole)));
  ASSERT_EQ(a.patches.patches.size(), b.patches.patches.size());
  EXPECT_EQ(16 * a.mesh.triangles.size(), b.mesh.triangles.size());
  for (std::size_t i = 0; i < a.patches.patches.size(); ++i) {
    const Patch &p = a.patches.patches[i], &q = b.patches.patches[i];
    EXPECT_NEAR(norm(p.normal - q.normal), 0, 1e-14);
    EXPECT_NEAR(p.area, q.area, 1e-12);
    EXPECT_EQ(p.low, q.low);
    EXPECT_EQ(p.high, q.high);
  }
}

TEST(Patch, TouchingAndOverlappingCoplanarSurfacesAreOne) {
  EXPECT_EQ(find(two_squares({10, 0, 0})).patches.patches.size(), 1u);       // side by side
  EXPECT_EQ(find(two_squares({3.3, 4.4, 0})).patches.patches.size(), 1u);    // overlapping, no vertex shared
  EXPECT_EQ(find(two_squares({10, 5, 0})).patches.patches.size(), 1u);       // along a part of one side
  EXPECT_EQ(find(two_squares({10.0005, 5, 0})).patches.patches.size(), 1u);  // 0.5 mm apart
  EXPECT_EQ(find(two_squares({3, 4, 0.0009})).patches.patches.size(), 1u);   // laid upon each other
  EXPECT_EQ(find(two_squares({10.0015, 5, 0})).patches.patches.size(), 2u);  // 1.5 mm apart
  EXPECT_EQ(find(two_squares({3, 4, 0.0011})).patches.patches.size(), 2u);   // another plane
  EXPECT_EQ(find(two_squares({3, 4, 0}, 0.1)).patches.patches.size(), 2u);  // 10 m × tan 0.1° = 17 mm out of the plane
  EXPECT_EQ(find(two_squares({10, 0, 0}, 0.3)).patches.patches.size(), 2u);  // a ridge
}

TEST(Patch, MaterialsAreKeptApartAndBothWindingsGoTogether) {
  SceneDescription apart = two_squares({10, 0, 0});
  apart.meshes.push_back(apart.meshes[0]);
  for (Vec3& p : apart.meshes[1].vertices) p.y += 10;
  EXPECT_EQ(find(apart).patches.patches.size(), 2u);

  std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Patches both = find_patches(vertices, {{0, 1, 2}, {0, 3, 2}}, {0, 0});
  ASSERT_EQ(both.patches.size(), 1u);
  EXPECT_EQ(both.patches[0].normal, (Vec3{0, 0, 1}));  // the first of equals decides
  EXPECT_NEAR(both.patches[0].area, 1, 1e-15);
}

TEST(Patch, ACurveIsCutIntoItsTriangles) {
  // A strip whose slope grows by 0.15° every 0.3 m: each step is coplanar with the next (0.8 mm), the whole is not.
  MeshDescription mesh = solids::empty_mesh("metal");
  double x = 0, z = 0;
  for (int i = 0; i < 30; ++i) {
    const double slope = 0.15 * i * pi / 180;
    const double nx = x + 0.3 * std::cos(slope), nz = z + 0.3 * std::sin(slope);
    solids::add_quad(mesh, {x, 0, z}, {nx, 0, nz}, {nx, 0.5, nz}, {x, 0.5, z});
    x = nx;
    z = nz;
  }
  const Found found = find(scene({mesh}));
  EXPECT_EQ(found.patches.patches.size(), found.mesh.triangles.size());
  for (std::size_t t = 0; t < found.mesh.triangles.size(); ++t) EXPECT_EQ(found.patches.triangle_patch[t], t);
}

TEST(Patch, FarFromTheOriginNothingChanges) {
  const SceneDescription whole = scene({box({0, 0, 0}, {4, 5, 6}), box({4, 0, 0}, {9, 5, 3})});
  const Found a = find(whole), b = find(solids::moved(whole, 30, {5e5, -5e5, 100}));
  EXPECT_EQ(a.patches.triangle_patch, b.patches.triangle_patch);
  for (std::size_t t = 0; t < b.mesh.triangles.size(); ++t) {
    const Patch& p = b.patches.patches[b.patches.triangle_patch[t]];
    // One rounding of a product of coordinates of 5e5 m is 1e-10 m; a few of them add.
    for (const auto v : b.mesh.triangles[t]) EXPECT_NEAR(dot(p.normal, b.mesh.vertices[v]), p.offset, 1e-9);
  }
}

}  // namespace
}  // namespace grimaldi
