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

constexpr std::size_t no_edge = max_edges;

/// Name of the wave of the small object that a path passes over one edge or over two in a row, with its faces: the same
/// for all such paths. Edge number `other` is left out. 0 if there is none.
SequenceHash wave_name(const SmallObjects& objects, std::span<const Interaction> interactions,
                       std::size_t other = no_edge) {
  SequenceHash name = empty_sequence;
  std::uint32_t object = no_index;
  std::size_t edge = 0, passed = 0, last = 0;
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    if (!is_edge(interactions[i])) {
      name = extended(name, interactions[i]);
      continue;
    }
    if (edge++ == other) continue;
    const std::uint32_t here = objects.of_wedge[index_of(interactions[i])];
    if (here == no_index || passed == 2 || (passed == 1 && (here != object || i != last + 1))) return 0;
    if (++passed == 1) name = extended(name, edge_interaction(here));
    object = here;
    last = i;
  }
  return passed > 0 ? name : 0;
}

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
  if (wave_name(plan.small_objects, interactions) == 0) return path;
  const auto& patches = scene.patches.patches;
  while (!is_edge(interactions[path.position])) ++path.position;
  path.edges = geometry.edge_count;
  path.object = plan.small_objects.at(geometry.edges[0].wedge);
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
                                                 const Arrival& arrival, std::size_t edge) {
  const double wavelength = 2 * pi / plan.wavenumber.front();
  double polygon = 0;
  if (!plan.small_objects.objects.empty())
    if (const ObjectPath path = object_path(scene, plan, source, arrival.interactions, arrival.geometry);
        path.object != nullptr)
      polygon = arrival.whole * path.share(wavelength);
  const EdgePassage& passage = arrival.geometry.edges[edge];
  const double utd =
      utd_share(plan.request.diffraction_model, scene.wedges.wedges[passage.wedge].length, passage, wavelength);
  return {(1 - polygon) * utd, (1 - polygon) * (1 - utd), polygon, 0};
}

/// How far the next edge's point lies off the straight way over edge number `other`, first or last of the path, m.
double clearance(const Arrival& arrival, std::size_t other) {
  const PathGeometry& geometry = arrival.geometry;
  std::size_t at = 0;
  for (std::size_t edge = 0;; ++at)
    if (is_edge(arrival.interactions[at]) && edge++ == other) break;
  const auto& points = geometry.points;
  const Vec3 in = normalized(points[at + 1] - points[at]), out = normalized(points[at + 2] - points[at + 1]);
  const double to_object = other == 0 ? geometry.edges[other].s_out : geometry.edges[other].s_in;
  return dot(in, out) > 0 ? to_object * norm(cross(in, out)) : to_object;
}

/// The wave of one object, before and behind the same faces, that paths at a point share.
struct SharedWave {
  SequenceHash name;
  double whole = 1;
  bool carried = false;
};

}  // namespace

void arrival_field(const Scene& scene, const Plan& plan, const Transmitter& transmitter,
                   std::span<const Interaction> interactions, const PathGeometry& geometry, bool carries, double part,
                   std::span<BandField> field) {
  path_field(scene, plan, transmitter, interactions, geometry, field);
  if (plan.small_objects.objects.empty()) return;
  const ObjectPath path = object_path(scene, plan, transmitter.position, interactions, geometry);
  if (path.object == nullptr) return;
  std::vector<double> share(plan.bands());
  for (std::size_t band = 0; band < plan.bands(); ++band)
    share[band] = part * path.share(2 * pi / plan.wavenumber[band]);
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

void object_fields(const Scene& scene, const Plan& plan, const Transmitter& transmitter, std::span<Arrival> arrivals) {
  const SmallObjects& objects = plan.small_objects;
  if (objects.objects.empty()) return;
  std::vector<SharedWave> waves;
  const auto wave_of = [&](SequenceHash name) {
    return std::find_if(waves.begin(), waves.end(), [&](const SharedWave& wave) { return wave.name == name; });
  };
  for (const Arrival& arrival : arrivals) {
    const SequenceHash name = wave_name(objects, arrival.interactions);
    if (name != 0 && wave_of(name) == waves.end()) waves.push_back({name});
  }
  if (waves.empty()) return;
  for (const Arrival& arrival : arrivals) {
    const std::size_t edges = arrival.geometry.edge_count;
    for (const std::size_t other : {std::size_t(0), edges - 1}) {
      if (edges < 2) continue;
      const SmallObject* const next = objects.at(arrival.geometry.edges[other == 0 ? 1 : other - 1].wedge);
      const auto wave = wave_of(wave_name(objects, arrival.interactions, other));
      if (wave == waves.end() || next == objects.at(arrival.geometry.edges[other].wedge)) continue;
      wave->whole = std::min(wave->whole, clear_share(next->diameter, clearance(arrival, other)));
    }
  }
  const double wavelength = 2 * pi / plan.wavenumber.front();
  for (Arrival& arrival : arrivals) {
    const auto wave = wave_of(wave_name(objects, arrival.interactions));
    if (wave == waves.end()) continue;
    arrival.whole = wave->whole;
    const ObjectPath path = object_path(scene, plan, transmitter.position, arrival.interactions, arrival.geometry);
    const bool carries = !wave->carried && brings_object(path) && path.share(wavelength) > 0;
    wave->carried = wave->carried || carries;
    arrival_field(scene, plan, transmitter, arrival.interactions, arrival.geometry, carries, wave->whole,
                  arrival.field);
  }
}

std::array<double, edge_model_count> model_shares(const Scene& scene, const Plan& plan, const Vec3& source,
                                                  const Arrival& arrival) {
  std::array<double, edge_model_count> shares{};
  const std::size_t edges = arrival.geometry.edge_count;
  for (std::size_t e = 0; e < edges; ++e) {
    const auto of_edge = edge_shares(scene, plan, source, arrival, e);
    for (std::size_t m = 0; m < edge_model_count; ++m) shares[m] += of_edge[m] / double(edges);
  }
  return shares;
}

std::string model_words(const Scene& scene, const Plan& plan, const Vec3& source, const Arrival& arrival) {
  std::string words;
  for (std::size_t e = 0; e < arrival.geometry.edge_count; ++e) {
    const auto shares = edge_shares(scene, plan, source, arrival, e);
    if (!words.empty()) words += ' ';
    words += edge_model_names[std::max_element(shares.begin(), shares.end()) - shares.begin()];
  }
  return words;
}

}  // namespace grimaldi
