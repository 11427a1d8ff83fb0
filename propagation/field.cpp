#include "propagation/field.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/antenna.h"
#include "propagation/face_reflection.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/utd.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;

struct ComplexVec3 {
  Complex x, y, z;
};
ComplexVec3 combine(Complex a, const Vec3& u, Complex b, const Vec3& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}
Complex dot(const ComplexVec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
ComplexVec3 operator*(Complex s, const ComplexVec3& a) { return {s * a.x, s * a.y, s * a.z}; }

/// ε beyond a boundary: > 0 on its dark side, capped at π.
double beyond_boundary(const Wedge& wedge, const EdgePassage& passage, Boundary boundary) {
  const double sum = passage.phi_in + passage.phi_out;
  switch (boundary) {
    case Boundary::incident:
      return std::min(std::abs(passage.phi_in - passage.phi_out) - pi, pi);
    // The two sides of a thin screen are one mirror: its image wave has one edge term, not two (Sommerfeld).
    case Boundary::face0:
      return std::min(wedge.free_rim ? std::min(sum, 4 * pi - sum) - pi : sum - pi, pi);
    case Boundary::facen:
      return std::min(2 * wedge.exterior_angle - sum - pi, pi);
  }
  return pi;
}

/// Unit vectors along and across the edge's cone for a wave of direction k: φ̂ = ê × k/|ê × k|, β̂ = φ̂ × k. Turned about
/// the edge as k is.
struct ConeFrame {
  Vec3 phi, beta;
  ConeFrame(const Vec3& edge, const Vec3& k) : phi(normalized(cross(edge, k))), beta(cross(phi, k)) {}
};

/// Curvature of a wavefront: principal radii along two unit vectors across the ray.
struct Wavefront {
  Vec3 along1, along2;
  double radius1, radius2;
};

/// Reflected field vector; k → k − 2 (k·n) n.
ComplexVec3 reflect(const ComplexVec3& field, const Vec3& k, const Vec3& normal, const ReflectionCoefficients& r) {
  const Vec3 k_out = k - 2 * dot(k, normal) * normal;
  Vec3 s = cross(k, normal);
  const double sine = norm(s);
  s = sine > 1e-9 ? s / sine : perpendicular(normal);  // normal incidence: any direction across serves
  const Complex te = r.te * dot(field, s), tm = r.tm * dot(field, cross(s, k));
  return combine(te, s, tm, cross(s, k_out));
}

/// T of line 6: which part of the edge's wave there is, with its ends.
Complex end_weight(const Wedge& wedge, const EdgePassage& passage, double wavelength, double wavenumber) {
  // An end shared with another wedge is a corner: the product of the two edges' end waves is split between them.
  const auto share = [](std::uint32_t vertex) { return vertex == no_index ? 1.0 : 0.5; };
  Complex weight = passage.inside ? 1.0 : 0.0;
  weight += share(wedge.vertex_start) * edge_end_wave(passage.detour_start, wavelength, wavenumber, passage.along >= 0);
  weight += share(wedge.vertex_end) *
            edge_end_wave(passage.detour_end, wavelength, wavenumber, passage.along <= wedge.length);
  return weight;
}

/// True if the azimuth of a way of length s from the edge runs along its face `patch`.
bool along_face(const Wedge& wedge, std::uint32_t patch, double azimuth, double s) {
  const double grazing = 5e-3 / s;  // rad; edges lie on their face to the millimetres of a patch's plane
  return (patch == wedge.patch0 && azimuth < grazing) ||
         (patch == wedge.patchn && azimuth > wedge.exterior_angle - grazing);
}

/// True if the wave comes from another edge along a face that both bound. What arrives is then the wave and its image
/// in one, and the edge's two terms would count it twice. The same for both directions of the way.
bool grazes_common_face(const Scene& scene, const EdgePassage& before, const EdgePassage& here) {
  const Wedge& first = scene.wedges.wedges[before.wedge];
  const Wedge& second = scene.wedges.wedges[here.wedge];
  for (const std::uint32_t patch : {first.patch0, first.patchn})
    if ((patch == second.patch0 || patch == second.patchn) &&
        (along_face(first, patch, before.phi_out, before.s_out) || along_face(second, patch, here.phi_in, here.s_in)))
      return true;
  return false;
}

/// What a face does to a wave in the cone frames of an edge: rows β̂, φ̂ of the image wave, columns β̂, φ̂ of the incident
/// one.
struct Dyadic {
  Complex bb, bp, pb, pp;
};

Dyadic image_dyadic(const Plan& plan, std::uint32_t material, std::size_t band, const Vec3& edge, const Vec3& k,
                    const Vec3& normal) {
  const double cosine = dot(k, normal);
  const auto r = face_reflection(plan, material, band, std::min(1.0, std::abs(cosine)));
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

/// The mean of the face's dyadic for the way there and, transposed, for the way back (φ̂ turns round with the ray):
/// reciprocal, and unchanged at the reflection boundary, where both are the same.
Dyadic reciprocal_image(const Plan& plan, std::uint32_t material, std::size_t band, const Vec3& edge, const Vec3& k_in,
                        const Vec3& k_out, const Vec3& normal) {
  const Dyadic there = image_dyadic(plan, material, band, edge, k_in, normal);
  const Dyadic back = image_dyadic(plan, material, band, edge, -k_out, normal);
  return {0.5 * (there.bb + back.bb), 0.5 * (there.bp - back.pb), 0.5 * (there.pb - back.bp),
          0.5 * (there.pp + back.pp)};
}

/// The waves of an edge over the incident field continued: of the incident wave and of its images in the two faces.
struct EdgeWaves {
  Complex incident, face0, facen;
};

EdgeWaves edge_waves(DiffractionModel model, bool faces, const Wedge& wedge, const EdgePassage& passage,
                     double effective, double wavenumber) {
  if (model == DiffractionModel::utd) {
    const double phase = wavenumber * effective * passage.sin_beta * passage.sin_beta;
    const auto waves = wedge_waves(wedge.exterior_angle, passage.phi_in, passage.phi_out, {phase, phase, phase, phase},
                                   BoundarySide::lit);
    const auto& t = waves.term;
    // The two sides of a thin screen are one mirror.
    return {t[0] + t[1], wedge.free_rim ? t[2] + t[3] : t[3], t[2]};
  }
  const auto wave = [&](Boundary boundary) {
    const double epsilon = beyond_boundary(wedge, passage, boundary);
    // On the boundary itself the way past the edge counts as free, as shadow rays have it.
    return edge_wave(fresnel_parameter(effective, 2 * pi / wavenumber, passage.sin_beta, epsilon), epsilon > 0);
  };
  if (!faces) return {wave(Boundary::incident), 0, 0};
  return {wave(Boundary::incident), wave(Boundary::face0), wedge.free_rim ? 0 : wave(Boundary::facen)};
}

/// True if the faces of an edge have waves of their own.
bool faces_count(const Plan& plan) {
  return plan.request.reflection || plan.request.diffraction_model == DiffractionModel::utd;
}

/// Bound on |U| of a straight edge: its value at the boundary, its asymptote beyond (|w| decreases and stays below
/// √2/(π v)).
double edge_wave_bound(double v) { return v < 0.45 ? 0.5 : 1 / (std::sqrt(2.0) * pi * v); }

}  // namespace

double power_bound(const Scene& scene, const Plan& plan, const PathGeometry& geometry) {
  const double wavelength = 2 * pi / plan.wavenumber.front();
  constexpr double highest_gain = 1.65;
  double bound =
      plan.request.kind == WaveKind::radio ? highest_gain * std::pow(wavelength / (4 * pi), 2) : 1 / (4 * pi);
  // Lengths of a chain of edges: √L √(ρ/(s(s+ρ))) with L ≤ s_out, and ρ at most the whole way so far.
  double way = geometry.edge_count == 0 ? geometry.length : geometry.edges[0].s_in;
  bound /= way * way;
  for (std::size_t i = 0; i < geometry.edge_count; ++i) {
    const EdgePassage& passage = geometry.edges[i];
    const Wedge& wedge = scene.wedges.wedges[passage.wedge];
    const double effective = passage.s_in * passage.s_out / (passage.s_in + passage.s_out);
    double sum = 0;
    for (const Boundary boundary : {Boundary::incident, Boundary::face0, Boundary::facen}) {
      sum += edge_wave_bound(
          fresnel_parameter(effective, wavelength, passage.sin_beta, beyond_boundary(wedge, passage, boundary)));
      if (!faces_count(plan)) break;
    }
    // UTD has a second incident term, the one of the boundary beside the other face.
    if (plan.request.diffraction_model == DiffractionModel::utd)
      sum += edge_wave_bound(fresnel_parameter(effective, wavelength, passage.sin_beta, pi));
    if (!passage.inside) sum *= 0.75;
    bound *= sum * sum * effective * way / (passage.s_out * (passage.s_out + way));
    way += passage.s_out;
  }
  return bound;
}

double boundary_parameter(const Scene& scene, const PathGeometry& geometry, std::size_t edge, Boundary boundary,
                          double wavelength) {
  const EdgePassage& passage = geometry.edges[edge];
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
  const std::size_t legs = geometry.count - 1;
  std::array<Vec3, max_depth + 1> k;
  for (std::size_t i = 0; i < legs; ++i) k[i] = normalized(geometry.points[i + 1] - geometry.points[i]);
  const Vec3 launched = radio ? radiated_field(transmitter.antenna, k[0]) : Vec3{};
  const PolarFrame receiver = polar_frame(-k[legs - 1]);

  for (std::size_t band = 0; band < plan.bands(); ++band) {
    const double wavenumber = plan.wavenumber[band], wavelength = 2 * pi / wavenumber;
    ComplexVec3 e{launched.x, launched.y, launched.z};
    Complex pressure = 1;
    double amplitude = geometry.edge_count == 0 ? 1 / geometry.length : 1 / geometry.edges[0].s_in;
    Wavefront front{};
    std::size_t edge_number = 0;
    for (std::size_t i = 0; i < interactions.size(); ++i) {
      if (!is_edge(interactions[i])) {
        const Patch& patch = scene.patches.patches[interactions[i]];
        const auto r = face_reflection(plan, patch.material, band, std::min(1.0, std::abs(dot(k[i], patch.normal))));
        if (radio)
          e = reflect(e, k[i], patch.normal, r);
        else
          pressure *= r.te;
        // A mirror turns the principal directions of the wavefront and leaves its radii.
        for (Vec3* along : {&front.along1, &front.along2}) *along -= 2 * dot(*along, patch.normal) * patch.normal;
        continue;
      }
      const EdgePassage& passage = geometry.edges[edge_number];
      const Wedge& wedge = scene.wedges.wedges[passage.wedge];
      const ConeFrame in(wedge.direction, k[i]), out(wedge.direction, k[i + 1]);
      // Radius of the incident wavefront in the plane of the ray and the edge, and effective distance.
      double radius = passage.s_in, effective = passage.s_in * passage.s_out / (passage.s_in + passage.s_out);
      if (edge_number > 0) {
        const double c1 = dot(front.along1, in.beta), c2 = dot(front.along2, in.beta);
        radius = 1 / (c1 * c1 / front.radius1 + c2 * c2 / front.radius2);
        effective = passage.s_out * (radius + passage.s_out) * front.radius1 * front.radius2 /
                    (radius * (front.radius1 + passage.s_out) * (front.radius2 + passage.s_out));
      }
      const EdgeWaves u = edge_waves(plan.request.diffraction_model, faces, wedge, passage, effective, wavenumber);
      Complex weight = end_weight(wedge, passage, wavelength, wavenumber);
      if (i > 0 && is_edge(interactions[i - 1]) && grazes_common_face(scene, geometry.edges[edge_number - 1], passage))
        weight *= 0.5;
      if (radio) {
        Complex beta = u.incident * dot(e, in.beta), phi = u.incident * dot(e, in.phi);
        if (faces) {
          const Complex e_beta = dot(e, in.beta), e_phi = dot(e, in.phi);
          const auto add_image = [&](Complex image, const Vec3& normal, std::uint32_t material) {
            const Dyadic d = reciprocal_image(plan, material, band, wedge.direction, k[i], k[i + 1], normal);
            beta += image * (d.bb * e_beta + d.bp * e_phi);
            phi += image * (d.pb * e_beta + d.pp * e_phi);
          };
          add_image(u.face0, wedge.normal0, wedge.material0);
          if (!wedge.free_rim) add_image(u.facen, wedge.normaln(), wedge.materialn);
        }
        e = weight * combine(beta, out.beta, phi, out.phi);
      } else {
        Complex sum = u.incident;
        if (faces) {
          sum += face_reflection(plan, wedge.material0, band, 1).te * u.face0;
          if (!wedge.free_rim) sum += face_reflection(plan, wedge.materialn, band, 1).te * u.facen;
        }
        pressure *= weight * sum;
      }
      amplitude *= std::sqrt(effective * radius / (passage.s_out * (passage.s_out + radius)));
      front = {out.phi, out.beta, passage.s_out, radius + passage.s_out};
      ++edge_number;
    }
    const double scale = radio ? wavelength / (4 * pi) : 1 / std::sqrt(4 * pi);
    const Complex carrier = std::polar(amplitude * scale * std::exp(-plan.attenuation[band] * geometry.length),
                                       -std::remainder(wavenumber * geometry.length, 2 * pi));
    if (radio)
      field[band] = {carrier * dot(e, receiver.theta), carrier * dot(e, receiver.phi)};
    else
      field[band] = {carrier * pressure, 0.0};
  }
}

}  // namespace grimaldi
