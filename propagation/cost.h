#pragma once
// What a run will cost, told before it.

#include <atomic>
#include <optional>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Time and memory of a run, from small samples of it (`simulate_sample`); nothing for a run that is expected to take
/// less than `least_seconds`, for one without a map, and after `stop`. Receivers are left out. Inputs: a valid plan
/// with its rays (budgets of time and accuracy are not looked at); least_seconds ≥ 0 in s.
///
/// A first sample has about a thousandth of the beams (30,000 at the most) and cells. A longer run gets a second one,
/// of 2 % of the run's time but at most 4 s. With the share f of the beams and c of the cells:
/// * what the transmitter sees costs the same, the beams' walk 1/f of the sample's, growing c^−0.6 f^−(0.4 + g),
/// evaluating c^−1 f^−e; g = 0.08, e = 0.235,
///   and 0.2, 0.35 for depth 1, since fewer beams find fewer paths to each cell. These powers are measured (demo city,
///   Munich, Etoile and a grid of blocks; UTD and FSD; depth 1 to 3; 1e5 to 1e7 rays), not derived.
/// * the memory is what the program had before, the map, and twice (vectors grow) what seeds, sequences and pairs take,
///   their counts scaled likewise.
/// Wall time is processor time by the ratio of the two in the sample: as busy as the machine was then.
///
/// Error: predicted over true, in the 18 runs that the powers are from, before pairs were asked by name
/// (`discover_pairs`): processor time 0.76 to 1.22, memory 0.70 to 1.15; in three others (transmitter, frequency, size
/// of the cells, sound) 0.97 to 1.1. With pairs, Munich at depth 3, 1.35e5 and 1e6 rays: 1.2 and 1.2 to 1.3. Scenes of
/// other kinds were not asked. The counts behind it are functions of (scene, plan, seed), the times are the clock's.
std::optional<Prediction> predict_cost(const Scene& scene, const Tracer& tracer, const Plan& plan, double least_seconds,
                                       const std::atomic<bool>* stop = nullptr);

/// A sample of the run and what it cost.
struct SampleCost {
  double beam_share = 1, cell_share = 1;  ///< in (0, 1]
  RunFigures figures;                     ///< of the sample
  int depth = 3;                          ///< of the plan
};

/// The law above: the whole run's cost from that of a sample. Wall time and memory leave out what does not grow with
/// the sample. Of the sample's figures those of the stages and the counts are read.
Prediction scaled_up(const SampleCost& sample);

}  // namespace grimaldi
