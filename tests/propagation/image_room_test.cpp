// A closed room without loss against the sum over image sources.

#include <cmath>

#include "core/constants.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

constexpr double width = 10, length = 12, height = 8;
const Vec3 source{3.1, 4.7, 2.3};

/// Σ over all images of at most `depth` reflections of spread(distance). Allen and Berkley 1979: along each axis the
/// images lie at 2 i a ± x; |2 i| reflections for +, |2 i − 1| for −. Each image sends one path to each point of a
/// convex room.
template <class Spread>
double image_sum(const Vec3& receiver, int depth, Spread spread) {
  const double size[3] = {width, length, height};
  double sum = 0;
  const auto along = [&](int axis, int n) {  // image number n (|n| reflections) along an axis
    return n % 2 == 0 ? n * size[axis] + source[axis] : (n + 1) * size[axis] - source[axis];
  };
  for (int i = -depth; i <= depth; ++i)
    for (int j = -depth + std::abs(i); j <= depth - std::abs(i); ++j)
      for (int k = -depth + std::abs(i) + std::abs(j); k <= depth - std::abs(i) - std::abs(j); ++k)
        sum += spread(distance({along(0, i), along(1, j), along(2, k)}, receiver));
  return sum;
}

Scene room(const Material& material) {
  MaterialChoice choice;
  choice.overrides = {{"concrete", material}};
  // The outer shell makes the room's inside the outdoors of a solid.
  return test::built_in("box", {{"width", width}, {"length", length}, {"height", height}, {"thick", 0.5}}, choice);
}

struct Room {
  const char* name;
  WaveKind kind;
  double frequency;
  int depth;
};

class ImageRoom : public testing::TestWithParam<Room> {
 protected:
  double gain(double d) const {
    if (GetParam().kind == WaveKind::radio) return std::pow(speed_of_light / GetParam().frequency / (4 * pi * d), 2);
    return std::pow(10, -sound_attenuation(Air{}, GetParam().frequency) * d / 10) / (4 * pi * d * d);
  }
  Scene scene() const {
    Material material = built_in_materials().at(GetParam().kind == WaveKind::radio ? "metal" : "concrete");
    material.absorption = Spectrum{{1000}, {0}};
    // A conductor near enough to perfect: |R|² > 1 − 1e-6 but at grazing.
    if (GetParam().kind == WaveKind::radio)
      material.conductivity = Spectrum{{1e9}, {1e16}}, material.permittivity = Spectrum{{1e9}, {1}};
    return room(material);
  }
  PlanDescription plan() const {
    PlanDescription plan = test::plan_for(GetParam().kind, GetParam().frequency, source);
    plan.depth = GetParam().depth;
    plan.rays = 4e5;
    return plan;
  }
};

// Every receiver, all images to the run's depth. The rays find each sequence that matters; what they miss is counted in
// the 0.1 dB.
TEST_P(ImageRoom, ReceiversHearEveryImage) {
  PlanDescription plan = this->plan();
  for (const Vec3& p : {Vec3{7.3, 9.1, 1.5}, Vec3{1, 1, 6.5}, Vec3{9.5, 0.4, 0.3}, Vec3{5, 6, 4}, Vec3{3.2, 4.6, 7.7}})
    plan.receivers.push_back(test::receiver_at(p));
  const Result result = test::run(scene(), plan);
  for (const ReceiverProfile& profile : result.profiles) {
    const double expected = image_sum(profile.position, plan.depth, [&](double d) { return gain(d); });
    std::printf("%s depth %d: %+.5f dB of the images, %zu paths\n", GetParam().name, plan.depth,
                test::decibel(profile.total[0] / expected), profile.paths[0].size());
    EXPECT_NEAR(test::decibel(profile.total[0] / expected), 0, 0.1) << profile.position.x;
  }
}

// The same for cells: their mean, by a midpoint rule of 40 × 40 points (error below 1e-4 at these distances).
TEST_P(ImageRoom, CellsHoldTheirMean) {
  PlanDescription plan = this->plan();
  plan.coverage =
      CoverageRequest{1.5 + 0.5, 2, std::array<double, 4>{0, 0, width, length}, Polarisation::both};  // z = 1.5
  const Result result = test::run(scene(), plan);
  ASSERT_EQ(result.coverage->path_gain.size(), 30u);
  double worst = 0;
  for (std::size_t cell = 0; cell < 30; ++cell) {
    const double x = double(cell % 5) * 2, y = double(cell / 5) * 2;
    double mean = 0;
    constexpr int n = 40;
    for (int i = 0; i < n * n; ++i)
      mean += image_sum({x + (i % n + 0.5) * 2 / n, y + (i / n + 0.5) * 2 / n, 1.5}, plan.depth,
                        [&](double d) { return gain(d); }) /
              (n * n);
    const double off = test::decibel(result.coverage->path_gain[cell] / mean);
    worst = std::max(worst, std::abs(off));
    EXPECT_NEAR(off, 0, 0.1) << x << " " << y;
  }
  std::printf("%s depth %d: cells within %.5f dB\n", GetParam().name, plan.depth, worst);
}

INSTANTIATE_TEST_SUITE_P(Engine, ImageRoom,
                         testing::Values(Room{"sound_1", WaveKind::acoustic, 1000, 1},
                                         Room{"sound_3", WaveKind::acoustic, 1000, 3},
                                         Room{"sound_6", WaveKind::acoustic, 500, 6},
                                         Room{"radio_3", WaveKind::radio, 3.5e9, 3},
                                         Room{"radio_5", WaveKind::radio, 3.5e9, 5}),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace grimaldi
