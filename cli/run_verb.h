#pragma once
// grimaldi coverage and grimaldi profile: scenario → scene → plan → result → files.

#include <chrono>

#include "cli/arguments.h"

namespace grimaldi {

/// Runs the scenario and writes DIR/result.h5, DIR/coverage.png or DIR/profiles.png, DIR/summary.json. `coverage`
/// without a section [coverage] takes its defaults; `profile` leaves the map out. `start` is when the program began,
/// for the wall time. Returns the exit code: 0, or 1 after an interruption (then no file is written). Throws
/// InputErrors with all faults of the scenario, the scene and the folder, before any ray is traced.
int run_verb(const Arguments& arguments, std::chrono::steady_clock::time_point start);

}  // namespace grimaldi
