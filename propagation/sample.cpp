#include "propagation/sample.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "core/blocks.h"
#include "core/constants.h"
#include "core/random.h"
#include "propagation/antenna.h"
#include "propagation/face_reflection.h"
#include "propagation/laws/edge_sampling.h"
#include "propagation/laws/free_space_diffraction.h"
#include "propagation/laws/published_diffraction.h"
#include "propagation/laws/utd.h"
#include "propagation/lit_edges.h"

namespace grimaldi {
namespace {

constexpr std::uint32_t sample_stream = 5;
constexpr std::uint64_t block_size = 4096, blocks_at_once = 256;
/// Points of an edge's line further beyond its end than this v_V are not sampled (nor connected).
constexpr double end_parameter_limit = 3;

struct Crossing {
  std::uint32_t cell;
  double gain;
};

/// Power that a sample, or all samples of a block, bring to a cell.
struct Tally {
  std::uint32_t cell, hits;
  double sum, squares;
};

/// What leaves an edge.
struct Beam {
  Vec3 origin, direction;
  std::uint32_t leave0, leave1;
  double power;  ///< over the transmitter's, over the density of its draw
  double s_in;   ///< length of its way so far, m
  int reflections;
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
        radio_(plan.request.kind == WaveKind::radio),
        published_(plan.request.diffraction_model == DiffractionModel::fsd_published),
        lit_(scene, plan, transmitter_, wavelength_, before(plan, classes), published_ ? 0 : end_parameter_limit) {}

  bool empty() const { return lit_.empty(); }

  /// Adds the crossings of sample `index`, one for each cell.
  void sample(std::uint64_t index, std::vector<Crossing>& crossings) const {
    const auto u = uniform4(plan_.request.seed, sample_stream, index, 0);
    const LitEdge& lit = lit_.choose(u[0]);
    const EdgePoint start = lit_.draw_point(lit, u[1]);
    const double arrived = arriving_power(lit, start) / (4 * pi * start.s_in * start.s_in * double(samples_));
    if (arrived == 0) return;
    if (published_)
      sample_published(index, lit, start, arrived, u, crossings);
    else
      sample_keller(lit, start, arrived, u, crossings);
  }

 private:
  static int before(const Plan& plan, const SampledClasses& classes) {
    return plan.request.reflection ? std::min({classes.before, plan.request.max_reflections, plan.request.depth - 1})
                                   : 0;
  }

  const Wedge& wedge_of(const LitEdge& lit) const { return scene_.wedges.wedges[lit.wedge]; }

  /// `arrived` = irradiance at the point over the number of samples, 1/m².
  void sample_keller(const LitEdge& lit, const EdgePoint& start, double arrived, const std::array<double, 4>& u,
                     std::vector<Crossing>& crossings) const {
    const Wedge& wedge = wedge_of(lit);
    const AzimuthLaw law(lit.sector, start.s_in, wavelength_, start.sin_beta);
    const double phi = law.draw(u[2], u[3]);
    const double cos_beta = (start.along - lit.axial) / start.s_in;
    const Vec3 direction = normalized(cos_beta * wedge.direction +
                                      start.sin_beta * (std::cos(phi) * wedge.along0 + std::sin(phi) * wedge.normal0));
    const double power = arrived * start.sin_beta * start.sin_beta / (start.density * law.density(phi));
    const auto law_at = [&](double s_out) {
      const double effective = s_out * start.s_in / (s_out + start.s_in);
      return effective * wave_power(lit, start, phi, effective, start.point + s_out * direction, s_out);
    };
    follow({outside_of_edge(tracer_, wedge, start.point), direction, wedge.patch0, wedge.patchn, power, start.s_in,
            static_cast<int>(lit_.lamp(lit).patches.size())},
           law_at, crossings);
  }

  void sample_published(std::uint64_t index, const LitEdge& lit, const EdgePoint& start, double arrived,
                        const std::array<double, 4>& u, std::vector<Crossing>& crossings) const {
    const Wedge& wedge = wedge_of(lit);
    const double angle = wedge.exterior_angle;
    const bool lit0 = lit.sector.phi_in < pi, litn = angle - lit.sector.phi_in < pi;
    if (lit0 == litn) return;  // no silhouette
    const auto w = uniform4(plan_.request.seed, sample_stream, index, 1);
    const PublishedFootprint footprint{published_sigma_wavelengths * wavelength_};
    // A hit beside the edge, on the side of the face that the wave meets.
    const Lamp& lamp = lit_.lamp(lit);
    const Vec3 face = lit0 ? wedge.along0 : std::cos(angle) * wedge.along0 + std::sin(angle) * wedge.normal0;
    Vec3 aside = normalized(cross(wedge.direction, start.point - lamp.position));
    if (dot(aside, face) < 0) aside = -aside;
    const double offset = footprint.sigma * std::sqrt(-2 * std::log(w[0])) * std::abs(std::cos(2 * pi * w[1]));
    const double offset_density = 2 / (std::sqrt(2 * pi) * footprint.sigma) *
                                  std::exp(-0.5 * offset * offset / (footprint.sigma * footprint.sigma));
    const Vec3 beside = start.point + offset * aside;
    const double length = distance(beside, lamp.position);
    const Vec3 in = (beside - lamp.position) / length;
    double walked = 0;  // to the last mirror
    if (!lamp.patches.empty()) {
      const Patch& patch = scene_.patches.patches[lamp.patches.back()];
      walked = (patch.offset - dot(patch.normal, lamp.position)) / dot(patch.normal, in);
    }
    const Hit hit =
        tracer_.nearest(lamp.position + walked * in, in, lamp.patches.empty() ? no_index : lamp.patches.back());
    if (hit.triangle == no_index) return;
    const std::uint32_t patch = scene_.patches.triangle_patch[hit.triangle];
    if (patch != wedge.patch0 && patch != wedge.patchn) return;
    const Vec3 along = normalized(wedge.direction - dot(wedge.direction, in) * in);
    Vec3 towards = cross(along, in);
    if (dot(towards, start.point - beside) < 0) towards = -towards;
    const PublishedScattering scattering(footprint, plan_.wavenumber[band_], dot(towards, start.point - beside),
                                         dot(wedge.start - beside, along), dot(wedge.end() - beside, along));
    const PlanePoint xi = scattering.draw(u[2], u[3], w[2]);
    const double forward = 1 - xi[0] * xi[0] - xi[1] * xi[1];
    if (forward <= 0) return;
    // Flux through the strip of points beside the edge, dt × d offset, against that at the edge.
    const double obliquity = std::abs(dot(in, cross(wedge.direction, aside)));
    const double flux = arrived * obliquity * start.s_in * start.s_in / (length * length);
    const double power = flux * scattering(xi) / (start.density * offset_density * scattering.density(xi));
    const double whole = walked + hit.distance;
    follow(
        {wedge.free_rim ? lamp.position + whole * in : outside_of_edge(tracer_, wedge, start.point),
         normalized(xi[0] * along + xi[1] * towards + std::sqrt(forward) * in), wedge.patch0, wedge.patchn, power,
         wedge.free_rim ? whole : start.s_in, static_cast<int>(lamp.patches.size())},
        [](double) { return 1.0; }, crossings);
  }

  /// Antenna gain times reflectances of the way from the transmitter to the edge; 0 if it is blocked. Points beyond an
  /// end are seen where the end is.
  double arriving_power(const LitEdge& lit, const EdgePoint& start) const {
    const Wedge& wedge = wedge_of(lit);
    const Lamp& lamp = lit_.lamp(lit);
    Vec3 point = outside_of_edge(tracer_, wedge, wedge.point(std::clamp(start.along, 0.0, wedge.length)));
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

  double reflectance(std::uint32_t material, double cosine) const {
    const ReflectionCoefficients r = face_reflection(plan_, material, band_, std::min(1.0, cosine));
    return 0.5 * (std::norm(r.te) + std::norm(r.tm));
  }

  /// Walks a beam and counts it where it crosses the grid's plane; `law_at` = what depends on the unfolded length from
  /// the edge.
  template <class Law>
  void follow(const Beam& beam, const Law& law_at, std::vector<Crossing>& crossings) const {
    const PlanDescription& request = plan_.request;
    const int after = request.reflection ? std::min({classes_.after, request.max_reflections - beam.reflections,
                                                     request.depth - 1 - beam.reflections})
                                         : 0;
    Vec3 origin = beam.origin, direction = beam.direction;
    std::uint32_t leave0 = beam.leave0, leave1 = beam.leave1;
    double walked = 0, power = beam.power;
    for (int reflections = 0;; ++reflections) {
      const Hit hit = tracer_.nearest(origin, direction, leave0, leave1);
      const double rise = grid_.layout.z - origin.z, t = rise / direction.z;
      if (rise * direction.z > 0 && (hit.triangle == no_index || t < hit.distance)) {
        const Vec3 point = origin + t * direction;
        const double air = std::exp(-2 * plan_.attenuation[band_] * (beam.s_in + walked + t));
        count(
            point, power * air / std::abs(direction.z), [&] { return law_at(walked + t); }, crossings);
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

  template <class Law>
  void count(const Vec3& point, double power, const Law& law, std::vector<Crossing>& crossings) const {
    const GridLayout& layout = grid_.layout;
    const double x = (point.x - layout.x0) / layout.cell, y = (point.y - layout.y0) / layout.cell;
    if (!(x >= 0 && y >= 0 && x < double(layout.nx) && y < double(layout.ny))) return;
    const auto cell = static_cast<std::uint32_t>(std::size_t(y) * layout.nx + std::size_t(x));
    const double area = layout.cell * layout.cell * (1 - grid_.inside_fraction[cell]);
    if (area <= 0) return;
    const double unit = radio_ ? wavelength_ * wavelength_ / (4 * pi) : 1;
    const double gain = power * law() * unit / area;
    if (gain == 0) return;
    for (Crossing& crossing : crossings)
      if (crossing.cell == cell) {
        crossing.gain += gain;
        return;
      }
    crossings.push_back({cell, gain});
  }

  /// |Σ r T U|², the mean of both polarisations.
  double wave_power(const LitEdge& lit, const EdgePoint& start, double phi, double effective, const Vec3& receiver,
                    double s_out) const {
    const Wedge& wedge = wedge_of(lit);
    auto waves = sector_waves(lit.sector, effective, wavelength_, start.sin_beta, phi);
    if (!add_ends(lit, start, phi, effective, receiver, s_out, waves)) return 0;
    if (!lit.sector.faces) return std::norm(waves[0]);
    std::complex<double> te = waves[0], tm = waves[0];
    const auto add = [&](std::complex<double> wave, std::uint32_t material, double azimuth_in, double azimuth_out) {
      const double in = start.sin_beta * std::abs(std::sin(azimuth_in));
      const double out = start.sin_beta * std::abs(std::sin(azimuth_out));
      const double share = face_share(in, out);
      // Sound's walls are the same at every angle.
      for (const auto& [cosine, part] : {std::pair{in, share}, std::pair{out, 1 - share}}) {
        const ReflectionCoefficients r = face_reflection(plan_, material, band_, std::min(1.0, cosine));
        te += part * r.te * wave;
        tm += part * r.tm * wave;
      }
    };
    const EdgeSector& sector = lit.sector;
    add(waves[1], wedge.material0, sector.phi_in, phi);
    if (!sector.free_rim)
      add(waves[2], wedge.materialn, sector.exterior_angle - sector.phi_in, sector.exterior_angle - phi);
    return 0.5 * (std::norm(te) + std::norm(tm));
  }

  /// Each wave times T: whether the point lies on the edge, and the waves of its ends towards the (unfolded) receiver.
  /// False if the point lies too far beyond an end.
  bool add_ends(const LitEdge& lit, const EdgePoint& start, double phi, double effective, const Vec3& receiver,
                double s_out, std::array<std::complex<double>, 3>& waves) const {
    const Wedge& wedge = wedge_of(lit);
    const Vec3& source = lit_.lamp(lit).position;
    const auto turns = turns_beyond_boundaries(lit.sector, phi);
    std::array<std::complex<double>, 3> weights;
    weights.fill(start.along >= 0 && start.along <= wedge.length ? 1 : 0);
    for (const bool last : {false, true}) {
      const Vec3 end = last ? wedge.end() : wedge.start;
      const bool inside = last ? start.along <= wedge.length : start.along >= 0;
      if (last ? wedge.stands_at_end : wedge.stands_at_start) {
        if (!inside) return false;
        if (plan_.request.reflection) continue;
      }
      const double detour = std::max(0.0, distance(source, end) + distance(end, receiver) - start.s_in - s_out);
      const double v_end = 2 * std::sqrt(detour / wavelength_);
      if (!inside && v_end >= end_parameter_limit) return false;
      const std::complex<double> wave = edge_end_wave(detour, wavelength_, plan_.wavenumber[band_], inside);
      for (std::size_t i = 0; i < waves.size(); ++i)
        weights[i] += edge_end_share(fresnel_parameter(effective, wavelength_, start.sin_beta, turns[i]), v_end) * wave;
    }
    for (std::size_t i = 0; i < waves.size(); ++i) waves[i] *= weights[i];
    return true;
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
  const bool radio_, published_;
  const LitEdges lit_;
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
  const PlanDescription& request = plan.request;
  const bool asked = request.diffraction && request.max_diffractions > 0 && request.depth > 0;
  const EdgeSampler sampler(scene, tracer, plan, transmitter, grid, samples, band, classes);
  const std::uint64_t blocks = !asked || sampler.empty() ? 0 : (samples + block_size - 1) / block_size;
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
