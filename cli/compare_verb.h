#pragma once
// grimaldi compare: one scenario with both theories of diffraction.

#include "cli/arguments.h"

namespace grimaldi {

/// Runs the scenario with FSD and with UTD (same seed, so the same beams) and writes DIR/fsd and DIR/utd, each as
/// `coverage` does, DIR/difference.png, DIR/report.html and, last, DIR/compare.json. What the scenario says of
/// propagation.diffraction is replaced, but fsd-published is refused. A scenario with receivers and no [coverage] takes
/// the defaults of the map. In the summaries wall and CPU time are those of the model's own run, the peak of memory is
/// that of the program so far. Returns the exit code: 0, or 1 after an interruption (then no file is written). Throws
/// InputErrors with all faults of scenario, scene and folders, before any ray is traced.
int compare_verb(const Arguments& arguments);

}  // namespace grimaldi
