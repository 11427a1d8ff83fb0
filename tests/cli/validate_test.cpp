// `grimaldi validate` as it is shipped: list, selection, table, validate.json, report page.

#include <nlohmann/json.hpp>

#include "cli/figure_picture.h"
#include "cli/report_page.h"
#include "cli/validate_verb.h"
#include "tests/cli/program.h"

namespace grimaldi {
namespace {

using test::Outcome;
using Json = nlohmann::json;

class Validate : public test::Program {};

TEST_F(Validate, ListsItsCases) {
  const Outcome all = run({"validate", "--list"});
  EXPECT_EQ(all.code, 0) << all.err;
  for (const char* name : {"apertures/square/D10/N0.1/fsd ", "wedges/utd/270/soft/k-rho-10 ", "published/ring ",
                           "invariance/rotated-30 ", "extremes/boundary "})
    EXPECT_NE(all.out.find(std::string("\n") + name), std::string::npos) << name;
  const Outcome some = run({"validate", "--list", "slit/D10"});
  EXPECT_EQ(std::count(some.out.begin(), some.out.end(), '\n'), 12);
  EXPECT_TRUE(files_in(".").size() == 2) << "only what the test itself keeps";
}

TEST_F(Validate, WritesTableJsonAndReport) {
  const Outcome outcome = run({"validate", "materials", "wedges/black-edges/270/hard"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("pass materials/slab/matrix"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("9 of 9 cases pass, 0 miss"), std::string::npos) << outcome.out;
  EXPECT_EQ(files_in("validate.out"),
            (std::vector<std::string>{"figure-wedge-270-hard.png", "report.html", "validate.json"}));
  const Json json = Json::parse(contents("validate.out/validate.json"));
  EXPECT_EQ(json["cases"].size(), 9u);
  EXPECT_EQ(json["passed"], 9);
  EXPECT_EQ(json["failed"], 0);
  EXPECT_GE(json["seconds"].get<double>(), 0);
  for (const Json& one : json["cases"]) {
    for (const char* key : {"name", "quantity", "reference", "unit", "reason"})
      EXPECT_TRUE(one[key].is_string()) << key;
    for (const char* key : {"error", "tolerance", "seconds"}) EXPECT_TRUE(one[key].is_number()) << key;
    EXPECT_TRUE(one["passed"].get<bool>());
  }
  const std::string page = contents("validate.out/report.html");
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0u);
  EXPECT_NE(page.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  for (const char* outside : {"<script", "http://", "https://", "src=\"figure"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* tag : {"table", "figure", "h2", "h3", "main"}) {
    const auto count = [&](const std::string& what) {
      std::size_t found = 0;
      for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++found;
      return found;
    };
    EXPECT_EQ(count(std::string("</") + tag + ">"),
              count(std::string("<") + tag + ">") + count(std::string("<") + tag + " "))
        << tag;
  }
}

TEST_F(Validate, AnOlderResultIsReplacedOnlyWithOverwrite) {
  ASSERT_EQ(run({"validate", "wedges/black-edges/270/hard", "-o", "v", "--quiet"}).code, 0);
  const Outcome again = run({"validate", "materials/rain", "-o", "v"});
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.err.find("validate.json: -o: a result is already there"), std::string::npos) << again.err;
  const Outcome replaced = run({"validate", "materials/rain", "-o", "v", "--overwrite", "--json"});
  EXPECT_EQ(replaced.code, 0) << replaced.err;
  EXPECT_EQ(Json::parse(replaced.out)["cases"].size(), 1u);
  EXPECT_EQ(replaced.out, contents("v/validate.json"));
  EXPECT_EQ(files_in("v"), (std::vector<std::string>{"report.html", "validate.json"}));  // the old figure is gone
}

TEST_F(Validate, UnknownCasesAreRefused) {
  const Outcome outcome = run({"validate", "squair", "wedgs", "-o", "v"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("error: squair: unknown case; did you mean square?"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("error: wedgs: unknown case; did you mean wedges?"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("v"));
}

// A miss is told by table, page and file alike.
TEST(ValidationTable, TellsWhatMisses) {
  const Case good{"a/good", "one question", "truth", "1", 1e-6, "rounding", 0, {}};
  const Case bad{"a/bad", "one question", "truth", "dB", 0.1, "<far field>", 0, {}};
  const std::vector<CaseResult> results = {{&good, {1e-9, "", {}}, true, 0.5}, {&bad, {3, "at N = 1", {}}, false, 0.1}};
  const std::string table = validation_table(results, 1);
  EXPECT_EQ(table.find("one question"), table.rfind("one question")) << "one heading for both\n" << table;
  EXPECT_NE(table.find("pass a/good"), std::string::npos);
  EXPECT_NE(table.find("MISS a/bad"), std::string::npos);
  EXPECT_NE(table.find("error 3, allowed 0.1 dB (<far field>); at N = 1"), std::string::npos) << table;
  EXPECT_NE(table.find("1 of 2 cases pass, 1 miss"), std::string::npos);
  EXPECT_EQ(validation_exit_code(results), 3);
  EXPECT_EQ(validation_exit_code({results[0]}), 0);
  const std::string page = report_page(results, {}, 1);
  EXPECT_NE(page.find("1 of 2 cases miss"), std::string::npos);
  EXPECT_NE(page.find("&lt;far field&gt;"), std::string::npos);
  EXPECT_NE(page.find("(9.0 digits)"), std::string::npos);
}

TEST(FigurePicture, DrawsWhatItIsGiven) {
  RasterRow row;
  row.title = "T";
  row.panels = {{"a", 2, {0, 1, NAN, 0.5}}, {"b", 2, {2, -1, 0, 1}}};
  const Canvas rasters = figure_picture({"f", "", row});
  EXPECT_EQ(rasters.width(), 1600);
  LineChart chart;
  chart.curves = {{"truth", {0, 1, 2}, {0, 0.5, NAN}}, {"ours", {0, 1, 2}, {1e9, -1e9, 0.5}}};
  EXPECT_EQ(figure_picture({"f", "", chart}).width(), 1600);
  EXPECT_EQ(figure_picture({"f", "", LineChart{}}).width(), 1600);  // nothing to show is no fault
}

}  // namespace
}  // namespace grimaldi
