#include "scenes/patch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "core/contract.h"
#include "scenes/triangle_tree.h"

namespace grimaldi {
namespace {

constexpr double touch = 1e-3;                       // m; see find_patches
constexpr double plane_tolerance = 1e-3;             // m, of a smaller triangle's corners from the larger one's plane
constexpr double drift = 2e-3;                       // m, of a patch's vertices from its plane
constexpr double normal_tolerance = 0.2 * pi / 180;  // rad

struct Surface {
  const std::vector<Vec3>& vertices;
  const std::vector<std::array<std::uint32_t, 3>>& triangles;
  std::vector<Vec3> normal;  // unit
  std::vector<double> area;
  const Vec3& corner(std::uint32_t triangle, int k) const { return vertices[triangles[triangle][k]]; }
};

bool share_vertex(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t v) { return v == b[0] || v == b[1] || v == b[2]; });
}

bool coplanar(const Surface& s, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t larger = s.area[a] >= s.area[b] ? a : b, smaller = larger == a ? b : a;
  const Vec3& n = s.normal[larger];
  if (norm2(cross(n, s.normal[smaller])) > normal_tolerance * normal_tolerance) return false;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(dot(n, s.corner(smaller, k) - s.corner(larger, 0))) > plane_tolerance) return false;
  }
  return true;
}

/// Two coplanar triangles overlap or come within `touch`: no side of either has the other wholly beyond it (separating
/// axes).
bool overlap(const Surface& s, std::uint32_t a, std::uint32_t b) {
  const auto apart = [&](std::uint32_t one, std::uint32_t other) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = s.corner(one, k);
      const Vec3 outward = normalized(cross(s.corner(one, (k + 1) % 3) - p, s.normal[one]));
      if (dot(outward, s.corner(other, 0) - p) > touch && dot(outward, s.corner(other, 1) - p) > touch &&
          dot(outward, s.corner(other, 2) - p) > touch) {
        return true;
      }
    }
    return false;
  };
  return !apart(a, b) && !apart(b, a);
}

/// Union-find whose representative is the smallest member.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t first(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = first(a);
    b = first(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The plane through `members`: the direction of the largest (first of equals), refined by all, weighted by area.
Patch fit(const Surface& s, const std::vector<std::uint32_t>& members, std::uint32_t material) {
  std::uint32_t largest = members.front();
  for (const std::uint32_t t : members) largest = s.area[t] > s.area[largest] ? t : largest;
  const Vec3 origin = s.corner(largest, 0);  // sums are taken from here: coordinates may be large
  Patch patch{{}, 0, material, 0, origin, origin};
  Vec3 sum, centre;
  for (const std::uint32_t t : members) {
    const double sign = dot(s.normal[t], s.normal[largest]) < 0 ? -1 : 1;
    sum += sign * s.area[t] * s.normal[t];
    patch.area += s.area[t];
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = s.corner(t, k);
      centre += s.area[t] / 3 * (p - origin);
      patch.low = {std::min(patch.low.x, p.x), std::min(patch.low.y, p.y), std::min(patch.low.z, p.z)};
      patch.high = {std::max(patch.high.x, p.x), std::max(patch.high.y, p.y), std::max(patch.high.z, p.z)};
    }
  }
  patch.normal = members.size() == 1 ? s.normal[largest] : normalized(sum);
  patch.offset = dot(patch.normal, origin + centre / patch.area);
  return patch;
}

bool drifts(const Surface& s, const std::vector<std::uint32_t>& members, const Patch& patch) {
  return std::any_of(members.begin(), members.end(), [&](std::uint32_t t) {
    for (int k = 0; k < 3; ++k) {
      if (std::abs(dot(patch.normal, s.corner(t, k)) - patch.offset) > drift) return true;
    }
    return false;
  });
}

}  // namespace

Patches find_patches(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                     const std::vector<std::uint32_t>& triangle_material) {
  GRIMALDI_EXPECT(triangles.size() == triangle_material.size());
  const auto count = static_cast<std::uint32_t>(triangles.size());
  Surface s{vertices, triangles, {}, {}};
  for (const auto& t : triangles) {
    const Vec3 twice = cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
    s.area.push_back(0.5 * norm(twice));
    s.normal.push_back(normalized(twice));
  }

  Groups groups(count);
  const TriangleTree tree(vertices, triangles);
  const Vec3 margin{touch, touch, touch};
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 &a = s.corner(i, 0), &b = s.corner(i, 1), &c = s.corner(i, 2);
    const Vec3 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
    const Vec3 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
    tree.find(low - margin, high + margin, near);
    for (const std::uint32_t j : near) {
      if (j >= i) break;
      if (triangle_material[i] != triangle_material[j] || !coplanar(s, i, j) || groups.first(i) == groups.first(j)) {
        continue;
      }
      if (share_vertex(triangles[i], triangles[j]) || overlap(s, i, j)) groups.unite(i, j);
    }
  }

  // Groups in the order of their smallest triangle; one that drifts falls apart again.
  std::vector<std::vector<std::uint32_t>> members(count);
  for (std::uint32_t i = 0; i < count; ++i) members[groups.first(i)].push_back(i);
  std::vector<std::uint8_t> whole(count, 0);
  Patches result;
  result.triangle_patch.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t first = groups.first(i);
    if (first != i && whole[first]) {
      result.triangle_patch[i] = result.triangle_patch[first];
      continue;
    }
    Patch patch = fit(s, first == i ? members[i] : std::vector<std::uint32_t>{i}, triangle_material[i]);
    if (first == i) {
      whole[i] = !drifts(s, members[i], patch);
      if (!whole[i]) patch = fit(s, {i}, triangle_material[i]);
    }
    result.triangle_patch[i] = static_cast<std::uint32_t>(result.patches.size());
    result.patches.push_back(patch);
  }
  return result;
}

}  // namespace grimaldi
