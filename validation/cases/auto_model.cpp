// The model `auto` in the engine: small objects as wholes, and walks through the fades from one model to the other.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/constants.h"
#include "scenes/shapes.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"
#include "validation/rayleigh_sommerfeld.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
constexpr double k = 2 * pi;  // lengths in wavelengths

enum class Wave { metal, rigid };

PlanDescription plan_for(Wave wave) {
  const bool sound = wave == Wave::rigid;
  PlanDescription plan = point_to_point(sound ? WaveKind::acoustic : WaveKind::radio, sound ? 1000 : 1e9, {}, 1e5);
  plan.diffraction_model = DiffractionModel::automatic;
  plan.depth = 2;  // paths over two edges of an object belong to its wave too
  return plan;
}

double wavelength_of(Wave wave) { return wavelength_of(plan_for(wave)); }

/// Levels of the engine over the free wave, dB: fields of all paths added, or as a map adds them. Places in
/// wavelengths.
std::vector<double> levels(const Scene& scene, Wave wave, const Vec3& source, const std::vector<Vec3>& points,
                           bool coherent, int depth = 2) {
  PlanDescription plan = plan_for(wave);
  plan.depth = depth;
  const double wavelength = wavelength_of(plan);
  plan.transmitters[0].position = wavelength * source;
  for (const Vec3& point : points) add_receiver(plan, wavelength * point);
  const Result result = run_engine(scene, plan);
  std::vector<double> list;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ReceiverProfile& profile = result.profiles[i];
    list.push_back(decibel((coherent ? profile.total_coherent : profile.total)[0] /
                           free_gain(plan, wavelength * source, wavelength * points[i])));
  }
  return list;
}

/// The part of the second kind in what goes through an opening.
constexpr double black = 0.5, what_a_rigid_plate_takes = 0, in_a_rigid_screen = 1;
double plate_like(Wave wave) { return wave == Wave::rigid ? what_a_rigid_plate_takes : black; }
double screen_like(Wave wave) { return wave == Wave::rigid ? in_a_rigid_screen : black; }

/// Kirchhoff's field through the rectangle |y| ≤ wide/2, |z| ≤ high/2 of the plane x = 0, over the free wave: the mean
/// of both kinds is the opening in a black screen; the first alone what a rigid plate in its place takes away, the
/// second (the pressure's slope is given) the opening in a rigid screen.
Complex share_through(double wide, double high, const Vec3& source, const Vec3& point, double second) {
  Aperture opening;
  opening.loops = {{{-wide / 2, -high / 2}, {wide / 2, -high / 2}, {wide / 2, high / 2}, {-wide / 2, high / 2}}};
  const double whole = distance(source, point), before = -source.x, middle = norm(source);
  const auto way = [&](double x, double y) { return norm(Vec3{before, x - source.y, y - source.z}); };
  const auto incident = [&](double x, double y) { return std::polar(1 / way(x, y), -k * (way(x, y) - middle)); };
  const auto tilted = [&](double x, double y) { return incident(x, y) * (before / way(x, y)); };
  const Vec3 to{point.y, point.z, point.x};
  Complex field = 0;
  if (second < 1) field += (1 - second) * rayleigh_sommerfeld_direct(opening, k, to, incident);
  if (second > 0) field += second * rayleigh_sommerfeld_direct(opening, k, to, tilted, RayleighSommerfeld::second);
  return field / std::polar(1 / whole, -k * (whole - middle));
}

/// Largest error of level where the truth lies above −20 dB of `top`, dB.
Outcome worst_of(const std::vector<double>& here, const std::vector<double>& truth, const std::vector<Vec3>& points,
                 double top = 0) {
  double largest = 0, depth = INFINITY, height = -INFINITY;
  std::vector<double> all;
  std::string where;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (truth[i] < top - 20) continue;
    all.push_back(std::abs(here[i] - truth[i]));
    depth = std::min(depth, truth[i]);
    height = std::max(height, truth[i]);
    if (all.back() > largest || std::isnan(all.back())) {
      largest = all.back();
      where = fmt::format("({:.1f}, {:.1f}, {:.1f}): {:.2f} dB, truth {:.2f} dB", points[i].x, points[i].y, points[i].z,
                          here[i], truth[i]);
    }
  }
  std::sort(all.begin(), all.end());
  return {largest,
          fmt::format("median {:.2f} dB of {}, truth {:.1f} to {:.1f} dB; largest at {}", all[all.size() / 2],
                      all.size(), depth, height, where),
          {}};
}

/// A screen that reaches 120 wavelengths to each side, with a square hole.
Scene screen_scene(double hole, double unit) {
  return scene_of(upright_screen_with_hole(120 * unit, hole * unit, hole * unit), perfect_faces());
}
Scene plate_scene(double size, double unit) {
  return scene_of(upright_plate(size * unit, size * unit), perfect_faces());
}
/// A box behind x = 0, its front square.
Scene closed_scene(double size, double depth, double unit) {
  const double half = 0.5 * size * unit;
  return scene_of(closed_box({0, -half, -half}, {depth * unit, half, half}), perfect_faces());
}

/// Points behind a plate or before it, out to directions of 0.5 rad.
std::vector<Vec3> points_at(double x) {
  std::vector<Vec3> points;
  for (const double y : {0.013, 0.06, 0.17, 0.31, 0.5})
    for (const double z : {0.0, 0.04, 0.13, 0.29}) points.push_back({x, y * std::abs(x), z * std::abs(x)});
  return points;
}

constexpr Vec3 on_axis{-150, 0.2, 0.1}, oblique{-140, 50, 20};

Outcome plate_behind(double size, Wave wave, const Vec3& source) {
  const Scene scene = plate_scene(size, wavelength_of(wave));
  std::vector<Vec3> points = points_at(160);
  // Into the shadow of an oblique source.
  for (Vec3& p : points) p = p + 160 / -source.x * Vec3{0, -source.y, -source.z};
  std::vector<double> truth;
  for (const Vec3& p : points)
    truth.push_back(decibel(std::norm(1.0 - share_through(size, size, source, p, plate_like(wave)))));
  return worst_of(levels(scene, wave, source, points, true), truth, points);
}

/// Behind a hole whose middle lies `before` and `behind` away, N from the hole's diagonal.
Outcome hole_behind(double size, Wave wave, const Vec3& source, double behind) {
  std::vector<Vec3> points = points_at(behind);
  for (Vec3& p : points) p = p + behind / -source.x * Vec3{0, -source.y, -source.z};
  std::vector<double> truth;
  for (const Vec3& p : points)
    truth.push_back(decibel(std::norm(share_through(size, size, source, p, screen_like(wave)))));
  return worst_of(levels(screen_scene(size, wavelength_of(wave)), wave, source, points, true), truth, points,
                  *std::max_element(truth.begin(), truth.end()));
}

/// A walk away from a hole, N of its diagonal from 1 on, straight behind it and aside.
Outcome hole_fade(double size, Wave wave, double before, double farthest) {
  const Vec3 source{-before, 0.2, 0.1};
  std::vector<Vec3> points;
  std::vector<double> truth;
  for (double x = 0.5 * size * size; x < farthest; x *= 1.25)
    for (const double aside : {0.0, 0.06, 0.12}) points.push_back({x, 0.3 + aside * x, 0.2 + 0.5 * aside * x});
  for (const Vec3& p : points)
    truth.push_back(decibel(std::norm(share_through(size, size, source, p, screen_like(wave)))));
  // 40 dB: the walk itself spans 25.
  return worst_of(levels(screen_scene(size, wavelength_of(wave)), wave, source, points, true), truth, points, -20);
}

/// Before a screen: the free wave and the reflected one, less what would go through the hole, mirrored.
Outcome hole_before(double size, Wave wave) {
  const Vec3 source{-150, 20, 0};
  std::vector<Vec3> points;
  std::vector<double> truth;
  const double sign = wave == Wave::rigid ? 1 : -1;
  for (const double y : {-0.2, -0.1, -0.04, 0.03, 0.2})
    for (const double z : {0.0, 0.05, 0.15}) {
      const Vec3 p{-120, -16 + y * 120, z * 120}, mirrored{120, p.y, p.z};
      const double way = distance(source, p), back = distance(source, mirrored);
      const Complex lost = share_through(size, size, source, mirrored, screen_like(wave));
      points.push_back(p);
      truth.push_back(decibel(std::norm(1.0 + sign * (1.0 - lost) * std::polar(way / back, -k * (back - way)))));
    }
  return worst_of(levels(screen_scene(size, wavelength_of(wave)), wave, source, points, true), truth, points);
}

/// Before the plate: what it sends back is what would go through an opening, mirrored.
Outcome plate_before(double size, Wave wave) {
  const Scene scene = plate_scene(size, wavelength_of(wave));
  const Vec3 source{-150, 20, 0};
  std::vector<Vec3> points;
  std::vector<double> truth;
  for (const double y : {-0.2, -0.1, -0.04, 0.03, 0.2})
    for (const double z : {0.0, 0.05, 0.15}) {
      const Vec3 p{-120, -16 + y * 120, z * 120}, mirrored{120, p.y, p.z};
      const double way = distance(source, p), back = distance(source, mirrored);
      const Complex sent =
          share_through(size, size, source, mirrored, plate_like(wave)) * std::polar(way / back, -k * (back - way));
      // A conductor turns the field along the plate round.
      points.push_back(p);
      truth.push_back(decibel(std::norm(1.0 + (wave == Wave::rigid ? 1.0 : -1.0) * sent)));
    }
  return worst_of(levels(scene, wave, source, points, true), truth, points);
}

/// Behind a box: the silhouette that a source on its axis sees is its front.
Outcome box_behind(double size, double depth, Wave wave) {
  const Scene scene = closed_scene(size, depth, wavelength_of(wave));
  const std::vector<Vec3> points = points_at(160);
  std::vector<double> truth;
  for (const Vec3& p : points) truth.push_back(decibel(std::norm(1.0 - share_through(size, size, on_axis, p, black))));
  return worst_of(levels(scene, wave, on_axis, points, true), truth, points);
}

/// The largest step of the level on a straight way: between points of the whole way, then ten times as near wherever it
/// was largest, twice. A slope becomes a hundredth, a jump stays.
Outcome largest_step(const Scene& scene, Wave wave, const Vec3& source, const Vec3& from, const Vec3& to, int depth) {
  constexpr int points = 240, parts = 10, places = 6;
  struct Step {
    double from, to, size;
  };
  std::vector<Step> steps;
  bool nothing = false;
  const auto add = [&](const std::vector<double>& shares, std::size_t run) {
    std::vector<Vec3> places_there;
    for (const double share : shares) places_there.push_back(from + share * (to - from));
    const std::vector<double> level = levels(scene, wave, source, places_there, false, depth);
    for (std::size_t i = 1; i < shares.size(); ++i)
      if (i % run != 0) steps.push_back({shares[i - 1], shares[i], std::abs(level[i] - level[i - 1])});
    for (const double one : level) nothing = nothing || !std::isfinite(one);
  };
  std::vector<double> shares;
  for (int i = 0; i < points; ++i) shares.push_back((i + 0.37) / points);
  add(shares, shares.size());
  for (int turn = 0; turn < 2; ++turn) {
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.size > b.size; });
    steps.resize(places);
    shares.clear();
    for (const Step& step : steps)
      for (int i = 0; i <= parts; ++i) shares.push_back(step.from + (step.to - step.from) * i / parts);
    steps.clear();
    add(shares, parts + 1);
  }
  const Step worst = *std::max_element(steps.begin(), steps.end(), [](auto& a, auto& b) { return a.size < b.size; });
  const Vec3 place = from + worst.from * (to - from);
  if (nothing) return {std::numeric_limits<double>::infinity(), "nothing arrives at some place", {}};
  return {worst.size, fmt::format("at ({:.2f}, {:.2f}, {:.2f}) wavelengths", place.x, place.y, place.z), {}};
}

/// A walk away from a plate or box through its shadow, N from 1 to 0.05: the fade from edges to the whole, against
/// Kirchhoff.
Outcome fade(double size, double thick, Wave wave) {
  const double unit = wavelength_of(wave);
  const Scene scene = thick > 0 ? closed_scene(size, thick, unit) : plate_scene(size, unit);
  std::vector<Vec3> points;
  std::vector<double> truth;
  for (double x = thick > 0 ? 18 : 12; x < 300; x *= 1.12)
    for (const double aside : {0.0, 0.06}) points.push_back({x, 0.3 + aside * x, 0.2 + 0.5 * aside * x});
  for (const Vec3& p : points)
    truth.push_back(decibel(std::norm(1.0 - share_through(size, size, on_axis, p, plate_like(wave)))));
  return worst_of(levels(scene, wave, on_axis, points, true), truth, points);
}

/// The wave that the object itself sends on: all fields less the free wave, over the largest of the truth; largest
/// error where the truth is above 0.3 of that.
Outcome sent_on(const Scene& scene, double size, Wave wave, const Vec3& source) {
  PlanDescription plan = plan_for(wave);
  const double wavelength = wavelength_of(plan);
  plan.transmitters[0].position = wavelength * source;
  std::vector<Complex> truth;
  std::vector<Vec3> points;
  for (const Vec3& p : points_at(160)) {
    points.push_back(p + 160 / -source.x * Vec3{0, -source.y, -source.z});
    add_receiver(plan, wavelength * points.back());
    truth.push_back(-share_through(size, size, source, points.back(), plate_like(wave)));
  }
  const Result result = run_engine(scene, plan);
  double top = 0, largest = 0;
  for (const Complex& one : truth) top = std::max(top, std::abs(one));
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(truth[i]) < 0.3 * top) continue;
    Complex sum = 0;
    for (const PathStory& path : result.profiles[i].paths[0]) sum += path.amplitude[0];
    const double way = distance(source, points[i]);
    const double free = std::sqrt(free_gain(plan, wavelength * source, wavelength * points[i]));
    largest = std::max(largest, std::abs(sum / std::polar(free, -k * way) - 1.0 - truth[i]) / top);
    ++count;
  }
  return {largest, fmt::format("{} points, largest of the truth {:.3f} of the free wave", count, top), {}};
}

/// A plate of 3 by 3 wavelengths in x = 0 and behind it, in x = 60, a screen up to z = 0: above it a receiver sees the
/// plate, below both stand in its way.
Scene plate_and_screen(double unit) {
  SceneDescription scene = upright_plate(3 * unit, 3 * unit);
  MeshDescription screen{"screen", "", "metal", {}, {}, {}};
  append_sheet({-90 * unit, 90 * unit}, {-60 * unit, 0}, {60 * unit, 0, 0}, {0, 1, 0}, {0, 0, 1},
               {true, true, true, false}, screen);
  scene.meshes.push_back(std::move(screen));
  return scene_of(scene, perfect_faces());
}

/// Behind a box that stands on rigid ground, against the box and its mirror image in free space, both ends' images
/// too.
Outcome box_on_ground(double wide, double high, double deep) {
  const double unit = wavelength_of(Wave::rigid);
  SceneDescription scene = closed_box({0, -0.5 * wide * unit, 0}, {deep * unit, 0.5 * wide * unit, high * unit});
  scene.meshes.push_back(ground_sheet({-200 * unit, -200 * unit}, {250 * unit, 200 * unit}, "metal"));
  const Vec3 source{-100, 0.2, 3};
  std::vector<Vec3> points;
  std::vector<double> truth;
  for (const double y : {0.0, 0.06, 0.17, 0.31})
    for (const double z : {0.5, 2.0, 6.0, 12.0}) points.push_back({110, y * 110, z});
  for (const Vec3& p : points) {
    const Vec3 image{source.x, source.y, -source.z};
    const double way = distance(source, p), back = distance(image, p);
    const Complex direct = 1.0 - share_through(wide, 2 * high, source, p, black);
    const Complex reflected = 1.0 - share_through(wide, 2 * high, image, p, black);
    truth.push_back(decibel(std::norm(direct + reflected * std::polar(way / back, -k * (back - way)))));
  }
  return worst_of(levels(scene_of(scene, perfect_faces()), Wave::rigid, source, points, true, 3), truth, points);
}

enum class Shape { plate, box, hole };

/// Ends exchanged: fields of all paths, sound.
Outcome exchanged(Shape shape) {
  const Wave wave = Wave::rigid;
  const double unit = wavelength_of(wave);
  const Scene scene = scene_of(shape == Shape::box    ? closed_box({0, -unit, -unit}, {1.5 * unit, unit, unit})
                               : shape == Shape::hole ? upright_screen_with_hole(120 * unit, 3 * unit, 2 * unit)
                                                      : upright_plate(3 * unit, 2 * unit),
                               perfect_faces());
  double largest = 0;
  for (const Vec3& a : {Vec3{-70, 4, 9}, Vec3{-60, 20, -30}})
    for (const Vec3& b : {Vec3{75, -3, 2}, Vec3{90, -15, 22}, Vec3{-80, -35, 41}})
      largest =
          std::max(largest, std::abs(levels(scene, wave, a, {b}, true)[0] - levels(scene, wave, b, {a}, true)[0]));
  return {largest, "", {}};
}

const char* name_of(Wave wave) { return wave == Wave::rigid ? "rigid" : "metal"; }
double goal(Wave wave) { return wave == Wave::rigid ? 1 : 0.5; }
const char* reason(Wave wave) { return wave == Wave::rigid ? "the goal for sound" : "the goal for radio"; }

}  // namespace

Cases auto_cases() {
  Cases cases;
  constexpr const char* integral = "Kirchhoff's integral";
  for (const Wave wave : {Wave::metal, Wave::rigid}) {
    for (const double size : {2.0, 3.5}) {
      cases.push_back(
          {fmt::format("auto/plate/{:g}/{}", size, name_of(wave)),
           fmt::format("engine behind a plate of {0:g} by {0:g} wavelengths: largest |error of level|", size), integral,
           "dB", goal(wave), reason(wave), 0, [=] { return plate_behind(size, wave, on_axis); }});
      cases.push_back({fmt::format("auto/plate/{:g}/{}-oblique", size, name_of(wave)),
                       fmt::format("engine behind a plate of {0:g} by {0:g} wavelengths that stands aslant: largest "
                                   "|error of level|",
                                   size),
                       integral, "dB", goal(wave), reason(wave), 0, [=] { return plate_behind(size, wave, oblique); }});
      cases.push_back(
          {fmt::format("auto/plate/{:g}/{}-before", size, name_of(wave)),
           fmt::format("engine before a plate of {0:g} by {0:g} wavelengths: largest |error of level|", size), integral,
           "dB", goal(wave), reason(wave), 0, [=] { return plate_before(size, wave); }});
    }
    cases.push_back({fmt::format("auto/box/{}", name_of(wave)),
                     "engine behind a box of 3 by 3 by 2 wavelengths: largest |error of level|", integral, "dB",
                     goal(wave), reason(wave), 0, [=] { return box_behind(3, 2, wave); }});
    struct Hole {
      double size, before, behind;
    };
    for (const Hole& hole : {Hole{3, 150, 160}, Hole{3, 400, 500}, Hole{6, 400, 400}, Hole{4, 100, 300}}) {
      const Vec3 straight{-hole.before, 0.2, 0.1}, aslant{-hole.before, 0.3 * hole.before, 0.13 * hole.before};
      for (const bool tilted : {false, true})
        cases.push_back({fmt::format("auto/opening/{:g}-{:g}/{}{}", hole.size, hole.behind, name_of(wave),
                                     tilted ? "-oblique" : ""),
                         fmt::format("engine behind a hole of {0:g} by {0:g} wavelengths in a screen{1}, to 20 dB "
                                     "below its axis: largest |error of level|",
                                     hole.size, tilted ? " that stands aslant" : ""),
                         integral, "dB", goal(wave), reason(wave), 0,
                         [=] { return hole_behind(hole.size, wave, tilted ? aslant : straight, hole.behind); }});
    }
    for (const Hole& hole : {Hole{3, 150, 600}, Hole{6, 900, 2000}})
      cases.push_back({fmt::format("auto/fade-of-an-opening/{:g}/{}", hole.size, name_of(wave)),
                       fmt::format("engine behind a hole of {0:g} by {0:g} wavelengths, away from it: largest |error "
                                   "of level|",
                                   hole.size),
                       integral, "dB", std::max(goal(wave), 0.6),
                       "the goals; 0.6 dB at N = 1, where it is the edges alone: what the validity map says of them", 0,
                       [=] { return hole_fade(hole.size, wave, hole.before, hole.behind); }});
    cases.push_back({fmt::format("auto/opening/3/{}-before", name_of(wave)),
                     "engine before a screen with a hole of 3 by 3 wavelengths: largest |error of level|", integral,
                     "dB", goal(wave), reason(wave), 0, [=] { return hole_before(3, wave); }});
    for (const bool box : {false, true})
      cases.push_back(
          {fmt::format("auto/sent-on/{}/{}", box ? "box" : "plate", name_of(wave)),
           fmt::format("engine, wave that a {} sends on, over its largest: largest error where it is above "
                       "0.3",
                       box ? "box of 3 by 3 by 2 wavelengths" : "plate of 3.5 by 3.5 wavelengths"),
           integral, "1", box ? 0.12 : 0.04,
           box ? "pi N/2 = 0.11 of the phase between the outlines of front and back"
               : "the far field leaves (1/2) pi N = 0.12 of the phase, its mean is taken; a third of it for its spread",
           0, [=] {
             const double unit = wavelength_of(wave);
             return box ? sent_on(closed_scene(3, 2, unit), 3, wave, on_axis)
                        : sent_on(plate_scene(3.5, unit), 3.5, wave, oblique);
           }});
    cases.push_back(
        {fmt::format("auto/fade-of-a-box/{}", name_of(wave)),
         "engine in the shadow of a box of 3 by 3 by 2 wavelengths, from N = 0.36 to 0.06: largest |error of "
         "level|",
         integral, "dB", goal(wave), reason(wave), 0, [=] { return fade(3, 2, wave); }});
    cases.push_back({fmt::format("auto/fade/{}", name_of(wave)),
                     "engine in the shadow of a plate of 3.5 by 3.5 wavelengths, from N = 1 to 0.1: largest "
                     "|error of level|",
                     integral, "dB", goal(wave), reason(wave), 0, [=] { return fade(3.5, 0, wave); }});
    struct Walk {
      const char* name;
      const char* words;
      double size, thick;  ///< of a plate or a hole, or of a box
      Vec3 source, from, to;
      int depth;
      bool hole = false;
    };
    const Walk walks[] = {
        {"away",
         "away from a plate through its shadow, from edges to the whole",
         3.5,
         0,
         on_axis,
         {12, 0.4, 0.3},
         {250, 0.4, 0.3},
         2},
        {"aside", "behind a small plate, out of its shadow", 3, 0, on_axis, {120, 0.3, 0.2}, {120, 40, 9}, 2},
        {"before", "before a small plate, over its reflection", 3, 0, {-150, 20, 0}, {-120, -50, 3}, {-120, 20, 3}, 2},
        {"around", "past a small box", 2, 1.5, {-70, 0, 0}, {90, -60, 5}, {90, 30, -7}, 2},
        {"beside",
         "in the shadow of a box, from long edges to short ones",
         10,
         10,
         {-100, 12, 2},
         {20, 3, 1.5},
         {140, -4.6, 1.5},
         1},
        {"away-from-a-hole",
         "away from a hole in a screen, from edges to the whole",
         3,
         0,
         on_axis,
         {3, 0.4, 0.3},
         {250, 0.4, 0.3},
         2,
         true},
        {"aside-of-a-hole",
         "behind a small hole in a screen, out of what goes straight through",
         3,
         0,
         on_axis,
         {120, 0.3, 0.2},
         {120, 40, 39},
         2,
         true},
        {"before-a-hole",
         "before a screen with a small hole, over where its reflection is missing",
         3,
         0,
         {-150, 20, 0},
         {-120, -50, 3},
         {-120, 20, 3},
         2,
         true},
    };
    for (const Walk& walk : walks)
      cases.push_back({fmt::format("auto/walk/{}/{}", walk.name, name_of(wave)),
                       fmt::format("engine, {}: largest step of the level where a slope would be gone", walk.words),
                       "continuity", "dB", 0.5, "the goal of a level without steps", 0, [=] {
                         const double unit = wavelength_of(wave);
                         const Scene scene = walk.hole        ? screen_scene(walk.size, unit)
                                             : walk.thick > 0 ? closed_scene(walk.size, walk.thick, unit)
                                                              : plate_scene(walk.size, unit);
                         return largest_step(scene, wave, walk.source, walk.from, walk.to, walk.depth);
                       }});
  }
  cases.push_back({"auto/box-on-the-ground",
                   "engine, fields of all paths behind a box of 2 by 1 by 1 wavelengths that stands on rigid ground: "
                   "largest |error of level|",
                   "Kirchhoff's integral with the mirror image", "dB", 3.5,
                   "a fact: what stands on something is no whole; its edges alone err behind it as those of a free box "
                   "do; 2.5 dB measured",
                   1, [] { return box_on_ground(2, 1, 1); }});
  cases.push_back({"auto/walk/plate-and-screen",
                   "engine, out of the shadow of a screen between it and a small plate in the same leg: largest step "
                   "of the level where a slope would be gone",
                   "continuity", "dB", 0.5, "the goal of a level without steps", 0, [] {
                     return largest_step(plate_and_screen(wavelength_of(Wave::metal)), Wave::metal, {-150, 0.2, 1.1},
                                         {180, 0.4, -25}, {180, 0.4, 30}, 2);
                   }});
  for (const auto& [name, shape] : {std::pair{"plate", Shape::plate}, {"box", Shape::box}, {"opening", Shape::hole}})
    cases.push_back({fmt::format("auto/exchange/{}", name),
                     "engine, ends exchanged past a small object: largest difference of level", "reciprocity", "dB",
                     1e-6, "rounding; phases of 1e4 rad", 0, [=, shape = shape] { return exchanged(shape); }});
  return cases;
}

}  // namespace grimaldi
