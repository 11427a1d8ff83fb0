// Transmitter and receiver exchanged: the level may not change.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/demo_city.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

struct Place {
  const char* name;
  const char* words;
  const char* scene;
  Vec3 one;
  std::vector<Vec3> others;
  int depth;    ///< interactions
  double rays;  ///< until another run finds the same paths
  double tolerance;
  const char* reason;
  bool slow = false;  ///< radio alone
};

constexpr const char* goal = "the goal: the laws are reciprocal, and both ways find the paths that count";

const std::vector<Place>& places() {
  const Vec3 canyon{-31, 3, 9};
  static const std::vector<Place> list = {
      {"canyon/depth1",
       "in a street canyon and its side streets, paths of one interaction",
       "street-canyon",
       canyon,
       {{-5, -4, 1.5}, {22, 6, 1.5}, {71, -3, 1.5}, {75, 17, 1.5}, {0, 22, 1.5}, {-73, -21, 1.5}, {75, 40, 1.5}},
       1,
       4e4,
       0.05,
       goal},
      {"canyon/depth2",
       "in a street canyon and its side streets, paths of two interactions",
       "street-canyon",
       canyon,
       {{71, -3, 1.5}, {0, 22, 1.5}},
       2,
       1e5,
       0.05,
       goal},
      {"city/depth1",
       "between some houses of the demo city, paths of one interaction",
       "demo-city",
       demo_city_rooftop,
       {{20, 20, 1.5}, {60, 40, 1.5}, {0, 80, 1.5}, {-60, 60, 1.5}, {80, 60, 1.5}, {-40, 40, 1.5}},
       1,
       1e5,
       0.05,
       goal},
      {"city/depth2",
       "between some houses of the demo city, paths of two interactions",
       "demo-city",
       demo_city_rooftop,
       {{20, 20, 1.5}, {0, 80, 1.5}, {-60, 60, 1.5}},
       2,
       1e5,
       0.05,
       goal,
       true},
  };
  return list;
}

/// Levels from `one` to all others and back, vertical polarisation at both ends.
Outcome exchanged(const Place& place, WaveKind kind, DiffractionModel model) {
  const Scene scene = scene_of(scene_description(place.scene));
  PlanDescription there = point_to_point(kind, kind == WaveKind::radio ? 1e9 : 500, place.one, place.rays);
  there.depth = place.depth;
  there.diffraction_model = model;
  PlanDescription back = there;
  back.transmitters.resize(place.others.size(), there.transmitters[0]);
  for (std::size_t i = 0; i < place.others.size(); ++i) {
    there.receivers.push_back({fmt::format("r{}", i), place.others[i], Polarisation::vertical});
    back.transmitters[i].name = fmt::format("t{}", i);
    back.transmitters[i].position = place.others[i];
  }
  back.receivers.push_back({"r", place.one, Polarisation::vertical});
  const Result first = run_engine(scene, there), second = run_engine(scene, back);
  Outcome outcome;
  std::vector<double> all;
  for (std::size_t i = 0; i < place.others.size(); ++i) {
    const double a = decibel(first.profiles[i].total[0]), b = decibel(second.profiles[0].total[i]);
    if (!std::isfinite(a) && !std::isfinite(b)) continue;
    all.push_back(std::abs(a - b));
    if (!(all.back() <= outcome.error) || all.size() == 1) {
      outcome.error = all.back();
      const Vec3& p = place.others[i];
      outcome.note = fmt::format("largest at ({:g}, {:g}, {:g}): {:.3f} dB there, {:.3f} dB back, {} and {} paths", p.x,
                                 p.y, p.z, a, b, first.profiles[i].paths[0].size(), second.profiles[0].paths[i].size());
    }
  }
  std::sort(all.begin(), all.end());
  outcome.note += fmt::format("; median {:.3f} dB of {}", all[all.size() / 2], all.size());
  return outcome;
}

}  // namespace

Cases reciprocity_cases() {
  Cases cases;
  for (const Place& place : places())
    for (const WaveKind kind : {WaveKind::radio, WaveKind::acoustic})
      for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd}) {
        if (place.slow && kind == WaveKind::acoustic) continue;
        cases.push_back({fmt::format("reciprocity/{}/{}/{}", place.name, kind == WaveKind::radio ? "radio" : "sound",
                                     model == DiffractionModel::utd ? "utd" : "fsd"),
                         fmt::format("engine {}, ends exchanged: largest difference of level", place.words),
                         "the way there", "dB", place.tolerance, place.reason, 0,
                         [&place, kind, model] { return exchanged(place, kind, model); }});
      }
  return cases;
}

}  // namespace grimaldi
