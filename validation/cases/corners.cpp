// One edge in the engine, all round it, against the exact field of a point source.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/engine_shapes.h"
#include "validation/cases/families.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

enum class Face { soft, hard, rigid };
constexpr Face faces[] = {Face::soft, Face::hard, Face::rigid};
constexpr const char* face_names[] = {"soft", "hard", "sound"};

Vec3 place(const EdgePoint& p) { return {p.rho * std::cos(p.phi), p.rho * std::sin(p.phi), p.z}; }

/// One comparison: kL of the way over the edge, levels over the free field of that way, dB.
struct Compared {
  double n, k;
  EdgePoint source, receiver;
  double kl, exact, engine;
  double error() const { return std::abs(engine - exact); }
  std::string words() const {
    return fmt::format("n = {:.3g}, kL = {:.3g}, azimuths {:.0f} and {:.0f} degrees: {:.2f} dB, exact {:.2f} dB", n, kl,
                       source.phi * 180 / pi, receiver.phi * 180 / pi, engine, exact);
  }
};

/// Every source with every receiver at every wavenumber (rad/m): the field of all paths, added, against the exact one.
std::vector<Compared> compared(double n, const std::vector<double>& wavenumbers, const std::vector<EdgePoint>& sources,
                               const std::vector<EdgePoint>& receivers, Face face, DiffractionModel model) {
  const Scene scene = scene_of(upright_wedge(n, 1000, 1000), perfect_faces());
  PlanDescription plan =
      point_to_point(face == Face::rigid ? WaveKind::acoustic : WaveKind::radio, 1e9, place(sources[0]), 2e4);
  const double speed = wavelength_of(plan) * 1e9;
  plan.frequency.clear();
  for (const double k : wavenumbers) plan.frequency.push_back(k * speed / (2 * pi));
  // The edge stands upright: vertical polarisation is soft, horizontal hard.
  plan.transmitters[0].antenna.polarisation = face == Face::hard ? Polarisation::horizontal : Polarisation::vertical;
  for (std::size_t t = 0; t < sources.size(); ++t) {
    if (t > 0) plan.transmitters.push_back(plan.transmitters[0]);
    plan.transmitters[t].name = fmt::format("t{}", t);
    plan.transmitters[t].position = place(sources[t]);
  }
  plan.diffraction_model = model;
  for (const EdgePoint& receiver : receivers) add_receiver(plan, place(receiver));
  const Result result = run_engine(scene, plan);
  std::vector<Compared> list;
  for (std::size_t t = 0; t < sources.size(); ++t)
    for (std::size_t f = 0; f < wavenumbers.size(); ++f)
      for (std::size_t r = 0; r < receivers.size(); ++r) {
        const EdgePoint &a = sources[t], &b = receivers[r];
        if (distance(place(a), place(b)) < 1e-3) continue;
        const double k = wavenumbers[f], way = std::hypot(a.rho + b.rho, a.z - b.z), sine = (a.rho + b.rho) / way;
        const WedgeField field = wedge_point_source(n, k, a, b);
        const double wavelength = 2 * pi / k;
        const double air = plan.kind == WaveKind::radio ? 0 : sound_attenuation(plan.air, plan.frequency[f]);
        const double one_metre = plan.kind == WaveKind::radio ? std::pow(wavelength / (4 * pi), 2) : 1 / (4 * pi);
        list.push_back({n, k, a, b, k * a.rho * b.rho / (a.rho + b.rho) * sine,
                        decibel(std::norm(face == Face::soft ? field.soft : field.hard) * way * way),
                        decibel(result.profiles[r].total_coherent[t * wavenumbers.size() + f] / one_metre * way * way) +
                            air * way});
      }
  return list;
}

constexpr double exteriors[] = {2, 7.0 / 4, 5.0 / 3, 3.0 / 2, 4.0 / 3};

/// Distances of source and receiver from the edge, and how far apart they stand along it, m.
constexpr struct Legs {
  double source, receiver, along;
} all_legs[] = {{10, 10, 0}, {20, 12, 23}, {50, 30, 40}, {7, 100, -21}};

/// Azimuths as shares of the free angle. Those of the table of exact fields meet a shadow boundary at n = 5/3
/// (0.35 + 0.6 = 0.95); the others meet none.
constexpr double table_in[] = {0.12, 0.35}, table_out[] = {0.08, 0.30, 0.55, 0.77, 0.95};
constexpr double other_in[] = {0.117, 0.353, 0.612}, other_out[] = {0.08, 0.303, 0.551, 0.772, 0.948};

bool on_boundary(const Compared& one) {
  return std::abs(std::abs(one.source.phi - one.receiver.phi) - pi) < 1e-9 ||
         std::abs(one.source.phi + one.receiver.phi - pi) < 1e-9 ||
         std::abs(2 * one.n * pi - one.source.phi - one.receiver.phi - pi) < 1e-9;
}

/// The points of the table of exact fields (there a tenth of the size, and ten times the wavenumber).
std::vector<Compared> table_points(Face face, DiffractionModel model) {
  std::vector<Compared> list;
  for (const double n : exteriors)
    for (const auto& [rho_s, rho, z] : all_legs) {
      std::vector<EdgePoint> sources, receivers;
      for (const double share : table_in) sources.push_back({rho_s, share * n * pi, 0});
      for (const double share : table_out) receivers.push_back({rho, share * n * pi, z});
      for (const Compared& one : compared(n, {0.1, 0.9, 6}, sources, receivers, face, model)) list.push_back(one);
    }
  return list;
}

/// Each source with the receivers of all legs.
std::vector<Compared> other_points(Face face, DiffractionModel model) {
  std::vector<Compared> list;
  for (const double n : exteriors) {
    std::vector<EdgePoint> sources, receivers;
    for (const auto& [rho_s, rho, z] : all_legs) {
      for (const double share : other_in) sources.push_back({rho_s, share * n * pi, 0});
      for (const double share : other_out) receivers.push_back({rho, share * n * pi, z});
    }
    for (const Compared& one : compared(n, {0.1, 0.3, 0.9, 6}, sources, receivers, face, model)) list.push_back(one);
  }
  return list;
}

/// The points of one set and face, compared once for all cases.
const std::vector<Compared>& once(std::vector<Compared> (*points)(Face, DiffractionModel), Face face) {
  static std::mutex guard;
  static std::map<std::pair<bool, Face>, std::vector<Compared>> known;
  const std::lock_guard lock(guard);
  const auto [place, added] = known.try_emplace({points == table_points, face});
  if (added) place->second = points(face, DiffractionModel::utd);
  return place->second;
}

/// Error of those that count, above −60 dB of the free field over the edge: the share `quantile` lies below it.
Outcome error_of(const std::vector<Compared>& points, const std::function<bool(const Compared&)>& counts,
                 double quantile) {
  std::vector<const Compared*> used;
  for (const Compared& one : points)
    if (counts(one) && one.exact > -60) used.push_back(&one);
  if (used.empty()) return {NAN, "no point", {}};
  std::sort(used.begin(), used.end(), [](const Compared* a, const Compared* b) { return a->error() < b->error(); });
  const auto at = [&](double share) { return used[std::size_t(share * double(used.size() - 1))]->error(); };
  return {at(quantile),
          fmt::format("median {:.2g} dB, 99 % below {:.2g} dB of {}; largest {:.2g} dB at {}", at(0.5), at(0.99),
                      used.size(), used.back()->error(), used.back()->words()),
          {}};
}

}  // namespace

Cases engine_corner_cases() {
  Cases cases;
  const char* exact = "exact field of a point source";
  for (const Face face : faces) {
    const auto add = [&](const char* part, const char* quantity, double tolerance, double at_least, const char* reason,
                         std::function<Outcome()> run) {
      cases.push_back({fmt::format("wedges/engine/all-round/{}/utd-{}", part, face_names[int(face)]), quantity, exact,
                       "dB", tolerance, reason, at_least, std::move(run)});
    };
    add("table", "engine (utd) all round wedges of 360 to 240 degrees, points of the table: largest |error of level|",
        0.5, 0, "the goal for kL from 2; 0.4 dB measured next to two boundaries at once at kL = 5", [=] {
          return error_of(
              once(table_points, face), [](const Compared& one) { return one.kl >= 2 && !on_boundary(one); }, 1);
        });
    add("others",
        "engine (utd) all round wedges, every source with every receiver, kL from 2: |error of level| of 99 in 100",
        0.5, 0, "the goal for kL from 2; next to a null of the field no bound in dB holds", [=] {
          return error_of(
              once(other_points, face), [](const Compared& one) { return one.kl >= 2; }, 0.99);
        });
    add("near", "engine (utd) all round wedges, kL below 2: largest |error of level|", 3, 0.5,
        "a fact: what UTD leaves out grows as 1/kL", [=] {
          return error_of(
              once(other_points, face), [](const Compared& one) { return one.kl < 2; }, 1);
        });
    add("on-the-boundary",
        "engine (utd), receivers on a shadow boundary to the last bit, oblique rays, any kL: largest |error of level|",
        0.5, 0, "the goal for kL from 2; here it holds from kL = 0.5",
        [=] { return error_of(once(table_points, face), on_boundary, 1); });
  }
  return cases;
}

}  // namespace grimaldi
