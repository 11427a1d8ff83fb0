// Runs that end by accuracy or by time.

#include "propagation/budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "propagation/result_file.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

PlanDescription canyon() {
  PlanDescription description = test::plan_for(WaveKind::radio, 3.5e9, {0, 0, 10});
  description.coverage = CoverageRequest{1.5, 5, std::nullopt, Polarisation::both};
  description.depth = 2;
  return description;
}

struct Ended {
  Plan plan;
  Result result;
};

Ended end_of(const PlanDescription& description) {
  const Scene scene = test::built_in("street-canyon");
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  Result result = simulate_within_budget(scene, tracer, plan, std::chrono::steady_clock::now());
  return {std::move(plan), std::move(result)};
}

TEST(Budget, EndsWithTheAccuracyAsked) {
  PlanDescription description = canyon();
  description.accuracy = 6.0;
  const Ended end = end_of(description);
  ASSERT_EQ(end.result.figures.ended_by, BudgetEnd::accuracy);
  const MapFigures figures = map_figures(end.plan, *end.result.coverage);
  EXPECT_LE(figures.p95_standard_error_dB, 6);
  // Counted anew: the share of the reached cells below the accuracy.
  std::size_t reached = 0, accurate = 0;
  for (std::size_t i = 0; i < end.result.coverage->path_gain.size(); ++i) {
    const double gain = end.result.coverage->path_gain[i];
    if (!(gain > 0)) continue;
    ++reached;
    accurate += 10 * std::log10(1 + end.result.coverage->standard_error[i] / gain) <= 6;
  }
  EXPECT_GE(double(accurate), 0.95 * double(reached));
  EXPECT_TRUE(end.result.warnings.empty());
}

TEST(Budget, TheLastRoundReplaysToTheSameBits) {
  PlanDescription description = canyon();
  description.accuracy = 6.0;
  const Ended end = end_of(description);
  description.accuracy = std::nullopt;
  description.rays = end.plan.request.rays;
  const Ended again = end_of(description);
  EXPECT_TRUE(again.result.figures.rounds.empty());
  EXPECT_EQ(std::memcmp(end.result.coverage->path_gain.data(), again.result.coverage->path_gain.data(),
                        again.result.coverage->path_gain.size() * sizeof(double)),
            0);
}

TEST(Budget, TimeLeavesAWholeRoundAndSaysWhatItReached) {
  PlanDescription description = canyon();
  description.accuracy = 0.01;  // out of reach
  description.time = 1.0;
  const Ended end = end_of(description);
  EXPECT_EQ(end.result.figures.ended_by, BudgetEnd::time);
  ASSERT_FALSE(end.result.figures.rounds.empty());
  EXPECT_EQ(end.plan.request.rays, end.result.figures.rounds.back().rays);
  EXPECT_FALSE(end.result.interrupted);
  ASSERT_TRUE(end.result.coverage.has_value());
  ASSERT_EQ(end.result.warnings.size(), 1u);
  EXPECT_NE(to_string(end.result.warnings[0]).find("the time was up"), std::string::npos);
}

TEST(Budget, ToldToStopItStops) {
  const Scene scene = test::built_in("street-canyon");
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  PlanDescription description = canyon();
  description.time = 60.0;
  Plan plan = make_plan(description, scene, tracer, diagnostics);
  const std::atomic<bool> stop = true;
  const Result result = simulate_within_budget(scene, tracer, plan, std::chrono::steady_clock::now(), {}, &stop);
  EXPECT_TRUE(result.interrupted);
}

}  // namespace
}  // namespace grimaldi
