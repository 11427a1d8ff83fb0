#include "propagation/detour.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"
#include "propagation/connect.h"
#include "propagation/effort.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/patch_rims.h"

namespace grimaldi {
namespace {

/// Patches next to either end of a blocked leg whose edges are tried.
constexpr int blockers_seen = 4;

/// A way around: the edge, where it is passed, and the length of the way over it. Of a solid that hides either end from
/// the edge nearer to the other: two edges of one face.
struct WayAround {
  std::uint32_t wedge, second;         ///< no_index: one edge is enough
  double along, along_second, length;  ///< m
};

/// An edge near the blocked leg: where the way around passes it, and which ends of the leg lie outside its solid there.
struct Rim {
  std::uint32_t wedge;
  double along;  ///< m
  bool sees_start, sees_end;
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
        const Effort& effort, const Discovered& discovered, const std::vector<double>& known, const PatchRims& rims)
      : scene_(scene),
        tracer_(tracer),
        plan_(plan),
        source_(plan.request.transmitters[transmitter].position),
        grid_(grid),
        discovered_(discovered),
        known_(known),
        rims_(rims),
        effort_(effort),
        wavelength_(2 * pi / plan.wavenumber.front()),
        unit_gain_(plan.request.kind == WaveKind::radio ? std::pow(wavelength_ / (4 * pi), 2) : 1 / (4 * pi)) {}

  void lead_around(const BlockedPath& path, std::vector<Proposal>& out) {
    const auto interactions = discovered_.sequences[path.sequence];
    const Vec3 target = grid_.layout.centre(path.cell) + grid_.of(path.cell)[path.point].offset;
    UnfoldedSequence parent(scene_, source_, interactions, &plan_.small_objects);
    if (!parent.solve_in_planes(target, wavelength_, geometry_)) return;
    const int edges_now = static_cast<int>(count_edges(interactions));
    gather_ways(
        interactions, path.leg,
        static_cast<int>(interactions.size()) + 2 <= plan_.request.depth && edges_now + 2 <= most_edges(plan_.request));
    Proposal proposal;
    proposal.cell = path.cell;
    proposal.point = path.point;
    proposal.passes = 1u << tile_pass(plan_, grid_.layout, path.cell);
    const std::span<const Interaction> before = interactions.first(path.leg), after = interactions.subspan(path.leg);
    // The parent's places along the edges are the child's first guess.
    const std::size_t edges_before = count_edges(before), edges_after = count_edges(after);
    std::array<double, max_edges> known_along{};
    for (std::size_t i = 0; i < edges_before + edges_after; ++i) known_along[i] = geometry_.edges[i].along;
    int tried = 0, free = 0, blocked = 0;
    for (const WayAround& way : ways_) {
      if (free == effort_.detours_kept) break;
      const std::size_t added = way.second == no_index ? 1 : 2;
      const std::size_t edges = edges_before + edges_after + added, size = interactions.size() + added;
      const int longest = plan_.request.depth, most = most_edges(plan_.request);
      if (static_cast<int>(size) > longest || static_cast<int>(edges) > most) continue;
      if (++tried > (edges > 2 ? effort_.detours_tried / 6 : effort_.detours_tried)) break;
      auto next = std::copy(before.begin(), before.end(), proposal.interactions.begin());
      *next++ = edge_interaction(way.wedge);
      if (added == 2) *next++ = edge_interaction(way.second);
      std::copy(after.begin(), after.end(), next);
      proposal.size = static_cast<std::uint32_t>(size);
      const std::span<const Interaction> child(proposal.interactions.data(), proposal.size);
      std::array<double, max_edges> along{};
      std::copy_n(known_along.begin(), edges_before, along.begin());
      along[edges_before] = way.along;
      if (added == 2) along[edges_before + 1] = way.along_second;
      std::copy_n(known_along.begin() + edges_before, edges_after, along.begin() + edges_before + added);
      UnfoldedSequence unfolded(scene_, source_, child, &plan_.small_objects);
      if (edges > 1) unfolded.begin_at({along.data(), edges});
      if (!unfolded.solve(target, wavelength_, solved_)) continue;
      const double bound = power_bound(scene_, plan_, child, solved_);
      if (child.size() > 1 && bound < effort_.negligible_share * known_[path.cell]) continue;
      const auto leg = blocked_leg(scene_, tracer_, child, solved_, shadow_rays_);
      proposal.free = !leg;
      if (leg) {
        const bool may_go_on = static_cast<int>(size) < longest && static_cast<int>(edges) < most;
        if (!may_go_on || ++blocked > effort_.detours_kept) continue;
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
  void gather_ways(std::span<const Interaction> interactions, std::size_t leg, bool room_for_two) {
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
    rim_numbers_.clear();
    for (const std::uint32_t patch : patches_)
      for (const std::uint32_t rim : rims_.of(patch)) rim_numbers_.push_back(rim);
    keep_distinct(rim_numbers_);
    ways_.clear();
    rims_found_.clear();
    const auto [from, to] = unfolded_leg(interactions, leg);
    for (const std::uint32_t number : rim_numbers_) {
      const Wedge& wedge = scene_.wedges.wedges[number];
      const double along = passed_at(wedge, from, to);
      const Vec3 corner = wedge.point(along);
      const Rim rim{number, along, leads_outside(wedge, from - corner), leads_outside(wedge, to - corner)};
      rims_found_.push_back(rim);
      if (rim.sees_start && rim.sees_end)
        ways_.push_back({number, no_index, along, 0, distance(from, corner) + distance(corner, to)});
    }
    if (room_for_two) gather_pairs(from, to);
    std::sort(ways_.begin(), ways_.end(), [](const WayAround& a, const WayAround& b) {
      return std::tie(a.length, a.wedge, a.second) < std::tie(b.length, b.wedge, b.second);
    });
  }

  /// The edges of a solid that hides the end from the first and the start from the second.
  void gather_pairs(const Vec3& from, const Vec3& to) {
    const auto found = [&](std::uint32_t number) {
      return rims_found_.data() +
             (std::lower_bound(rim_numbers_.begin(), rim_numbers_.end(), number) - rim_numbers_.begin());
    };
    for (const std::uint32_t patch : patches_) {
      firsts_.clear();
      seconds_.clear();
      for (const std::uint32_t number : rims_.of(patch)) {
        const Rim* rim = found(number);
        if (rim->sees_start != rim->sees_end) (rim->sees_start ? firsts_ : seconds_).push_back(rim);
      }
      for (const Rim* first : firsts_)
        for (const Rim* second : seconds_) add_pair(*first, *second, from, to);
    }
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

  /// The point of an edge that the way from a to b passes nearest.
  static double passed_at(const Wedge& wedge, const Vec3& a, const Vec3& b) {
    return std::clamp(crossing(wedge.start, wedge.direction, a, b), 0.0, wedge.length);
  }

  void add_pair(const Rim& rim1, const Rim& rim2, const Vec3& from, const Vec3& to) {
    const Wedge &first = scene_.wedges.wedges[rim1.wedge], &second = scene_.wedges.wedges[rim2.wedge];
    const double along2 = passed_at(second, first.point(rim1.along), to);
    const Vec3 corner2 = second.point(along2);
    const double along1 = passed_at(first, from, corner2);
    const Vec3 corner1 = first.point(along1);
    if (distance(corner1, corner2) < 1e-3) return;  // they meet: one corner
    ways_.push_back({rim1.wedge, rim2.wedge, along1, along2,
                     distance(from, corner1) + distance(corner1, corner2) + distance(corner2, to)});
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Plan& plan_;
  const Vec3 source_;
  const CoverageGrid& grid_;
  const Discovered& discovered_;
  const std::vector<double>& known_;
  const PatchRims& rims_;
  const Effort effort_;
  const double wavelength_, unit_gain_;
  PathGeometry geometry_, solved_;
  std::vector<std::uint32_t> patches_, rim_numbers_;
  std::vector<Rim> rims_found_;  ///< in the order of rim_numbers_
  std::vector<const Rim*> firsts_, seconds_;
  std::vector<WayAround> ways_;
  std::uint64_t shadow_rays_ = 0;
};

}  // namespace

Discovered detours(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                   const CoverageGrid& grid, const Effort& effort, const Discovered& discovered,
                   const std::vector<double>& known, int most_edges, const std::atomic<bool>* stop) {
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
    scouts.emplace_back(scene, tracer, plan, transmitter, grid, effort, discovered, known, rims);
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
