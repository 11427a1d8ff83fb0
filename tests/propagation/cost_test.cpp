// What a run will cost: samples that are parts of the run, and the law from them to the whole.

#include "propagation/cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "propagation/run_sample.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

struct City {
  Scene scene = test::built_in("demo-city");
  Tracer tracer{scene};
  Plan plan;

  explicit City(double cell_size, double rays = 40000, unsigned threads = 0) {
    PlanDescription description = test::plan_for(WaveKind::radio, 3.5e9, {8.5, 21, 27});
    description.coverage = CoverageRequest{1.5, cell_size, std::nullopt, Polarisation::both};
    description.depth = 2;
    description.rays = rays;
    description.threads = threads;
    Diagnostics diagnostics;
    plan = make_plan(description, scene, tracer, diagnostics);
    diagnostics.throw_if_errors();
  }
};

TEST(Cost, ASampleOfCellsKeepsTheirOwnPoints) {
  const City city(5);
  const CoverageGrid grid = make_coverage_grid(city.scene, city.plan);
  constexpr std::size_t block = 3;
  const CoverageGrid sample = sample_of(grid, block, 1);
  ASSERT_EQ(sample.layout.nx, (grid.layout.nx + block - 1) / block);
  ASSERT_EQ(sample.ranges.size(), sample.layout.size());
  for (std::size_t square = 0; square < sample.layout.size(); ++square) {
    const auto points = sample.of(square);
    if (points.empty()) continue;
    const Vec3 first = sample.layout.centre(square) + points[0].offset;
    // The cell of the map in which the point lies has it too, and lies in the square.
    const auto x = static_cast<std::size_t>((first.x - grid.layout.x0) / grid.layout.cell);
    const auto y = static_cast<std::size_t>((first.y - grid.layout.y0) / grid.layout.cell);
    ASSERT_EQ(x / block, square % sample.layout.nx);
    ASSERT_EQ(y / block, square / sample.layout.nx);
    const std::size_t cell = y * grid.layout.nx + x;
    ASSERT_EQ(points.size(), grid.of(cell).size());
    ASSERT_EQ(sample.dense_of(square).size(), grid.dense_of(cell).size());
    for (std::size_t i = 0; i < points.size(); ++i)
      // Rounding of coordinates of some 1e3 m.
      ASSERT_LT(
          distance(sample.layout.centre(square) + points[i].offset, grid.layout.centre(cell) + grid.of(cell)[i].offset),
          1e-9);
  }
}

TEST(Cost, ACellOfTheSampleIsDrawnFairly) {
  const City city(5);
  const CoverageGrid grid = make_coverage_grid(city.scene, city.plan);
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  };
  const CoverageGrid sample = sample_of(grid, 4, 1);
  // An inside fraction lies in 0 … 1, so its standard deviation is at most ½; four of them, for a seed that is fixed.
  EXPECT_NEAR(mean(sample.inside_fraction), mean(grid.inside_fraction),
              4 * 0.5 / std::sqrt(double(sample.inside_fraction.size())));
}

TEST(Cost, TheWholeIsASampleOfItself) {
  const City city(20);
  const RunFigures run = simulate(city.scene, city.tracer, city.plan).figures;
  const RunFigures sample = simulate_sample(city.scene, city.tracer, city.plan,
                                            sample_of(make_coverage_grid(city.scene, city.plan), 1, 1), 1);
  EXPECT_EQ(sample.rays, run.rays);
  EXPECT_EQ(sample.segments, run.segments);
  EXPECT_EQ(sample.sequences, run.sequences);
  EXPECT_EQ(sample.seeds, run.seeds);
  // A cell's points are moved by a rounding error, which may tip a grazing one.
  EXPECT_NEAR(double(sample.sequence_cell_pairs), double(run.sequence_cell_pairs),
              1e-3 * double(run.sequence_cell_pairs));
}

TEST(Cost, AStrideOfFourHasAQuarterOfTheBeams) {
  // One edge at most: the beams of a second search depend on what the first one found.
  City city(20);
  city.plan.request.max_diffractions = 1;
  const CoverageGrid grid = make_coverage_grid(city.scene, city.plan);
  const RunFigures all = simulate_sample(city.scene, city.tracer, city.plan, grid, 1);
  const RunFigures quarter = simulate_sample(city.scene, city.tracer, city.plan, grid, 4);
  EXPECT_NEAR(double(quarter.rays), double(all.rays) / 4, city.plan.request.passes);
  // Some 1e4 beams of up to some 50 segments each, neighbours alike: 10 % is many standard errors.
  EXPECT_NEAR(4 * double(quarter.segments) / double(all.segments), 1, 0.1);
  EXPECT_LE(quarter.sequences, all.sequences);
  EXPECT_LE(quarter.seeds, all.seeds);
}

TEST(Cost, TheCountsDependOnTheSeedAlone) {
  const auto counts = [](unsigned threads) {
    const City city(10, 40000, threads);
    const CoverageGrid sample = sample_of(make_coverage_grid(city.scene, city.plan), 3, city.plan.request.seed);
    const RunFigures run = simulate_sample(city.scene, city.tracer, city.plan, sample, 9);
    return std::vector<std::uint64_t>{run.rays,      run.segments, run.shadow_rays,
                                      run.sequences, run.seeds,    run.sequence_cell_pairs};
  };
  EXPECT_EQ(counts(1), counts(3));
}

SampleCost some_sample() {
  SampleCost sample;
  RunFigures& run = sample.figures;
  run.discover_seconds = run.discover_cpu_seconds = 0.2;
  run.grow_seconds = run.grow_cpu_seconds = 0.3;
  run.evaluate_seconds = run.evaluate_cpu_seconds = 0.4;
  run.sequences = 1000;
  run.seeds = 3000;
  run.segments = 100000;
  run.sequence_cell_pairs = 2000;
  return sample;
}

TEST(Cost, ASampleThatIsTheWholeCostsTheWhole) {
  const SampleCost sample = some_sample();
  EXPECT_NEAR(scaled_up(sample).cpu_seconds, 0.9, 1e-12);
  EXPECT_NEAR(scaled_up(sample).seconds, 0.9, 1e-12);
}

TEST(Cost, TheSmallerTheSampleWasTheMoreTheWholeCosts) {
  SampleCost sample = some_sample();
  for (const int depth : {1, 3}) {
    sample.depth = depth;
    double SampleCost::*const shares[] = {&SampleCost::beam_share, &SampleCost::cell_share};
    for (const auto share : shares) {
      SampleCost smaller = sample;
      smaller.*share = 0.01;
      const Prediction more = scaled_up(smaller), less = scaled_up(sample);
      EXPECT_GT(more.cpu_seconds, less.cpu_seconds);
      EXPECT_GT(more.seconds, less.seconds);
      EXPECT_GT(more.memory_bytes, less.memory_bytes);
    }
  }
}

TEST(Cost, WallTimeIsAsMuchOfTheProcessorsAsInTheSample) {
  SampleCost sample = some_sample();
  sample.beam_share = sample.cell_share = 0.02;
  const double one = scaled_up(sample).seconds;
  for (double* const wall :
       {&sample.figures.discover_seconds, &sample.figures.grow_seconds, &sample.figures.evaluate_seconds})
    *wall /= 2;
  EXPECT_NEAR(scaled_up(sample).seconds, one / 2, 1e-12 * one);
}

TEST(Cost, APredictionIsToldOrNot) {
  const City city(10);
  const auto told = predict_cost(city.scene, city.tracer, city.plan, 0);
  ASSERT_TRUE(told);
  EXPECT_GT(told->seconds, 0);
  EXPECT_GT(told->cpu_seconds, 0);
  EXPECT_GT(told->pilot_seconds, 0);
  // At least the map itself: path_gain of one transmitter and band.
  EXPECT_GT(told->memory_bytes, 8 * city.plan.grid.size());
  // A run shorter than a year is not worth it, nor one that the user stopped, nor one without a map.
  EXPECT_FALSE(predict_cost(city.scene, city.tracer, city.plan, 3e7));
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(predict_cost(city.scene, city.tracer, city.plan, 0, &stop));
  Plan profile = city.plan;
  profile.request.coverage.reset();
  EXPECT_FALSE(predict_cost(city.scene, city.tracer, profile, 0));
}

}  // namespace
}  // namespace grimaldi
