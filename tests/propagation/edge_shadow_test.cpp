// Shadows on edges against similar triangles, and views from both ends.

#include "propagation/edge_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"
#include "propagation/both_ends.h"
#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

constexpr double gap = 1e-4;

/// An edge of 10 m along x at y = 20, z = 0, free all round.
Wedge bar() {
  Wedge wedge{};
  wedge.start = {0, 20, 0};
  wedge.direction = {1, 0, 0};
  wedge.length = 10;
  wedge.along0 = {0, 0, -1};
  wedge.normal0 = {0, 1, 0};
  wedge.exterior_angle = 2 * pi;
  wedge.cos_half = -1;
  return wedge;
}

/// One triangle at y = 5 whose cut with z = 0 goes from x = `from` to `to`.
Scene screen(double from, double to) {
  Scene scene;
  scene.vertices = {{from, 5, -1}, {to, 5, -1}, {0.5 * (from + to), 5, 1e9}};
  scene.triangles = {{0, 1, 2}};
  return scene;
}

// The eye at the origin, the triangle at a quarter of the way: its shadow is four times as large. 1e-8: the slope of
// the triangle's sides, and 3 gaps that the edge is seen above its line.
TEST(EdgeShadow, IsThatOfSimilarTriangles) {
  EdgeShadow shadow(bar(), {0, 0, 0}, gap);
  shadow.add(screen(0.5, 1), 0);
  ASSERT_EQ(shadow.dark().size(), 1u);
  EXPECT_NEAR(shadow.dark()[0].first, 0.2, 1e-8);
  EXPECT_NEAR(shadow.dark()[0].second, 0.4, 1e-8);
  EXPECT_TRUE(shadow.is_dark(0.3));
  EXPECT_FALSE(shadow.is_dark(0.5));
  shadow.add(screen(2, 2.2), 0);
  EXPECT_EQ(shadow.dark().size(), 2u);
  shadow.add(screen(-1, 0.6), 0);
  shadow.add(screen(0.9, 2.1), 0);
  EXPECT_EQ(shadow.dark().size(), 1u);
  EXPECT_FALSE(shadow.all_dark());
  shadow.add(screen(2.1, 7), 0);
  EXPECT_TRUE(shadow.all_dark());
}

TEST(EdgeShadow, NothingBehindTheEyeOrTheEdgeCastsOne) {
  Scene scene = screen(-10, 10);
  for (const double y : {-5.0, 25.0}) {
    for (Vec3& corner : scene.vertices) corner.y = y;
    EdgeShadow shadow(bar(), {0, 0, 0}, gap);
    shadow.add(scene, 0);
    EXPECT_TRUE(shadow.dark().empty()) << y;
  }
}

// What a view leaves out as dark, no ray reaches; what it says to be dark of an edge in view, neither. A hundredth of a
// hair at the rim of a shadow is beyond rays of single precision: five places of each edge, not its ends.
TEST(EndView, LeavesOutOnlyWhatNoRayReaches) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  const Tracer tracer(scene);
  std::uint64_t rays = 0;
  for (const Vec3& eye : {Vec3{-41.3, 8.2, 26.4}, Vec3{20.1, 20.7, 1.5}, Vec3{-60.2, 60.3, 1.5}}) {
    const EndView view(scene, tracer, eye, 0, 0, rays);
    std::size_t lit = 0;
    for (std::uint32_t w = 0; w < scene.wedges.wedges.size(); ++w) {
      const Wedge& wedge = scene.wedges.wedges[w];
      const EndView::Edge* edge = view.edge_of(w);
      for (const double share : {0.05, 0.27, 0.51, 0.74, 0.95}) {
        const Vec3 place = wedge.point(share * wedge.length) + 3 * tracer.surface_gap() * wedge.bisector();
        if (!tracer.visible(eye, place)) continue;
        const Vec3 way = eye - wedge.start;
        if (dot(way, wedge.normal0) < 0 && dot(way, wedge.normaln()) < 0) continue;  // along a face, below it
        ++lit;
        EXPECT_TRUE(edge && !edge->shadow.is_dark(share)) << w << " at " << share;
      }
    }
    EXPECT_GT(lit, 20u);
  }
}

// Ends exchanged, each finds the other's strongest sequences, backwards.
TEST(BothEnds, FindTheSameFromEither) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  const Tracer tracer(scene);
  const Vec3 a{-41.3, 8.2, 26.4}, b{-60.2, 60.3, 1.5};
  PlanDescription request = test::plan_for(WaveKind::radio, 1e9, a);
  request.depth = 2;
  request.receivers = {{"r", b, Polarisation::both}};
  std::vector<std::vector<Interaction>> found[2];
  for (const int way : {0, 1}) {
    request.transmitters[0].position = way == 0 ? a : b;
    request.receivers[0].position = way == 0 ? b : a;
    const Plan plan = make_plan(request, scene, tracer, diagnostics);
    std::uint64_t rays = 0;
    const EndView from = view_from(scene, tracer, plan, way == 0 ? a : b, rays);
    const EndView to = view_from(scene, tracer, plan, way == 0 ? b : a, rays);
    SequenceTable sequences;
    double power = 0;
    for (const std::uint32_t s :
         add_from_both_ends(scene, tracer, plan, 0, from, to, power, SequenceTable(), sequences, rays, nullptr)) {
      auto& one = found[way].emplace_back(sequences[s].begin(), sequences[s].end());
      if (way == 1) std::reverse(one.begin(), one.end());
    }
  }
  // Strongest first; weak ones may lie on either side of what is negligible.
  for (const int way : {0, 1}) {
    ASSERT_GT(found[way].size(), 40u);
    for (std::size_t i = 0; i < 30; ++i)
      EXPECT_NE(std::find(found[1 - way].begin(), found[1 - way].end(), found[way][i]), found[1 - way].end())
          << testing::PrintToString(found[way][i]);
  }
}

}  // namespace
}  // namespace grimaldi
