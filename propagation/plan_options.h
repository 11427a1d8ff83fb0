#pragma once
// Options of the command line laid over a scenario.

#include <vector>

#include "core/contract.h"
#include "propagation/plan_file.h"
#include "propagation/scenario_tree.h"

namespace grimaldi {

/// Brings the tree to one spelling: [[source]] joins [[transmitter]], a single table [transmitter] is a list of one,
/// "polarization" is "polarisation". Paths and lines stay those of the file, for messages.
void normalise_scenario(ScenarioNode& root);

/// Sets each option's key in the (normalised) tree, in their order. Members of transmitter, receiver and material are
/// named by number (0 is the first; the number after the last adds one) or by name; a name that is not there adds a
/// member if the file has none (material: always), else it is an error (did you mean). An option takes away what the
/// file said in its place otherwise: scene.file and scene.builtin (with its parameters), wave.frequency, wavelength,
/// octaves and third_octaves. Errors to `diagnostics`: a key that is no path, a number beyond the list, a step through
/// a value that is no table, text that is not UTF-8.
void lay_options(ScenarioNode& root, const std::vector<PlanOption>& options, Diagnostics& diagnostics);

}  // namespace grimaldi
