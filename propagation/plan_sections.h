#pragma once
// The sections of a scenario, each read into its part of the description. `root` is the normalised tree with options
// applied; faults go to the reader's diagnostics, and what could not be read keeps its default.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "propagation/plan_file.h"
#include "propagation/scenario_reader.h"
#include "propagation/scenario_tree.h"

namespace grimaldi {

/// [scene]. Makes scene.file absolute, in the description and in the tree (so that the text runs again from any
/// folder); a relative one counts from `folder`.
void read_scene_section(ScenarioReader& reader, ScenarioNode& root, const std::filesystem::path& folder,
                        PlanDescription& plan);

/// [wave]: kind, air, frequencies (sorted, ascending). Returns the user's order: element i is the place that band i of
/// the plan has in the scenario.
std::vector<std::size_t> read_wave_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);

/// [[transmitter]] and [[receiver]], [coverage], [profile]; they need the kind of wave. Powers by band are brought from
/// the user's order to the plan's.
void read_transmitters(ScenarioReader& reader, const ScenarioNode& root, const std::vector<std::size_t>& user_order,
                       PlanDescription& plan);
void read_receivers(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);
void read_coverage_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);
void read_profile_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);

/// [propagation] and [budget].
void read_propagation_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);
void read_budget_section(ScenarioReader& reader, const ScenarioNode& root, PlanDescription& plan);

/// [[material]], with tables over frequency read from CSV files (made absolute as scene.file is).
void read_materials(ScenarioReader& reader, ScenarioNode& root, const std::filesystem::path& folder,
                    PlanDescription& plan);

}  // namespace grimaldi
