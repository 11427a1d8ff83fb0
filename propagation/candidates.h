#pragma once
// Sequences that may arrive at one point: proposed with what each can bring, asked for visibility strongest first.

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "propagation/both_ends.h"
#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// What all paths together may bring that are not asked for, as a share of the power: 0.1 % (0.004 dB), or
/// `Effort::negligible_share` if that is less.
double negligible_rest(const Plan& plan);

/// Sequences and the `power_bound` of each.
class Candidates {
 public:
  struct Candidate {
    double bound;
    std::span<const Interaction> interactions;
  };
  void add(double bound, std::span<const Interaction> interactions);
  std::size_t size() const { return list_.size(); }
  Candidate operator[](std::size_t i) const {
    return {list_[i].bound, {interactions_.data() + list_[i].first, list_[i].count}};
  }

 private:
  struct Entry {
    double bound;
    std::size_t first, count;
  };
  std::vector<Entry> list_;
  std::vector<Interaction> interactions_;
};

/// Proposes sequences between two ends, of what these see.
class Proposer {
 public:
  /// Scene, plan, views and tables stay alive as long as this. Sequences `known` are not proposed.
  Proposer(const Scene& scene, const Plan& plan, const EndView& from, const EndView& to,
           std::span<const SequenceTable* const> known);

  /// Adds a sequence to `out` if it is new and a path can take it whose first and last edge are in view, where they are
  /// passed, of the end next to them.
  void propose(std::span<const Interaction> interactions, Candidates& out) const;

 private:
  bool in_view(const EndView& view, Interaction interaction, const EdgePassage& passage) const;
  const Scene& scene_;
  const Plan& plan_;
  const EndView &from_, &to_;
  const std::vector<const SequenceTable*> known_;
  const double wavelength_;
};

/// Asks the candidates of all blocks for visibility, largest bound first, until the bounds of all that are left come to
/// less than `negligible_rest` of `power`, which grows by what is found. Of candidates of one bound, the first comes
/// first; one that is there twice counts once. Adds to `sequences` those that arrive at `point` and returns their
/// numbers, in the order in which they were asked. `shadow_rays` grows by the rays asked.
std::vector<std::uint32_t> add_strongest(const Scene& scene, const Tracer& tracer, const Plan& plan,
                                         std::size_t transmitter, const Vec3& point, std::span<const Candidates> blocks,
                                         double& power, SequenceTable& sequences, std::uint64_t& shadow_rays,
                                         const std::atomic<bool>* stop);

/// Where the shortest way from a to b over the line of the wedge passes it, as a share of its length from 0 to 1.
double passed_share(const Wedge& wedge, const Vec3& a, const Vec3& b);

/// True if the solid of `wedge` hides it from both ends of `other`, and so from all of it, by more than `gap` m.
bool hides_from(const Wedge& wedge, const Wedge& other, double gap);

}  // namespace grimaldi
