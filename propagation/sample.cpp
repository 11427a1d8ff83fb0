#include "propagation/sample.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <span>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"
#include "propagation/antenna.h"
#include "propagation/face_reflection.h"
#include "propagation/fermat.h"
#include "propagation/laws/edge_sampling.h"
#include "propagation/laws/free_space_diffraction.h"

namespace grimaldi {
namespace {

constexpr std::uint32_t sample_stream = 5;
constexpr std::uint64_t block_size = 4096, blocks_at_once = 256;
/// Points of an edge's line further beyond its end than this v_V are not sampled (nor connected).
constexpr double end_parameter_limit = 3;

/// The transmitter or its image in one patch after the other.
struct Lamp {
  Vec3 position;
  std::vector<std::uint32_t> patches;  ///< in the order of the wave
  std::vector<Vec3> images;            ///< transmitter, its image in the first patch …; the last is `position`
};

/// One wedge as one lamp shines on it.
struct Lit {
  std::uint32_t lamp, wedge;
  EdgeSector sector;
  double axial, radial;         ///< of the lamp in the wedge's frame, m from its start
  double angle_from, angle_to;  ///< atan((t − axial)/radial) at the ends of the sampled part
  double cumulative;            ///< probability of this and all before
  double probability;
};

struct Crossing {
  std::uint32_t cell;
  double gain;
};

/// Power that one sample of a block or a whole block brings to a cell.
struct Tally {
  std::uint32_t cell, hits;
  double sum, squares;
};

class EdgeSampler {
 public:
  EdgeSampler(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
              const CoverageGrid& grid, std::uint64_t samples, std::size_t band, const SampledClasses& classes)
      : scene_(scene),
        tracer_(tracer),
        plan_(plan),
        transmitter_(plan.request.transmitters[transmitter]),
        grid_(grid),
        samples_(samples),
        band_(band),
        wavelength_(2 * pi / plan.wavenumber[band]),
        classes_(classes),
        radio_(plan.request.kind == WaveKind::radio) {
    if (!plan.request.diffraction || plan.request.max_diffractions < 1 || plan.request.depth < 1) return;
    add_lamps();
    add_wedges();
  }

  bool empty() const { return lit_.empty(); }

  /// Adds the crossings of sample `index`, one for each cell.
  void sample(std::uint64_t index, std::vector<Crossing>& crossings) const {
    const auto u = uniform4(plan_.request.seed, sample_stream, index, 0);
    const auto found =
        std::lower_bound(lit_.begin(), lit_.end(), u[0], [](const Lit& a, double x) { return a.cumulative < x; });
    const Lit& lit = found == lit_.end() ? lit_.back() : *found;
    const Wedge& wedge = scene_.wedges.wedges[lit.wedge];
    const Lamp& lamp = lamps_[lit.lamp];
    const double angle = lit.angle_from + u[1] * (lit.angle_to - lit.angle_from);
    Start start{lit, wedge, {}};
    start.along = lit.axial + lit.radial * std::tan(angle);
    start.point = wedge.point(start.along);
    start.s_in = lit.radial / std::cos(angle);
    start.sin_beta = std::cos(angle);
    const AzimuthLaw law(lit.sector, start.s_in, wavelength_, start.sin_beta);
    start.phi = law.draw(u[2], u[3]);
    // Density of the point along the edge: dθ/dt = ρ/s'².
    const double density = lit.probability * lit.radial / (start.s_in * start.s_in * (lit.angle_to - lit.angle_from)) *
                           law.density(start.phi);
    const double arrived = arriving_power(lamp, wedge, start);
    if (arrived == 0) return;
    start.weight =
        arrived / (4 * pi * start.s_in * start.s_in) * start.sin_beta * start.sin_beta / (density * double(samples_));
    follow(lamp, start, crossings);
  }

 private:
  struct Start {
    const Lit& lit;
    const Wedge& wedge;
    Vec3 point;
    double along = 0, s_in = 0, sin_beta = 1, phi = 0, weight = 0;
  };

  void add_lamps() {
    lamps_.push_back({transmitter_.position, {}, {transmitter_.position}});
    const int before = plan_.request.reflection
                           ? std::min({classes_.before, plan_.request.max_reflections, plan_.request.depth - 1})
                           : 0;
    std::size_t first = 0;
    for (int order = 0; order < before; ++order) {
      const std::size_t last = lamps_.size();
      for (std::size_t l = first; l < last; ++l)
        for (std::uint32_t p = 0; p < scene_.patches.patches.size(); ++p) {
          if (!lamps_[l].patches.empty() && lamps_[l].patches.back() == p) continue;
          Lamp next = lamps_[l];
          next.position = mirrored(next.position, scene_.patches.patches[p]);
          next.patches.push_back(p);
          next.images.push_back(next.position);
          lamps_.push_back(std::move(next));
        }
      first = last;
    }
  }

  void add_wedges() {
    double sum = 0;
    for (std::uint32_t l = 0; l < lamps_.size(); ++l)
      for (std::uint32_t w = 0; w < scene_.wedges.wedges.size(); ++w) {
        Lit lit{};
        lit.lamp = l;
        lit.wedge = w;
        if (!lights(lamps_[l], scene_.wedges.wedges[w], lit)) continue;
        // Power of the edge: ∫ I sin β √(λ s') dt = √λ/4π ∫ dθ/√s' ≤ … (θ₁ − θ₀)/√min s'.
        const double nearest = lit.angle_from > 0 ? lit.radial / std::cos(lit.angle_from)
                               : lit.angle_to < 0 ? lit.radial / std::cos(lit.angle_to)
                                                  : lit.radial;
        lit.probability = (lit.angle_to - lit.angle_from) / std::sqrt(nearest);
        lit.cumulative = sum += lit.probability;
        lit_.push_back(lit);
      }
    for (Lit& lit : lit_) {
      lit.probability /= sum;
      lit.cumulative /= sum;
    }
  }

  bool lights(const Lamp& lamp, const Wedge& wedge, Lit& lit) const {
    if (!lamp.patches.empty()) {
      const std::uint32_t last = lamp.patches.back();
      if (last == wedge.patch0 || last == wedge.patchn) return false;
      // Some of the edge lies before the last mirror: on the side away from the image.
      const Patch& patch = scene_.patches.patches[last];
      const double image = dot(patch.normal, lamp.position) - patch.offset;
      const double ends[2] = {dot(patch.normal, wedge.start) - patch.offset,
                              dot(patch.normal, wedge.end()) - patch.offset};
      if (!(image * ends[0] < 0 || image * ends[1] < 0)) return false;
    }
    const Vec3 way = lamp.position - wedge.start;
    lit.axial = dot(way, wedge.direction);
    const Vec3 across = way - lit.axial * wedge.direction;
    lit.radial = norm(across);
    if (lit.radial < 1e-6) return false;
    constexpr double rounding = 1e-9;
    double phi = std::atan2(dot(across, wedge.normal0), dot(across, wedge.along0));
    if (phi < -rounding) phi += 2 * pi;
    if (phi > wedge.exterior_angle + rounding) return false;
    lit.sector = {wedge.exterior_angle, std::clamp(phi, 0.0, wedge.exterior_angle), wedge.free_rim,
                  plan_.request.reflection};
    lit.angle_from = std::atan((-beyond_end(lit.axial, lit.radial) - lit.axial) / lit.radial);
    lit.angle_to =
        std::atan((wedge.length + beyond_end(wedge.length - lit.axial, lit.radial) - lit.axial) / lit.radial);
    return true;
  }

  /// Length beyond an end, `towards` m along the edge from the source's foot to it, up to which v_V < 3 for a receiver
  /// at any distance: the detour over the end is least for the farthest one, |SV| − |SQ| + a cos β; it grows with a. At
  /// most 10 |SV|.
  double beyond_end(double towards, double radial) const {
    const double most = end_parameter_limit * end_parameter_limit * wavelength_ / 4;
    const double to_end = std::hypot(towards, radial);
    const auto detour = [&](double a) {
      const double s = std::hypot(towards + a, radial);
      return to_end - s + a * (towards + a) / s;
    };
    double low = 0, high = 10 * to_end;
    if (detour(high) < most) return high;
    while (high - low > 1e-3 * high) (detour(0.5 * (low + high)) < most ? low : high) = 0.5 * (low + high);
    return high;
  }

  /// Antenna gain times reflectances of the way from the transmitter to the edge; 0 if it is blocked. Points beyond an
  /// end are seen where the end is.
  double arriving_power(const Lamp& lamp, const Wedge& wedge, const Start& start) const {
    Vec3 point = outside(wedge, wedge.point(std::clamp(start.along, 0.0, wedge.length)));
    double power = 1;
    std::uint32_t leave0 = wedge.patch0, leave1 = wedge.patchn;
    for (std::size_t i = lamp.patches.size(); i-- > 0;) {
      const Vec3 direction = normalized(lamp.images[i + 1] - point);
      const Hit hit = tracer_.nearest(point, direction, leave0, leave1);
      if (hit.triangle == no_index || scene_.patches.triangle_patch[hit.triangle] != lamp.patches[i]) return 0;
      if (hit.distance > distance(point, lamp.images[i + 1])) return 0;
      const Patch& patch = scene_.patches.patches[lamp.patches[i]];
      power *= reflectance(patch.material, std::abs(dot(direction, patch.normal)));
      point += hit.distance * direction;
      leave0 = lamp.patches[i];
      leave1 = no_index;
    }
    if (!tracer_.visible(transmitter_.position, point)) return 0;
    return radio_ ? power * norm2(radiated_field(transmitter_.antenna, normalized(point - transmitter_.position)))
                  : power;
  }

  Vec3 outside(const Wedge& wedge, const Vec3& point) const {
    const double half = 0.5 * wedge.exterior_angle;
    return point + 3 * tracer_.surface_gap() * (std::cos(half) * wedge.along0 + std::sin(half) * wedge.normal0);
  }

  double reflectance(std::uint32_t material, double cosine) const {
    const ReflectionCoefficients r = face_reflection(plan_, material, band_, std::min(1.0, cosine));
    return 0.5 * (std::norm(r.te) + std::norm(r.tm));
  }

  void follow(const Lamp& lamp, const Start& start, std::vector<Crossing>& crossings) const {
    const Wedge& wedge = start.wedge;
    const double cos_beta = (start.along - start.lit.axial) / start.s_in;
    const Vec3 unfolded =
        normalized(cos_beta * wedge.direction +
                   start.sin_beta * (std::cos(start.phi) * wedge.along0 + std::sin(start.phi) * wedge.normal0));
    const int before = static_cast<int>(lamp.patches.size());
    const int after =
        !plan_.request.reflection
            ? 0
            : std::min({classes_.after, plan_.request.max_reflections - before, plan_.request.depth - 1 - before});
    Vec3 origin = outside(wedge, start.point), direction = unfolded;
    std::uint32_t leave0 = wedge.patch0, leave1 = wedge.patchn;
    double walked = 0, power = start.weight;
    for (int reflections = 0;; ++reflections) {
      const Hit hit = tracer_.nearest(origin, direction, leave0, leave1);
      const double rise = grid_.layout.z - origin.z;
      if (rise * direction.z > 0) {
        const double t = rise / direction.z;
        if (hit.triangle == no_index || t < hit.distance)
          cross(lamp, start, unfolded, origin + t * direction, walked + t, power / std::abs(direction.z), crossings);
      }
      if (hit.triangle == no_index || reflections >= after) return;
      const std::uint32_t patch_index = scene_.patches.triangle_patch[hit.triangle];
      const Patch& patch = scene_.patches.patches[patch_index];
      const double cosine = dot(patch.normal, direction);
      power *= reflectance(patch.material, std::abs(cosine));
      if (power == 0) return;
      walked += hit.distance;
      origin += hit.distance * direction;
      direction = normalized(direction - 2 * cosine * patch.normal);
      leave0 = patch_index;
      leave1 = no_index;
    }
  }

  void cross(const Lamp& lamp, const Start& start, const Vec3& unfolded, const Vec3& point, double s_out, double power,
             std::vector<Crossing>& crossings) const {
    const GridLayout& layout = grid_.layout;
    const double x = (point.x - layout.x0) / layout.cell, y = (point.y - layout.y0) / layout.cell;
    if (!(x >= 0 && y >= 0 && x < double(layout.nx) && y < double(layout.ny))) return;
    const auto cell = static_cast<std::uint32_t>(std::size_t(y) * layout.nx + std::size_t(x));
    const double area = layout.cell * layout.cell * (1 - grid_.inside_fraction[cell]);
    if (area <= 0 || s_out <= 0) return;
    const double effective = s_out * start.s_in / (s_out + start.s_in);
    const double ends = std::norm(end_waves(lamp.position, start, start.point + s_out * unfolded, s_out));
    const double air = std::exp(-2 * plan_.attenuation[band_] * (start.s_in + s_out));
    const double unit = radio_ ? wavelength_ * wavelength_ / (4 * pi) : 1;
    const double gain = power * effective * wave_power(start, effective) * ends * air * unit / area;
    if (gain == 0) return;
    for (Crossing& crossing : crossings)
      if (crossing.cell == cell) {
        crossing.gain += gain;
        return;
      }
    crossings.push_back({cell, gain});
  }

  /// |Σ r U|², the mean of both polarisations.
  double wave_power(const Start& start, double effective) const {
    const auto waves = sector_waves(start.lit.sector, effective, wavelength_, start.sin_beta, start.phi);
    if (!start.lit.sector.faces) return std::norm(waves[0]);
    std::complex<double> te = waves[0], tm = waves[0];
    const auto add = [&](std::complex<double> wave, std::uint32_t material, double azimuth_in, double azimuth_out) {
      for (const double azimuth : {azimuth_in, azimuth_out}) {
        // Sound's walls are the same at every angle.
        const ReflectionCoefficients r =
            face_reflection(plan_, material, band_, std::min(1.0, start.sin_beta * std::abs(std::sin(azimuth))));
        te += 0.5 * r.te * wave;
        tm += 0.5 * r.tm * wave;
      }
    };
    const EdgeSector& sector = start.lit.sector;
    add(waves[1], start.wedge.material0, sector.phi_in, start.phi);
    if (!sector.free_rim)
      add(waves[2], start.wedge.materialn, sector.exterior_angle - sector.phi_in, sector.exterior_angle - start.phi);
    return 0.5 * (std::norm(te) + std::norm(tm));
  }

  /// T: whether the point lies on the edge, and the waves of its ends towards the (unfolded) receiver.
  std::complex<double> end_waves(const Vec3& source, const Start& start, const Vec3& receiver, double s_out) const {
    const Wedge& wedge = start.wedge;
    std::complex<double> weight = start.along >= 0 && start.along <= wedge.length ? 1 : 0;
    for (const bool last : {false, true}) {
      const Vec3 end = last ? wedge.end() : wedge.start;
      const bool inside = last ? start.along <= wedge.length : start.along >= 0;
      const double detour = std::max(0.0, distance(source, end) + distance(end, receiver) - start.s_in - s_out);
      if (!inside && 2 * std::sqrt(detour / wavelength_) >= end_parameter_limit) return 0;
      const double share = (last ? wedge.vertex_end : wedge.vertex_start) == no_index ? 1 : 0.5;
      weight += share * edge_end_wave(detour, wavelength_, plan_.wavenumber[band_], inside);
    }
    return weight;
  }

  const Scene& scene_;
  const Tracer& tracer_;
  const Plan& plan_;
  const Transmitter& transmitter_;
  const CoverageGrid& grid_;
  const std::uint64_t samples_;
  const std::size_t band_;
  const double wavelength_;
  const SampledClasses classes_;
  const bool radio_;
  std::vector<Lamp> lamps_;
  std::vector<Lit> lit_;
};

/// Samples first … last−1, one tally for each cell met, sorted by cell.
std::vector<Tally> tally_block(const EdgeSampler& sampler, std::uint64_t first, std::uint64_t last) {
  std::vector<Tally> tallies;
  std::vector<Crossing> crossings;
  for (std::uint64_t i = first; i < last; ++i) {
    crossings.clear();
    sampler.sample(i, crossings);
    for (const Crossing& c : crossings) tallies.push_back({c.cell, 1, c.gain, c.gain * c.gain});
  }
  std::stable_sort(tallies.begin(), tallies.end(), [](const Tally& a, const Tally& b) { return a.cell < b.cell; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (kept > 0 && tallies[kept - 1].cell == tallies[i].cell) {
      tallies[kept - 1].hits += 1;
      tallies[kept - 1].sum += tallies[i].sum;
      tallies[kept - 1].squares += tallies[i].squares;
    } else {
      tallies[kept++] = tallies[i];
    }
  }
  tallies.resize(kept);
  return tallies;
}

}  // namespace

SampledLayer sample_diffraction(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                                const CoverageGrid& grid, std::uint64_t samples, std::size_t band,
                                const SampledClasses& classes, const std::atomic<bool>* stop) {
  GRIMALDI_EXPECT(samples >= 2 && band < plan.bands() && transmitter < plan.request.transmitters.size());
  const std::size_t cells = grid.layout.size();
  SampledLayer layer{std::vector<double>(cells, 0), std::vector<double>(cells, 0),
                     std::vector<std::uint32_t>(cells, 0)};
  const EdgeSampler sampler(scene, tracer, plan, transmitter, grid, samples, band, classes);
  const std::uint64_t blocks = sampler.empty() ? 0 : (samples + block_size - 1) / block_size;
  std::vector<std::vector<Tally>> tallies(blocks_at_once);
  for (std::uint64_t begin = 0; begin < blocks; begin += blocks_at_once) {
    const std::uint64_t count = std::min(blocks_at_once, blocks - begin);
    for_each_block(
        count, plan.request.threads,
        [&](std::size_t block, unsigned) {
          const std::uint64_t first = (begin + block) * block_size;
          tallies[block] = tally_block(sampler, first, std::min(samples, first + block_size));
        },
        stop);
    if (stop && *stop) return {};
    for (std::uint64_t block = 0; block < count; ++block)
      for (const Tally& tally : tallies[block]) {
        layer.gain[tally.cell] += tally.sum;
        layer.standard_error[tally.cell] += tally.squares;
        layer.hits[tally.cell] += tally.hits;
      }
  }
  const double n = double(samples);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (grid.inside_fraction[cell] >= 1) {
      layer.gain[cell] = layer.standard_error[cell] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const double variance = layer.standard_error[cell] - layer.gain[cell] * layer.gain[cell] / n;
    layer.standard_error[cell] = std::sqrt(std::max(0.0, variance) / (1 - 1 / n));
  }
  return layer;
}

}  // namespace grimaldi
