#include "propagation/field.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/antenna.h"
#include "propagation/face_reflection.h"
#include "propagation/laws/free_space_diffraction.h"

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

/// True if the wave comes from another edge along a face that both bound. What arrives is then the wave and its image
/// in one, and the edge's two terms would count it twice.
bool grazes_common_face(const Scene& scene, Interaction before, const Wedge& wedge, const EdgePassage& passage) {
  if (!is_edge(before)) return false;
  const Wedge& other = scene.wedges.wedges[index_of(before)];
  const auto bounds = [&](std::uint32_t patch) { return other.patch0 == patch || other.patchn == patch; };
  const double grazing = 5e-3 / passage.s_in;  // rad; both edges lie on the face to the millimetres of a patch's plane
  return (passage.phi_in < grazing && bounds(wedge.patch0)) ||
         (passage.phi_in > wedge.exterior_angle - grazing && bounds(wedge.patchn));
}

/// cos of the angle of incidence on the faces of a wedge, the mean of both legs' coefficients makes the term
/// reciprocal.
ReflectionCoefficients wedge_face_reflection(const Plan& plan, std::uint32_t material, std::size_t band,
                                             double sin_beta, double azimuth_in, double azimuth_out) {
  const auto at = [&](double azimuth) {
    return face_reflection(plan, material, band, std::min(1.0, sin_beta * std::abs(std::sin(azimuth))));
  };
  const ReflectionCoefficients in = at(azimuth_in), out = at(azimuth_out);
  return {0.5 * (in.te + out.te), 0.5 * (in.tm + out.tm)};
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
      if (!plan.request.reflection) break;
    }
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
  const bool faces = plan.request.reflection;
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
      const auto term = [&](Boundary boundary) {
        const double epsilon = beyond_boundary(wedge, passage, boundary);
        return edge_wave(fresnel_parameter(effective, wavelength, passage.sin_beta, epsilon), epsilon >= 0);
      };
      const Complex incident = term(Boundary::incident);
      Complex weight = end_weight(wedge, passage, wavelength, wavenumber);
      if (i > 0 && grazes_common_face(scene, interactions[i - 1], wedge, passage)) weight *= 0.5;
      if (radio) {
        Complex beta = incident * dot(e, in.beta), phi = incident * dot(e, in.phi);
        if (faces) {
          const double n = wedge.exterior_angle;
          const Vec3 normaln = std::sin(n) * wedge.along0 - std::cos(n) * wedge.normal0;
          const auto add_image = [&](Boundary boundary, const Vec3& normal, std::uint32_t material, double a,
                                     double b) {
            const auto r = wedge_face_reflection(plan, material, band, passage.sin_beta, a, b);
            const ComplexVec3 image = reflect(e, k[i], normal, r);
            const ConeFrame frame(wedge.direction, k[i] - 2 * dot(k[i], normal) * normal);
            const Complex u = term(boundary);
            beta += u * dot(image, frame.beta);
            phi += u * dot(image, frame.phi);
          };
          add_image(Boundary::face0, wedge.normal0, wedge.material0, passage.phi_in, passage.phi_out);
          if (!wedge.free_rim)
            add_image(Boundary::facen, normaln, wedge.materialn, n - passage.phi_in, n - passage.phi_out);
        }
        e = weight * combine(beta, out.beta, phi, out.phi);
      } else {
        Complex sum = incident;
        if (faces) {
          sum += face_reflection(plan, wedge.material0, band, 1).te * term(Boundary::face0);
          if (!wedge.free_rim) sum += face_reflection(plan, wedge.materialn, band, 1).te * term(Boundary::facen);
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
