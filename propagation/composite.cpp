#include "propagation/composite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.h"
#include "core/contract.h"
#include "core/sine_cosine.h"
#include "propagation/fade.h"

namespace grimaldi {
namespace {

constexpr double full_coherence = 3;                 ///< v up to which an edge belongs wholly to a composite
constexpr double no_coherence = 2 * full_coherence;  ///< v from which it does not belong to it
constexpr double full_end = 1.5;  ///< v_V up to which an edge passed beyond its end belongs wholly to a composite

constexpr double full_bridge = 1. / 300;  ///< share of the power from which a wave ties what it belongs to
constexpr double no_bridge = 1. / 3000;   ///< and up to which it does not

/// Share of the power up to which a wave adds its power alone: its cross terms would be 0.03 dB.
constexpr double without_cross_terms = 1e-5;

/// The fade between the two, over the logarithm.
double bridging(double power, double whole) {
  if (power >= full_bridge * whole) return 1;
  if (power <= no_bridge * whole) return 0;
  return fade(1 + std::log(full_bridge * whole / power) / std::log(full_bridge / no_bridge), 1);
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

std::uint32_t CompositeSum::node_of(SequenceHash name) {
  const auto [place, added] = node_by_hash_.try_emplace(name, static_cast<std::uint32_t>(node_count_));
  if (added) {
    if (node_count_ == nodes_.size()) nodes_.emplace_back();
    Node& node = nodes_[node_count_++];
    node.interactions.clear();
    node.edges.clear();
    node.apart = std::numeric_limits<double>::infinity();
    node.power.assign(plan_->bands(), 0);
  }
  return place->second;
}

void CompositeSum::enter(std::span<const Arrival> arrivals, Polarisation polarisation) {
  node_by_hash_.clear();
  node_count_ = 0;
  arrivals_ = arrivals.size();
  power_.assign(plan_->bands(), 0);
  for (const Arrival& arrival : arrivals) {
    const std::uint32_t number = node_of(arrival.hash);
    GRIMALDI_EXPECT(number + 1 == node_count_);  // no sequence arrives twice
    Node& node = nodes_[number];
    node.interactions.assign(arrival.interactions.begin(), arrival.interactions.end());
    const auto first = arrival.geometry.edges.begin();
    node.edges.assign(first, first + static_cast<std::ptrdiff_t>(arrival.geometry.edge_count));
    node.apart = 0;
    for (std::size_t band = 0; band < plan_->bands(); ++band)
      power_[band] += node.power[band] = received_power(arrival.field[band], polarisation);
  }
  for (std::size_t i = 0; i < arrivals_; ++i) {
    bool counts = false;
    for (std::size_t band = 0; band < plan_->bands(); ++band)
      counts = counts || nodes_[i].power[band] > without_cross_terms * power_[band];
    if (!counts) nodes_[i].edges.clear();
  }
}

void CompositeSum::note(std::uint32_t other, std::uint32_t node, const Bounded& wave) {
  const Node& from = nodes_[node];
  Node& to = nodes_[other];
  if (!(from.apart + wave.v < to.apart)) return;
  to.apart = from.apart + wave.v;
  to.interactions = from.interactions;
  to.edges = from.edges;
  const auto at = to.interactions.begin() + static_cast<std::ptrdiff_t>(wave.position);
  if (wave.face == no_interaction)
    to.interactions.erase(at);
  else
    *at = wave.face;
  const double leg = from.edges[wave.edge].s_in + from.edges[wave.edge].s_out;
  to.edges.erase(to.edges.begin() + static_cast<std::ptrdiff_t>(wave.edge));
  if (wave.edge > 0) to.edges[wave.edge - 1].s_out = leg;
  if (wave.edge < to.edges.size()) to.edges[wave.edge].s_in = leg;
}

void CompositeSum::tie(std::uint32_t node, const Bounded& wave, double beyond_end, bool nearest) {
  const auto weight = [&](std::size_t band) {
    const double scale = std::sqrt(plan_->wavenumber[band] / plan_->wavenumber.front());
    const double bridge = nearest ? 1 : bridging(nodes_[node].power[band], power_[band]);
    return bridge * fade(wave.v * scale, full_coherence) * fade(beyond_end * scale, full_end);
  };
  // The longest wave is coherent the furthest.
  if (nearest ? weight(0) == 0 : !bridges(node)) return;
  const std::uint32_t other = node_of(hash_without(nodes_[node].interactions, wave.position, wave.face));
  ties_.push_back({other, node, static_cast<std::uint32_t>(weights_.size())});
  for (std::size_t band = 0; band < plan_->bands(); ++band) {
    weights_.push_back(weight(band));
    nodes_[other].power[band] = std::max(nodes_[other].power[band], weights_.back() * nodes_[node].power[band]);
  }
  if (other >= arrivals_) note(other, node, wave);
}

bool CompositeSum::bridges(std::uint32_t node) const {
  for (std::size_t band = 0; band < plan_->bands(); ++band)
    if (bridging(nodes_[node].power[band], power_[band]) > 0) return true;
  return false;
}

void CompositeSum::tie_upward(std::uint32_t node) {
  const double longest = 2 * pi / plan_->wavenumber.front();
  double beyond_end = 0;  // v_V
  bounded_.clear();
  const EdgePlaces places(nodes_[node].interactions);
  for (std::size_t e = 0; e < nodes_[node].edges.size(); ++e) {
    const EdgePassage& passage = nodes_[node].edges[e];
    if (!passage.inside) {
      const double detour = passage.along < 0 ? passage.detour_start : passage.detour_end;
      beyond_end = std::max(beyond_end, 2 * std::sqrt(detour / longest));
    }
    const Wedge& wedge = scene_->wedges.wedges[passage.wedge];
    for (const auto& [boundary, face] : BoundedWaves(wedge, plan_->request.reflection)) {
      const double v = boundary_parameter(*scene_, passage, boundary, longest);
      if (v < no_coherence) bounded_.push_back({e, places[e], face, v});
    }
  }
  const auto nearest =
      std::min_element(bounded_.begin(), bounded_.end(), [](const Bounded& x, const Bounded& y) { return x.v < y.v; });
  for (auto wave = bounded_.begin(); wave != bounded_.end(); ++wave) tie(node, *wave, beyond_end, wave == nearest);
}

void CompositeSum::tie_to_composites() {
  std::size_t most = 0;
  for (std::size_t i = 0; i < arrivals_; ++i) most = std::max(most, nodes_[i].edges.size());
  // What belongs to a wave has one edge more: it has spoken before.
  for (std::size_t edges = most; edges > 0; --edges)
    for (std::uint32_t i = 0; i < node_count_; ++i)
      if (nodes_[i].edges.size() == edges) tie_upward(i);
}

void CompositeSum::tie_corners(std::uint32_t node) {
  const double longest = 2 * pi / plan_->wavenumber.front();
  const std::span<const Interaction> interactions = nodes_[node].interactions;
  const EdgePlaces places(interactions);
  for (std::size_t e = 0; e < nodes_[node].edges.size(); ++e) {
    const EdgePassage passage = nodes_[node].edges[e];
    const Wedge& wedge = scene_->wedges.wedges[passage.wedge];
    const double zone = std::sqrt(longest * passage.s_in * passage.s_out / (passage.s_in + passage.s_out));
    const auto tie_to = [&](std::uint32_t vertex, double away) {
      if (vertex == no_index || away >= 2 * zone) return;
      constexpr Interaction some_corner = 0x7fffffffu;
      const SequenceHash rest = hash_without(interactions, places[e], edge_interaction(some_corner));
      ties_.push_back({node_of(extended(rest, vertex)), node, static_cast<std::uint32_t>(weights_.size())});
      for (const double k : plan_->wavenumber)
        weights_.push_back(fade(away / zone * std::sqrt(k / plan_->wavenumber.front()), 1));
    };
    tie_to(wedge.vertex_start, std::abs(passage.along));
    tie_to(wedge.vertex_end, std::abs(wedge.length - passage.along));
  }
}

std::uint32_t CompositeSum::root_of(std::uint32_t node) {
  while (root_[node] != node) node = root_[node] = root_[root_[node]];
  return node;
}

/// Ties to a wave that does not arrive and ties no other are for nothing.
void CompositeSum::drop_loose_ends() {
  degree_.assign(node_count_, 0);
  for (const Tie& tie : ties_) ++degree_[tie.a], ++degree_[tie.b];
  for (bool more = true; more;) {
    more = false;
    std::erase_if(ties_, [&](const Tie& tie) {
      const bool loose = (tie.a >= arrivals_ && degree_[tie.a] == 1) || (tie.b >= arrivals_ && degree_[tie.b] == 1);
      if (loose) --degree_[tie.a], --degree_[tie.b], more = true;
      return loose;
    });
  }
}

void CompositeSum::span_tree() {
  std::sort(ties_.begin(), ties_.end(), [&](const Tie& x, const Tie& y) {
    if (weights_[x.weights] != weights_[y.weights]) return weights_[x.weights] > weights_[y.weights];
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  const std::size_t nodes = node_count_;
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
  sums_.assign(node_count_, {});
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
  const auto sinc = [](double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : sine_cosine(x).sine / x; };
  const double scale = 0.5 * plan_->wavenumber[band] * extent;
  double cross_terms = 0;
  place_.resize(node_count_);
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
  if (arrivals.size() < 2) return;
  ties_.clear();
  weights_.clear();
  enter(arrivals, polarisation);
  tie_to_composites();
  for (std::uint32_t i = 0; i < arrivals_; ++i) tie_corners(i);
  drop_loose_ends();
  span_tree();
  for (std::size_t band = 0; band < plan_->bands(); ++band) {
    out[band] =
        extent > 0 ? over_a_square(arrivals, band, polarisation, extent) : at_the_point(arrivals, band, polarisation);
    // A null of the field may come out a rounding error below zero.
    out[band] = std::max(out[band], -power_[band] * (1 - 1e-12));
  }
}

}  // namespace grimaldi
