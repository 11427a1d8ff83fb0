#include "benchmarks/cities.h"

#include <filesystem>

#include "scenes/canonical.h"
#include "scenes/demo_city.h"
#include "scenes/scene_file.h"

namespace grimaldi {
namespace {

struct Place {
  std::string name;
  std::filesystem::path file;  ///< empty: built in
  Vec3 transmitter;
};

const Place& place(std::int64_t number) {
  static const std::filesystem::path folder = std::filesystem::path(GRIMALDI_SHARED) / "data" / "sionna";
  static const Place places[] = {
      {"demo-city", {}, demo_city_rooftop},
      {"munich", folder / "munich" / "munich.xml", {8.5, 21, 27}},
      {"etoile", folder / "etoile" / "etoile.xml", {8.5, 21, 27}},
  };
  return places[number];
}

std::unique_ptr<City> loaded(const Place& place) {
  Diagnostics diagnostics;
  const SceneDescription description =
      place.file.empty() ? canonical_scene(place.name, {}, diagnostics) : read_scene_file(place.file, diagnostics);
  auto city = std::make_unique<City>();
  city->name = place.name;
  city->transmitter = place.transmitter;
  city->scene = build_scene(description, {}, diagnostics);
  diagnostics.throw_if_errors();
  city->tracer = std::make_unique<Tracer>(city->scene);
  return city;
}

}  // namespace

const City* city_for(benchmark::State& state, std::int64_t number) {
  static std::unique_ptr<City> cities[3];
  const Place& wanted = place(number);
  if (!wanted.file.empty() && !std::filesystem::exists(wanted.file)) {
    state.SkipWithError("needs ../shared/data/sionna");
    return nullptr;
  }
  if (!cities[number]) cities[number] = loaded(wanted);
  state.SetLabel(wanted.name);
  return cities[number].get();
}

Plan radio_plan(const City& city, bool diffraction, double rays, unsigned threads) {
  PlanDescription request;
  request.frequency = {3.5e9};
  request.transmitters = {{"tx", city.transmitter, {0.0}, {}}};
  request.coverage = CoverageRequest{};
  request.diffraction = diffraction;
  request.rays = rays;
  request.threads = threads;
  Diagnostics diagnostics;
  Plan plan = make_plan(request, city.scene, *city.tracer, diagnostics);
  diagnostics.throw_if_errors();
  return plan;
}

}  // namespace grimaldi
