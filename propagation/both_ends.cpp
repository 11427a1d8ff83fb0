#include "propagation/both_ends.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/blocks.h"
#include "propagation/candidates.h"
#include "propagation/fermat.h"
#include "propagation/launcher.h"
#include "propagation/patch_rims.h"

namespace grimaldi {
namespace {

/// The largest part between 0 and 1 that is neither dark nor split by a share known to be in view; its length is 0 if
/// all is dark.
struct Gap {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

Gap largest_gap(const EdgeShadow& shadow, std::span<const double> lit) {
  std::vector<Gap> gaps;
  double begin = 0;
  for (const auto& [from, to] : shadow.dark()) {
    if (from > begin) gaps.push_back({begin, std::min(from, 1.0)});
    begin = std::max(begin, to);
  }
  if (begin < 1) gaps.push_back({begin, 1});
  Gap largest;
  for (Gap gap : gaps) {
    for (const double share : lit)
      if (share > gap.from && share < gap.to) {
        if (share - gap.from > largest.length()) largest = {gap.from, share};
        gap.from = share;
      }
    if (gap.length() > largest.length()) largest = gap;
  }
  return largest;
}

/// Looks at a wedge until it is known to be dark, or for `most` rays and while parts longer than 1/16 are unknown once
/// something of it was seen.
void look_at(const Scene& scene, const Tracer& tracer, const Vec3& eye, const Wedge& wedge, EdgeShadow& shadow,
             std::uint64_t& rays) {
  constexpr std::size_t most = 64;
  constexpr double fine = 1.0 / 16;
  std::vector<double> lit;  // ascending
  for (std::size_t i = 0; i < most; ++i) {
    const Gap gap = largest_gap(shadow, lit);
    if (gap.length() == 0 || (!lit.empty() && gap.length() < fine)) return;
    const double share = 0.5 * (gap.from + gap.to);
    const Vec3 to = wedge.point(share * wedge.length) + 3 * tracer.surface_gap() * wedge.bisector();
    const double length = distance(eye, to);
    ++rays;
    const Hit hit = tracer.nearest(eye, (to - eye) / length);
    if (hit.triangle != no_index && hit.distance < length) shadow.add(scene, hit.triangle);
    if (!shadow.is_dark(share)) lit.insert(std::upper_bound(lit.begin(), lit.end(), share), share);
  }
}

class Joiner {
 public:
  Joiner(const Scene& scene, const Tracer& tracer, const Plan& plan, const EndView& from, const EndView& to,
         const SequenceTable& known, const SequenceTable& sequences)
      : scene_(scene),
        plan_(plan),
        from_(from),
        to_(to),
        proposer_(scene, plan, from, to, std::array{&known, &sequences}),
        rims_(scene),
        gap_(tracer.surface_gap()) {}

  /// An edge in view of both.
  void one_edge(const EndView::Edge& edge, Candidates& out) const {
    if (const EndView::Edge* other = to_.edge_of(edge.wedge)) {
      const double share = passed_at(edge.wedge, from_.eye(), to_.eye());
      if (!edge.shadow.is_dark(share) && !other->shadow.is_dark(share)) propose({}, {edge.wedge}, {}, out);
    }
  }
  /// An edge, then the mirrors of the receiver.
  void before_mirrors(const EndView::Edge& edge, Candidates& out) const {
    for (const EndView::Mirror& mirror : to_.mirrors())
      if (in_mirror(edge, from_.eye(), mirror)) propose({}, {edge.wedge}, mirror.patches, out);
  }
  /// The mirrors of the transmitter, then an edge.
  void behind_mirrors(const EndView::Edge& edge, Candidates& out) const {
    for (const EndView::Mirror& mirror : from_.mirrors())
      if (in_mirror(edge, to_.eye(), mirror)) propose(mirror.patches, {edge.wedge}, {}, out);
  }
  /// Two edges of one face, then the mirrors of the receiver, whose image the first edge's own solid hides from it; or
  /// the same from the other end.
  void over_a_face(const EndView::Edge& edge, bool from_receiver, Candidates& out) const {
    const EndView &own = from_receiver ? to_ : from_, &other = from_receiver ? from_ : to_;
    const Wedge& wedge = scene_.wedges.wedges[edge.wedge];
    for (const EndView::Mirror& mirror : other.mirrors()) {
      const Vec3 way = mirror.image - wedge.start;
      if (dot(way, wedge.normal0) >= 0 || dot(way, wedge.normaln()) >= 0) continue;
      if (static_cast<int>(mirror.patches.size()) + 2 > plan_.request.depth) continue;
      for (const std::uint32_t patch : {wedge.patch0, wedge.patchn})
        for (const std::uint32_t second : rims_.of(patch)) {
          if (second == edge.wedge) continue;
          const Wedge& next = scene_.wedges.wedges[second];
          const Vec3 passed = next.point(passed_at(second, own.eye(), mirror.image) * next.length);
          if (!crosses_box(scene_.patches.patches[mirror.patches.back()], mirror.image, passed)) continue;
          if (from_receiver)
            propose(mirror.patches, {second, edge.wedge}, {}, out);
          else
            propose({}, {edge.wedge, second}, mirror.patches, out);
        }
    }
  }
  void two_edges(const EndView::Edge& first, Candidates& out) const {
    const Wedge& wedge = scene_.wedges.wedges[first.wedge];
    for (const EndView::Edge& second : to_.edges()) {
      const Wedge& other = scene_.wedges.wedges[second.wedge];
      if (second.wedge == first.wedge || hides_from(wedge, other, gap_) || hides_from(other, wedge, gap_)) continue;
      propose({}, {first.wedge, second.wedge}, {}, out);
    }
  }

 private:
  double passed_at(std::uint32_t wedge, const Vec3& a, const Vec3& b) const {
    return passed_share(scene_.wedges.wedges[wedge], a, b);
  }

  /// True if the way from `eye` over the edge to the image in the mirror meets the last of its faces, the edge in view.
  bool in_mirror(const EndView::Edge& edge, const Vec3& eye, const EndView::Mirror& mirror) const {
    const double share = passed_at(edge.wedge, eye, mirror.image);
    const Wedge& wedge = scene_.wedges.wedges[edge.wedge];
    return crosses_box(scene_.patches.patches[mirror.patches.back()], mirror.image,
                       wedge.point(share * wedge.length)) &&
           !edge.shadow.is_dark(share);
  }

  /// Faces from the transmitter, edges, faces from the receiver on.
  void propose(std::span<const Interaction> before, std::initializer_list<std::uint32_t> wedges,
               std::span<const Interaction> after, Candidates& out) const {
    std::array<Interaction, max_depth> held;
    auto end = std::copy(before.begin(), before.end(), held.begin());
    for (const std::uint32_t wedge : wedges) *end++ = edge_interaction(wedge);
    end = std::reverse_copy(after.begin(), after.end(), end);
    proposer_.propose({held.begin(), end}, out);
  }

  const Scene& scene_;
  const Plan& plan_;
  const EndView &from_, &to_;
  const Proposer proposer_;
  const PatchRims rims_;
  const double gap_;
};

}  // namespace

EndView::EndView(const Scene& scene, const Tracer& tracer, const Vec3& eye, int most_faces, std::uint64_t beams,
                 std::uint64_t& rays)
    : eye_(eye) {
  look_for_edges(scene, tracer, rays);
  if (most_faces > 0) look_for_faces(scene, tracer, most_faces, beams, rays);
}

const EndView::Edge* EndView::edge_of(std::uint32_t wedge) const {
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), wedge,
                                      [](const Edge& edge, std::uint32_t w) { return edge.wedge < w; });
  return found != edges_.end() && found->wedge == wedge ? &*found : nullptr;
}

void EndView::look_for_edges(const Scene& scene, const Tracer& tracer, std::uint64_t& rays) {
  for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
    EdgeShadow shadow(scene.wedges.wedges[w], eye_, tracer.surface_gap());
    if (shadow.hidden_by_itself()) continue;
    if (!shadow.end_on()) look_at(scene, tracer, eye_, scene.wedges.wedges[w], shadow, rays);
    if (!shadow.all_dark()) edges_.push_back({w, std::move(shadow)});
  }
}

void EndView::look_for_faces(const Scene& scene, const Tracer& tracer, int most_faces, std::uint64_t beams,
                             std::uint64_t& rays) {
  SequenceTable met;
  std::array<Interaction, max_depth> held;
  const auto walk = [&](Vec3 direction) {
    Vec3 origin = eye_;
    SequenceHash hash = empty_sequence;
    std::uint32_t leave = no_index;
    for (int count = 0; count < most_faces; ++count) {
      ++rays;
      const Hit hit = tracer.nearest(origin, direction, leave);
      if (hit.triangle == no_index) return;
      held[static_cast<std::size_t>(count)] = leave = scene.patches.triangle_patch[hit.triangle];
      hash = extended(hash, leave);
      met.enter(hash, {held.data(), static_cast<std::size_t>(count) + 1});
      const Vec3& normal = scene.patches.patches[leave].normal;
      origin = origin + hit.distance * direction;
      direction = direction - 2 * dot(direction, normal) * normal;
    }
  };
  const Launcher launcher(0, 0, beams);
  for (std::uint64_t i = 0; i < beams; ++i) walk(launcher.direction(i));
  for (const auto& corners : scene.triangles) {
    const Vec3 way = (scene.vertices[corners[0]] + scene.vertices[corners[1]] + scene.vertices[corners[2]]) / 3 - eye_;
    if (norm(way) > tracer.surface_gap()) walk(normalized(way));
  }
  for (std::size_t s = 0; s < met.size(); ++s) {
    Mirror& mirror = mirrors_.emplace_back();
    mirror.image = eye_;
    mirror.patches.assign(met[s].begin(), met[s].end());
    for (const Interaction patch : mirror.patches) mirror.image = mirrored(mirror.image, scene.patches.patches[patch]);
  }
}

EndView view_from(const Scene& scene, const Tracer& tracer, const Plan& plan, const Vec3& eye, std::uint64_t& rays) {
  const int most_faces =
      plan.request.reflection ? std::clamp(plan.request.max_reflections, 0, plan.request.depth - 1) : 0;
  const auto beams = static_cast<std::uint64_t>(std::clamp(plan.request.rays / 16, 4096.0, 65536.0));
  return {scene, tracer, eye, most_faces, beams, rays};
}

std::vector<std::uint32_t> add_from_both_ends(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                              std::size_t transmitter, const EndView& from_transmitter,
                                              const EndView& from_receiver, double& power, const SequenceTable& known,
                                              SequenceTable& sequences, std::uint64_t& shadow_rays,
                                              const std::atomic<bool>* stop) {
  const Joiner joiner(scene, tracer, plan, from_transmitter, from_receiver, known, sequences);
  const auto &first = from_transmitter.edges(), &last = from_receiver.edges();
  constexpr std::size_t edges_per_block = 16;
  const std::size_t edges = std::max(first.size(), last.size());
  const bool two = plan.request.depth > 1 && most_edges(plan.request) > 1;
  std::vector<Candidates> blocks((edges + edges_per_block - 1) / edges_per_block);
  for_each_block(
      blocks.size(), plan.request.threads,
      [&](std::size_t number, unsigned) {
        Candidates& block = blocks[number];
        for (std::size_t i = number * edges_per_block; i < (number + 1) * edges_per_block; ++i) {
          if (i < first.size()) {
            joiner.one_edge(first[i], block);
            joiner.before_mirrors(first[i], block);
            if (two) joiner.two_edges(first[i], block);
            if (two) joiner.over_a_face(first[i], false, block);
          }
          if (i < last.size()) {
            joiner.behind_mirrors(last[i], block);
            if (two) joiner.over_a_face(last[i], true, block);
          }
        }
      },
      stop);
  return add_strongest(scene, tracer, plan, transmitter, from_receiver.eye(), blocks, power, sequences, shadow_rays,
                       stop);
}

}  // namespace grimaldi
