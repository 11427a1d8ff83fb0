#include "propagation/sequence.h"

#include <algorithm>
#include <numeric>

namespace grimaldi {

SequenceHash hash_of(std::span<const Interaction> interactions) {
  SequenceHash hash = empty_sequence;
  for (const Interaction i : interactions) hash = extended(hash, i);
  return hash;
}

SequenceHash hash_without(std::span<const Interaction> interactions, std::size_t at, Interaction other) {
  SequenceHash hash = empty_sequence;
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    if (i != at)
      hash = extended(hash, interactions[i]);
    else if (other != no_interaction)
      hash = extended(hash, other);
  }
  return hash;
}

std::size_t count_edges(std::span<const Interaction> interactions) {
  return static_cast<std::size_t>(std::count_if(interactions.begin(), interactions.end(), is_edge));
}

bool is_in(std::span<const SequenceTable* const> tables, SequenceHash hash) {
  return std::any_of(tables.begin(), tables.end(),
                     [&](const SequenceTable* table) { return table->find(hash) != SequenceTable::no_sequence; });
}

SequenceTable::SequenceTable() { clear(); }

void SequenceTable::clear() {
  hashes_.clear();
  interactions_.clear();
  begins_.assign(1, 0);
  slots_.assign(1024, 0);
}

std::uint32_t SequenceTable::find(SequenceHash hash) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
    if (slots_[slot] == 0) return no_sequence;
    if (hashes_[slots_[slot] - 1] == hash) return slots_[slot] - 1;
  }
}

std::uint32_t SequenceTable::enter(SequenceHash hash, std::span<const Interaction> interactions) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash & mask;
  for (; slots_[slot] != 0; slot = (slot + 1) & mask)
    if (hashes_[slots_[slot] - 1] == hash) return slots_[slot] - 1;
  const auto number = static_cast<std::uint32_t>(hashes_.size());
  slots_[slot] = number + 1;
  hashes_.push_back(hash);
  interactions_.insert(interactions_.end(), interactions.begin(), interactions.end());
  begins_.push_back(interactions_.size());
  if (2 * hashes_.size() > slots_.size()) rehash(4 * slots_.size());
  return number;
}

void SequenceTable::rehash(std::size_t slots) {
  slots_.assign(slots, 0);
  for (std::size_t i = 0; i < hashes_.size(); ++i) {
    std::size_t slot = hashes_[i] & (slots - 1);
    while (slots_[slot] != 0) slot = (slot + 1) & (slots - 1);
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

std::vector<std::uint32_t> SequenceTable::sort() {
  std::vector<std::uint32_t> order(size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::uint32_t> edges(size());
  for (std::size_t i = 0; i < size(); ++i) edges[i] = static_cast<std::uint32_t>(count_edges((*this)[i]));
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (edges[a] != edges[b]) return edges[a] < edges[b];
    const auto sa = (*this)[a], sb = (*this)[b];
    if (sa.size() != sb.size()) return sa.size() < sb.size();
    return std::lexicographical_compare(sa.begin(), sa.end(), sb.begin(), sb.end());
  });
  SequenceTable sorted;
  std::vector<std::uint32_t> renumbered(size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.enter(hash(order[i]), (*this)[order[i]]);
    renumbered[order[i]] = static_cast<std::uint32_t>(i);
  }
  *this = std::move(sorted);
  return renumbered;
}

}  // namespace grimaldi
