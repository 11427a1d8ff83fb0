// A strip, a slit and a rectangular plate in the engine, against integrals and boundary elements.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/constants.h"
#include "validation/boundary_elements.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"
#include "validation/cases/thin_screens.h"
#include "validation/hankel.h"
#include "validation/quadrature.h"
#include "validation/rayleigh_sommerfeld.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Point = PolygonBody::Point;  // (x, z), wavelengths; the screen lies in x = 0
constexpr double k = 2 * pi;

constexpr const char* screen_names[] = {"strip", "slit"};

/// Which faces the screen has, and which wave meets them.
enum class Face { black, soft, hard, rigid };
constexpr const char* face_names[] = {"black", "soft", "hard", "sound"};

/// What a line source sends through the slit |z| < width/2 of a black screen, Kirchhoff's integral (the mean of
/// Rayleigh and Sommerfeld's two): ∫ (u_i ∂G/∂x' − G ∂u_i/∂x') dz'.
Complex through_slit(double width, const Point& source, const Point& to) {
  const auto integrand = [&](double z) {
    const double rs = std::hypot(source.x, z - source.y), r = std::hypot(to.x, to.y - z);
    const HankelPair in = hankel2_pair(k * rs), out = hankel2_pair(k * r);
    const Complex field{0, -0.25};
    return field * Complex(0, -0.25 * k) * (in.zero * out.one * to.x / r - out.zero * in.one * source.x / rs);
  };
  return integrate(integrand, -width / 2, width / 2, 1e-10, 2 + static_cast<int>(width)).value;
}

/// The level of a row, dB.
double truth_of(const ThinScreenRow& row, Face face) {
  if (face != Face::black) return face == Face::soft ? row.soft : row.hard;
  const Point source{-40, row.zs}, to{row.x, row.z};
  const Complex share = through_slit(row.width, source, to) / line_source_free_field(k, source, to);
  return decibel(std::norm(row.screen == Screen::slit ? share : 1.0 - share));
}

/// Errors of the level where the truth lies above the floor (dB over the free field).
struct Errors {
  double floor = -20;
  std::vector<double> all;
  double largest = -1;
  std::string worst;
  void add(double here, double truth, const std::string& where) {
    if (truth < floor) return;
    all.push_back(std::abs(here - truth));
    if (!(all.back() <= largest))
      largest = all.back(), worst = fmt::format("{}: {:.2f} dB, truth {:.2f} dB", where, here, truth);
  }
  Outcome outcome() {
    std::sort(all.begin(), all.end());
    return {largest, fmt::format("median {:.2f} dB of {}; largest at {}", all[all.size() / 2], all.size(), worst), {}};
  }
};

PlanDescription plan_for(Face face, DiffractionModel model) {
  const bool sound = face == Face::rigid;
  PlanDescription plan = point_to_point(sound ? WaveKind::acoustic : WaveKind::radio, sound ? 1000 : 1e9, {}, 2e4);
  // Edges run across the plane of source and receivers: horizontal polarisation is soft, vertical hard.
  plan.transmitters[0].antenna.polarisation = face == Face::soft ? Polarisation::horizontal : Polarisation::vertical;
  plan.reflection = face != Face::black;
  plan.diffraction_model = model;
  plan.depth = 2;
  return plan;
}

Outcome long_screen(Screen screen, double width, Face face, DiffractionModel model) {
  PlanDescription plan = plan_for(face, model);
  const double wavelength = wavelength_of(plan);
  const Scene scene =
      scene_of(scene_description(screen_names[int(screen)], {{"width", width * wavelength}}), perfect_faces());
  const auto place = [&](double x, double z) { return Vec3{x * wavelength, 0, z * wavelength}; };
  Errors errors;
  for (const double zs : {0.0, 9.0}) {
    plan.transmitters[0].position = place(-40, zs);
    plan.receivers.clear();
    std::vector<ThinScreenRow> rows;
    for (const ThinScreenRow& row : thin_screens)
      if (row.screen == screen && row.width == width && row.zs == zs) rows.push_back(row);
    for (const ThinScreenRow& row : rows) add_receiver(plan, place(row.x, row.z));
    const Result result = run_engine(scene, plan);
    for (std::size_t i = 0; i < rows.size(); ++i)
      errors.add(
          decibel(result.profiles[i].total_coherent[0] / free_gain(plan, place(-40, zs), place(rows[i].x, rows[i].z))),
          truth_of(rows[i], face), fmt::format("(-40, {:g}) to ({:g}, {:g})", zs, rows[i].x, rows[i].z));
  }
  return errors.outcome();
}

/// Behind a plate of `width` × 0.6 `width`, the source on its axis: the free wave less what would go through an opening
/// of its shape.
Outcome plate(double width, Face face, DiffractionModel model) {
  PlanDescription plan = plan_for(face, model);
  const double wavelength = wavelength_of(plan), before = 60;
  const Scene scene = scene_of(upright_plate(width * wavelength, 0.6 * width * wavelength), perfect_faces());
  plan.transmitters[0].position = {-before * wavelength, 0, 0};
  Aperture opening;
  opening.loops = {
      {{-width / 2, -0.3 * width}, {width / 2, -0.3 * width}, {width / 2, 0.3 * width}, {-width / 2, 0.3 * width}}};
  std::vector<Vec3> points;  // x and y on the plate, z behind it; wavelengths
  // Near behind it the images in a conducting plate count, which a black one has not.
  const std::vector<double> depths = face == Face::black ? std::vector{15.0, 60.0} : std::vector{60.0, 120.0};
  for (const double z : depths)
    for (const double x : {0.0, 0.23, 0.51, 0.83})
      for (const double y : {0.0, 0.17, 0.33, 0.61})
        points.push_back({x * (width + 0.05 * z), y * (width + 0.05 * z), z});
  for (const Vec3& p : points) add_receiver(plan, wavelength * Vec3{p.z, p.x, p.y});
  const Result result = run_engine(scene, plan);
  // Nor is a conducting plate a black one deep in its shadow.
  Errors errors;
  if (face != Face::black) errors.floor = -10;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto incident = [&](double x, double y) {
      const double way = std::sqrt(x * x + y * y + before * before);
      return std::polar(1 / way, -k * (way - before));
    };
    const auto tilted = [&](double x, double y) {
      return incident(x, y) * (before / std::sqrt(x * x + y * y + before * before));
    };
    // Kirchhoff: the mean of the two integrals. Phases count from the source's distance.
    const Complex share = 0.5 * (rayleigh_sommerfeld_direct(opening, k, points[i], incident) +
                                 rayleigh_sommerfeld_direct(opening, k, points[i], tilted, RayleighSommerfeld::second));
    const Vec3 way{points[i].x, points[i].y, points[i].z + before};
    const Complex free = std::polar(1 / norm(way), -k * (norm(way) - before));
    errors.add(decibel(result.profiles[i].total_coherent[0] /
                       free_gain(plan, plan.transmitters[0].position, plan.receivers[i].position)),
               decibel(std::norm(1.0 - share / free)),
               fmt::format("({:.1f}, {:.1f}) at {:g} behind", points[i].x, points[i].y, points[i].z));
  }
  return errors.outcome();
}

/// The bounds of this suite, dB.
struct Bound {
  double tolerance;
  const char* reason;
};
Bound goal(Face face) {
  return face == Face::rigid ? Bound{1, "the goal for sound"} : Bound{0.5, "the goal for radio"};
}
const char* model_name(DiffractionModel model) { return model == DiffractionModel::utd ? "utd" : "fsd"; }

}  // namespace

Cases screen_cases() {
  Cases cases;
  constexpr DiffractionModel models[] = {DiffractionModel::fsd, DiffractionModel::utd};
  for (const Screen screen : {Screen::strip, Screen::slit})
    for (const double width : {3.0, 10.0})
      for (const Face face : {Face::black, Face::soft, Face::hard, Face::rigid})
        for (const DiffractionModel model : models) {
          if (face == Face::black && model == DiffractionModel::utd) continue;  // its faces are always on
          const Bound bound = goal(face);
          cases.push_back({fmt::format("screens/{}/{:g}/{}/{}", screen_names[int(screen)], width, face_names[int(face)],
                                       model_name(model)),
                           fmt::format("engine behind a {} of {:g} wavelengths: largest |error of level| above -20 dB",
                                       screen_names[int(screen)], width),
                           face == Face::black ? "Kirchhoff's integral" : "boundary elements", "dB", bound.tolerance,
                           bound.reason, 0, [=] { return long_screen(screen, width, face, model); }});
        }
  for (const double width : {4.0, 12.0}) {
    const std::string shape = fmt::format("a plate of {:g} by {:g} wavelengths", width, 0.6 * width);
    cases.push_back({fmt::format("screens/plate/{:g}/fsd", width),
                     "engine behind " + shape + ": largest |error of level| above -20 dB", "Kirchhoff's integral", "dB",
                     0.5, "the goal for radio", 0, [=] { return plate(width, Face::black, DiffractionModel::fsd); }});
    for (const DiffractionModel model : models)
      cases.push_back(
          {fmt::format("screens/plate/{:g}/metal-{}", width, model_name(model)),
           "engine behind " + shape + ", metal: largest |error of level| above -10 dB", "Kirchhoff's integral", "dB", 1,
           "0.5 dB, and what the images in the metal bring, which the integral leaves out: 0.5 dB where the "
           "waves of four edges nearly cancel",
           0, [=] { return plate(width, Face::hard, model); }});
  }
  return cases;
}

}  // namespace grimaldi
