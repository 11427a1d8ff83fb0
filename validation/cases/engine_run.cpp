#include "validation/cases/engine_run.h"

#include <cmath>

#include "core/constants.h"
#include "propagation/simulation.h"

namespace grimaldi {

SceneDescription scene_description(const std::string& name, const CanonicalParameters& parameters) {
  Diagnostics diagnostics;
  SceneDescription description = canonical_scene(name, parameters, diagnostics);
  diagnostics.throw_if_errors();
  return description;
}

Scene scene_of(const SceneDescription& description, const MaterialChoice& choice) {
  Diagnostics diagnostics;
  Scene scene = build_scene(description, choice, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

MaterialChoice perfect_faces() {
  MaterialChoice choice;
  choice.replace = {{"*", "metal"}};
  Material metal = built_in_materials().at("metal");
  metal.absorption = Spectrum{{1000}, {0}};
  choice.overrides = {{"metal", metal}};
  return choice;
}

PlanDescription point_to_point(WaveKind kind, double frequency, const Vec3& transmitter, double rays) {
  PlanDescription plan;
  plan.kind = kind;
  plan.frequency = {frequency};
  plan.transmitters = {{"tx", transmitter, {0.0}, {}}};
  plan.depth = 1;
  plan.rays = rays;
  plan.threads = 1;
  if (kind == WaveKind::acoustic) plan.profile.resolution = 1e-3;
  return plan;
}

void add_receiver(PlanDescription& plan, const Vec3& position) {
  plan.receivers.push_back({"r" + std::to_string(plan.receivers.size()), position, Polarisation::both});
}

Result run_engine(const Scene& scene, const PlanDescription& description) {
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(description, scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  return simulate(scene, tracer, plan);
}

double wavelength_of(const PlanDescription& plan) { return wave_speed(plan.kind, plan.air) / plan.frequency.front(); }

double free_gain(const PlanDescription& plan, const Vec3& a, const Vec3& b) {
  const double d = distance(a, b);
  if (plan.kind == WaveKind::radio) return std::pow(wavelength_of(plan) / (4 * pi * d), 2);
  return std::pow(10, -sound_attenuation(plan.air, plan.frequency.front()) * d / 10) / (4 * pi * d * d);
}

double decibel(double ratio) { return 10 * std::log10(ratio); }

}  // namespace grimaldi
