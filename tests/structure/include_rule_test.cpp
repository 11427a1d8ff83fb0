// The house rules that a compiler does not hold: arrows between the folders, no cycles, one door for each package,
// names that say something, files of a readable length.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

struct Include {
  int line;
  std::string name;  ///< as between the quotes or brackets
  bool quoted;
};
struct Source {
  std::string path;  ///< from the root, with /
  std::vector<Include> includes;
  int lines = 1;
};
using Faults = std::vector<std::string>;

constexpr int most_lines = 600;

/// Room → rooms that its files may include. A file belongs to the longest room that its path begins with.
const std::map<std::string, std::set<std::string>> rooms = {
    {"core", {"core"}},
    {"scenes", {"core", "scenes"}},
    {"propagation/laws", {"core", "propagation/laws"}},
    {"propagation", {"core", "scenes", "propagation/laws", "propagation"}},
    {"validation", {"core", "validation"}},
    {"validation/cases", {"core", "scenes", "propagation/laws", "propagation", "validation", "validation/cases"}},
    {"cli", {"core", "scenes", "propagation/laws", "propagation", "validation", "validation/cases", "cli"}},
    {"tests", {"core", "scenes", "propagation/laws", "propagation", "validation", "validation/cases", "cli", "tests"}},
    {"benchmarks",
     {"core", "scenes", "propagation/laws", "propagation", "validation", "validation/cases", "cli", "benchmarks"}},
};

/// References that check the kernels share nothing with them but the vocabulary.
const std::set<std::string> references = {
    "quadrature",          "bessel",     "fresnel_integral", "aperture",    "aperture_shape", "aperture_quadrature",
    "rayleigh_sommerfeld", "fraunhofer", "half_plane",       "wedge_field", "wedge_contour",  "wedge_series",
    "knife_edge",          "hankel",     "boundary_elements"};
const std::set<std::string> vocabulary = {"core/quantity.h",          "core/vector.h",
                                          "core/constants.h",         "core/contract.h",
                                          "validation/bessel.h",      "validation/hankel.h",
                                          "validation/quadrature.h",  "validation/fresnel_integral.h",
                                          "validation/aperture.h",    "validation/aperture_quadrature.h",
                                          "validation/wedge_field.h", "validation/wedge_contour.h"};

/// A package and where its headers may be included. Only sources count as doors: a header would leak the package.
struct Door {
  std::string package;
  Names prefixes;      ///< of the names of its headers
  std::string within;  ///< file, or room ("" = any), that holds the door
  std::size_t most;    ///< files that may include it
  bool per_room = false;
  std::string yardstick = {};  ///< one more file that may: what the benchmarks measure the door against
};
const std::vector<Door> doors = {
    {"Embree", {"embree3/", "embree4/"}, "propagation/tracer.cpp", 1, false, "benchmarks/bare_embree.cpp"},
    {"HDF5", {"hdf5", "H5", "netcdf"}, "propagation/result_file.cpp", 1},
    {"CGAL", {"CGAL/"}, "", 1},
    {"OpenMesh", {"OpenMesh/"}, "", 1},
    {"assimp", {"assimp/"}, "", 1},
    {"pugixml", {"pugixml"}, "", 1},
    {"toml++", {"toml++/", "toml.hpp"}, "", 1},
    {"Cairo", {"cairo"}, "cli", 2},
    {"CLI11", {"CLI/", "CLI11"}, "", 1},
    {"GeographicLib", {"GeographicLib/"}, "", 1},
    {"GDAL", {"gdal", "ogr"}, "", 2},
    {"Boost.Math", {"boost/math"}, "validation/bessel.cpp", 1},
    {"nlohmann-json", {"nlohmann/"}, "", 1, true},
};

bool begins_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

/// The room of a path from the root; empty if it lies in none.
std::string room_of(const std::string& path) {
  std::string best;
  for (const auto& [room, may] : rooms)
    if (begins_with(path, room + "/") && room.size() > best.size()) best = room;
  return best;
}

std::string at(const Source& source, int line) { return source.path + ":" + std::to_string(line) + ": "; }

std::string stem(const std::string& path) { return fs::path(path).stem().string(); }

Source parse(const std::string& path, std::istream& text) {
  const auto skip_blanks = [](const std::string& line, std::size_t from) {
    return std::min(line.find_first_not_of(" \t", from), line.size());
  };
  Source source{path, {}, 0};
  for (std::string line; std::getline(text, line);) {
    ++source.lines;
    std::size_t i = skip_blanks(line, 0);
    if (i == line.size() || line[i] != '#') continue;
    i = skip_blanks(line, i + 1);
    if (line.compare(i, 7, "include") != 0) continue;
    i = skip_blanks(line, i + 7);
    if (i == line.size() || (line[i] != '"' && line[i] != '<')) continue;
    const std::size_t end = line.find(line[i] == '"' ? '"' : '>', i + 1);
    if (end != std::string::npos)
      source.includes.push_back({source.lines, line.substr(i + 1, end - i - 1), line[i] == '"'});
  }
  return source;
}

Faults arrow_faults(const std::vector<Source>& sources) {
  Faults faults;
  std::set<std::string> paths;
  for (const Source& source : sources) paths.insert(source.path);
  for (const Source& source : sources) {
    const std::string from = room_of(source.path);
    if (from.empty()) {
      faults.push_back(at(source, 1) + "lies in no room of the house; move it, or add the room to the rule");
      continue;
    }
    for (const Include& include : source.includes) {
      const std::string to = room_of(include.name);
      if (to.empty() && !include.quoted) continue;  // the system or a package
      const bool package = std::any_of(doors.begin(), doors.end(), [&](const Door& door) {
        return std::any_of(door.prefixes.begin(), door.prefixes.end(),
                           [&](const std::string& prefix) { return begins_with(include.name, prefix); });
      });
      if (!paths.contains(include.name)) {
        if (!package)
          faults.push_back(at(source, include.line) + "\"" + include.name +
                           "\" is no file of the project (includes go from the root)");
        continue;
      }
      if (!rooms.at(from).contains(to))
        faults.push_back(at(source, include.line) + from + " may not include " + include.name +
                         " (the arrows go core <- scenes <- propagation <- validation/cases <- cli; laws and "
                         "references see core alone)");
      if (from == "validation" && references.contains(stem(source.path)) && !vocabulary.contains(include.name) &&
          stem(include.name) != stem(source.path))
        faults.push_back(at(source, include.line) + "a reference may not include " + include.name +
                         " (one that shares code with what it checks, checks nothing)");
    }
  }
  return faults;
}

Faults cycle_faults(const std::vector<Source>& sources) {
  Faults faults;
  std::map<std::string, const Source*> by_path;
  for (const Source& source : sources) by_path[source.path] = &source;
  enum class Mark { open, done };
  std::map<std::string, Mark> marks;
  Names chain;
  const std::function<void(const Source&)> visit = [&](const Source& source) {
    marks[source.path] = Mark::open;
    chain.push_back(source.path);
    for (const Include& include : source.includes) {
      const auto next = by_path.find(include.name);
      if (next == by_path.end()) continue;
      const auto mark = marks.find(include.name);
      if (mark == marks.end()) {
        visit(*next->second);
      } else if (mark->second == Mark::open) {
        std::string circle;
        for (auto i = std::find(chain.begin(), chain.end(), include.name); i != chain.end(); ++i) circle += *i + " -> ";
        faults.push_back(at(source, include.line) + "files include each other: " + circle + include.name);
      }
    }
    chain.pop_back();
    marks[source.path] = Mark::done;
  };
  for (const Source& source : sources)
    if (!marks.contains(source.path)) visit(source);
  return faults;
}

Faults door_faults(const std::vector<Source>& sources) {
  Faults faults;
  for (const Door& door : doors) {
    std::map<std::string, Names> users;  // by room, or all under ""
    for (const Source& source : sources) {
      const auto use = std::find_if(source.includes.begin(), source.includes.end(), [&](const Include& include) {
        return std::any_of(door.prefixes.begin(), door.prefixes.end(),
                           [&](const std::string& prefix) { return begins_with(include.name, prefix); });
      });
      if (use == source.includes.end()) continue;
      const std::string room = room_of(source.path), place = at(source, use->line);
      // Tests read the JSON that users read.
      if (door.per_room && room == "tests") continue;
      if (!door.yardstick.empty() && source.path == door.yardstick) continue;
      if (!door.within.empty() && source.path != door.within && room != door.within)
        faults.push_back(place + door.package + " has its one door in " + door.within);
      else if (fs::path(source.path).extension() != ".cpp")
        faults.push_back(place + door.package + " in a header: its door is one .cpp, behind a header of ours");
      Names& others = users[door.per_room ? room : ""];
      others.push_back(source.path);
      if (others.size() > door.most)
        faults.push_back(place + "a further door for " + door.package + ", which " + others.front() +
                         " includes (at most " + std::to_string(door.most) + (door.per_room ? " in a folder)" : ")"));
    }
  }
  return faults;
}

Faults form_faults(const std::vector<Source>& sources) {
  static const std::set<std::string> empty_words = {"util",   "utils",   "utility", "utilities",
                                                    "helper", "helpers", "common",  "misc"};
  Faults faults;
  for (const Source& source : sources) {
    std::string words = (fs::path(source.path).parent_path() / stem(source.path)).generic_string();
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c == '/' || c == '_' || c == '-' || c == '.'; }, ' ');
    std::istringstream list(words);
    for (std::string word; list >> word;)
      if (empty_words.contains(word))
        faults.push_back(at(source, 1) + "\"" + word + "\" says nothing; name the file by the noun that it holds");
    if (source.lines > most_lines)
      faults.push_back(at(source, most_lines + 1) + "the file has " + std::to_string(source.lines) +
                       " lines (at most " + std::to_string(most_lines) + "); cut it by nouns");
  }
  return faults;
}

std::string joined(const Faults& faults) {
  std::string text;
  for (const std::string& fault : faults) text += fault + "\n";
  return text;
}

/// The C++ files of the project, sorted. Hidden folders and folders of a build are passed over.
std::vector<Source> project() {
  const fs::path root = GRIMALDI_SOURCE;
  std::vector<Source> sources;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::path& path = entry->path();
    if (entry->is_directory()) {
      if (begins_with(path.filename().string(), ".") || fs::exists(path / "CMakeCache.txt"))
        entry.disable_recursion_pending();
      continue;
    }
    static const std::set<std::string> extensions = {".cpp", ".h", ".hpp", ".cc", ".cxx", ".c", ".inl"};
    if (!extensions.contains(path.extension().string())) continue;
    std::ifstream text(path);
    sources.push_back(parse(fs::relative(path, root).generic_string(), text));
  }
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

// The project itself.

TEST(IncludeRule, TheWalkSeesTheProject) {
  const std::vector<Source> sources = project();
  const auto has = [&](const char* path) {
    return std::any_of(sources.begin(), sources.end(), [&](const Source& s) { return s.path == path; });
  };
  EXPECT_TRUE(has("core/vector.h") && has("scenes/scene.h") && has("propagation/result_file.cpp"));
  EXPECT_TRUE(has("tests/structure/include_rule_test.cpp"));
  const auto door = std::find_if(sources.begin(), sources.end(),
                                 [](const Source& s) { return s.path == "propagation/result_file.cpp"; });
  ASSERT_NE(door, sources.end());
  EXPECT_TRUE(
      std::any_of(door->includes.begin(), door->includes.end(), [](const Include& i) { return i.name == "hdf5.h"; }));
}

TEST(IncludeRule, ArrowsPointDown) {
  const Faults faults = arrow_faults(project());
  EXPECT_TRUE(faults.empty()) << joined(faults);
}

TEST(IncludeRule, NoFilesIncludeEachOther) {
  const Faults faults = cycle_faults(project());
  EXPECT_TRUE(faults.empty()) << joined(faults);
}

TEST(IncludeRule, EachPackageHasItsDoor) {
  const Faults faults = door_faults(project());
  EXPECT_TRUE(faults.empty()) << joined(faults);
}

TEST(IncludeRule, FilesHaveANameAndALength) {
  const Faults faults = form_faults(project());
  EXPECT_TRUE(faults.empty()) << joined(faults);
}

// The rules themselves, on made-up projects.

/// A source with its includes on lines 1, 2, …; names in <> are the system's.
Source made_up(const std::string& path, const Names& includes = {}) {
  Source source{path, {}, 1};
  int line = 0;
  for (const std::string& name : includes) {
    const bool quoted = name.front() != '<';
    source.includes.push_back({++line, quoted ? name : name.substr(1, name.size() - 2), quoted});
  }
  return source;
}

/// The faults are exactly one for each of `beginnings`, in this order, and begin like it.
void expect_faults(const Faults& faults, const Names& beginnings) {
  ASSERT_EQ(faults.size(), beginnings.size()) << joined(faults);
  for (std::size_t i = 0; i < faults.size(); ++i) EXPECT_TRUE(begins_with(faults[i], beginnings[i])) << faults[i];
}

TEST(IncludeRuleItself, ReadsDirectives) {
  std::istringstream text(
      "#pragma once\n#include \"core/vector.h\"\n  #  include <vector>  // why\n// #include \"scenes/a.h\"\nint a;\n");
  const Source source = parse("core/a.h", text);
  EXPECT_EQ(source.lines, 5);
  ASSERT_EQ(source.includes.size(), 2u);
  EXPECT_EQ(source.includes[0].name, "core/vector.h");
  EXPECT_EQ(source.includes[0].line, 2);
  EXPECT_TRUE(source.includes[0].quoted);
  EXPECT_EQ(source.includes[1].name, "vector");
  EXPECT_EQ(source.includes[1].line, 3);
  EXPECT_FALSE(source.includes[1].quoted);
}

TEST(IncludeRuleItself, SeesArrowsThatPointUp) {
  expect_faults(arrow_faults({
                    made_up("core/a.h", {"<vector>", "scenes/b.h"}),
                    made_up("scenes/b.h", {"core/a.h", "propagation/c.h", "propagation/laws/d.h"}),
                    made_up("propagation/c.h", {"scenes/b.h", "propagation/laws/d.h", "cli/e.h", "validation/v.h"}),
                    made_up("propagation/laws/d.h", {"core/a.h", "scenes/b.h", "propagation/c.h"}),
                    made_up("validation/v.h", {"propagation/c.h", "cli/e.h"}),
                    made_up("cli/e.h", {"validation/v.h", "propagation/laws/d.h", "tests/core/t.h"}),
                    made_up("tests/core/t.h", {"cli/e.h", "core/a.h"}),
                }),
                {
                    "core/a.h:2: core may not include scenes/b.h",
                    "scenes/b.h:2: scenes may not include propagation/c.h",
                    "scenes/b.h:3: scenes may not include propagation/laws/d.h",
                    "propagation/c.h:3: propagation may not include cli/e.h",
                    "propagation/c.h:4: propagation may not include validation/v.h",
                    "propagation/laws/d.h:2: propagation/laws may not include scenes/b.h",
                    "propagation/laws/d.h:3: propagation/laws may not include propagation/c.h",
                    "validation/v.h:1: validation may not include propagation/c.h",
                    "validation/v.h:2: validation may not include cli/e.h",
                    "cli/e.h:3: cli may not include tests/core/t.h",
                });
}

TEST(IncludeRuleItself, SeesWrongArrowsInBracketsToo) {
  expect_faults(arrow_faults({made_up("core/a.h", {"<scenes/b.h>"}), made_up("scenes/b.h")}),
                {"core/a.h:1: core may not include scenes/b.h"});
}

TEST(IncludeRuleItself, SeesIncludesThatDoNotStartAtTheRoot) {
  expect_faults(arrow_faults({made_up("core/a.h"), made_up("core/b.h", {"a.h"}), made_up("attic/c.h")}),
                {"core/b.h:1: \"a.h\" is no file of the project", "attic/c.h:1: lies in no room"});
}

TEST(IncludeRuleItself, SeesReferencesThatShareCodeWithWhatTheyCheck) {
  expect_faults(arrow_faults({
                    made_up("core/vector.h"),
                    made_up("core/special_functions.h"),
                    made_up("validation/quadrature.h"),
                    made_up("validation/half_plane.h", {"core/vector.h"}),
                    made_up("validation/half_plane.cpp",
                            {"validation/half_plane.h", "validation/quadrature.h", "core/special_functions.h"}),
                    made_up("propagation/laws/utd.h"),
                    made_up("validation/cases/wedges.cpp",
                            {"propagation/laws/utd.h", "core/special_functions.h", "validation/half_plane.h"}),
                    made_up("validation/cases/case.h"),
                    made_up("validation/wedge_series.cpp", {"propagation/laws/utd.h", "validation/cases/case.h"}),
                }),
                {"validation/half_plane.cpp:3: a reference may not include core/special_functions.h",
                 "validation/wedge_series.cpp:1: validation may not include propagation/laws/utd.h",
                 "validation/wedge_series.cpp:1: a reference may not include propagation/laws/utd.h",
                 "validation/wedge_series.cpp:2: validation may not include validation/cases/case.h",
                 "validation/wedge_series.cpp:2: a reference may not include validation/cases/case.h"});
}

TEST(IncludeRuleItself, SeesCycles) {
  expect_faults(cycle_faults({
                    made_up("core/a.h", {"core/b.h"}),
                    made_up("core/b.h", {"<vector>", "core/a.h"}),
                    made_up("core/c.h", {"core/d.h"}),
                    made_up("core/d.h", {"core/e.h"}),
                    made_up("core/e.h", {"core/a.h", "core/c.h"}),
                    made_up("core/f.h", {"core/f.h"}),
                }),
                {
                    "core/b.h:2: files include each other: core/a.h -> core/b.h -> core/a.h",
                    "core/e.h:2: files include each other: core/c.h -> core/d.h -> core/e.h -> core/c.h",
                    "core/f.h:1: files include each other: core/f.h -> core/f.h",
                });
  // A diamond is no cycle.
  expect_faults(cycle_faults({made_up("core/a.h", {"core/b.h", "core/c.h"}), made_up("core/b.h", {"core/d.h"}),
                              made_up("core/c.h", {"core/d.h"}), made_up("core/d.h")}),
                {});
}

TEST(IncludeRuleItself, SeesSecondDoors) {
  expect_faults(door_faults({
                    made_up("propagation/tracer.cpp", {"<embree3/rtcore.h>"}),
                    made_up("propagation/beam.cpp", {"<vector>", "<embree3/rtcore_ray.h>"}),
                }),
                {"propagation/beam.cpp:2: Embree has its one door in propagation/tracer.cpp",
                 "propagation/beam.cpp:2: a further door for Embree, which propagation/tracer.cpp"});
  // Benchmarks have one more, for the bare case alone.
  expect_faults(door_faults({
                    made_up("benchmarks/bare_embree.cpp", {"<embree3/rtcore.h>"}),
                    made_up("benchmarks/bare_embree.h", {"<embree3/rtcore.h>"}),
                    made_up("propagation/tracer.cpp", {"<embree3/rtcore.h>"}),
                }),
                {"benchmarks/bare_embree.h:1: Embree has its one door in propagation/tracer.cpp",
                 "propagation/tracer.cpp:1: a further door for Embree, which benchmarks/bare_embree.h"});
  expect_faults(door_faults({made_up("cli/report.cpp", {"<hdf5.h>"})}),
                {"cli/report.cpp:1: HDF5 has its one door in propagation/result_file.cpp"});
  expect_faults(door_faults({made_up("tests/scenes/a_test.cpp", {"<hdf5_hl.h>"})}),
                {"tests/scenes/a_test.cpp:1: HDF5"});
  expect_faults(door_faults({
                    made_up("scenes/a.cpp", {"<CGAL/Surface_mesh.h>", "<CGAL/Kernel.h>"}),
                    made_up("scenes/b.cpp", {"<OpenMesh/Core/Mesh.hh>"}),
                    made_up("scenes/c.cpp", {"\"assimp/scene.h"}),
                }),
                {});
  expect_faults(
      door_faults({made_up("scenes/a.cpp", {"<CGAL/Surface_mesh.h>"}), made_up("scenes/b.cpp", {"CGAL/a.h"})}),
      {"scenes/b.cpp:1: a further door for CGAL, which scenes/a.cpp"});
}

TEST(IncludeRuleItself, SeesPackagesInHeaders) {
  expect_faults(door_faults({made_up("scenes/mesh_file.h", {"<assimp/scene.h>"})}),
                {"scenes/mesh_file.h:1: assimp in a header"});
}

TEST(IncludeRuleItself, CountsDoorsByRoom) {
  expect_faults(door_faults({
                    made_up("propagation/summary.cpp", {"<nlohmann/json.hpp>"}),
                    made_up("cli/scene.cpp", {"<nlohmann/json.hpp>"}),
                    made_up("cli/report.cpp", {"<nlohmann/json.hpp>"}),
                    made_up("tests/cli/a_test.cpp", {"<nlohmann/json.hpp>"}),
                    made_up("tests/cli/b_test.cpp", {"<nlohmann/json.hpp>"}),
                    made_up("scenes/anything.h", {"<Eigen/Dense>"}),
                }),
                {"cli/report.cpp:1: a further door for nlohmann-json, which cli/scene.cpp"});
  expect_faults(door_faults({made_up("cli/a.cpp", {"<cairo.h>"}), made_up("cli/b.cpp", {"<cairo/cairo.h>"})}), {});
  expect_faults(door_faults({made_up("cli/a.cpp", {"<cairo.h>"}), made_up("cli/b.cpp", {"<cairo.h>"}),
                             made_up("cli/c.cpp", {"<cairo.h>"}), made_up("core/d.cpp", {"<cairo.h>"})}),
                {"cli/c.cpp:1: a further door for Cairo", "core/d.cpp:1: Cairo has its one door in cli",
                 "core/d.cpp:1: a further door for Cairo"});
}

TEST(IncludeRuleItself, SeesEmptyNamesAndLongFiles) {
  Source just_right = made_up("core/bands.cpp"), too_long = made_up("core/bands.h");
  just_right.lines = 600;
  too_long.lines = 601;
  expect_faults(form_faults({
                    just_right,
                    too_long,
                    made_up("core/math_utils.h"),
                    made_up("scenes/common.cpp"),
                    made_up("cli/helpers/table.h"),
                    made_up("core/commonwealth.h"),
                }),
                {"core/bands.h:601: the file has 601 lines", "core/math_utils.h:1: \"utils\"",
                 "scenes/common.cpp:1: \"common\"", "cli/helpers/table.h:1: \"helpers\""});
}

}  // namespace
