#include "scenes/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace grimaldi {
namespace {

Vec3 lower(const Vec3& a, const Vec3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(const Vec3& a, const Vec3& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

bool meet(const Vec3& low_a, const Vec3& high_a, const Vec3& low_b, const Vec3& high_b) {
  return low_a.x <= high_b.x && low_b.x <= high_a.x && low_a.y <= high_b.y && low_b.y <= high_a.y &&
         low_a.z <= high_b.z && low_b.z <= high_a.z;
}

constexpr std::uint32_t leaf_size = 4;

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vec3>& vertices,
                           const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  boxes_.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    boxes_.push_back(
        {lower(lower(vertices[a], vertices[b]), vertices[c]), upper(upper(vertices[a], vertices[b]), vertices[c])});
  }
  order_.resize(triangles.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(triangles.size() + 1);
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()));
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  Box box = boxes_[order_[begin]];
  Vec3 low = box.low + box.high, high = low;  // of twice the centroids
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    const Box& other = boxes_[order_[i]];
    box = {lower(box.low, other.low), upper(box.high, other.high)};
    low = lower(low, other.low + other.high);
    high = upper(high, other.low + other.high);
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= leaf_size) return;

  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = boxes_[a].low[axis] + boxes_[a].high[axis];
                     const double cb = boxes_[b].low[axis] + boxes_[b].high[axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  build(begin, middle);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

void TriangleTree::find(const Vec3& low, const Vec3& high, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> waiting;  // halving: no deeper than the 32 bits of the index
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = waiting[--count];
    const Node& node = nodes_[index];
    if (!meet(node.box.low, node.box.high, low, high)) continue;
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const Box& box = boxes_[order_[i]];
        if (meet(box.low, box.high, low, high)) found.push_back(order_[i]);
      }
    } else {
      waiting[count++] = node.right;
      waiting[count++] = index + 1;
    }
  }
  std::sort(found.begin(), found.end());
}

}  // namespace grimaldi
