// The program as it is shipped: exit codes, messages, files, interruption.

#include "tests/cli/program.h"

#include <nlohmann/json.hpp>

namespace grimaldi {
namespace {

using test::Outcome;
using test::Program;
namespace fs = std::filesystem;

const std::vector<std::string> coverage_files = {"coverage.png", "result.h5", "summary.json"};

TEST_F(Program, HelpAndVersion) {
  const Outcome alone = run({});
  EXPECT_EQ(alone.code, 1);
  EXPECT_NE(alone.out.find("coverage"), std::string::npos);
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("Examples"), std::string::npos);
  EXPECT_EQ(run({"profile", "--help"}).code, 0);
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("grimaldi ", 0), 0u);
  EXPECT_EQ(std::count(version.out.begin(), version.out.end(), '\n'), 1);
}

TEST_F(Program, BadInputEndsWithOneAndSaysWhere) {
  write("bad.toml",
        "[scene]\nbuiltin = \"demo-city\"\n[wave]\nfrequency = \"3.5m\"\n[[transmitter]]\nposition = [0, 0]\n");
  const struct {
    std::vector<std::string> words;
    std::vector<std::string> hints;
  } cases[] = {
      {{"cverage"}, {"did you mean coverage?"}},
      {{"tradeoff", "bad.toml"}, {"not in this version"}},
      {{"coverage", "absent.toml"}, {"absent.toml", "no such file"}},
      {{"coverage", "bad.toml"}, {"bad.toml:4: wave.frequency", "bad.toml:6: transmitter.0.position"}},
      {{"coverage", "--scene", "absent.xml"}, {"--scene absent.xml", "--frequency", "--tx"}},
      {{"coverage", "--unknown"}, {"--unknown"}},
      {{"scene", "absent.ply"}, {"absent.ply"}},
      {{"scene", "demo-citi"}, {"demo-citi"}},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.words.back());
    const Outcome outcome = run(one.words);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("error: ", 0), 0u) << outcome.err;
    for (const auto& hint : one.hints)
      EXPECT_NE(outcome.err.find(hint), std::string::npos) << hint << "\n" << outcome.err;
  }
  EXPECT_FALSE(exists("bad.out"));
}

TEST_F(Program, AProfileNeedsAReceiver) {
  const Outcome outcome = run({"profile", "--scene", "street-canyon", "--frequency", "1GHz", "--tx", "0,0,10"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("receiver"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("grimaldi.out"));
}

TEST_F(Program, CoverageWritesItsFilesAndATable) {
  const Outcome outcome = run(small("coverage", {"--cell-size", "10"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files_in("grimaldi.out"), coverage_files);  // and no temporary file
  EXPECT_NE(outcome.out.find("standard error"), std::string::npos) << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("grimaldi.out/coverage.png\n")) << outcome.out;
  EXPECT_EQ(outcome.err.find("%"), std::string::npos) << outcome.err;  // no progress: stderr is no terminal
  EXPECT_EQ(contents("grimaldi.out/coverage.png").substr(1, 3), "PNG");
}

TEST_F(Program, JsonIsTheSummaryAndNothingElse) {
  write("street.toml",
        "[scene]\nbuiltin = 'street-canyon'\n[wave]\nfrequency = '1GHz'\n[[transmitter]]\nposition = [0, 0, 10]\n"
        "[coverage]\ncell_size = 10\n[budget]\nrays = 20000\n[propagation]\ndepth = 1\n");
  const Outcome outcome = run({"coverage", "street.toml", "--json", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, contents("street.out/summary.json"));
  const auto summary = nlohmann::json::parse(outcome.out);
  for (const char* key : {"wall_seconds",
                          "cpu_seconds",
                          "trace_seconds",
                          "threads",
                          "peak_memory_bytes",
                          "rays",
                          "rays_per_second",
                          "segments",
                          "segments_per_second",
                          "shadow_rays",
                          "passes",
                          "mechanism_power",
                          "model_power",
                          "cells",
                          "cells_asked",
                          "cells_reached",
                          "median_standard_error_dB",
                          "flux",
                          "warnings",
                          "outputs"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["threads"], 1);
  EXPECT_EQ(summary["outputs"].size(), 3u);
  EXPECT_GT(summary["wall_seconds"].get<double>(), 0.0);
  EXPECT_LE(summary["cells_reached"].get<int>(), summary["cells_asked"].get<int>());
  EXPECT_LE(summary["cells_asked"].get<int>(), summary["cells"].get<int>());
}

TEST_F(Program, PredictTellsTheCostAndRunsNothing) {
  const Outcome json = run(small("coverage", {"--predict", "--json"}));
  ASSERT_EQ(json.code, 0) << json.err;
  const auto predicted = nlohmann::json::parse(json.out);
  for (const char* key : {"trace_seconds", "cpu_seconds", "peak_memory_bytes", "seconds_to_predict"})
    EXPECT_GT(predicted[key].get<double>(), 0) << key;
  const Outcome text = run(small("compare", {"--predict"}));
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("predicted"), std::string::npos) << text.out;
  EXPECT_FALSE(exists("grimaldi.out"));
}

TEST_F(Program, PredictNeedsTheNumberOfRays) {
  const Outcome outcome = run(
      {"coverage", "--scene", "street-canyon", "--frequency", "1GHz", "--tx", "0,0,10", "--time", "5s", "--predict"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("--rays"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("grimaldi.out"));
}

TEST_F(Program, XarrayOpensTheResultWithBothEngines) {
  ASSERT_EQ(run({"coverage", "--scene", "demo-city", "--frequency", "3.5GHz,28GHz", "--tx", "8.5,21,27", "--rx",
                 "120,20,1.5", "--rays", "20000", "--depth", "2", "--cell-size", "20", "-o", "out"})
                .code,
            0);
  // read_result.py opens each group with the netcdf4 and the h5netcdf engine and fails if they disagree in anything.
  const std::string command = "/usr/bin/python3 '" GRIMALDI_SOURCE "/tests/propagation/read_result.py' '" +
                              (folder_ / "out/result.h5").string() + "' coverage profile/rx1 > '" +
                              (folder_ / "read.json").string() + "' 2> '" + (folder_ / "read.err").string() + "'";
  const int status = std::system(command.c_str());
  if (status < 0 || WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127)
    GTEST_SKIP() << "needs /usr/bin/python3 with xarray, netCDF4 and h5netcdf";
  ASSERT_EQ(status, 0) << contents("read.err");
  const auto read = nlohmann::json::parse(contents("read.json"));
  EXPECT_EQ(read["attributes"]["format"], "grimaldi-result");
  const auto& map = read["groups"]["coverage"];
  EXPECT_EQ(map["dimensions"]["frequency"], 2);
  EXPECT_EQ(map["dimensions"]["transmitter"], 1);
  EXPECT_EQ(map["variables"]["frequency"]["values"], (nlohmann::json{3.5e9, 28e9}));
  EXPECT_EQ(map["variables"]["path_gain"]["dimensions"], (nlohmann::json{"transmitter", "frequency", "y", "x"}));
  // 700 m a side (the city and its rim) in cells of 20 m; some cell is reached, some lies wholly inside a house.
  const auto& gain = map["variables"]["path_gain"]["values"];
  EXPECT_EQ(gain.size(), 2u * 35 * 35);
  EXPECT_TRUE(std::any_of(gain.begin(), gain.end(), [](const auto& v) { return v.is_number() && v > 0; }));
  EXPECT_TRUE(std::any_of(gain.begin(), gain.end(), [](const auto& v) { return v.is_null(); }));
  EXPECT_TRUE(read["groups"]["profile/rx1"]["variables"].contains("power"));
}

TEST_F(Program, ProfileWritesItsFiles) {
  const Outcome outcome = run(small("profile", {"-o", "deep/er"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files_in("deep/er"), (std::vector<std::string>{"profiles.png", "result.h5", "summary.json"}));
  EXPECT_TRUE(outcome.out.ends_with("deep/er/profiles.png\n")) << outcome.out;
}

TEST_F(Program, QuietSaysNothing) {
  const Outcome outcome = run(small("profile", {"--quiet"}));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Program, ProgressOnRequest) {
  const Outcome outcome = run(small("profile", {"--progress"}));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find(" %\n"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);  // no terminal: whole lines
}

TEST_F(Program, AResultIsReplacedOnlyOnRequest) {
  const auto words = small("profile", {"-o", "out"});
  fs::create_directories(folder_ / "out");
  write("out/result.h5", "mine");
  write("out/coverage.png", "old");
  write("out/notes.txt", "notes");
  const Outcome refused = run(words);
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_EQ(contents("out/result.h5"), "mine");
  auto again = words;
  again.push_back("--overwrite");
  const Outcome replaced = run(again);
  ASSERT_EQ(replaced.code, 0) << replaced.err;
  // The picture of the older result is gone, what is not ours stays.
  EXPECT_EQ(files_in("out"), (std::vector<std::string>{"notes.txt", "profiles.png", "result.h5", "summary.json"}));
  EXPECT_EQ(contents("out/result.h5").substr(1, 3), "HDF");
}

TEST_F(Program, AFolderThatCannotBeIsRefusedBeforeTheRun) {
  write("file", "");
  // So many rays that the run would last for minutes: the refusal must come first.
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = run(small("coverage", {"-o", "file/out", "--rays", "1e9"}));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("file"), std::string::npos) << outcome.err;
  EXPECT_LT(seconds.count(), 20);  // the scene is read, no ray is traced; slack for a busy machine
  write("grimaldi.out", "");
  EXPECT_EQ(run(small("coverage")).code, 1);
  if (geteuid() != 0) {  // the superuser may write everywhere
    fs::create_directories(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(run(small("coverage", {"-o", "locked/out"})).code, 1);
    fs::permissions(folder_ / "locked", fs::perms::owner_all);
  }
}

TEST_F(Program, AnInterruptedRunLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start(small("coverage", {"--rays", "1e10", "--cell-size", "2", "--progress", "-o", "out"}));
    ASSERT_GT(child, 0);
    wait_until_it_traces();
    const auto begin = std::chrono::steady_clock::now();
    kill(child, signal);
    const Outcome outcome = wait(child);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(outcome.code, 1) << "signal " << outcome.signal << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_LT(seconds.count(), 5);  // about a second is promised; slack for a busy machine or a sanitizer
    EXPECT_FALSE(exists("out"));    // the folder was ours and is empty: gone
  }
}

TEST_F(Program, AnInterruptedRunLeavesTheOlderResult) {
  fs::create_directories(folder_ / "out");
  write("out/result.h5", "mine");
  const pid_t child = start(small("coverage", {"--rays", "1e10", "--progress", "-o", "out", "--overwrite"}));
  wait_until_it_traces();
  kill(child, SIGKILL);
  EXPECT_EQ(wait(child).signal, SIGKILL);
  EXPECT_EQ(files_in("out"), std::vector<std::string>{"result.h5"});
  EXPECT_EQ(contents("out/result.h5"), "mine");
}

TEST_F(Program, SceneTellsWhatItSees) {
  const Outcome outcome = run({"scene", "box", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  // A room of 10 m × 12 m × 8 m: six faces of two triangles, 2 · (120 + 80 + 96) m² of wall, and no edge that
  // diffracts.
  EXPECT_EQ(json["triangles"], 12);
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["extent"], (nlohmann::json{{0.0, 0.0, 0.0}, {10.0, 12.0, 8.0}}));
  double area = 0;
  for (const auto& material : json["materials"]) area += material["area_m2"].get<double>();
  EXPECT_NEAR(area, 592, 1e-9);  // rounding of a dozen products
  EXPECT_EQ(json["wedges"]["count"], 0);
  for (const char* key : {"within_material", "across_materials"})
    EXPECT_TRUE(json["wedges"][key].contains("length_m")) << key;
  for (const char* key : {"free", "concave", "filled", "propagating"}) EXPECT_TRUE(json[key].contains("count")) << key;
  for (const char* key : {"degenerate", "duplicate", "non_manifold_edges", "holes", "flipped"})
    EXPECT_TRUE(json["defects"].contains(key)) << key;
  const Outcome table = run({"scene", "demo-city"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("wedges"), std::string::npos);
}

TEST_F(Program, SceneTakesKeysOfTheScene) {
  const Outcome outcome = run({"scene", "street-canyon", "--json", "--set", "scene.parameters.count=2", "--set",
                               "scene.replace_materials.brick=glass"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");  // feet on the ground and the end of the ground are no open rims
  const auto json = nlohmann::json::parse(outcome.out);
  // Two rows of two houses without floor, 4 walls and a roof each; every rim of house and ground is a boundary loop.
  EXPECT_EQ(json["defects"]["holes"], 5);
  EXPECT_EQ(json["open_rims"]["count"], 0);
  std::vector<std::string> names;
  for (const auto& material : json["materials"]) names.push_back(material["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"concrete", "glass", "metal"}));
  const Outcome screen = run({"scene", "half-plane", "--json"});
  EXPECT_EQ(nlohmann::json::parse(screen.out)["open_rims"]["count"], 1);
  EXPECT_NE(screen.err.find("1 open rim, 4000.0 m"), std::string::npos) << screen.err;
}

TEST_F(Program, AFullDiskOfStandardOutputIsAFaultNotSilence) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const pid_t child = fork();
  if (child == 0) {
    const int full = open("/dev/full", O_WRONLY);
    dup2(full, 1);
    execl(GRIMALDI_PROGRAM, GRIMALDI_PROGRAM, "--version", static_cast<char*>(nullptr));
    _exit(99);
  }
  EXPECT_EQ(wait(child).code, 2);
}

}  // namespace
}  // namespace grimaldi
