// The engine's receivers in the scenes of ../shared against the search through all paths of two interactions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "scenes/scene_file.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/exhaustive_search.h"

namespace grimaldi {
namespace {

struct Quarter {
  const char* name;
  Vec3 transmitter;  ///< in no plane of a face
  double half;       ///< m, of the square in which the points lie
  std::size_t points;
};
void PrintTo(const Quarter& quarter, std::ostream* out) { *out << quarter.name; }

class Exhaustive : public testing::TestWithParam<Quarter> {};

// A receiver asks for what is not found yet until at most 0.1 % of the power can be left: 0.005 dB.
TEST_P(Exhaustive, NothingIsMissed) {
  const Quarter& quarter = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(GRIMALDI_SHARED) / "data/sionna" / quarter.name / (std::string(quarter.name) + ".xml");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Diagnostics diagnostics;
  const Scene scene = scene_of(read_scene_file(file, diagnostics), perfect_faces());
  PlanDescription plan = point_to_point(WaveKind::radio, 3.5e9, quarter.transmitter, 1e5);
  plan.diffraction_model = DiffractionModel::utd;
  for (const Vec3& point : street_points(scene, quarter.half, quarter.points, 1)) add_receiver(plan, point);
  const ExhaustiveComparison run = compare_with_exhaustive_search(scene, plan);
  ASSERT_FALSE(run.share.empty());
  for (std::size_t i = 0; i < run.share.size(); ++i) {
    EXPECT_NEAR(decibel(run.share[i]), 0, 0.01) << run.places[i].x << ", " << run.places[i].y;
    EXPECT_NEAR(run.delay[i], 0, 1e-12) << run.places[i].x << ", " << run.places[i].y;
  }
  for (const auto& part : run.classes)
    RecordProperty(part.name, std::to_string(part.engine_paths) + " of " + std::to_string(part.all_paths));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Exhaustive,
                         testing::Values(Quarter{"munich", {8.5, 21, 27.37}, 250, 2},
                                         Quarter{"simple_street_canyon", {-31.3, 3.2, 9.37}, 60, 6},
                                         Quarter{"simple_wedge", {-12.3, 3.7, 0.4}, 25, 6}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace grimaldi
