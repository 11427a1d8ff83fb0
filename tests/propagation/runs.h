#pragma once
// What the engine's tests share: scenes by name, plans by a few numbers, one run.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "propagation/simulation.h"
#include "scenes/canonical.h"
#include "scenes/scene_file.h"

namespace grimaldi::test {

inline Scene built_in(const std::string& name, const CanonicalParameters& parameters = {},
                      const MaterialChoice& choice = {}) {
  Diagnostics diagnostics;
  const SceneDescription description = canonical_scene(name, parameters, diagnostics);
  Scene scene = build_scene(description, choice, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

inline Scene from_file(const std::filesystem::path& file, const MaterialChoice& choice = {}) {
  Diagnostics diagnostics;
  const SceneDescription description = read_scene_file(file, diagnostics);
  Scene scene = build_scene(description, choice, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

/// One isotropic V transmitter, everything else at its default, no coverage.
inline PlanDescription plan_for(WaveKind kind, double frequency, const Vec3& transmitter) {
  PlanDescription plan;
  plan.kind = kind;
  plan.frequency = {frequency};
  plan.transmitters = {{"tx", transmitter, {0.0}, {}}};
  return plan;
}

inline Receiver receiver_at(const Vec3& position, Polarisation polarisation = Polarisation::both) {
  static int number = 0;
  return {"r" + std::to_string(number++), position, polarisation};
}

inline Result run(const Scene& scene, const PlanDescription& description) {
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  return simulate(scene, tracer, plan);
}

inline double decibel(double ratio) { return 10 * std::log10(ratio); }

}  // namespace grimaldi::test
