#pragma once
// profiles.png: what arrives when at each receiver.

#include <cstddef>
#include <filesystem>

#include "cli/plot.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Receivers that one picture holds; a note says how many are left out.
inline constexpr std::size_t most_profiles = 12;

/// One panel per receiver, first band: the power-delay profile as bars in dB (path gain for radio, sound pressure level
/// for sound) over delay in ns (radio) or ms (sound), the strongest paths as stems, the first three numbered with their
/// interaction story, delay and strength; totals, mean delay and delay spread in the panel's heading. Each transmitter
/// has its colour (eight, then they repeat). The scale reaches from the strongest, rounded up to 10 dB, down by the
/// dynamic range of the plan, at least 40 dB; weaker arrivals are not drawn. Requires profiles with the shapes of
/// `plan`.
Canvas profile_picture(const Plan& plan, const Result& result);

/// Writes profile_picture to `file` as PNG under a temporary name and renames. Throws InputErrors if it cannot be
/// written.
void draw_profiles(const std::filesystem::path& file, const Plan& plan, const Result& result);

}  // namespace grimaldi
