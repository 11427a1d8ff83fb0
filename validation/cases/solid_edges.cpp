// Solid edges in the engine: wedges against the exact field.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/families.h"
#include "validation/wedge_series.h"

namespace grimaldi {
namespace {

/// A wedge with its edge on the horizon of source and receivers: 1 GHz, 100 m on either side; `depths` = degrees into
/// the shadow, those inside the solid left out.
Outcome wedge_in_the_engine(double interior, bool soft, const std::vector<double>& depths,
                            DiffractionModel model = DiffractionModel::fsd) {
  const Scene scene = scene_of(scene_description("wedge", {{"interior_angle", interior}}), perfect_faces());
  PlanDescription plan = point_to_point(WaveKind::radio, 1e9, {-100, 0, 0}, 5e4);
  plan.transmitters[0].antenna.polarisation = soft ? Polarisation::horizontal : Polarisation::vertical;
  plan.diffraction_model = model;
  std::vector<double> used;
  for (const double depth : depths)
    if (depth < 85 - interior / 2) {
      used.push_back(depth);
      add_receiver(plan, {100, 0, -100 * std::tan(depth * pi / 180)});
    }
  const Result result = run_engine(scene, plan);
  Outcome outcome;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Vec3& rx = plan.receivers[i].position;
    // Azimuths from the lit face, which hangs interior/2 to the left of straight down.
    const double in = (90 - interior / 2) * pi / 180, out = in + pi + used[i] * pi / 180;
    const WedgeField exact = wedge_point_source(2 - interior / 180, 2 * pi / wavelength_of(plan), {100, in, 0},
                                                {std::hypot(rx.x, rx.z), out, 0});
    const Vec3& tx = plan.transmitters[0].position;
    const double truth = decibel(std::norm(soft ? exact.soft : exact.hard) * std::pow(distance(tx, rx), 2));
    const double here = decibel(result.profiles[i].total[0] / free_gain(plan, tx, rx));
    outcome.error = std::max(outcome.error, std::abs(here - truth));
    outcome.note += fmt::format("{}{:g} degrees: {:.2f} dB, exact {:.2f} dB", i == 0 ? "" : "; ", used[i], here, truth);
  }
  return outcome;
}

}  // namespace

Cases engine_wedge_cases() {
  Cases cases;
  const char* exact = "exact field of a point source";
  for (const double interior : {30.0, 60.0, 90.0, 135.0})
    cases.push_back({fmt::format("wedges/engine/{:g}/hard", 360 - interior),
                     "engine behind a hard wedge (fsd), 2 to 50 degrees into the shadow: largest |error of level|",
                     exact, "dB", 1.7, "weights of the three black edges at n < 2", 0, [=] {
                       return wedge_in_the_engine(interior, false, {2, 5, 10, 20, 30, 50});
                     }});
  for (const double interior : {30.0, 60.0, 90.0, 135.0})
    cases.push_back({fmt::format("wedges/engine/{:g}/soft", 360 - interior),
                     "engine behind a soft wedge (fsd), 2 to 20 degrees into the shadow: largest |error of level|",
                     exact, "dB", 3.0, "the three black edges do not vanish on the face: the deeper the worse", 0, [=] {
                       return wedge_in_the_engine(interior, true, {2, 5, 10, 20});
                     }});
  for (const double interior : {30.0, 60.0, 90.0})
    cases.push_back({fmt::format("wedges/engine/{:g}/soft-deep", 360 - interior),
                     "engine behind a soft wedge (fsd), 30 and 50 degrees into the shadow: largest |error of level|",
                     exact, "dB", 30,
                     "a fact: near its face the soft field vanishes, its three terms do not; UTD is for that", 2, [=] {
                       return wedge_in_the_engine(interior, true, {30, 50});
                     }});
  for (const double interior : {30.0, 60.0, 90.0, 135.0})
    for (const bool soft : {false, true})
      cases.push_back({fmt::format("wedges/engine/{:g}/utd-{}", 360 - interior, soft ? "soft" : "hard"),
                       "engine behind a wedge (utd), 2 to 50 degrees into the shadow: largest |error of level|", exact,
                       "dB", 0.1, "what UTD leaves out falls as 1/kL, kL = 1000; the ends of the edge are 2 km away", 0,
                       [=] {
                         return wedge_in_the_engine(interior, soft, {2, 5, 10, 20, 30, 50}, DiffractionModel::utd);
                       }});
  return cases;
}

}  // namespace grimaldi
