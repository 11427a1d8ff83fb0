#include "propagation/detour.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"
#include "propagation/connect.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/patch_rims.h"

namespace grimaldi {
namespace {

/// Patches next to either end of a blocked leg whose edges are tried.
constexpr int blockers_seen = 4;
/// Ways around whose path is asked for (a sixth of them for a third edge and more); of those that are free, and of
/// those that something else blocks, as many are kept.
constexpr int detours_tried = 48, free_detours = 12, blocked_detours = 12;

/// A way around: the edge, where it is passed, and the length of the way over it.
struct WayAround {
  std::uint32_t wedge;
  double along, length;  ///< m
};

/// A sequence found by one blocked path.
struct Proposal {
  std::uint32_t cell, passes;
  std::uint8_t leg, point;  ///< of a blocked one
  bool free;
  float gain;
  SequenceHash hash;
  std::uint32_t size;
  std::array<Interaction, max_depth> interactions;
};

/// True if the direction `way` from the edge leads through its exterior (which is more than half of all).
bool leads_outside(const Wedge& wedge, const Vec3& way) {
  constexpr double hair = -1e-6;  // m; an end may lie on a face
  return dot(way, wedge.normal0) >= hair || dot(way, wedge.normaln()) >= hair;
}

constexpr std::uint32_t tile_stream = 7;
constexpr std::size_t tile_side = 3;

std::size_t tile_of(std::size_t cell, const GridLayout& layout) {
  return (cell / layout.nx / tile_side) * layout.nx + cell % layout.nx / tile_side;
}

/// The pass to which a cell's tile belongs: drawn, so that what one tile alone finds counts as found by one pass.
std::uint32_t tile_pass(const Plan& plan, const GridLayout& layout, std::size_t cell) {
  const double u = uniform4(plan.request.seed, tile_stream, tile_of(cell, layout), 0)[0];
  return static_cast<std::uint32_t>(u * plan.request.passes);
}

class Scout {
 public:
  Scout(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter, const CoverageGrid& grid,
        const Discovered& discovered, const std::vector<double>& known, const PatchRims& rims)
      : scene_(scene),
        tracer_(tracer),
        plan_(plan),
        source_(plan.request.transmitters[transmitter].position),
        grid_(grid),
        discovered_(discovered),
        known_(known),
        rims_(rims),
        wavelength_(2 * pi / plan.wavenumber.front()),
        unit_gain_(plan.request.kind == WaveKind::radio ? std::pow(wavelength_ / (4 * pi), 2) : 1 / (4 * pi)) {}

  void lead_around(const BlockedPath& path, std::vector<Proposal>& out) {
    const auto interactions = discovered_.sequences[path.sequence];
    const Vec3 target = grid_.layout.centre(path.cell) + grid_.of(path.cell)[path.point].offset;
    UnfoldedSequence parent(scene_, source_, interactions);
    if (!parent.solve_in_planes(target, wavelength_, geometry_)) return;
    gather_ways(interactions, path.leg);
    Proposal proposal;
    proposal.cell = path.cell;
    proposal.point = path.point;
    proposal.passes = 1u << tile_pass(plan_, grid_.layout, path.cell);
    proposal.size = static_cast<std::uint32_t>(interactions.size() + 1);
    const auto inserted = std::copy_n(interactions.begin(), path.leg, proposal.interactions.begin());
    std::copy(interactions.begin() + path.leg, interactions.end(), inserted + 1);
    const std::span<const Interaction> child(proposal.interactions.data(), proposal.size);
    // The parent's places along the edges are the child's first guess.
    const std::size_t edges_before = count_edges(interactions.first(path.leg)), edges = count_edges(interactions) + 1;
    std::array<double, max_edges> along{};
    for (std::size_t i = 0; i + 1 < edges; ++i) along[i + (i >= edges_before)] = geometry_.edges[i].along;
    const bool may_go_on =
        static_cast<int>(child.size()) < plan_.request.depth && static_cast<int>(edges) < most_edges(plan_.request);
    int tried = 0, free = 0, blocked = 0;
    for (const WayAround& way : ways_) {
      if (free == free_detours) break;
      *inserted = edge_interaction(way.wedge);
      if (++tried > (edges > 2 ? detours_tried / 6 : detours_tried)) break;
      UnfoldedSequence unfolded(scene_, source_, child);
      along[edges_before] = way.along;
      if (edges > 1) unfolded.begin_at({along.data(), edges});
      if (!unfolded.solve(target, wavelength_, geometry_)) continue;
      const double bound = power_bound(scene_, plan_, child, geometry_);
      if (child.size() > 1 && bound < negligible_share * known_[path.cell]) continue;
      const auto leg = blocked_leg(scene_, tracer_, child, geometry_, shadow_rays_);
      proposal.free = !leg;
      if (leg) {
        if (!may_go_on || ++blocked > blocked_detours) continue;
        proposal.leg = static_cast<std::uint8_t>(*leg);
      } else {
        ++free;
      }
      proposal.gain = static_cast<float>(bound / unit_gain_);
      proposal.hash = hash_of(child);
      out.push_back(proposal);
    }
  }

  /// Rays asked so far, of either kind.
  std::uint64_t shadow_rays() const { return shadow_rays_; }

 private:
  /// Edges of what stands in the leg and of the patches next to that, shortest way around first.
  void gather_ways(std::span<const Interaction> interactions, std::size_t leg) {
    const Vec3 start = end_of_leg(interactions, leg), end = end_of_leg(interactions, leg + 1);
    const std::uint32_t at_start = face_at(interactions, leg), at_end = face_at(interactions, leg + 1);
    patches_.clear();
    gather_blockers(start, end, at_start, at_end);
    gather_blockers(end, start, at_end, at_start);
    keep_distinct(patches_);
    const std::size_t blocking = patches_.size();
    for (std::size_t i = 0; i < blocking; ++i)
      for (const std::uint32_t rim : rims_.of(patches_[i])) {
        patches_.push_back(scene_.wedges.wedges[rim].patch0);
        patches_.push_back(scene_.wedges.wedges[rim].patchn);
      }
    keep_distinct(patches_);
    rims_found_.clear();
    for (const std::uint32_t patch : patches_)
      for (const std::uint32_t rim : rims_.of(patch)) rims_found_.push_back(rim);
    keep_distinct(rims_found_);
    ways_.clear();
    const auto [from, to] = unfolded_leg(interactions, leg);
    for (const std::uint32_t rim : rims_found_) add(rim, from, to);
    std::sort(ways_.begin(), ways_.end(), [](const WayAround& a, const WayAround& b) {
      return std::tie(a.length, a.wedge) < std::tie(b.length, b.wedge);
    });
  }

  static void keep_distinct(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  /// The patches met first from `start` on.
  void gather_blockers(const Vec3& start, const Vec3& end, std::uint32_t leave, std::uint32_t target) {
    const double length = distance(start, end);
    const Vec3 direction = (end - start) / length;
    double travelled = 0;
    for (int i = 0; i < blockers_seen; ++i) {
      const Hit hit = tracer_.nearest(start + travelled * direction, direction, leave);
      ++shadow_rays_;
      if (hit.triangle == no_index || travelled + hit.distance > length) break;
      travelled += hit.distance;
      const std::uint32_t patch = scene_.patches.triangle_patch[hit.triangle];
      if (patch != target) patches_.push_back(patch);
      leave = patch;
    }
  }

  /// Point i of the path; a mirror's point beside its face is taken at the face's border.
  Vec3 end_of_leg(std::span<const Interaction> interactions, std::size_t i) const {
    const Vec3 point = seen_point(scene_, tracer_, interactions, geometry_, i);
    const std::uint32_t face = face_at(interactions, i);
    if (face == no_index) return point;
    const Patch& patch = scene_.patches.patches[face];
    return {std::clamp(point.x, patch.low.x, patch.high.x), std::clamp(point.y, patch.low.y, patch.high.y),
            std::clamp(point.z, patch.low.z, patch.high.z)};
  }

  /// The ends of the leg as the mirrors next to it show them: the edges, or ends of the path, before and after.
  std::pair<Vec3, Vec3> unfolded_leg(std::span<const Interaction> interactions, std::size_t leg) const {
    const auto& points = geometry_.points;
    const Vec3 direction = normalized(points[leg + 1] - points[leg]);
    double before = 0, after = 0;
    for (std::size_t i = leg; i > 0 && !is_edge(interactions[i - 1]); --i) before += distance(points[i], points[i - 1]);
    for (std::size_t i = leg + 1; i <= interactions.size() && !is_edge(interactions[i - 1]); ++i)
      after += distance(points[i], points[i + 1]);
    return {points[leg] - before * direction, points[leg + 1] + after * direction};
  }

  void add(std::uint32_t wedge_index, const Vec3& from, const Vec3& to) {
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    const double along = std::clamp(crossing(wedge.start, wedge.direction, from, to), 0.0, wedge.length);
    const Vec3 corner = wedge.point(along);
    if (!leads_outside(wedge, from - corner) || !leads_outside(wedge, to - corner)) return;
    ways_.push_back({wedge_index, along, distance(from, corner) + distance(corner, to)});
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Plan& plan_;
  const Vec3 source_;
  const CoverageGrid& grid_;
  const Discovered& discovered_;
  const std::vector<double>& known_;
  const PatchRims& rims_;
  const double wavelength_, unit_gain_;
  PathGeometry geometry_;
  std::vector<std::uint32_t> patches_, rims_found_;
  std::vector<WayAround> ways_;
  std::uint64_t shadow_rays_ = 0;
};

}  // namespace

Discovered detours(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                   const CoverageGrid& grid, const Discovered& discovered, const std::vector<double>& known,
                   int most_edges, const std::atomic<bool>* stop) {
  Discovered found;
  std::vector<BlockedPath> paths;
  for (const BlockedPath& path : discovered.blocked) {
    const auto interactions = discovered.sequences[path.sequence];
    if (static_cast<int>(interactions.size()) < plan.request.depth &&
        static_cast<int>(count_edges(interactions)) < most_edges)
      paths.push_back(path);
  }
  // One of each sequence, leg and tile.
  const auto key = [&](const BlockedPath& path) {
    return std::tuple(path.sequence, path.leg, tile_of(path.cell, grid.layout));
  };
  std::sort(paths.begin(), paths.end(), [&](const BlockedPath& a, const BlockedPath& b) {
    return std::tuple(key(a), a.cell, a.point) < std::tuple(key(b), b.cell, b.point);
  });
  paths.erase(std::unique(paths.begin(), paths.end(),
                          [&](const BlockedPath& a, const BlockedPath& b) { return key(a) == key(b); }),
              paths.end());
  const PatchRims rims(scene);
  const unsigned threads = plan.request.threads ? plan.request.threads : hardware_threads();
  std::vector<Scout> scouts;
  for (unsigned i = 0; i < threads; ++i)
    scouts.emplace_back(scene, tracer, plan, transmitter, grid, discovered, known, rims);
  constexpr std::size_t paths_per_block = 256;
  std::vector<std::vector<Proposal>> proposals((paths.size() + paths_per_block - 1) / paths_per_block);
  for_each_block(
      proposals.size(), threads,
      [&](std::size_t block, unsigned thread) {
        for (std::size_t i = block * paths_per_block; i < std::min(paths.size(), (block + 1) * paths_per_block); ++i)
          scouts[thread].lead_around(paths[i], proposals[block]);
      },
      stop);
  for (const Scout& scout : scouts) found.shadow_rays += scout.shadow_rays();
  for (const auto& block : proposals)
    for (const Proposal& p : block) {
      const std::uint32_t sequence = found.sequences.enter(p.hash, {p.interactions.data(), p.size});
      if (p.free)
        found.seeds.push_back({sequence, p.cell, p.passes, false, p.gain});
      else
        found.blocked.push_back({sequence, p.cell, p.leg, p.point});
    }
  return found;
}

}  // namespace grimaldi
