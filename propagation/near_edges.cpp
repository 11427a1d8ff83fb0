#include "propagation/near_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "propagation/connect.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/patch_rims.h"

namespace grimaldi {
namespace {

constexpr std::size_t most_parents = 64;
constexpr double transition_end = 6;

/// True if the way from a to b over the edge is at most `most` longer than the straight one.
bool passes_near(const Wedge& wedge, const Vec3& a, const Vec3& b, double straight, double most) {
  const Vec3 pa = a - wedge.start, pb = b - wedge.start;
  const double za = dot(pa, wedge.direction), zb = dot(pb, wedge.direction);
  const double ra = std::sqrt(std::max(0.0, norm2(pa) - za * za)), rb = std::sqrt(std::max(0.0, norm2(pb) - zb * zb));
  // The way over the whole line is the shortest there is.
  const double z = za - zb, r = ra + rb, longest = straight + most;
  if (z * z + r * r > longest * longest || r == 0) return false;
  const double along = std::clamp((za * rb + zb * ra) / r, 0.0, wedge.length);
  return std::hypot(za - along, ra) + std::hypot(zb - along, rb) <= longest;
}

}  // namespace

void each_near_edge(const Scene& scene, const PathGeometry& geometry, double wavelength, double v_most,
                    const std::function<void(std::size_t, std::uint32_t)>& act) {
  const double most = wavelength * v_most * v_most / 4;
  for (std::size_t leg = 0; leg + 1 < geometry.count; ++leg) {
    const Vec3 &a = geometry.points[leg], &b = geometry.points[leg + 1];
    const double straight = distance(a, b);
    for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w)
      if (passes_near(scene.wedges.wedges[w], a, b, straight, most)) act(leg, w);
  }
}

std::vector<std::uint32_t> add_near_edges(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                          std::size_t transmitter, const Vec3& point,
                                          std::span<const std::uint32_t> arriving,
                                          std::span<const SequenceTable* const> known, SequenceTable& sequences,
                                          std::uint64_t& shadow_rays, const std::atomic<bool>* stop) {
  const double wavelength = 2 * pi / plan.wavenumber.front();
  const Vec3& source = plan.request.transmitters[transmitter].position;
  std::vector<std::uint32_t> parents(arriving.begin(), arriving.end());
  for (std::size_t i = 0; i < std::min(parents.size(), most_parents) && !(stop && *stop); ++i) {
    const auto found = sequences[parents[i]];
    const std::vector<Interaction> parent(found.begin(), found.end());  // the table grows below
    if (static_cast<int>(parent.size()) >= plan.request.depth ||
        static_cast<int>(count_edges(parent)) >= most_edges(plan.request))
      continue;
    PathGeometry geometry, child_geometry;
    if (!UnfoldedSequence(scene, source, parent, &plan.small_objects).solve(point, wavelength, geometry)) continue;
    each_near_edge(scene, geometry, wavelength, transition_end, [&](std::size_t leg, std::uint32_t w) {
      std::vector<Interaction> child = parent;
      child.insert(child.begin() + static_cast<std::ptrdiff_t>(leg), edge_interaction(w));
      const SequenceHash hash = hash_of(child);
      if (is_in(known, hash) || sequences.find(hash) != SequenceTable::no_sequence) return;
      UnfoldedSequence unfolded(scene, source, child, &plan.small_objects);
      if (!unfolded.solve(point, wavelength, child_geometry) ||
          blocked_leg(scene, tracer, child, child_geometry, shadow_rays))
        return;
      parents.push_back(sequences.enter(hash, child));
    });
  }
  parents.erase(parents.begin(), parents.begin() + static_cast<std::ptrdiff_t>(arriving.size()));
  return parents;
}

std::vector<std::uint32_t> add_second_edges(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                            std::size_t transmitter, const Vec3& point, double least,
                                            SequenceTable& sequences, std::uint64_t& shadow_rays,
                                            const std::atomic<bool>* stop) {
  const double wavelength = 2 * pi / plan.wavenumber.front();
  const Vec3& source = plan.request.transmitters[transmitter].position;
  const PatchRims rims(scene);
  const auto hidden = [&](const Wedge& wedge) {
    const Vec3 way = point - wedge.start;
    return dot(way, wedge.normal0) < 0 && dot(way, wedge.normaln()) < 0;
  };
  std::vector<std::uint32_t> added;
  const auto first_new = static_cast<std::uint32_t>(sequences.size());
  for (std::uint32_t s = 0; s < first_new && !(stop && *stop); ++s) {
    const auto found = sequences[s];
    if (found.empty() || !is_edge(found.back()) || static_cast<int>(found.size()) >= plan.request.depth ||
        static_cast<int>(count_edges(found)) >= most_edges(plan.request))
      continue;
    const std::uint32_t last = index_of(found.back());
    const Wedge& wedge = scene.wedges.wedges[last];
    if (!hidden(wedge)) continue;
    std::vector<Interaction> child(found.begin(), found.end());  // the table grows below
    child.push_back(0);
    for (const std::uint32_t patch : {wedge.patch0, wedge.patchn})
      for (const std::uint32_t second : rims.of(patch)) {
        if (second == last || hidden(scene.wedges.wedges[second])) continue;
        child.back() = edge_interaction(second);
        const SequenceHash hash = hash_of(child);
        if (sequences.find(hash) != SequenceTable::no_sequence) continue;
        PathGeometry geometry;
        UnfoldedSequence unfolded(scene, source, child, &plan.small_objects);
        if (!unfolded.solve(point, wavelength, geometry) || power_bound(scene, plan, child, geometry) < least ||
            blocked_leg(scene, tracer, child, geometry, shadow_rays))
          continue;
        added.push_back(sequences.enter(hash, child));
      }
  }
  return added;
}

}  // namespace grimaldi
