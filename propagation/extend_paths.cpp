#include "propagation/extend_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/candidates.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/near_edges.h"
#include "propagation/patch_rims.h"

namespace grimaldi {
namespace {

/// How often what is found is extended in its turn, the first time included.
constexpr int most_rounds = 3;

/// Paths that one round extends at the most.
constexpr std::size_t most_parents = 256;

/// A path to be extended.
struct Parent {
  std::vector<Interaction> interactions;
  PathGeometry geometry;
  std::vector<std::size_t> turns;  ///< numbers of its points that no mirror moves: source, edges, receiver
  double bound;                    ///< power_bound
};

Parent parent_of(const Scene& scene, const Plan& plan, std::span<const Interaction> interactions,
                 const PathGeometry& geometry) {
  Parent parent{{interactions.begin(), interactions.end()}, geometry, {0}, 0};
  for (std::size_t i = 0; i < interactions.size(); ++i)
    if (is_edge(interactions[i])) parent.turns.push_back(i + 1);
  parent.turns.push_back(interactions.size() + 1);
  parent.bound = power_bound(scene, plan, interactions, geometry);
  return parent;
}

class Extender {
 public:
  Extender(const Scene& scene, const Tracer& tracer, const Plan& plan, const EndView& from, const EndView& to,
           std::span<const SequenceTable* const> known, const PatchRims& rims, const Parent& parent, Candidates& out)
      : scene_(scene),
        from_(from),
        to_(to),
        proposer_(scene, plan, from, to, known),
        rims_(rims),
        parent_(parent),
        gap_(tracer.surface_gap()),
        out_(out) {
    const int size = static_cast<int>(parent.interactions.size());
    const int edges = static_cast<int>(count_edges(parent.interactions));
    room_ = plan.request.depth - size;
    edges_left_ = most_edges(plan.request) - edges;
    faces_left_ = plan.request.reflection ? plan.request.max_reflections - (size - edges) : 0;
  }

  void extend() const {
    const std::size_t edges = parent_.turns.size() - 2, size = parent_.interactions.size();
    if (edges == 0) return;
    // What is shorter is found from both ends (add_from_both_ends).
    if (size > 2) exchange();
    if (room_ <= 0) return;
    if (size > 1)
      for (const bool receiver : {true, false}) {
        if (faces_left_ > 0) mirrors_at(receiver);
        if (edges_left_ > 0) edges_at(receiver);
      }
    if (faces_left_ <= 0) return;
    for (std::size_t turn = 1; turn < edges; ++turn) faces_between(turn);
    if (room_ > 1 && edges_left_ > 0)
      for (std::size_t turn = 1; turn <= edges; ++turn) edge_and_back(turn);
  }

 private:
  const Vec3& point(std::size_t turn) const { return parent_.geometry.points[parent_.turns[turn]]; }
  const Wedge& wedge(std::size_t turn) const {
    return scene_.wedges.wedges[index_of(parent_.interactions[parent_.turns[turn] - 1])];
  }
  /// The faces between a turn and the next.
  std::span<const Interaction> faces_behind(std::size_t turn) const {
    const std::size_t first = parent_.turns[turn];
    return std::span(parent_.interactions).subspan(first, parent_.turns[turn + 1] - first - 1);
  }
  /// The image of the turn before or behind in the faces between, as this one sees it.
  Vec3 image_before(std::size_t turn) const {
    Vec3 image = point(turn - 1);
    for (const Interaction face : faces_behind(turn - 1)) image = mirrored(image, scene_.patches.patches[face]);
    return image;
  }
  Vec3 image_behind(std::size_t turn) const {
    const auto faces = faces_behind(turn);
    Vec3 image = point(turn + 1);
    for (std::size_t i = faces.size(); i-- > 0;) image = mirrored(image, scene_.patches.patches[faces[i]]);
    return image;
  }

  /// Where the shortest way from a to b passes the edge of that turn.
  Vec3 passed(std::size_t turn, const Vec3& a, const Vec3& b) const {
    const Wedge& edge = wedge(turn);
    return edge.point(passed_share(edge, a, b) * edge.length);
  }

  /// The mirrors of an end beyond the edge next to it.
  void mirrors_at(bool receiver) const {
    const std::size_t turn = receiver ? parent_.turns.size() - 2 : 1;
    const std::size_t position = receiver ? parent_.interactions.size() : 0;
    if (!(receiver ? faces_behind(turn) : faces_behind(0)).empty()) return;
    const Vec3 origin = receiver ? image_before(turn) : image_behind(turn);
    std::array<Interaction, max_depth> held;
    for (const EndView::Mirror& mirror : (receiver ? to_ : from_).mirrors()) {
      if (static_cast<int>(mirror.patches.size()) > std::min(room_, faces_left_)) continue;
      const Patch& last = scene_.patches.patches[mirror.patches.back()];
      if (!crosses_box(last, mirror.image, passed(turn, origin, mirror.image))) continue;
      const auto end = receiver ? std::reverse_copy(mirror.patches.begin(), mirror.patches.end(), held.begin())
                                : std::copy(mirror.patches.begin(), mirror.patches.end(), held.begin());
      propose_with(position, {held.begin(), end});
    }
  }

  /// The edges in view of an end.
  void edges_at(bool receiver) const {
    const std::size_t position = receiver ? parent_.interactions.size() : 0;
    const Interaction next = receiver ? parent_.interactions.back() : parent_.interactions.front();
    for (const EndView::Edge& edge : (receiver ? to_ : from_).edges()) {
      const Interaction added = edge_interaction(edge.wedge);
      if (is_edge(next)) {
        const Wedge &a = scene_.wedges.wedges[index_of(next)], &b = scene_.wedges.wedges[edge.wedge];
        if (added == next || hides_from(a, b, gap_) || hides_from(b, a, gap_)) continue;
      }
      propose_with(position, std::span(&added, 1));
    }
  }

  /// Faces between two edges, among those that are there, and ways from one of these to another and back.
  void faces_between(std::size_t turn) const {
    const auto faces = faces_behind(turn);
    const Vec3 before = image_before(turn), behind = image_behind(turn + 1);
    std::vector<Vec3> from = {point(turn)}, to(faces.size() + 1, point(turn + 1));
    for (const Interaction face : faces) from.push_back(mirrored(from.back(), scene_.patches.patches[face]));
    for (std::size_t i = faces.size(); i-- > 0;) to[i] = mirrored(to[i + 1], scene_.patches.patches[faces[i]]);
    for (std::uint32_t p = 0; p < scene_.patches.patches.size(); ++p) {
      const Patch& patch = scene_.patches.patches[p];
      for (std::size_t i = 0; i <= faces.size(); ++i) {
        // The edges are passed elsewhere then: each is moved in its turn.
        const Vec3 image = mirrored(to[i], patch), own_image = mirrored(from[i], patch);
        const Vec3 start = i == 0 ? passed(turn, before, image) : from[i];
        const Vec3 end = i == faces.size() ? passed(turn + 1, own_image, behind) : to[i];
        if (crosses_box(patch, image, start) || crosses_box(patch, own_image, end))
          propose_with(parent_.turns[turn] + i, std::array<Interaction, 1>{p});
        if (i > 0 && std::min(room_, faces_left_) > 1 && crosses_box(patch, mirrored(to[i - 1], patch), from[i]))
          propose_with(parent_.turns[turn] + i, std::array<Interaction, 2>{p, faces[i - 1]});
      }
    }
  }

  /// From an edge to a face and back to the edge.
  void edge_and_back(std::size_t turn) const {
    const Wedge& edge = wedge(turn);
    const Vec3 before = image_before(turn) - edge.start, behind = image_behind(turn) - edge.start;
    const double z0 = dot(before, edge.direction), z1 = dot(behind, edge.direction);
    const double r0 = norm(before - z0 * edge.direction), r1 = norm(behind - z1 * edge.direction);
    for (std::uint32_t p = 0; p < scene_.patches.patches.size(); ++p) {
      const Patch& patch = scene_.patches.patches[p];
      // On a face along the edge the way turns halfway between its two passages.
      const double away = std::abs(dot(patch.normal, point(turn)) - patch.offset);
      const double middle = z0 + (z1 - z0) * (r0 + away) / (r0 + 2 * away + r1);
      const Vec3 above = edge.start + middle * edge.direction;
      if (!crosses_box(patch, mirrored(above, patch), above)) continue;
      propose_with(parent_.turns[turn], std::array<Interaction, 2>{p, parent_.interactions[parent_.turns[turn] - 1]});
    }
  }

  /// A face in place of an edge that bounds it, and an edge in place of its face.
  void exchange() const {
    std::vector<Interaction> child = parent_.interactions;
    for (Interaction& here : child) {
      const Interaction own = here;
      if (is_edge(own) && faces_left_ > 0) {
        const Wedge& edge = scene_.wedges.wedges[index_of(own)];
        for (const std::uint32_t patch : {edge.patch0, edge.patchn}) {
          here = patch;
          proposer_.propose(child, out_);
        }
      } else if (!is_edge(own) && edges_left_ > 0) {
        for (const std::uint32_t rim : rims_.of(own)) {
          here = edge_interaction(rim);
          proposer_.propose(child, out_);
        }
      }
      here = own;
    }
  }

  /// The parent with more interactions at a place.
  void propose_with(std::size_t position, std::span<const Interaction> added) const {
    std::array<Interaction, max_depth> held;
    const auto middle = parent_.interactions.begin() + static_cast<std::ptrdiff_t>(position);
    auto end = std::copy(parent_.interactions.begin(), middle, held.begin());
    end = std::copy(added.begin(), added.end(), end);
    end = std::copy(middle, parent_.interactions.end(), end);
    proposer_.propose({held.begin(), end}, out_);
  }

  const Scene& scene_;
  const EndView &from_, &to_;
  const Proposer proposer_;
  const PatchRims& rims_;
  const Parent& parent_;
  const double gap_;
  Candidates& out_;
  int room_, edges_left_, faces_left_;
};

/// The parents of largest bound, that first, without those below `least`.
void keep_strongest(std::vector<Parent>& parents, double least) {
  std::erase_if(parents, [&](const Parent& parent) { return parent.bound < least; });
  std::sort(parents.begin(), parents.end(), [](const Parent& a, const Parent& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.interactions < b.interactions;
  });
  parents.resize(std::min(parents.size(), most_parents));
}

}  // namespace

SequenceTable extend_paths(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                           const EndView& from_transmitter, const EndView& from_receiver,
                           std::span<const Arrival> arrivals, std::span<const SequenceTable* const> known,
                           std::uint64_t& shadow_rays, const std::atomic<bool>* stop) {
  SequenceTable longer;
  if (plan.request.depth < 3) return longer;
  std::vector<const SequenceTable*> tables(known.begin(), known.end());
  tables.push_back(&longer);
  const Vec3 &source = from_transmitter.eye(), &point = from_receiver.eye();
  const PatchRims rims(scene);
  double power = 0;
  std::vector<Parent> parents;
  for (const Arrival& arrival : arrivals) {
    power += received_power(arrival.field[0], Polarisation::both);
    parents.push_back(parent_of(scene, plan, arrival.interactions, arrival.geometry));
  }
  for (int round = 0; round < most_rounds && !parents.empty() && !(stop && *stop); ++round) {
    keep_strongest(parents, negligible_rest(plan) * power);
    std::vector<Candidates> blocks(parents.size());
    for_each_block(
        parents.size(), plan.request.threads,
        [&](std::size_t number, unsigned) {
          Extender(scene, tracer, plan, from_transmitter, from_receiver, tables, rims, parents[number], blocks[number])
              .extend();
        },
        stop);
    std::vector<std::uint32_t> found =
        add_strongest(scene, tracer, plan, transmitter, point, blocks, power, longer, shadow_rays, stop);
    for (const std::uint32_t sequence :
         add_near_edges(scene, tracer, plan, transmitter, point, found, known, longer, shadow_rays, stop))
      found.push_back(sequence);
    parents.clear();
    for (const std::uint32_t sequence : found) {
      PathGeometry geometry;
      UnfoldedSequence unfolded(scene, source, longer[sequence], &plan.small_objects);
      if (unfolded.solve(point, 2 * pi / plan.wavenumber.front(), geometry))
        parents.push_back(parent_of(scene, plan, longer[sequence], geometry));
    }
  }
  return longer;
}

}  // namespace grimaldi
