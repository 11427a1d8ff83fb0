// One and two flat roofs in the engine against boundary elements.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/boundary_elements.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

/// Lengths in wavelengths; sources and receivers as (x, z).
struct Roofs {
  const char* name;
  const char* words;
  std::vector<DeepBlock> blocks;
  std::vector<PolygonBody::Point> sources, receivers;
};

/// Receivers behind the last roof from the lit region down into the shadow, and one above the roof.
std::vector<PolygonBody::Point> behind(double end, double top) {
  std::vector<PolygonBody::Point> points = {{end - 1, top + 3}};
  for (const double x : {end + 8, end + 30})
    for (const double z : {5.0, 1.5, -1.5, -4.0, -9.0}) points.push_back({x, top + z});
  return points;
}

const std::vector<Roofs>& all_roofs() {
  static const std::vector<Roofs> list = {
      {"one/1.3", "a roof of 1.3 wavelengths", {{0, 1.3, 0}}, {{-20, 5}, {-20, -3}, {-50, 1}}, behind(1.3, 0)},
      {"one/4.3", "a roof of 4.3 wavelengths", {{0, 4.3, 0}}, {{-20, 5}, {-20, -3}, {-50, 1}}, behind(4.3, 0)},
      {"one/20", "a roof of 20.2 wavelengths", {{0, 20.2, 0}}, {{-20, 5}, {-20, -3}, {-50, 1}}, behind(20.2, 0)},
      {"two/level",
       "two roofs of 4.3 wavelengths and one height, 12.4 apart",
       {{0, 4.3, 0}, {16.7, 4.3, 0}},
       {{-20, 5}, {-20, -3}, {-50, 1}},
       behind(21, 0)},
      {"two/second-higher",
       "two roofs of 4.3 wavelengths, the second one 2.2 higher, 12.4 apart",
       {{0, 4.3, 0}, {16.7, 4.3, 2.2}},
       {{-20, 5}, {-20, -3}, {-50, 1}},
       behind(21, 2.2)},
      {"two/first-higher",
       "two roofs of 4.3 wavelengths, the first one 2.2 higher, 12.4 apart",
       {{0, 4.3, 2.2}, {16.7, 4.3, 0}},
       {{-20, 5}, {-20, -3}, {-50, 1}},
       behind(21, 0)},
  };
  return list;
}

/// Levels over the free field, dB, [source][receiver]; computed once for all cases of one shape.
struct Truth {
  std::vector<std::vector<double>> soft, hard;
};

const Truth& truth_of(const Roofs& roofs) {
  static std::mutex guard;
  static std::map<std::string, Truth> known;
  const std::lock_guard lock(guard);
  const auto [place, added] = known.try_emplace(roofs.name);
  Truth& truth = place->second;
  if (!added) return truth;
  constexpr double k = 2 * pi;
  std::vector<PolygonBody> bodies;
  for (const DeepBlock& b : roofs.blocks)
    bodies.push_back({{{b.from + b.width, b.top}, {b.from, b.top}}, true, {0, -1}, {0, -1}});
  // 6 levels at the corners: 1e-4 of the field.
  const BoundaryElements elements(bodies, k, {.levels = 6, .reach = 11});
  for (const auto& source : roofs.sources) {
    const auto fields = elements.line_source(source, roofs.receivers);
    auto &soft = truth.soft.emplace_back(), &hard = truth.hard.emplace_back();
    for (std::size_t r = 0; r < fields.size(); ++r) {
      const double free = std::norm(line_source_free_field(k, source, roofs.receivers[r]));
      soft.push_back(decibel(std::norm(fields[r].soft) / free));
      hard.push_back(decibel(std::norm(fields[r].hard) / free));
    }
  }
  return truth;
}

/// Level at which nothing that arrives counts, dB.
constexpr double nothing = -100;

/// Bounds of this suite, of the errors of nine points in ten, dB.
struct Bound {
  double most;
  const char* reason;
};
Bound bound_of(const Roofs& roofs, bool soft, DiffractionModel model) {
  if (!soft || model != DiffractionModel::fsd) return {0.5, "the goal for radio"};
  const auto& blocks = roofs.blocks;
  const bool level = blocks.size() > 1 && blocks[0].top == blocks[1].top;
  return {level ? 5.0 : 3.0,
          "a fact: near grazing three black edges lack one term of the soft wave, at each roof along the ray"};
}

enum class Face { soft, hard, rigid };
constexpr const char* face_names[] = {"soft", "hard", "sound"};

/// Levels at all receivers, fields added: paths of depth 2, over two roofs 6, and what lies beyond estimated.
Outcome levels_behind(const Roofs& roofs, Face face, DiffractionModel model) {
  const bool sound = face == Face::rigid;
  PlanDescription plan = point_to_point(sound ? WaveKind::acoustic : WaveKind::radio, sound ? 1000 : 1e9, {}, 2e4);
  const double wavelength = wavelength_of(plan);
  std::vector<DeepBlock> blocks = roofs.blocks;
  for (DeepBlock& b : blocks) b.from *= wavelength, b.width *= wavelength, b.top *= wavelength;
  const Scene scene = scene_of(deep_blocks(blocks, 300, 1000), perfect_faces());
  const auto place = [&](const PolygonBody::Point& p) { return Vec3{p.x * wavelength, 0, p.y * wavelength}; };
  // Edges run across the plane of source and receivers: horizontal polarisation is soft, vertical hard.
  plan.transmitters[0].antenna.polarisation = face == Face::soft ? Polarisation::horizontal : Polarisation::vertical;
  plan.transmitters.resize(roofs.sources.size(), plan.transmitters[0]);
  for (std::size_t t = 0; t < roofs.sources.size(); ++t) {
    plan.transmitters[t].name = fmt::format("t{}", t);
    plan.transmitters[t].position = place(roofs.sources[t]);
  }
  for (const auto& receiver : roofs.receivers) add_receiver(plan, place(receiver));
  plan.depth = blocks.size() > 1 ? 6 : 2;
  plan.diffraction_model = model;
  const Result result = run_engine(scene, plan);
  const Truth& truth = truth_of(roofs);
  std::vector<double> errors;
  std::string worst;
  double largest = -1;
  for (std::size_t t = 0; t < roofs.sources.size(); ++t)
    for (std::size_t r = 0; r < roofs.receivers.size(); ++r) {
      const double exact = (face == Face::soft ? truth.soft : truth.hard)[t][r];
      if (exact < -40) continue;  // deeper than any street
      const Vec3 tx = place(roofs.sources[t]), rx = place(roofs.receivers[r]);
      const double gain = result.profiles[r].total_completed[t];
      const double here = std::max(nothing, decibel(gain / free_gain(plan, tx, rx)));
      errors.push_back(std::abs(here - exact));
      if (errors.back() > largest) {
        largest = errors.back();
        worst = fmt::format("({:g}, {:g}) to ({:g}, {:g}): {:.1f} dB, truth {:.1f} dB", roofs.sources[t].x,
                            roofs.sources[t].y, roofs.receivers[r].x, roofs.receivers[r].y, here, exact);
      }
    }
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) { return errors[std::size_t(share * double(errors.size() - 1))]; };
  return {at(0.9),
          fmt::format("median {:.2f} dB, nine in ten below {:.2f} dB of {}; largest at {}", at(0.5), at(0.9),
                      errors.size(), worst),
          {}};
}

}  // namespace

Cases roof_cases() {
  Cases cases;
  for (const Roofs& roofs : all_roofs())
    for (const Face face : {Face::soft, Face::hard, Face::rigid})
      for (const DiffractionModel model : {DiffractionModel::fsd, DiffractionModel::utd}) {
        const Bound bound = bound_of(roofs, face == Face::soft, model);
        cases.push_back(
            {fmt::format("roofs/{}/{}/{}", roofs.name, face_names[int(face)],
                         model == DiffractionModel::utd ? "utd" : "fsd"),
             fmt::format("engine over {}: |error of level| of nine points in ten above -40 dB", roofs.words),
             "boundary elements", "dB", bound.most, bound.reason, 0,
             [&roofs, face, model] { return levels_behind(roofs, face, model); }});
      }
  return cases;
}

}  // namespace grimaldi
