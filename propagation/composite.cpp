#include "propagation/composite.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

constexpr double full_coherence = 3;  ///< v up to which an edge belongs wholly to a composite
constexpr double no_coherence = 6;    ///< v from which it does not belong to it

/// cos² fade between the two.
double coherence(double v) {
  if (v <= full_coherence) return 1;
  if (v >= no_coherence) return 0;
  const double c = std::cos(0.5 * pi * (v - full_coherence) / (no_coherence - full_coherence));
  return c * c;
}

/// Name of `interactions` with number `at` left out, or replaced by `face`.
SequenceHash without_edge(std::span<const Interaction> interactions, std::size_t at, std::uint32_t face) {
  SequenceHash hash = empty_sequence;
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    if (i != at)
      hash = extended(hash, interactions[i]);
    else if (face != no_index)
      hash = extended(hash, face);
  }
  return hash;
}

double correlation(const std::array<std::complex<double>, 2>& a, const std::array<std::complex<double>, 2>& b,
                   Polarisation polarisation) {
  double sum = 0;
  if (polarisation != Polarisation::horizontal) sum += (a[0] * std::conj(b[0])).real();
  if (polarisation != Polarisation::vertical) sum += (a[1] * std::conj(b[1])).real();
  return sum;
}

}  // namespace

Mechanism mechanism_of(std::span<const Interaction> interactions) {
  if (interactions.empty()) return Mechanism::direct;
  return count_edges(interactions) > 0 ? Mechanism::diffraction : Mechanism::reflection;
}

double received_power(const std::array<std::complex<double>, 2>& field, Polarisation polarisation) {
  return correlation(field, field, polarisation);
}

void CompositeSum::gather_members(std::span<const Arrival> arrivals) {
  const double longest = 2 * pi / plan_->wavenumber.front();
  for (std::uint32_t a = 0; a < arrivals.size(); ++a) {
    const Arrival& arrival = arrivals[a];
    std::size_t position = 0;
    for (std::size_t e = 0; e < arrival.geometry.edge_count; ++e, ++position) {
      while (!is_edge(arrival.interactions[position])) ++position;
      const Wedge& wedge = scene_->wedges.wedges[arrival.geometry.edges[e].wedge];
      const std::pair<Boundary, std::uint32_t> bounded[3] = {
          {Boundary::incident, no_index}, {Boundary::face0, wedge.patch0}, {Boundary::facen, wedge.patchn}};
      const std::size_t kinds = !plan_->request.reflection ? 1 : wedge.free_rim ? 2 : 3;
      for (std::size_t kind = 0; kind < kinds; ++kind) {
        const double v = boundary_parameter(*scene_, arrival.geometry, e, bounded[kind].first, longest);
        if (v >= no_coherence) continue;
        members_.push_back({without_edge(arrival.interactions, position, bounded[kind].second), a,
                            static_cast<std::uint32_t>(weights_.size())});
        for (const double k : plan_->wavenumber) weights_.push_back(coherence(v * std::sqrt(k / plan_->wavenumber.front())));
      }
    }
  }
  std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return a.composite != b.composite ? a.composite < b.composite : a.arrival < b.arrival;
  });
}

void CompositeSum::add_pair(std::uint32_t a, std::uint32_t b, const double* ta, const double* tb) {
  if (a == b) return;
  pairs_.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(weights_.size())});
  for (std::size_t band = 0; band < plan_->bands(); ++band)
    weights_.push_back((ta ? ta[band] : 1.0) * (tb ? tb[band] : 1.0));
}

void CompositeSum::pair_members(std::span<const Arrival> arrivals) {
  const std::size_t bands = plan_->bands();
  // Weights are read while pairs append to the same vector: no reallocation in between.
  std::size_t largest = 0;
  for (std::size_t i = 0, j = 0; i < members_.size(); i = j) {
    for (j = i; j < members_.size() && members_[j].composite == members_[i].composite;) ++j;
    largest += (j - i) * (j - i + 1);
  }
  weights_.reserve(weights_.size() + (largest + members_.size() * members_.size()) * bands);

  // Per member the bounded wave of its composite, if it arrives.
  std::vector<std::uint32_t> bounded(members_.size(), no_index);
  for (std::size_t i = 0, j = 0; i < members_.size(); i = j) {
    std::uint32_t wave = no_index;
    for (std::uint32_t a = 0; a < arrivals.size(); ++a)
      if (arrivals[a].hash == members_[i].composite) wave = a;
    for (j = i; j < members_.size() && members_[j].composite == members_[i].composite; ++j) {
      bounded[j] = wave;
      const double* t = weights_.data() + members_[j].weights;
      if (wave != no_index) add_pair(wave, members_[j].arrival, nullptr, t);
      for (std::size_t other = i; other < j; ++other)
        add_pair(members_[other].arrival, members_[j].arrival, weights_.data() + members_[other].weights, t);
    }
  }
  // Two bounded waves of one edge, direct and reflected near grazing.
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (members_[i].arrival == members_[j].arrival && bounded[i] != no_index && bounded[j] != no_index)
        add_pair(bounded[i], bounded[j], weights_.data() + members_[i].weights, weights_.data() + members_[j].weights);
}

void CompositeSum::pair_corners(std::span<const Arrival> arrivals) {
  struct End {
    SequenceHash rest;
    std::uint32_t vertex, arrival;
  };
  std::vector<End> ends;
  const double longest = 2 * pi / plan_->wavenumber.front();
  for (std::uint32_t a = 0; a < arrivals.size(); ++a) {
    std::size_t position = 0;
    for (std::size_t e = 0; e < arrivals[a].geometry.edge_count; ++e, ++position) {
      while (!is_edge(arrivals[a].interactions[position])) ++position;
      const EdgePassage& passage = arrivals[a].geometry.edges[e];
      const Wedge& wedge = scene_->wedges.wedges[passage.wedge];
      const double zone = std::sqrt(longest * passage.s_in * passage.s_out / (passage.s_in + passage.s_out));
      const SequenceHash rest = without_edge(arrivals[a].interactions, position, edge_interaction(0x7fffffffu));
      if (wedge.vertex_start != no_index && std::abs(passage.along) < zone) ends.push_back({rest, wedge.vertex_start, a});
      if (wedge.vertex_end != no_index && std::abs(wedge.length - passage.along) < zone)
        ends.push_back({rest, wedge.vertex_end, a});
    }
  }
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (ends[i].rest == ends[j].rest && ends[i].vertex == ends[j].vertex)
        add_pair(ends[i].arrival, ends[j].arrival, nullptr, nullptr);
}

void CompositeSum::interference(std::span<const Arrival> arrivals, Polarisation polarisation, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  members_.clear();
  pairs_.clear();
  weights_.clear();
  if (arrivals.size() < 2) return;
  gather_members(arrivals);
  pair_members(arrivals);
  pair_corners(arrivals);
  std::sort(pairs_.begin(), pairs_.end(), [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  const std::size_t bands = plan_->bands();
  for (std::size_t i = 0, j = 0; i < pairs_.size(); i = j) {
    for (std::size_t band = 0; band < bands; ++band) {
      double weight = 0;
      for (j = i; j < pairs_.size() && pairs_[j].a == pairs_[i].a && pairs_[j].b == pairs_[i].b; ++j)
        weight = std::max(weight, weights_[pairs_[j].weights + band]);
      if (weight > 0)
        out[band] += 2 * weight * correlation(arrivals[pairs_[i].a].field[band], arrivals[pairs_[i].b].field[band], polarisation);
    }
  }
  for (std::size_t band = 0; band < bands; ++band) {
    double powers = 0;
    for (const Arrival& arrival : arrivals) powers += received_power(arrival.field[band], polarisation);
    out[band] = std::max(out[band], -powers);
  }
}

}  // namespace grimaldi
