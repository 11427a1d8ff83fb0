// Pairs of a face and an edge that launched beams miss.

#include "propagation/aimed_pairs.h"

#include <cmath>

#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

const Vec3 hidden{0, 0, 1.5}, street{41.5, -15, 1.5};

/// A screen hides `hidden` from `street`, another one hides both from what a mirror, 3 m wide and 0.1 m high and 300 m
/// away, sends from one to the other: over the upper edge of the second screen.
Scene far_mirror() {
  MeshDescription hiding = solids::empty_mesh("metal");
  solids::add_quad(hiding, {10, -50, 0}, {10, 50, 0}, {10, 50, 100}, {10, -50, 100});
  hiding.artificial_edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  MeshDescription others = solids::empty_mesh("metal");
  solids::add_quad(others, {36, 0, 0}, {46, 0, 0}, {46, 0, 10}, {36, 0, 10});
  const Vec3 middle{5, 300, 5.75}, edge{41, 0, 10};
  Vec3 normal = normalized(hidden - middle) + normalized(edge - middle);
  normal = normalized(Vec3{normal.x, normal.y, 0});
  const Vec3 across{-1.5 * normal.y, 1.5 * normal.x, 0}, up{0, 0, 0.05};
  solids::add_quad(others, middle - across - up, middle + across - up, middle + across + up, middle - across + up);
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({hiding, others}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

/// From `from` to cells about `to` and to a receiver there.
Result by_the_mirror(const Vec3& from, const Vec3& to) {
  PlanDescription plan = test::plan_for(WaveKind::radio, 3.5e9, from);
  plan.coverage = CoverageRequest{1.5, 1, std::array<double, 4>{to.x - 10.5, to.y - 10.5, to.x + 10.5, to.y + 10.5},
                                  Polarisation::both};
  plan.depth = 2;
  plan.max_diffractions = 1;
  plan.rays = 2.5e5;
  const Result map = test::run(far_mirror(), plan);
  plan.coverage.reset();
  plan.receivers = {test::receiver_at(to)};
  Result both = test::run(far_mirror(), plan);
  both.coverage = map.coverage;
  return both;
}

/// The middle cell of the map against the receiver in its middle; the level changes by 1 dB over its
/// metre, so its mean and the one of its points differ by less than 0.5 dB.
void expect_the_same(const Result& result) {
  ASSERT_GT(result.profiles[0].total[0], 0);
  const auto& gain = result.coverage->path_gain;
  ASSERT_GT(gain[gain.size() / 2], 0);
  EXPECT_NEAR(test::decibel(gain[gain.size() / 2] / result.profiles[0].total[0]), 0, 0.5);
}

// The mirror fills 3e-7 of the sphere: not one of ten runs of 2.5e5 launched beams would meet it.
TEST(AimedPairs, AFaceThenAnEdge) { expect_the_same(by_the_mirror(hidden, street)); }
TEST(AimedPairs, AnEdgeThenAFace) { expect_the_same(by_the_mirror(street, hidden)); }

}  // namespace
}  // namespace grimaldi
