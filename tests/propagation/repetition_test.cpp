// The same seed gives the same bits on any number of threads; another seed gives others.

#include <bit>
#include <cstdint>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

/// Every number of a result in order, as bits: NaN equals NaN, and −0 is not 0.
class Bits {
 public:
  void add(double value) { words_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void add(std::size_t value) { words_.push_back(value); }
  void add(const Vec3& p) { add(p.x), add(p.y), add(p.z); }
  void add(const std::vector<double>& values) {
    add(values.size());
    for (const double v : values) add(v);
  }
  void add(const std::string& text) {
    add(text.size());
    for (const char c : text) words_.push_back(static_cast<unsigned char>(c));
  }
  void add(const CoverageMap& map) {
    for (const auto* values : {&map.path_gain, &map.standard_error, &map.bias, &map.mechanism_gain, &map.mean_delay,
                               &map.rms_delay_spread, &map.inside_fraction, &map.detection_limit})
      add(*values);
  }
  void add(const ReceiverProfile& profile) {
    add(profile.position);
    for (const auto* values : {&profile.delay, &profile.power, &profile.total, &profile.total_coherent,
                               &profile.total_completed, &profile.mean_delay, &profile.rms_delay_spread})
      add(*values);
    for (const auto& paths : profile.paths) {
      add(paths.size());
      for (const PathStory& path : paths) {
        add(path.delay);
        for (const auto& amplitude : path.amplitude) add(amplitude.real()), add(amplitude.imag());
        add(path.departure_azimuth), add(path.departure_elevation), add(path.arrival_azimuth),
            add(path.arrival_elevation);
        add(path.interactions);
        for (const Vec3& point : path.points) add(point);
      }
    }
  }
  bool operator==(const Bits&) const = default;
  std::size_t size() const { return words_.size(); }

 private:
  std::vector<std::uint64_t> words_;
};

Bits bits_of(const Result& result) {
  Bits bits;
  bits.add(*result.coverage);
  for (const ReceiverProfile& profile : result.profiles) bits.add(profile);
  const RunFigures& f = result.figures;
  for (const double share : {f.flux.launched, f.flux.absorbed, f.flux.escaped, f.flux.cut_by_depth}) bits.add(share);
  for (const std::uint64_t count : {f.rays, f.segments, f.shadow_rays, f.sequences, f.sequence_cell_pairs})
    bits.add(std::size_t{count});
  return bits;
}

/// Everything at once: two transmitters, map and receivers, all mechanisms.
PlanDescription full_plan(WaveKind kind) {
  PlanDescription plan = test::plan_for(kind, kind == WaveKind::radio ? 3.5e9 : 500, demo_city_rooftop);
  plan.frequency.push_back(kind == WaveKind::radio ? 5.8e9 : 1000);
  plan.transmitters.push_back({"mast", demo_city_mast, {0.0}, {AntennaPattern::dipole, Polarisation::vertical, 0, 0}});
  plan.coverage = CoverageRequest{1.5, 20, std::array<double, 4>{-120, -120, 120, 120}, Polarisation::both};
  plan.depth = 2;
  plan.rays = 5e4;
  for (const Vec3& p : {Vec3{20, -10, 1.5}, Vec3{-35, 60, 1.5}, Vec3{0, 125, 3}}) {
    plan.receivers.push_back(test::receiver_at(p));
  }
  return plan;
}

class Repetition : public testing::TestWithParam<WaveKind> {};

TEST_P(Repetition, SameBitsOnAnyNumberOfThreads) {
  const Scene scene = test::built_in("demo-city");
  PlanDescription plan = full_plan(GetParam());
  plan.threads = 1;
  const Bits one = bits_of(test::run(scene, plan));
  EXPECT_GT(one.size(), 10000u);
  for (const unsigned threads : {2u, 3u, 7u}) {
    plan.threads = threads;
    EXPECT_TRUE(bits_of(test::run(scene, plan)) == one) << threads << " threads";
  }
}

TEST_P(Repetition, AnotherSeedIsAnotherRun) {
  const Scene scene = test::built_in("demo-city");
  PlanDescription plan = full_plan(GetParam());
  plan.rays = 2e4;
  const Result first = test::run(scene, plan);
  plan.seed = 2;
  const Result second = test::run(scene, plan);
  EXPECT_FALSE(bits_of(first) == bits_of(second));
  // Another draw of the same thing: the sum over the cells stays within a few per cent (20,000 rays).
  double a = 0, b = 0;
  for (std::size_t i = 0; i < first.coverage->path_gain.size(); ++i) {
    if (std::isnan(first.coverage->path_gain[i])) continue;
    a += first.coverage->path_gain[i], b += second.coverage->path_gain[i];
  }
  EXPECT_NEAR(a / b, 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Engine, Repetition, testing::Values(WaveKind::radio, WaveKind::acoustic),
                         [](const auto& p) { return p.param == WaveKind::radio ? "radio" : "sound"; });

}  // namespace
}  // namespace grimaldi
