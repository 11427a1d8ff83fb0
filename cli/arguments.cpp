#include "cli/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "cli/version.h"
#include "scenes/canonical.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> verbs = {"coverage", "profile", "compare", "scene", "eval", "validate"};
const std::vector<std::string> later_verbs = {"tradeoff", "report"};

constexpr const char* examples = R"(Examples:
  grimaldi coverage city.toml
  grimaldi coverage city.toml --set coverage.cell_size=2 --set transmitter.0.power=30dBm -o fine
  grimaldi coverage --scene demo-city --frequency 3.5GHz --tx 8.5,21,27 --height 1.5 --cell-size 5 --rays 1e6 --depth 3 -o out
  grimaldi profile city.toml --rx 40,-60,1.5 --rx=-8,21,1.5
  grimaldi compare city.toml
  grimaldi scene city.xml --json
  grimaldi scene street-canyon --set scene.parameters.width=30
  grimaldi eval --list
  grimaldi eval utd --in rows.csv --out results.csv
  grimaldi validate
  grimaldi validate square extremes --overwrite

Numbers take units: 3.5GHz, 500Hz, 30dBm, 5m, 550nm; a bare number is SI.
Exit codes: 0 done, 1 bad input or interrupted, 2 a fault of the program, 3 a validation missed its tolerance.)";

// A direct option and the key of the scenario that it sets.
struct DirectOption {
  const char* flag;
  const char* key;
  const char* metavar;
  const char* help;
};

constexpr DirectOption wave_options[] = {
    {"--wave", "wave.kind", "KIND", "radio (default) or acoustic"},
    {"--frequency", "wave.frequency", "F[,F...]", "carriers or bands, e.g. 3.5GHz"},
    {"--rays", "budget.rays", "N", "rays per transmitter, over all passes (default 1e6)"},
    {"--accuracy", "budget.accuracy", "E",
     "in place of --rays: 95 % of the cells with a standard error below, e.g. 1dB"},
    {"--time", "budget.time", "T", "in place of --rays: what can be found in that time, e.g. 60s"},
    {"--depth", "propagation.depth", "N", "most interactions along a path (default 3)"},
    {"--diffraction", "propagation.diffraction", "MODEL", "fsd (default), utd, auto or fsd-published"},
    {"--mechanisms", "propagation.mechanisms", "M[,M...]", "of direct, reflection, diffraction (default: all)"},
    {"--seed", "budget.seed", "N", "seed of every random choice (default 1)"},
};
constexpr DirectOption map_options[] = {
    {"--height", "coverage.height", "H", "height of the map above the ground (default 1.5m)"},
    {"--cell-size", "coverage.cell_size", "D", "side of a cell (default 5m)"},
    {"--area", "coverage.area", "X0,Y0,X1,Y1", "south-west and north-east corner (default: the scene)"},
};

// What CLI11 fills for a run.
struct RunOptions {
  std::vector<std::pair<const DirectOption*, std::string>> direct;
  std::string scene;
  std::vector<std::string> transmitters, receivers, sets;
  std::string output, threads;
};

// One option of one value; given twice, the last counts.
CLI::Option* add_text(CLI::App& app, const std::string& flags, std::string& target, const std::string& metavar,
                      const std::string& help) {
  return app.add_option(flags, target, help)->type_name(metavar)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

// An option of one value that may be repeated; all values are kept.
void add_texts(CLI::App& app, const std::string& flags, std::vector<std::string>& target, const std::string& metavar,
               const std::string& help) {
  app.add_option(flags, target, help)
      ->type_name(metavar)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_run_options(CLI::App& app, RunOptions& run, Arguments& arguments, bool map) {
  app.allow_extras();
  app.add_option("scenario", arguments.input, "the scenario, a TOML file; options alone do too")->type_name("SCENARIO");
  add_text(app, "--scene", run.scene, "FILE|NAME",
           "scene file, or built-in: " + fmt::format("{}", fmt::join(canonical_names(), ", ")));
  const std::size_t count = std::size(wave_options) + (map ? std::size(map_options) : 0);
  run.direct.reserve(count);  // CLI11 keeps the addresses
  for (const auto& option : wave_options) run.direct.emplace_back(&option, "");
  if (map)
    for (const auto& option : map_options) run.direct.emplace_back(&option, "");
  for (auto& [option, value] : run.direct) add_text(app, option->flag, value, option->metavar, option->help);
  add_texts(app, "--tx", run.transmitters, "X,Y,Z",
            "transmitter in metres east, north, up; repeatable; --tx=-8,21,27 works too");
  add_texts(app, "--rx", run.receivers, "X,Y,Z", "point receiver; repeatable");
  add_texts(app, "--set", run.sets, "KEY=VALUE", "any key of the scenario, e.g. transmitter.0.power=30dBm; repeatable");
  add_text(app, "--threads", run.threads, "N", "0 (default) = all processors; the result does not depend on it");
  add_text(app, "-o,--output", run.output, "DIR", "folder of the results (default: name of the scenario + .out)");
  app.add_flag("--overwrite", arguments.overwrite, "replace a result that is already there");
  app.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  app.add_flag("--json", arguments.json, "print the summary as JSON, nothing else");
  if (map) app.add_flag("--predict", arguments.predict, "tell the run's time and memory beforehand, and do not run it");
  app.add_flag("--progress", arguments.progress, "show progress also where stderr is no terminal");
}

// "a,b,c" as the list "[a,b,c]"; what is a list already stays.
std::string as_list(const std::string& text) { return !text.empty() && text.front() == '[' ? text : "[" + text + "]"; }

bool is_list_option(const std::string& key, const std::string& value) {
  if (key == "coverage.area") return true;
  return (key == "wave.frequency" || key == "propagation.mechanisms") && value.find(',') != std::string::npos;
}

void take_sets(const std::vector<std::string>& sets, Arguments& arguments, Diagnostics& diagnostics) {
  for (const auto& set : sets) {
    const auto equals = set.find('=');
    if (equals == std::string::npos || equals == 0) {
      diagnostics.error("", 0, "--set " + set, "not KEY=VALUE", "", "write e.g. --set coverage.cell_size=5");
    } else {
      arguments.options.push_back({"--set " + set, set.substr(0, equals), set.substr(equals + 1)});
    }
  }
}

void take_threads(const std::string& text, Arguments& arguments, Diagnostics& diagnostics) {
  const char* end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, arguments.threads);
  // More threads than this only cost memory on any machine of today.
  if (fault != std::errc() || rest != end || arguments.threads > 1024)
    diagnostics.error("", 0, "--threads " + text, "out of range", "a whole number of threads 0 … 1024 is needed",
                      "0 takes all processors");
}

void take_run_options(const CLI::App& app, const RunOptions& run, Arguments& arguments, Diagnostics& diagnostics) {
  auto& options = arguments.options;
  const auto given = [&](const char* flag) { return app.get_option(flag)->count() > 0; };
  if (given("--scene")) {
    const auto& names = canonical_names();
    const bool built_in = std::find(names.begin(), names.end(), run.scene) != names.end();
    // A relative name in a scenario counts from the scenario's folder, one on the command line from the working folder.
    const bool move = !built_in && !arguments.input.empty() && !run.scene.empty();
    options.push_back({"--scene " + run.scene, built_in ? "scene.builtin" : "scene.file",
                       move ? fs::absolute(run.scene).string() : run.scene});
  }
  for (const auto& [option, value] : run.direct)
    if (given(option->flag))
      options.push_back({fmt::format("{} {}", option->flag, value), option->key,
                         is_list_option(option->key, value) ? as_list(value) : value});
  for (std::size_t i = 0; i < run.transmitters.size(); ++i)
    options.push_back(
        {"--tx " + run.transmitters[i], fmt::format("transmitter.{}.position", i), as_list(run.transmitters[i])});
  for (std::size_t i = 0; i < run.receivers.size(); ++i)
    options.push_back({"--rx " + run.receivers[i], fmt::format("receiver.{}.position", i), as_list(run.receivers[i])});
  take_sets(run.sets, arguments, diagnostics);
  arguments.output = run.output;
  if (given("-o") && run.output.empty()) diagnostics.error("", 0, "-o", "an empty name", "a folder is needed");
  if (given("--threads")) take_threads(run.threads, arguments, diagnostics);
}

void refuse_extras(const CLI::App& app, const Arguments& arguments, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  for (const auto& extra : app.remaining()) {
    const std::string word = extra.substr(0, extra.find('='));
    if (extra.size() > 1 && extra.front() == '-') {
      diagnostics.error("", 0, word, "unknown option", "", did_you_mean(word, known));
    } else {
      diagnostics.error("", 0, extra, "one argument too many",
                        fmt::format("\"{}\" was given before it", arguments.input),
                        "options begin with --; run one at a time");
    }
  }
}

// True if the first argument is no verb of this version; says so.
bool refuse_verb(const std::string& word, Diagnostics& diagnostics) {
  if (word.empty() || word.front() != '-') {
    if (std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return false;
    if (std::find(later_verbs.begin(), later_verbs.end(), word) != later_verbs.end()) {
      diagnostics.error("", 0, word, "not in this version", "", fmt::format("known: {}", fmt::join(verbs, ", ")));
    } else if (word.ends_with(".toml")) {
      diagnostics.error("", 0, word, "no verb", "the first word says what to do", "write grimaldi coverage " + word);
    } else {
      diagnostics.error("", 0, word, "unknown verb", "the first word says what to do", did_you_mean(word, verbs));
    }
    return true;
  }
  if (word == "-h" || word == "--help" || word == "--version") return false;
  diagnostics.error("", 0, word, "no verb", "the verb stands before its options",
                    fmt::format("known: {}", fmt::join(verbs, ", ")));
  return true;
}

}  // namespace

Arguments parse_arguments(int argc, const char* const* argv, Diagnostics& diagnostics) {
  Arguments arguments;
  CLI::App app("Grimaldi: how radio waves and sound travel through cities, diffraction included.", "grimaldi");
  app.set_version_flag("--version", std::string("grimaldi ") + program_version());
  app.footer(examples);
  app.require_subcommand(0, 1);
  RunOptions coverage_options, profile_options, compare_options;
  CLI::App& coverage = *app.add_subcommand("coverage", "coverage map, and point receivers if there are any");
  CLI::App& profile =
      *app.add_subcommand("profile", "power-delay profiles at point receivers, with the paths explained");
  CLI::App& compare =
      *app.add_subcommand("compare", "one scenario with both theories of diffraction, FSD and UTD, side by side");
  CLI::App& scene =
      *app.add_subcommand("scene", "what the program sees in a scene: triangles, wedges, materials, defects");
  add_run_options(coverage, coverage_options, arguments, true);
  add_run_options(profile, profile_options, arguments, false);
  add_run_options(compare, compare_options, arguments, true);
  coverage.footer("Writes DIR/result.h5, DIR/coverage.png, DIR/summary.json.\n\n" + std::string(examples));
  profile.footer("Writes DIR/result.h5, DIR/profiles.png, DIR/summary.json.\n\n" + std::string(examples));
  compare.footer(
      "Writes DIR/fsd and DIR/utd, each as coverage does, DIR/difference.png, DIR/compare.json, DIR/report.html.\n"
      "--predict tells of both runs; the comparison after them, a tenth of a millisecond or so per cell in a city, is "
      "not in it.\n\n" +
      std::string(examples));
  scene.allow_extras();
  scene.add_option("file", arguments.input, "a scene file, or the name of a built-in scene")->type_name("FILE|NAME");
  std::vector<std::string> scene_sets;
  add_texts(scene, "--set", scene_sets, "KEY=VALUE",
            "a key of [scene] or [[material]], e.g. scene.parameters.width=30; repeatable");
  scene.add_flag("--json", arguments.json, "print JSON, nothing else");
  scene.add_flag("--quiet", arguments.quiet, "no warnings");

  CLI::App& eval = *app.add_subcommand("eval", "one kernel over the rows of a CSV file");
  eval.allow_extras();
  eval.set_help_flag();  // a function has a help of its own
  eval.add_option("function", arguments.input, "which one")->type_name("FUNCTION");
  add_text(eval, "--in", arguments.rows_in, "ROWS.csv", "the rows to read; - (default) is stdin");
  add_text(eval, "--out", arguments.rows_out, "ROWS.csv",
           "the same rows with the results; - (default) is stdout; replaced if it is there");
  eval.add_flag("--list", arguments.list, "name the functions");
  eval.add_flag("--quiet", arguments.quiet, "no warnings");
  eval.add_flag("-h,--help", arguments.help, "what the function reads and gives");

  CLI::App& validate = *app.add_subcommand("validate", "how far the program is from the truth, case by case");
  validate.allow_extras();
  validate
      .add_option("case", arguments.cases, "cases by name, part of a name between strokes, or suite (default: all)")
      ->type_name("CASE");
  std::string validate_output, validate_threads;
  validate.add_flag("--list", arguments.list, "name the cases");
  add_text(validate, "-o,--output", validate_output, "DIR", "folder of the results (default: validate.out)");
  add_text(validate, "--threads", validate_threads, "N", "0 (default) = all processors");
  validate.add_flag("--overwrite", arguments.overwrite, "replace a result that is already there");
  validate.add_flag("--quiet", arguments.quiet, "print nothing but errors");
  validate.add_flag("--json", arguments.json, "print validate.json, nothing else");
  validate.add_flag("--progress", arguments.progress, "show progress also where stderr is no terminal");
  validate.footer("Writes DIR/validate.json, DIR/report.html and the figures. Exit code 3 if a case misses.");

  if (argc < 2) {
    arguments.print = app.help();
    arguments.exit_code = 1;
    return arguments;
  }
  if (refuse_verb(argv[1], diagnostics)) return arguments;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments.print = app.help();
    return arguments;
  } catch (const CLI::CallForVersion& version) {
    arguments.print = std::string(version.what()) + "\n";
    return arguments;
  } catch (const CLI::ParseError& fault) {
    diagnostics.error("", 0, "", fault.what(), "", fmt::format("grimaldi {} --help lists the options", argv[1]));
    return arguments;
  }
  if (coverage.parsed()) {
    arguments.verb = Verb::coverage;
    take_run_options(coverage, coverage_options, arguments, diagnostics);
    refuse_extras(coverage, arguments, diagnostics);
  } else if (profile.parsed()) {
    arguments.verb = Verb::profile;
    take_run_options(profile, profile_options, arguments, diagnostics);
    refuse_extras(profile, arguments, diagnostics);
  } else if (compare.parsed()) {
    arguments.verb = Verb::compare;
    take_run_options(compare, compare_options, arguments, diagnostics);
    refuse_extras(compare, arguments, diagnostics);
  } else if (scene.parsed()) {
    arguments.verb = Verb::scene;
    take_sets(scene_sets, arguments, diagnostics);
    refuse_extras(scene, arguments, diagnostics);
    if (arguments.input.empty())
      diagnostics.error("", 0, "scene", "no scene given", "",
                        fmt::format("name a file, or one of {}", fmt::join(canonical_names(), ", ")));
  }
  if (eval.parsed()) {
    arguments.verb = Verb::eval;
    refuse_extras(eval, arguments, diagnostics);
    if (arguments.help && arguments.input.empty()) arguments.print = eval.help();
    for (const auto& [flag, file] : {std::pair{"--in", &arguments.rows_in}, std::pair{"--out", &arguments.rows_out}})
      if (file->empty())
        diagnostics.error("", 0, flag, "an empty name", "a CSV file is needed", "- is stdin or stdout");
  }
  if (validate.parsed()) {
    arguments.verb = Verb::validate;
    arguments.output = validate_output;
    if (validate.get_option("-o")->count() > 0 && validate_output.empty())
      diagnostics.error("", 0, "-o", "an empty name", "a folder is needed");
    if (validate.get_option("--threads")->count() > 0) take_threads(validate_threads, arguments, diagnostics);
    refuse_extras(validate, arguments, diagnostics);
  }
  for (const auto& extra : app.remaining()) diagnostics.error("", 0, extra, "one argument too many");
  return arguments;
}

}  // namespace grimaldi
