#include "propagation/field.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/constants.h"
#include "core/sine_cosine.h"
#include "propagation/antenna.h"
#include "propagation/chain_steps.h"
#include "propagation/edge_faces.h"
#include "propagation/edge_model.h"
#include "propagation/face_reflection.h"
#include "propagation/field_vector.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// True if the faces of an edge have waves of their own.
bool faces_count(const Plan& plan) {
  const DiffractionModel model = plan.request.diffraction_model;
  return plan.request.reflection || model == DiffractionModel::utd || model == DiffractionModel::automatic;
}

/// A path and what its field is made of.
struct FieldOf {
  const Scene& scene;
  const Plan& plan;
  std::span<const Interaction> interactions;
  const PathGeometry& geometry;
  std::span<const Vec3> k;  ///< directions of the legs
  std::size_t band;
};

/// The wave (sound: pressure, 0, 0) launched as `launched` where it arrives, without spreading and phase.
template <typename Steps>
ComplexVec3 carried(const FieldOf& path, const ComplexVec3& launched, const ChainTerms& chain_terms, Steps&& steps) {
  const auto& [scene, plan, interactions, geometry, k, band] = path;
  const bool radio = plan.request.kind == WaveKind::radio, faces = faces_count(plan);
  const double wavenumber = plan.wavenumber[band], wavelength = 2 * pi / wavenumber;
  const std::size_t edges = geometry.edge_count;
  // Between two edges there is one wave for each term of the edge before; at the ends of the path one in all.
  // `unseen`: without its image in the face along which it goes on.
  std::array<std::array<ComplexVec3, Steps::most>, max_terms> wave, unseen;
  std::array<std::size_t, max_terms> parts{1};
  wave[0][0] = launched;
  std::size_t waves = 1, edge_number = 0;
  double weight = 1;
  FaceWay came;
  bool twice_before = false;
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    if (!is_edge(interactions[i])) {
      const Patch& patch = scene.patches.patches[interactions[i]];
      const auto r = face_reflection(plan, patch.material, band, std::min(1.0, std::abs(dot(k[i], patch.normal))));
      for (std::size_t a = 0; a < waves; ++a)
        for (ComplexVec3& w : std::span(wave[a].data(), parts[a])) {
          if (radio)
            w = reflect(w, k[i], patch.normal, r);
          else
            w.x *= r.te;
        }
      continue;
    }
    const EdgePassage& passage = geometry.edges[edge_number];
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    const EdgeTerms& terms = chain_terms[edge_number];
    const bool last = edge_number + 1 == edges;
    FaceWay leaves;
    if (!last && is_edge(interactions[i + 1])) leaves = way_along_face(scene, geometry, edge_number, wavelength);
    // The wave along a face that both edges bound is there as itself and as its image.
    if (faces && leaves.patch != no_index) weight *= 0.5;
    // Three edges along one face: which of the images is which is not kept.
    const bool twice = leaves.patch != no_index && leaves.patch == came.patch;
    std::optional<EdgeFaces> at_faces, at_black_faces;
    const auto meet_faces = [&](ImageRule rule, std::optional<EdgeFaces>& at) {
      if (faces) at.emplace(plan, rule, wedge, passage, band, k[i], k[i + 1], came, leaves);
    };
    if (terms.has(false)) meet_faces(ImageRule::utd, at_faces);
    if (terms.has(true)) meet_faces(ImageRule::black, at_black_faces);
    const ConeFrame in(wedge.direction, k[i]), out(wedge.direction, k[i + 1]);
    const auto in_frame = [&](const ComplexVec3& w) {
      return radio ? ConeField{dot(w, in.beta), dot(w, in.phi)} : ConeField{w.x, 0.0};
    };
    const auto out_of_frame = [&](const ConeField& w) {
      return radio ? combine(w[0], out.beta, w[1], out.phi) : ComplexVec3{w[0], 0.0, 0.0};
    };
    steps.meet(edge_number, EndWeights(wedge, passage, wavelength, wavenumber, plan.request.reflection));
    std::array<std::array<ConeField, Steps::most>, max_terms> arriving, arriving_unseen;
    for (std::size_t a = 0; a < waves; ++a)
      for (std::size_t n = 0; n < parts[a]; ++n) {
        arriving[a][n] = in_frame(wave[a][n]);
        if (came.patch != no_index) arriving_unseen[a][n] = in_frame(unseen[a][n]);
      }
    // Per term: all that arrives, through its face.
    if (last) wave[0][0] = {};
    for (std::size_t t = 0; t < terms.count; ++t) {
      const EdgeTerm& term = terms.term[t];
      // An image in the face along which it came, mirrored in it again, is the wave itself.
      const bool in_face = !twice && !twice_before && images_in(wedge, term, came.patch);
      std::array<ConeField, Steps::most> sum{}, mirrored_back{};
      for (std::size_t a = 0; a < waves; ++a) {
        const bool back = in_face && images_in(scene.wedges.wedges[geometry.edges[edge_number - 1].wedge],
                                               chain_terms[edge_number - 1].term[a], came.patch);
        steps.pass(a, t, std::span(back ? arriving_unseen[a] : arriving[a]).first(parts[a]),
                   back ? mirrored_back : sum);
      }
      steps.leave(t, sum);
      if (in_face) steps.leave(t, mirrored_back);
      for (std::size_t n = 0; n < steps.leaving(t); ++n) {
        const ConeField& back = mirrored_back[n];
        ConeField seen = faces ? (term.black ? at_black_faces : at_faces)->seen_at(term.boundary, sum[n]) : sum[n];
        for (std::size_t p = 0; p < 2; ++p) seen[p] += back[p];
        if (last) {
          const ComplexVec3 here = out_of_frame(seen);
          wave[0][0].x += here.x, wave[0][0].y += here.y, wave[0][0].z += here.z;
          continue;
        }
        wave[t][n] = out_of_frame(seen);
        if (leaves.patch != no_index) unseen[t][n] = out_of_frame({sum[n][0] + back[0], sum[n][1] + back[1]});
      }
    }
    waves = last ? 1 : terms.count;
    for (std::size_t a = 0; a < waves; ++a) parts[a] = steps.leaving(a);
    came = leaves;
    twice_before = twice;
    ++edge_number;
  }
  return {weight * wave[0][0].x, weight * wave[0][0].y, weight * wave[0][0].z};
}

}  // namespace

double power_bound(const Scene& scene, const Plan& plan, std::span<const Interaction> interactions,
                   const PathGeometry& geometry) {
  constexpr double highest_gain = 1.65;
  const double wavenumber = plan.wavenumber.front();
  const double unit =
      plan.request.kind == WaveKind::radio ? highest_gain / (4 * wavenumber * wavenumber) : 1 / (4 * pi);
  if (geometry.edge_count == 0) return unit / (geometry.length * geometry.length);
  const EdgeChain chain = edge_chain(scene, interactions, geometry);
  double share = 0.5;
  for (std::size_t i = 0; i + 1 < geometry.edge_count; ++i)
    share = std::max(share, double_edge_share(chain.coupling[i]));
  double amplitude = chain.amplitude;
  // The terms of `utd` are those of `fsd` and one more, and `auto` is between both.
  const bool utd = plan.request.diffraction_model != DiffractionModel::fsd;
  for (std::size_t i = 0; i < geometry.edge_count; ++i) {
    const EdgePassage& passage = geometry.edges[i];
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    const double size = passage.sin_beta * std::sqrt(2 * wavenumber * chain.distance[i]);
    const auto bound = [&](double epsilon) {
      return double_edge_bound(size * sine_cosine(0.5 * std::min(std::abs(epsilon), pi)).sine, share);
    };
    double sum = bound(beyond_boundary(wedge, passage, Boundary::incident));
    if (faces_count(plan))
      sum += bound(beyond_boundary(wedge, passage, Boundary::face0)) +
             bound(beyond_boundary(wedge, passage, Boundary::facen));
    // UTD has a second incident term, the one of the boundary beside the other face.
    if (utd) sum += bound(pi);
    if (!passage.inside) sum *= 0.75;
    // A pair of terms counts each of its edges once: within a chain, an edge between two pairs over its own wave.
    if (i > 0 && i + 1 < geometry.edge_count) sum *= 2 * share;
    amplitude *= sum;
  }
  if (geometry.edge_count <= 2) {
    const EdgePassage& first = geometry.edges[0];
    const double beyond = std::max({0.0, -first.along, first.along - scene.wedges.wedges[first.wedge].length});
    amplitude +=
        object_wave_bound(plan.small_objects, first, beyond, geometry.edges[geometry.edge_count - 1].s_out, wavenumber);
  }
  return unit * amplitude * amplitude;
}

void path_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                std::span<const Interaction> interactions, const PathGeometry& geometry,
                std::span<std::array<Complex, 2>> field) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const std::size_t legs = geometry.count - 1, edges = geometry.edge_count;
  std::array<Vec3, max_depth + 1> k;
  for (std::size_t i = 0; i < legs; ++i) k[i] = normalized(geometry.points[i + 1] - geometry.points[i]);
  const Vec3 launched = radio ? radiated_field(transmitter.antenna, k[0]) : Vec3{1, 0, 0};
  const PolarFrame receiver = polar_frame(-k[legs - 1]);
  EdgeChain chain;
  chain.amplitude = 1 / geometry.length;
  if (edges > 0) chain = edge_chain(scene, interactions, geometry);
  thread_local ChainTerms terms;  // too much to set to zero for each path
  for (std::size_t band = 0; band < plan.bands(); ++band) {
    const double wavenumber = plan.wavenumber[band], wavelength = 2 * pi / wavenumber;
    for (std::size_t e = 0; e < edges; ++e) {
      const EdgePassage& passage = geometry.edges[e];
      terms[e] = edge_terms(plan.request.diffraction_model, faces_count(plan), scene.wedges.wedges[passage.wedge],
                            passage, chain.distance[e], wavenumber);
    }
    const FieldOf path{scene, plan, interactions, geometry, std::span(k).first(legs), band};
    const ComplexVec3 start{launched.x, launched.y, launched.z};
    const ComplexVec3 wave = edges <= 2 ? carried(path, start, terms, PairSteps(chain, terms, edges))
                             : is_row(chain, terms, edges)
                                 ? carried(path, start, terms, RowSteps(chain, terms, edges))
                                 : carried(path, start, terms, MomentSteps(chain, terms, edges));
    const double scale = radio ? wavelength / (4 * pi) : 1 / std::sqrt(4 * pi);
    const SineCosine phase = sine_cosine(-std::remainder(wavenumber * geometry.length, 2 * pi));
    const double spread = chain.amplitude * scale * std::exp(-plan.attenuation[band] * geometry.length);
    const Complex carrier = spread * Complex(phase.cosine, phase.sine);
    if (radio)
      field[band] = {carrier * dot(wave, receiver.theta), carrier * dot(wave, receiver.phi)};
    else
      field[band] = {carrier * wave.x, 0.0};
  }
}

}  // namespace grimaldi
