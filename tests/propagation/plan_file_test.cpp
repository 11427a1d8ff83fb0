// The scenario: what it parses to, and what is said of each kind of fault.

#include "propagation/plan_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "core/constants.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, with a scene file of that name in it.
class PlanFile : public testing::Test {
 protected:
  PlanFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::path(testing::TempDir()) / ("plan_file_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    write("city.ply", "ply\n");
  }
  ~PlanFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  PlanDescription read(const std::string& text, const std::vector<PlanOption>& options = {}) {
    diagnostics_ = {};
    return read_plan(write("scenario.toml", text), options, diagnostics_);
  }

  std::vector<Diagnostic> errors() const {
    std::vector<Diagnostic> list;
    for (const auto& diagnostic : diagnostics_.all())
      if (diagnostic.severity == Severity::error) list.push_back(diagnostic);
    return list;
  }

  std::string all_text() const {
    std::string text;
    for (const auto& diagnostic : diagnostics_.all()) text += to_string(diagnostic) + "\n";
    return text;
  }

  // Exactly one error, at this line and option, with this problem.
  void expect_one(const std::string& text, int line, const std::string& option, const std::string& problem,
                  const std::string& hint = "") {
    SCOPED_TRACE(text);
    read(text);
    ASSERT_EQ(errors().size(), 1u) << all_text();
    const Diagnostic fault = errors().front();
    EXPECT_EQ(fault.line, line) << all_text();
    EXPECT_EQ(fault.option, option);
    EXPECT_EQ(fault.problem, problem) << all_text();
    EXPECT_EQ(fs::path(fault.file).filename(), "scenario.toml");
    if (!hint.empty()) {
      EXPECT_NE((fault.why + fault.suggestion).find(hint), std::string::npos) << all_text();
    }
  }

  fs::path folder_;
  Diagnostics diagnostics_;
};

constexpr const char* minimal = R"([scene]
builtin = "demo-city"
[wave]
frequency = "3.5GHz"
[[transmitter]]
position = [1, 2, 3]
)";  // 6 lines; what a test adds begins in line 7

TEST_F(PlanFile, FullScenarioParsesToSiValues) {
  write("brick.csv", "# measured\nfrequency_GHz,relative_permittivity,conductivity\n1,3.9,0.03\n10,3.8,0.05\n");
  const PlanDescription plan = read(R"([scene]
file = "city.ply"
material = "itu_Brick"
replace_materials = { marble = "brick", "*" = "mat-metal" }
origin = { latitude = 48.14, longitude = 11.57, height = 520.0, bearing = "10deg" }
[wave]
kind = "radio"
frequency = ["28GHz", 3.5e9]
temperature = "20degC"
humidity = "40%"
pressure = "1013.25hPa"
[[transmitter]]
name = "mast"
position = [8.5, "21m", 0.027e3]
power = ["44dBm", 1]
antenna = { pattern = "dipole", polarization = "H", azimuth = 30, tilt = "4deg" }
[[source]]
position = [-1, 0, 2]
[coverage]
height = "150cm"
cell_size = 2.5
area = [-100, -50.5, 100, 50]
polarisation = "V"
[[receiver]]
name = "corner"
position = [40.0, -60.0, 1.5]
polarization = "H"
[profile]
resolution = "2ns"
dynamic_range = "40dB"
max_paths = 7
[propagation]
depth = 4
max_reflections = 2
max_diffractions = 1
mechanisms = ["direct", "diffraction"]
diffraction = "fsd-published"
[[material]]
name = "ITU Concrete"
relative_permittivity = 5.24
conductivity = "120mS/m"
thickness = "20cm"
absorption = { bands = ["125Hz", "1kHz"], values = [0.02, 0.03] }
[[material]]
name = "brick"
table = "brick.csv"
thickness = inf
[budget]
rays = "2e5"
seed = 99
passes = 8
)");
  ASSERT_EQ(errors().size(), 0u) << all_text();
  EXPECT_EQ(plan.scene_file.filename(), "city.ply");
  EXPECT_TRUE(fs::exists(plan.scene_file));
  EXPECT_EQ(plan.default_material, "brick");
  EXPECT_EQ(plan.replace_materials.at("marble"), "brick");
  EXPECT_EQ(plan.replace_materials.at("*"), "metal");
  ASSERT_TRUE(plan.origin);
  EXPECT_EQ(plan.origin->bearing, 10);
  // Values without a unit, or with one that is a power of ten, are the nearest doubles: no tolerance.
  EXPECT_EQ(plan.frequency, (std::vector<double>{3.5e9, 28e9}));
  EXPECT_DOUBLE_EQ(plan.air.temperature, 293.15);
  EXPECT_DOUBLE_EQ(plan.air.relative_humidity, 0.4);
  EXPECT_DOUBLE_EQ(plan.air.pressure, 101325);
  ASSERT_EQ(plan.transmitters.size(), 2u);
  EXPECT_EQ(plan.transmitters[0].name, "mast");
  EXPECT_EQ(plan.transmitters[0].position, (Vec3{8.5, 21, 27}));
  // The powers follow the bands into ascending order; 1 W is 30 dBm.
  ASSERT_EQ(plan.transmitters[0].power.size(), 2u);
  EXPECT_DOUBLE_EQ(plan.transmitters[0].power[0], 30);
  EXPECT_DOUBLE_EQ(plan.transmitters[0].power[1], 44);
  EXPECT_EQ(plan.transmitters[0].antenna.pattern, AntennaPattern::dipole);
  EXPECT_EQ(plan.transmitters[0].antenna.polarisation, Polarisation::horizontal);
  EXPECT_EQ(plan.transmitters[0].antenna.azimuth, 30);
  EXPECT_EQ(plan.transmitters[0].antenna.tilt, 4);
  EXPECT_EQ(plan.transmitters[1].name, "tx2");
  ASSERT_TRUE(plan.coverage);
  EXPECT_EQ(plan.coverage->height, 1.5);
  EXPECT_EQ(plan.coverage->cell_size, 2.5);
  EXPECT_EQ(*plan.coverage->area, (std::array<double, 4>{-100, -50.5, 100, 50}));
  EXPECT_EQ(plan.coverage->polarisation, Polarisation::vertical);
  ASSERT_EQ(plan.receivers.size(), 1u);
  EXPECT_EQ(plan.receivers[0].name, "corner");
  EXPECT_EQ(plan.receivers[0].polarisation, Polarisation::horizontal);
  EXPECT_DOUBLE_EQ(plan.profile.resolution, 2e-9);
  EXPECT_EQ(plan.profile.dynamic_range, 40);
  EXPECT_EQ(plan.profile.max_paths, 7u);
  EXPECT_EQ(plan.depth, 4);
  EXPECT_EQ(plan.max_reflections, 2);
  EXPECT_EQ(plan.max_diffractions, 1);
  EXPECT_TRUE(plan.direct && plan.diffraction);
  EXPECT_FALSE(plan.reflection);
  EXPECT_EQ(plan.diffraction_model, DiffractionModel::fsd_published);
  const Material& concrete = plan.materials.at("concrete");
  EXPECT_EQ(concrete.permittivity->value, std::vector<double>{5.24});
  EXPECT_DOUBLE_EQ(concrete.conductivity->value[0], 0.12);
  EXPECT_DOUBLE_EQ(concrete.thickness, 0.2);
  EXPECT_EQ(concrete.absorption->frequency, (std::vector<double>{125, 1000}));
  const Material& brick = plan.materials.at("brick");
  EXPECT_EQ(brick.permittivity->frequency, (std::vector<double>{1e9, 1e10}));
  EXPECT_EQ(brick.conductivity->value, (std::vector<double>{0.03, 0.05}));
  EXPECT_TRUE(std::isinf(brick.thickness));
  EXPECT_EQ(plan.rays, 2e5);
  EXPECT_EQ(plan.seed, 99u);
  EXPECT_EQ(plan.passes, 8);
}

TEST_F(PlanFile, SoundHasItsOwnKeysAndDefaults) {
  const PlanDescription plan = read(R"([scene]
builtin = "street-canyon"
parameters = { width = "12m", count = 3 }
[wave]
kind = "acoustic"
octaves = { from = "63Hz", to = "8kHz" }
[source]
position = [0, 0, 1]
sound_power_level = "93dB"
)");
  ASSERT_EQ(errors().size(), 0u) << all_text();
  EXPECT_EQ(plan.builtin_parameters.at("width"), 12);
  EXPECT_EQ(plan.builtin_parameters.at("count"), 3);
  EXPECT_EQ(plan.kind, WaveKind::acoustic);
  ASSERT_EQ(plan.frequency.size(), 8u);  // octaves 63 … 8000
  // IEC 61260-1: exact mid-band frequencies 10^(3n/10) kHz; one product and one power of rounding.
  EXPECT_NEAR(plan.frequency[0], 1000 * std::pow(10, -1.2), 1e-10);
  EXPECT_EQ(plan.transmitters.at(0).power, std::vector<double>{93});
  EXPECT_EQ(plan.profile.resolution, 1e-3);
  EXPECT_FALSE(plan.coverage);
}

TEST_F(PlanFile, AWavelengthIsConvertedWithTheSpeedOfTheWave) {
  const PlanDescription plan =
      read("scene = {builtin='box'}\nwave = {wavelength='550nm'}\ntransmitter = [{position=[1,1,1]}]\n");
  ASSERT_EQ(errors().size(), 0u) << all_text();
  EXPECT_DOUBLE_EQ(plan.frequency.at(0), speed_of_light / 550e-9);
  const PlanDescription sound = read(
      "scene = {builtin='box'}\nwave = {kind='acoustic', wavelength=1, temperature='20degC'}\ntransmitter = "
      "[{position=[1,1,1]}]\n");
  EXPECT_DOUBLE_EQ(sound.frequency.at(0), 343.2);  // ISO 9613-1 at 293.15 K
}

TEST_F(PlanFile, TheTextRunsAgainToTheSameDescription) {
  const PlanDescription first =
      read(std::string(minimal) + R"([[receiver]]
name = "a \"quoted\" one"
position = [0.1, -1e-7, 1.5e7]
[scene.parameters]
width = 0.30000000000000004
)",
           {{"--set budget.seed=5", "budget.seed", "5"}, {"--tx 4,5,6", "transmitter.0.position", "[4,5,6]"}});
  const std::vector<Diagnostic> before = diagnostics_.all();
  const PlanDescription again = read(first.text);
  EXPECT_EQ(again.text, first.text);  // a fixed point: nothing is lost or reordered
  EXPECT_EQ(again.seed, 5u);
  EXPECT_EQ(again.transmitters.at(0).position, (Vec3{4, 5, 6}));
  EXPECT_EQ(again.receivers.at(0).position, (Vec3{0.1, -1e-7, 1.5e7}));  // every bit
  EXPECT_EQ(again.receivers.at(0).name, "a \"quoted\" one");
  EXPECT_EQ(again.builtin_parameters.at("width"), 0.30000000000000004);
  EXPECT_EQ(diagnostics_.all().size(), before.size());
}

TEST_F(PlanFile, TheTextRunsAgainFromAnotherFolder) {
  const PlanDescription first =
      read("[scene]\nfile = 'city.ply'\n[wave]\nfrequency = 1e9\n[[transmitter]]\nposition = [0, 0, 9]\n");
  ASSERT_EQ(errors().size(), 0u) << all_text();
  fs::create_directories(folder_ / "elsewhere");
  diagnostics_ = {};
  const PlanDescription again = read_plan(write("elsewhere/scenario.toml", first.text), {}, diagnostics_);
  EXPECT_EQ(errors().size(), 0u) << all_text();
  EXPECT_TRUE(fs::equivalent(again.scene_file, folder_ / "city.ply"));
}

TEST_F(PlanFile, OptionsAloneAreAScenario) {
  const PlanDescription plan =
      read_plan("",
                {{"--scene demo-city", "scene.builtin", "demo-city"},
                 {"--frequency 3.5GHz", "wave.frequency", "3.5GHz"},
                 {"--tx -8,21,27m", "transmitter.0.position", "[-8,21,27m]"},
                 {"--mechanisms direct,reflection", "propagation.mechanisms", "[direct,reflection]"},
                 {"--set receiver.corner.position=[1,2,3]", "receiver.corner.position", "[1,2,3]"},
                 {"--set receiver.corner.polarization=H", "receiver.corner.polarization", "H"},
                 {"--set transmitter.0.name=7", "transmitter.0.name", "7"}},
                diagnostics_);
  ASSERT_EQ(errors().size(), 0u) << all_text();
  EXPECT_EQ(plan.builtin, "demo-city");
  EXPECT_EQ(plan.transmitters.at(0).position, (Vec3{-8, 21, 27}));
  EXPECT_EQ(plan.transmitters.at(0).name, "7");
  EXPECT_FALSE(plan.diffraction);
  EXPECT_EQ(plan.receivers.at(0).name, "corner");
  EXPECT_EQ(plan.receivers.at(0).polarisation, Polarisation::horizontal);
}

TEST_F(PlanFile, OptionsReplaceWhatTheFileSays) {
  const PlanDescription plan =
      read(std::string(minimal) +
               "[[receiver]]\nname = 'a'\nposition = [0, 0, 1]\n[[material]]\nname = 'wood'\nthickness = 1\n",
           {{"--scene city.ply", "scene.file", (folder_ / "city.ply").string()},
            {"--set wave.wavelength=1m", "wave.wavelength", "1m"},
            {"--set source.0.power=30dBm", "source.0.power", "30dBm"},
            {"--set receiver.a.position=[5, 5, 5]", "receiver.a.position", "[5, 5, 5]"},
            {"--set receiver.1.position=[6, 6, 6]", "receiver.1.position", "[6, 6, 6]"},
            {"--set material.metal.thickness=2cm", "material.metal.thickness", "2cm"}});
  ASSERT_EQ(errors().size(), 0u) << all_text();
  EXPECT_TRUE(plan.builtin.empty());
  EXPECT_EQ(plan.scene_file.filename(), "city.ply");
  EXPECT_DOUBLE_EQ(plan.frequency.at(0), speed_of_light);
  EXPECT_EQ(plan.transmitters.at(0).power.at(0), 30);
  ASSERT_EQ(plan.receivers.size(), 2u);
  EXPECT_EQ(plan.receivers[0].position, (Vec3{5, 5, 5}));
  EXPECT_EQ(plan.receivers[1].position, (Vec3{6, 6, 6}));
  EXPECT_DOUBLE_EQ(plan.materials.at("metal").thickness, 0.02);
  EXPECT_EQ(plan.materials.at("wood").thickness, 1);
}

TEST_F(PlanFile, FaultyOptionsAreNamedAsTheUserWroteThem) {
  const std::string with_receiver = std::string(minimal) + "[[receiver]]\nname = 'corner'\nposition = [0, 0, 1]\n";
  const struct {
    PlanOption option;
    std::string problem, hint;
  } cases[] = {
      {{"--set coverage.cell_sze=5", "coverage.cell_sze", "5"}, "unknown key", "cell_size"},
      {{"--set coverage.cell_size=5GHz", "coverage.cell_size", "5GHz"}, "unit of the wrong kind", "length"},
      {{"--tx 1,2", "transmitter.0.position", "[1,2]"}, "wrong count of numbers", "3 are needed"},
      {{"--tx 1,2,nan", "transmitter.0.position", "[1,2,nan]"}, "not finite", ""},
      {{"--set transmitter.4.power=1", "transmitter.4.power", "1"}, "no such member", "1 in the list"},
      {{"--set receiver.cornr.position=[1,2,3]", "receiver.cornr.position", "[1,2,3]"}, "no such member", "corner"},
      {{"--set wave.kind.x=1", "wave.frequency.x", "1"}, "not a key", ""},
      {{"--set transmitter.power=1", "transmitter.power", "1"}, "not a key", "transmitter.0"},
      {{"--set a..b=1", "a..b", "1"}, "not a key", ""},
      {{"--set transmitter.0.name=\xff", "transmitter.0.name", "\xff"}, "not UTF-8", ""},
      {{"--seed x", "budget.seed", "x"}, "not a number", ""},
      {{"--seed 1.5", "budget.seed", "1.5"}, "not a whole number", ""},
      {{"--scene nowhere.xml", "scene.file", "nowhere.xml"}, "no such file", "nowhere.xml"},
      {{"--diffraction uto", "propagation.diffraction", "uto"}, "unknown value", "utd"},
      {{"--mechanisms direct,scattering", "propagation.mechanisms", "[direct,scattering]"}, "not in this version", ""},
      {{"--mechanisms ", "propagation.mechanisms", "[]"}, "empty list", ""},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.option.option);
    read(with_receiver, {one.option});
    ASSERT_EQ(errors().size(), 1u) << all_text();
    EXPECT_EQ(errors()[0].option, one.option.option);
    EXPECT_EQ(errors()[0].line, 0);
    EXPECT_EQ(errors()[0].file, "");
    EXPECT_EQ(errors()[0].problem, one.problem) << all_text();
    EXPECT_NE(all_text().find(one.hint), std::string::npos) << all_text();
  }
}

TEST_F(PlanFile, UnknownKeysAreNamedWithTheirLineAndTheNearestOne) {
  const std::string m = minimal;
  expect_one(m + "[coverage]\ncell_sise = 5\n", 8, "coverage.cell_sise", "unknown key", "cell_size");
  expect_one(m + "[covrage]\n", 7, "covrage", "unknown key", "coverage");
  expect_one(m + "antenna = { patern = 'dipole' }\n", 7, "transmitter.0.antenna.patern", "unknown key", "pattern");
  expect_one(m + "[budget]\nthreads = 4\n", 8, "budget.threads", "unknown key", "rays");
}

TEST_F(PlanFile, WrongNumbersAreRefused) {
  const std::string m = minimal;
  expect_one(m + "[coverage]\ncell_size = '5GHz'\n", 8, "coverage.cell_size", "unit of the wrong kind", "length");
  expect_one(m + "[coverage]\ncell_size = 0\n", 8, "coverage.cell_size", "out of range", "greater than 0");
  expect_one(m + "[coverage]\nheight = nan\n", 8, "coverage.height", "not finite");
  expect_one(m + "[coverage]\nheight = -inf\n", 8, "coverage.height", "not finite");
  expect_one(m + "[coverage]\nheight = 1979-05-27\n", 8, "coverage.height", "wrong kind of value", "a date");
  expect_one(m + "[coverage]\nheight = true\n", 8, "coverage.height", "wrong kind of value", "length");
  expect_one(m + "[coverage]\nheight = [1.5]\n", 8, "coverage.height", "wrong kind of value", "a list");
  expect_one(m + "[coverage]\narea = [0, 1, 2]\n", 8, "coverage.area", "wrong count of numbers", "4 are needed");
  expect_one(m + "[coverage]\narea = [0, 0, -1, 5]\n", 8, "coverage.area", "an empty area");
  expect_one(m + "[[receiver]]\nposition = [1, '2GHz', 3]\n", 8, "receiver.0.position.1", "unit of the wrong kind");
  expect_one(m + "power = ['1W', '2W']\n", 7, "transmitter.0.power", "wrong count of numbers", "one per band (1)");
  expect_one(m + "power = '-1W'\n", 7, "transmitter.0.power", "negative power");
  expect_one(m + "[propagation]\ndepth = 2.5\n", 8, "propagation.depth", "not a whole number");
  expect_one(m + "[propagation]\ndepth = -1\n", 8, "propagation.depth", "out of range");
  expect_one(m + "[budget]\nrays = 0\n", 8, "budget.rays", "out of range", "1");
  expect_one(m + "[budget]\naccuracy = '1dB'\nrays = 1e5\n", 8, "budget.accuracy", "two budgets", "leave out");
  expect_one(m + "[budget]\ntime = '60s'\nrays = 1e5\n", 8, "budget.time", "two budgets", "leave out");
  expect_one(m + "[budget]\naccuracy = '5GHz'\n", 8, "budget.accuracy", "unit of the wrong kind");
  expect_one(m + "[budget]\ntime = 0\n", 8, "budget.time", "out of range");
  expect_one(m + "[budget]\npasses = 1\n", 8, "budget.passes", "out of range", "2 … 32");
  expect_one(m + "[budget]\nseed = -1\n", 8, "budget.seed", "out of range");
  expect_one(m + "[profile]\nmax_paths = 0\n", 8, "profile.max_paths", "out of range");
}

TEST_F(PlanFile, WrongWordsAreRefused) {
  const std::string m = minimal;
  expect_one(m + "[propagation]\ndiffraction = 'fds'\n", 8, "propagation.diffraction", "unknown value", "fsd");
  expect_one(m + "[propagation]\nmechanisms = ['direct', 'reflektion']\n", 8, "propagation.mechanisms.1",
             "unknown value", "reflection");
  expect_one(m + "[propagation]\nmechanisms = []\n", 8, "propagation.mechanisms", "empty list");
  expect_one(m + "antenna = { polarisation = 'both' }\n", 7, "transmitter.0.antenna.polarisation", "unknown value",
             "V");
  expect_one(m + "antenna = { polarisation = 'V', polarization = 'H' }\n", 7, "transmitter.0.antenna.polarization",
             "given twice");
  expect_one(m + "antenna = 'dipole'\n", 7, "transmitter.0.antenna", "wrong kind of value", "a table");
  expect_one(m + "[[receiver]]\nname = 'a b'\nposition = [0, 0, 0]\n", 8, "receiver.0.name",
             "not a name for a receiver");
  expect_one(m + "[[receiver]]\nname = '.'\nposition = [0, 0, 0]\n", 8, "receiver.0.name", "not a name for a receiver");
  expect_one(m + "[[receiver]]\nname = ''\nposition = [0, 0, 0]\n", 8, "receiver.0.name", "empty text");
  expect_one(m + "[[receiver]]\nname = 'a'\nposition = [0, 0, 0]\n[[receiver]]\nname = 'a'\nposition = [0, 0, 0]\n", 11,
             "receiver.1.name", "name given twice");
  expect_one(m + "name = 'x'\n[[source]]\nname = 'x'\nposition = [0, 0, 0]\n", 9, "source.0.name", "name given twice");
  expect_one("receiver = 5\n" + m, 1, "receiver", "wrong kind of value", "[[receiver]]");
  expect_one("coverage = 5\n" + m, 1, "coverage", "wrong kind of value", "[coverage]");
}

TEST_F(PlanFile, MissingAndContradictingKeys) {
  const std::string scene = "[scene]\nbuiltin = 'box'\n", wave = "[wave]\nfrequency = 1e9\n",
                    tx = "[[transmitter]]\nposition = [1, 1, 1]\n";
  expect_one(wave + tx, 0, "scene", "missing", "--scene");
  expect_one(scene + tx, 0, "wave", "missing", "--frequency");
  expect_one(scene + "[wave]\nkind = 'radio'\n" + tx, 3, "wave.frequency", "missing", "--frequency");
  expect_one(scene + wave, 0, "transmitter", "missing", "--tx");
  expect_one("transmitter = []\n" + scene + wave, 0, "transmitter", "missing", "--tx");
  expect_one(scene + wave + "[[transmitter]]\nname = 'a'\n", 5, "transmitter.0.position", "missing", "--tx");
  expect_one(scene + "file = 'city.ply'\n" + wave + tx, 2, "scene.builtin", "two scenes");
  expect_one("[scene]\nfile = 'city.ply'\nparameters = { width = 1 }\n" + wave + tx, 3, "scene.parameters",
             "no built-in scene");
  expect_one(scene + wave + "wavelength = 1\n" + tx, 5, "wave.wavelength", "more than one kind of frequency");
  expect_one(scene + "[wave]\nfrequency = [1e9, '1GHz']\n" + tx, 4, "wave.frequency", "given twice", "1 GHz");
  expect_one(scene + "[wave]\noctaves = { from = '8kHz', to = '63Hz' }\n" + tx, 4, "wave.octaves", "out of range");
  expect_one(scene + "[wave]\noctaves = { from = 1, to = 2 }\n" + tx, 4, "wave.octaves", "no band");
  expect_one(scene + "[wave]\nthird_octaves = { from = '1kHz' }\n" + tx, 4, "wave.third_octaves.to", "missing");
  expect_one(scene + wave + "temperature = '20'\n" + tx, 5, "wave.temperature", "out of range");
  expect_one(scene + wave + tx + "sound_power_level = 90\n", 7, "transmitter.0.sound_power_level",
             "not for this kind of wave");
  expect_one(scene + wave + "kind = 'acoustic'\n" + tx + "power = 1\n", 8, "transmitter.0.power",
             "not for this kind of wave");
  expect_one("[scene]\nbuiltin = 'demo_city'\n" + wave + tx, 2, "scene.builtin", "no such built-in scene", "demo-city");
  expect_one("[scene]\nfile = 'town.ply'\n" + wave + tx, 2, "scene.file", "no such file", "town.ply");
  expect_one("[scene]\nfile = '.'\n" + wave + tx, 2, "scene.file", "not a file", "folder");
  expect_one(scene + "origin = { latitude = 91, longitude = 0 }\n" + wave + tx, 3, "scene.origin.latitude",
             "out of range");
  expect_one(scene + "origin = { latitude = 9 }\n" + wave + tx, 3, "scene.origin.longitude", "missing");
}

TEST_F(PlanFile, WhatThisVersionLacksIsSaid) {
  const std::string m = minimal, lacks = "not in this version";
  expect_one(m + "[propagation]\nmechanisms = ['transmission']\n", 8, "propagation.mechanisms.0", lacks);
  expect_one(m + "[[receiver]]\nlocation = { latitude = 1, longitude = 2, height = 3 }\n", 8, "receiver.0.location",
             lacks);
  expect_one(m + "[[material]]\nname = 'grass'\nflow_resistivity = '200kPa·s/m²'\n", 9, "material.0.flow_resistivity",
             lacks);
  expect_one(m + "[[material]]\nname = 'grass'\nscattering = 0.1\n", 9, "material.0.scattering", lacks);
  expect_one(
      "[scene]\nbuiltin = 'box'\nterrain = 'dem.tif'\n[wave]\nfrequency = 1e9\n[[transmitter]]\nposition = [1, 1, 1]\n",
      3, "scene.terrain", lacks);
  expect_one("[scene]\nfile = 'town.osm.pbf'\n[wave]\nfrequency = 1e9\n[[transmitter]]\nposition = [1, 1, 1]\n", 2,
             "scene.file", lacks);
}

TEST_F(PlanFile, FaultyMaterialsAreRefused) {
  const std::string m = std::string(minimal) + "[[material]]\n";
  expect_one(m + "conductivity = 1\n", 7, "material.0.name", "missing");
  expect_one(m + "name = 'wood'\n[[material]]\nname = 'itu_wood'\n", 10, "material.1.name", "name given twice");
  expect_one(m + "name = 'felt'\nconductivity = 1\n", 7, "material.0.relative_permittivity", "missing");
  expect_one(m + "name = 'felt'\nrelative_permittivity = 0.5\n", 9, "material.0.relative_permittivity", "out of range");
  expect_one(m + "name = 'felt'\nabsorption = 1.5\n", 9, "material.0.absorption", "out of range", "0 … 1");
  expect_one(m + "name = 'felt'\nabsorption = [0.1]\n", 9, "material.0.absorption", "wrong kind of value");
  expect_one(m + "name = 'felt'\nabsorption = { bands = [125, 250], values = [0.1] }\n", 9, "material.0.absorption",
             "wrong count of numbers", "2 bands, 1 values");
  expect_one(m + "name = 'felt'\nabsorption = { bands = [250, 125], values = [0.1, 0.2] }\n", 9,
             "material.0.absorption.bands", "not ascending");
  expect_one(m + "name = 'felt'\ntable = 'felt.csv'\n", 9, "material.0.table", "no such file");
}

TEST_F(PlanFile, FaultsOfATableNameItsLine) {
  const std::string m = std::string(minimal) + "[[material]]\nname = 'felt'\ntable = 'felt.csv'\n";
  const struct {
    const char* table;
    int line;
    const char* problem;
  } cases[] = {{"", 0, "cannot be read"},
               {"f_GHz,conductivity\n1,2\n", 1, "columns missing"},
               {"f_GHz,relative_permittivity,conductivity\n", 1, "no rows"},
               {"f_GHz,relative_permittivity,conductivity\n1,2,x\n", 2, "not a number"},
               {"f_GHz,relative_permittivity,conductivity\n1,2\n", 2, "not a number"},
               {"f_GHz,relative_permittivity,conductivity\n1,2,nan\n", 2, "not a number"},
               {"f_GHz,relative_permittivity,conductivity\n1,0.5,0\n", 2, "out of range"},
               {"f_GHz,relative_permittivity,conductivity\n1,2,0\n1,2,0\n", 3, "not ascending"}};
  for (const auto& one : cases) {
    SCOPED_TRACE(one.table);
    write("felt.csv", one.table);
    read(m);
    ASSERT_EQ(errors().size(), 1u) << all_text();
    EXPECT_EQ(fs::path(errors()[0].file).filename(), "felt.csv");
    EXPECT_EQ(errors()[0].line, one.line);
    EXPECT_EQ(errors()[0].problem, one.problem);
  }
}

TEST_F(PlanFile, AllFaultsAreToldAtOnce) {
  read(R"([scene]
builtin = "demo-citi"
[wave]
frequency = "3.5m"
[[transmitter]]
position = [1, 2]
[coverage]
cellsize = 5
[budget]
rays = "many"
)");
  std::vector<int> lines;
  for (const auto& fault : errors()) lines.push_back(fault.line);
  EXPECT_EQ(lines, (std::vector<int>{2, 4, 6, 8, 10})) << all_text();
}

TEST_F(PlanFile, WhatIsNoTomlIsNamedWithItsLine) {
  expect_one("[scene]\nbuiltin = demo-city\n", 2, "", "not valid TOML", "column");
  expect_one("[scene]\nbuiltin = 'box'\nbuiltin = 'box'\n", 3, "", "not valid TOML", "column");
  expect_one("a = 1\nb = '\xff'\n", 2, "", "not valid TOML", "column");
  expect_one(std::string("a = 1\nb\0 = 2\n", 13), 2, "", "not valid TOML", "column");
  // As deep as a file can make it: the stack must bear it.
  std::string deep = "x = 1\na";
  for (int i = 0; i < 200000; ++i) deep += ".a";
  expect_one(deep + " = 1\n", 2, "", "not a scenario", "parts");
  expect_one("x = " + std::string(200000, '[') + "\n", 1, "", "not valid TOML");
}

TEST_F(PlanFile, FilesThatAreNoScenarioAreRefused) {
  const struct {
    fs::path file;
    const char* problem;
  } cases[] = {
      {folder_ / "absent.toml", "no such file"}, {folder_, "not a file"}, {folder_ / "city.ply", "not a scenario"}};
  for (const auto& one : cases) {
    SCOPED_TRACE(one.file);
    diagnostics_ = {};
    read_plan(one.file, {}, diagnostics_);
    ASSERT_EQ(errors().size(), 1u) << all_text();
    EXPECT_EQ(errors()[0].problem, one.problem);
    EXPECT_EQ(errors()[0].file, one.file.string());
  }
}

TEST_F(PlanFile, SoundWarnsOfAPolarisation) {
  read(
      "[scene]\nbuiltin = 'box'\n[wave]\nkind = 'acoustic'\nfrequency = 500\n[[source]]\nposition = [1, 1, "
      "1]\n[coverage]\npolarisation = 'V'\n");
  EXPECT_EQ(errors().size(), 0u) << all_text();
  ASSERT_EQ(diagnostics_.all().size(), 1u);
  EXPECT_EQ(diagnostics_.all()[0].line, 9);
  EXPECT_EQ(diagnostics_.all()[0].option, "coverage.polarisation");
}

// Every cut of a full scenario is read without a crash (run under the sanitizers), and none but the whole is silent
// about a broken line.
TEST_F(PlanFile, EveryPrefixOfAScenarioIsRead) {
  const std::string text =
      std::string(minimal) + "antenna = { pattern = 'dipole', tilt = '4deg' }\n[[material]]\nname = 'x'\n";
  for (std::size_t length = 0; length < text.size(); ++length) {
    SCOPED_TRACE(length);
    const PlanDescription plan = read(text.substr(0, length));
    if (!diagnostics_.has_errors()) {
      EXPECT_EQ(plan.transmitters.size(), 1u);
      EXPECT_EQ(plan.frequency.size(), 1u);
    }
  }
}

}  // namespace
}  // namespace grimaldi
