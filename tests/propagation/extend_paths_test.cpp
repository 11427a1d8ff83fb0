// Paths that extend strong ones, against their points by hand.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

/// Two long thin screens in a row, 20 m and 16 m high, on the ground, and a wall behind them.
Scene two_screens_and_a_wall() {
  MeshDescription metal = solids::empty_mesh("metal");
  const auto upright = [&](double x, double top) {
    solids::add_quad(metal, {x, -200, 0}, {x, 200, 0}, {x, 200, top}, {x, -200, top});
  };
  upright(40, 20);
  upright(90, 16);
  upright(140, 40);
  solids::add_quad(metal, {-50, -200, 0}, {140, -200, 0}, {140, 200, 0}, {-50, 200, 0});
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({metal}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

constexpr Vec3 transmitter{0, 0, 10}, receiver{110, 0, 1.5};

/// So few rays that chance finds no path over an edge.
ReceiverProfile profile(const Scene& scene, bool exchanged, unsigned threads) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, exchanged ? receiver : transmitter);
  plan.receivers = {test::receiver_at(exchanged ? transmitter : receiver)};
  plan.depth = 4;
  plan.rays = 100;
  plan.diffraction_model = DiffractionModel::utd;
  plan.threads = threads;
  plan.profile.max_paths = 100000;
  return test::run(scene, plan).profiles[0];
}

/// The path of these points between the ends, or null. 1e-6 m: Newton ends at 1e-9.
const PathStory* path_through(const ReceiverProfile& profile, const std::vector<Vec3>& between) {
  for (const PathStory& path : profile.paths[0]) {
    if (path.points.size() != between.size() + 2) continue;
    bool same = true;
    for (std::size_t i = 0; i < between.size(); ++i) same = same && distance(path.points[i + 1], between[i]) < 1e-6;
    if (same) return &path;
  }
  return nullptr;
}

const Vec3 first_edge{40, 0, 20}, second_edge{90, 0, 16};

/// Points between transmitter and receiver, all by similar triangles.
const std::vector<Vec3> expected[] = {
    // over both edges, then by the wall: to the receiver's image at x = 170
    {first_edge, second_edge, {140, 0, 16 - 14.5 * 50 / 80}},
    // between the edges by the ground
    {first_edge, {40 + 50 * 20. / 36, 0, 0}, second_edge},
    // from the second edge back to the first screen, and over the second edge again
    {first_edge, second_edge, {40, 0, 16}, second_edge},
};

// 1e-6 dB: Newton's points err by 1e-9 m, which turns phases of slopes by that much at 3.5 GHz.
TEST(ExtendPaths, AreFoundWithoutLuckFromEitherEnd) {
  const Scene scene = two_screens_and_a_wall();
  const ReceiverProfile there = profile(scene, false, 1), back = profile(scene, true, 1);
  for (std::vector<Vec3> between : expected) {
    const PathStory* one = path_through(there, between);
    std::reverse(between.begin(), between.end());
    const PathStory* other = path_through(back, between);
    ASSERT_NE(one, nullptr) << between.size();
    ASSERT_NE(other, nullptr) << between.size();
    EXPECT_NEAR(test::decibel(std::norm(one->amplitude[0]) / std::norm(other->amplitude[0])), 0, 1e-6);
  }
}

TEST(ExtendPaths, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene = two_screens_and_a_wall();
  const ReceiverProfile one = profile(scene, false, 1), three = profile(scene, false, 3);
  EXPECT_EQ(one.total[0], three.total[0]);
  ASSERT_EQ(one.paths[0].size(), three.paths[0].size());
  for (std::size_t i = 0; i < one.paths[0].size(); ++i)
    EXPECT_EQ(one.paths[0][i].amplitude, three.paths[0][i].amplitude) << i;
}

}  // namespace
}  // namespace grimaldi
