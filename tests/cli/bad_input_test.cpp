// Bad input, end to end: every fault ends at once with one message that says where, what, why and what to do, or with a
// named warning; never with a crash, a hang or a half-written result.

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using Words = std::vector<std::string>;

class BadInput : public test::Program {
 protected:
  // Runs the program, which must end by itself with `code`: a guard against hanging, so it is generous; "at once" is
  // some tenths of a second.
  Outcome ended(const Words& words, int code) const {
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome = run(words);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(outcome.signal, 0) << outcome.err;
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_LT(seconds.count(), 20);
    return outcome;
  }

  // Refused with an error that has all `parts`, in one line; nothing on stdout, no output folder.
  void refused(const Words& words, const Words& parts) const {
    SCOPED_TRACE(words.back());
    const Outcome outcome = ended(words, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(has_line("error: ", outcome.err, parts)) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_NE(entry.path().extension(), ".out") << "left over: " << entry.path();
  }

  static bool has_line(const std::string& start, const std::string& text, const Words& parts) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(start, 0) != 0) continue;
      if (std::all_of(parts.begin(), parts.end(),
                      [&](const std::string& part) { return line.find(part) != std::string::npos; }))
        return true;
    }
    return false;
  }

  // Warned of on stderr and in summary.json; the result is whole.
  void warned(const Words& words, const Words& parts) const {
    const Outcome outcome = ended(words, 0);
    EXPECT_TRUE(has_line("warning: ", outcome.err, parts)) << outcome.err;
    EXPECT_EQ(files_in("grimaldi.out").size(), 3u);
    const auto summary = nlohmann::json::parse(contents("grimaldi.out/summary.json"));
    const auto& list = summary["warnings"];
    EXPECT_TRUE(std::any_of(list.begin(), list.end(), [&](const nlohmann::json& one) {
      return has_line("", one.get<std::string>(), parts);
    })) << list;
  }

  // A run of the demo city at few rays and coarse cells.
  static Words city(const Words& more) {
    Words words = {"coverage", "--scene", "demo-city", "--frequency", "3.5GHz", "--rays",
                   "20000",    "--depth", "1",         "--cell-size", "20"};
    words.insert(words.end(), more.begin(), more.end());
    if (std::find(more.begin(), more.end(), "--tx") == more.end()) words.insert(words.end(), {"--tx", "8.5,21,27"});
    return words;
  }

  // A run of a scene file.
  static Words of_scene(const std::string& file) {
    return {"coverage", "--scene", file, "--frequency", "1GHz", "--tx", "0,0,10", "--rays", "1000"};
  }

  // The scenario of `city`, in lines; more may follow.
  static std::string scenario(const std::string& more = {}) {
    return "[scene]\nbuiltin = 'demo-city'\n[wave]\nfrequency = '3.5GHz'\n[[transmitter]]\nposition = [8.5, 21, 27]\n" +
           more;
  }

  // An ASCII PLY of one triangle: its header, then what the test says.
  static std::string ply(const std::string& vertices, const std::string& faces, const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + body;
  }
};

const std::string triangle = "0 0 0\n10 0 0\n0 10 0\n3 0 1 2\n";

TEST_F(BadInput, MissingSceneFile) {
  write("munich.xml", "<scene/>");
  refused(of_scene("munch.xml"), {"--scene munch.xml", "no such file", "did you mean munich.xml?"});
  refused(of_scene("nowhere/munich.xml"),
          {"--scene nowhere/munich.xml", "no such file", "the folder", "check the path"});
  refused({"scene", "demo-citi"}, {"demo-citi", "no such file", "did you mean demo-city?"});
  write("city.toml",
        "[scene]\nfile = 'munch.xml'\n[wave]\nfrequency = '1GHz'\n[[transmitter]]\nposition = [0, 0, 9]\n");
  refused({"coverage", "city.toml"}, {"city.toml:2: scene.file", "no such file", "did you mean munich.xml?"});
}

TEST_F(BadInput, TruncatedPly) {
  const std::string whole = ply("3", "1", triangle);
  write("whole.ply", whole);
  EXPECT_EQ(run({"scene", "whole.ply"}).code, 0);
  // Cut in the last row, between the rows, in the header.
  for (const std::size_t length :
       {whole.size() - 4, whole.size() - 8, whole.size() - 20, std::size_t{60}, std::size_t{3}}) {
    write("cut.ply", whole.substr(0, length));
    refused(of_scene("cut.ply"), {"cut.ply:"});
  }
  // A binary one: a header for 1000 triangles, bytes for a few.
  write("binary.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face 1000\nproperty list uchar int vertex_indices\nend_header\n" +
            std::string(36, '\0') + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13));
  refused(of_scene("binary.ply"), {"binary.ply", "1000"});
}

TEST_F(BadInput, HeaderThatPromisesFourBillionVertices) {
  for (const char* count : {"4000000000", "4294967296", "18446744073709551615", "99999999999999999999999", "-1"}) {
    write("vast.ply", ply(count, "1", triangle));
    refused(of_scene("vast.ply"), {"vast.ply"});
    std::string binary = ply(count, "1", triangle);
    binary.replace(binary.find("ascii"), 5, "binary_big_endian");
    write("vast.ply", binary);
    refused(of_scene("vast.ply"), {"vast.ply"});
    write("vast.ply", ply("3", count, triangle));
    refused(of_scene("vast.ply"), {"vast.ply"});
  }
}

TEST_F(BadInput, XmlNamingAMeshThatIsNotThere) {
  fs::create_directories(folder_ / "meshes");
  write("meshes/wall.ply", ply("3", "1", triangle));
  write(
      "city.xml",
      "<scene version=\"2.1.0\">\n<shape type=\"ply\" id=\"a\">\n<string name=\"filename\" value=\"meshes/wal.ply\"/>\n"
      "</shape>\n<shape type=\"ply\" id=\"b\">\n<string name=\"filename\" "
      "value=\"meshes/gone.ply\"/>\n</shape>\n</scene>\n");
  refused(of_scene("city.xml"), {"wal.ply", "no such file", "did you mean wall.ply?"});
  refused(of_scene("city.xml"), {"gone.ply", "no such file"});  // both at once
}

TEST_F(BadInput, XmlNestedAHundredThousandDeep) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  write("open.xml", "<scene>" + deep);
  refused(of_scene("open.xml"), {"open.xml"});
  for (int i = 0; i < 100000; ++i) deep += "</a>";
  write("deep.xml", "<scene>" + deep + "</scene>");
  refused(of_scene("deep.xml"), {"deep.xml", "nest"});
  std::string bsdf;
  for (int i = 0; i < 100000; ++i) bsdf += "<bsdf type=\"twosided\">";
  for (int i = 0; i < 100000; ++i) bsdf += "</bsdf>";
  write("deep.xml", "<scene>" + bsdf + "</scene>");
  refused(of_scene("deep.xml"), {"deep.xml", "nest"});
}

TEST_F(BadInput, DeeplyNestedScenario) {
  write("deep.toml", "a = " + std::string(100000, '[') + std::string(100000, ']'));
  refused({"coverage", "deep.toml"}, {"deep.toml:1", "not valid TOML"});
  std::string key = "a";
  for (int i = 0; i < 100000; ++i) key += ".a";
  write("deep.toml", key + " = 1\n");
  refused({"coverage", "deep.toml"}, {"deep.toml:1", "not a scenario"});
  // As long as the system lets one argument be.
  refused(city({"--set", "scene." + key.substr(0, 100000) + "=1"}), {"--set", "a key of more than 64 parts"});
}

TEST_F(BadInput, UnknownKey) {
  write("city.toml", scenario("[coverage]\ncell_sze = 5\n"));
  refused({"coverage", "city.toml"}, {"city.toml:8: coverage.cell_sze", "unknown key", "did you mean cell_size?"});
  refused(city({"--set", "budget.ray=5"}), {"--set budget.ray=5", "unknown key", "did you mean rays?"});
  refused(city({"--ray", "5"}), {"--ray", "unknown option", "did you mean --rays?"});
  refused({"scene", "street-canyon", "--set", "scene.parameters.with=30"},
          {"scene.parameters.with", "unknown parameter", "did you mean width?"});
}

TEST_F(BadInput, UnitOfTheWrongKind) {
  write("city.toml", scenario("[coverage]\ncell_size = '5GHz'\n"));
  refused({"coverage", "city.toml"}, {"city.toml:8: coverage.cell_size", "unit of the wrong kind", "a length", "5GHz"});
  refused(city({"--frequency", "3.5m"}), {"--frequency 3.5m", "unit of the wrong kind", "a frequency"});
}

TEST_F(BadInput, CountsAndValuesOutOfRange) {
  refused(city({"--tx", "1,2"}), {"--tx 1,2", "wrong count of numbers", "3 are needed (east, north, up in metres)"});
  refused(city({"--tx", "1,nan,3"}), {"--tx 1,nan,3", "not finite"});
  refused(city({"--depth", "33"}), {"--depth 33", "out of range", "0 … 32"});
  refused(city({"--cell-size", "0"}), {"--cell-size 0", "out of range", "greater than 0"});
  refused(city({"--rays", "nan"}), {"--rays nan", "not finite"});
  // Lengths that single precision, which rays are traced in, cannot hold.
  refused(city({"--tx", "1e20,0,1"}), {"--tx 1e20,0,1", "out of range", "100000000"});
  refused(city({"--rx", "0,1e300,1"}), {"--rx 0,1e300,1", "out of range"});
  refused(city({"--height", "1e20"}), {"--height 1e20", "out of range"});
  refused(city({"--cell-size", "1e100"}), {"--cell-size 1e100", "out of range"});
  write("far.ply", ply("3", "1", "0 0 0\n1e30 0 0\n0 1e30 0\n3 0 1 2\n"));
  refused(of_scene("far.ply"), {"far.ply", "a vertex lies 1e+30 m away", "are the coordinates in metres?"});
}

TEST_F(BadInput, NanVertex) {
  write("nan.ply", ply("3", "1", "0 0 0\n10 nan 0\n0 10 0\n3 0 1 2\n"));
  refused(of_scene("nan.ply"), {"nan.ply", "vertex 1", "finite"});
  write("inf.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(of_scene("inf.obj"), {"inf.obj"});
}

TEST_F(BadInput, ZeroTriangles) {
  write("none.ply", ply("3", "0", "0 0 0\n10 0 0\n0 10 0\n"));
  refused(of_scene("none.ply"), {"none.ply", "no triangles", "check what was exported"});
  write("none.xml", "<scene version=\"2.1.0\"></scene>");
  refused(of_scene("none.xml"), {"none.xml", "no triangles"});
  write("tiny.ply", ply("3", "1", "0 0 0\n0.001 0 0\n0 0.001 0\n3 0 1 2\n"));
  refused(of_scene("tiny.ply"), {"tiny.ply", "no triangles", "degenerate", "are the coordinates in metres?"});
}

TEST_F(BadInput, TransmitterInsideABuilding) {
  // (−60, −60) lies in a house of the demo city, 16 m high and more.
  refused(city({"--tx", "-60,-60,3"}),
          {"transmitter.tx1.position", "inside a solid", "(-60, -60, 3)", "move it out of the building"});
}

TEST_F(BadInput, MaterialTableThatDoesNotCoverTheFrequency) {
  write("brick.csv", "frequency_GHz,relative_permittivity,conductivity\n1,3.9,0.02\n3,3.8,0.03\n");
  write("city.toml", scenario("[[material]]\nname = 'brick'\ntable = 'brick.csv'\n"));
  refused({"coverage", "city.toml"}, {"material.brick", "the table of relative permittivity does not cover 3.5 GHz",
                                      "from 1 GHz to 3 GHz", "extend the table"});
  // Two frequencies beyond it: one message that names both.
  refused({"coverage", "city.toml", "--frequency", "3.5GHz,2GHz,28GHz"},
          {"material.brick", "relative permittivity does not cover 3.5 GHz, 28 GHz", "from 1 GHz to 3 GHz"});
  const Outcome inside =
      ended({"coverage", "city.toml", "--frequency", "2GHz", "--rays", "1000", "--cell-size", "50"}, 0);
  EXPECT_EQ(inside.err.find("brick"), std::string::npos) << inside.err;
}

TEST_F(BadInput, GridThatCannotFitInMemory) {
  refused(city({"--cell-size", "1mm"}), {"coverage.cell_size", "cannot fit in memory", "cells need", "GB may be used",
                                         "use cells of", "or a smaller coverage.area"});
  refused(city({"--area", "-1e8,-1e8,1e8,1e8"}), {"coverage.cell_size", "cannot fit in memory", "use cells of"});
  refused(city({"--cell-size", "1e-300"}), {"coverage.cell_size", "cannot fit in memory", "use cells of"});
}

TEST_F(BadInput, UnwritableOutputFolder) {
  write("file", "mine");
  refused(city({"-o", "file/out"}),
          {"file/out", "-o", "cannot be a folder", "file is a file", "choose another folder"});
  EXPECT_EQ(contents("file"), "mine");
  if (fs::exists("/proc/self")) refused(city({"-o", "/proc/out"}), {"/proc/out", "-o", "choose another folder"});
  refused(city({"-o", std::string(300, 'x')}), {"-o", "choose another folder"});  // no file system takes such a name
}

TEST_F(BadInput, ExistingResultWithoutOverwrite) {
  fs::create_directories(folder_ / "kept");
  write("kept/result.h5", "mine");
  refused(city({"-o", "kept"}), {"kept/result.h5", "a result is already there", "it would be lost", "--overwrite"});
  EXPECT_EQ(files_in("kept"), Words{"result.h5"});
  EXPECT_EQ(contents("kept/result.h5"), "mine");
}

TEST_F(BadInput, InterruptedRun) {
  // So many rays that only the signal can end it.
  const Words words = city({"--rays", "1e10", "--progress", "-o", "out", "--overwrite"});
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    SCOPED_TRACE(signal);
    const pid_t child = start(words);
    ASSERT_GT(child, 0);
    wait_until_it_traces();
    const auto begin = std::chrono::steady_clock::now();
    kill(child, signal);
    const Outcome outcome = wait(child);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(seconds.count(), 20);  // a guard against hanging; about a second is promised
    if (signal == SIGKILL) {
      EXPECT_EQ(outcome.signal, SIGKILL);
    } else {
      EXPECT_EQ(outcome.code, 1) << "signal " << outcome.signal;
      EXPECT_NE(outcome.err.find("error: interrupted (nothing was written)"), std::string::npos) << outcome.err;
      EXPECT_FALSE(exists("out"));
    }
    for (const char* name : {"result.h5", "coverage.png", "summary.json"})
      EXPECT_FALSE(exists(std::string("out/") + name)) << name;
  }
}

TEST_F(BadInput, AllFaultsOfAScenarioAtOnce) {
  fs::create_directories(folder_ / "city.out");
  write("city.out/result.h5", "mine");
  write(
      "city.toml",
      "[scene]\nbuiltin = 'demo-city'\nmateril = 'brick'\n[wave]\nfrequency = '3.5GHz'\n[[transmitter]]\nname = 'in'\n"
      "position = [-60, -60, 3]\n[[transmitter]]\nname = 'two'\nposition = [1, 2]\n[coverage]\ncell_size = '5GHz'\n"
      "area = [-1e5, -1e5, 1e5, 1e5]\n[[receiver]]\nposition = [nan, 0, 0]\n[propagation]\ndepth = 99\n"
      "[[material]]\nname = 'brick'\ntable = 'gone.csv'\n");
  const Outcome outcome = ended({"coverage", "city.toml", "--rays", "many", "--set", "budget.passes=1"}, 1);
  EXPECT_EQ(outcome.out, "");
  const std::vector<Words> faults = {
      {"city.toml:3: scene.materil", "unknown key", "did you mean material?"},
      {"city.toml:11: transmitter.1.position", "wrong count of numbers"},
      {"city.toml:13: coverage.cell_size", "unit of the wrong kind"},
      {"city.toml:16: receiver.0.position.0", "not finite"},
      {"city.toml:18: propagation.depth", "out of range"},
      {"city.toml:21: material.0.table", "no such file"},
      {"--rays many", "not a number"},
      {"--set budget.passes=1", "out of range"},
      {"city.out/result.h5", "a result is already there"},
      {"transmitter.in.position", "inside a solid"},
  };
  for (const Words& fault : faults)
    EXPECT_TRUE(has_line("error: ", outcome.err, fault)) << fault[0] << "\n" << outcome.err;
  // And no other: none that only follows from one of these.
  EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.err.begin(), outcome.err.end(), '\n')), faults.size())
      << outcome.err;
}

TEST_F(BadInput, FaultsOfTheSceneAndOfTheScenarioAtOnce) {
  write("wall.ply", ply("3", "1", "0 0 0\n10 nan 0\n0 10 0\n3 0 1 2\n"));
  Words words = of_scene("wall.ply");
  words.insert(words.end(), {"--depth", "x"});
  refused(words, {"wall.ply", "vertex 1"});
  refused(words, {"--depth x"});
  // A material that is not there, and a transmitter inside.
  words = city({"--tx", "-60,-60,3", "--set", "scene.replace_materials.brick=brik"});
  refused(words, {"unknown material \"brik\"", "it replaces \"brick\"", "did you mean brick?"});
  refused(words, {"transmitter.tx1.position", "inside a solid"});
}

TEST_F(BadInput, ReceiverInsideASolidIsAWarning) {
  warned(city({"--rx", "-60,-60,1.5"}), {"receiver.rx1.position", "inside a solid", "(-60, -60, 1.5)"});
}

TEST_F(BadInput, P2040OutsideItsRangeIsAWarningWithTheValue) {
  // ITU-R P.2040-3, Table 3: concrete 1 … 100 GHz, ε' = 5.24, σ = 0.0462 f^0.7822 S/m: 0.026864 at 0.5 GHz, 0.0076285
  // at 0.1 GHz. One line for both carriers.
  const Words words = city({"--frequency", "3.5GHz,500MHz,100MHz", "--rays", "1000", "--cell-size", "50"});
  warned(words, {"material.concrete", "ITU-R P.2040 used outside its range at 100 MHz, 500 MHz", "1 GHz to 100 GHz",
                 "relative permittivity 5.24, conductivity 0.0076285 S/m at 100 MHz",
                 "conductivity 0.026864 S/m at 500 MHz", "give relative_permittivity and conductivity"});
  const std::string err = contents("stderr.txt");
  const auto first = err.find("material.concrete");
  EXPECT_EQ(err.find("material.concrete", first + 1), std::string::npos) << err;
}

TEST_F(BadInput, UnknownAbsorptionIsOneWarningForAllBands) {
  warned({"coverage", "--scene", "demo-city", "--wave", "acoustic", "--set", "wave.octaves={from='63Hz',to='8kHz'}",
          "--tx", "8.5,21,27", "--rays", "1000", "--depth", "1", "--cell-size", "50"},
         {"material.metal", "no absorption known", "used: 0.05; give absorption"});
  const std::string err = contents("stderr.txt");
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
}

TEST_F(BadInput, WhatThisVersionLacks) {
  const std::string lacks = "not in this version";
  write("city.toml", scenario());
  for (const char* verb : {"tradeoff", "report"}) {
    refused({verb}, {verb, lacks, "known: coverage"});
    refused({verb, "city.toml", "-o", "x.out"}, {verb, lacks});
  }
  refused(city({"--mechanisms", "direct,transmission"}), {"--mechanisms", lacks});
  refused(city({"--mechanisms", "scattering"}), {"--mechanisms scattering", lacks});
  for (const char* set :
       {"scene.terrain=dem.tif", "material.brick.scattering=0.1", "material.brick.flow_resistivity=200kPa.s/m2",
        "receiver.0.location={latitude=48,longitude=11}"})
    refused(city({"--set", set}), {std::string("--set ") + set, lacks});
  for (const char* file : {"town.osm", "town.osm.pbf", "town.geojson", "town.shp", "town.gpkg"}) {
    refused(of_scene(file), {std::string("--scene ") + file, lacks, ".xml"});
    refused({"scene", file}, {file, lacks, ".xml"});
  }
}

}  // namespace
}  // namespace grimaldi
