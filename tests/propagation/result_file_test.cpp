#include "propagation/result_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace grimaldi {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;
namespace fs = std::filesystem;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A folder of its own for each test, gone with it.
class ResultFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("grimaldi-result-file-" + std::string(test->name()) + "-" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string text_of(const fs::path& file) const {
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), {}};
  }
  Strings entries() const {
    Strings names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    return names;
  }
  /// What Python reads; null if xarray is not there. A file that Python cannot read is a failure.
  json read(const fs::path& file, const std::string& groups) const {
    const fs::path out = folder / "read.json", errors = folder / "read.err";
    const std::string command = "/usr/bin/python3 '" GRIMALDI_SOURCE "/tests/propagation/read_result.py' '" +
                                file.string() + "' " + groups + " >'" + out.string() + "' 2>'" + errors.string() + "'";
    const int status = std::system(command.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == 77 || code == 127) return nullptr;
    EXPECT_EQ(code, 0) << text_of(errors);
    return code == 0 ? json::parse(text_of(out)) : json::object();
  }

  fs::path folder;
};

#define NEEDS_XARRAY(data) \
  if ((data).is_null()) GTEST_SKIP() << "needs /usr/bin/python3 with xarray, netCDF4 and h5netcdf"

struct Case {
  Scene scene;
  Plan plan;
  Result result;
};

/// `base`, base + 1, … : every value differs from its neighbours, so that a wrong order of dimensions shows.
std::vector<double> ramp(std::size_t count, double base) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = base + double(i);
  return values;
}

/// Two transmitters, three bands, 4 × 2 cells of which the first lies inside a solid, two receivers, one in the dark.
Case small_case(WaveKind kind = WaveKind::radio) {
  Case c;
  c.scene.name = "demo-city";
  c.scene.fingerprint = 0x00ab54a98ceb1f0aULL;
  PlanDescription& request = c.plan.request;
  request.text = "[wave]\nkind = \"radio\" # Stra\u00dfe, 20 \u00b0C\n";
  request.kind = kind;
  request.seed = 18446744073709551615ULL;  // the largest seed there is must survive
  request.passes = 16;
  request.rays = 1e6;
  request.transmitters = {{"mast", {8.5, 21, 27}, {44}, {}}, {"Turm-\u00e4", {0, 0, 30}, {44}, {}}};
  request.receivers = {{"corner", {40, -60, 1.5}, Polarisation::horizontal}, {"dark.2", {1, 2, 3}, {}}};
  request.coverage = CoverageRequest{};
  request.origin = Origin{48.14, 11.57, 520, 12.5};
  c.plan.frequency = {1e9, 2e9, 3.5e9};
  c.plan.grid = {4, 2, -10, 30, 5, 1.5};

  const std::size_t cells = 8, T = 2, F = 3;
  CoverageMap map;
  map.path_gain = ramp(T * F * cells, 100);
  map.standard_error = ramp(T * F * cells, 200);
  map.bias = ramp(T * F * cells, 300);
  map.mechanism_gain = ramp(T * mechanism_count * F * cells, 1000);
  map.model_gain = ramp(T * edge_model_count * cells, 700);
  map.mean_delay = ramp(T * F * cells, 400);
  map.rms_delay_spread = ramp(T * F * cells, 500);
  map.inside_fraction = {1, 0, 0.25, 0, 0, 0, 0, 0};
  map.detection_limit = ramp(T * cells, 600);
  for (auto* layer : {&map.path_gain, &map.standard_error, &map.bias, &map.mechanism_gain, &map.mean_delay,
                      &map.rms_delay_spread, &map.detection_limit})
    for (std::size_t i = 0; i < layer->size(); i += cells) (*layer)[i] = nan_value;
  for (std::size_t tf = 0; tf < T * F; ++tf) {  // cell 1: asked, and nothing arrived
    map.path_gain[tf * cells + 1] = map.standard_error[tf * cells + 1] = 0;
    map.mean_delay[tf * cells + 1] = map.rms_delay_spread[tf * cells + 1] = nan_value;
  }
  c.result.coverage = map;

  const std::size_t P = c.plan.polarisations();
  ReceiverProfile corner;
  corner.name = "corner";
  corner.position = {40, -60, 1.5};
  corner.delay = {1e-7, 1.1e-7};
  corner.power = ramp(T * F * 2, 1);
  corner.total = ramp(T * F, 20);
  corner.total_coherent = ramp(T * F, 30);
  corner.total_completed = ramp(T * F, 35);
  corner.mean_delay = ramp(T * F, 40);
  corner.rms_delay_spread = ramp(T * F, 50);
  corner.mean_delay[5] = nan_value;
  const auto amplitudes = [&](double base) {
    std::vector<std::complex<double>> values;
    for (std::size_t i = 0; i < P * F; ++i) values.emplace_back(base + double(i), -base - double(i));
    return values;
  };
  corner.paths = {
      {{1e-7, amplitudes(1), 10, 20, 30, 40, "", {{0, 1, 2}, {3, 4, 5}}, ""},
       {1.1e-7, amplitudes(100), 11, 21, 31, 41, "R:concrete D:17", {{6, 7, 8}, {9, 10, 11}, {12, 13, 14}}, "utd"}},
      {{2e-7, amplitudes(200), 12, 22, 32, 42, "D:3", {{15, 16, 17}, {18, 19, 20}}, "fsd-polygon"}}};
  ReceiverProfile dark;
  dark.name = "dark.2";
  dark.total = dark.total_coherent = dark.total_completed = std::vector<double>(T * F, 0.0);
  dark.mean_delay = dark.rms_delay_spread = std::vector<double>(T * F, nan_value);
  dark.paths.resize(T);
  c.result.profiles = {corner, dark};

  RunFigures& run = c.result.figures;
  run.wall_seconds = 12.5;
  run.cpu_seconds = 20.25;
  run.trace_seconds = 10;
  run.threads = 2;
  run.peak_memory_bytes = 5'000'000'000;
  run.rays = 1'000'000;
  run.segments = 4'000'000;
  run.shadow_rays = 77;
  run.passes = 12;
  run.flux = {1, 0.25, 0.5, 0.25};
  c.result.warnings = {{Severity::warning, "city.toml", 3, "receiver.dark", "inside a solid", "", ""}};
  return c;
}

/// Values as the script prints them: NaN is null.
json numbers(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(std::isnan(value) ? json(nullptr) : json(value));
  return list;
}

// Values are compared for equality throughout: the file holds the same doubles, and JSON prints them to the last bit.

TEST_F(ResultFile, CoverageIsReadByBothEngines) {
  const Case c = small_case();
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "coverage");
  NEEDS_XARRAY(data);
  const json& group = data["groups"]["coverage"];
  EXPECT_EQ(group["dimensions"], json({{"transmitter", 2}, {"mechanism", 6}, {"frequency", 3}, {"y", 2}, {"x", 4}}));
  const json& v = group["variables"];
  const CoverageMap& map = *c.result.coverage;
  const Strings maps = {"transmitter", "frequency", "y", "x"};
  const struct {
    const char* name;
    Strings dimensions;
    const std::vector<double>& values;
    const char* units;
    bool may_miss;
  } expected[] = {
      {"path_gain", maps, map.path_gain, "1", true},
      {"standard_error", maps, map.standard_error, "1", true},
      {"bias", maps, map.bias, "1", true},
      {"mechanism_gain", {"transmitter", "mechanism", "frequency", "y", "x"}, map.mechanism_gain, "1", true},
      {"mean_delay", maps, map.mean_delay, "s", true},
      {"rms_delay_spread", maps, map.rms_delay_spread, "s", true},
      {"inside_fraction", {"y", "x"}, map.inside_fraction, "1", false},
      {"detection_limit", {"transmitter", "y", "x"}, map.detection_limit, "1", true},
      {"frequency", {"frequency"}, c.plan.frequency, "Hz", false},
      {"x", {"x"}, {-7.5, -2.5, 2.5, 7.5}, "m", false},
      {"y", {"y"}, {32.5, 37.5}, "m", false},
  };
  for (const auto& want : expected) {
    SCOPED_TRACE(want.name);
    const json& have = v[want.name];
    EXPECT_EQ(have["dimensions"], json(want.dimensions));
    EXPECT_EQ(have["values"], numbers(want.values));
    EXPECT_EQ(have["kind"], "f");
    EXPECT_EQ(have["attributes"]["units"], want.units);
    EXPECT_FALSE(have["attributes"]["long_name"].get<std::string>().empty());
    EXPECT_EQ(have["fill"], want.may_miss ? json(nullptr) : json("none"));  // null is NaN
    EXPECT_EQ(have["coordinate"].get<bool>(), want.dimensions == Strings{want.name});
  }
  EXPECT_EQ(v["transmitter"]["values"], json({"mast", "Turm-\u00e4"}));
  EXPECT_EQ(v["mechanism"]["values"],
            json({"direct", "reflection", "transmission", "diffraction", "scattering", "interference"}));
  EXPECT_TRUE(v["transmitter"]["coordinate"].get<bool>() && v["mechanism"]["coordinate"].get<bool>());
  EXPECT_EQ(v["x"]["attributes"]["standard_name"], "projection_x_coordinate");
  EXPECT_EQ(v["y"]["attributes"]["standard_name"], "projection_y_coordinate");
  EXPECT_EQ(v["x"]["attributes"]["axis"], "X");
  EXPECT_EQ(v["y"]["attributes"]["axis"], "Y");
  EXPECT_EQ(v.size(), 13u);  // the eleven above and two of names: nothing else lies in the group
  EXPECT_EQ(group["attributes"]["cell_size"], 5.0);
}

TEST_F(ResultFile, RootSaysWhatWasRun) {
  const Case c = small_case();
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "coverage");
  NEEDS_XARRAY(data);
  EXPECT_EQ(data["members"], json({"coverage", "profile"}));
  const json& root = data["attributes"];
  EXPECT_EQ(root["Conventions"], "CF-1.11");
  EXPECT_EQ(root["format"], "grimaldi-result");
  EXPECT_EQ(root["format_version"], 1);
  EXPECT_EQ(root["program_version"], "0.1.0");
  EXPECT_EQ(root["scenario"], c.plan.request.text);
  EXPECT_EQ(root["seed"].get<std::uint64_t>(), c.plan.request.seed);
  EXPECT_EQ(root["passes"], 12);
  EXPECT_EQ(root["rays_per_transmitter"], 1e6);
  EXPECT_EQ(root["scene_fingerprint"], "00ab54a98ceb1f0a");
  EXPECT_EQ(root["wall_seconds"], 12.5);
  EXPECT_EQ(root["cpu_seconds"], 20.25);
  EXPECT_EQ(root["origin_latitude"], 48.14);
  EXPECT_EQ(root["origin_longitude"], 11.57);
  EXPECT_EQ(root["origin_height"], 520.0);
  EXPECT_EQ(root["origin_bearing"], 12.5);
}

TEST_F(ResultFile, ProfileIsReadByBothEngines) {
  const Case c = small_case();
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "profile/corner");
  NEEDS_XARRAY(data);
  const json& group = data["groups"]["profile/corner"];
  EXPECT_EQ(group["dimensions"], json({{"transmitter", 2},
                                       {"frequency", 3},
                                       {"delay", 2},
                                       {"path", 2},
                                       {"polarisation", 2},
                                       {"point", 7},
                                       {"axis", 3}}));
  EXPECT_EQ(group["attributes"]["position"], json({40.0, -60.0, 1.5}));
  EXPECT_EQ(group["attributes"]["polarisation"], "H");
  const json& v = group["variables"];
  const auto holds = [&](const char* name, const Strings& dimensions, const json& values, const char* units) {
    SCOPED_TRACE(name);
    EXPECT_EQ(v[name]["dimensions"], json(dimensions));
    EXPECT_EQ(v[name]["values"], values);
    EXPECT_EQ(v[name]["attributes"].value("units", ""), units);
    EXPECT_FALSE(v[name]["attributes"]["long_name"].get<std::string>().empty());
  };
  const ReceiverProfile& p = c.result.profiles[0];
  const Strings each = {"transmitter", "path"}, levels = {"transmitter", "frequency"};
  holds("delay", {"delay"}, numbers(p.delay), "s");
  holds("power", {"transmitter", "frequency", "delay"}, numbers(p.power), "1");
  holds("total", levels, numbers(p.total), "1");
  holds("total_coherent", levels, numbers(p.total_coherent), "1");
  holds("total_completed", levels, numbers(p.total_completed), "1");
  holds("mean_delay", levels, numbers(p.mean_delay), "s");
  holds("rms_delay_spread", levels, numbers(p.rms_delay_spread), "s");
  holds("polarisation", {"polarisation"}, {"V", "H"}, "");
  holds("axis", {"axis"}, {"x", "y", "z"}, "");
  holds("path_count", {"transmitter"}, {2, 1}, "1");
  // The second transmitter has one path: its second place is unused.
  holds("path_delay", each, {1e-7, 1.1e-7, 2e-7, nullptr}, "s");
  holds("departure_azimuth", each, {10.0, 11.0, 12.0, nullptr}, "degree");
  holds("departure_elevation", each, {20.0, 21.0, 22.0, nullptr}, "degree");
  holds("arrival_azimuth", each, {30.0, 31.0, 32.0, nullptr}, "degree");
  holds("arrival_elevation", each, {40.0, 41.0, 42.0, nullptr}, "degree");
  holds("path_interactions", each, {"", "R:concrete D:17", "D:3", ""}, "");
  holds("path_models", each, {"", "utd", "fsd-polygon", ""}, "");
  std::vector<double> real;
  for (const double base : {1.0, 100.0, 200.0, nan_value})
    for (const double value : ramp(6, base)) real.push_back(value);
  std::vector<double> imaginary = real;
  for (double& value : imaginary) value = -value;
  const Strings amplitude = {"transmitter", "path", "polarisation", "frequency"};
  holds("path_amplitude_re", amplitude, numbers(real), "1");
  holds("path_amplitude_im", amplitude, numbers(imaginary), "1");
  // Ragged: path p has the points start[p] … start[p] + count[p], and all points belong to a path.
  holds("point_xyz", {"point", "axis"}, numbers(ramp(21, 0)), "m");
  holds("path_point_start", each, {0, 2, 5, 7}, "1");
  holds("path_point_count", each, {2, 3, 2, 0}, "1");
  EXPECT_EQ(v["path_point_count"]["kind"], "i");
  EXPECT_EQ(v["path_point_count"]["attributes"]["sample_dimension"], "point");
  EXPECT_EQ(v.size(), 24u);  // those above, transmitter and frequency: nothing else lies in the group
}

TEST_F(ResultFile, ReceiverWithoutPathsIsReadable) {
  const Case c = small_case();
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "profile/dark.2");
  NEEDS_XARRAY(data);
  const json& group = data["groups"]["profile/dark.2"];
  EXPECT_EQ(group["dimensions"]["path"], 0);
  EXPECT_EQ(group["dimensions"]["point"], 0);
  EXPECT_EQ(group["dimensions"]["delay"], 0);
  EXPECT_EQ(group["variables"]["path_count"]["values"], json({0, 0}));
  EXPECT_EQ(group["variables"]["total"]["values"], numbers(std::vector<double>(6, 0.0)));
}

TEST_F(ResultFile, SoundHasItsOwnUnits) {
  const Case c = small_case(WaveKind::acoustic);
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "coverage profile/corner");
  NEEDS_XARRAY(data);
  const json& coverage = data["groups"]["coverage"]["variables"];
  for (const char* name : {"path_gain", "standard_error", "bias", "mechanism_gain", "detection_limit"})
    EXPECT_EQ(coverage[name]["attributes"]["units"], "m-2") << name;
  const json& profile = data["groups"]["profile/corner"];
  EXPECT_EQ(profile["dimensions"]["polarisation"], 1);
  EXPECT_EQ(profile["variables"]["power"]["attributes"]["units"], "m-2");
  EXPECT_EQ(profile["variables"]["path_amplitude_re"]["attributes"]["units"], "m-1");  // its square is a gain
}

TEST_F(ResultFile, LargeMapsAreCompressedAndExact) {
  Case c = small_case();
  c.plan.grid = {150, 120, 0, 0, 1, 1.5};  // 2 × 3 × 18000 values: one chunk of 65536 does not hold them
  CoverageMap& map = *c.result.coverage;
  const std::size_t cells = c.plan.grid.size(), maps = 6 * cells;
  map.path_gain = ramp(maps, 1);
  map.standard_error = map.bias = map.mean_delay = map.rms_delay_spread = std::vector<double>(maps, 0.5);
  map.mechanism_gain.assign(6 * maps, 0.125);
  map.inside_fraction.assign(cells, 0);
  map.detection_limit.assign(2 * cells, 1);
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  // 23 layers, 22 of them constant: deflate (at most 1032 : 1 by its format) leaves little more than the ramp.
  const double written = double(fs::file_size(folder / "result.h5")),
               held = double(sizeof(double) * (11 * maps + 3 * cells));
  EXPECT_LT(written, 0.1 * held);
  const json data = read(folder / "result.h5", "coverage");
  NEEDS_XARRAY(data);
  for (const char* name : {"path_gain", "mechanism_gain", "detection_limit"}) {
    const json& storage = data["storage"][std::string("coverage/") + name];
    EXPECT_TRUE(storage["zlib"].get<bool>()) << name;
    EXPECT_EQ(storage["complevel"], 1) << name;
    EXPECT_TRUE(storage["shuffle"].get<bool>()) << name;
  }
  EXPECT_EQ(data["storage"]["coverage/x"]["chunking"], "contiguous");
  EXPECT_EQ(data["groups"]["coverage"]["variables"]["path_gain"]["values"], numbers(map.path_gain));
}

TEST_F(ResultFile, DimensionsAreFixedAndEmptyTextsAreRead) {
  Case c = small_case();
  c.scene.name.clear();  // an empty text, too, must be one that netCDF reads
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "coverage");
  NEEDS_XARRAY(data);
  EXPECT_EQ(data["attributes"]["scene"], "");
  for (const auto& [name, storage] : data["storage"].items()) EXPECT_FALSE(storage["unlimited"].get<bool>()) << name;
}

TEST_F(ResultFile, LongScenarioIsKeptWhole) {
  Case c = small_case();
  c.plan.request.text = std::string(200'000, '#') + "end";  // more than the 64 KiB of a plain attribute
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "coverage");
  NEEDS_XARRAY(data);
  EXPECT_EQ(data["attributes"]["scenario"], c.plan.request.text);
}

TEST_F(ResultFile, SameResultSameBytes) {
  const Case c = small_case();
  write_result(folder / "one.h5", c.scene, c.plan, c.result, "0.1.0");
  write_result(folder / "two.h5", c.scene, c.plan, c.result, "0.1.0");
  EXPECT_EQ(text_of(folder / "one.h5"), text_of(folder / "two.h5"));
  EXPECT_EQ(entries().size(), 2u);  // no temporary name is left
}

/// The one message of a write that fails; empty if it does not fail.
template <class Write>
std::string failure_of(const Write& write) {
  try {
    write();
  } catch (const InputErrors& errors) {
    return errors.what();
  }
  return {};
}

TEST_F(ResultFile, FolderThatIsNotThereIsOneClearError) {
  const Case c = small_case();
  const fs::path file = folder / "nowhere" / "result.h5";
  for (const std::string& message : {failure_of([&] { write_result(file, c.scene, c.plan, c.result, "0.1.0"); }),
                                     failure_of([&] { write_text(file, "text"); })}) {
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
    EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(ResultFile, FullDiskLeavesTheOldResultAlone) {
  // A limit on the size of files stands for the full disk: write() fails in the same place, with EFBIG.
  Case c = small_case();
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  write_text(folder / "summary.json", "old");
  const std::string before = text_of(folder / "result.h5");
  c.plan.request.text = std::string(1'000'000, '#');
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_action = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{100'000, old_limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  const std::string result_message =
      failure_of([&] { write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0"); });
  const std::string text_message = failure_of([&] { write_text(folder / "summary.json", c.plan.request.text); });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_action);
  EXPECT_NE(result_message.find("File too large"), std::string::npos) << result_message;
  EXPECT_NE(text_message.find("File too large"), std::string::npos) << text_message;
  EXPECT_EQ(text_of(folder / "result.h5"), before);
  EXPECT_EQ(text_of(folder / "summary.json"), "old");
  EXPECT_EQ(entries().size(), 2u);  // the temporary names are gone
  // And the next write works: HDF5 holds nothing back from the failure.
  write_result(folder / "next.h5", c.scene, c.plan, c.result, "0.1.0");
  EXPECT_GT(fs::file_size(folder / "next.h5"), 1'000'000u);
}

TEST_F(ResultFile, NamesThatCannotBeGroupsAreErrors) {
  Case c = small_case();
  for (const char* name : {".", "", "a/b", "dark.2"}) {
    c.result.profiles[0].name = name;
    const std::string message = failure_of([&] { write_result(folder / "r.h5", c.scene, c.plan, c.result, "1"); });
    EXPECT_NE(message.find("receiver.name"), std::string::npos) << '"' << name << "\": " << message;
  }
  EXPECT_TRUE(entries().empty());
}

TEST_F(ResultFile, ReceiverNamesWithSignsAreGroups) {
  Case c = small_case();
  c.result.profiles[0].name = "..";
  c.result.profiles[1].name = "-1_a.B";
  write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0");
  const json data = read(folder / "result.h5", "profile/-1_a.B");
  NEEDS_XARRAY(data);
  EXPECT_TRUE(data["storage"].contains("profile/../total"));
}

TEST_F(ResultFile, WrongShapeIsOurFault) {
  Case c = small_case();
  c.result.coverage->bias.pop_back();
  EXPECT_THROW(write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0"), std::logic_error);
  EXPECT_TRUE(entries().empty());
  c = small_case();
  c.result.profiles[0].paths[1][0].amplitude.pop_back();
  EXPECT_THROW(write_result(folder / "result.h5", c.scene, c.plan, c.result, "0.1.0"), std::logic_error);
  EXPECT_TRUE(entries().empty());
  c = small_case();
  c.result.coverage->mechanism_gain.pop_back();
  EXPECT_THROW(map_figures(c.plan, *c.result.coverage), std::logic_error);
  c = small_case();
  c.result.coverage->model_gain.pop_back();
  EXPECT_THROW(map_figures(c.plan, *c.result.coverage), std::logic_error);
}

TEST_F(ResultFile, TextIsWrittenWhole) {
  const std::string text("one\ntwo \u00e4 \0 three", 18);
  write_text(folder / "summary.json", "old");
  write_text(folder / "summary.json", text);
  EXPECT_EQ(text_of(folder / "summary.json"), text);
  EXPECT_EQ(entries(), Strings{"summary.json"});
}

/// One transmitter, two bands (only the first counts), five cells: inside a solid, dark, and three reached.
Case figures_case() {
  Case c = small_case();
  c.plan.request.transmitters.resize(1);
  c.plan.frequency = {1e9, 2e9};
  c.plan.grid = {5, 1, 0, 0, 1, 1.5};
  CoverageMap map;
  map.path_gain = {nan_value, 0, 1, 2, 4, nan_value, 9, 9, 9, 9};
  map.standard_error = {nan_value, 0, 1, 0, 36, nan_value, 9, 9, 9, 9};
  map.mechanism_gain.assign(mechanism_count * 10, 0);
  const auto layer = [&](Mechanism m) { return map.mechanism_gain.begin() + std::ptrdiff_t(m) * 10; };
  const double direct[] = {nan_value, 0, 1.5, 2, 2, nan_value, 7, 7, 7, 7};
  const double interference[] = {nan_value, 0, -0.5, 0, 0, nan_value, 7, 7, 7, 7};
  const double diffraction[] = {nan_value, 0, 0, 0, 2, nan_value, 7, 7, 7, 7};
  std::copy(std::begin(direct), std::end(direct), layer(Mechanism::direct));
  std::copy(std::begin(interference), std::end(interference), layer(Mechanism::interference));
  std::copy(std::begin(diffraction), std::end(diffraction), layer(Mechanism::diffraction));
  map.model_gain = {nan_value, 0, 0, 0, 1.5, nan_value, 0, 0, 0, 0.25, nan_value, 0, 0, 0, 0.25, nan_value, 0, 0, 0, 0};
  c.result.coverage = map;
  return c;
}

TEST(MapFigures, CountCellsAndAddLayers) {
  const Case c = figures_case();
  const MapFigures figures = map_figures(c.plan, *c.result.coverage);
  EXPECT_EQ(figures.cells, 5u);
  EXPECT_EQ(figures.asked, 4u);
  EXPECT_EQ(figures.reached, 3u);
  // Errors over gains 1, 0, 9, that is 3.01 dB, 0 dB, 10 dB; the median is 10 lg 2. 1e-12: rounding of one logarithm.
  EXPECT_NEAR(figures.median_standard_error_dB, 10 * std::log10(2.0), 1e-12);
  EXPECT_EQ(figures.mechanism_power[std::size_t(Mechanism::direct)], 5.5);
  EXPECT_EQ(figures.mechanism_power[std::size_t(Mechanism::diffraction)], 2.0);
  EXPECT_EQ(figures.model_power[std::size_t(EdgeModel::utd)], 1.5);
  EXPECT_EQ(figures.model_power[std::size_t(EdgeModel::fsd)], 0.25);
  EXPECT_EQ(figures.model_power[std::size_t(EdgeModel::polygon)], 0.25);
  EXPECT_EQ(figures.model_power[std::size_t(EdgeModel::published)], 0);
  EXPECT_EQ(figures.mechanism_power[std::size_t(Mechanism::interference)], -0.5);
  EXPECT_EQ(figures.mechanism_power[std::size_t(Mechanism::reflection)], 0.0);
}

TEST(MapFigures, ACellCountsOnceForTwoTransmitters) {
  const Case c = small_case();  // 8 cells, one inside, one dark, both for each of the two transmitters
  const MapFigures figures = map_figures(c.plan, *c.result.coverage);
  EXPECT_EQ(figures.asked, 7u);
  EXPECT_EQ(figures.reached, 6u);
}

TEST(Summary, HasTheKeysOfTheContract) {
  const Case c = figures_case();
  const json summary = json::parse(summary_json(c.plan, c.result, {"result.h5", "coverage.png"}));
  Strings keys;
  for (const auto& [key, value] : summary.items()) keys.push_back(key);
  EXPECT_EQ(keys, (Strings{"cells",
                           "cells_asked",
                           "cells_reached",
                           "cpu_seconds",
                           "flux",
                           "mechanism_power",
                           "median_standard_error_dB",
                           "model_power",
                           "outputs",
                           "p95_standard_error_dB",
                           "passes",
                           "peak_memory_bytes",
                           "rays",
                           "rays_per_second",
                           "segments",
                           "segments_per_second",
                           "sequence_cell_pairs",
                           "sequences",
                           "shadow_rays",
                           "stage_seconds",
                           "threads",
                           "trace_seconds",
                           "wall_seconds",
                           "warnings"}));
  EXPECT_EQ(summary["wall_seconds"], 12.5);
  EXPECT_EQ(summary["rays_per_second"], 1e5);      // 1e6 rays in 10 s
  EXPECT_EQ(summary["segments_per_second"], 4e5);  // 4e6 in 10 s
  EXPECT_EQ(summary["peak_memory_bytes"], 5'000'000'000u);
  EXPECT_EQ(summary["cells_reached"], 3);
  EXPECT_EQ(summary["model_power"], json({{"utd", 1.5}, {"fsd", 0.25}, {"fsd-polygon", 0.25}, {"fsd-published", 0.0}}));
  EXPECT_EQ(summary["mechanism_power"], json({{"direct", 5.5},
                                              {"reflection", 0.0},
                                              {"transmission", 0.0},
                                              {"diffraction", 2.0},
                                              {"scattering", 0.0},
                                              {"interference", -0.5}}));
  EXPECT_EQ(summary["flux"], json({{"launched", 1.0}, {"absorbed", 0.25}, {"escaped", 0.5}, {"cut_by_depth", 0.25}}));
  EXPECT_EQ(summary["warnings"], json::array({to_string(c.result.warnings[0])}));
  EXPECT_EQ(summary["outputs"], json({"result.h5", "coverage.png"}));
}

TEST(Summary, IsJsonWithoutCoverageTimeOrUtf8) {
  Case c = small_case();
  c.result.coverage.reset();
  c.result.figures.trace_seconds = 0;
  c.result.warnings[0].file = "caf\xe9.toml";  // Latin-1
  const std::string text = summary_json(c.plan, c.result, {});
  const json summary = json::parse(text);
  EXPECT_EQ(summary["cells"], 0);
  EXPECT_EQ(summary["median_standard_error_dB"], 0.0);
  EXPECT_EQ(summary["rays_per_second"], 0.0);
  EXPECT_TRUE(summary["outputs"].is_array());
  EXPECT_EQ(text.find("null"), std::string::npos);
}

}  // namespace
}  // namespace grimaldi
