#include "propagation/edge_faces.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/sine_cosine.h"
#include "propagation/face_reflection.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/utd.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

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

/// For a way of that azimuth from the face: ±(π/2 − image_angle).
Turn image_turn(double exterior_angle, double azimuth) {
  const double to_face = image_angle(exterior_angle, azimuth), side = azimuth <= exterior_angle - azimuth ? 1 : -1;
  const SineCosine turn = sine_cosine(to_face);
  return {side * (0.5 * pi - to_face), side * turn.cosine, turn.sine};
}

/// The turn of a way by which the image goes where the `other` way is nearer to a face: that of the mirror's way, or,
/// as both turn to one side, between that and its own.
Turn turn_with(const Turn& turn, const Turn& other) {
  if (std::abs(turn.angle) >= std::abs(other.angle)) return turn;
  if (turn.angle * other.angle <= 0) return -other;
  const double angle = 2 * turn.angle - other.angle;
  const SineCosine turned = sine_cosine(angle);
  return {angle, turned.sine, turned.cosine};
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

}  // namespace

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

EdgeFaces::EdgeFaces(const Plan& plan, ImageRule rule, const Wedge& wedge, const EdgePassage& passage, std::size_t band,
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

ConeField EdgeFaces::seen_at(Boundary boundary, const ConeField& wave) const {
  if (boundary == Boundary::incident) return wave;
  const Dyadic& d = boundary == Boundary::face0 ? face0_ : facen_;
  return {d.bb * wave[0] + d.bp * wave[1], d.pb * wave[0] + d.pp * wave[1]};
}

Dyadic EdgeFaces::dyadic(std::uint32_t patch, std::uint32_t material, const Vec3& normal, double side) const {
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

bool images_in(const Wedge& wedge, const EdgeTerm& term, std::uint32_t face) {
  return face != no_index && ((term.boundary == Boundary::face0 && wedge.patch0 == face) ||
                              (term.boundary == Boundary::facen && wedge.patchn == face));
}

}  // namespace grimaldi
