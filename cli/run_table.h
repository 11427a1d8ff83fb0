#pragma once
// What a run found, in a few lines for people.

#include <filesystem>
#include <string>
#include <vector>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "scenes/scene.h"

namespace grimaldi {

/// A short table: scene, rays, map, receivers (at most ten), time, warnings, files. `outputs`: result, picture,
/// summary; the last line is the path of the picture. Levels in dB of path gain (radio) or of 1/(4πd²) · 1 m² (sound),
/// first band.
std::string run_table(const Scene& scene, const Plan& plan, const Result& result, const std::filesystem::path& folder,
                      const std::vector<std::string>& outputs);

}  // namespace grimaldi
