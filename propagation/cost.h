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
///   evaluating c^−1 f^−e; g = 0.2, 0.07, 0.02 and e = 0.3, 0.2, 0.15 for depth 1, 2, 3 and more: the more sequences
///   are asked by name, the less the paths to a cell depend on the beams. These powers are measured, not derived.
/// * the memory is what the program had before, the map, and twice (vectors grow) what seeds, sequences and pairs take,
///   their counts scaled likewise.
/// Wall time is processor time by the ratio of the two in the sample: as busy as the machine was then.
///
/// Error: predicted over true processor time 0.82 to 1.28 in the nine runs that the powers are from (Munich, Etoile, a
/// grid of 16 demo cities; depth 1 to 3, UTD, 1e6 rays) and in others (Munich with 1.3e5 rays, the demo city with 1e6
/// and 4e6; `auto`); memory 0.73 to 2.25, most of it too much. Scenes of other kinds were not asked. The counts behind
/// it are functions of (scene, plan, seed), the times are the clock's.
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
