#include "propagation/field.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/constants.h"
#include "propagation/antenna.h"
#include "propagation/edge_model.h"
#include "propagation/face_reflection.h"
#include "propagation/field_vector.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/utd.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

/// Argument of a term beyond which the ends of the edge next to it no longer couple with it; a fade from 1 less.
constexpr double coupled_end = 2;

/// Power of an end's wave below which the coupling does not count.
constexpr double negligible_end = 1e-4;

/// T of line 6: which part of each term there is, with the ends of the edge.
class EndWeights {
 public:
  /// `mirrors`: an end that stands on a face has no wave.
  EndWeights(const Wedge& wedge, const EdgePassage& passage, double wavelength, double wavenumber, bool mirrors)
      : inside_(passage.inside ? 1.0 : 0.0) {
    if (!mirrors || !wedge.stands_at_start) add(passage.detour_start, 1, wavelength, wavenumber, passage.along >= 0);
    if (!mirrors || !wedge.stands_at_end)
      add(passage.detour_end, -1, wavelength, wavenumber, passage.along <= wedge.length);
  }

  Complex of(const EdgeTerm& term) const {
    Complex weight = inside_;
    for (const End& end : std::span(ends_.data(), count_))
      weight += edge_end_share(term.wave.argument, end.argument) * end.wave;
    return weight;
  }

  /// The same, there `weight`, in a pair with a term of the one other edge, of an argument below coupled_end: the ends
  /// couple with it, and share as they do without it. `alone`: the term's argument without the other edge; `coupling`:
  /// of the other edge's aperture with the way along this edge.
  Complex of_pair(Complex weight, double alone, const EdgeTerm& other, double coupling) const {
    const double near = std::min(coupled_end - other.wave.argument, 1.0);
    Complex coupled = inside_;
    const double root = std::sqrt((1 - coupling) * (1 + coupling));
    for (std::size_t i = 0; i < count_; ++i) {
      const End& end = ends_[i];
      const double w = end.side * coupling, b = other.sign * other.wave.argument;
      const double share = edge_end_share(alone, root * (end.dark ? end.argument : -end.argument) + w * b);
      if (share * std::norm(end.wave) * std::abs(w) < negligible_end) {
        coupled += share * end.wave;
        continue;
      }
      const Complex both = end_and_edge_wave(end.argument, end.dark, other.wave.argument, other.sign > 0, w);
      coupled += share / other.sign * both / other.wave.wave * std::polar(1.0, -end.argument * end.argument);
    }
    return weight + near * (coupled - weight);
  }

 private:
  struct End {
    double side;      ///< + where the edge starts, - where it ends
    double argument;  ///< of its wave, √(kδ)
    bool dark;
    Complex wave;
  };
  void add(double detour, double side, double wavelength, double wavenumber, bool inside) {
    ends_[count_++] = {side, std::sqrt(wavenumber * detour), !inside,
                       edge_end_wave(detour, wavelength, wavenumber, inside)};
  }
  double inside_;
  std::array<End, 2> ends_{};
  std::size_t count_ = 0;
};

/// True if a term of an edge is so near its boundary that the ends of the edge next to it couple with it.
bool couples(const EdgeTerms& terms) {
  return std::any_of(terms.begin(), terms.end(), [](const EdgeTerm& t) { return t.wave.argument < coupled_end; });
}

/// What a face does to a wave in the cone frames of an edge: rows β̂, φ̂ of the image wave, columns β̂, φ̂ of the incident
/// one.
struct Dyadic {
  Complex bb, bp, pb, pp;
};

/// For a way to the edge in direction k, with those coefficients.
Dyadic image_dyadic(const ReflectionCoefficients& r, const Vec3& edge, const Vec3& k, const Vec3& normal) {
  const double cosine = dot(k, normal);
  const Vec3 image = k - 2 * cosine * normal;
  Vec3 s = cross(k, normal);
  const double sine = norm(s);
  s = sine > 1e-9 ? s / sine : perpendicular(normal);
  const Vec3 p_in = cross(s, k), p_out = cross(s, image);
  const ConeFrame in(edge, k), out(edge, image);
  const auto element = [&](const Vec3& to, const Vec3& from) {
    return r.te * (dot(to, s) * dot(from, s)) + r.tm * (dot(to, p_out) * dot(from, p_in));
  };
  return {element(out.beta, in.beta), element(out.beta, in.phi), element(out.phi, in.beta), element(out.phi, in.phi)};
}

/// The same for the way back: transposed (φ̂ turns round with the ray).
Dyadic reversed(const Dyadic& d) { return {d.bb, -d.pb, -d.bp, d.pp}; }

/// share a + (1 − share) b.
Dyadic mixed(double share, const Dyadic& a, const Dyadic& b) {
  const auto mix = [&](const Complex& x, const Complex& y) { return share * x + (1 - share) * y; };
  return {mix(a.bb, b.bb), mix(a.bp, b.bp), mix(a.pb, b.pb), mix(a.pp, b.pp)};
}

/// True if the faces of an edge have waves of their own.
bool faces_count(const Plan& plan) {
  const DiffractionModel model = plan.request.diffraction_model;
  return plan.request.reflection || model == DiffractionModel::utd || model == DiffractionModel::automatic;
}

/// A way along a face that two edges in a row bound.
struct FaceWay {
  std::uint32_t patch = no_index;
  double length = 0;  ///< m
};

/// From edge `e` to the next. Where the wave passes one of them straight on, the way goes on too: a wave of one edge
/// less has it whole.
FaceWay way_along_face(const Scene& scene, const PathGeometry& geometry, std::size_t e, double wavelength) {
  const EdgePassage &here = geometry.edges[e], &next = geometry.edges[e + 1];
  FaceWay way{grazed_face(scene, here, next), here.s_out};
  const auto straight = [&](const EdgePassage& passage) {
    const double v = boundary_parameter(scene, passage, Boundary::incident, wavelength);
    return std::exp(-0.5 * pi * v * v);
  };
  if (way.patch != no_index) way.length += straight(here) * here.s_in + straight(next) * next.s_out;
  return way;
}

/// By how much an image is turned from a right angle towards its own face (−: towards the other).
struct Turn {
  double angle, sine, cosine;
  Turn operator-() const { return {-angle, -sine, cosine}; }
};

/// For a way of that azimuth from the face: ±(π/2 − image_angle).
Turn image_turn(double exterior_angle, double azimuth) {
  const double to_face = image_angle(exterior_angle, azimuth), side = azimuth <= exterior_angle - azimuth ? 1 : -1;
  return {side * (0.5 * pi - to_face), side * std::cos(to_face), std::sin(to_face)};
}

/// The turn of a way by which the image goes where the `other` way is nearer to a face: that of the mirror's way, or,
/// as both turn to one side, between that and its own.
Turn turn_with(const Turn& turn, const Turn& other) {
  if (std::abs(turn.angle) >= std::abs(other.angle)) return turn;
  if (turn.angle * other.angle <= 0) return -other;
  const double angle = 2 * turn.angle - other.angle;
  return {angle, std::sin(angle), std::cos(angle)};
}

/// Normal of the mirror whose image a wave of direction k to an edge has at that turn. `side` 1: the face at azimuth 0,
/// −1: the other.
Vec3 turned_normal(const Vec3& edge, const Vec3& k, const Vec3& normal, double side, const Turn& turn) {
  const Vec3 across = k - dot(k, edge) * edge;
  const double sine = norm(across);
  if (sine < 1e-9) return normal;
  const Vec3 u = across / sine, v = cross(edge, u);
  return -turn.cosine * u - side * turn.sine * v;
}

/// Whose terms the images belong to.
enum class ImageRule { utd, black };

/// The faces of one edge as its wave meets them: dyadics (sound: bb alone), by the rules of laws/utd.h. Along a face
/// that the edge before (`came`) or after (`leaves`) shares, the way between the two alone.
class EdgeFaces {
 public:
  EdgeFaces(const Plan& plan, ImageRule rule, const Wedge& wedge, const EdgePassage& passage, std::size_t band,
            const Vec3& k_in, const Vec3& k_out, const FaceWay& came, const FaceWay& leaves)
      : plan_(plan),
        rule_(rule),
        wedge_(wedge),
        passage_(passage),
        band_(band),
        k_in_(k_in),
        k_out_(k_out),
        came_(came),
        leaves_(leaves) {
    if (rule == ImageRule::utd) {
      turn_in_ = image_turn(wedge.exterior_angle, passage.phi_in);
      turn_out_ = image_turn(wedge.exterior_angle, passage.phi_out);
    }
    face0_ = dyadic(wedge.patch0, wedge.material0, wedge.normal0, 1);
    if (!wedge.free_rim) facen_ = dyadic(wedge.patchn, wedge.materialn, wedge.normaln(), -1);
  }

  /// A wave {β̂, φ̂} (sound: {pressure, 0}) as the term of a boundary has it: itself or its image.
  std::array<Complex, 2> seen_at(Boundary boundary, const std::array<Complex, 2>& wave) const {
    if (boundary == Boundary::incident) return wave;
    const Dyadic& d = boundary == Boundary::face0 ? face0_ : facen_;
    return {d.bb * wave[0] + d.bp * wave[1], d.pb * wave[0] + d.pp * wave[1]};
  }

 private:
  /// `side` 1: face 0, −1: face n.
  Dyadic dyadic(std::uint32_t patch, std::uint32_t material, const Vec3& normal, double side) const {
    if (plan_.request.kind != WaveKind::radio) return {face_reflection(plan_, material, band_, 1).te, 0, 0, 0};
    const bool utd = rule_ == ImageRule::utd;
    const auto met = [&](double cosine, double way) { return met_cosines(plan_, material, band_, cosine, way); };
    const Turn turn_in = side > 0 ? turn_in_ : -turn_in_, turn_out = side > 0 ? turn_out_ : -turn_out_;
    const double c_in = utd ? passage_.sin_beta * turn_in.cosine : std::abs(dot(k_in_, normal));
    const double c_out = utd ? passage_.sin_beta * turn_out.cosine : std::abs(dot(k_out_, normal));
    const auto there = [&](const MetCosines& m, const Turn& x) {
      return image_dyadic(face_reflection(plan_, material, band_, m), wedge_.direction, k_in_,
                          utd ? turned_normal(wedge_.direction, k_in_, normal, side, x) : normal);
    };
    const auto back = [&](const MetCosines& m, const Turn& x) {
      return reversed(image_dyadic(face_reflection(plan_, material, band_, m), wedge_.direction, -k_out_,
                                   utd ? turned_normal(wedge_.direction, -k_out_, normal, side, x) : normal));
    };
    if (patch == came_.patch && patch != leaves_.patch) return there(met(c_in, came_.length), turn_in);
    if (patch == leaves_.patch && patch != came_.patch) return back(met(c_out, leaves_.length), turn_out);
    const MetCosines m_in = met(c_in, came_.patch != no_index ? came_.length : passage_.s_in);
    const MetCosines m_out = met(c_out, leaves_.patch != no_index ? leaves_.length : passage_.s_out);
    // Each way has a width, 1/√(ks): two ways along the face share by that, not by the rounding of their angles.
    const auto wide = [&](double c, double way) { return std::sqrt(c * c + 1 / (plan_.wavenumber[band_] * way)); };
    const double share = face_share(wide(c_in, passage_.s_in), wide(c_out, passage_.s_out));
    if (!utd) return mixed(share, there(m_in, turn_in), back(m_out, turn_out));
    const MetCosines least{std::min(m_in.te, m_out.te), std::min(m_in.tm, m_out.tm)};
    return mixed(share, there(least, turn_with(turn_in, turn_out)), back(least, turn_with(turn_out, turn_in)));
  }

  const Plan& plan_;
  const ImageRule rule_;
  const Wedge& wedge_;
  const EdgePassage& passage_;
  const std::size_t band_;
  const Vec3 &k_in_, &k_out_;
  const FaceWay &came_, &leaves_;
  Turn turn_in_{}, turn_out_{};  ///< towards face 0
  Dyadic face0_{}, facen_{};
};

/// True if the term is that of the image in `face`.
bool images_in(const Wedge& wedge, const EdgeTerm& term, std::uint32_t face) {
  return face != no_index && ((term.boundary == Boundary::face0 && wedge.patch0 == face) ||
                              (term.boundary == Boundary::facen && wedge.patchn == face));
}

/// The two components of a wave in the cone frame of an edge (sound: pressure, 0).
using Pair = std::array<Complex, 2>;

/// Adds what a wave becomes at the next edge of a chain.
void add(const ChainStep& step, const ChainWave<Pair>& wave, ChainWave<Pair>& sum) {
  for (std::size_t p = 0; p < 2; ++p) {
    sum.whole[p] += step.whole * wave.whole[p] + step.slope * wave.slope[p];
    sum.slope[p] += step.slope_from_whole * wave.whole[p] + step.slope_from_slope * wave.slope[p];
  }
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
      return double_edge_bound(size * std::sin(0.5 * std::min(std::abs(epsilon), pi)), share);
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

double boundary_parameter(const Scene& scene, const EdgePassage& passage, Boundary boundary, double wavelength) {
  // The transition region of an edge in a chain is that of the legs next to it.
  const double effective = passage.s_in * passage.s_out / (passage.s_in + passage.s_out);
  return fresnel_parameter(effective, wavelength, passage.sin_beta,
                           beyond_boundary(scene.wedges.wedges[passage.wedge], passage, boundary));
}

void path_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                std::span<const Interaction> interactions, const PathGeometry& geometry,
                std::span<std::array<Complex, 2>> field) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const bool faces = faces_count(plan);
  const std::size_t legs = geometry.count - 1, edges = geometry.edge_count;
  std::array<Vec3, max_depth + 1> k;
  for (std::size_t i = 0; i < legs; ++i) k[i] = normalized(geometry.points[i + 1] - geometry.points[i]);
  const Vec3 launched = radio ? radiated_field(transmitter.antenna, k[0]) : Vec3{};
  const PolarFrame receiver = polar_frame(-k[legs - 1]);
  EdgeChain chain;
  chain.amplitude = 1 / geometry.length;
  if (edges > 0) chain = edge_chain(scene, interactions, geometry);

  for (std::size_t band = 0; band < plan.bands(); ++band) {
    const double wavenumber = plan.wavenumber[band], wavelength = 2 * pi / wavenumber;
    // Between two edges there is one wave for each term of the edge before; at the ends of the path one in all.
    // `unseen`: without its image in the face along which it goes on.
    std::array<ChainWave<ComplexVec3>, max_terms> wave, unseen;
    wave[0].whole = radio ? ComplexVec3{launched.x, launched.y, launched.z} : ComplexVec3{1.0, 0.0, 0.0};
    std::size_t waves = 1, edge_number = 0;
    double weight = 1;
    EdgeTerms before;
    const Wedge* wedge_before = nullptr;
    std::optional<EndWeights> ends_before;
    std::array<Complex, max_terms> weights_before, weights;
    FaceWay came;
    bool twice_before = false;
    for (std::size_t i = 0; i < interactions.size(); ++i) {
      if (!is_edge(interactions[i])) {
        const Patch& patch = scene.patches.patches[interactions[i]];
        const auto r = face_reflection(plan, patch.material, band, std::min(1.0, std::abs(dot(k[i], patch.normal))));
        for (std::size_t a = 0; a < waves; ++a) {
          const auto mirror = [&](ComplexVec3& w) {
            if (radio)
              w = reflect(w, k[i], patch.normal, r);
            else
              w.x *= r.te;
          };
          mirror(wave[a].whole);
          if (edge_number > 1) mirror(wave[a].slope);
        }
        continue;
      }
      const EdgePassage& passage = geometry.edges[edge_number];
      const Wedge& wedge = scene.wedges.wedges[passage.wedge];
      const bool first = edge_number == 0, last = edge_number + 1 == edges;
      const EndWeights ends(wedge, passage, wavelength, wavenumber, plan.request.reflection);
      FaceWay leaves;
      if (!last && is_edge(interactions[i + 1])) leaves = way_along_face(scene, geometry, edge_number, wavelength);
      // The wave along a face that both edges bound is there as itself and as its image.
      if (faces && leaves.patch != no_index) weight *= 0.5;
      // Three edges along one face: which of the images is which is not kept.
      const bool twice = leaves.patch != no_index && leaves.patch == came.patch;
      EdgeTerms terms =
          edge_terms(plan.request.diffraction_model, faces, wedge, passage, chain.distance[edge_number], wavenumber);
      if (!first && !last)
        for (std::size_t t = 0; t < terms.count; ++t)
          terms.term[t].slope = std::min(terms.term[t].slope, 4 * terms.term[t].plain);
      const ConeFrame in(wedge.direction, k[i]), out(wedge.direction, k[i + 1]);
      std::optional<EdgeFaces> at_faces;
      std::optional<EdgeFaces> at_black_faces;
      const auto meet_faces = [&](ImageRule rule, std::optional<EdgeFaces>& at) {
        if (faces) at.emplace(plan, rule, wedge, passage, band, k[i], k[i + 1], came, leaves);
      };
      if (terms.has(false)) meet_faces(ImageRule::utd, at_faces);
      if (terms.has(true)) meet_faces(ImageRule::black, at_black_faces);
      const auto in_frame = [&](const ComplexVec3& w) -> std::array<Complex, 2> {
        return radio ? std::array<Complex, 2>{dot(w, in.beta), dot(w, in.phi)} : std::array<Complex, 2>{w.x, 0.0};
      };
      const auto out_of_frame = [&](const std::array<Complex, 2>& w) {
        return radio ? combine(w[0], out.beta, w[1], out.phi) : ComplexVec3{w[0], 0.0, 0.0};
      };
      std::array<ChainWave<Pair>, max_terms> arriving, arriving_unseen;
      const auto arrive = [&](const ChainWave<ComplexVec3>& w) -> ChainWave<Pair> {
        return {in_frame(w.whole), edge_number > 1 ? in_frame(w.slope) : Pair{}};
      };
      for (std::size_t a = 0; a < waves; ++a) {
        arriving[a] = arrive(wave[a]);
        if (came.patch != no_index) arriving_unseen[a] = arrive(unseen[a]);
      }
      for (std::size_t t = 0; t < terms.count; ++t) weights[t] = ends.of(terms.term[t]);
      // Weights of both edges of two in a pair of their terms, where ends couple with a term.
      const bool ends_couple = edges == 2 && last && (couples(before) || couples(terms));
      const double coupling = first ? 0 : chain.coupling[edge_number - 1];
      const double apart = 1 / std::sqrt(std::max((1 - coupling) * (1 + coupling), 1e-12));
      const auto both_ends = [&](std::size_t a, std::size_t t) {
        const EdgeTerm &one = before.term[a], &two = terms.term[t];
        const double w = -coupling * one.lit_out * two.lit_in;
        const double q1 = one.sign * one.wave.argument, q2 = two.sign * two.wave.argument;
        Complex weight1 = weights_before[a], weight2 = weights[t];
        if (two.wave.argument < coupled_end)
          weight1 = ends_before->of_pair(weight1, apart * (q1 + w * q2), two, -two.lit_in * chain.end_coupling[0]);
        if (one.wave.argument < coupled_end)
          weight2 = ends.of_pair(weight2, apart * (q2 + w * q1), one, one.lit_out * chain.end_coupling[1]);
        return weight1 * weight2;
      };
      for (std::size_t a = 0; edges == 2 && last && !ends_couple && a < waves; ++a)
        for (std::size_t p = 0; p < 2; ++p) {
          arriving[a].whole[p] *= weights_before[a];
          if (came.patch != no_index) arriving_unseen[a].whole[p] *= weights_before[a];
        }
      // Per term: all that arrives, through its face. A first edge leaves its factors to the pairs with the second.
      std::array<ChainWave<Pair>, max_terms> leaving{}, leaving_unseen;
      for (std::size_t t = 0; t < terms.count; ++t) {
        const EdgeTerm& term = terms.term[t];
        // An image in the face along which it came, mirrored in it again, is the wave itself.
        const bool in_face = !twice && !twice_before && images_in(wedge, term, came.patch);
        ChainWave<Pair> sum{}, mirrored_back{};
        for (std::size_t a = 0; a < waves; ++a) {
          const bool back = in_face && images_in(*wedge_before, before.term[a], came.patch);
          const ChainWave<Pair>& w = back ? arriving_unseen[a] : arriving[a];
          ChainWave<Pair>& into = back ? mirrored_back : sum;
          if (edges > 2 && !first) {
            add(edge_number == 1 ? first_step(before.term[a], term, coupling)
                                 : next_step(before.term[a], term, coupling),
                w, into);
            continue;
          }
          Complex factor = 1;
          if (edge_number == 1)
            factor = pair_wave(before.term[a], term, chain.coupling[0]);
          else if (last)
            factor = term.value();
          if (ends_couple) factor *= both_ends(a, t);
          for (std::size_t p = 0; p < 2; ++p) into.whole[p] += factor * w.whole[p];
        }
        // The first of two edges leaves its weights to the second.
        const Complex there = ends_couple || (edges == 2 && first) ? Complex(1) : weights[t];
        const auto leave = [&](const Pair& w, const Pair& back, Pair& to) {
          const auto seen = faces ? (term.black ? at_black_faces : at_faces)->seen_at(term.boundary, w) : w;
          for (std::size_t p = 0; p < 2; ++p) to[p] += there * (seen[p] + back[p]);
        };
        const bool slopes = !first && !last;
        leave(sum.whole, mirrored_back.whole, leaving[last ? 0 : t].whole);
        if (slopes) leave(sum.slope, mirrored_back.slope, leaving[t].slope);
        if (leaves.patch == no_index) continue;
        for (std::size_t p = 0; p < 2; ++p)
          leaving_unseen[t].whole[p] = there * (sum.whole[p] + mirrored_back.whole[p]);
        for (std::size_t p = 0; p < 2; ++p)
          leaving_unseen[t].slope[p] = there * (sum.slope[p] + mirrored_back.slope[p]);
      }
      waves = last ? 1 : terms.count;
      for (std::size_t a = 0; a < waves; ++a) {
        wave[a] = {out_of_frame(leaving[a].whole), out_of_frame(leaving[a].slope)};
        if (leaves.patch != no_index)
          unseen[a] = {out_of_frame(leaving_unseen[a].whole), out_of_frame(leaving_unseen[a].slope)};
      }
      before = terms;
      wedge_before = &wedge;
      ends_before = ends;
      weights_before = weights;
      came = leaves;
      twice_before = twice;
      ++edge_number;
    }
    const double scale = radio ? wavelength / (4 * pi) : 1 / std::sqrt(4 * pi);
    const Complex carrier =
        weight * std::polar(chain.amplitude * scale * std::exp(-plan.attenuation[band] * geometry.length),
                            -std::remainder(wavenumber * geometry.length, 2 * pi));
    if (radio)
      field[band] = {carrier * dot(wave[0].whole, receiver.theta), carrier * dot(wave[0].whole, receiver.phi)};
    else
      field[band] = {carrier * wave[0].whole.x, 0.0};
  }
}

}  // namespace grimaldi
