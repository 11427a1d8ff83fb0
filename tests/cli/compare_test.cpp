// grimaldi compare: the program end to end, the figures on made-up maps, the depth in the shadow.

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/axes.h"
#include "cli/comparison.h"
#include "cli/comparison_page.h"
#include "cli/difference_picture.h"
#include "cli/shadow_depth.h"
#include "core/constants.h"
#include "tests/cli/program.h"
#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

using Json = nlohmann::json;
using test::Outcome;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;
constexpr double infinite = std::numeric_limits<double>::infinity();

class Compare : public test::Program {
 protected:
  /// The half-plane, transmitter and cells 5 m below its edge: v falls from 4.5 at x = 10 m to 2.2 at x = 100 m.
  static Words half_plane(Words more = {}) {
    Words words = {"compare",       "--scene", "half-plane", "--frequency", "1GHz", "--tx=-50,0,-5", "--area",
                   "10,-50,100,50", "--rays",  "20000",      "--cell-size", "10",   "--depth",       "1",
                   "--height",      "3995"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  void expect_refused(const Words& words, const Words& parts) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    for (const std::string& part : parts) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
};

const Words top_files = {"compare.json", "difference.png", "fsd", "report.html", "utd"};
const Words model_files = {"coverage.png", "result.h5", "summary.json"};

TEST_F(Compare, WritesWhatTheContractSays) {
  const Outcome outcome = run(small("compare", {"--cell-size", "10", "--json", "--set", "receiver.0.name=corner"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files_in("grimaldi.out"), top_files);
  for (const char* model : {"fsd", "utd"}) {
    const std::string folder = std::string("grimaldi.out/") + model;
    EXPECT_EQ(files_in(folder), model_files);
    EXPECT_EQ(contents(folder + "/coverage.png").substr(1, 3), "PNG");
  }
  EXPECT_EQ(contents("grimaldi.out/difference.png").substr(1, 3), "PNG");
  EXPECT_EQ(outcome.out, contents("grimaldi.out/compare.json"));
  const Json json = Json::parse(outcome.out);
  for (const char* model : {"fsd", "utd"}) {
    EXPECT_EQ(json["models"][model], Json::parse(contents(std::string("grimaldi.out/") + model + "/summary.json")));
    EXPECT_GT(json["models"][model]["wall_seconds"].get<double>(), 0);
  }
  // The same beams: both runs sent the same rays along the same ways.
  for (const char* key : {"rays", "segments", "passes"})
    EXPECT_EQ(json["models"]["fsd"][key], json["models"]["utd"][key]) << key;
  const Json& all = json["difference_dB"];
  EXPECT_GT(all["cells"].get<int>(), 400);
  for (const char* key : {"median", "median_abs", "p95_abs"}) EXPECT_TRUE(all[key].is_number()) << key;
  EXPECT_LE(all["median_abs"].get<double>(), all["p95_abs"].get<double>());
  ASSERT_EQ(json["regions"].size(), 4u);
  std::size_t cells = 0;
  for (std::size_t r = 0; r < 4; ++r) {
    const Json& region = json["regions"][r];
    EXPECT_EQ(region["name"], region_names[r]);
    EXPECT_TRUE(region["median"].is_number() && region["p95_abs"].is_number()) << region;
    // Brick houses are solid: UTD wherever edges matter.
    EXPECT_EQ(region["believe"], r == 0 ? "either" : "utd");
    cells += region["cells"].get<std::size_t>();
  }
  EXPECT_EQ(cells, all["cells"].get<std::size_t>());
  // Faces and free lines do not know of the theory.
  for (const char* same : {"direct", "reflection"}) {
    EXPECT_GT(json["mechanisms"][same]["cells"].get<int>(), 100);
    EXPECT_LT(json["mechanisms"][same]["p95_abs"].get<double>(), 1e-9) << same;
  }
  EXPECT_GT(json["mechanisms"]["diffraction"]["p95_abs"].get<double>(), 0.1);
  const Json& corner = json["profiles"]["corner"];
  EXPECT_NEAR(corner["level_dB"].get<double>(), 0, 0.5);  // it stands in the street, in sight
  EXPECT_TRUE(corner["delay_spread_s"].is_number());
}

TEST_F(Compare, TheReportPageIsWholeInItself) {
  ASSERT_EQ(run(small("compare", {"--cell-size", "20", "--quiet", "-o", "out"})).code, 0);
  const std::string page = contents("out/report.html");
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("data:image/png;base64,iVBORw0KGgo"), 3u);
  for (const char* outside : {"<script", "http://", "https://", ">nan", " nan", ">inf"})
    EXPECT_EQ(count(outside), 0u) << outside;
  for (const char* tag : {"table", "figure", "h1", "h2", "p", "div", "main"})
    EXPECT_EQ(count(std::string("</") + tag + ">"),
              count(std::string("<") + tag + ">") + count(std::string("<") + tag + " "))
        << tag;
  EXPECT_NE(page.find("<td class=v>UTD"), std::string::npos);  // brick houses are solid
}

// Behind a thin screen both theories are one law: K. of the half-plane, 0.02 dB in the engine.
TEST_F(Compare, BothTheoriesAgreeBehindTheHalfPlane) {
  const Outcome outcome = run(half_plane({"--json", "--quiet", "-o", "out"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["difference_dB"]["cells"], 90);
  EXPECT_NEAR(json["difference_dB"]["median"].get<double>(), 0, 0.02);
  EXPECT_LT(json["difference_dB"]["p95_abs"].get<double>(), 0.02);
  for (const Json& region : json["regions"]) EXPECT_EQ(region["believe"], "either");
  EXPECT_EQ(json["regions"][0]["cells"], 0);
  EXPECT_TRUE(json["regions"][0]["median"].is_null());
  EXPECT_GT(json["regions"][1]["cells"], 0);
  EXPECT_GT(json["regions"][2]["cells"], 50);
  EXPECT_EQ(json["difference_dB"]["beyond_noise"], 0);
}

TEST_F(Compare, TheStoredScenariosRunAgainAsTheyWere) {
  ASSERT_EQ(run(half_plane({"--quiet", "-o", "out", "--diffraction", "utd"})).code, 0);
  // The text of the scenario stands in the file as it is.
  EXPECT_NE(contents("out/fsd/result.h5").find("diffraction = \"fsd\""), std::string::npos);
  EXPECT_NE(contents("out/utd/result.h5").find("diffraction = \"utd\""), std::string::npos);
}

TEST_F(Compare, AnOlderResultIsReplacedOnlyWithOverwrite) {
  fs::create_directories(folder_ / "out/utd");
  write("out/utd/result.h5", "mine");
  expect_refused(half_plane({"-o", "out"}), {"out/utd/result.h5", "a result is already there", "--overwrite"});
  EXPECT_EQ(contents("out/utd/result.h5"), "mine");
  ASSERT_EQ(run(half_plane({"-o", "out", "--quiet", "--overwrite"})).code, 0);
  EXPECT_EQ(files_in("out"), top_files);
  expect_refused(half_plane({"-o", "out"}), {"out/compare.json", "a result is already there"});
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  expect_refused(small("compare", {"--diffraction", "fsd-published"}),
                 {"propagation.diffraction", "fsd-published is not compared", "leave the key out"});
  expect_refused(small("compare", {"--mechanisms", "direct,reflection"}),
                 {"propagation.mechanisms", "no diffraction", "add \"diffraction\""});
  expect_refused({"compare", "--scene", "street-canyon", "--frequency", "1GHz", "--tx", "0,0,10"},
                 {"coverage: missing", "a map or receivers", "--cell-size 5"});
  write("file", "");
  expect_refused(small("compare", {"-o", "file"}), {"file: -o: cannot be a folder"});
  expect_refused(small("compare", {"--cel-size", "5"}), {"--cel-size", "unknown option", "--cell-size"});
  expect_refused({"compare", "absent.toml"}, {"absent.toml", "no such file"});
  EXPECT_FALSE(exists("grimaldi.out"));
}

TEST_F(Compare, AnInterruptedRunLeavesNothing) {
  const pid_t child = start(small("compare", {"--rays", "1e10", "--cell-size", "2", "--progress", "-o", "out"}));
  ASSERT_GT(child, 0);
  wait_until_it_traces();
  kill(child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted (nothing was written)"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("out"));
}

// v = h √(2 (d1 + d2) / (λ d1 d2)), ITU-R P.526-15 (26), for h small against d1 and d2: at 50 m the next term of the
// detour is (h/d)²/4 of it. 1 mm that the point is off the edge is 0.02 % of the height.
TEST(ShadowDepth, OfTheHalfPlaneIsThatOfTheKnifeEdge) {
  const Scene scene = test::built_in("half-plane");
  const Tracer tracer(scene);
  const double wavelength = 0.3;
  const ShadowDepth around(scene, tracer, wavelength);
  const auto depth = [&](double z) { return around({-50, 0, z}, {50, 3, z}, 5, 5); };
  for (const double height : {1.0, 2.0, 5.0}) {
    const double v = height * std::sqrt(2 * 100 / (wavelength * 50 * 50));
    EXPECT_NEAR(depth(-height), v, 0.005 * v);
    EXPECT_NEAR(depth(height), -v, 0.005 * v);
  }
  EXPECT_EQ(depth(-30), infinite);  // v = 15: deeper than was asked
  EXPECT_EQ(depth(30), -infinite);
}

// The ground is so large that a ray passes over what lies within millimetres of its ends, the faces of the edge too.
TEST(ShadowDepth, NoEdgeLeadsIntoItsOwnWedge) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(solids::scene({solids::box({-10, -10, 0}, {10, 10, 10}, false), solids::ground(5e3)}),
                                  {}, diagnostics);
  const Tracer tracer(scene);
  ASSERT_GT(tracer.surface_gap(), 2e-3);
  const ShadowDepth around(scene, tracer, 0.1);
  EXPECT_EQ(around({-60, 1, 15}, {1, 2, 5}, 1e3, 1e3), infinite);
  // 0.02: the way passes 1 mm off the edge. Behind the wall over the roof's far edge: √(70² + 5²) + √(10² + 8.5²) −
  // √(80² + 13.5²) m around.
  const double detour = std::hypot(70, 5) + std::hypot(10, 8.5) - std::hypot(80, 13.5);
  EXPECT_NEAR(around({-60, 1, 15}, {20, 1, 1.5}, 1e3, 1e3), 2 * std::sqrt(detour / 0.1), 0.02);
}

/// A grid of n cells in a row on the lit side of a half-plane, with the gains of both theories; errors of 1 %.
struct MadeUp {
  Scene scene = test::built_in("half-plane");
  Tracer tracer{scene};
  Plan plan;
  Result fsd, utd;

  MadeUp(std::vector<double> of_fsd, std::vector<double> of_utd) {
    plan.request = test::plan_for(WaveKind::radio, 1e9, {-50, 0, 100});
    plan.request.coverage.emplace();
    plan.frequency = {1e9};
    plan.wavenumber = {20.958};
    plan.grid = {of_fsd.size(), 1, 10, -5, 10, 100};
    fill(fsd, of_fsd);
    fill(utd, of_utd);
  }
  static void fill(Result& result, const std::vector<double>& gains) {
    CoverageMap& map = result.coverage.emplace();
    map.path_gain = gains;
    for (const double gain : gains) {
      map.standard_error.push_back(0.01 * gain);
      map.inside_fraction.push_back(std::isnan(gain) ? 1 : 0);
    }
    map.mechanism_gain.assign(mechanism_count * gains.size(), 0.0);
    map.model_gain.assign(edge_model_count * gains.size(), 0.0);
    for (std::size_t i = 0; i < gains.size(); ++i) map.mechanism_gain[3 * gains.size() + i] = gains[i];
  }
  Comparison compare() const { return compare_results(scene, tracer, plan, fsd, utd).value(); }
};

TEST(Comparison, CountsCellsAndDecibels) {
  // Inside, reached by neither, by each alone; then 0, +3.01, −10, +0.04 dB: the last is within the noise of 0.06 dB.
  const MadeUp made({NAN, 0, 1, 0, 1, 2, 1, 1.01}, {NAN, 0, 0, 1, 1, 1, 10, 1});
  const Comparison c = made.compare();
  using Sort = Comparison::Sort;
  EXPECT_EQ(c.sort, (std::vector<Sort>{Sort::inside, Sort::neither, Sort::only_fsd, Sort::only_utd, Sort::both,
                                       Sort::both, Sort::both, Sort::both}));
  EXPECT_EQ(c.first().only_fsd, 1u);
  EXPECT_EQ(c.first().only_utd, 1u);
  EXPECT_EQ(c.first().all.cells, 4u);
  EXPECT_NEAR(c.difference_dB[5], 10 * std::log10(2), 1e-12);
  EXPECT_NEAR(c.first().all.median, 0, 1e-12);  // nearest rank: the second of four
  EXPECT_NEAR(c.first().all.p95_abs, 10, 1e-12);
  EXPECT_EQ(c.first().all.beyond_noise, 0.5);
  EXPECT_EQ(c.first().regions[0].cells, 4u);  // 100 m above the edge: lit
  EXPECT_EQ(c.first().mechanisms[3].cells, 4u);
  EXPECT_EQ(c.first().mechanisms[0].cells, 0u);
  EXPECT_FALSE(c.solid);
  const std::vector<std::string> words = comparison_words(made.plan, c, made.fsd, made.utd);
  const auto told = [&](const std::string& part) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& one) { return one.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(told("Over 4 cells"));
  EXPECT_TRUE(told("50 % of them differ by more than twice"));
  EXPECT_TRUE(told("1 cell reached by FSD alone, 1 cell by UTD alone"));
}

/// A row of cells 5 m below the edge of the half-plane, as is the transmitter, in these bands.
struct BehindTheEdge : MadeUp {
  explicit BehindTheEdge(const std::vector<double>& frequencies) : MadeUp(row(), row()) {
    plan.request.transmitters.front().position = {-50, 0, -5};
    plan.grid.z = -5;
    plan.frequency = frequencies;
    plan.wavenumber.clear();
    for (const double f : frequencies) plan.wavenumber.push_back(2 * pi * f / speed_of_light);
    std::vector<double> of_fsd, of_utd;
    for (std::size_t band = 0; band < frequencies.size(); ++band)
      for (std::size_t cell = 0; cell < row().size(); ++cell)
        of_fsd.push_back(1), of_utd.push_back(frequencies[band] / 1e9);
    fsd = utd = {};
    fill(fsd, of_fsd);
    fill(utd, of_utd);
  }
  static std::vector<double> row() { return std::vector<double>(10, 1.0); }
};

// v goes with the root of the frequency; each band of a comparison is what that band alone would be.
TEST(Comparison, EachBandIsAsItIsAlone) {
  const BehindTheEdge both({4e9, 1e9});
  const Comparison c = both.compare();
  ASSERT_EQ(c.bands.size(), 2u);
  for (std::size_t band = 0; band < 2; ++band) {
    const Comparison alone = BehindTheEdge({both.plan.frequency[band]}).compare();
    EXPECT_EQ(c.bands[band].frequency, both.plan.frequency[band]);
    EXPECT_EQ(c.bands[band].all.median, alone.first().all.median);
    for (std::size_t r = 0; r < region_count; ++r)
      EXPECT_EQ(c.bands[band].regions[r].cells, alone.first().regions[r].cells) << band << " " << r;
  }
  EXPECT_NEAR(c.bands[0].all.median, -10 * std::log10(4), 1e-12);
  EXPECT_EQ(c.bands[0].regions[1].cells, 0u);  // v = 4.4 and more
  EXPECT_GT(c.bands[1].regions[1].cells, 0u);  // v = 2.2 at the far end
  const Json json = Json::parse(comparison_json(c, "{}", "{}", {}));
  ASSERT_EQ(json["bands"].size(), 2u);
  EXPECT_EQ(json["bands"][1]["frequency_Hz"], 1e9);
  for (const char* key : {"difference_dB", "regions", "mechanisms", "profiles"})
    EXPECT_EQ(json["bands"][0][key], json[key]) << key;
}

TEST(Comparison, TellsHowFarItIsAndStops) {
  const MadeUp made({1, 1}, {1, 1});
  std::vector<double> shares;
  std::atomic<bool> stop = false;
  const auto progress = [&](double share) { shares.push_back(share); };
  EXPECT_TRUE(compare_results(made.scene, made.tracer, made.plan, made.fsd, made.utd, progress, &stop).has_value());
  EXPECT_EQ(shares, std::vector<double>{1});  // one row
  stop = true;
  EXPECT_FALSE(compare_results(made.scene, made.tracer, made.plan, made.fsd, made.utd, progress, &stop).has_value());
}

TEST(Comparison, NothingReachedIsNoFault) {
  const MadeUp made({NAN, 0}, {NAN, 0});
  const Comparison c = made.compare();
  EXPECT_EQ(c.first().all.cells, 0u);
  EXPECT_TRUE(std::isnan(c.first().all.median));
  EXPECT_GT(difference_picture(made.scene, made.plan, made.fsd, made.utd, c).width(), 1000);
  const Json json = Json::parse(comparison_json(c, "{}", "{}", {}));
  EXPECT_TRUE(json["difference_dB"]["median"].is_null());
  EXPECT_NE(comparison_words(made.plan, c, made.fsd, made.utd).front().find("No cell"), std::string::npos);
}

TEST(DifferencePicture, ShowsWhoIsStrongerAndWhoIsAlone) {
  const MadeUp made({2, 1, 1, 0}, {1, 2, 0, 1});
  const Canvas canvas = difference_picture(made.scene, made.plan, made.fsd, made.utd, made.compare());
  const ValueRange scale{-5, 5};  // 3.01 dB, rounded up
  EXPECT_EQ(difference_scale(3.01), 5);
  std::vector<Colour> wanted = {diverging_colour_of(10 * std::log10(2), scale),
                                diverging_colour_of(-10 * std::log10(2), scale), only_fsd_colour, only_utd_colour};
  for (const Colour& colour : wanted) {
    std::size_t pixels = 0;
    for (int y = 0; y < canvas.height(); ++y)
      for (int x = 0; x < canvas.width(); ++x) pixels += canvas.pixel(x, y) == colour;
    EXPECT_GT(pixels, 1000u) << int(colour.red) << " " << int(colour.green) << " " << int(colour.blue);
  }
}

TEST(DivergingColours, AreSymmetricAboutNearWhite) {
  const ValueRange scale{-2, 2};
  EXPECT_EQ(diverging_colour_of(0, scale), (Colour{247, 247, 247}));
  EXPECT_EQ(diverging_colour_of(-9, scale), (Colour{5, 48, 97}));
  EXPECT_EQ(diverging_colour_of(9, scale), (Colour{103, 0, 31}));
}

}  // namespace
}  // namespace grimaldi
