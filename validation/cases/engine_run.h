#pragma once
// Short runs of the engine, as the cases need them: one thread, no file.

#include <functional>
#include <string>
#include <vector>

#include "propagation/plan.h"
#include "propagation/result.h"
#include "scenes/canonical.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The description of a built-in scene. Throws InputErrors.
SceneDescription scene_description(const std::string& name, const CanonicalParameters& parameters = {});

/// The scene as the engine takes it. Throws InputErrors.
Scene scene_of(const SceneDescription& description, const MaterialChoice& choice = {});

/// All faces of a perfect conductor and a rigid wall.
MaterialChoice perfect_faces();

/// One isotropic transmitter, one carrier, paths of one interaction, no coverage; one thread.
PlanDescription point_to_point(WaveKind kind, double frequency, const Vec3& transmitter, double rays = 1e5);

/// Adds a receiver of both polarisations.
void add_receiver(PlanDescription& plan, const Vec3& position);

/// Runs. Throws InputErrors for what make_plan refuses.
Result run_engine(const Scene& scene, const PlanDescription& plan);

/// λ of the plan's first carrier, m.
double wavelength_of(const PlanDescription& plan);

/// Free-space gain between two points: (λ/4πd)², for sound 1/(4πd²) less the air's absorption.
double free_gain(const PlanDescription& plan, const Vec3& a, const Vec3& b);

/// 10 lg.
double decibel(double ratio);

}  // namespace grimaldi
