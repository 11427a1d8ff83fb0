// What follows from a fault of a scenario, and what does not.

#include <gtest/gtest.h>

#include <cmath>

#include "propagation/plan_file.h"
#include "tests/scenes/temporary_folder.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

class PlanFaults : public testing::Test {
 protected:
  PlanDescription read(const std::string& text, const std::vector<PlanOption>& options = {}) {
    diagnostics_ = {};
    return read_plan(folder_.write("scenario.toml", text), options, diagnostics_);
  }

  std::vector<Diagnostic> errors() const {
    std::vector<Diagnostic> list;
    for (const auto& diagnostic : diagnostics_.all())
      if (diagnostic.severity == Severity::error) list.push_back(diagnostic);
    return list;
  }

  std::string all_text() const {
    std::string text;
    for (const auto& diagnostic : diagnostics_.all()) text += to_string(diagnostic) + "\n";
    return text;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

constexpr const char* minimal = R"([scene]
builtin = "demo-city"
[wave]
frequency = "3.5GHz"
[[transmitter]]
position = [1, 2, 3]
)";

TEST_F(PlanFaults, WhatAFaultSpoilsIsNotJudgedFurther) {
  // A place, a wave and a grid that could not be read are NaN or empty: nothing is said of them against a scene.
  const PlanDescription plan = read(R"([scene]
builtin = "demo-city"
[wave]
kind = "sond"
octaves = { from = "63Hz", to = "8kHz" }
[[transmitter]]
position = [1, 2]
[coverage]
cell_size = "5GHz"
)");
  EXPECT_EQ(errors().size(), 3u) << all_text();
  ASSERT_EQ(plan.transmitters.size(), 1u);
  EXPECT_TRUE(std::isnan(plan.transmitters[0].position.z));
  EXPECT_TRUE(plan.frequency.empty());
  ASSERT_TRUE(plan.coverage);
  EXPECT_TRUE(std::isnan(plan.coverage->cell_size));
}

TEST_F(PlanFaults, TheDepthIsAtMostThatOfASequence) {
  EXPECT_EQ(read(std::string(minimal) + "[propagation]\ndepth = 32\n").depth, 32);
  EXPECT_TRUE(errors().empty()) << all_text();
  read(std::string(minimal) + "[propagation]\ndepth = 33\n");
  ASSERT_EQ(errors().size(), 1u) << all_text();
  EXPECT_EQ(errors()[0].option, "propagation.depth");
  EXPECT_NE(errors()[0].why.find("0 … 32"), std::string::npos) << all_text();
}

TEST_F(PlanFaults, ASceneAloneIsRequestedByItsNameAndOptions) {
  Diagnostics diagnostics;
  const PlanDescription street =
      read_scene_request("street-canyon",
                         {{"--set scene.parameters.width=30m", "scene.parameters.width", "30m"},
                          {"--set material.brick.thickness=0.3", "material.brick.thickness", "0.3"},
                          {"--set scene.material=Wood", "scene.material", "Wood"}},
                         diagnostics);
  EXPECT_EQ(street.builtin, "street-canyon");
  EXPECT_EQ(street.builtin_parameters.at("width"), 30);
  EXPECT_EQ(street.materials.at("brick").thickness, 0.3);
  EXPECT_EQ(street.default_material, "wood");
  const fs::path file = folder_.write("city.ply", "ply\n");
  EXPECT_EQ(read_scene_request(file.string(), {}, diagnostics).scene_file, file);
  EXPECT_TRUE(diagnostics.all().empty());
  read_scene_request("box", {{"--set wave.kind=radio", "wave.kind", "radio"}}, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].option, "--set wave.kind=radio");
  EXPECT_EQ(diagnostics.all()[0].problem, "unknown key");
}

TEST_F(PlanFaults, AKeyOfTooManyPartsIsRefused) {
  std::string key = "scene";
  for (int i = 0; i < 50000; ++i) key += ".a";  // would need a stack frame each
  read(minimal, {{"--set x", key, "1"}});
  ASSERT_EQ(errors().size(), 1u);
  EXPECT_EQ(errors()[0].problem, "not a key");
  EXPECT_NE(errors()[0].why.find("64 parts"), std::string::npos);
}

}  // namespace
}  // namespace grimaldi
