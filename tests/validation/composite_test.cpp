// Which arrivals add as fields, at street points of the demo city.

#include "propagation/composite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "propagation/field.h"
#include "validation/cases/engine_run.h"
#include "validation/cases/exhaustive_search.h"

namespace grimaldi {
namespace {

/// All paths of at most two interactions to a number of points.
class Composites : public testing::Test {
 protected:
  Composites() {
    PlanDescription description = point_to_point(WaveKind::radio, 1e9, {8.5, 21, 27});
    description.depth = 2;
    description.diffraction_model = DiffractionModel::utd;
    for (const Vec3& point : street_points(scene, 60, 25, 3)) add_receiver(description, point);
    Diagnostics diagnostics;
    plan = make_plan(description, scene, tracer, diagnostics);
    diagnostics.throw_if_errors();
    const ExhaustiveSearch search(scene, tracer, description.transmitters[0].position, wavelength_of(description));
    for (const Receiver& receiver : description.receivers) paths.push_back(search.paths_to(receiver.position));
  }

  std::vector<Arrival> arrivals_at(std::size_t point) const {
    std::vector<Arrival> list;
    for (const ExhaustivePath& path : paths[point]) {
      Arrival& arrival = list.emplace_back();
      arrival.hash = hash_of(path.interactions());
      arrival.interactions = path.interactions();
      arrival.geometry = path.geometry;
      arrival.field.resize(1);
      path_field(scene, plan, plan.request.transmitters[0], arrival.interactions, arrival.geometry, arrival.field);
    }
    return list;
  }

  double interference(const std::vector<Arrival>& arrivals) const {
    double sum = 0;
    CompositeSum(scene, plan).interference(arrivals, Polarisation::vertical, {&sum, 1});
    return sum;
  }

  static double amplitude(const Arrival& arrival) { return std::abs(arrival.field[0][0]); }

  const Scene scene = scene_of(scene_description("demo-city"), perfect_faces());
  const Tracer tracer{scene};
  Plan plan;
  std::vector<std::vector<ExhaustivePath>> paths;
};

// A wave without power that others belong to may come and go: between the others nothing changes but by the fade, whose
// shares are of a whole that is 1/4000 less: 1e-3 is four times that.
TEST_F(Composites, WhatIsWeakTiesNothing) {
  int tried = 0;
  for (std::size_t point = 0; point < paths.size(); ++point) {
    const std::vector<Arrival> all = arrivals_at(point);
    if (all.size() < 3) continue;
    double power = 0, sum = 0;
    for (const Arrival& arrival : all) power += amplitude(arrival) * amplitude(arrival), sum += amplitude(arrival);
    const double whole = interference(all);
    for (std::size_t i = 0; i < all.size(); i += 5) {
      // Nothing belongs to a path of two edges, so that its power is its own.
      if (all[i].geometry.edge_count < 2 || std::norm(all[i].field[0][0]) > power / 4000) continue;
      std::vector<Arrival> others = all;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_LE(std::abs(interference(others) - whole), 2 * amplitude(all[i]) * sum + 1e-3 * power)
          << point << " " << i;
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
}

// A correlation: the total is the mean power of waves. The order in which they are told does not count.
TEST_F(Composites, TotalsArePowers) {
  for (std::size_t point = 0; point < paths.size(); ++point) {
    std::vector<Arrival> all = arrivals_at(point);
    double power = 0;
    for (const Arrival& arrival : all) power += amplitude(arrival) * amplitude(arrival);
    const double whole = interference(all);
    EXPECT_GE(power + whole, 0);
    std::reverse(all.begin(), all.end());
    EXPECT_NEAR(interference(all), whole, 1e-9 * power) << point;
  }
}

}  // namespace
}  // namespace grimaldi
