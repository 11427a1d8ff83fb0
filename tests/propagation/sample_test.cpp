// The sampled estimator against the connected map, where both apply: power counted along beams, and fields at points.

#include "propagation/sample.h"

#include <cmath>
#include <cstring>

#include "core/constants.h"
#include "propagation/laws/published_diffraction.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

constexpr auto diffraction_layer = static_cast<std::size_t>(Mechanism::diffraction);

struct SampledRun {
  SampledLayer layer;
  CoverageGrid grid;
};

SampledRun sampled(const Scene& scene, const PlanDescription& description, std::uint64_t samples,
                   const SampledClasses& classes = {}) {
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  SampledRun run{{}, make_coverage_grid(scene, plan)};
  run.layer = sample_diffraction(scene, tracer, plan, 0, run.grid, samples, 0, classes);
  return run;
}

/// The diffraction layer of the connected map, each cell as the mean of parts × parts cells.
std::vector<double> connected(const Scene& scene, PlanDescription description, int parts) {
  const double cell = description.coverage->cell_size;
  description.coverage->cell_size /= parts;
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  const Result result = simulate(scene, tracer, plan);
  const CoverageMap& map = *result.coverage;
  const GridLayout& fine = plan.grid;
  const auto n = static_cast<std::size_t>(parts), nx = fine.nx / n, ny = fine.ny / n;
  EXPECT_EQ(nx * n, fine.nx);
  EXPECT_EQ(ny * n, fine.ny);
  EXPECT_NEAR(fine.cell * parts, cell, 1e-9);
  std::vector<double> gain(nx * ny, 0), outdoors(nx * ny, 0);
  for (std::size_t c = 0; c < fine.size(); ++c) {
    if (map.inside_fraction[c] >= 1) continue;
    const std::size_t at = (c / fine.nx / n) * nx + c % fine.nx / n;
    gain[at] += (1 - map.inside_fraction[c]) * map.mechanism_gain[diffraction_layer * fine.size() + c];
    outdoors[at] += 1 - map.inside_fraction[c];
  }
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = outdoors[i] > 0 ? gain[i] / outdoors[i] : 0;
  return gain;
}

struct Comparison {
  double chi2 = 0, total_sampled = 0, total_connected = 0, total_error2 = 0;
  int cells = 0;
  double ratio() const { return total_sampled / total_connected; }
  double ratio_error() const { return std::sqrt(total_error2) / total_connected; }
};

/// Cells with at least 100 samples, so that their standard error is known to some 10 %; `slack` = relative error of the
/// connected map's cell means.
Comparison compare(const SampledRun& run, const std::vector<double>& expected, double slack, double least_gain = 0) {
  Comparison c;
  EXPECT_EQ(run.layer.gain.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (run.grid.inside_fraction[i] > 0) continue;
    c.total_sampled += run.layer.gain[i];
    c.total_connected += expected[i];
    c.total_error2 += run.layer.standard_error[i] * run.layer.standard_error[i];
    if (run.layer.hits[i] < 100 || expected[i] < least_gain) continue;
    const double error = run.layer.standard_error[i], off = run.layer.gain[i] - expected[i];
    c.chi2 += off * off / (error * error + slack * slack * expected[i] * expected[i]);
    ++c.cells;
  }
  return c;
}

void print(const char* name, const Comparison& c) {
  std::printf("%s: %d cells, chi2/cells %.3f, total sampled/connected %.5f +- %.5f\n", name, c.cells, c.chi2 / c.cells,
              c.ratio(), c.ratio_error());
}

class HalfPlaneSampled : public testing::TestWithParam<std::pair<WaveKind, double>> {};

TEST_P(HalfPlaneSampled, AgreesWithTheConnectedMap) {
  const auto [kind, frequency] = GetParam();
  const Scene scene = test::built_in("half-plane", {{"length", 400}, {"depth", 100}});
  PlanDescription plan = test::plan_for(kind, frequency, {-40, 0, -3});
  plan.reflection = false;
  plan.direct = false;
  plan.depth = 1;
  plan.rays = 4e6;  // 3 × 3 points a cell for edges' waves
  plan.coverage = CoverageRequest{};
  plan.coverage->height = 90;  // z = −10: the screen's foot is the scene's lowest height
  plan.coverage->cell_size = 5;
  plan.coverage->area = {2.5, -50, 62.5, 50};
  const SampledRun run = sampled(scene, plan, 8'000'000);
  const Comparison c = compare(run, connected(scene, plan, 1), 0);
  print(kind == WaveKind::radio ? "half-plane, radio" : "half-plane, sound", c);
  EXPECT_GT(c.cells, 200);
  // χ² of n cells has a spread of √(2n): 4 of them. (Cells share samples' weights only through the same beams: one cell
  // a beam.)
  EXPECT_NEAR(c.chi2 / c.cells, 1, 4 * std::sqrt(2.0 / c.cells));
  EXPECT_NEAR(c.ratio(), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Waves, HalfPlaneSampled,
                         testing::Values(std::pair{WaveKind::radio, 1e9}, std::pair{WaveKind::acoustic, 500.0}),
                         [](const auto& p) { return p.param.first == WaveKind::radio ? "radio" : "sound"; });

// The published method, sampled in the engine, against its expectation by quadrature: a row of cells behind the screen,
// 10 m below its edge. Cell means by 3 × 1 points. Slack 2 %: the quadrature's steps and cells 4 m wide across; the
// screen of 120 m ends 8 sigma from the middle.
TEST(PublishedSampled, AgreesWithItsExpectation) {
  const Scene scene = test::built_in("half-plane", {{"length", 120}, {"depth", 100}});
  PlanDescription plan = test::plan_for(WaveKind::radio, 1e9, {-100, 0, 0});
  plan.diffraction_model = DiffractionModel::fsd_published;
  plan.reflection = false;
  plan.direct = false;
  plan.depth = 1;
  plan.coverage = CoverageRequest{};
  plan.coverage->height = 90;
  plan.coverage->cell_size = 8;
  plan.coverage->area = {24, -4, 120, 4};
  const SampledRun run = sampled(scene, plan, 4'000'000);
  const double wavelength = speed_of_light / 1e9;
  const PublishedFootprint footprint{published_sigma_wavelengths * wavelength};
  std::vector<double> expected;
  for (std::size_t cell = 0; cell < run.grid.layout.size(); ++cell) {
    double mean = 0;
    for (const double share : {-1.0, 0.0, 1.0}) {
      const double x = run.grid.layout.centre(cell).x + share * std::sqrt(0.6) * 4;  // Gauss-Legendre
      const double level = published_half_plane_level(footprint, wavelength, 100, x, 10, 800, 120);
      mean += (share == 0 ? 8 : 5) / 18.0 * level * std::pow(wavelength / (4 * pi), 2) / ((100 + x) * (100 + x) + 100);
    }
    expected.push_back(mean);
  }
  const Comparison c = compare(run, expected, 0.01);
  print("fsd-published behind the half-plane", c);
  EXPECT_EQ(c.cells, 12);
  EXPECT_LT(c.chi2 / c.cells, 1 + 4 * std::sqrt(2.0 / c.cells));
  EXPECT_NEAR(c.ratio(), 1, 0.02);
}

/// Rigid walls, a source in a side street and the street that it does not see.
class StreetCanyonSampled : public testing::Test {
 protected:
  Scene scene() const {
    MaterialChoice choice;
    choice.replace = {{"*", "metal"}};
    Material metal = built_in_materials().at("metal");
    metal.absorption = Spectrum{{1000}, {0}};
    choice.overrides = {{"metal", metal}};
    return test::built_in("street-canyon", {}, choice);
  }
  PlanDescription plan(int depth) const {
    PlanDescription plan = test::plan_for(WaveKind::acoustic, 1000, {1, 19, 8});
    plan.direct = false;
    plan.depth = depth;
    plan.max_diffractions = 1;
    plan.rays = 4e6;
    plan.coverage = CoverageRequest{};
    plan.coverage->cell_size = 4;
    plan.coverage->area = {-40, -8, 40, 8};
    return plan;
  }
};

// χ² as above. Totals: 1 % is what the two ways are asked to agree to; the standard errors of the totals are 0.3 % here
// and 0.6 % with reflections.
TEST_F(StreetCanyonSampled, EdgesAgree) {
  const Scene scene = this->scene();
  const SampledRun run = sampled(scene, plan(1), 8'000'000);
  const Comparison c = compare(run, connected(scene, plan(1), 4), 0);
  print("street canyon, E", c);
  EXPECT_GT(c.cells, 60);
  EXPECT_NEAR(c.chi2 / c.cells, 1, 4 * std::sqrt(2.0 / c.cells));
  EXPECT_NEAR(c.ratio(), 1, 0.01);
}

TEST_F(StreetCanyonSampled, EdgesAndOneReflectionAgree) {
  const Scene scene = this->scene();
  const SampledRun run = sampled(scene, plan(2), 8'000'000, {1, 1});
  const Comparison c = compare(run, connected(scene, plan(2), 4), 0);
  print("street canyon, E + ER + RE", c);
  EXPECT_GT(c.cells, 60);
  EXPECT_NEAR(c.chi2 / c.cells, 1, 4 * std::sqrt(2.0 / c.cells));
  EXPECT_NEAR(c.ratio(), 1, 0.01);
}

// Sums are taken in the order of the samples, whoever drew them.
TEST_F(StreetCanyonSampled, SameBitsOnAnyNumberOfThreads) {
  const Scene scene = this->scene();
  PlanDescription one = plan(2), three = plan(2);
  one.threads = 1;
  three.threads = 3;
  const SampledLayer a = sampled(scene, one, 100'000, {1, 1}).layer, b = sampled(scene, three, 100'000, {1, 1}).layer;
  EXPECT_EQ(std::memcmp(a.gain.data(), b.gain.data(), a.gain.size() * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(a.standard_error.data(), b.standard_error.data(), a.gain.size() * sizeof(double)), 0);
  EXPECT_EQ(a.hits, b.hits);
}

// Each class adds power, and nothing is sampled where nothing diffracts.
TEST_F(StreetCanyonSampled, ClassesAreThoseAskedFor) {
  const Scene scene = this->scene();
  const auto total = [&](const PlanDescription& description, const SampledClasses& classes) {
    double sum = 0;
    for (const double gain : sampled(scene, description, 200'000, classes).layer.gain) sum += gain;
    return sum;
  };
  const double edges = total(plan(2), {0, 0}), after = total(plan(2), {0, 1}), both = total(plan(2), {1, 1});
  EXPECT_GT(edges, 0);
  // A rigid street gives each wave from an edge at least its image in the ground: 1.5 times the power is a safe bound
  // on chance.
  EXPECT_GT(after, 1.5 * edges);
  EXPECT_GT(both, after);
  EXPECT_EQ(total(plan(1), {1, 1}), edges);
  PlanDescription none = plan(2);
  none.diffraction = false;
  EXPECT_EQ(total(none, {1, 1}), 0);
}

}  // namespace
}  // namespace grimaldi
