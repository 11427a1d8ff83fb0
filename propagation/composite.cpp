#include "propagation/composite.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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

std::uint32_t CompositeSum::node_of(SequenceHash composite) {
  const auto [place, added] = node_by_hash_.try_emplace(composite, static_cast<std::uint32_t>(arrivals_ + absent_));
  absent_ += added;
  return place->second;
}

void CompositeSum::tie_to_composites(std::span<const Arrival> arrivals) {
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
        const std::uint32_t node = node_of(hash_without(arrival.interactions, position, bounded[kind].second));
        ties_.push_back({node, a, static_cast<std::uint32_t>(weights_.size())});
        for (const double k : plan_->wavenumber)
          weights_.push_back(coherence(v * std::sqrt(k / plan_->wavenumber.front())));
      }
    }
  }
}

void CompositeSum::tie_corners(std::span<const Arrival> arrivals) {
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
      const SequenceHash rest = hash_without(arrivals[a].interactions, position, edge_interaction(0x7fffffffu));
      if (wedge.vertex_start != no_index && std::abs(passage.along) < zone)
        ends.push_back({rest, wedge.vertex_start, a});
      if (wedge.vertex_end != no_index && std::abs(wedge.length - passage.along) < zone)
        ends.push_back({rest, wedge.vertex_end, a});
    }
  }
  // A chain of ties through each corner makes its arrivals one wave.
  std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) {
    return std::tie(x.rest, x.vertex, x.arrival) < std::tie(y.rest, y.vertex, y.arrival);
  });
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (ends[i].rest == ends[i - 1].rest && ends[i].vertex == ends[i - 1].vertex &&
        ends[i].arrival != ends[i - 1].arrival) {
      ties_.push_back({ends[i - 1].arrival, ends[i].arrival, static_cast<std::uint32_t>(weights_.size())});
      weights_.insert(weights_.end(), plan_->bands(), 1.0);
    }
}

std::uint32_t CompositeSum::root_of(std::uint32_t node) {
  while (root_[node] != node) node = root_[node] = root_[root_[node]];
  return node;
}

void CompositeSum::span_tree() {
  std::sort(ties_.begin(), ties_.end(), [&](const Tie& x, const Tie& y) {
    if (weights_[x.weights] != weights_[y.weights]) return weights_[x.weights] > weights_[y.weights];
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  const std::size_t nodes = arrivals_ + absent_;
  root_.resize(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) root_[i] = i;
  // Kruskal; the kept ties as linked lists of neighbours.
  first_.assign(nodes, no_index);
  next_.clear();
  tie_of_.clear();
  for (std::uint32_t t = 0; t < ties_.size(); ++t) {
    const std::uint32_t a = root_of(ties_[t].a), b = root_of(ties_[t].b);
    if (a == b) continue;
    root_[std::max(a, b)] = std::min(a, b);
    for (const std::uint32_t node : {ties_[t].a, ties_[t].b}) {
      next_.push_back(first_[node]);
      first_[node] = static_cast<std::uint32_t>(tie_of_.size());
      tie_of_.push_back(t);
    }
  }
  branches_.clear();
  for (std::uint32_t root = 0; root < nodes; ++root) {
    if (root_of(root) != root || first_[root] == no_index) continue;
    branches_.push_back({root, no_index, 0});
    for (std::size_t i = branches_.size() - 1; i < branches_.size(); ++i) {
      const Branch here = branches_[i];
      for (std::uint32_t link = first_[here.node]; link != no_index; link = next_[link]) {
        const Tie& tie = ties_[tie_of_[link]];
        const std::uint32_t other = tie.a == here.node ? tie.b : tie.a;
        if (other != here.parent) branches_.push_back({other, here.node, tie.weights});
      }
    }
  }
}

double CompositeSum::at_the_point(std::span<const Arrival> arrivals, std::size_t band, Polarisation polarisation) {
  // From the leaves: a node's sum is its own wave and its branches' sums, each times the weight of its tie.
  double cross_terms = 0;
  sums_.assign(arrivals_ + absent_, {});
  for (std::size_t a = 0; a < arrivals_; ++a) sums_[a] = arrivals[a].field[band];
  for (std::size_t i = branches_.size(); i-- > 0;) {
    const Branch& branch = branches_[i];
    if (branch.parent == no_index) continue;
    const double weight = weights_[branch.weights + band];
    auto& into = sums_[branch.parent];
    const std::array<std::complex<double>, 2> part{weight * sums_[branch.node][0], weight * sums_[branch.node][1]};
    cross_terms += 2 * correlation(into, part, polarisation);
    for (std::size_t p = 0; p < 2; ++p) into[p] += part[p];
  }
  return cross_terms;
}

double CompositeSum::over_a_square(std::span<const Arrival> arrivals, std::size_t band, Polarisation polarisation,
                                   double extent) {
  const auto direction = [&](std::uint32_t a) {
    const PathGeometry& g = arrivals[a].geometry;
    return normalized(g.points[g.count - 1] - g.points[g.count - 2]);
  };
  const auto sinc = [](double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; };
  const double scale = 0.5 * plan_->wavenumber[band] * extent;
  double cross_terms = 0;
  place_.resize(arrivals_ + absent_);
  for (std::size_t begin = 0, end = 0; begin < branches_.size(); begin = end) {
    for (end = begin + 1; end < branches_.size() && branches_[end].parent != no_index;) ++end;
    const std::size_t size = end - begin;
    gamma_.assign(size * size, 1);
    for (std::size_t i = 0; i < size; ++i) {
      const Branch& here = branches_[begin + i];
      place_[here.node] = static_cast<std::uint32_t>(i);
      if (i == 0) continue;
      const std::size_t parent = place_[here.parent];
      const double weight = weights_[here.weights + band];
      const Vec3 own = here.node < arrivals_ ? direction(here.node) : Vec3{};
      for (std::size_t j = 0; j < i; ++j) {
        const double gamma = weight * gamma_[parent * size + j];
        gamma_[i * size + j] = gamma_[j * size + i] = gamma;
        const std::uint32_t other = branches_[begin + j].node;
        if (here.node >= arrivals_ || other >= arrivals_ || gamma == 0) continue;
        const Vec3 apart = scale * (own - direction(other));
        cross_terms += 2 * gamma * sinc(apart.x) * sinc(apart.y) *
                       correlation(arrivals[here.node].field[band], arrivals[other].field[band], polarisation);
      }
    }
  }
  return cross_terms;
}

void CompositeSum::interference(std::span<const Arrival> arrivals, Polarisation polarisation, std::span<double> out,
                                double extent) {
  std::fill(out.begin(), out.end(), 0.0);
  ties_.clear();
  weights_.clear();
  absent_ = 0;
  arrivals_ = arrivals.size();
  if (arrivals.size() < 2) return;
  node_by_hash_.clear();
  for (std::uint32_t a = 0; a < arrivals.size(); ++a) node_by_hash_[arrivals[a].hash] = a;
  tie_to_composites(arrivals);
  tie_corners(arrivals);
  span_tree();
  for (std::size_t band = 0; band < plan_->bands(); ++band) {
    out[band] =
        extent > 0 ? over_a_square(arrivals, band, polarisation, extent) : at_the_point(arrivals, band, polarisation);
    // A null of the field may come out a rounding error below zero.
    double powers = 0;
    for (const Arrival& arrival : arrivals) powers += received_power(arrival.field[band], polarisation);
    out[band] = std::max(out[band], -powers * (1 - 1e-12));
  }
}

}  // namespace grimaldi
