#pragma once
// A path as a sequence: source, then faces (patches) and edges (wedges) in order, then a receiver.

#include <cstdint>
#include <span>
#include <vector>

namespace grimaldi {

/// A patch index, or a wedge index with `edge_bit`.
using Interaction = std::uint32_t;
inline constexpr Interaction edge_bit = 0x80000000u;
constexpr bool is_edge(Interaction i) { return (i & edge_bit) != 0; }
constexpr std::uint32_t index_of(Interaction i) { return i & ~edge_bit; }
constexpr Interaction edge_interaction(std::uint32_t wedge) { return wedge | edge_bit; }

/// Interactions along one path at the most.
inline constexpr std::size_t max_depth = 32;
/// Edges among them at the most.
inline constexpr std::size_t max_edges = 8;

/// Name of a sequence: 64 bits that depend on its interactions in order; the empty one has `empty_sequence`.
using SequenceHash = std::uint64_t;
inline constexpr SequenceHash empty_sequence = 0x9e3779b97f4a7c15u;

/// The name of a sequence with one more interaction. (Finaliser of splitmix64: a permutation, so that names collide
/// only by chance: 1e-7 for a million sequences.)
constexpr SequenceHash extended(SequenceHash hash, Interaction interaction) {
  std::uint64_t x = hash + 0x9e3779b97f4a7c15u * (std::uint64_t(interaction) + 1);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

SequenceHash hash_of(std::span<const Interaction> interactions);

/// Name of `interactions` with number `at` left out, or replaced by `other` if that is not no_interaction.
inline constexpr Interaction no_interaction = 0xffffffffu;
SequenceHash hash_without(std::span<const Interaction> interactions, std::size_t at, Interaction other);

/// Many distinct sequences, numbered in the order in which they came.
class SequenceTable {
 public:
  SequenceTable();
  std::size_t size() const { return hashes_.size(); }
  std::span<const Interaction> operator[](std::size_t i) const {
    return {interactions_.data() + begins_[i], interactions_.data() + begins_[i + 1]};
  }
  SequenceHash hash(std::size_t i) const { return hashes_[i]; }

  /// Number of the sequence of that name, entered now if it is new.
  std::uint32_t enter(SequenceHash hash, std::span<const Interaction> interactions);

  /// Number of the sequence of that name, or no_sequence.
  static constexpr std::uint32_t no_sequence = 0xffffffffu;
  std::uint32_t find(SequenceHash hash) const;

  /// Numbers anew by fewest edges, then shortest, then by the interactions' values. Returns the new number of each old
  /// one.
  std::vector<std::uint32_t> sort();

  void clear();

 private:
  void rehash(std::size_t slots);
  std::vector<SequenceHash> hashes_;
  std::vector<std::uint64_t> begins_;
  std::vector<Interaction> interactions_;
  std::vector<std::uint32_t> slots_;  ///< open addressing by hash: number + 1, 0 = free
};

/// True if one of the tables has the sequence of that name.
bool is_in(std::span<const SequenceTable* const> tables, SequenceHash hash);

std::size_t count_edges(std::span<const Interaction> interactions);

}  // namespace grimaldi
