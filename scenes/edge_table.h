#pragma once
// Every edge of a soup of triangles once, with the triangles that use it: any number of them.

#include <array>
#include <cstdint>
#include <vector>

namespace grimaldi {

/// A triangle at an edge.
struct EdgeUse {
  std::uint32_t triangle;
  std::uint32_t third;  ///< the triangle's corner that is not on the edge
  bool forward;         ///< the triangle's winding runs from vertex0 to vertex1
};

/// The edge between two vertices; its uses are `EdgeTable::uses[begin … end)`, in the order of the triangles.
struct Edge {
  std::uint32_t vertex0, vertex1;  ///< vertex0 < vertex1
  std::uint32_t begin, end;
  std::uint32_t valence() const { return end - begin; }
};

struct EdgeTable {
  std::vector<Edge> edges;  ///< ascending by (vertex0, vertex1)
  std::vector<EdgeUse> uses;
};

/// The table of `triangles`, whose corners are three different indices below `vertex_count`.
/// Time and memory are linear in the number of triangles (times the logarithm of the greatest number of edges at a
/// vertex).
EdgeTable make_edge_table(std::size_t vertex_count, const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace grimaldi
