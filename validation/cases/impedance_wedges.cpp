// Wedges of finite conductivity in the engine against the exact diffraction coefficient of impedance faces.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "propagation/laws/utd.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"
#include "validation/impedance_wedge.h"

namespace grimaldi {
namespace {

constexpr double degree = pi / 180;
constexpr double leg = 100, frequency = 1e10;  // m, Hz
constexpr double permittivity = 30;
constexpr double least_v = 3;  // of every boundary, so that the coefficient is Keller's

enum class Polarised { te, tm };  // E along the edge, H along the edge
constexpr Polarised polarisations[] = {Polarised::te, Polarised::tm};
constexpr const char* polarisation_names[] = {"te", "tm"};

enum class Place { shadow, near_face, elsewhere };
constexpr Place places[] = {Place::shadow, Place::near_face, Place::elsewhere};
constexpr const char* place_names[] = {"shadow", "near-a-face", "elsewhere"};
constexpr const char* place_words[] = {"in the shadow", "in the light, an end within 10 degrees of a face",
                                       "in the light, both ends farther from the faces"};

/// Normalised admittance of a half-space of that permittivity at grazing incidence, or straight at it.
double admittance(Polarised polarised, bool grazing) {
  const double root = std::sqrt(grazing ? permittivity - 1 : permittivity);
  return polarised == Polarised::te ? root : root / permittivity;
}

MaterialChoice half_space() {
  Material material;
  material.permittivity = Spectrum{{frequency}, {permittivity}};
  material.conductivity = Spectrum{{frequency}, {0}};
  material.thickness = std::numeric_limits<double>::infinity();
  MaterialChoice choice;
  choice.replace = {{"*", "half-space"}};
  choice.overrides = {{"half-space", material}};
  return choice;
}

/// What is held against the exact coefficient.
enum class Rule { utd, fsd, mean, other_admittance };
constexpr std::size_t rules = 4;

/// Errors of level (dB, with sign) of all rules at one pair of directions.
struct Compared {
  double in, out;
  Place place;
  std::array<double, rules> error;
};

Place place_of(double n, double in, double out) {
  const auto from_a_face = [&](double angle) { return std::min(angle, n * pi - angle); };
  if (std::abs(in - out) > pi) return Place::shadow;
  return std::min(from_a_face(in), from_a_face(out)) < 10 * degree ? Place::near_face : Place::elsewhere;
}

bool near_boundary(double n, double wavenumber, double in, double out) {
  for (const double turn : wedge_turns(n * pi, in, out))
    if (std::sqrt(8 * wavenumber * leg / 2 / (2 * pi)) * std::abs(std::sin(turn / 2)) < least_v) return true;
  return false;
}

/// The coefficient with the plain mean of each face's reflection coefficients for the way there and the way back.
std::complex<double> with_mean(double n, double beta, double wavenumber, double in, double out) {
  const auto reflected = [&](double a, double b) {
    const auto r = [&](double angle) {
      const double c = std::abs(std::sin(angle));
      return (c - beta) / (c + beta);
    };
    return 0.5 * (r(a) + r(b));
  };
  const double l = leg / 2;
  return utd_coefficients(n * pi, in, out, 1, wavenumber, {l, l, l, l})
      .with_faces(reflected(in, out), reflected(n * pi - in, n * pi - out));
}

/// Amplitude of the path over the edge alone.
double edge_amplitude(const ReceiverProfile& profile, std::size_t transmitter, Polarised polarised) {
  for (const PathStory& path : profile.paths[transmitter])
    if (path.interactions.starts_with("D:")) return std::abs(path.amplitude[polarised == Polarised::te ? 0 : 1]);
  throw std::runtime_error("a receiver without the path over the edge");
}

std::vector<Compared> compared(double n, Polarised polarised) {
  const auto at = [](double angle) { return Vec3{leg * std::cos(angle), leg * std::sin(angle), 0}; };
  const Scene scene = scene_of(upright_wedge(n, 1000, 1000), half_space());
  PlanDescription plan = point_to_point(WaveKind::radio, frequency, at(1), 2e4);
  plan.transmitters[0].antenna.polarisation =
      polarised == Polarised::te ? Polarisation::vertical : Polarisation::horizontal;
  // By symmetry sources before one face suffice.
  std::vector<double> sources, receivers;
  for (const double in : {3, 6, 12, 20, 35, 50, 70, 95, 120, 150, 175})
    if (in < 90 * n) sources.push_back(in * degree);
  for (double out = 3; out < 180 * n - 2.9; out += 6) receivers.push_back(out * degree);
  for (std::size_t t = 0; t < sources.size(); ++t) {
    if (t > 0) plan.transmitters.push_back(plan.transmitters[0]);
    plan.transmitters[t].name = fmt::format("t{}", t);
    plan.transmitters[t].position = at(sources[t]);
  }
  for (const double out : receivers) add_receiver(plan, at(out));
  plan.diffraction_model = DiffractionModel::utd;
  const Result utd = run_engine(scene, plan);
  plan.diffraction_model = DiffractionModel::fsd;
  const Result fsd = run_engine(scene, plan);

  const double wavelength = wavelength_of(plan), wavenumber = 2 * pi / wavelength;
  // |D| of a path's amplitude (λ/4π) |D| / √(s s' (s + s')), and of a coefficient without unit.
  const double from_amplitude = 4 * pi / wavelength * std::sqrt(2 * leg * leg * leg);
  const double from_keller = 1 / std::sqrt(2 * pi * wavenumber);
  const double beta = admittance(polarised, true);
  const ImpedanceWedge exact(n, beta), other(n, admittance(polarised, false));
  std::vector<Compared> list;
  for (std::size_t t = 0; t < sources.size(); ++t)
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const double in = sources[t], out = receivers[r];
      if (near_boundary(n, wavenumber, in, out)) continue;
      const double truth = std::abs(exact.coefficient(in, out)) * from_keller;
      const auto error = [&](double coefficient) { return 20 * std::log10(coefficient / truth); };
      list.push_back({in,
                      out,
                      place_of(n, in, out),
                      {error(edge_amplitude(utd.profiles[r], t, polarised) * from_amplitude),
                       error(edge_amplitude(fsd.profiles[r], t, polarised) * from_amplitude),
                       error(std::abs(with_mean(n, beta, wavenumber, in, out))),
                       error(std::abs(other.coefficient(in, out)) * from_keller)}});
    }
  return list;
}

/// One wedge and polarisation, run once for all cases.
const std::vector<Compared>& once(double n, Polarised polarised) {
  static std::mutex guard;
  static std::map<std::pair<double, Polarised>, std::vector<Compared>> known;
  const std::lock_guard lock(guard);
  const auto [place, added] = known.try_emplace({n, polarised});
  if (added) place->second = compared(n, polarised);
  return place->second;
}

/// The |errors| of one rule at one place, ascending.
std::vector<double> errors_of(const std::vector<Compared>& points, Place place, Rule rule) {
  std::vector<double> errors;
  for (const Compared& one : points)
    if (one.place == place) errors.push_back(std::abs(one.error[std::size_t(rule)]));
  std::sort(errors.begin(), errors.end());
  return errors;
}

double quantile_of(const std::vector<double>& ascending, double quantile) {
  return ascending.at(std::size_t(quantile * double(ascending.size() - 1)));
}

Outcome error_of(double n, Polarised polarised, Place place, double quantile) {
  const std::vector<Compared>& points = once(n, polarised);
  const auto at = [&](Rule rule) { return quantile_of(errors_of(points, place, rule), quantile); };
  return {at(Rule::utd),
          fmt::format(
              "of {} pairs of directions; fsd {:.2f} dB, utd with the plain mean of both reflection "
              "coefficients {:.2f} dB; the half-space's admittance straight at it for that at grazing {:.2f} dB",
              errors_of(points, place, Rule::utd).size(), at(Rule::fsd), at(Rule::mean), at(Rule::other_admittance)),
          {}};
}

/// Measured, rounded up: median and ninth decile.
struct Bound {
  double n;
  Polarised polarised;
  Place place;
  double median, decile;
};
constexpr Bound bounds[] = {
    {1.5, Polarised::te, Place::shadow, 0.3, 2.8},    {1.5, Polarised::te, Place::near_face, 1.8, 11.5},
    {1.5, Polarised::te, Place::elsewhere, 0.6, 6},   {1.5, Polarised::tm, Place::shadow, 0.3, 2.6},
    {1.5, Polarised::tm, Place::near_face, 0.7, 3.7}, {1.5, Polarised::tm, Place::elsewhere, 0.6, 1.8},
    {2, Polarised::te, Place::shadow, 0.3, 2},        {2, Polarised::te, Place::near_face, 2.1, 12.5},
    {2, Polarised::te, Place::elsewhere, 1, 4.5},     {2, Polarised::tm, Place::shadow, 0.1, 1.1},
    {2, Polarised::tm, Place::near_face, 0.7, 3.6},   {2, Polarised::tm, Place::elsewhere, 0.9, 5.5},
};

}  // namespace

Cases impedance_wedge_cases() {
  Cases cases;
  for (const Bound& bound : bounds)
    for (const bool median : {true, false}) {
      const auto [n, polarised, place, middle, decile] = bound;
      cases.push_back(
          {fmt::format("wedges/engine/impedance/{:g}/{}/{}/{}", 180 * n, polarisation_names[int(polarised)],
                       place_names[int(place)], median ? "median" : "ninth-decile"),
           fmt::format("engine (utd), wave of an edge between half-spaces of permittivity 30, {}, v > 3: {} of |error "
                       "of level|",
                       place_words[int(place)], median ? "median" : "ninth decile"),
           "exact diffraction coefficient of impedance faces (Maliuzhinets)", "dB", median ? middle : decile,
           "as measured: coefficients in place of -1 and 1 are a heuristic; the admittance's own dependence on the "
           "angle costs below 0.3 dB",
           0, [n = n, polarised = polarised, place = place, median] {
             return error_of(n, polarised, place, median ? 0.5 : 0.9);
           }});
    }
  return cases;
}

}  // namespace grimaldi
