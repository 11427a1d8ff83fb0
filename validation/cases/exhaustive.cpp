// The engine's receivers against a search through all paths of two interactions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/demo_city.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/exhaustive_search.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

struct City {
  const char* name;
  const char* words;
  Vec3 transmitter;  ///< in no plane of a face: rays of single precision do not tell there what is seen
  double half;       ///< m, of the square in which the points lie
};

const std::vector<City>& cities() {
  static const std::vector<City> list = {
      {"demo-city", "a dozen random street points of the demo city", demo_city_rooftop + Vec3{0, 0, 0.37}, 200},
      {"street-canyon", "a dozen random points of a street canyon and its side streets", {-31, 3, 9.37}, 80},
  };
  return list;
}

/// The run of a city, made by whichever case asks first.
const ExhaustiveComparison& comparison(std::size_t city) {
  const auto make = [](std::size_t number) {
    const City& place = cities()[number];
    const Scene scene = scene_of(scene_description(place.name), perfect_faces());
    PlanDescription plan = point_to_point(WaveKind::radio, 3.5e9, place.transmitter, 1e6);
    plan.diffraction_model = DiffractionModel::utd;
    for (const Vec3& point : street_points(scene, place.half, 12, 1)) add_receiver(plan, point);
    return compare_with_exhaustive_search(scene, plan);
  };
  static const ExhaustiveComparison city_run = make(0), canyon_run = make(1);
  return city == 0 ? city_run : canyon_run;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Outcome class_difference(std::size_t city, std::size_t kind) {
  const auto& part = comparison(city).classes[kind];
  std::vector<double> sizes;
  for (const double d : part.difference) sizes.push_back(std::abs(d));
  Outcome outcome;
  outcome.error = median(sizes);
  outcome.note = fmt::format(
      "{} points, {} paths of {}; largest {:.3f} dB, median with sign {:.3f} dB", sizes.size(), part.engine_paths,
      part.all_paths, sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end()), median(part.difference));
  return outcome;
}

Outcome power_share(std::size_t city) {
  const auto& run = comparison(city);
  Outcome outcome;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < run.share.size(); ++i) {
    sizes.push_back(std::abs(decibel(run.share[i])));
    if (!(sizes.back() <= outcome.error) || i == 0) {
      outcome.error = sizes.back();
      const Vec3& p = run.places[i];
      outcome.note = fmt::format("largest at ({:.2f}, {:.2f}, {:g})", p.x, p.y, p.z);
    }
  }
  outcome.note += fmt::format("; median {:.4f} dB of {}", median(sizes), sizes.size());
  return outcome;
}

Outcome delay_of_the_strongest(std::size_t city) {
  const auto& run = comparison(city);
  Outcome outcome;
  outcome.error =
      double(std::count_if(run.delay.begin(), run.delay.end(), [](double d) { return std::abs(d) > 1e-12; }));
  outcome.note = fmt::format("{} points reached", run.delay.size());
  return outcome;
}

}  // namespace

Cases exhaustive_cases() {
  Cases cases;
  const char* search = "search through all faces and all pairs of edges";
  for (std::size_t c = 0; c < cities().size(); ++c) {
    const City& city = cities()[c];
    const auto add = [&](const char* what, const std::string& quantity, const char* unit, double tolerance,
                         const char* reason, const std::function<Outcome()>& run) {
      cases.push_back({fmt::format("exhaustive/{}/{}", city.name, what),
                       fmt::format("{}, perfect conductors, paths of two interactions: {}", city.words, quantity),
                       search, unit, tolerance, reason, 0, run});
    };
    constexpr const char* names[] = {"D", "R", "RR", "E", "RE", "ER", "EE"};
    for (std::size_t k = 0; k < std::size(names); ++k)
      add(names[k], "power by such paths (R face, E edge), median of the differences", "dB", 0.02,
          "weak paths are left out until 0.1 % of a point's power may be left; a weak class may be weaker by more",
          [c, k] { return class_difference(c, k); });
    add("power", "power by all paths, largest difference", "dB", 0.01,
        "0.1 % of a point's power may be left out: 0.004 dB", [c] { return power_share(c); });
    add("delay", "points where another path is the strongest", "1", 0, "the strongest path is never left out",
        [c] { return delay_of_the_strongest(c); });
  }
  return cases;
}

}  // namespace grimaldi
