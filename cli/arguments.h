#pragma once
// What the user asks for on the command line. The one door to CLI11.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/contract.h"
#include "propagation/plan_file.h"

namespace grimaldi {

enum class Verb { none, coverage, profile, scene, eval, validate, compare };

struct Arguments {
  Verb verb = Verb::none;
  std::string input;  ///< the scenario; for `scene` a file or the name of a built-in scene; for `eval` the
                      ///< function; may be empty
  std::vector<PlanOption> options;  ///< direct options first, then --set, each in the order of the command line
  std::filesystem::path output;     ///< -o; empty = the default
  unsigned threads = 0;             ///< 0 = all processors
  bool overwrite = false, quiet = false, json = false, progress = false;
  bool predict = false;  ///< of `coverage` and `compare`: tell what the run will cost, and do not run it
  std::string rows_in = "-", rows_out = "-";  ///< of `eval`: files, - is stdin or stdout
  bool list = false, help = false;            ///< of `eval`: the functions, or what one of them is
  std::vector<std::string> cases;             ///< of `validate`, whose cases `list` lists; empty: all
  std::optional<std::string> print;           ///< help or version: print this and end with `exit_code`
  int exit_code = 0;
};

/// Reads the command line (argv[0] is the program). Direct options become keys of the scenario: --tx number N sets
/// transmitter.N.position, so it moves the scenario's N-th transmitter or adds one; --rx likewise. A relative --scene
/// counts from the working folder. Errors to `diagnostics`: unknown verb or option (did you mean), a verb of a later
/// version, a value that is missing or no number, --set without "=".
Arguments parse_arguments(int argc, const char* const* argv, Diagnostics& diagnostics);

}  // namespace grimaldi
