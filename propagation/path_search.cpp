#include "propagation/path_search.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "propagation/detour.h"
#include "propagation/effort.h"
#include "propagation/fermat.h"
#include "propagation/field.h"
#include "propagation/look_back.h"
#include "propagation/near_edges.h"

namespace grimaldi {

void grow_and_lead_around(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                          const CoverageGrid& grid, const Effort& effort, std::size_t first_seed, int most_edges,
                          Discovered& discovered, Grown& grown, const std::function<void(double)>& progress,
                          const std::atomic<bool>* stop) {
  // How many rounds there will be is not known: each is told as half of what was left.
  double done = 0;
  const auto report = [&](double share) {
    if (progress) progress(done + 0.5 * share * (1 - done));
  };
  for (bool more = true; more && !(stop && *stop); done += 0.5 * (1 - done)) {
    grow(scene, tracer, plan, transmitter, grid, effort, discovered, first_seed, grown, report, stop);
    auto& blocked = discovered.blocked;
    blocked.insert(blocked.end(), grown.blocked.begin(), grown.blocked.end());
    const Discovered found =
        detours(scene, tracer, plan, transmitter, grid, effort, discovered, grown.known, most_edges, stop);
    std::erase_if(blocked, [&](const BlockedPath& path) {
      return static_cast<int>(count_edges(discovered.sequences[path.sequence])) < most_edges;
    });
    more = !found.seeds.empty() || !found.blocked.empty();
    first_seed = discovered.append(found);
  }
}

SequenceTable search_for_point(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                               const EndView& from_transmitter, const EndView& from_receiver,
                               std::span<const Arrival> arrivals, const SequenceTable& known,
                               std::uint64_t& shadow_rays, const std::atomic<bool>* stop) {
  const PlanDescription& request = plan.request;
  const Vec3& point = from_receiver.eye();
  const Effort effort = effort_at_a_point(request);
  CoverageGrid spot;
  spot.layout.nx = spot.layout.ny = 1;
  spot.layout.cell = 1;
  spot.layout.x0 = point.x - 0.5;
  spot.layout.y0 = point.y - 0.5;
  spot.layout.z = point.z;
  spot.inside_fraction = {0};
  spot.sub_points = {{{}, 1, 1}};
  spot.ranges = {{0, 1}};
  Discovered here;
  here.sequences.enter(empty_sequence, {});
  here.blocked.push_back({0, 0, 0, 0});  // the direct wave; if nothing blocks it there is no way around
  look_back(scene, tracer, plan, transmitter, spot, BackwardBeams::all_round, here, stop);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (const auto size = static_cast<int>(known[i].size()); size > 0 && size < request.depth)
      here.seeds.push_back({here.sequences.enter(known.hash(i), known[i]), 0, ~0u, false, 0});
  std::sort(here.seeds.begin(), here.seeds.end(), [](const Seed& a, const Seed& b) { return a.sequence < b.sequence; });
  Grown grown;
  double power = 0;
  for (const Arrival& arrival : arrivals) power += received_power(arrival.field[0], Polarisation::both);
  grown.known = {power};
  grow_and_lead_around(scene, tracer, plan, transmitter, spot, effort, 0, most_edges(request), here, grown, {}, stop);
  std::vector<std::pair<double, std::uint32_t>> strongest;  // bound, sequence
  for (const Arrival& arrival : arrivals)
    strongest.emplace_back(-power_bound(scene, plan, arrival.interactions, arrival.geometry),
                           here.sequences.enter(arrival.hash, arrival.interactions));
  std::vector<std::uint32_t> around = add_second_edges(
      scene, tracer, plan, transmitter, point, effort.negligible_share * power, here.sequences, shadow_rays, stop);
  for (const Pair& pair : grown.pairs) around.push_back(pair.sequence);
  for (const std::uint32_t sequence :
       add_from_both_ends(scene, tracer, plan, transmitter, from_transmitter, from_receiver, power, known,
                          here.sequences, shadow_rays, stop))
    around.push_back(sequence);
  for (const std::uint32_t sequence : around) {
    const auto interactions = here.sequences[sequence];
    PathGeometry geometry;
    UnfoldedSequence unfolded(scene, request.transmitters[transmitter].position, interactions, &plan.small_objects);
    if (unfolded.solve(point, 2 * pi / plan.wavenumber.front(), geometry))
      strongest.emplace_back(-power_bound(scene, plan, interactions, geometry), sequence);
  }
  std::sort(strongest.begin(), strongest.end());
  std::vector<std::uint32_t> arriving;
  std::vector<bool> listed(here.sequences.size(), false);
  for (const auto& [bound, sequence] : strongest) {
    if (!listed[sequence]) arriving.push_back(sequence);
    listed[sequence] = true;
  }
  add_near_edges(scene, tracer, plan, transmitter, point, arriving, std::array{&known}, here.sequences, shadow_rays,
                 stop);
  shadow_rays += grown.shadow_rays + here.shadow_rays;
  SequenceTable found;
  for (std::size_t i = 0; i < here.sequences.size(); ++i)
    if (known.find(here.sequences.hash(i)) == SequenceTable::no_sequence)
      found.enter(here.sequences.hash(i), here.sequences[i]);
  return found;
}

}  // namespace grimaldi
