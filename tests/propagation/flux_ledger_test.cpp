// What is launched is absorbed, escapes or is cut by the depth.

#include <cmath>

#include "scenes/demo_city.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

struct Case {
  const char* name;
  const char* scene;
  WaveKind kind;
  double frequency;
  Vec3 transmitter;
  int depth;
  bool reflection = true;
};

class FluxLedgerOf : public testing::TestWithParam<Case> {};

// Each beam's power is split at each face; sums of 1e5 terms round to 1e-16 √1e5.
TEST_P(FluxLedgerOf, Closes) {
  const Case& c = GetParam();
  const Scene scene = test::built_in(
      c.scene, std::string(c.scene) == "box" ? CanonicalParameters{{"thick", 0.5}} : CanonicalParameters{});
  PlanDescription plan = test::plan_for(c.kind, c.frequency, c.transmitter);
  plan.depth = c.depth;
  plan.reflection = c.reflection;
  if (c.depth > 3) plan.diffraction = false;  // beams from edges carry no flux; deep, they are many
  plan.rays = 1e5;
  plan.receivers = {test::receiver_at(c.transmitter + Vec3{1, 1, 0.5})};
  const FluxLedger flux = test::run(scene, plan).figures.flux;
  const double rest = flux.launched - flux.absorbed - flux.escaped - flux.cut_by_depth;
  std::printf("%s: absorbed %.4f escaped %.4f cut %.4f, open %.1e\n", c.name, flux.absorbed, flux.escaped,
              flux.cut_by_depth, rest);
  EXPECT_NEAR(flux.launched, 1, 1e-12);
  EXPECT_NEAR(rest, 0, 1e-12);
  EXPECT_GE(flux.absorbed, 0);
  EXPECT_GE(flux.escaped, 0);
  EXPECT_GE(flux.cut_by_depth, 0);
  if (std::string(c.scene) == "box") {
    EXPECT_EQ(flux.escaped, 0) << "a closed room";
  } else {
    // An open scene loses the upper half of the sphere.
    EXPECT_GT(flux.escaped, 0.3);
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, FluxLedgerOf,
                         testing::Values(Case{"demo_city_0", "demo-city", WaveKind::radio, 3.5e9, demo_city_rooftop, 1},
                                         Case{"demo_city_3", "demo-city", WaveKind::radio, 3.5e9, demo_city_rooftop, 3},
                                         Case{"demo_city_8", "demo-city", WaveKind::radio, 3.5e9, demo_city_mast, 8},
                                         Case{"demo_city_edges_alone", "demo-city", WaveKind::radio, 3.5e9,
                                              demo_city_mast, 2, false},
                                         Case{"canyon_sound", "street-canyon", WaveKind::acoustic, 500, {0, 0, 5}, 4},
                                         Case{"half_plane", "half-plane", WaveKind::radio, 1e9, {-100, 0, 1}, 3},
                                         Case{"box", "box", WaveKind::acoustic, 1000, {3, 4, 2}, 20},
                                         Case{"box_radio", "box", WaveKind::radio, 1e9, {3, 4, 2}, 5}),
                         [](const auto& p) { return p.param.name; });

// Without loss nothing is absorbed: in a closed room all is cut by the depth.
TEST(FluxLedger, LosslessRoomKeepsAll) {
  Material material = built_in_materials().at("concrete");
  material.absorption = Spectrum{{1000}, {0}};
  MaterialChoice choice;
  choice.overrides = {{"concrete", material}};
  PlanDescription plan = test::plan_for(WaveKind::acoustic, 1000, {3, 4, 2});
  plan.rays = 2e4;
  plan.depth = 10;
  const FluxLedger flux = test::run(test::built_in("box", {{"thick", 0.5}}, choice), plan).figures.flux;
  EXPECT_NEAR(flux.cut_by_depth, 1, 1e-12);
  EXPECT_NEAR(flux.absorbed, 0, 1e-12);
}

}  // namespace
}  // namespace grimaldi
