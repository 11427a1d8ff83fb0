#pragma once
// difference.png: both theories and their difference side by side.

#include "cli/comparison.h"
#include "cli/plot.h"

namespace grimaldi {

/// Cells that one theory alone reaches, on the map of the difference.
inline constexpr Colour only_fsd_colour{0, 158, 115}, only_utd_colour{240, 200, 0};

/// Half the width of the difference's scale: the 95 % quantile of its size, rounded up to 1, 2, 3, 5, 10, 15, 20, 30,
/// 40 dB; at least 1, at most 40.
double difference_scale(double p95_abs);

/// Three maps, FSD | UTD | FSD − UTD (one above the other where the map is twice as wide as high): the first two on one
/// scale as on coverage.png, the third on blue–white–red, symmetric about 0 dB. Cells inside a building grey, cells
/// that nothing reaches hatched, cells that one theory alone reaches marked. Axes in metres, buildings, transmitters, a
/// legend with counts, a title that says what it is. Requires both maps with the shapes of `plan`.
Canvas difference_picture(const Scene& scene, const Plan& plan, const Result& fsd, const Result& utd,
                          const Comparison& comparison);

}  // namespace grimaldi
