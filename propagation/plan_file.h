#pragma once
// The scenario: a TOML file, options of the command line laid over it, or options alone.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/bands.h"
#include "core/contract.h"
#include "core/material.h"
#include "core/medium.h"
#include "core/vector.h"

namespace grimaldi {

enum class AntennaPattern { isotropic, dipole, short_dipole };
enum class Polarisation { vertical, horizontal, both };
enum class DiffractionModel { fsd, fsd_published, utd, automatic };

/// Antenna of a transmitter. azimuth: degrees clockwise from north; tilt: degrees downwards. An isotropic antenna
/// radiates one polarisation equally in all directions (V: E along the unit vector of growing polar angle θ, H: along
/// that of azimuth).
struct Antenna {
  AntennaPattern pattern = AntennaPattern::isotropic;
  Polarisation polarisation = Polarisation::vertical;  ///< vertical or horizontal
  double azimuth = 0, tilt = 0;
};

struct Transmitter {
  std::string name;
  Vec3 position;
  std::vector<double>
      power;  ///< dBm (radio, conducted) or dB re 1 pW (sound), one or one per band of `frequency`; 0 if not given
  Antenna antenna;
};

struct Receiver {
  std::string name;
  Vec3 position;
  Polarisation polarisation = Polarisation::both;
};

struct CoverageRequest {
  double height = 1.5;                        ///< m above the ground below the cell
  double cell_size = 5.0;                     ///< m
  std::optional<std::array<double, 4>> area;  ///< xmin, ymin, xmax, ymax; default the scene's extent
  Polarisation polarisation = Polarisation::both;
};

struct ProfileRequest {
  double resolution = 10e-9;  ///< s; documented default: 10 ns for radio, 1 ms for sound
  double dynamic_range = 60;  ///< dB, threshold of the delay spreads below the strongest path (ITU-R P.1407)
  std::size_t max_paths = 100;
};

struct Origin {
  double latitude = 0, longitude = 0, height = 0, bearing = 0;  ///< degrees, m; kept and written into the result
};

/// What the scenario says, in SI units, before it is held against a scene.
struct PlanDescription {
  std::string text;                     ///< the scenario as TOML text, options applied: enough to run it again
  std::filesystem::path scenario_file;  ///< empty if given by options alone
  // [scene]
  std::filesystem::path scene_file;  ///< resolved against the scenario's folder; empty if builtin
  std::string builtin;
  std::map<std::string, double> builtin_parameters;  ///< [scene.parameters], SI
  std::string default_material = "concrete";
  std::map<std::string, std::string> replace_materials;
  std::optional<Origin> origin;
  std::map<std::string, Material> materials;  ///< [[material]] by key
  // [wave]
  WaveKind kind = WaveKind::radio;
  std::vector<double> frequency;  ///< Hz, ascending (a wavelength is converted with the wave's speed)
  Air air;
  // [[transmitter]], [[receiver]], [coverage], [profile]
  std::vector<Transmitter> transmitters;
  std::vector<Receiver> receivers;
  std::optional<CoverageRequest> coverage;
  ProfileRequest profile;
  // [propagation]
  int depth = 3;
  int max_reflections = 1000, max_diffractions = 1000;
  bool direct = true, reflection = true, diffraction = true;
  DiffractionModel diffraction_model = DiffractionModel::fsd;
  // [budget]
  double rays = 1e6;               ///< with an accuracy or a time: those of the last round, once it was run
  std::optional<double> accuracy;  ///< dB; 95 % of the reached cells shall have a standard error below it
  std::optional<double> time;      ///< s from the start of the program
  std::uint64_t seed = 1;
  int passes = 16;
  unsigned threads = 0;  ///< 0 = all processors; not part of the result's identity
};

/// One option of the command line that sets a key, e.g. {"--set transmitter.0.power=30dBm", "transmitter.0.power",
/// "30dBm"}.
struct PlanOption {
  std::string option;  ///< as the user wrote it, for messages
  std::string key;  ///< dotted path; list members by number or, for transmitter, source, receiver and material, by name
  std::string value;  ///< TOML value, or bare text that is taken as a string
};

/// Reads `file` (may be empty: options alone) with `options` laid over it. All faults go to `diagnostics` with file and
/// line, or the option: unknown key (did you mean), missing key, unit of the wrong kind, wrong count of numbers, NaN or
/// infinity, a value out of its range, file not there, TOML that does not parse. What the contract names and this
/// version lacks is the error "not in this version".
PlanDescription read_plan(const std::filesystem::path& file, const std::vector<PlanOption>& options,
                          Diagnostics& diagnostics);

/// The part of a plan that makes a scene: `scene`, a file or the name of a built-in scene, with `options` that set keys
/// of [scene] and [[material]] laid over it. Faults as in `read_plan`; any other key is one.
PlanDescription read_scene_request(const std::string& scene, const std::vector<PlanOption>& options,
                                   Diagnostics& diagnostics);

}  // namespace grimaldi
