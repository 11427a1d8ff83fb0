// Chains of edges in space: spreading, exchange of the ends, and the bound that culls.

#include "propagation/edge_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/random.h"
#include "propagation/chain_steps.h"
#include "propagation/field.h"
#include "tests/propagation/runs.h"

namespace grimaldi {
namespace {

constexpr double frequency = 3.5e9;

struct City {
  Scene scene;
  Plan plan;
};

City city(DiffractionModel model, const std::string& material) {
  MaterialChoice choice;
  choice.replace = {{"*", material}};
  City made{test::built_in("demo-city", {}, choice), {}};
  PlanDescription description = test::plan_for(WaveKind::radio, frequency, {0, 0, 30});
  description.diffraction_model = model;
  const Tracer tracer(made.scene);
  Diagnostics diagnostics;
  made.plan = make_plan(description, made.scene, tracer, diagnostics);
  return made;
}

struct Way {
  Vec3 source, receiver;
  std::vector<Interaction> interactions;
};

/// Chains between random points over random edges of the city, seen or not: the law does not ask.
std::vector<Way> ways(const Scene& scene, std::size_t edges, std::size_t count, std::uint64_t stream,
                      bool face_between = false) {
  std::vector<Way> found;
  const auto wedges = scene.wedges.wedges.size();
  for (std::uint64_t i = 0; found.size() < count && i < 2000000; ++i) {
    const auto u = uniform4(5, stream, i, 0), v = uniform4(5, stream, i, 1), e = uniform4(5, stream, i, 2);
    Way way{
        {200 * u[0] - 100, 200 * u[1] - 100, 1 + 40 * u[2]}, {200 * v[0] - 100, 200 * v[1] - 100, 1 + 40 * v[2]}, {}};
    auto wedge = static_cast<std::size_t>(e[0] * double(wedges));
    for (std::size_t n = 0; n < edges; ++n) {
      if (n > 0 && face_between)
        way.interactions.push_back(static_cast<Interaction>(v[3] * double(scene.patches.patches.size())));
      way.interactions.push_back(edge_interaction(static_cast<std::uint32_t>(wedge)));
      // A near neighbour in every other step: edges of one building, of one face.
      wedge = i % 2 == 0 ? (wedge + 1 + static_cast<std::size_t>(4 * e[n + 1])) % wedges
                         : static_cast<std::size_t>(e[n + 1] * double(wedges));
    }
    PathGeometry geometry;
    UnfoldedSequence unfolded(scene, way.source, way.interactions);
    if (unfolded.solve(way.receiver, 0.0857, geometry)) found.push_back(way);
  }
  return found;
}

struct Solved {
  PathGeometry geometry;
  std::vector<std::array<std::complex<double>, 2>> field{1};
};

Solved solve(const City& here, const Vec3& from, const Vec3& to, const std::vector<Interaction>& interactions) {
  Solved out;
  UnfoldedSequence unfolded(here.scene, from, interactions);
  if (!unfolded.solve(to, 0.0857, out.geometry)) return out;
  Transmitter transmitter = here.plan.request.transmitters[0];
  transmitter.position = from;
  path_field(here.scene, here.plan, transmitter, interactions, out.geometry, out.field);
  return out;
}

// The distances and the amplitude together are what the astigmatic radii give: the same field outside the transition
// regions, where every wave falls as 1/√L.
TEST(EdgeChain, SpreadsAsAstigmaticRadiiDo) {
  const City here = city(DiffractionModel::utd, "concrete");
  for (const std::size_t edges : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
    for (const Way& way : ways(here.scene, edges, 200, edges)) {
      const PathGeometry geometry = solve(here, way.source, way.receiver, way.interactions).geometry;
      const EdgeChain chain = edge_chain(here.scene, way.interactions, geometry);
      double ours = chain.amplitude, theirs = 1 / geometry.edges[0].s_in;
      Vec3 along1, along2;
      double radius1 = 0, radius2 = 0;
      for (std::size_t i = 0; i < edges; ++i) {
        const EdgePassage& passage = geometry.edges[i];
        const Vec3& direction = here.scene.wedges.wedges[passage.wedge].direction;
        const ConeFrame in(direction, normalized(geometry.points[i + 1] - geometry.points[i])),
            out(direction, normalized(geometry.points[i + 2] - geometry.points[i + 1]));
        double radius = passage.s_in;
        if (i > 0) {
          const double c1 = dot(along1, in.beta), c2 = dot(along2, in.beta);
          radius = 1 / (c1 * c1 / radius1 + c2 * c2 / radius2);
        }
        // |D| = 1/√L U √L: √(ρ/(s(s+ρ))) for each edge (Kouyoumjian & Pathak).
        theirs *= std::sqrt(radius / (passage.s_out * (radius + passage.s_out)));
        ours /= std::sqrt(chain.distance[i]);
        along1 = out.phi;
        along2 = out.beta;
        radius1 = passage.s_out;
        radius2 = radius + passage.s_out;
      }
      // Points beyond an edge's end are drawn to it, so directions and lengths differ there; else rounding.
      if (!std::all_of(geometry.edges.begin(), geometry.edges.begin() + static_cast<std::ptrdiff_t>(edges),
                       [](const auto& e) { return e.inside; }))
        continue;
      EXPECT_NEAR(ours / theirs, 1, 1e-6) << edges;
    }
}

/// Wave over a chain by one of the laws, its edges without ends.
template <typename Steps>
std::complex<double> through(const EdgeChain& chain, const ChainTerms& terms, std::size_t edges) {
  Wedge wedge;
  wedge.stands_at_start = wedge.stands_at_end = true;
  EdgePassage passage{};
  passage.inside = true;
  Steps steps(chain, terms, edges);
  std::array<ConeField, Steps::most> wave{ConeField{1, 0}};
  for (std::size_t e = 0; e < edges; ++e) {
    steps.meet(e, EndWeights(wedge, passage, 1, 2 * pi, true));
    std::array<ConeField, Steps::most> passed{};
    steps.pass(0, 0, std::span(wave).first(steps.arriving(0)), passed);
    steps.leave(0, passed);
    wave = passed;
  }
  return wave[0][0];
}

// Screens in a row, all tips on the straight line between the ends and equally far apart: |E/E0| = 1/(N + 1) for N of
// them (Lee 1978). What the law of moments leaves out adds up: its second powers of both couplings of an edge are 8 %
// low.
TEST(EdgeChain, GrazingScreensInARow) {
  const EdgeTerm term{make_edge_wave(0), 1, 1, 1, 1, -1, Boundary::incident, true};
  ChainTerms terms;
  for (EdgeTerms& of_edge : terms) of_edge.term[0] = term, of_edge.count = 1;
  constexpr double allowed[] = {0.3, 1.0, 2.2};  // dB
  // C_ij = i (N + 1 − j)/(N + 1), so K is that of second differences: L = ½, w = ½, det K = N + 1.
  for (std::size_t screens = 3; screens <= 5; ++screens) {
    EdgeChain chain;
    chain.coupling.fill(0.5);
    for (std::size_t i = 0; i < screens; ++i)
      chain.width[i] = std::sqrt(2 * double(i + 1) * double(screens - i) / double(screens + 1));
    const double amplitude = std::sqrt(double(screens + 1) / std::pow(2.0, screens)) * double(screens + 1);
    const auto level = [&](std::complex<double> wave) { return 20 * std::log10(amplitude * std::abs(wave)); };
    EXPECT_TRUE(is_row(chain, terms, screens));
    EXPECT_NEAR(level(through<RowSteps>(chain, terms, screens)), 0, 2e-3) << screens;
    EXPECT_NEAR(level(through<MomentSteps>(chain, terms, screens)), 0, allowed[screens - 3]) << screens;
  }
}

// Where a chain is left to the law of moments, it errs by less than 1 % of the wave: three edges near the limit of
// is_row and below, couplings and arguments at random.
TEST(EdgeChain, MomentsSufficeBelowTheRow) {
  double worst = 0;
  int compared = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const auto u = uniform4(11, i, 0, 0), v = uniform4(11, i, 0, 1), s = uniform4(11, i, 0, 2);
    EdgeChain chain;
    // Legs between 1 and 100; K of a Brownian bridge.
    std::array<double, 4> leg;
    for (std::size_t e = 0; e < 4; ++e) leg[e] = std::pow(100.0, u[e]);
    const double whole = leg[0] + leg[1] + leg[2] + leg[3];
    double before = 0;
    ChainTerms terms;
    for (std::size_t e = 0; e < 3; ++e) {
      before += leg[e];
      chain.distance[e] = 1 / (1 / leg[e] + 1 / leg[e + 1]);
      chain.width[e] = std::sqrt(before * (whole - before) / whole / chain.distance[e]);
      terms[e].count = 1;
      terms[e].term[0] = {
          make_edge_wave(4 * v[e] * v[e]), s[e] < 0.3 ? -1.0 : 1.0, 1, 1, 1, -1, Boundary::incident, true};
    }
    for (std::size_t e = 0; e < 2; ++e)
      chain.coupling[e] = std::sqrt(chain.distance[e] * chain.distance[e + 1]) / leg[e + 1];
    if (is_row(chain, terms, 3) || !row_fits(chain.width[1])) continue;
    ++compared;
    const auto row = through<RowSteps>(chain, terms, 3), moments = through<MomentSteps>(chain, terms, 3);
    worst = std::max(worst, std::abs(row - moments) / std::abs(row));
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(worst, 0.01);
}

class Chains : public testing::TestWithParam<DiffractionModel> {};

// One polarisation at both ends. Newton's points err by 1e-9 m.
TEST_P(Chains, ExchangeOfTheEnds) {
  for (const char* material : {"concrete", "metal"}) {
    const City here = city(GetParam(), material);
    struct Kind {
      std::size_t edges;
      bool face_between;
    };
    for (const auto& [edges, face_between] : {Kind{2, false}, Kind{2, true}, Kind{3, false}}) {
      double worst = 0;
      int lost = 0;
      const std::vector<Way> all = ways(here.scene, edges, face_between ? 50 : 300, 10 + edges, face_between);
      ASSERT_GE(all.size(), 50u);
      for (const Way& way : all) {
        const Solved there = solve(here, way.source, way.receiver, way.interactions);
        const Solved back = solve(here, way.receiver, way.source, {way.interactions.rbegin(), way.interactions.rend()});
        const auto forth = there.field[0], again = back.field[0];
        if (back.geometry.count == 0 || std::norm(again[0]) == 0) {
          ++lost;
          continue;
        }
        // Exactly at an end the diffraction point is on the edge for one end and beside it for the other.
        const auto& passed = there.geometry.edges;
        if (std::any_of(passed.begin(), passed.begin() + static_cast<std::ptrdiff_t>(edges), [&](const auto& e) {
              return std::min(std::abs(e.along), std::abs(e.along - here.scene.wedges.wedges[e.wedge].length)) < 1e-6;
            }))
          continue;
        // Beside a null of the polarisation what is left is the rounding of the whole.
        if (std::norm(forth[0]) < 1e-9 * std::norm(forth[1])) continue;
        worst = std::max(worst, std::abs(test::decibel(std::norm(forth[0]) / std::norm(again[0]))));
      }
      std::printf("%s, %zu edges%s: %.1e dB\n", material, edges, face_between ? ", a face between" : "", worst);
      // Along faces waves and their images cancel to a hundredth and less, and Newton's rounding is that much greater.
      EXPECT_LT(worst, 5e-5);
      EXPECT_LT(lost, 15);  // Newton starts elsewhere: ways past corners are not always found again
    }
  }
}

TEST_P(Chains, StayBelowTheirBound) {
  for (const char* material : {"concrete", "metal"}) {
    const City here = city(GetParam(), material);
    for (const std::size_t edges : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
      for (const Way& way : ways(here.scene, edges, 2000, 20 + edges)) {
        const Solved there = solve(here, way.source, way.receiver, way.interactions);
        const double power = std::norm(there.field[0][0]) + std::norm(there.field[0][1]);
        EXPECT_LE(power, power_bound(here.scene, here.plan, way.interactions, there.geometry)) << edges;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Chains, testing::Values(DiffractionModel::utd, DiffractionModel::fsd),
                         [](const auto& p) { return p.param == DiffractionModel::utd ? "utd" : "fsd"; });

}  // namespace
}  // namespace grimaldi
