#pragma once
// What a run leaves behind; the shapes are those of result.h5 (row-major, last index fastest).

#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/contract.h"
#include "core/vector.h"
#include "propagation/edge_model.h"
#include "propagation/plan.h"

namespace grimaldi {

/// The layers of a map, in the order of the file.
enum class Mechanism { direct, reflection, transmission, diffraction, scattering, interference };
inline constexpr std::size_t mechanism_count = 6;
inline constexpr const char* mechanism_names[mechanism_count] = {"direct",      "reflection", "transmission",
                                                                 "diffraction", "scattering", "interference"};

/// T transmitters, F bands, M = 6 mechanisms, cells = ny × nx.
struct CoverageMap {
  std::vector<double> path_gain;         ///< [T][F][cells]; NaN = wholly inside a solid, 0 = asked and nothing arrived
  std::vector<double> standard_error;    ///< [T][F][cells]; same unit as path_gain
  std::vector<double> bias;              ///< [T][F][cells]; estimate of the gain not yet found, ≥ 0
  std::vector<double> mechanism_gain;    ///< [T][M][F][cells]
  std::vector<double> model_gain;        ///< [T][edge_model_count][cells]; diffraction at the first band by its model
  std::vector<double> mean_delay;        ///< [T][F][cells], s; NaN where nothing arrived
  std::vector<double> rms_delay_spread;  ///< [T][F][cells], s; NaN where nothing arrived
  std::vector<double> inside_fraction;   ///< [cells]
  std::vector<double> detection_limit;   ///< [T][cells]; gain that the run would have found with 95 % confidence
};

/// One path for people.
struct PathStory {
  double delay = 0;                             ///< s
  std::vector<std::complex<double>> amplitude;  ///< [polarisation][band]
  double departure_azimuth = 0, departure_elevation = 0, arrival_azimuth = 0, arrival_elevation = 0;  ///< degrees
  std::string interactions;  ///< tokens R:material, D:edge-number, by blanks
  std::vector<Vec3> points;  ///< transmitter, interaction points, receiver
  std::string models;        ///< of its edges in order, by blanks: the one of edge_model_names with the largest share
};

/// Profile at one receiver. T transmitters, F bands, B delay bins.
struct ReceiverProfile {
  std::string name;
  Vec3 position;
  std::vector<double> delay;                         ///< [B], bin centres, s, absolute
  std::vector<double> power;                         ///< [T][F][B]
  std::vector<double> total;                         ///< [T][F]; power sum of composites
  std::vector<double> total_coherent;                ///< [T][F]; all fields added per polarisation
  std::vector<double> total_completed;               ///< [T][F]; the same with what lies beyond the depth estimated
  std::vector<double> mean_delay, rms_delay_spread;  ///< [T][F], s; NaN where nothing arrived
  std::vector<std::vector<PathStory>> paths;         ///< [T], strongest first, at most max_paths
};

/// Shares of the launched flux; launched = absorbed + escaped + cut_by_depth.
struct FluxLedger {
  double launched = 0, absorbed = 0, escaped = 0, cut_by_depth = 0;
};

/// One of the runs that a budget of accuracy or time makes.
struct BudgetRound {
  double rays = 0;
  double seconds = 0;
  double error_dB = 0;  ///< 95 % of the reached cells have a standard error below it; 0 without a map
};

/// What ended the rounds: the accuracy was reached, the time was up, or there are no more rays.
enum class BudgetEnd { accuracy, time, rays };

/// What a run was told to cost before it began.
struct Prediction {
  double seconds = 0;              ///< wall time of finding and evaluating paths
  double cpu_seconds = 0;          ///< the same, of all threads together
  std::uint64_t memory_bytes = 0;  ///< largest memory of the program
  double pilot_seconds = 0;        ///< wall time of finding this out
};

struct RunFigures {
  double wall_seconds = 0, cpu_seconds = 0, trace_seconds = 0;
  double discover_seconds = 0, merge_seconds = 0, grow_seconds = 0,
         evaluate_seconds = 0;  ///< wall time of the stages; merge is part of discover
  double view_seconds = 0;      ///< part of discover that does not depend on the rays: what the transmitter sees
  double discover_cpu_seconds = 0, grow_cpu_seconds = 0, evaluate_cpu_seconds = 0;  ///< of all threads
  unsigned threads = 1;
  std::uint64_t peak_memory_bytes = 0;
  std::uint64_t rays = 0, segments = 0, shadow_rays = 0;
  std::uint64_t sequences = 0, sequence_cell_pairs = 0;
  std::uint64_t seeds = 0;  ///< pairs named by beams or led around what blocks a path
  int passes = 0;
  FluxLedger flux;
  std::vector<BudgetRound> rounds;  ///< empty where the rays were given
  BudgetEnd ended_by = BudgetEnd::rays;
  std::optional<Prediction> predicted;  ///< empty where none was worth its time
};

struct Result {
  std::optional<CoverageMap> coverage;
  std::vector<ReceiverProfile> profiles;
  RunFigures figures;
  std::vector<Diagnostic> warnings;
  bool interrupted = false;
};

}  // namespace grimaldi
