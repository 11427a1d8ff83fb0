// What may not change the answer of the engine: how a mesh is cut, where the scene lies, what else is asked.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

constexpr Vec3 transmitter{-31, 3, 9};
constexpr double frequency = 1e9;
/// Levels more than this below the strongest are left out: what arrives there are single weak paths, found or not.
constexpr double dynamic_range = 60;

/// A street between brick houses on concrete, with side streets.
SceneDescription street() { return scene_description("street-canyon"); }

using Index = std::array<std::uint32_t, 2>;

/// Each triangle cut in four by the midpoints of its sides.
SceneDescription cut_in_four(SceneDescription scene) {
  for (MeshDescription& mesh : scene.meshes) {
    std::map<Index, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const Index key{std::min(a, b), std::max(a, b)};
      const auto found = middles.find(key);
      if (found != middles.end()) return found->second;
      mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      return middles[key] = std::uint32_t(mesh.vertices.size() - 1);
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        triangles.push_back(part);
    }
    std::vector<Index> artificial;
    for (const auto& [a, b] : mesh.artificial_edges) {
      const std::uint32_t m = middle(a, b);
      artificial.push_back({a, m}), artificial.push_back({m, b});
    }
    mesh.triangles = std::move(triangles), mesh.artificial_edges = std::move(artificial);
  }
  return scene;
}

/// One object for each material.
SceneDescription merged(const SceneDescription& scene) {
  SceneDescription result;
  result.name = scene.name, result.materials = scene.materials;
  std::map<std::string, MeshDescription> by_material;
  for (const MeshDescription& mesh : scene.meshes) {
    MeshDescription& target = by_material[mesh.material];
    target.name = target.material = mesh.material;
    const auto shift = std::uint32_t(target.vertices.size());
    target.vertices.insert(target.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) target.triangles.push_back({a + shift, b + shift, c + shift});
    for (const auto& [a, b] : mesh.artificial_edges) target.artificial_edges.push_back({a + shift, b + shift});
  }
  for (auto& [material, mesh] : by_material) result.meshes.push_back(std::move(mesh));
  return result;
}

/// One object for each triangle, in another order.
SceneDescription split(const SceneDescription& scene) {
  SceneDescription result;
  result.name = scene.name, result.materials = scene.materials;
  for (const MeshDescription& mesh : scene.meshes)
    for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
      const auto& corners = mesh.triangles[t];
      MeshDescription one;
      one.name = fmt::format("{} {}", mesh.name, t), one.material = mesh.material;
      for (const std::uint32_t corner : corners) one.vertices.push_back(mesh.vertices[corner]);
      one.triangles = {{0, 1, 2}};
      for (const auto& [a, b] : mesh.artificial_edges) {
        const auto ia = std::find(corners.begin(), corners.end(), a), ib = std::find(corners.begin(), corners.end(), b);
        if (ia != corners.end() && ib != corners.end())
          one.artificial_edges.push_back({std::uint32_t(ia - corners.begin()), std::uint32_t(ib - corners.begin())});
      }
      result.meshes.push_back(std::move(one));
    }
  return result;
}

/// A motion of the whole: turned about the vertical, then moved.
struct Motion {
  double angle = 0;
  Vec3 shift;
  Vec3 operator()(const Vec3& p) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z} + shift;
  }
};

SceneDescription moved(SceneDescription scene, const Motion& motion) {
  for (MeshDescription& mesh : scene.meshes)
    for (Vec3& vertex : mesh.vertices) vertex = motion(vertex);
  return scene;
}

/// Points of the streets.
std::vector<Vec3> street_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 120; ++i) {
    const double x = -140 + 2.37 * i, y = -7.5 + std::fmod(3.71 * i, 15.0);
    points.push_back({x, y, 1.5});
  }
  for (int i = 0; i < 40; ++i)
    points.push_back({-75 + 150 * (i % 2) + std::fmod(1.7 * i, 12.0) - 6, 12 + 0.3 * i, 1.5});
  return points;
}

PlanDescription plan_at(const std::vector<Vec3>& points, const Motion& motion = {}) {
  PlanDescription plan = point_to_point(WaveKind::radio, frequency, motion(transmitter), 2e5);
  for (const Vec3& point : points) add_receiver(plan, motion(point));
  return plan;
}

std::vector<double> totals(const Result& result) {
  std::vector<double> gains;
  for (const ReceiverProfile& profile : result.profiles) gains.push_back(profile.total[0]);
  return gains;
}

/// Largest difference of level; points within the dynamic range of one of the two alone count in full.
Outcome difference(const std::vector<double>& a, const std::vector<double>& b) {
  Outcome outcome;
  const double top = *std::max_element(a.begin(), a.end());
  std::vector<double> all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::max(a[i], b[i]) > top * std::pow(10, -dynamic_range / 10))) continue;
    const double off = a[i] > 0 && b[i] > 0 ? std::abs(decibel(a[i] / b[i])) : 1000.0;
    all.push_back(off);
    if (off > outcome.error)
      outcome.error = off, outcome.note = fmt::format("largest at point {}, {:.1f} dB", i, decibel(a[i]));
  }
  std::sort(all.begin(), all.end());
  if (all.empty())
    outcome.error = NAN;
  else
    outcome.note += fmt::format("; median {:.2g} dB of {} points", all[all.size() / 2], all.size());
  return outcome;
}

Outcome against_street(const SceneDescription& other, const Motion& motion = {}) {
  const std::vector<Vec3> points = street_points();
  return difference(totals(run_engine(scene_of(street()), plan_at(points))),
                    totals(run_engine(scene_of(other), plan_at(points, motion))));
}

/// Differences of level within 40 dB of the strongest, ascending.
std::vector<double> sorted_differences(const std::vector<double>& a, const std::vector<double>& b) {
  const double top = *std::max_element(a.begin(), a.end());
  std::vector<double> all;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::max(a[i], b[i]) > 1e-4 * top)
      all.push_back(a[i] > 0 && b[i] > 0 ? std::abs(decibel(a[i] / b[i])) : 1000.0);
  std::sort(all.begin(), all.end());
  return all;
}

/// Paths of two interactions are found by chance: what a change of the scene does, beside what another seed does.
/// Error: 90 % quantile of the former less that of the latter.
Outcome within_noise(const SceneDescription& other, const Motion& motion = {}) {
  const std::vector<Vec3> points = street_points();
  PlanDescription plan = plan_at(points), there = plan_at(points, motion);
  plan.depth = there.depth = 2;
  const Scene scene = scene_of(street());
  const std::vector<double> first = totals(run_engine(scene, plan)),
                            changed = totals(run_engine(scene_of(other), there));
  plan.seed = 2;
  const std::vector<double> second = totals(run_engine(scene, plan));
  const std::vector<double> change = sorted_differences(first, changed), noise = sorted_differences(first, second);
  const auto quantile = [](const std::vector<double>& sorted) {
    return sorted[std::size_t(0.9 * double(sorted.size() - 1))];
  };
  return {
      std::max(0.0, quantile(change) - quantile(noise)),
      fmt::format(
          "90 % of {} points change by less than {:.3f} dB, by another seed {:.3f} dB; largest {:.3f} and {:.3f} dB",
          change.size(), quantile(change), quantile(noise), change.back(), noise.back()),
      {}};
}

/// A run of cells over an area, one transmitter.
CoverageMap cells(const Scene& scene, double cell, const std::array<double, 4>& area, std::size_t& nx) {
  PlanDescription plan = point_to_point(WaveKind::radio, frequency, transmitter, 2e5);
  plan.coverage = CoverageRequest{1.5, cell, area, Polarisation::both};
  nx = std::size_t(std::ceil((area[2] - area[0]) / cell - 1e-9));
  return *run_engine(scene, plan).coverage;
}

constexpr std::array<double, 4> open_street{-60, -10, 60, 10};

Outcome coarse_against_fine() {
  const Scene scene = scene_of(street());
  std::size_t wide = 0, narrow = 0;
  const CoverageMap coarse = cells(scene, 10, open_street, wide), fine = cells(scene, 1, open_street, narrow);
  std::vector<double> means;
  Outcome outcome;
  double noise = 0;
  for (std::size_t c = 0; c < coarse.path_gain.size(); ++c) {
    double sum = 0, weight = 0;
    for (std::size_t j = 0; j < 10; ++j)
      for (std::size_t i = 0; i < 10; ++i) {
        const std::size_t k = (c / wide * 10 + j) * narrow + c % wide * 10 + i;
        if (std::isnan(fine.path_gain[k])) continue;
        const double outdoors = 1 - fine.inside_fraction[k];
        sum += outdoors * fine.path_gain[k], weight += outdoors;
      }
    const double mean = sum / weight;
    // In units of what the coarse cell states as its error, at least 0.05 dB.
    const double off = std::abs(decibel(coarse.path_gain[c] / mean));
    const double stated = decibel(1 + coarse.standard_error[c] / coarse.path_gain[c]);
    noise = std::max(noise, stated);
    const double beyond = off / std::max(0.05, stated);
    if (!(beyond <= outcome.error))
      outcome.error = beyond,
      outcome.note = fmt::format("largest at cell {}: {:.3f} dB, stated error {:.3f} dB", c, off, stated);
  }
  outcome.note += fmt::format("; largest stated error {:.2f} dB", noise);
  return outcome;
}

Outcome cell_against_points() {
  const Scene scene = scene_of(street());
  constexpr std::array<double, 4> area{0, -5, 20, 5};
  std::size_t nx = 0;
  const CoverageMap map = cells(scene, 5, area, nx);
  std::vector<Vec3> points;
  constexpr int side = 12;
  const std::size_t count = map.path_gain.size();
  for (std::size_t c = 0; c < count; ++c)
    for (int k = 0; k < side * side; ++k)
      points.push_back({area[0] + 5 * (double(c % nx) + (k % side + 0.5) / side),
                        area[1] + 5 * (double(c / nx) + (k / side + 0.5) / side), 1.5});
  const std::vector<double> gains = totals(run_engine(scene, plan_at(points)));
  Outcome outcome;
  for (std::size_t c = 0; c < count; ++c) {
    double mean = 0;
    for (int k = 0; k < side * side; ++k) mean += gains[c * side * side + std::size_t(k)] / (side * side);
    const double off = std::abs(decibel(map.path_gain[c] / mean));
    const double stated = decibel(1 + map.standard_error[c] / map.path_gain[c]);
    const double beyond = off / std::max(0.05, stated);
    if (!(beyond <= outcome.error))
      outcome.error = beyond,
      outcome.note = fmt::format("largest at cell {}: {:.3f} dB, stated error {:.3f} dB", c, off, stated);
  }
  return outcome;
}

Outcome one_among_many() {
  const Scene scene = scene_of(street());
  const std::vector<Vec3> points = street_points();
  const std::vector<double> many = totals(run_engine(scene, plan_at(points)));
  std::vector<double> among, alone;
  for (std::size_t i = 0; i < points.size(); i += 13) {
    among.push_back(many[i]);
    alone.push_back(totals(run_engine(scene, plan_at({points[i]}))).front());
  }
  return difference(among, alone);
}

}  // namespace

Cases invariance_cases() {
  const char* same = "the same scene as it was";
  const char* quantity = "engine, paths of one interaction at 160 points: largest difference of level";
  const char* reason = "same geometry: rounding; the goal is 0.05 dB";
  const Motion turned{pi / 6, {}}, far{0, {5e5, 5e5, 0}}, both{pi / 6, {5e5, -5e5, 0}};
  Cases cases = {
      {"invariance/triangles-in-four", quantity, same, "dB", 0.05, reason, 0,
       [] { return against_street(cut_in_four(street())); }},
      {"invariance/objects-merged", quantity, same, "dB", 0.05, reason, 0,
       [] { return against_street(merged(street())); }},
      {"invariance/objects-split", quantity, same, "dB", 0.05, reason, 0,
       [] { return against_street(split(street())); }},
      {"invariance/rotated-30", quantity, same, "dB", 0.05,
       "both polarisations of an upright antenna: turning about the vertical changes nothing; 0.05 dB", 0,
       [=] { return against_street(moved(street(), turned), turned); }},
      {"invariance/moved-5e5", quantity, same, "dB", 0.05, "doubles keep 6e-11 m there; 0.05 dB", 0,
       [=] { return against_street(moved(street(), far), far); }},
      {"invariance/rotated-and-moved", quantity, same, "dB", 0.05, "both at once; 0.05 dB", 0,
       [=] { return against_street(moved(street(), both), both); }},
      {"invariance/one-receiver", "engine, a receiver alone against the same among 160: largest difference of level",
       "the receiver among others", "dB", 0.05, "aimed rays may find more; 0.05 dB", 0, one_among_many},
      {"invariance/cells-10m-1m", "engine, cells of 10 m: largest difference over the stated error (at least 0.05 dB)",
       "mean of the cells of 1 m in them", "1", 4, "24 cells: 4 standard errors (p = 0.002)", 0, coarse_against_fine},
      {"invariance/cell-points", "engine, cells of 5 m: largest difference over the stated error (at least 0.05 dB)",
       "mean of 144 receivers in each", "1", 4, "8 cells: 4 standard errors", 0, cell_against_points},
  };
  const char* found = "engine, paths of two interactions: 90 % quantile of the differences less that of another seed";
  const char* chance = "found by chance: no more than another seed changes, and 0.05 dB";
  const auto noise = [&](const char* name, std::function<Outcome()> run) {
    cases.push_back(
        {fmt::format("invariance/two-interactions/{}", name), found, same, "dB", 0.05, chance, 0, std::move(run)});
  };
  noise("triangles-in-four", [] { return within_noise(cut_in_four(street())); });
  noise("objects-split", [] { return within_noise(split(street())); });
  noise("rotated-and-moved", [=] { return within_noise(moved(street(), both), both); });
  return cases;
}

}  // namespace grimaldi
