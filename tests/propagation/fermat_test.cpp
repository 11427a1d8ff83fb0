// The points of a path: images against mirrors made by hand, edges against minimisation by brute force.

#include "propagation/fermat.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/constants.h"
#include "core/random.h"

namespace grimaldi {
namespace {

constexpr double wavelength = 0.1;

/// Scenes of planes and edges alone: all that a path's points depend on.
class Stage {
 public:
  Interaction mirror(const Vec3& normal, double offset, double half_size = 1e5) {
    const Vec3 n = normalized(normal);
    const Vec3 centre = offset * n, reach{half_size, half_size, half_size};
    scene_.patches.patches.push_back({n, offset, 0, 1, centre - reach, centre + reach});
    return static_cast<Interaction>(scene_.patches.patches.size() - 1);
  }
  /// An edge of a thin screen (every azimuth is free) through `middle`, 1 km to either side.
  Interaction edge(const Vec3& middle, const Vec3& along, double half_length = 1000) {
    Wedge wedge{};
    wedge.direction = normalized(along);
    wedge.start = middle - half_length * wedge.direction;
    wedge.length = 2 * half_length;
    wedge.along0 = perpendicular(wedge.direction);
    wedge.normal0 = cross(wedge.direction, wedge.along0);
    wedge.exterior_angle = 2 * pi;
    wedge.patch0 = wedge.patchn = own_patch_;
    wedge.free_rim = true;
    scene_.wedges.wedges.push_back(wedge);
    return edge_interaction(static_cast<std::uint32_t>(scene_.wedges.wedges.size() - 1));
  }
  /// The path, if there is one.
  bool solve(const Vec3& a, const std::vector<Interaction>& way, const Vec3& b, PathGeometry& path) const {
    return UnfoldedSequence(scene_, a, way).solve(b, wavelength, path);
  }
  const Wedge& wedge(Interaction i) const { return scene_.wedges.wedges[index_of(i)]; }
  const Patch& patch(Interaction i) const { return scene_.patches.patches[i]; }
  Scene& scene() { return scene_; }

 private:
  static constexpr std::uint32_t own_patch_ = 1000000;
  Scene scene_;
};

/// Minimum of a convex function on [low, high] by golden section; good to √ulp of the interval.
double argmin(const std::function<double(double)>& f, double low, double high) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = high - ratio * (high - low), b = low + ratio * (high - low), fa = f(a), fb = f(b);
  for (int i = 0; i < 90; ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa, a = high - ratio * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + ratio * (high - low), fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

/// Reproducible points in a box of ±`half` m.
Vec3 random_point(std::uint64_t index, std::uint32_t which, double half) {
  const auto u = uniform4(11, 99, index, which);
  return half * Vec3{2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1};
}

void expect_point(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LT(distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Fermat, OneMirror) {
  Stage stage;
  const Interaction floor = stage.mirror({0, 0, 1}, 0);
  PathGeometry path;
  ASSERT_TRUE(stage.solve({0, 0, 3}, {floor}, {4, 0, 1}, path));
  ASSERT_EQ(path.count, 3u);
  expect_point(path.points[1], {3, 0, 0}, 1e-14);
  EXPECT_NEAR(path.length, std::sqrt(32.0), 1e-14);
  EXPECT_FALSE(stage.solve({0, 0, 3}, {floor}, {4, 0, -1}, path)) << "the other side of the mirror";
}

TEST(Fermat, CornerOfTwoMirrorsReturns) {
  Stage stage;
  const Interaction floor = stage.mirror({0, 0, 1}, 0), wall = stage.mirror({-1, 0, 0}, -10);  // x = 10
  PathGeometry path;
  ASSERT_TRUE(stage.solve({1, 0, 3}, {floor, wall}, {4, 0, 6}, path));
  // Image in the floor (1, 0, −3), then in the wall (19, 0, −3): the line to (4, 0, 6) has slope −3/5.
  expect_point(path.points[2], {10, 0, 2.4}, 1e-13);
  expect_point(path.points[1], {6, 0, 0}, 1e-13);
  EXPECT_NEAR(path.length, std::hypot(15.0, 9.0), 1e-13);
  EXPECT_FALSE(stage.solve({1, 0, 3}, {wall, floor}, {4, 0, 6}, path))
      << "the other order meets the floor beyond the wall";
}

TEST(Fermat, MirrorEndsAtItsBox) {
  Stage stage;
  const Interaction small = stage.mirror({0, 0, 1}, 0, 2);
  PathGeometry path;
  EXPECT_TRUE(stage.solve({-1, 0, 3}, {small}, {3, 0, 3}, path));
  EXPECT_FALSE(stage.solve({0, 0, 3}, {small}, {4.1, 0, 3}, path));
}

// Reflections of any order obey the law of reflection, and their length is that of the broken line.
TEST(Fermat, ManyMirrorsObeyTheLaw) {
  Stage stage;
  // Floor, two walls and the ceiling of a crooked room.
  const std::vector<Interaction> way{stage.mirror({0, 0, 1}, -20), stage.mirror({1, 0.1, 0.2}, -25),
                                     stage.mirror({0.1, 1, 0.1}, -28), stage.mirror({0, 0.1, -1}, -22)};
  int found = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    PathGeometry path;
    if (!stage.solve(random_point(trial, 0, 15), way, random_point(trial, 1, 15), path)) continue;
    ++found;
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.count; ++i) length += distance(path.points[i], path.points[i + 1]);
    EXPECT_NEAR(length, path.length, 1e-11);
    for (std::size_t i = 0; i < way.size(); ++i) {
      const Vec3 in = normalized(path.points[i + 1] - path.points[i]),
                 out = normalized(path.points[i + 2] - path.points[i + 1]);
      const Vec3 n = stage.patch(way[i]).normal;
      expect_point(out, in - 2 * dot(in, n) * n, 1e-12);
      EXPECT_NEAR(dot(path.points[i + 1], n), stage.patch(way[i]).offset, 1e-11);
    }
  }
  EXPECT_GT(found, 5);
}

TEST(Fermat, OneEdgeIsTheClosedForm) {
  Stage stage;
  const Interaction edge = stage.edge({1, 2, 3}, {0.3, -0.2, 1});
  const Wedge& wedge = stage.wedge(edge);
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    const Vec3 a = random_point(trial, 0, 50), b = random_point(trial, 1, 50);
    PathGeometry path;
    ASSERT_TRUE(stage.solve(a, {edge}, b, path));
    const EdgePassage& passage = path.edges[0];
    const double za = dot(a - wedge.start, wedge.direction), zb = dot(b - wedge.start, wedge.direction);
    const double ra = norm(cross(a - wedge.start, wedge.direction)), rb = norm(cross(b - wedge.start, wedge.direction));
    EXPECT_NEAR(passage.along, (za * rb + zb * ra) / (ra + rb), 1e-10);
    const double brute =
        argmin([&](double t) { return distance(a, wedge.point(t)) + distance(wedge.point(t), b); }, 900, 1100);
    EXPECT_NEAR(passage.along, brute, 1e-4);  // √ulp of golden section: the length is flat there
    EXPECT_NEAR(passage.s_in, distance(a, wedge.point(passage.along)), 1e-10);
    EXPECT_NEAR(passage.s_out, distance(b, wedge.point(passage.along)), 1e-10);
    EXPECT_NEAR(path.length, passage.s_in + passage.s_out, 1e-12);
    EXPECT_NEAR(passage.sin_beta, ra / passage.s_in, 1e-10);
    EXPECT_TRUE(passage.inside);
  }
}

// Mirrors before and after an edge: the same minimum with both ends mirrored by hand.
TEST(Fermat, MirrorEdgeMirror) {
  Stage stage;
  const Interaction floor = stage.mirror({0, 0, 1}, -30), ceiling = stage.mirror({0, 0, -1}, -30);
  const Interaction edge = stage.edge({0, 0, 0}, {0.1, 1, 0.2});
  const Wedge& wedge = stage.wedge(edge);
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    const Vec3 a = random_point(trial, 0, 20), b = random_point(trial, 1, 20);
    const Vec3 a_image{a.x, a.y, -60 - a.z}, b_image{b.x, b.y, 60 - b.z};
    PathGeometry path;
    ASSERT_TRUE(stage.solve(a, {floor, edge, ceiling}, b, path)) << trial;
    const double brute = argmin(
        [&](double t) { return distance(a_image, wedge.point(t)) + distance(wedge.point(t), b_image); }, 900, 1100);
    EXPECT_NEAR(path.edges[0].along, brute, 1e-4);
    EXPECT_NEAR(path.length, distance(a_image, wedge.point(brute)) + distance(wedge.point(brute), b_image), 1e-9);
    EXPECT_NEAR(path.points[1].z, -30, 1e-10);
    EXPECT_NEAR(path.points[3].z, 30, 1e-10);
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.count; ++i) length += distance(path.points[i], path.points[i + 1]);
    EXPECT_NEAR(length, path.length, 1e-10);
  }
}

class TwoEdges : public testing::TestWithParam<std::array<Vec3, 4>> {};  // middle and direction of either

TEST_P(TwoEdges, AgainstBruteForce) {
  const auto [middle1, along1, middle2, along2] = GetParam();
  Stage stage;
  const Interaction first = stage.edge(middle1, along1), second = stage.edge(middle2, along2);
  const Wedge &w1 = stage.wedge(first), &w2 = stage.wedge(second);
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Vec3 a = middle1 + random_point(trial, 0, 30) - Vec3{40, 0, 0},
               b = middle2 + random_point(trial, 1, 30) + Vec3{40, 0, 0};
    PathGeometry path;
    ASSERT_TRUE(stage.solve(a, {first, second}, b, path)) << trial;
    const auto inner = [&](double t) {
      const auto rest = [&](double u) { return distance(w1.point(t), w2.point(u)) + distance(w2.point(u), b); };
      return rest(argmin(rest, 700, 1300));
    };
    const double t = argmin([&](double x) { return distance(a, w1.point(x)) + inner(x); }, 700, 1300);
    const double brute = distance(a, w1.point(t)) + inner(t);
    EXPECT_NEAR(path.length, brute, 1e-9) << trial;
    EXPECT_NEAR(path.edges[0].along, t, 1e-3) << trial;
    // Keller's cones: the angle to the edge is the same on both sides.
    const Vec3 k1 = normalized(w1.point(path.edges[0].along) - a);
    const Vec3 k2 = normalized(w2.point(path.edges[1].along) - w1.point(path.edges[0].along));
    const Vec3 k3 = normalized(b - w2.point(path.edges[1].along));
    // Newton ends at a step below 10 µm; what it leaves is its square over the legs: 1e-11 m, 1e-12 rad.
    EXPECT_NEAR(dot(k1, w1.direction), dot(k2, w1.direction), 1e-10) << trial;
    EXPECT_NEAR(dot(k2, w2.direction), dot(k3, w2.direction), 1e-10) << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fermat, TwoEdges,
    testing::Values(std::array{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{30, 0, 5}, Vec3{0, 1, 0}},            // parallel
                    std::array{Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{30, 0, 5}, Vec3{0, 0, 1}},            // across
                    std::array{Vec3{0, 0, 0}, Vec3{0.5, 1, 0.1}, Vec3{0.7, 0, 0}, Vec3{0, 1, 0.3}},     // close by
                    std::array{Vec3{0, 0, 0}, Vec3{1, 0.2, 0}, Vec3{200, 3, 5}, Vec3{1, -0.2, 0.1}}));  // along the way

// Ends swapped: the same points, lengths and angles in the other order.
TEST(Fermat, Reciprocity) {
  Stage stage;
  const Interaction floor = stage.mirror({0.02, 0, 1}, -30), wall = stage.mirror({0, 1, 0.01}, -60);
  const Interaction first = stage.edge({0, 0, 0}, {0.3, 1, 0.1}), second = stage.edge({40, 0, 10}, {0, 1, -0.4}),
                    third = stage.edge({70, 10, 0}, {0, 0.2, 1});
  const std::vector<std::vector<Interaction>> ways{{first},
                                                   {floor, first},
                                                   {first, second},
                                                   {first, floor, second},
                                                   {wall, first, second, third},
                                                   {first, second, floor, third}};
  int found = 0;
  for (const auto& way : ways) {
    const std::vector<Interaction> back(way.rbegin(), way.rend());
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      const Vec3 a = random_point(trial, 0, 15) - Vec3{40, 0, 0}, b = random_point(trial, 1, 15) + Vec3{110, 0, 0};
      PathGeometry there, home;
      const bool exists = stage.solve(a, way, b, there);
      ASSERT_EQ(exists, stage.solve(b, back, a, home));
      if (!exists) continue;
      ++found;
      EXPECT_NEAR(there.length, home.length, 1e-12 * there.length);
      for (std::size_t i = 0; i < there.count; ++i)
        expect_point(there.points[i], home.points[there.count - 1 - i], 1e-8);
      for (std::size_t i = 0; i < there.edge_count; ++i) {
        const EdgePassage &x = there.edges[i], &y = home.edges[there.edge_count - 1 - i];
        EXPECT_EQ(x.wedge, y.wedge);
        EXPECT_NEAR(x.phi_in, y.phi_out, 1e-9);
        EXPECT_NEAR(x.phi_out, y.phi_in, 1e-9);
        EXPECT_NEAR(x.s_in, y.s_out, 1e-8);
        EXPECT_NEAR(x.sin_beta, y.sin_beta, 1e-9);
        EXPECT_NEAR(x.detour_start, y.detour_start, 1e-8);
      }
    }
  }
  EXPECT_GT(found, 80);
}

// A solver that starts from the last receiver's solution ends where a fresh one does.
TEST(Fermat, WarmStartChangesNothing) {
  Stage stage;
  const std::vector<Interaction> way{stage.edge({0, 0, 0}, {0.3, 1, 0.1}), stage.edge({40, 0, 10}, {0, 1, -0.4})};
  UnfoldedSequence warm(stage.scene(), {-40, 3, 5}, way);
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    const Vec3 receiver = random_point(trial, 1, 30) + Vec3{100, 0, 0};
    PathGeometry a, b;
    ASSERT_TRUE(warm.solve(receiver, wavelength, a));
    ASSERT_TRUE(stage.solve({-40, 3, 5}, way, receiver, b));
    EXPECT_NEAR(a.length, b.length, 1e-12 * b.length);
    expect_point(a.points[2], b.points[2], 1e-9);  // what the header promises
  }
}

// Past the end of an edge its wave is kept while v_V < 3 and seen from the end itself.
// Two rims of a roof meet in a corner; the path passes both just beside it. Newton from one end alone falls into the
// corner, where the length has a kink, and finds nothing.
TEST(Fermat, BesideTheCornerOfTwoEdges) {
  Stage stage;
  const Interaction first = stage.edge({-53, 87.5, 17}, {0, 1, 0}, 9.5);
  const Interaction second = stage.edge({-77, 97, 17}, {-1, 0, 0}, 24);
  const Vec3 a{-41, 8, 26}, b{-60, 60, 1.5};
  PathGeometry there, back;
  ASSERT_TRUE(stage.solve(a, {first, second}, b, there));
  ASSERT_TRUE(stage.solve(b, {second, first}, a, back));
  EXPECT_NEAR(there.length, back.length, 1e-9);
  const auto over = [&](double t) {
    const Vec3 point = stage.wedge(first).point(t);
    const auto rest = [&](double u) {
      const Vec3 next = stage.wedge(second).point(u);
      return distance(point, next) + distance(next, b);
    };
    return distance(a, point) + rest(argmin(rest, 0, 48));
  };
  EXPECT_NEAR(there.length, over(argmin(over, 0, 19)), 1e-9);
}

TEST(Fermat, BeyondTheEnd) {
  Stage stage;
  const Interaction edge = stage.edge({0, 0, 0}, {0, 1, 0}, 5);
  PathGeometry path;
  // Both ends 10 m off in plan, diffraction point at y: detour over the end (y − 5)²/10, v_V = 2√(δ/λ): 3 at y − 5
  // = 1.5.
  ASSERT_TRUE(stage.solve({-10, 6.4, 0}, {edge}, {10, 6.4, 0.1}, path));
  EXPECT_FALSE(path.edges[0].inside);
  expect_point(path.points[1], {0, 5, 0}, 1e-12);
  EXPECT_NEAR(path.edges[0].detour_end, 2 * std::hypot(10, 1.4) - 20, 1e-4);
  EXPECT_FALSE(stage.solve({-10, 6.6, 0}, {edge}, {10, 6.6, 0.1}, path));
}

TEST(Fermat, ImpossibleSequences) {
  Stage stage;
  const Interaction floor = stage.mirror({0, 0, 1}, 0);
  const Interaction edge = stage.edge({0, 0, 10}, {0, 1, 0});
  const auto possible = [&](const std::vector<Interaction>& way) {
    return UnfoldedSequence(stage.scene(), {-40, 3, 5}, way).possible();
  };
  EXPECT_TRUE(possible({floor, edge}));
  EXPECT_FALSE(possible({floor, floor}));
  EXPECT_FALSE(possible({edge, edge}));
  stage.scene().wedges.wedges[0].patch0 = floor;
  EXPECT_FALSE(possible({floor, edge})) << "an edge next to a face of its own";
  EXPECT_FALSE(possible({edge, floor}));
}

}  // namespace
}  // namespace grimaldi
