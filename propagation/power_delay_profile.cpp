#include "propagation/power_delay_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/blocks.h"
#include "core/constants.h"
#include "propagation/bounded_waves.h"
#include "propagation/composite.h"
#include "propagation/connect.h"
#include "propagation/depth_limit.h"
#include "propagation/extend_paths.h"
#include "propagation/fermat.h"
#include "propagation/object_wave.h"
#include "propagation/path_search.h"
#include "propagation/ties.h"

namespace grimaldi {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_bins = 100'000;

double azimuth(const Vec3& direction) {
  const double degrees = std::atan2(direction.x, direction.y) * 180 / pi;
  return degrees < 0 ? degrees + 360 : degrees;
}
double elevation(const Vec3& direction) {
  return std::atan2(direction.z, std::hypot(direction.x, direction.y)) * 180 / pi;
}

std::string interaction_tokens(const Scene& scene, std::span<const Interaction> interactions) {
  std::string text;
  for (const Interaction i : interactions) {
    if (!text.empty()) text += ' ';
    text +=
        is_edge(i) ? fmt::format("D:{}", index_of(i)) : "R:" + scene.materials[scene.patches.patches[i].material].name;
  }
  return text;
}

/// Adds the paths of one receiver, in the order of the sequences.
void add_arrivals(const Scene& scene, const Tracer& tracer, const Plan& plan, const Transmitter& transmitter,
                  const Vec3& position, const SequenceTable& sequences, std::vector<Arrival>& all,
                  std::uint64_t& shadow_rays, const std::atomic<bool>* stop) {
  struct Found {
    std::vector<Arrival> arrivals;
    std::uint64_t shadow_rays = 0;
  };
  constexpr std::size_t block_size = 4096;
  const std::size_t count = sequences.size(), blocks = (count + block_size - 1) / block_size;
  const double wavelength = 2 * pi / plan.wavenumber.front();
  std::vector<Found> found(blocks);
  for_each_block(
      blocks, plan.request.threads,
      [&](std::size_t block, unsigned) {
        Arrival arrival;
        for (std::size_t s = block * block_size; s < std::min(count, (block + 1) * block_size); ++s) {
          const auto interactions = sequences[s];
          if (interactions.empty() && !plan.request.direct) continue;
          UnfoldedSequence unfolded(scene, transmitter.position, interactions, &plan.small_objects);
          if (!unfolded.solve(position, wavelength, arrival.geometry)) continue;
          if (!connected(scene, tracer, interactions, arrival.geometry, found[block].shadow_rays)) continue;
          arrival.hash = sequences.hash(s);
          arrival.interactions = interactions;
          arrival.field.resize(plan.bands());
          path_field(scene, plan, transmitter, interactions, arrival.geometry, arrival.field);
          found[block].arrivals.push_back(arrival);
        }
      },
      stop);
  for (Found& block : found) {
    for (Arrival& arrival : block.arrivals) all.push_back(std::move(arrival));
    shadow_rays += block.shadow_rays;
  }
}

/// The path of a name to one point, from several tables.
bool find_path(const Scene& scene, const Plan& plan, const Transmitter& transmitter, const Vec3& position,
               std::span<const SequenceTable* const> tables, SequenceHash name, Arrival& arrival) {
  for (const SequenceTable* table : tables) {
    const std::uint32_t number = table->find(name);
    if (number == SequenceTable::no_sequence) continue;
    arrival.hash = name;
    arrival.interactions = (*table)[number];
    if (arrival.interactions.empty() && !plan.request.direct) return false;
    UnfoldedSequence unfolded(scene, transmitter.position, arrival.interactions, &plan.small_objects);
    if (!unfolded.solve(position, 2 * pi / plan.wavenumber.front(), arrival.geometry)) return false;
    arrival.field.resize(plan.bands());
    path_field(scene, plan, transmitter, arrival.interactions, arrival.geometry, arrival.field);
    return true;
  }
  return false;
}

void delay_statistics(const std::vector<Arrival>& arrivals, const Plan& plan, Polarisation polarisation,
                      std::size_t band, double& mean_delay, double& spread) {
  double strongest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const Arrival& a : arrivals) {
    strongest = std::max(strongest, received_power(a.field[band], polarisation));
    shortest = std::min(shortest, a.geometry.length / plan.speed);
  }
  if (!(strongest > 0)) return;
  const double threshold = strongest * std::pow(10.0, -plan.request.profile.dynamic_range / 10);
  double power = 0, first = 0, second = 0;
  for (const Arrival& a : arrivals) {
    const double p = received_power(a.field[band], polarisation), delay = a.geometry.length / plan.speed - shortest;
    if (p < threshold) continue;
    power += p;
    first += p * delay;
    second += p * delay * delay;
  }
  const double mean = first / power;
  mean_delay = shortest + mean;
  spread = std::sqrt(std::max(0.0, second / power - mean * mean));
}

PathStory story(const Scene& scene, const Plan& plan, const Transmitter& transmitter, const Arrival& arrival) {
  PathStory path;
  path.delay = arrival.geometry.length / plan.speed;
  for (std::size_t p = 0; p < plan.polarisations(); ++p)
    for (std::size_t band = 0; band < plan.bands(); ++band) path.amplitude.push_back(arrival.field[band][p]);
  const PathGeometry& g = arrival.geometry;
  const Vec3 departure = normalized(g.points[1] - g.points[0]);
  const Vec3 towards = normalized(g.points[g.count - 2] - g.points[g.count - 1]);
  path.departure_azimuth = azimuth(departure);
  path.departure_elevation = elevation(departure);
  path.arrival_azimuth = azimuth(towards);
  path.arrival_elevation = elevation(towards);
  path.interactions = interaction_tokens(scene, arrival.interactions);
  path.models = model_words(scene, plan, transmitter.position, arrival);
  path.points.assign(g.points.begin(), g.points.begin() + static_cast<std::ptrdiff_t>(g.count));
  return path;
}

void add_transmitter(const Scene& scene, const Plan& plan, std::size_t transmitter, const Receiver& receiver,
                     const std::vector<Arrival>& arrivals, std::span<const std::complex<double>> left_at_depth,
                     ReceiverProfile& profile) {
  const std::size_t bands = plan.bands();
  std::vector<double> interference(bands);
  CompositeSum(scene, plan).interference(arrivals, receiver.polarisation, interference);
  for (std::size_t band = 0; band < bands; ++band) {
    const std::size_t at = transmitter * bands + band;
    std::array<std::complex<double>, 2> sum{}, completed{};
    double power = 0;
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      const auto& field = arrivals[i].field[band];
      power += received_power(field, receiver.polarisation);
      for (std::size_t p = 0; p < 2; ++p) {
        sum[p] += field[p];
        completed[p] += left_at_depth[i * bands + band] * field[p];
      }
    }
    profile.total[at] = power + interference[band];
    profile.total_coherent[at] = received_power(sum, receiver.polarisation);
    profile.total_completed[at] = received_power(completed, receiver.polarisation);
    delay_statistics(arrivals, plan, receiver.polarisation, band, profile.mean_delay[at], profile.rms_delay_spread[at]);
  }
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < arrivals.size(); ++i)
    order.emplace_back(-received_power(arrivals[i].field[0], receiver.polarisation), i);
  std::sort(order.begin(), order.end());
  auto& paths = profile.paths[transmitter];
  for (const auto& [power, i] : order) {
    // A path that the receiver's polarisation does not take is none of its paths.
    if (power == 0) break;
    paths.push_back(story(scene, plan, plan.request.transmitters[transmitter], arrivals[i]));
  }
}

}  // namespace

std::vector<ReceiverProfile> empty_profiles(const Plan& plan) {
  const std::size_t rows = plan.request.transmitters.size() * plan.bands();
  std::vector<ReceiverProfile> profiles;
  for (const Receiver& receiver : plan.request.receivers) {
    ReceiverProfile& profile = profiles.emplace_back();
    profile.name = receiver.name;
    profile.position = receiver.position;
    profile.total.assign(rows, 0);
    profile.total_coherent.assign(rows, 0);
    profile.total_completed.assign(rows, 0);
    profile.mean_delay.assign(rows, not_a_number);
    profile.rms_delay_spread.assign(rows, not_a_number);
    profile.paths.resize(plan.request.transmitters.size());
  }
  return profiles;
}

std::uint64_t connect_receivers(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                                const SequenceTable& sequences, std::vector<ReceiverProfile>& profiles,
                                const std::atomic<bool>* stop) {
  std::uint64_t shadow_rays = 0;
  const Transmitter& source = plan.request.transmitters[transmitter];
  std::optional<EndView> view;
  if (most_edges(plan.request) > 0) view.emplace(view_from(scene, tracer, plan, source.position, shadow_rays));
  for (std::size_t r = 0; r < plan.request.receivers.size(); ++r) {
    const Receiver& receiver = plan.request.receivers[r];
    std::vector<Arrival> arrivals;
    add_arrivals(scene, tracer, plan, source, receiver.position, sequences, arrivals, shadow_rays, stop);
    object_fields(scene, plan, source, arrivals);  // the search below asks for the power
    SequenceTable around, longer;
    if (view) {
      const EndView own_view = view_from(scene, tracer, plan, receiver.position, shadow_rays);
      around =
          search_for_point(scene, tracer, plan, transmitter, *view, own_view, arrivals, sequences, shadow_rays, stop);
      add_arrivals(scene, tracer, plan, source, receiver.position, around, arrivals, shadow_rays, stop);
      longer = extend_paths(scene, tracer, plan, transmitter, *view, own_view, arrivals,
                            std::array{&sequences, &std::as_const(around)}, shadow_rays, stop);
      add_arrivals(scene, tracer, plan, source, receiver.position, longer, arrivals, shadow_rays, stop);
    }
    const std::array<const SequenceTable*, 3> tables = {&sequences, &around, &longer};
    const SequenceTable bounded =
        bounded_waves(scene, plan, arrivals, [&](SequenceHash name) { return is_in(tables, name); });
    add_arrivals(scene, tracer, plan, source, receiver.position, bounded, arrivals, shadow_rays, stop);
    if (stop && *stop) break;
    settle_ties(scene, plan, tie_hair(tracer.surface_gap()), arrivals, [&](SequenceHash name, Arrival& arrival) {
      return find_path(scene, plan, source, receiver.position, std::array{tables[0], tables[1], tables[2], &bounded},
                       name, arrival);
    });
    object_fields(scene, plan, source, arrivals);
    const std::vector<std::complex<double>> left =
        left_at_depth(scene, plan, source.position, receiver.position, tie_hair(tracer.surface_gap()), arrivals);
    add_transmitter(scene, plan, transmitter, receiver, arrivals, left, profiles[r]);
  }
  return shadow_rays;
}

void fill_bins(const Plan& plan, std::vector<ReceiverProfile>& profiles, std::vector<Diagnostic>& warnings) {
  const std::size_t bands = plan.bands();
  for (std::size_t r = 0; r < profiles.size(); ++r) {
    ReceiverProfile& profile = profiles[r];
    double first = std::numeric_limits<double>::infinity(), last = 0;
    for (const auto& paths : profile.paths)
      for (const PathStory& path : paths) first = std::min(first, path.delay), last = std::max(last, path.delay);
    if (!(first <= last)) continue;  // nothing arrived: no bins
    double resolution = plan.request.profile.resolution;
    if ((last - first) / resolution >= double(most_bins)) {
      const double asked = resolution;
      resolution = (last - first) / double(most_bins - 1);
      warnings.push_back({Severity::warning, "", 0, "profile.resolution", "more than 100,000 delay bins",
                          fmt::format("receiver {}: {:g} s over {:g} s", profile.name, asked, last - first),
                          fmt::format("bins of {:g} s are used", resolution)});
    }
    const double start = std::floor(first / resolution) * resolution;
    const std::size_t bins = std::min(most_bins, static_cast<std::size_t>((last - start) / resolution) + 1);
    for (std::size_t b = 0; b < bins; ++b) profile.delay.push_back(start + (double(b) + 0.5) * resolution);
    profile.power.assign(plan.request.transmitters.size() * bands * bins, 0);
    for (std::size_t t = 0; t < profile.paths.size(); ++t)
      for (const PathStory& path : profile.paths[t]) {
        const std::size_t bin = std::min(bins - 1, static_cast<std::size_t>((path.delay - start) / resolution));
        for (std::size_t band = 0; band < bands; ++band) {
          std::array<std::complex<double>, 2> field{path.amplitude[band], 0.0};
          if (plan.polarisations() == 2) field[1] = path.amplitude[bands + band];
          profile.power[(t * bands + band) * bins + bin] +=
              received_power(field, plan.request.receivers[r].polarisation);
        }
      }
    for (auto& paths : profile.paths)
      if (paths.size() > plan.request.profile.max_paths) paths.resize(plan.request.profile.max_paths);
  }
}

}  // namespace grimaldi
