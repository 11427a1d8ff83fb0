#include "validation/cases/exhaustive_search.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.h"
#include "propagation/composite.h"
#include "propagation/connect.h"
#include "propagation/edge_shadow.h"
#include "propagation/field.h"
#include "propagation/simulation.h"
#include "validation/cases/engine_run.h"

namespace grimaldi {
namespace {

Vec3 passed_at(const Wedge& wedge, const Vec3& a, const Vec3& b) {
  return wedge.point(std::clamp(crossing(wedge.start, wedge.direction, a, b), 0.0, wedge.length));
}

const std::vector<std::string> classes{"D", "R", "RR", "E", "RE", "ER", "EE"};

struct ClassPower {
  double power = 0, strongest = 0, delay = 0;
  std::size_t paths = 0;
  void add(double p, double d) {
    power += p;
    ++paths;
    if (p > strongest) strongest = p, delay = d;
  }
};
using Powers = std::map<std::string, ClassPower>;

ClassPower whole(const Powers& powers) {
  ClassPower all;
  for (const auto& [name, part] : powers) {
    all.power += part.power;
    if (part.strongest > all.strongest) all.strongest = part.strongest, all.delay = part.delay;
  }
  return all;
}

std::string class_of(std::span<const Interaction> interactions) {
  std::string name;
  for (const Interaction i : interactions) name += is_edge(i) ? 'E' : 'R';
  return name.empty() ? "D" : name;
}

/// The class of a path as a profile tells it: "R:concrete D:12".
std::string class_of(const PathStory& path) {
  std::string name;
  for (std::size_t i = 0; i + 1 < path.interactions.size(); ++i)
    if (path.interactions[i + 1] == ':') name += path.interactions[i] == 'D' ? 'E' : 'R';
  return name.empty() ? "D" : name;
}

Powers powers_of(const std::vector<PathStory>& paths) {
  Powers powers;
  for (const PathStory& path : paths) {
    double power = 0;
    for (const auto& amplitude : path.amplitude) power += std::norm(amplitude);
    powers[class_of(path)].add(power, path.delay);
  }
  return powers;
}

Powers powers_of(const Scene& scene, const Plan& plan, const std::vector<ExhaustivePath>& paths) {
  Powers powers;
  std::array<std::complex<double>, 2> field[1];
  for (const ExhaustivePath& path : paths) {
    path_field(scene, plan, plan.request.transmitters[0], path.interactions(), path.geometry, field);
    powers[class_of(path.interactions())].add(received_power(field[0], Polarisation::both),
                                              path.geometry.length / plan.speed);
  }
  return powers;
}

}  // namespace

ExhaustiveSearch::ExhaustiveSearch(const Scene& scene, const Tracer& tracer, const Vec3& transmitter, double wavelength)
    : scene_(scene),
      tracer_(tracer),
      transmitter_(transmitter),
      wavelength_(wavelength),
      transmitter_images_(images_of(transmitter)),
      transmitter_view_(edges_in_view(transmitter)) {}

std::vector<Vec3> ExhaustiveSearch::images_of(const Vec3& point) const {
  std::vector<Vec3> images;
  for (const Patch& patch : scene_.patches.patches) images.push_back(mirrored(point, patch));
  return images;
}

std::vector<std::uint32_t> ExhaustiveSearch::edges_in_view(const Vec3& eye) const {
  // The near triangles first: they cover most.
  std::vector<std::pair<double, std::size_t>> triangles;
  for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
    double apart = 0;
    for (const std::uint32_t corner : scene_.triangles[t]) apart += distance(eye, scene_.vertices[corner]);
    triangles.emplace_back(apart, t);
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<std::uint32_t> seen;
  for (std::uint32_t w = 0; w < scene_.wedges.wedges.size(); ++w) {
    EdgeShadow shadow(scene_.wedges.wedges[w], eye, tracer_.surface_gap());
    if (shadow.hidden_by_itself()) continue;
    for (std::size_t i = 0; i < triangles.size() && !shadow.end_on() && !shadow.all_dark(); ++i)
      shadow.add(scene_, triangles[i].second);
    if (!shadow.all_dark()) seen.push_back(w);
  }
  return seen;
}

std::vector<ExhaustivePath> ExhaustiveSearch::paths_to(const Vec3& receiver) const {
  const auto& patches = scene_.patches.patches;
  const auto& wedges = scene_.wedges.wedges;
  const std::vector<Vec3> receiver_images = images_of(receiver);
  const std::vector<std::uint32_t> receiver_view = edges_in_view(receiver);
  std::vector<ExhaustivePath> paths;
  ExhaustivePath path;
  std::uint64_t shadow_rays = 0;
  const auto ask = [&](std::initializer_list<Interaction> interactions) {
    path.count = interactions.size();
    std::copy(interactions.begin(), interactions.end(), path.held.begin());
    UnfoldedSequence unfolded(scene_, transmitter_, path.interactions());
    if (unfolded.solve(receiver, wavelength_, path.geometry) &&
        connected(scene_, tracer_, path.interactions(), path.geometry, shadow_rays))
      paths.push_back(path);
  };
  ask({});
  for (std::uint32_t p = 0; p < patches.size(); ++p) ask({p});
  for (std::uint32_t p = 0; p < patches.size(); ++p)
    for (std::uint32_t q = 0; q < patches.size(); ++q)
      if (crosses_box(patches[p], transmitter_images_[p], receiver_images[q]) &&
          crosses_box(patches[q], receiver_images[q], transmitter_images_[p]))
        ask({p, q});
  for (const std::uint32_t w : transmitter_view_) ask({edge_interaction(w)});
  for (std::uint32_t p = 0; p < patches.size(); ++p)
    for (const std::uint32_t w : receiver_view)
      if (crosses_box(patches[p], transmitter_images_[p], passed_at(wedges[w], transmitter_images_[p], receiver)))
        ask({p, edge_interaction(w)});
  for (const std::uint32_t w : transmitter_view_)
    for (std::uint32_t q = 0; q < patches.size(); ++q)
      if (crosses_box(patches[q], receiver_images[q], passed_at(wedges[w], transmitter_, receiver_images[q])))
        ask({edge_interaction(w), q});
  for (const std::uint32_t a : transmitter_view_)
    for (const std::uint32_t b : receiver_view) ask({edge_interaction(a), edge_interaction(b)});
  return paths;
}

ExhaustiveComparison compare_with_exhaustive_search(const Scene& scene, PlanDescription request) {
  request.depth = 2;
  request.profile.max_paths = 1'000'000;
  const Result result = run_engine(scene, request);
  const Tracer tracer(scene);
  Diagnostics diagnostics;
  const Plan plan = make_plan(request, scene, tracer, diagnostics);
  const ExhaustiveSearch search(scene, tracer, request.transmitters[0].position, wavelength_of(request));
  ExhaustiveComparison comparison;
  for (const std::string& name : classes) comparison.classes.push_back({name, {}, 0, 0});
  for (const ReceiverProfile& profile : result.profiles) {
    Powers engine = powers_of(profile.paths[0]);
    Powers all = powers_of(scene, plan, search.paths_to(profile.position));
    const ClassPower total = whole(all), found = whole(engine);
    if (total.power == 0) continue;
    for (auto& part : comparison.classes) {
      part.engine_paths += engine[part.name].paths;
      part.all_paths += all[part.name].paths;
      if (all[part.name].power > 0)
        part.difference.push_back(decibel(std::max(1e-10, engine[part.name].power / all[part.name].power)));
    }
    comparison.share.push_back(found.power / total.power);
    comparison.delay.push_back(found.delay - total.delay);
    comparison.places.push_back(profile.position);
  }
  return comparison;
}

std::vector<Vec3> street_points(const Scene& scene, double half, std::size_t count, std::uint64_t seed) {
  const Tracer tracer(scene);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; points.size() < count; ++i) {
    const auto u = uniform4(seed, 0, i, 0);
    const Vec3 point{half * (2 * u[0] - 1), half * (2 * u[1] - 1), scene.ground + 1.5};
    if (!tracer.inside_solid(point)) points.push_back(point);
  }
  return points;
}

}  // namespace grimaldi
