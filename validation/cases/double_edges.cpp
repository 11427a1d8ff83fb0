// Two edges in the engine: two screens against the exact double integral, one flat roof against boundary elements,
// walks across their shadow boundaries.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "scenes/shapes.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"
#include "validation/cases/thick_screen_rows.h"
#include "validation/knife_edge.h"

namespace grimaldi {
namespace {

constexpr Vec3 east{1, 0, 0}, north{0, 1, 0}, up{0, 0, 1};

/// Two thin screens across the line y = z = 0, tops at `heights`, long against every Fresnel zone.
Scene two_screens(double x1, double height1, double x2, double height2, double half) {
  SceneDescription scene;
  scene.name = "two screens";
  const std::vector<double> along = symmetric_cuts(half, half);
  for (const auto& [x, height, name] : {std::tuple{x1, height1, "first"}, std::tuple{x2, height2, "second"}}) {
    MeshDescription mesh{name, scene.name, "metal", {}, {}, {}};
    append_sheet(along, equal_cuts(-half, height, half), {x, 0, 0}, north, up, {true, true, true, false}, mesh);
    scene.meshes.push_back(std::move(mesh));
  }
  return scene_of(scene, perfect_faces());
}

/// Level over the free field, dB.
double level_at(const Result& result, const PlanDescription& plan, std::size_t receiver) {
  return decibel(result.profiles[receiver].total[0] /
                 free_gain(plan, plan.transmitters[0].position, plan.receivers[receiver].position));
}

PlanDescription two_edges_plan(double frequency, const Vec3& transmitter) {
  PlanDescription plan = point_to_point(WaveKind::radio, frequency, transmitter, 5e4);
  plan.depth = 2;
  return plan;
}

/// A row of the table of two knife edges; heights over the straight line, m.
struct ScreenPair {
  const char* id;
  double gigahertz, d1, d2, d3, h1, h2;
};
constexpr ScreenPair screen_pairs[] = {
    {"MK01", 0.9, 1000, 500, 1000, 10, 10}, {"MK02", 0.9, 1000, 500, 1000, 10, 20},
    {"MK03", 0.9, 1000, 500, 1000, 0, 0},   {"MK04", 0.9, 1000, 500, 1000, -10, 15},
    {"MK08", 5.8, 40, 12, 25, 0.5, 0.9},    {"MK10", 28, 30, 10, 60, 0.1, 0.3},
    {"MK11", 28, 30, 10, 60, 0, 0.05},      {"MK15", 0.6, 5000, 5000, 5000, 60, 25},
    {"MK17", 60, 5, 2, 5, 0.1, -0.05},      {"MK18", 3.5, 100, 100, 100, 0, 0},
    {"MK19", 3.5, 100, 1, 100, 0, 0},       {"MK20", 3.5, 100, 400, 100, 3, 4},
    {"", 2.4, 200, 50, 300, 2, 2},          {"", 2.4, 200, 5, 300, 4, 4},
    {"", 2.4, 200, 50, 300, 0.5, -0.5},     {"", 2.4, 200, 5, 300, -1, -1},
};

Outcome behind_two_screens(const ScreenPair& pair) {
  const double over = pair.d1 + pair.d2 + pair.d3;
  // Long against the Fresnel zones and the way round.
  const Scene scene = two_screens(pair.d1, pair.h1, pair.d1 + pair.d2, pair.h2, 2 * over);
  PlanDescription plan = two_edges_plan(pair.gigahertz * 1e9, {0, 0, 0});
  plan.reflection = false;
  add_receiver(plan, {over, 0, 0});
  const double here = level_at(run_engine(scene, plan), plan, 0);
  const double exact =
      -diffraction_loss(exact_double_knife_edge({wavelength_of(plan), pair.d1, pair.d2, pair.d3, pair.h1, pair.h2}));
  return {std::abs(here - exact), fmt::format("{:.3f} dB, exact {:.3f} dB", here, exact), {}};
}

/// A walk upwards behind two screens: largest change of the error from one place to the next.
Outcome walk_behind_two_screens(double height1, double height2) {
  constexpr double d1 = 100, d2 = 30, d3 = 60, frequency = 2.4e9;
  const Scene scene = two_screens(d1, height1, d1 + d2, height2, 600);
  PlanDescription plan = two_edges_plan(frequency, {0, 0, 0});
  plan.reflection = false;
  constexpr double end = d1 + d2 + d3;
  std::vector<double> heights;
  for (double z = -8.05; z < 12; z += 0.125) heights.push_back(z);
  // Close to either side of the lines of sight over the edges, and of the line over both.
  for (const double z : {height1 * end / d1, height2 * end / (d1 + d2), height2 + (height2 - height1) * d3 / d2})
    for (const double off : {-1e-2, -1e-3, -1e-4, 0.0, 1e-4, 1e-3, 1e-2}) heights.push_back(z + off);
  std::sort(heights.begin(), heights.end());
  for (const double z : heights) add_receiver(plan, {end, 0, z});
  const Result result = run_engine(scene, plan);
  LineChart chart{
      "Walk upwards behind two screens", "height of the receiver, m", "level over free space, dB", {}, -40, 6};
  Curve truth{"exact double integral", {}, {}}, engine{"engine", {}, {}};
  Outcome outcome;
  double largest = 0, last = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double z = heights[i], h1 = height1 - z * d1 / end, h2 = height2 - z * (d1 + d2) / end;
    const double exact = -diffraction_loss(exact_double_knife_edge({wavelength_of(plan), d1, d2, d3, h1, h2}));
    const double error = level_at(result, plan, i) - exact;
    if (i > 0 && !(std::abs(error - last) <= outcome.error)) {
      outcome.error = std::abs(error - last);
      outcome.note = fmt::format("at {:.4f} m", z);
    }
    last = error;
    largest = std::max(largest, std::abs(error));
    truth.x.push_back(z), truth.y.push_back(exact);
    engine.x.push_back(z), engine.y.push_back(exact + error);
  }
  outcome.note += fmt::format("; largest error of level {:.2f} dB", largest);
  chart.curves = {truth, engine};
  outcome.figures = {{fmt::format("two-screens-walk-{:g}-{:g}", height1, height2),
                      "A receiver rises behind two black screens through three boundaries: no step.", chart}};
  return outcome;
}

Scene block(double width) {
  constexpr double depth = 1000, half = 2000;
  const std::vector<double> along = symmetric_cuts(half, 200), down = equal_cuts(-depth, 0, 200);
  SceneDescription scene;
  scene.name = "thick screen";
  MeshDescription mesh{"block", scene.name, "metal", {}, {}, {}};
  append_sheet({0, width}, along, {}, east, north, {false, false, true, true}, mesh);
  append_sheet(down, along, {}, up, north, {true, false, true, true}, mesh);
  append_sheet(along, down, {width, 0, 0}, north, up, {true, true, true, false}, mesh);
  scene.meshes.push_back(std::move(mesh));
  return scene_of(scene, perfect_faces());
}

constexpr double lowest_level = -35;

struct RoofErrors {
  std::vector<double> errors;
  std::size_t within = 0;
  std::string worst;
};

/// Errors of level over blocks of that width, rows above −35 dB.
RoofErrors over_the_roof(double width, bool soft, DiffractionModel model) {
  constexpr double wavelength = speed_of_light / 1e9;
  const Scene scene = block(width * wavelength);
  std::map<std::pair<double, double>, std::vector<const ThickScreenRow*>> sources;
  for (const ThickScreenRow& row : thick_screen_rows)
    if (row.width == width && (soft ? row.soft : row.hard) > lowest_level) sources[{row.xs, row.ys}].push_back(&row);
  RoofErrors out;
  double largest = -1;
  for (const auto& [source, rows] : sources) {
    PlanDescription plan = two_edges_plan(1e9, Vec3{source.first * wavelength, 0, source.second * wavelength});
    plan.diffraction_model = model;
    plan.transmitters[0].antenna.polarisation = soft ? Polarisation::horizontal : Polarisation::vertical;
    for (const ThickScreenRow* row : rows) add_receiver(plan, Vec3{row->xr * wavelength, 0, row->yr * wavelength});
    const Result result = run_engine(scene, plan);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double here = level_at(result, plan, i), truth = soft ? rows[i]->soft : rows[i]->hard;
      const double error = std::abs(here - truth);
      out.errors.push_back(error);
      out.within += error <= 1;
      if (!(error <= largest)) {
        largest = error;
        out.worst = fmt::format("largest {:.2f} dB, ({:g}, {:g}) to ({:g}, {:g}) at {:.1f} dB", error, rows[i]->xs,
                                rows[i]->ys, rows[i]->xr, rows[i]->yr, truth);
      }
    }
  }
  std::sort(out.errors.begin(), out.errors.end());
  return out;
}

Outcome roof_levels(double width, bool soft, DiffractionModel model, bool nine_in_ten) {
  const RoofErrors all = over_the_roof(width, soft, model);
  const std::size_t n = all.errors.size();
  return {nine_in_ten ? all.errors[(9 * n + 9) / 10 - 1] : all.errors[n / 2],
          fmt::format("{} of {} rows within 1 dB; {}", all.within, n, all.worst),
          {}};
}

/// A walk down behind a flat roof: largest step between places 1 mm apart at the boundaries, 0.05 wavelengths
/// elsewhere.
Outcome walk_over_a_roof(bool soft, DiffractionModel model, double source_height) {
  constexpr double wavelength = speed_of_light / 1e9, width = 5, away = 20;
  const Scene scene = block(width * wavelength);
  PlanDescription plan = two_edges_plan(1e9, Vec3{-20 * wavelength, 0, source_height * wavelength});
  plan.diffraction_model = model;
  plan.transmitters[0].antenna.polarisation = soft ? Polarisation::horizontal : Polarisation::vertical;
  std::vector<double> heights;
  for (double y = -6.007; y < 6; y += 0.02) heights.push_back(y);
  const double x = width + away;
  for (const double y : {0.0, -source_height * away / (20 + width), source_height * away / (20 + width),
                         -source_height * x / 20, source_height * x / 20})
    for (const double off : {-1e-3, 1e-3}) heights.push_back(y + off);
  std::sort(heights.begin(), heights.end());
  for (const double y : heights) add_receiver(plan, Vec3{x * wavelength, 0, y * wavelength});
  const Result result = run_engine(scene, plan);
  Outcome outcome;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double step = std::abs(level_at(result, plan, i) - level_at(result, plan, i - 1));
    if (!(step <= outcome.error)) {
      outcome.error = step;
      outcome.note = fmt::format("at {:.3f} wavelengths, {:.1f} dB", heights[i], level_at(result, plan, i));
    }
  }
  return outcome;
}

}  // namespace

Cases double_edge_cases() {
  Cases cases;
  for (const ScreenPair& pair : screen_pairs)
    cases.push_back({fmt::format("double-edges/screens/{}{:g}GHz-{:g}-{:g}-{:g}-{:g}-{:g}",
                                 pair.id[0] ? fmt::format("{}-", pair.id) : "", pair.gigahertz, pair.d1, pair.d2,
                                 pair.d3, pair.h1, pair.h2),
                     "two thin screens as a mesh, no reflection: |error of level|",
                     "exact double integral of two knife edges", "dB", 0.02,
                     "the engine's angles are true ones, the integral's paraxial: 0.005 dB at the steepest", 0,
                     [=] { return behind_two_screens(pair); }});
  for (const auto& [height1, height2] : {std::pair{2.0, 2.0}, std::pair{1.0, 3.0}, std::pair{3.0, -1.0}})
    cases.push_back({fmt::format("double-edges/walk/screens/{:g}-{:g}", height1, height2),
                     "a receiver rises behind two screens: largest step of the error between neighbouring places",
                     "exact double integral of two knife edges", "dB", 0.1,
                     "the angles' error changes slowly; a wave that begins or ends without its partner makes 6 dB", 0,
                     [=] { return walk_behind_two_screens(height1, height2); }});
  for (const DiffractionModel model : {DiffractionModel::utd, DiffractionModel::fsd}) {
    const char* name = model == DiffractionModel::utd ? "utd" : "fsd";
    const bool utd = model == DiffractionModel::utd;
    for (const double width : {0.25, 1.0, 3.0, 10.0, 30.0})
      for (const bool soft : {false, true})
        for (const bool nine : {false, true}) {
          const bool fact = !utd && soft;
          cases.push_back(
              {fmt::format("double-edges/roof/{}/{:g}/{}/{}", name, width, soft ? "soft" : "hard",
                           nine ? "nine-in-ten" : "median"),
               fmt::format("engine over a block of that many wavelengths, levels above -35 dB: {} |error of level|",
                           nine ? "the bound of nine rows in ten," : "median"),
               "boundary elements", "dB",
               fact   ? (nine ? 1.5 : 0.5)
               : nine ? 1.0
                      : 0.5,
               fact ? "a fact: near grazing three black edges lack one term of the soft wave"
                    : "what is asked of ray methods; 0.1 to 0.3 dB of it is the table's",
               0, [=] { return roof_levels(width, soft, model, nine); }});
        }
  }
  for (const bool soft : {false, true})
    for (const double height : {-2.0, 0.5, 2.0})
      cases.push_back(
          {fmt::format("double-edges/walk/roof/{}/source-{:g}", soft ? "soft" : "hard", height),
           "a receiver sinks behind a roof of 5 wavelengths (utd): largest step between neighbouring places", "no step",
           "dB", 0.5, "what a walk may show", 0,
           [=] { return walk_over_a_roof(soft, DiffractionModel::utd, height); }});
  return cases;
}

}  // namespace grimaldi
