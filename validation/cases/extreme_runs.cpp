// The engine at the ends of its domain.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"
#include "validation/knife_edge.h"

namespace grimaldi {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

SceneDescription shifted(SceneDescription scene, const Vec3& shift) {
  for (MeshDescription& mesh : scene.meshes)
    for (Vec3& vertex : mesh.vertices) vertex += shift;
  return scene;
}

/// Keeps the largest error; levels that are not finite are infinitely wrong.
void worst(Outcome& outcome, double error, const std::string& where) {
  if (!std::isfinite(error)) error = infinite;
  if (error > outcome.error || outcome.note.empty())
    outcome.error = std::max(error, outcome.error), outcome.note = "largest at " + where;
}

struct Carrier {
  WaveKind kind;
  double frequency;
};
constexpr Carrier carriers[] = {{WaveKind::acoustic, 20}, {WaveKind::acoustic, 500}, {WaveKind::acoustic, 20e3},
                                {WaveKind::radio, 30e6},  {WaveKind::radio, 1e9},    {WaveKind::radio, 60e9},
                                {WaveKind::radio, 300e9}};

/// Level of the direct wave from 1 mm to 100 km, 20 Hz to 300 GHz, far beside a small plate.
Outcome free_space() {
  const Scene scene = scene_of(scene_description("half-plane", {{"length", 1}, {"depth", 1}}));
  Outcome outcome;
  for (const Carrier& carrier : carriers) {
    PlanDescription plan = point_to_point(carrier.kind, carrier.frequency, {-50, 0, 30}, 1e3);
    plan.reflection = plan.diffraction = false;
    std::vector<double> lengths = {1e-3, 1e-2, 1, 1e2, 1e4, 1e5};
    for (const double length : lengths) add_receiver(plan, {-50, length, 30});
    const Result result = run_engine(scene, plan);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const double expected = free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position);
      // Sound of 20 kHz is gone after 10 km: nothing is the right answer below 1e-300.
      if (expected < 1e-300) {
        worst(outcome, result.profiles[i].total[0] < 1e-300 ? 0 : infinite, "what should be nothing");
        continue;
      }
      worst(outcome, std::abs(decibel(result.profiles[i].total[0] / expected)),
            fmt::format("{:g} m, {:g} Hz", lengths[i], carrier.frequency));
    }
  }
  return outcome;
}

/// Levels behind a black half-plane at a place of the world.
void half_plane(Outcome& outcome, const Carrier& carrier, const Vec3& shift, double before, double behind) {
  const Scene scene = scene_of(shifted(scene_description("half-plane"), shift));
  PlanDescription plan = point_to_point(carrier.kind, carrier.frequency, Vec3{-before, 0, 0} + shift, 2e4);
  plan.reflection = false;
  std::vector<double> levels;
  for (const double v : {-1.0, 0.05, 0.3, 1.0, 2.0}) {
    const double length = before * behind / (before + behind);
    const double bend = std::copysign(v * v, v) / 2 * wavelength_of(plan) / length;
    const double z = -std::copysign(behind * std::sqrt(std::abs(bend)), v);
    if (std::abs(z) > 0.3 * behind) continue;  // no longer paraxial: the truth below would not be one
    const double detour = before + std::hypot(behind, z) - std::hypot(before + behind, z);
    levels.push_back(std::copysign(2 * std::sqrt(detour / wavelength_of(plan)), v));
    add_receiver(plan, Vec3{behind, 0, z} + shift);
  }
  if (levels.empty()) return;
  const Result result = run_engine(scene, plan);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double expected = decibel(std::norm(exact_knife_edge(levels[i])));
    const double level = decibel(result.profiles[i].total[0] /
                                 free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position));
    worst(outcome, std::abs(level - expected),
          fmt::format("v = {:.2f}, {:g} Hz, {:g} m and {:g} m, moved by {:g} m", levels[i], carrier.frequency, before,
                      behind, norm(shift)));
  }
}

Outcome moved_far(double distance) {
  Outcome outcome;
  for (const Vec3& shift : {Vec3{distance, 0, 0}, Vec3{0, -distance, 0}, Vec3{distance, distance, 0}})
    half_plane(outcome, {WaveKind::radio, 1e9}, shift, 100, 100);
  return outcome;
}

Outcome all_carriers() {
  Outcome outcome;
  for (const Carrier& carrier : carriers) half_plane(outcome, carrier, {}, 100, 100);
  return outcome;
}

Outcome long_links() {
  Outcome outcome;
  for (const double leg : {10.0, 1e3, 1e4, 1e5}) half_plane(outcome, {WaveKind::radio, 1e9}, {}, leg, 100);
  return outcome;
}

/// Millimetres from the edge of a small plate, 300 GHz: the level, or a refusal.
Outcome close_to_an_edge() {
  Outcome outcome;
  const Scene scene = scene_of(scene_description("half-plane", {{"length", 1}, {"depth", 1}}));
  for (const double leg : {1e-3, 1e-2, 0.1}) {
    PlanDescription plan = point_to_point(WaveKind::radio, 300e9, {-leg, 0, 0}, 2e4);
    plan.reflection = false;
    add_receiver(plan, {leg, 0, -0.05 * leg});
    const double detour = leg + leg * std::hypot(1, 0.05) - leg * std::hypot(2, 0.05);
    const double expected = decibel(std::norm(exact_knife_edge(2 * std::sqrt(detour / wavelength_of(plan)))));
    const Result result = run_engine(scene, plan);
    const double level = decibel(result.profiles[0].total[0] /
                                 free_gain(plan, plan.transmitters[0].position, plan.receivers[0].position));
    worst(outcome, std::abs(level - expected), fmt::format("{:g} m before and behind", leg));
  }
  return outcome;
}

/// Receivers on the shadow boundary, and within some micrometres of it, of a half-plane that is tilted about its edge
/// and moved: the verdict of the ray that grazes the edge and the sign of the edge's wave must be one.
Outcome on_the_boundary(double tilt, const Vec3& shift, const std::vector<double>& offsets) {
  const auto placed = [&](double x, double z) {
    return Vec3{std::cos(tilt) * x - std::sin(tilt) * z, 0, std::sin(tilt) * x + std::cos(tilt) * z} + shift;
  };
  SceneDescription description = scene_description("half-plane");
  for (MeshDescription& mesh : description.meshes)
    for (Vec3& vertex : mesh.vertices) {
      const double y = vertex.y;
      vertex = placed(vertex.x, vertex.z);
      vertex.y += y;
    }
  const Scene scene = scene_of(description);
  Outcome outcome;
  for (const Carrier& carrier : carriers) {
    if (carrier.frequency > 1e9 && offsets.size() > 1) continue;  // 10 µm are no longer nothing
    PlanDescription plan = point_to_point(carrier.kind, carrier.frequency, placed(-100, 0), 2e4);
    plan.reflection = false;
    for (const double x : {1.0, 10.0, 100.0, 1000.0})
      for (const double offset : offsets) add_receiver(plan, placed(x, offset));
    const Result result = run_engine(scene, plan);
    for (std::size_t i = 0; i < plan.receivers.size(); ++i) {
      const double level = decibel(result.profiles[i].total[0] /
                                   free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position));
      worst(outcome, std::abs(level - decibel(0.25)),
            fmt::format("{:.0f} m behind, {:g} m off, {:g} Hz", distance(plan.receivers[i].position, shift),
                        offsets[i % offsets.size()], carrier.frequency));
    }
  }
  return outcome;
}

/// The screen cut into slivers of 1 : 1e4 beside its edge.
SceneDescription slivers(SceneDescription scene) {
  MeshDescription needles;
  needles.name = "needles", needles.material = scene.meshes.front().material;
  // A strip of height 0.02 m below the edge, 200 m long pieces; the rest of the screen hangs below it.
  const double top = 0, low = -0.02, deep = -2000, half = 2000;
  for (int i = 0; i <= 20; ++i) {
    const double y = -half + 200 * i;
    for (const double z : {top, low, deep}) needles.vertices.push_back({0, y, z});
  }
  for (std::uint32_t i = 0; i < 20; ++i)
    for (std::uint32_t row = 0; row < 2; ++row) {
      const std::uint32_t a = 3 * i + row, b = a + 3;
      needles.triangles.push_back({a, a + 1, b});
      needles.triangles.push_back({b, a + 1, b + 1});
      if (row == 1) needles.artificial_edges.push_back({a + 1, b + 1});
    }
  for (std::uint32_t row = 0; row < 2; ++row) {
    needles.artificial_edges.push_back({row, row + 1});
    needles.artificial_edges.push_back({60 + row, 61 + row});
  }
  scene.meshes = {needles};
  return scene;
}

Outcome needle_triangles() {
  Outcome outcome;
  std::vector<double> levels[2];
  for (const bool cut : {false, true}) {
    const SceneDescription whole = scene_description("half-plane");
    const Scene scene = scene_of(cut ? slivers(whole) : whole);
    PlanDescription plan = point_to_point(WaveKind::radio, 1e9, {-100, 0, 0}, 2e4);
    plan.reflection = false;
    for (const double z : {3.0, 0.5, -0.5, -3.0, -10.0}) add_receiver(plan, {100, 0, z});
    const Result result = run_engine(scene, plan);
    for (const ReceiverProfile& profile : result.profiles) levels[cut ? 1 : 0].push_back(decibel(profile.total[0]));
  }
  for (std::size_t i = 0; i < levels[0].size(); ++i)
    worst(outcome, std::abs(levels[0][i] - levels[1][i]), fmt::format("receiver {}", i));
  return outcome;
}

/// Transmitters and receivers in places that physics does not allow or that are nowhere in particular: a number or a
/// refusal, never NaN.
Outcome awkward_places() {
  const Scene scene = scene_of(scene_description("street-canyon"));
  const std::pair<const char*, Vec3> places[] = {{"at the transmitter", {0, 0, 10}},
                                                 {"on the ground", {5, 0, 0}},
                                                 {"below the ground", {5, 0, -3}},
                                                 {"on a wall", {10, 10, 5}},
                                                 {"on the edge of a roof", {10, 10, 20}},
                                                 {"inside a house", {10, 18, 5}},
                                                 {"a thousand kilometres away", {1e6, 0, 10}},
                                                 {"a micrometre away", {1e-6, 0, 10}}};
  Outcome outcome;
  int refused = 0, answered = 0;
  for (const auto& [what, place] : places) {
    try {
      PlanDescription plan = point_to_point(WaveKind::radio, 1e9, {0, 0, 10}, 1e4);
      add_receiver(plan, place);
      const Result result = run_engine(scene, plan);
      const double gain = result.profiles[0].total[0];
      worst(outcome, std::isfinite(gain) && gain >= 0 ? 0 : infinite, what);
      ++answered;
    } catch (const InputErrors&) {
      ++refused;
    }
  }
  if (outcome.error == 0)
    outcome.note = fmt::format("{} answered with finite gains, {} refused with a message", answered, refused);
  return outcome;
}

}  // namespace

Cases extreme_engine_cases() {
  const char* fresnel = "Fresnel integral by quadrature on a rotated ray";
  const char* half = "half the field; the ends of the 4 km edge add 0.14 dB at 20 Hz";
  const char* quantity = "engine behind a black half-plane: largest |error of level|, v from -1 to 2";
  return {
      {"extremes/engine/free-space",
       "engine, direct wave from 1 mm to 100 km, 20 Hz to 300 GHz: largest |error of level|", "closed form", "dB", 1e-9,
       "an ulp of the coordinates at 1 mm", 0, free_space},
      {"extremes/engine/moved-5e5", quantity, fresnel, "dB", 0.02, "the law's own 0.01 dB; doubles keep 6e-11 m", 0,
       [] { return moved_far(5e5); }},
      {"extremes/engine/moved-5e6", quantity, fresnel, "dB", 0.02, "the law's own 0.01 dB; doubles keep 1e-9 m", 0,
       [] { return moved_far(5e6); }},
      {"extremes/engine/carriers",
       "engine behind a black half-plane, 20 Hz to 300 GHz, 100 m on either side: largest |error of level|", fresnel,
       "dB", 0.2, "bends of up to 17 degrees: paraxial truth, 0.1 dB", 0, all_carriers},
      {"extremes/engine/long-links",
       "engine behind a black half-plane, source 10 m to 100 km before the edge: largest |error of level|", fresnel,
       "dB", 0.1, "the law's own angle; ends of the 4 km edge", 0, long_links},
      {"extremes/engine/close",
       "engine behind a black half-plane, 1 mm to 0.1 m on either side, 300 GHz: largest |error of level|", fresnel,
       "dB", 0.1, "the law's own angle; a ray leaves an edge at 0.1 mm", 0, close_to_an_edge},
      {"extremes/engine/boundary", "engine exactly on the shadow boundary, 20 Hz to 300 GHz: largest |error of level|",
       "-6.02 dB", "dB", 0.2, half, 0, [] { return on_the_boundary(0, {}, {0}); }},
      {"extremes/engine/beside-the-boundary",
       "engine 1e-9 to 1e-5 m beside the shadow boundary: largest |error of level|", "-6.02 dB", "dB", 0.2, half, 0,
       [] {
         return on_the_boundary(0, {}, {-1e-5, -1e-7, -1e-9, 1e-9, 1e-7, 1e-5});
       }},
      {"extremes/engine/boundary-tilted",
       "engine on and beside the shadow boundary, scene tilted by 17 degrees and moved: largest |error of level|",
       "-6.02 dB", "dB", 0.2, half, 0,
       [] {
         return on_the_boundary(0.3, {1234.567, -89.01, 2.345}, {-1e-5, -1e-7, -1e-9, 0, 1e-9, 1e-7, 1e-5});
       }},
      {"extremes/engine/needles",
       "engine, half-plane with slivers of 0.02 m by 200 m at its edge: largest difference of level",
       "the half-plane as it was", "dB", 0.05, "same geometry", 0, needle_triangles},
      {"extremes/engine/awkward-places",
       "receivers at the source, on faces and edges, in solids, far out: gains not finite",
       "a finite gain or a refusal", "1", 0, "no NaN, no infinity", 0, awkward_places},
  };
}

}  // namespace grimaldi
