#include "propagation/candidates.h"

#include <algorithm>
#include <array>
#include <complex>

#include "core/constants.h"
#include "propagation/composite.h"
#include "propagation/connect.h"
#include "propagation/effort.h"
#include "propagation/field.h"

namespace grimaldi {

double negligible_rest(const Plan& plan) {
  constexpr double most = 1e-3;
  return std::min(most, effort_of(plan.request).negligible_share);
}

void Candidates::add(double bound, std::span<const Interaction> interactions) {
  list_.push_back({bound, interactions_.size(), interactions.size()});
  interactions_.insert(interactions_.end(), interactions.begin(), interactions.end());
}

Proposer::Proposer(const Scene& scene, const Plan& plan, const EndView& from, const EndView& to,
                   std::span<const SequenceTable* const> known)
    : scene_(scene),
      plan_(plan),
      from_(from),
      to_(to),
      known_(known.begin(), known.end()),
      wavelength_(2 * pi / plan.wavenumber.front()) {}

bool Proposer::in_view(const EndView& view, Interaction interaction, const EdgePassage& passage) const {
  if (!is_edge(interaction)) return true;
  const EndView::Edge* edge = view.edge_of(passage.wedge);
  const double share = passage.along / scene_.wedges.wedges[passage.wedge].length;
  return edge && !edge->shadow.is_dark(std::clamp(share, 0.0, 1.0));
}

void Proposer::propose(std::span<const Interaction> interactions, Candidates& out) const {
  PathGeometry geometry;
  UnfoldedSequence unfolded(scene_, from_.eye(), interactions, &plan_.small_objects);
  if (!unfolded.solve(to_.eye(), wavelength_, geometry)) return;
  if (geometry.edge_count > 0 && !(in_view(from_, interactions.front(), geometry.edges[0]) &&
                                   in_view(to_, interactions.back(), geometry.edges[geometry.edge_count - 1])))
    return;
  const SequenceHash hash = hash_of(interactions);
  if (!is_in(known_, hash)) out.add(power_bound(scene_, plan_, interactions, geometry), interactions);
}

std::vector<std::uint32_t> add_strongest(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                         std::size_t transmitter, const Vec3& point, std::span<const Candidates> blocks,
                                         double& power, SequenceTable& sequences, std::uint64_t& shadow_rays,
                                         const std::atomic<bool>* stop) {
  std::vector<Candidates::Candidate> ranked;
  SequenceTable listed;
  double left = 0;
  for (const Candidates& block : blocks)
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto [bound, interactions] = block[i];
      const SequenceHash hash = hash_of(interactions);
      if (listed.find(hash) != SequenceTable::no_sequence) continue;
      listed.enter(hash, interactions);
      ranked.push_back({bound, interactions});
      left += bound;
    }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.bound > b.bound; });
  const double share = negligible_rest(plan);
  const Transmitter& source = plan.request.transmitters[transmitter];
  std::vector<std::array<std::complex<double>, 2>> field(plan.bands());
  std::vector<std::uint32_t> added;
  for (const Candidates::Candidate& candidate : ranked) {
    if (left <= share * power || (stop && *stop)) break;
    left -= candidate.bound;
    PathGeometry geometry;
    UnfoldedSequence unfolded(scene, source.position, candidate.interactions, &plan.small_objects);
    if (!unfolded.solve(point, 2 * pi / plan.wavenumber.front(), geometry) ||
        !connected(scene, tracer, candidate.interactions, geometry, shadow_rays))
      continue;
    path_field(scene, plan, source, candidate.interactions, geometry, field);
    power += received_power(field[0], Polarisation::both);
    added.push_back(sequences.enter(hash_of(candidate.interactions), candidate.interactions));
  }
  return added;
}

double passed_share(const Wedge& wedge, const Vec3& a, const Vec3& b) {
  return std::clamp(crossing(wedge.start, wedge.direction, a, b) / wedge.length, 0.0, 1.0);
}

bool hides_from(const Wedge& wedge, const Wedge& other, double gap) {
  for (const Vec3& end : {other.start, other.end()}) {
    const Vec3 way = end - wedge.start;
    if (dot(way, wedge.normal0) > -gap || dot(way, wedge.normaln()) > -gap) return false;
  }
  return true;
}

}  // namespace grimaldi
