// Coefficients of faces along which waves go.

#include "propagation/face_reflection.h"

#include <complex>

#include "tests/propagation/runs.h"
#include "tests/scenes/solids.h"

namespace grimaldi {
namespace {

Scene box_of(const char* material) {
  Diagnostics diagnostics;
  Scene scene = build_scene(solids::scene({solids::box({0, 0, 0}, {5, 5, 5}, true, material)}), {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

struct Faces {
  Scene scene;
  Plan plan;
  std::uint32_t material;
};
Faces faces_of(const char* material) {
  Faces faces{box_of(material), {}, 0};
  const Tracer tracer(faces.scene);
  Diagnostics diagnostics;
  faces.plan = make_plan(test::plan_for(WaveKind::radio, 3.5e9, {20, 0, 2}), faces.scene, tracer, diagnostics);
  diagnostics.throw_if_errors();
  faces.material = faces.scene.patches.patches[0].material;
  return faces;
}

ReflectionCoefficients reflection_along(const Faces& faces, double cosine, double way) {
  return face_reflection(faces.plan, faces.material, 0, met_cosines(faces.plan, faces.material, 0, cosine, way));
}

// Vertical waves along metal: the numerical distance of 30 m is 2e-3, so they go on as along a perfect conductor, where
// the plain coefficient turns to -1 at grazing. Along concrete it is great: they die.
TEST(FaceReflection, AlongMetalAndConcrete) {
  const Faces metal = faces_of("metal"), concrete = faces_of("concrete");
  EXPECT_LT(std::abs(face_reflection(metal.plan, metal.material, 0, 0).tm + 1.0), 1e-9);
  EXPECT_LT(std::abs(reflection_along(metal, 0, 30).tm - 1.0), 0.1);
  EXPECT_LT(std::abs(reflection_along(concrete, 0, 30).tm + 1.0), 0.01);
  // Horizontal ones are extinguished by both.
  EXPECT_LT(std::abs(reflection_along(metal, 0, 30).te + 1.0), 1e-4);
}

// Steeper than the width of the way it is the face's own coefficient, and there is no step to it.
TEST(FaceReflection, NoStepWhereTheWidthBegins) {
  for (const char* material : {"metal", "concrete", "glass"}) {
    const Faces here = faces_of(material);
    const double way = 30, width = 1 / std::sqrt(here.plan.wavenumber[0] * way);
    const auto plain = face_reflection(here.plan, here.material, 0, 1.5 * width);
    const auto along = reflection_along(here, 1.5 * width, way);
    EXPECT_EQ(plain.te, along.te);
    EXPECT_EQ(plain.tm, along.tm);
    const auto below = reflection_along(here, width * (1 - 1e-9), way);
    const auto above = reflection_along(here, width * (1 + 1e-9), way);
    EXPECT_LT(std::abs(below.tm - above.tm), 1e-7) << material;
    EXPECT_LT(std::abs(below.te - above.te), 1e-7) << material;
  }
}

}  // namespace
}  // namespace grimaldi
