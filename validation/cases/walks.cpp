// Walks over shadow boundaries, reflection boundaries, ends of edges and corners: the level may not jump.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "scenes/shapes.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

/// Which wave meets which faces.
struct Wave {
  const char* name;
  WaveKind kind;
  double frequency;  ///< Hz
  const char* material;
  Polarisation polarisation;
};
constexpr Wave waves[] = {{"metal-V", WaveKind::radio, 1e9, "metal", Polarisation::vertical},
                          {"metal-H", WaveKind::radio, 1e9, "metal", Polarisation::horizontal},
                          {"concrete-V", WaveKind::radio, 1e9, "concrete", Polarisation::vertical},
                          {"rigid", WaveKind::acoustic, 500, "metal", Polarisation::vertical}};

/// A way of the receiver: a straight line, or an arc about the z axis.
struct Walk {
  const char* name;
  const char* words;
  SceneDescription (*scene)();
  Vec3 transmitter;
  int depth;
  Vec3 from, to;
  double tolerance;    ///< dB
  const char* reason;  ///< for it
  double radius = 0;   ///< of an arc, m; then x of `from` and `to` are azimuths in degrees and z the height
  Vec3 at(double share) const {
    const Vec3 here = from + share * (to - from);
    if (radius == 0) return here;
    return {radius * std::cos(here.x * pi / 180), radius * std::sin(here.x * pi / 180), here.z};
  }
};

SceneDescription corner_of_a_house() { return upright_wedge(1.5, 1000, 1000); }
SceneDescription plate() { return upright_plate(6, 4); }
SceneDescription house() {
  SceneDescription scene;
  scene.name = "house";
  scene.meshes.push_back(ground_sheet({-60, -60}, {60, 60}, "metal"));
  append_building({"house", {{-6, -5}, {6, -5}, {6, 5}, {-6, 5}}, {}, 9, 0, "metal", "metal"}, scene);
  return scene;
}
SceneDescription flat_roof() { return deep_blocks({{0, 10, 0}}, 500, 500); }
SceneDescription two_roofs() { return deep_blocks({{0, 10, 0}, {30, 10, 1}}, 500, 500); }

constexpr const char* goal = "the goal of a level without steps";
/// Levels further below free space count as this: what cancels so far has no level to be continuous, dB.
constexpr double lowest = -60;

const Walk walks[] = {
    {"corner-one-face",
     "around a right-angled corner, one face lit",
     corner_of_a_house,
     {40 * std::cos(0.9), 40 * std::sin(0.9), 0},
     1,
     {1, 0, 0},
     {269, 0, 0},
     0.5,
     goal,
     15},
    {"corner-two-faces",
     "around a right-angled corner, both faces lit",
     corner_of_a_house,
     {40 * std::cos(2.2), 40 * std::sin(2.2), 0},
     1,
     {1, 0, 0},
     {269, 0, 0},
     0.5,
     goal,
     15},
    {"corner-oblique",
     "around a right-angled corner, rays oblique to it",
     corner_of_a_house,
     {40 * std::cos(0.9), 40 * std::sin(0.9), 30},
     1,
     {1, 0, 0},
     {269, 0, -20},
     0.5,
     goal,
     15},
    {"behind-a-plate",
     "behind a plate, past both of its upright edges",
     plate,
     {-30, 1, 0.4},
     1,
     {20, -12, 0.3},
     {20, 12, 0.3},
     0.5,
     goal},
    {"before-a-plate",
     "before a plate, over the boundaries of its reflection",
     plate,
     {-30, 4, 1},
     1,
     {-20, -16, 0.3},
     {-20, 6, 0.3},
     0.5,
     goal},
    {"reflected-corner",
     "before a plate, over the reflection of one of its corners",
     plate,
     {-30, 4, 1},
     1,
     {-20, -14, -5},
     {-20, -2, 6},
     0.5,
     goal},
    {"past-the-end",
     "behind a plate above the shadow of its upper edge, past the end of that edge",
     plate,
     {-30, 1, 0.4},
     1,
     {3, 2.4, 3.1},
     {3, 4.2, 3.1},
     0.5,
     goal},
    {"over-a-corner",
     "behind a plate, over the shadow of one of its corners",
     plate,
     {-30, 1, 0.4},
     1,
     {3, 4.3, 1.7},
     {3, 2.8, 3.4},
     0.5,
     goal},
    {"around-a-house",
     "around a house on ground at street level, a mast over the roofs before it",
     house,
     {-40, 3, 14},
     4,
     {150, 0, 1.5},
     {-30, 0, 1.5},
     0.5,
     goal,
     13},
    {"over-a-roof", "down behind a flat roof", flat_roof, {-40, 0, 2}, 2, {25, 0, 6}, {25, 0, -15}, 0.5, goal},
    {"over-two-roofs", "down behind two flat roofs", two_roofs, {-40, 0, 2}, 4, {55, 0, 8}, {55, 0, -15}, 0.5, goal},
};

/// Levels of the engine at shares of the walk, dB.
std::vector<double> levels(const Scene& scene, const Walk& walk, const Wave& wave, DiffractionModel model,
                           const std::vector<double>& shares) {
  PlanDescription plan = point_to_point(wave.kind, wave.frequency, walk.transmitter, 2e4);
  plan.depth = walk.depth;
  plan.diffraction_model = model;
  plan.transmitters[0].antenna.polarisation = wave.polarisation;
  for (const double share : shares) add_receiver(plan, walk.at(share));
  std::vector<double> list;
  for (const ReceiverProfile& profile : run_engine(scene, plan).profiles)
    list.push_back(
        std::max(decibel(profile.total[0]), decibel(free_gain(plan, walk.transmitter, profile.position)) + lowest));
  return list;
}

/// The largest step: first between points of the whole walk, then between points a tenth as far apart wherever it was
/// largest, and so on. A slope becomes a tenth at each turn, a jump stays.
Outcome largest_jump(const Walk& walk, const Wave& wave, DiffractionModel model) {
  MaterialChoice faces = perfect_faces();
  if (std::string(wave.material) != "metal") faces = {}, faces.replace = {{"*", wave.material}};
  const Scene scene = scene_of(walk.scene(), faces);
  constexpr int points = 300, parts = 10, places = 8, turns = 2;
  struct Step {
    double from, to, size;
  };
  std::vector<Step> steps;
  const auto add_steps = [&](const std::vector<double>& shares, std::size_t pieces) {
    const std::vector<double> level = levels(scene, walk, wave, model, shares);
    for (std::size_t i = 1; i < shares.size(); ++i)
      if (i % pieces != 0 || pieces == shares.size())
        steps.push_back({shares[i - 1], shares[i], std::abs(level[i] - level[i - 1])});
  };
  std::vector<double> shares;
  for (int i = 0; i < points; ++i) shares.push_back((i + 0.37) / points);
  add_steps(shares, shares.size());
  for (int turn = 0; turn < turns; ++turn) {
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.size > b.size; });
    steps.resize(std::min<std::size_t>(steps.size(), places));
    shares.clear();
    for (const Step& step : steps)
      for (int i = 0; i <= parts; ++i) shares.push_back(step.from + (step.to - step.from) * i / parts);
    steps.clear();
    add_steps(shares, parts + 1);
  }
  const Step worst = *std::max_element(steps.begin(), steps.end(), [](auto& a, auto& b) { return a.size < b.size; });
  const Vec3 place = walk.at(worst.from);
  const auto beside = levels(scene, walk, wave, model, {worst.from, worst.to});
  return {worst.size,
          fmt::format("at ({:.3f}, {:.3f}, {:.3f}), {:.2g} of the walk: {:.2f} and {:.2f} dB within {:.1e} m", place.x,
                      place.y, place.z, worst.from, beside[0], beside[1], distance(place, walk.at(worst.to))),
          {}};
}

}  // namespace

Cases walk_cases() {
  Cases cases;
  for (const Walk& walk : walks)
    for (const Wave& wave : waves)
      for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd})
        cases.push_back(
            {fmt::format("walks/{}/{}/{}", walk.name, wave.name, model == DiffractionModel::utd ? "utd" : "fsd"),
             fmt::format("engine, {}: largest step of the level where a slope would be gone", walk.words), "continuity",
             "dB", walk.tolerance, walk.reason, 0, [walk, wave, model] { return largest_jump(walk, wave, model); }});
  return cases;
}

}  // namespace grimaldi
