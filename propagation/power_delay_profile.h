#pragma once
// Point receivers: every sequence found is tried, and the paths that arrive are told one by one.

#include <atomic>

#include "propagation/discover.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "propagation/tracer.h"

namespace grimaldi {

/// The profiles of the plan's receivers, without paths yet: arrays of the right sizes, delay bins still empty.
std::vector<ReceiverProfile> empty_profiles(const Plan& plan);

/// Adds transmitter `transmitter` to `profiles`: connects every discovered sequence to every receiver, and
/// those that lead around what blocks them there (`search_for_point`) or extend what arrives (`extend_paths`).
/// total = Σ|h|² + interference of composites, total_coherent = Σ over the receiver's polarisations of |Σ h|²,
/// total_completed the same with each h times `left_at_depth`; delay statistics weighted by power over the paths within
/// the dynamic range below the strongest (ITU-R P.1407); paths strongest first (by power at the first band; ties by
/// sequence). Returns the shadow rays asked. The same bits on any number of threads.
std::uint64_t connect_receivers(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                                const SequenceTable& sequences, std::vector<ReceiverProfile>& profiles,
                                const std::atomic<bool>* stop);

/// Fills delay bins and power of each profile once all transmitters are in: bins of the plan's resolution from the
/// first to the last path (at least one bin, at most 100,000: then the resolution is coarsened to fit and a warning
/// says so), a bin holds Σ|h|² of its paths; the cross terms of composites stand in the total only.
void fill_bins(const Plan& plan, std::vector<ReceiverProfile>& profiles, std::vector<Diagnostic>& warnings);

}  // namespace grimaldi
