#include "propagation/ties.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "propagation/edge_chain.h"

namespace grimaldi {
namespace {

/// What one edge says of a wave that it bounds.
struct Tie {
  SequenceHash bounded;
  bool lit;
};

/// Calls act(position of the edge, face in its place or no_interaction, lit) for each tie of a path, until it is false.
template <typename Act>
void each_tie(const Scene& scene, const Plan& plan, double hair, const Arrival& arrival, const Act& act) {
  const EdgePlaces places(arrival.interactions);
  for (std::size_t e = 0; e < arrival.geometry.edge_count; ++e) {
    const EdgePassage& passage = arrival.geometry.edges[e];
    if (!passage.inside) continue;
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    // A displacement h at the edge across the ray turns both ways, by h/ρ' and h/ρ.
    const double turn = hair / passage.sin_beta * (1 / passage.s_in + 1 / passage.s_out);
    for (const auto& [boundary, face] : BoundedWaves(wedge, plan.request.reflection)) {
      const double epsilon = beyond_boundary(wedge, passage, boundary);
      if (std::abs(epsilon) < turn && !act(places[e], face, !is_dark(wedge, passage, epsilon))) return;
    }
  }
}

}  // namespace

bool has_tie(const Scene& scene, const Plan& plan, double hair, const Arrival& arrival) {
  bool found = false;
  each_tie(scene, plan, hair, arrival, [&](std::size_t, Interaction, bool) {
    found = true;
    return false;
  });
  return found;
}

bool settle_ties(const Scene& scene, const Plan& plan, double hair, std::vector<Arrival>& arrivals,
                 const std::function<bool(SequenceHash, Arrival&)>& find) {
  std::vector<Tie> ties;
  std::vector<Arrival> taken_out;
  bool changed = false;
  for (std::size_t edges = max_edges; edges > 0; --edges) {
    ties.clear();
    const auto add_ties = [&](const std::vector<Arrival>& paths, bool arrive) {
      for (const Arrival& path : paths) {
        if (path.geometry.edge_count != edges) continue;
        each_tie(scene, plan, hair, path, [&](std::size_t position, Interaction face, bool lit) {
          if (arrive || !lit) ties.push_back({hash_without(path.interactions, position, face), lit});
          return true;
        });
      }
    };
    add_ties(arrivals, true);
    add_ties(taken_out, false);
    // One for each bounded wave, the dark ones first.
    std::sort(ties.begin(), ties.end(),
              [](const Tie& a, const Tie& b) { return std::tie(a.bounded, a.lit) < std::tie(b.bounded, b.lit); });
    const auto same = [](const Tie& a, const Tie& b) { return a.bounded == b.bounded; };
    ties.erase(std::unique(ties.begin(), ties.end(), same), ties.end());
    for (const Tie& tie : ties) {
      const auto there = std::find_if(arrivals.begin(), arrivals.end(),
                                      [&](const Arrival& arrival) { return arrival.hash == tie.bounded; });
      if ((there != arrivals.end()) == tie.lit) continue;
      if (!tie.lit) {
        taken_out.push_back(std::move(*there));
        arrivals.erase(there);
        changed = true;
      } else if (Arrival missing; find(tie.bounded, missing)) {
        arrivals.push_back(std::move(missing));
        changed = true;
      }
    }
  }
  return changed;
}

}  // namespace grimaldi
