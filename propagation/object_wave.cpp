#include "propagation/object_wave.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "propagation/antenna.h"
#include "propagation/edge_model.h"
#include "propagation/face_reflection.h"
#include "propagation/field_vector.h"
#include "propagation/laws/triangle_transform.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using BandField = std::array<Complex, 2>;

/// A path over one edge of a small object, or over two in a row, unfolded about the object.
struct ObjectPath {
  const SmallObject* object = nullptr;
  std::size_t position = 0;  ///< of the first edge in the sequence
  std::size_t edges = 1;
  Vec3 source, receiver;  ///< as the object sees them
  Vec3 in, out;           ///< unit directions
  double s_in = 0, s_out = 0;
  double share(double wavelength) const {
    return polygon_share(object->diameter, object->flat(), s_in, s_out, wavelength);
  }
};

ObjectPath object_path(const Scene& scene, const Plan& plan, const Vec3& source,
                       std::span<const Interaction> interactions, const PathGeometry& geometry) {
  ObjectPath path;
  if (geometry.edge_count == 0 || geometry.edge_count > 2) return path;
  const SmallObject* const object = plan.small_objects.at(geometry.edges[0].wedge);
  const auto& patches = scene.patches.patches;
  while (!is_edge(interactions[path.position])) ++path.position;
  path.edges = geometry.edge_count;
  if (object == nullptr || !is_edge(interactions[path.position + path.edges - 1]) ||
      plan.small_objects.at(geometry.edges[path.edges - 1].wedge) != object)
    return path;
  path.object = object;
  path.source = source;
  for (std::size_t i = 0; i < path.position; ++i) path.source = mirrored(path.source, patches[interactions[i]]);
  path.receiver = geometry.points[geometry.count - 1];
  for (std::size_t i = interactions.size(); i-- > path.position + path.edges;)
    path.receiver = mirrored(path.receiver, patches[interactions[i]]);
  const Vec3 in = path.object->centre - path.source, out = path.receiver - path.object->centre;
  path.s_in = norm(in);
  path.s_out = norm(out);
  path.in = in / path.s_in;
  path.out = out / path.s_out;
  return path;
}

Vec3 mirrored_direction(const Vec3& k, const Vec3& normal) { return k - 2 * dot(k, normal) * normal; }

/// A field across `from` turned as `from` turns to `to`.
ComplexVec3 turned(const ComplexVec3& field, const Vec3& from, const Vec3& to) {
  const Complex part = -dot(field, to) / std::max(1 + dot(from, to), 1e-12);
  const Vec3 sum = from + to;
  return {field.x + part * sum.x, field.y + part * sum.y, field.z + part * sum.z};
}

/// ∫ e^{−jk(i−o)·r} dS over a triangle, r from the object's centre, times the mean of what the true distances bring.
Complex surface_integral(const ObjectPath& path, const std::array<Vec3, 3>& corner, const Vec3& normal,
                         double wavenumber) {
  const Vec3 e1 = normalized(corner[1] - corner[0]), e2 = cross(normal, e1);
  const Vec3 turn = path.in - path.out;
  AmplitudeTriangle triangle;
  Complex mean = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 way = corner[i] - corner[0];
    triangle.corner[i] = {dot(way, e1), dot(way, e2)};
    // The middles of the sides: exact for the second powers.
    const Vec3 middle = 0.5 * (corner[i] + corner[(i + 1) % 3]);
    const double in = distance(path.source, middle), out = distance(middle, path.receiver);
    const double excess = in + out - path.s_in - path.s_out - dot(turn, middle - path.object->centre);
    mean += std::polar(path.s_in * path.s_out / (3 * in * out), -wavenumber * excess);
  }
  triangle.amplitude = {1, 1, 1};
  return mean * std::polar(1.0, -wavenumber * dot(turn, corner[0] - path.object->centre)) *
         triangle_transform(triangle, {wavenumber * dot(turn, e1), wavenumber * dot(turn, e2)});
}

/// What the object scatters towards the receiver, at one band, in the direction `out`.
ComplexVec3 scattered(const Plan& plan, const ObjectPath& path, const ComplexVec3& incident, std::size_t band) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const double wavenumber = plan.wavenumber[band];
  Complex black = 0;
  ComplexVec3 sum{};
  const auto add = [&](const ComplexVec3& wave, Complex factor) {
    sum.x += factor * wave.x, sum.y += factor * wave.y, sum.z += factor * wave.z;
  };
  for (const auto& [corner, material, patch] : path.object->faces) {
    const Vec3 normal = normalized(cross(corner[1] - corner[0], corner[2] - corner[0]));
    const double x = dot(normal, path.in), y = dot(normal, path.out), size = std::abs(x) + std::abs(y);
    if (size < 1e-9) continue;  // both along the face
    const Complex integral = surface_integral(path, corner, normal, wavenumber);
    black += (path.object->flat() ? 0.5 : 0.25) * (x + y) * (x + y) / size * integral;
    const bool sends_back = path.object->flat() ? x * y < 0 : x < 0 && y > 0;
    if (!sends_back) continue;
    const auto there = face_reflection(plan, material, band, std::abs(x)),
               back = face_reflection(plan, material, band, std::abs(y));
    const ReflectionCoefficients r{0.5 * (there.te + back.te), 0.5 * (there.tm + back.tm)};
    const Complex factor = 2 * std::abs(x * y) / size * integral;
    if (radio)
      add(turned(reflect(incident, path.in, normal, r), mirrored_direction(path.in, normal), path.out), factor);
    else
      add(incident, r.te * factor);
  }
  add(radio ? turned(incident, path.in, path.out) : incident, -black);
  const Complex spread =
      Complex(0, wavenumber / (2 * pi)) *
      std::polar(1 / (path.s_in * path.s_out), -std::remainder(wavenumber * (path.s_in + path.s_out), 2 * pi));
  return {spread * sum.x, spread * sum.y, spread * sum.z};
}

/// The object's wave as the receiver takes it, all bands.
void object_wave(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                 std::span<const Interaction> interactions, const ObjectPath& path, std::span<BandField> field) {
  const bool radio = plan.request.kind == WaveKind::radio;
  const auto& patches = scene.patches.patches;
  Vec3 launch = path.in;
  for (std::size_t i = path.position; i-- > 0;) launch = mirrored_direction(launch, patches[interactions[i]].normal);
  const Vec3 launched = radio ? radiated_field(transmitter.antenna, launch) : Vec3{1, 0, 0};
  const auto pass_faces = [&](std::size_t first, std::size_t last, Vec3 k, ComplexVec3& wave, std::size_t band) {
    for (std::size_t i = first; i < last; ++i) {
      const Patch& patch = patches[interactions[i]];
      const auto r = face_reflection(plan, patch.material, band, std::min(1.0, std::abs(dot(k, patch.normal))));
      if (radio)
        wave = reflect(wave, k, patch.normal, r);
      else
        wave.x *= r.te;
      k = mirrored_direction(k, patch.normal);
    }
    return k;
  };
  for (std::size_t band = 0; band < plan.bands(); ++band) {
    ComplexVec3 wave{launched.x, launched.y, launched.z};
    pass_faces(0, path.position, launch, wave, band);
    wave = scattered(plan, path, wave, band);
    const Vec3 arriving = pass_faces(path.position + path.edges, interactions.size(), path.out, wave, band);
    const double scale = (radio ? 1 / (2 * plan.wavenumber[band]) : 1 / std::sqrt(4 * pi)) *
                         std::exp(-plan.attenuation[band] * (path.s_in + path.s_out));
    const PolarFrame receiver = polar_frame(-arriving);
    if (radio)
      field[band] = {scale * dot(wave, receiver.theta), scale * dot(wave, receiver.phi)};
    else
      field[band] = {scale * wave.x, 0.0};
  }
}

/// Adds `sign` times the wave of the sequence with the edge taken out (face = no_index) or replaced by a face, where
/// the object stands in its way or reflects it.
void add_bounded_wave(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                      std::span<const Interaction> interactions, const ObjectPath& path, const Vec3& receiver,
                      std::uint32_t face, std::span<BandField> field) {
  std::vector<Interaction> bounded(interactions.begin(), interactions.end());
  const auto here = bounded.begin() + static_cast<std::ptrdiff_t>(path.position);
  bounded.erase(here, here + static_cast<std::ptrdiff_t>(path.edges));
  if (face != no_index) bounded.insert(bounded.begin() + static_cast<std::ptrdiff_t>(path.position), face);
  PathGeometry geometry;
  UnfoldedSequence unfolded(scene, transmitter.position, bounded);
  if (!unfolded.solve_in_planes(receiver, 2 * pi / plan.wavenumber.front(), geometry)) return;
  const Vec3 &from = geometry.points[path.position], &to = geometry.points[path.position + 1];
  if (face == no_index) {
    if (!crosses(*path.object, from, to)) return;
  } else {
    // The mirror's point lies on the face, and nothing of the object before it.
    const Vec3 hair = 1e-3 * path.object->diameter * normalized(to - from);
    if (!crosses(*path.object, face, from, to + hair) || crosses(*path.object, from, to - hair)) return;
  }
  std::vector<BandField> wave(plan.bands());
  path_field(scene, plan, transmitter, bounded, geometry, wave);
  const double sign = face == no_index ? 1 : -1;
  for (std::size_t band = 0; band < plan.bands(); ++band)
    for (std::size_t p = 0; p < 2; ++p) field[band][p] += sign * wave[band][p];
}

/// Whether a path may bring its object's wave: over one edge; over two only in the object's shadow, where no edge may
/// be seen from both ends. (Two edges are not tied to the direct wave.)
bool brings_object(const ObjectPath& path) {
  if (path.object == nullptr) return false;
  return path.edges == 1 ||
         (path.object->kind != ObjectKind::opening && crosses(*path.object, path.source, path.receiver));
}

/// Shares of the models in the wave of one edge, at the first band.
std::array<double, edge_model_count> edge_shares(const Scene& scene, const Plan& plan, const Vec3& source,
                                                 std::span<const Interaction> interactions,
                                                 const PathGeometry& geometry, std::size_t edge) {
  const double wavelength = 2 * pi / plan.wavenumber.front();
  double polygon = 0;
  if (!plan.small_objects.objects.empty())
    if (const ObjectPath path = object_path(scene, plan, source, interactions, geometry); path.object != nullptr)
      polygon = path.share(wavelength);
  const EdgePassage& passage = geometry.edges[edge];
  const double utd =
      utd_share(plan.request.diffraction_model, scene.wedges.wedges[passage.wedge].length, passage, wavelength);
  return {(1 - polygon) * utd, (1 - polygon) * (1 - utd), polygon, 0};
}

}  // namespace

SequenceHash object_name(const Scene& scene, const Plan& plan, const Vec3& source,
                         std::span<const Interaction> interactions, const PathGeometry& geometry) {
  if (plan.small_objects.objects.empty()) return 0;
  const ObjectPath path = object_path(scene, plan, source, interactions, geometry);
  if (!brings_object(path) || path.share(2 * pi / plan.wavenumber.front()) == 0) return 0;
  const auto number = static_cast<std::uint32_t>(path.object - plan.small_objects.objects.data());
  SequenceHash name = empty_sequence;
  for (std::size_t i = 0; i < interactions.size(); ++i)
    if (i == path.position || !is_edge(interactions[i]))
      name = extended(name, is_edge(interactions[i]) ? edge_interaction(number) : interactions[i]);
  return name;
}

bool carries_object(std::span<const Arrival> before, SequenceHash name) {
  return name == 0 || std::none_of(before.begin(), before.end(), [&](const Arrival& a) { return a.object == name; });
}

void arrival_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                   std::span<const Interaction> interactions, const PathGeometry& geometry, bool carries,
                   std::span<BandField> field) {
  path_field(scene, plan, transmitter, interactions, geometry, field);
  if (plan.small_objects.objects.empty()) return;
  const ObjectPath path = object_path(scene, plan, transmitter.position, interactions, geometry);
  if (path.object == nullptr) return;
  std::vector<double> share(plan.bands());
  for (std::size_t band = 0; band < plan.bands(); ++band) share[band] = path.share(2 * pi / plan.wavenumber[band]);
  if (share.front() == 0) return;  // N is least at the longest wave
  std::vector<BandField> whole(plan.bands());
  if (carries && brings_object(path)) {
    object_wave(scene, plan, transmitter, interactions, path, whole);
    const Vec3& receiver = geometry.points[geometry.count - 1];
    add_bounded_wave(scene, plan, transmitter, interactions, path, receiver, no_index, whole);
    std::vector<std::uint32_t> faces;
    // Faces of the path and the object's own.
    const auto reflections = static_cast<int>(interactions.size() - path.edges + 1);
    if (plan.request.reflection && reflections <= plan.request.max_reflections)
      for (const ObjectFace& face : path.object->faces)
        if (std::find(faces.begin(), faces.end(), face.patch) == faces.end()) faces.push_back(face.patch);
    for (const std::uint32_t face : faces)
      add_bounded_wave(scene, plan, transmitter, interactions, path, receiver, face, whole);
    if (path.object->kind == ObjectKind::opening)
      for (BandField& wave : whole) wave = {-wave[0], -wave[1]};
  }
  for (std::size_t band = 0; band < plan.bands(); ++band)
    for (std::size_t p = 0; p < 2; ++p)
      field[band][p] = (1 - share[band]) * field[band][p] + share[band] * whole[band][p];
}

std::array<double, edge_model_count> model_shares(const Scene& scene, const Plan& plan, const Vec3& source,
                                                  std::span<const Interaction> interactions,
                                                  const PathGeometry& geometry) {
  std::array<double, edge_model_count> shares{};
  for (std::size_t e = 0; e < geometry.edge_count; ++e) {
    const auto of_edge = edge_shares(scene, plan, source, interactions, geometry, e);
    for (std::size_t m = 0; m < edge_model_count; ++m) shares[m] += of_edge[m] / double(geometry.edge_count);
  }
  return shares;
}

std::string model_words(const Scene& scene, const Plan& plan, const Vec3& source,
                        std::span<const Interaction> interactions, const PathGeometry& geometry) {
  std::string words;
  for (std::size_t e = 0; e < geometry.edge_count; ++e) {
    const auto shares = edge_shares(scene, plan, source, interactions, geometry, e);
    if (!words.empty()) words += ' ';
    words += edge_model_names[std::max_element(shares.begin(), shares.end()) - shares.begin()];
  }
  return words;
}

}  // namespace grimaldi
