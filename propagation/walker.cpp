#include "propagation/walker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/constants.h"
#include "core/random.h"
#include "propagation/edge_visibility.h"
#include "propagation/fermat.h"
#include "propagation/laws/free_space_diffraction.h"

namespace grimaldi {
namespace {

/// Wedges at which a beam that has met faces alone is aimed from each patch that it hits.
constexpr int aims_before_edge = 3;
/// Of the azimuth of a wave that runs along a face, rad.
constexpr double azimuth_rounding = 1e-9;
/// Paths weaker than the wave at 1 m by this factor (140 dB) are not sought.
constexpr double gain_floor = 1e-14;
constexpr std::uint32_t edge_stream = 2;
/// Footprint of a beam over the spacing of the beams of its pass: more than ½ √2, so that every place is in some
/// footprint.
constexpr double footprint_share = 0.75;
/// Near an edge the footprint is never finer than this (rad): more beams then meet each edge more often.
constexpr double coarse_spacing = 0.014;
/// Beams that leave an edge for one that met it: the exterior of an edge is a whole fan of directions. More where the
/// transmitter itself sees the edge, or sees it in a face that it is aimed by: those waves are the strong ones.
constexpr int beams_per_first_edge = 16, beams_per_edge = 6;

struct Beam {
  Vec3 origin, direction;
  std::uint32_t leave0 = no_index, leave1 = no_index;
  double since_vertex = 0;  ///< length since the source or the last edge, m
  double length = 0;        ///< since the transmitter, m
  double power = 1;         ///< share of the launched flux; 0 for beams from edges, which carry none of it
  /// Estimate of the gain at s m since the vertex, faces taken as lossless: strength/(s (s + radius)).
  double strength = 1, radius = 0;
  SequenceHash hash = empty_sequence;
  std::uint8_t depth = 0, reflections = 0, diffractions = 0;
  std::array<Interaction, max_depth> interactions;
};

/// A set of 64-bit keys other than 0.
class KeySet {
 public:
  KeySet() : slots_(1u << 14, 0) {}
  void clear() {
    std::fill(slots_.begin(), slots_.end(), 0);
    used_ = 0;
  }
  /// True if the key was not there.
  bool insert(std::uint64_t key) {
    if (2 * used_ >= slots_.size()) grow();
    if (!place(key)) return false;
    ++used_;
    return true;
  }

 private:
  bool place(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = (key * 0x9e3779b97f4a7c15u) >> 20 & mask;; i = (i + 1) & mask) {
      if (slots_[i] == key) return false;
      if (slots_[i] == 0) {
        slots_[i] = key;
        return true;
      }
    }
  }
  void grow() {
    std::vector<std::uint64_t> old(2 * slots_.size(), 0);
    old.swap(slots_);
    for (const std::uint64_t key : old)
      if (key != 0) place(key);
  }
  std::vector<std::uint64_t> slots_;  ///< 0 = free; small, so that they stay in the cache
  std::size_t used_ = 0;
};

}  // namespace

class Walker::Walk {
 public:
  Walk(const Scene& scene, const Tracer& tracer, const Plan& plan, const Search& search,
       const ReflectanceTable& reflectance, const PatchRims& rims)
      : scene_(scene),
        tracer_(tracer),
        plan_(plan),
        search_(search),
        most_edges_(std::min(most_edges(plan.request), search.most_edges)),
        reflectance_(reflectance),
        rims_(rims),
        keep_all_(!plan.request.receivers.empty()),
        far_(2 * distance(scene.low, scene.high) + double(plan.grid.nx + plan.grid.ny) * plan.grid.cell),
        unit_gain_(plan.request.kind == WaveKind::radio ? std::pow(plan.speed / plan.frequency.front() / (4 * pi), 2)
                                                        : 1 / (4 * pi)) {}

  void begin_block(double spacing, BlockRecords& records) {
    spacing_ = spacing;
    records_ = &records;
    keys_.clear();
    kept_hash_ = empty_sequence;
  }

  /// One launched beam with all that grows out of it.
  void walk(const Vec3& origin, const Vec3& direction, std::uint64_t beam_number) {
    beam_number_ = beam_number;
    draws_ = 0;
    seed_draw_ = beam_number;
    Beam beam;
    beam.origin = origin;
    beam.direction = direction;
    records_->flux.launched += 1;
    follow(beam);
    follow_pending();
  }

  /// A beam aimed at the wedge at the share `along` of its length, straight from the transmitter.
  void walk_to_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint64_t beam_number) {
    beam_number_ = beam_number;
    draws_ = 0;
    seed_draw_ = beam_number;
    Beam beam;
    beam.origin = origin;
    aim(beam, wedge_index, along, beams_per_first_edge);
    follow_pending();
  }

  /// A beam over the wedge towards `target`.
  void walk_over_edge(const Vec3& origin, std::uint32_t wedge_index, double along, const Vec3& target,
                      std::uint64_t beam_number) {
    if (auto beam = over_edge(origin, wedge_index, along, target, beam_number)) {
      keep_if_wanted(*beam);
      follow(*beam);
      follow_pending();
    }
  }

  /// The same towards a point of another wedge: what leaves that one.
  void walk_to_second_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint32_t second,
                           double share, std::uint64_t beam_number) {
    const Wedge& wedge = scene_.wedges.wedges[second];
    const auto beam = over_edge(origin, wedge_index, along, wedge.point(share * wedge.length), beam_number);
    if (!beam) return;
    ++records_->segments;  // whether it takes a ray or not: counts do not depend on what is known
    if (!tracer_.edges().visible(wedge_index, along / scene_.wedges.wedges[wedge_index].length, second, share)) return;
    leave_edge(*beam, second, share * wedge.length, distance(beam->origin, outside(wedge, share * wedge.length)),
               beams_per_edge);
    follow_pending();
  }

  /// A beam by the patch to the wedge: what leaves the wedge.
  void walk_by_mirror(const Vec3& origin, std::uint32_t patch_index, std::uint32_t wedge_index, double share,
                      std::uint64_t beam_number) {
    beam_number_ = beam_number;
    draws_ = 0;
    seed_draw_ = beam_number;
    const Patch& patch = scene_.patches.patches[patch_index];
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    const Vec3 image = mirrored(origin, patch), way = outside(wedge, share * wedge.length) - image;
    const double length = norm(way), towards = dot(way, patch.normal);
    const double part = (patch.offset - dot(patch.normal, image)) / towards;
    if (!(part > 0 && part < 1)) return;
    Beam beam;
    beam.origin = image + part * way;
    beam.direction = way / length;
    beam.since_vertex = beam.length = part * length;
    ++records_->segments;
    const Hit hit = tracer_.nearest(origin, (beam.origin - origin) / beam.length);
    if (hit.triangle == no_index || scene_.patches.triangle_patch[hit.triangle] != patch_index) return;
    beam.leave0 = patch_index;
    append(beam, patch_index);
    ++beam.reflections;
    aim(beam, wedge_index, share, beams_per_first_edge);
    follow_pending();
  }

 private:
  /// The beam that leaves the wedge, met straight from `origin`, towards `target`.
  std::optional<Beam> over_edge(const Vec3& origin, std::uint32_t wedge_index, double along, const Vec3& target,
                                std::uint64_t beam_number) {
    beam_number_ = beam_number;
    draws_ = 0;
    seed_draw_ = beam_number;
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    Beam beam;
    beam.origin = origin;
    auto passed = pass_edge(beam, wedge_index, along, distance(origin, outside(wedge, along)));
    if (!passed) return std::nullopt;
    Beam& child = passed->beam;
    child.direction = normalized(target - child.origin);
    double phi = std::atan2(dot(child.direction, wedge.normal0), dot(child.direction, wedge.along0));
    if (phi < 0) phi += 2 * pi;
    if (phi > wedge.exterior_angle) return std::nullopt;
    child.strength *= diffracted_strength(wedge, passed->phi_in, phi, passed->sin_beta, child.radius);
    return child;
  }

  void follow_pending() {
    while (!pending_.empty()) {
      Beam beam = pending_.back();
      pending_.pop_back();
      follow(beam);
    }
  }

  void follow(Beam& beam) {
    const PlanDescription& request = plan_.request;
    for (;;) {
      const Hit hit = tracer_.nearest(beam.origin, beam.direction, beam.leave0, beam.leave1);
      ++records_->segments;
      record_cells(beam, hit);
      if (hit.triangle == no_index) {
        records_->flux.escaped += beam.power;
        return;
      }
      const std::uint32_t patch_index = scene_.patches.triangle_patch[hit.triangle];
      const Patch& patch = scene_.patches.patches[patch_index];
      const Vec3 point = beam.origin + hit.distance * beam.direction;
      const bool deep = beam.depth >= request.depth;
      // Every edge that the transmitter sees has beams of its own.
      if (!deep && beam.depth > 0 && request.diffraction && beam.diffractions < most_edges_)
        meet_edges(beam, hit, point, patch_index);
      const double cosine = dot(patch.normal, beam.direction);
      const double reflected = beam.power * reflectance_(patch.material, std::abs(cosine));
      records_->flux.absorbed += beam.power - reflected;
      if (deep || !request.reflection || beam.reflections >= request.max_reflections) {
        records_->flux.cut_by_depth += reflected;
        return;
      }
      beam.power = reflected;
      beam.since_vertex += hit.distance;
      beam.length += hit.distance;
      beam.origin = point;
      beam.direction = beam.direction - 2 * cosine * patch.normal;  // stays a unit vector to a few ulp
      beam.leave0 = patch_index;
      beam.leave1 = no_index;
      append(beam, patch_index);
      ++beam.reflections;
      keep_if_wanted(beam);
    }
  }

  static void append(Beam& beam, Interaction interaction) {
    beam.interactions[beam.depth++] = interaction;
    beam.hash = extended(beam.hash, interaction);
  }

  void keep_if_wanted(const Beam& beam) {
    if (keep_all_ && beam.diffractions >= search_.fewest_edges) keep(beam);
  }

  std::uint32_t keep(const Beam& beam) {
    // The cells of one segment, and often those of the next beams, belong to one sequence.
    if (beam.hash != kept_hash_) {
      kept_hash_ = beam.hash;
      kept_number_ = records_->sequences.enter(beam.hash, {beam.interactions.data(), beam.depth});
    }
    return kept_number_;
  }

  void record_cells(const Beam& beam, const Hit& hit) {
    const GridLayout& grid = plan_.grid;
    // The direct wave asks every cell.
    if (grid.nx == 0 || beam.depth == 0 || beam.diffractions < search_.fewest_edges) return;
    const double end = hit.triangle != no_index ? hit.distance : far_;
    const double rise = grid.z - beam.origin.z;
    if (rise * beam.direction.z > 0 && std::abs(rise) < end * std::abs(beam.direction.z))
      record_cell(beam, rise / beam.direction.z, true);
    // A draw from the beam's own number and direction: one cell under the segment.
    seed_draw_ = (seed_draw_ + beam.hash) * 0x9e3779b97f4a7c15u;
    double from = 0, to = end;
    if (clip(beam.origin.x - grid.x0, beam.direction.x, double(grid.nx) * grid.cell, from, to) &&
        clip(beam.origin.y - grid.y0, beam.direction.y, double(grid.ny) * grid.cell, from, to))
      record_cell(beam, from + double(seed_draw_ >> 11) * 0x1p-53 * (to - from), false);
  }

  /// Cuts [from, to] to where 0 ≤ origin + t direction ≤ size. False if nothing is left.
  static bool clip(double origin, double direction, double size, double& from, double& to) {
    if (direction == 0) return origin >= 0 && origin <= size;
    const double inverse = 1 / direction, a = -origin * inverse, b = (size - origin) * inverse;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    return from < to;
  }

  /// Estimated gain `t` m further along the beam.
  static double gain_at(const Beam& beam, double t) {
    const double s = beam.since_vertex + t;
    return beam.strength / (s * (s + beam.radius));
  }

  void record_cell(const Beam& beam, double t, bool crossed) {
    const GridLayout& grid = plan_.grid;
    const double gain = gain_at(beam, t);
    if (gain < gain_floor) return;
    const double x = (beam.origin.x + t * beam.direction.x - grid.x0) / grid.cell;
    const double y = (beam.origin.y + t * beam.direction.y - grid.y0) / grid.cell;
    if (!(x >= 0 && y >= 0 && x < double(grid.nx) && y < double(grid.ny))) return;
    const std::uint64_t cell = std::uint64_t(y) * grid.nx + std::uint64_t(x);
    constexpr double margin = 10;  // the estimate leaves out the second leg's part of L and the shift along the edge
    if (!search_.negligible.empty() && margin * gain * unit_gain_ < search_.negligible[cell]) return;
    if (!keys_.insert(beam.hash ^ ((2 * cell + crossed) * 0xd6e8feb86659fd93u))) return;
    records_->seeds.push_back({keep(beam), static_cast<std::uint32_t>(cell), 0, crossed, static_cast<float>(gain)});
  }

  /// Beams leave those edges of the hit triangle that lie in the footprint, and after faces alone some drawn from the
  /// rims of the hit patch and of the patches next to it (the far side of a roof is grazed, so hardly ever hit).
  void meet_edges(const Beam& beam, const Hit& hit, const Vec3& point, std::uint32_t hit_patch) {
    const Wedges& wedges = scene_.wedges;
    const double reach = footprint_share * std::max(spacing_, coarse_spacing) * (beam.length + hit.distance);
    for (auto i = wedges.triangle_wedge_begin[hit.triangle]; i < wedges.triangle_wedge_begin[hit.triangle + 1]; ++i) {
      const std::uint32_t wedge_index = wedges.triangle_wedge[i];
      const Wedge& wedge = wedges.wedges[wedge_index];
      // The face that the beam comes from cannot send it to its own rim but along itself: that wave is a term of the
      // edge.
      const Interaction last = beam.interactions[beam.depth - 1];
      if (last == wedge.patch0 || last == wedge.patchn || last == edge_interaction(wedge_index)) continue;
      const double along = std::clamp(dot(point - wedge.start, wedge.direction), 0.0, wedge.length);
      if (norm2(point - wedge.point(along)) > reach * reach) continue;
      leave_edge(beam, wedge_index, along, hit.distance, beams_per_edge);
    }
    // Beams that have only been reflected are few, and lead to the strong ones of many edges.
    for (int i = 0; beam.diffractions == 0 && i < aims_before_edge; ++i) {
      const auto u = uniform4(plan_.request.seed, edge_stream, beam_number_, draws_++);
      const std::uint32_t target = pick_near(hit_patch, u);
      if (target != no_index) aim(beam, target, u[3]);
    }
  }

  /// Beams leave a wedge that the beam's last point sees, whichever way the beam went.
  void aim(const Beam& beam, std::uint32_t wedge_index, double share, int fan = beams_per_edge) {
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    if (beam.depth > 0) {
      const Interaction last = beam.interactions[beam.depth - 1];
      if (last == wedge.patch0 || last == wedge.patchn || last == edge_interaction(wedge_index)) return;
    }
    const double along = share * wedge.length;
    const Vec3 seen = outside(wedge, along);
    ++records_->segments;
    if (tracer_.visible(beam.origin, seen)) leave_edge(beam, wedge_index, along, distance(beam.origin, seen), fan);
  }

  /// A point of the edge as rays see it: moved out of the solid.
  Vec3 outside(const Wedge& wedge, double along) const {
    return wedge.point(along) + 3 * tracer_.surface_gap() * wedge.bisector();
  }

  /// The wedge of a patch, or as often of a patch next to it, that the numbers u name.
  std::uint32_t pick_near(std::uint32_t patch, const std::array<double, 4>& u) const {
    const std::uint32_t first = rims_.pick(patch, u[0]);
    if (first == no_index || u[1] >= 0.5) return first;
    const Wedge& wedge = scene_.wedges.wedges[first];
    return rims_.pick(wedge.patch0 == patch ? wedge.patchn : wedge.patch0, u[2]);
  }

  /// A beam about to leave an edge: direction and the edge's factor of its strength are still to be chosen.
  struct PassedEdge {
    Beam beam;
    double phi_in, sin_beta, cos_beta;
  };

  /// Nothing if the wave comes along the edge, through the solid, or too weak.
  std::optional<PassedEdge> pass_edge(const Beam& beam, std::uint32_t wedge_index, double along,
                                      double hit_distance) const {
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    const Vec3 virtual_source = beam.origin - beam.since_vertex * beam.direction;
    const Vec3 way = wedge.point(along) - virtual_source;
    const double incident_length = norm(way);
    if (incident_length < 1e-6) return std::nullopt;
    const Vec3 incident = way / incident_length;
    PassedEdge passed;
    passed.cos_beta = dot(incident, wedge.direction);
    passed.sin_beta = std::sqrt(std::max(0.0, 1 - passed.cos_beta * passed.cos_beta));
    if (passed.sin_beta < 1e-3) return std::nullopt;  // along the edge: no cone
    passed.phi_in = std::atan2(-dot(incident, wedge.normal0), -dot(incident, wedge.along0));
    if (passed.phi_in < -azimuth_rounding) passed.phi_in += 2 * pi;
    if (passed.phi_in > wedge.exterior_angle + azimuth_rounding) return std::nullopt;
    const double gain = gain_at(beam, hit_distance);
    if (gain < gain_floor) return std::nullopt;
    Beam& child = passed.beam;
    child.radius = incident_length;
    child.strength = gain * incident_length;
    child.origin = outside(wedge, along);
    child.leave0 = wedge.patch0;
    child.leave1 = wedge.patchn;
    child.length = beam.length + hit_distance;
    child.power = 0;
    child.hash = beam.hash;
    child.depth = beam.depth;
    child.reflections = beam.reflections;
    child.diffractions = static_cast<std::uint8_t>(beam.diffractions + 1);
    child.interactions = beam.interactions;
    append(child, edge_interaction(wedge_index));
    return passed;
  }

  void leave_edge(const Beam& beam, std::uint32_t wedge_index, double along, double hit_distance, int fan) {
    const Wedge& wedge = scene_.wedges.wedges[wedge_index];
    const auto passed = pass_edge(beam, wedge_index, along, hit_distance);
    if (!passed) return;
    keep_if_wanted(passed->beam);
    for (int i = 0; i < fan; ++i) {
      Beam& child = pending_.emplace_back(passed->beam);
      const double phi = draw_azimuth(wedge, passed->phi_in, passed->sin_beta, child.radius);
      child.strength *= diffracted_strength(wedge, passed->phi_in, phi, passed->sin_beta, child.radius);
      child.direction = normalized(passed->cos_beta * wedge.direction +
                                   passed->sin_beta * (std::cos(phi) * wedge.along0 + std::sin(phi) * wedge.normal0));
    }
  }

  /// Bound on L|ΣU|², m: each of an edge's terms by its asymptote or ½, L by the length of the incident leg.
  double diffracted_strength(const Wedge& wedge, double phi_in, double phi, double sin_beta,
                             double incident_length) const {
    const double wavelength = plan_.speed / plan_.frequency.front();
    double sum = 0;
    for (const double epsilon :
         {std::abs(phi - phi_in) - pi, phi + phi_in - pi, 2 * wedge.exterior_angle - phi - phi_in - pi}) {
      const double v = fresnel_parameter(incident_length, wavelength, sin_beta, epsilon);
      sum += v < 0.45 ? 0.5 : 1 / (std::sqrt(2.0) * pi * v);
      if (!plan_.request.reflection) break;
    }
    return incident_length * sum * sum;
  }

  double draw_azimuth(const Wedge& wedge, double phi_in, double sin_beta, double incident_length) {
    const auto u = uniform4(plan_.request.seed, edge_stream, beam_number_, draws_++);
    if (u[0] < 0.5) return u[1] * wedge.exterior_angle;
    const double boundaries[3] = {phi_in + pi, pi - phi_in, 2 * wedge.exterior_angle - phi_in - pi};
    const int first = std::min(2, static_cast<int>(3 * (2 * u[0] - 1)));
    // ε at which v = 1, for a second leg as long as the first: sin(ε/2) = √(λ/8L)/sin β.
    const double wavelength = plan_.speed / plan_.frequency.front();
    const double scale = std::min(1.0, std::sqrt(wavelength / (4 * incident_length)) / sin_beta);
    for (int i = 0; i < 3; ++i) {
      const double boundary = boundaries[(first + i) % 3];
      if (boundary <= 0 || boundary >= wedge.exterior_angle) continue;
      const double phi = boundary + scale * std::tan(pi * (u[1] - 0.5));
      if (phi > 0 && phi < wedge.exterior_angle) return phi;
    }
    return u[2] * wedge.exterior_angle;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Plan& plan_;
  const Search& search_;
  const int most_edges_;
  const ReflectanceTable& reflectance_;
  const PatchRims& rims_;
  const bool keep_all_;
  const double far_;        ///< beyond everything, m
  const double unit_gain_;  ///< path gain at 1 m
  double spacing_ = 0;
  BlockRecords* records_ = nullptr;
  KeySet keys_;
  SequenceHash kept_hash_ = empty_sequence;  ///< the last sequence entered; the empty one is never kept
  std::uint32_t kept_number_ = 0;
  std::vector<Beam> pending_;
  std::uint64_t beam_number_ = 0;
  std::uint32_t draws_ = 0;
  std::uint64_t seed_draw_ = 0;
};

Walker::Walker(const Scene& scene, const Tracer& tracer, const Plan& plan, const Search& search,
               const ReflectanceTable& reflectance, const PatchRims& rims)
    : walk_(std::make_unique<Walk>(scene, tracer, plan, search, reflectance, rims)) {}
Walker::~Walker() = default;
Walker::Walker(Walker&&) noexcept = default;

void Walker::begin_block(double spacing, BlockRecords& records) { walk_->begin_block(spacing, records); }

void Walker::walk(const Vec3& origin, const Vec3& direction, std::uint64_t beam_number) {
  walk_->walk(origin, direction, beam_number);
}

void Walker::walk_to_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint64_t beam_number) {
  walk_->walk_to_edge(origin, wedge_index, along, beam_number);
}

void Walker::walk_over_edge(const Vec3& origin, std::uint32_t wedge_index, double along, const Vec3& target,
                            std::uint64_t beam_number) {
  walk_->walk_over_edge(origin, wedge_index, along, target, beam_number);
}

void Walker::walk_to_second_edge(const Vec3& origin, std::uint32_t wedge_index, double along, std::uint32_t second,
                                 double share, std::uint64_t beam_number) {
  walk_->walk_to_second_edge(origin, wedge_index, along, second, share, beam_number);
}

void Walker::walk_by_mirror(const Vec3& origin, std::uint32_t patch, std::uint32_t wedge_index, double share,
                            std::uint64_t beam_number) {
  walk_->walk_by_mirror(origin, patch, wedge_index, share, beam_number);
}

}  // namespace grimaldi
