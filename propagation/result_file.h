#pragma once
// result.h5 and summary.json by contract.

#include <filesystem>
#include <string>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Writes result.h5 (HDF5, valid netCDF-4 with dimension scales, CF-1.11 attributes): groups /coverage and
/// /profile/<receiver>. Written under the hidden name .<file>.partial-<pid> in the same folder and renamed at the end;
/// a failure removes it and leaves an older result alone. Maps go to the file from where they lie, without a copy;
/// those above 64 KiB are cut into chunks, shuffled and deflated (level 1). Beyond the contract: root attributes
/// program, wave, scene, passes_planned, rays; attributes cell_size and z (m), polarisation of /coverage; position (m),
/// polarisation of a profile. Equal arguments give equal bytes (no time stamps). A receiver without paths has
/// dimensions path and point of length 0. Throws InputErrors if the folder cannot be written, the disk is full, or two
/// profiles have one name or a name that no group can have; std::logic_error if a vector of `result` has not the shape
/// of `plan`. Not for two threads at once (HDF5 keeps global state).
void write_result(const std::filesystem::path& file, const Scene& scene, const Plan& plan, const Result& result,
                  const std::string& program_version);

/// The text of summary.json (UTF-8, one object), keys by contract; `outputs` = file names written so far. Rates are
/// over trace_seconds, 0 if that is 0. Without coverage the figures of cells and mechanisms are 0. Bytes of file names
/// that are not UTF-8 become U+FFFD.
std::string summary_json(const Plan& plan, const Result& result, const std::vector<std::string>& outputs);

/// A prediction alone as JSON (UTF-8, one object), as summary.json has it under `predicted`.
std::string prediction_json(const Prediction& predicted);

/// Writes `text` to `file` under a temporary name and renames. Throws InputErrors if that fails.
void write_text(const std::filesystem::path& file, const std::string& text);

/// Figures over the cells, as in summary.json.
struct MapFigures {
  std::size_t cells = 0;
  std::size_t asked = 0;    ///< cells not wholly inside a solid
  std::size_t reached = 0;  ///< cells with path_gain > 0 (any transmitter, first band)
  /// 10 lg(1 + error/gain), median over the pairs (transmitter, cell) with path_gain > 0, first band; 0 of none.
  double median_standard_error_dB = 0;
  double p95_standard_error_dB = 0;              ///< 95 % of those pairs have less
  double mechanism_power[mechanism_count] = {};  ///< sum over cells and transmitters, first band
  double model_power[edge_model_count] = {};     ///< the same, of diffraction, by the model that carried it
};

/// Throws std::logic_error if the map has not the shape of the plan.
MapFigures map_figures(const Plan& plan, const CoverageMap& map);

}  // namespace grimaldi
