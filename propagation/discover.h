#pragma once
// Launched beams find the sequences: each beam leaves records of what it met and which cells it lit on the way.

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/sequence.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// A cell that a sequence may reach, with the passes (bits) in which a beam said so.
struct Seed {
  std::uint32_t sequence, cell, passes;
  bool crossed;  ///< a beam of the sequence crossed the cell; else one passed over or under it
  float gain;    ///< largest estimate of the beams that said so, over the wave at 1 m
};

/// A sequence whose path to a point of a cell something stands in the way of.
struct BlockedPath {
  std::uint32_t sequence, cell;
  std::uint8_t leg, point;  ///< of the path; of the cell's sub-points
};

struct Discovered {
  SequenceTable sequences;           ///< sorted; the empty sequence is number 0
  std::vector<Seed> seeds;           ///< sorted by sequence, then cell; unique
  std::vector<BlockedPath> blocked;  ///< still to be led around what blocks them
  FluxLedger flux;                   ///< of the launched beams, shares of all
  std::uint64_t rays = 0, segments = 0, shadow_rays = 0;
  double merge_seconds = 0;  ///< of one thread, uniting the blocks' records
  double view_seconds = 0;   ///< of one thread, what the transmitter sees (the same for any number of rays)

  /// Adds what a later search of the same transmitter found: its new sequences get the numbers after the ones there
  /// are, its seeds come behind the others, sorted among themselves and unique. Returns the number of their first. The
  /// ledger and the rays stay those of the first (the beams are the same).
  std::size_t append(const Discovered& later);
};

/// Which part of the paths to look for. Paths of two and more edges are many and mostly negligible: they are looked for
/// when the power that simpler ones bring to each cell is known.
struct Search {
  int fewest_edges = 0, most_edges = 1000;
  /// Per cell the power below which a path is negligible there; empty: none is. A beam whose estimate stays 10 dB below
  /// does not name the cell.
  std::vector<double> negligible;
  /// Of the beams of each pass every `stride`-th is launched, as if the others were there: a sample of the whole
  /// search.
  std::uint64_t stride = 1;
};

/// Launches the plan's rays from transmitter `transmitter` in plan.request.passes passes.
/// * A beam reflects at every face up to the depth. Each pass also aims beams at points of the wedges (one for 8
///   launched, at least one to each wedge, at most as many as there are rays): those that the transmitter sees are met
///   at all their length.
/// * From an edge met leaves a fan (16 beams for a first edge, else 6) on the Keller cone, azimuths drawn half
///   uniformly over the exterior and half close to the shadow and reflection boundaries; they go on in the same way.
///   After a reflection or an edge a beam meets the edges of the triangle that it hits within its footprint (¾ of the
///   spacing of the beams at its length, at least 14 mrad); while it has met faces alone it is also aimed at three
///   wedges of that patch or of its neighbours.
/// * A segment of a beam names the cell that it crosses and one cell, drawn at random, over or under which it passes: a
///   wave that leaves a wall or an upright edge at one height leaves it at others too.
/// * Paths 140 dB weaker than the wave at 1 m, by a bound on the way, are not sought.
/// Only which sequences are found depends on these choices, never how strong they are. Every sequence met is entered if
/// the plan has receivers, else those that named a cell. `progress` is told the share done. Ends early when `stop` is
/// set.
Discovered discover(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                    const Search& search, const std::function<void(double)>& progress, const std::atomic<bool>* stop);

/// Aims beams at pairs by name: from each edge in view of the transmitter at every face and (if the plan allows two
/// edges) every edge, by each face in view at every edge (`AimedPairs`). What launched beams meet by chance is missed
/// where one of the two is narrow or far, and a path over an edge and a face is often one of few that a cell has. The
/// beams go on by faces alone. With as many rays that every pair is asked, what is found counts as found by every pass.
Discovered discover_pairs(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                          const Search& search, const std::function<void(double)>& progress,
                          const std::atomic<bool>* stop);

}  // namespace grimaldi
