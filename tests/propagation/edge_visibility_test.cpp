// What hides one edge from another for good, and that a scene which knows it gives the same maps.

#include "propagation/edge_visibility.h"

#include <array>
#include <cmath>
#include <random>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

constexpr double gap = 1e-4;
using Line = std::array<Vec3, 2>;

/// A sheet in the plane y = 5 of rectangles given by their corners in x and z.
Scene sheet(const std::vector<std::array<double, 4>>& rectangles) {
  MeshDescription mesh = solids::empty_mesh("metal");
  for (const auto& [x0, z0, x1, z1] : rectangles)
    solids::add_quad(mesh, {x0, 5, z0}, {x1, 5, z0}, {x1, 5, z1}, {x0, 5, z1});
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({mesh}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

/// Along x at height z = 0.
Line line(double y, double from, double to) { return {Vec3{from, y, 0}, Vec3{to, y, 0}}; }

// Halfway between the lines stands a sheet to x = 2: of lines to x = 1 and x = t the outermost way passes it at
// (1 + t)/2. It hides as a whole: neither of its triangles has all four ways.
TEST(ConvexFaces, ASheetHidesWhatAllFourWaysCut) {
  const Scene scene = sheet({{-2, -2, 2, 2}});
  ASSERT_EQ(scene.triangles.size(), 2u);
  const ConvexFaces faces(scene);
  for (const std::uint32_t triangle : {0u, 1u}) {
    EXPECT_TRUE(faces.hides(triangle, line(0, -1, 1), line(10, -1, 1), gap));
    EXPECT_TRUE(faces.hides(triangle, line(0, -1, 1), line(10, -1, 2.999), gap));
    EXPECT_FALSE(faces.hides(triangle, line(0, -1, 1), line(10, -1, 3.001), gap));
    EXPECT_FALSE(faces.hides(triangle, line(0, -1, 1), line(4, -1, 1), gap)) << "in front of it";
    EXPECT_FALSE(faces.hides(triangle, line(0, -1, 1), line(5 + gap, -1, 1), gap)) << "upon it";
  }
}

// Two arms joined at their foot: the ends of the line are hidden behind one arm each, its middle is seen between them.
TEST(ConvexFaces, NothingIsHiddenInAGapOrThroughAHole) {
  const Line eye = line(0, -0.01, 0.01), behind = line(10, -4, 4);
  const Scene fork = sheet({{-3, -3, -1, -1}, {-1, -3, 1, -1}, {1, -3, 3, -1}, {-3, -1, -1, 3}, {1, -1, 3, 3}});
  const Scene frame = sheet({{-3, -3, -1, -1},
                             {-1, -3, 1, -1},
                             {1, -3, 3, -1},
                             {-3, -1, -1, 1},
                             {1, -1, 3, 1},
                             {-3, 1, -1, 3},
                             {-1, 1, 1, 3},
                             {1, 1, 3, 3}});
  for (const Scene* scene : {&fork, &frame}) {
    ASSERT_EQ(scene->patches.patches.size(), 1u);
    const ConvexFaces faces(*scene);
    for (std::uint32_t t = 0; t < scene->triangles.size(); ++t) EXPECT_FALSE(faces.hides(t, eye, behind, gap)) << t;
  }
}

/// Asks pairs of wedges at places drawn from `draw`.
void ask(const Scene& scene, const EdgeVisibility& visibility, int times, std::mt19937& draw) {
  std::uniform_int_distribution<std::uint32_t> wedge(0, static_cast<std::uint32_t>(scene.wedges.wedges.size() - 1));
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < times; ++i) {
    const std::uint32_t a = wedge(draw), b = wedge(draw);
    if (a != b) visibility.visible(a, share(draw), b, share(draw));
  }
}

// Of every pair that is kept as hidden, 40 ways from anywhere to anywhere are blocked. A tenth, so that there is
// something to be tried (15 % of what is asked are kept; pairs come twice).
TEST(EdgeVisibility, NoRayPassesBetweenWhatIsKnownToBeHidden) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  const Tracer tracer(scene);
  const EdgeVisibility visibility(scene, tracer);
  std::mt19937 draw(7);
  constexpr int asked = 200000;
  ask(scene, visibility, asked, draw);
  std::uniform_real_distribution<double> share(0, 1);
  const double out = 3 * tracer.surface_gap();
  const auto& wedges = scene.wedges.wedges;
  std::size_t hidden = 0;
  for (std::uint32_t a = 0; a < wedges.size(); ++a)
    for (std::uint32_t b = 0; b < wedges.size(); ++b) {
      if (!visibility.known_hidden(a, b)) continue;
      ++hidden;
      for (int i = 0; i < 40; ++i) {
        const Vec3 from = wedges[a].point(share(draw) * wedges[a].length) + out * wedges[a].bisector();
        const Vec3 to = wedges[b].point(share(draw) * wedges[b].length) + out * wedges[b].bisector();
        EXPECT_FALSE(tracer.visible(from, to)) << a << " " << b;
      }
    }
  EXPECT_GT(hidden, asked / 10);
}

// What is known spares rays and changes no answer; without memory for it nothing is known.
TEST(EdgeVisibility, AnswersTheSameWhateverIsKnown) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  const Tracer tracer(scene);
  const EdgeVisibility keeping(scene, tracer), forgetting(scene, tracer, 0);
  std::mt19937 draw(8);
  ask(scene, keeping, 200000, draw);
  EXPECT_GT(keeping.bytes(), 0u);
  std::uniform_int_distribution<std::uint32_t> wedge(0, static_cast<std::uint32_t>(scene.wedges.wedges.size() - 1));
  std::uniform_real_distribution<double> share(0, 1);
  int known = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t a = wedge(draw), b = wedge(draw);
    if (a == b) continue;
    const double from = share(draw), to = share(draw);
    known += keeping.known_hidden(a, b);
    EXPECT_EQ(keeping.visible(a, from, b, to), forgetting.visible(a, from, b, to)) << a << " " << b;
    EXPECT_FALSE(forgetting.known_hidden(a, b));
  }
  EXPECT_GT(known, 0);
  EXPECT_EQ(forgetting.bytes(), 0u);
}

// A second run on the same scene uses what the first one found out, for the same bits and the same counts.
TEST(EdgeVisibility, ASceneThatIsKnownGivesTheSameMap) {
  Diagnostics diagnostics;
  const Scene scene = build_scene(demo_city(), {}, diagnostics);
  const Tracer tracer(scene);
  PlanDescription description = test::plan_for(WaveKind::radio, 3.5e9, {8.5, 21, 27});
  description.depth = 2;
  description.rays = 1.25e5;
  description.coverage = CoverageRequest{};
  description.coverage->cell_size = 20;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  const Result first = simulate(scene, tracer, plan), second = simulate(scene, tracer, plan);
  EXPECT_GT(tracer.edges().bytes(), 0u);
  EXPECT_EQ(second.figures.segments, first.figures.segments);
  ASSERT_EQ(first.coverage->path_gain.size(), second.coverage->path_gain.size());
  for (std::size_t i = 0; i < first.coverage->path_gain.size(); ++i) {
    if (std::isnan(first.coverage->path_gain[i])) continue;
    EXPECT_EQ(first.coverage->path_gain[i], second.coverage->path_gain[i]) << i;
    EXPECT_EQ(first.coverage->standard_error[i], second.coverage->standard_error[i]) << i;
  }
}

}  // namespace
}  // namespace grimaldi
