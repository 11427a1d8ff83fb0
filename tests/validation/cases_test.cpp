// The machinery of the cases, and the families that take no time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "validation/cases/families.h"
#include "validation/cases/opening.h"
#include "validation/cases/results_file.h"
#include "validation/cases/suite.h"

namespace grimaldi {
namespace {

Case made_up(double error, double tolerance, double at_least = 0) {
  return {"made-up/case", "a question", "the truth", "1",
          tolerance,      "because",    at_least,    [error] { return Outcome{error, "a note", {}}; }};
}

CaseResult run_one(const Case& subject) { return run_cases({&subject}, 1).front(); }

TEST(Cases, PassWithinTheirTolerance) {
  EXPECT_TRUE(run_one(made_up(1e-3, 1e-3)).passed);
  EXPECT_FALSE(run_one(made_up(1.01e-3, 1e-3)).passed);
  EXPECT_TRUE(run_one(made_up(0, 0)).passed);
}

TEST(Cases, MissWhereAFailureIsNotWhatItWas) {
  EXPECT_TRUE(run_one(made_up(5, 10, 1)).passed);
  EXPECT_FALSE(run_one(made_up(0.5, 10, 1)).passed);
  EXPECT_FALSE(run_one(made_up(11, 10, 1)).passed);
}

TEST(Cases, WhatIsNotFiniteIsAMiss) {
  EXPECT_FALSE(run_one(made_up(NAN, 1)).passed);
  EXPECT_FALSE(run_one(made_up(INFINITY, INFINITY)).passed);
}

TEST(Cases, AFaultIsAMissThatSaysWhy) {
  Case subject = made_up(0, 1);
  subject.run = []() -> Outcome { throw std::runtime_error("it broke"); };
  const CaseResult result = run_one(subject);
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.outcome.note, "it broke");
}

TEST(Cases, RunInTheirOrderOnAnyNumberOfThreads) {
  std::vector<Case> cases;
  for (int i = 0; i < 50; ++i) cases.push_back(made_up(i, 100));
  std::vector<const Case*> list;
  for (const Case& one : cases) list.push_back(&one);
  int told = 0;
  const auto results = run_cases(list, 4, [&](const CaseResult&) { ++told; });
  ASSERT_EQ(results.size(), 50u);
  EXPECT_EQ(told, 50);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(results[std::size_t(i)].outcome.error, i);
}

TEST(Cases, EachHasANameAToleranceAndAReason) {
  std::set<std::string> names;
  for (const Case& one : all_cases()) {
    SCOPED_TRACE(one.name);
    EXPECT_TRUE(names.insert(one.name).second) << "twice";
    EXPECT_NE(one.name.find('/'), std::string::npos);
    EXPECT_EQ(one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-/"),
              std::string::npos);
    EXPECT_FALSE(one.quantity.empty() || one.reference.empty() || one.reason.empty());
    EXPECT_TRUE(one.unit == "dB" || one.unit == "1") << one.unit;
    EXPECT_TRUE(one.tolerance >= one.at_least && std::isfinite(one.tolerance));
    EXPECT_TRUE(one.run);
  }
  EXPECT_GT(names.size(), 300u);
  const std::vector<std::string> suites = suite_names();
  EXPECT_EQ(std::set<std::string>(suites.begin(), suites.end()).size(), suites.size())
      << "a suite stands in two places";
}

TEST(Cases, SelectedByNameSuiteAndPart) {
  Diagnostics diagnostics;
  EXPECT_EQ(select_cases({}, diagnostics).size(), all_cases().size());
  const auto one = select_cases({"apertures/square/D10/N0.1/fsd"}, diagnostics);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0]->name, "apertures/square/D10/N0.1/fsd");
  EXPECT_EQ(select_cases({"apertures/square/D10"}, diagnostics).size(), 12u);  // six distances, two theories
  for (const Case* subject : select_cases({"extremes"}, diagnostics))
    EXPECT_EQ(subject->name.rfind("extremes/", 0), 0u);
  // A word is whole parts: D1 is not D10. Twice named is once run.
  EXPECT_EQ(select_cases({"square/D10", "D10"}, diagnostics).size(), select_cases({"D10"}, diagnostics).size());
  EXPECT_FALSE(diagnostics.has_errors());
  select_cases({"square/D1"}, diagnostics);
  select_cases({"extreems"}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_NE(to_string(diagnostics.all()[1]).find("did you mean extremes?"), std::string::npos)
      << to_string(diagnostics.all()[1]);
}

TEST(Cases, ResultsFile) {
  const Case good = made_up(1e-6, 1e-3), bad = made_up(NAN, 1);
  const std::string json = results_json(run_cases({&good, &bad}, 1), 1.5);
  for (const char* part : {"\"name\": \"made-up/case\"", "\"suite\": \"made-up\"", "\"quantity\": \"a question\"",
                           "\"reference\": \"the truth\"", "\"error\": 1e-06", "\"error\": null", "\"unit\": \"1\"",
                           "\"tolerance\": 0.001", "\"reason\": \"because\"", "\"passed\": true", "\"digits\": 6.0",
                           "\"passed\": 1", "\"failed\": 1", "\"seconds\": 1.5"})
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
}

// The measure itself: half the power is 3 dB, directions 20 dB below the peak do not count.
TEST(PatternError, MedianOfTheLevelsThatCount) {
  const PatternError error = pattern_error({0.5, 0.25, 1, 0.1, 77}, {1, 0.5, 1, 0.1, 0.005});
  EXPECT_EQ(error.directions, 4u);
  EXPECT_NEAR(error.median, 10 * std::log10(2), 1e-12);
}

// Both sides of an opening have the same area and hold the same points of the pattern together.
TEST(Opening, TrianglesCoverTheLoops) {
  for (const std::string& name : opening_names()) {
    const Opening shape = opening(name, 10);
    double sum = 0;
    for (const auto& corner : shape.triangles.triangles) {
      const PlanePoint &a = shape.triangles.vertices[corner[0]], &b = shape.triangles.vertices[corner[1]],
                       &c = shape.triangles.vertices[corner[2]];
      sum += 0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    EXPECT_NEAR(sum, area(shape.aperture), 1e-12 * sum) << name;
    EXPECT_LE(std::max(shape.wide, shape.high), 10 * (1 + 1e-12)) << name;
  }
}

// The field of connected edges jumps nowhere: over the shadow of an edge, past its end, over a corner.
TEST(Opening, ConnectedEdgesAreContinuous) {
  const Opening shape = opening("square", 6);
  for (const double y : {0.0, 2.9, 3.0, 3.4})
    for (const double z : {2.0, 30.0}) {
      const auto before = connected_field(shape, {3 - 1e-9, y + 1e-9, z}),
                 after = connected_field(shape, {3 + 1e-9, y + 1e-9, z});
      EXPECT_LT(std::abs(after - before), 1e-7) << y << ' ' << z;
    }
}

class Family : public testing::TestWithParam<std::pair<const char*, Cases (*)()>> {};

// The exact shadow boundary in the engine is told by `validate` alone.
TEST_P(Family, Passes) {
  const Cases cases = GetParam().second();
  std::vector<const Case*> list;
  for (const Case& one : cases) list.push_back(&one);
  for (const CaseResult& result : run_cases(list, 0))
    EXPECT_TRUE(result.passed) << result.subject->name << ": error " << result.outcome.error << ", allowed "
                               << result.subject->at_least << " to " << result.subject->tolerance << " "
                               << result.subject->unit << "; " << result.outcome.note;
}

INSTANTIATE_TEST_SUITE_P(Cases, Family,
                         testing::Values(std::pair{"apertures", &aperture_cases}, std::pair{"wedges", &wedge_cases},
                                         std::pair{"knife_edges", &knife_edge_cases},
                                         std::pair{"screens", &screen_cases}, std::pair{"energy", &energy_cases},
                                         std::pair{"materials", &material_cases},
                                         std::pair{"extremes", &extreme_kernel_cases}),
                         [](const auto& p) { return p.param.first; });

}  // namespace
}  // namespace grimaldi
