#pragma once
// A tree of boxes over the triangles of a scene: which of them come near a place.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"

namespace grimaldi {

/// Built by halving at the median of the centroids along the longest side; ties go by the index, so the tree depends on
/// the input alone. Building takes O(n log n), a query O(log n + hits) for triangles of about equal size.
class TriangleTree {
 public:
  TriangleTree(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);

  /// `found` becomes the triangles whose bounding box meets the box [low, high] (m, ends included), ascending.
  void find(const Vec3& low, const Vec3& high, std::vector<std::uint32_t>& found) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  struct Node {
    Box box;
    std::uint32_t begin, end;  ///< range of `order_`
    std::uint32_t right;       ///< index of the second child (the first follows its parent); 0: a leaf
  };
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace grimaldi
