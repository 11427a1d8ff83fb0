// Transmitter and receiver swapped: the same paths, backwards.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

struct Link {
  Vec3 a, b;
};
const Link links[] = {{demo_city_rooftop, {20, -10, 1.5}},
                      {demo_city_mast, {-35, 60, 1.5}},
                      {{0, 0, 3}, {30, 35, 2}},
                      {{234, 150, 20}, {233, 160, 1.5}}};

Scene city(const std::string& material) {
  MaterialChoice choice;
  choice.replace = {{"*", material}};
  Material conductor;  // perfect but for 1e-9
  conductor.permittivity = Spectrum{{1e9}, {1}};
  conductor.conductivity = Spectrum{{1e9}, {1e26}};
  choice.overrides = {{"conductor", conductor}};
  return test::built_in("demo-city", {}, choice);
}

PlanDescription plan_between(const Vec3& from, const Vec3& to) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, from);
  plan.receivers = {test::receiver_at(to, Polarisation::vertical)};
  plan.depth = 2;
  plan.rays = 4e5;
  plan.profile.max_paths = 100000;
  return plan;
}

class Reciprocity : public testing::TestWithParam<std::string> {};

// Direct and reflected paths are a finite set that the rays of either end find whole; each is the same product of
// matrices backwards, rounded in another order: 1e-9 dB.
TEST_P(Reciprocity, ReflectedPathsAreTheSame) {
  const Scene scene = city(GetParam());
  for (const Link& link : links) {
    PlanDescription there = plan_between(link.a, link.b), back = plan_between(link.b, link.a);
    there.diffraction = back.diffraction = false;
    const ReceiverProfile x = test::run(scene, there).profiles[0], y = test::run(scene, back).profiles[0];
    ASSERT_GT(x.total[0], 0);
    std::printf("%s: %zu and %zu paths, power %+.1e dB, coherent %+.1e dB\n", GetParam().c_str(), x.paths[0].size(),
                y.paths[0].size(), test::decibel(x.total[0] / y.total[0]),
                test::decibel(x.total_coherent[0] / y.total_coherent[0]));
    EXPECT_EQ(x.paths[0].size(), y.paths[0].size());
    EXPECT_NEAR(test::decibel(x.total[0] / y.total[0]), 0, 1e-9);
    // The fields' phases are those of lengths rounded to 1e-13 m: 1e-11 rad, more where the sum is a null.
    EXPECT_NEAR(test::decibel(x.total_coherent[0] / y.total_coherent[0]), 0, 1e-6);
    EXPECT_NEAR(x.mean_delay[0], y.mean_delay[0], 1e-15);
  }
}

/// The same points in the other order. Newton's steps end at 1e-9 m, points at corners at the corner.
bool same_way(const PathStory& a, const PathStory& b) {
  if (a.points.size() != b.points.size()) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    if (distance(a.points[i], b.points[b.points.size() - 1 - i]) > 1e-6) return false;
  return true;
}

/// The tokens in any order: the edge's number tells which edge of a corner it is.
std::string sorted_letters(std::string text) {
  std::sort(text.begin(), text.end());
  return text;
}

double power_of(const PathStory& path) { return std::norm(path.amplitude[0]); }

// One edge and at most one reflection: what both ends find is the same path with the same strength: the edge's law is
// symmetric in its legs, that of two edges in both. What only one end finds is chance.
TEST_P(Reciprocity, DiffractedPathsAreTheSame) {
  const Scene scene = city(GetParam());
  for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd})
    for (const Link& link : links) {
      PlanDescription there = plan_between(link.a, link.b), back = plan_between(link.b, link.a);
      there.diffraction_model = back.diffraction_model = model;
      const ReceiverProfile x = test::run(scene, there).profiles[0], y = test::run(scene, back).profiles[0];
      double total[2] = {}, common[2] = {}, lone = 0;
      double worst = 0, worst_two = 0;
      std::size_t same = 0;
      for (const PathStory& path : x.paths[0]) {
        const auto twin = std::find_if(y.paths[0].begin(), y.paths[0].end(), [&](const PathStory& other) {
          return same_way(path, other) && sorted_letters(path.interactions) == sorted_letters(other.interactions);
        });
        total[0] += power_of(path);
        if (twin == y.paths[0].end()) {
          lone += power_of(path);
          continue;
        }
        ++same;
        common[0] += power_of(path);
        common[1] += power_of(*twin);
        const auto edges = std::count(path.interactions.begin(), path.interactions.end(), 'D');
        // Weak paths beside the nulls of the antennas' polarisation are left out: their rounding is that of stronger
        // ones.
        if (power_of(path) < 1e-20) continue;
        const double off = std::abs(test::decibel(power_of(path) / power_of(*twin)));
        (edges < 2 ? worst : worst_two) = std::max(edges < 2 ? worst : worst_two, off);
      }
      for (const PathStory& path : y.paths[0]) total[1] += power_of(path);
      std::printf(
          "%s: %zu of %zu/%zu paths found by both; one edge within %.1e dB, two within %.2f dB; found by one alone "
          "%.1e "
          "of the power; "
          "totals %+.3f dB, with interference %+.3f dB\n",
          GetParam().c_str(), same, x.paths[0].size(), y.paths[0].size(), worst, worst_two, lone / total[0],
          test::decibel(total[0] / total[1]), test::decibel(x.total[0] / y.total[0]));
      EXPECT_LT(worst, 1e-6);
      // Newton's points err by 1e-9 m, which the slopes of a soft face's pair magnify.
      EXPECT_LT(worst_two, 1e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(Engine, Reciprocity, testing::Values("conductor", "concrete"),
                         [](const auto& p) { return p.param; });

}  // namespace
}  // namespace grimaldi
