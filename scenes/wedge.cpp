#include "scenes/wedge.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "scenes/edge_foot.h"
#include "scenes/edge_table.h"
#include "scenes/piece.h"
#include "scenes/surroundings.h"
#include "scenes/wedge_merge.h"
#include "scenes/wedge_sector.h"
#include "scenes/wedge_stretch.h"

namespace grimaldi {
namespace {

// A change of the sector by less is taken for rounding: vertices a contact distance off on a face one metre wide, rad.
constexpr double same_angle = 0.5 * pi / 180;

void add(EdgeTally& tally, double length) {
  ++tally.count;
  tally.length += length;
}

class WedgeSearch {
 public:
  WedgeSearch(const Surroundings& surroundings, const EdgeTable& table, const std::vector<std::uint32_t>& material,
              const Patches& patches)
      : surroundings_(surroundings), table_(table), material_(material), patches_(patches) {}

  /// Counts the edge and keeps its free sectors.
  void look_at(const Edge& edge) {
    const std::uint32_t first = table_.uses[edge.begin].triangle;
    if (edge.valence() == 1 && surroundings_.ground[first]) return;
    EdgeSection section(surroundings_, table_, edge);
    if (edge.valence() == 1) {
      const auto stretches = find_stretches(section, patches_);
      count_rim(section);
      keep(edge, section, stretches);
      return;
    }
    if (edge.valence() > 2) {
      add(report_.higher, section.length);
      keep(edge, section, find_stretches(section, patches_));
      return;
    }
    if (is_touch(surroundings_.vertices, table_, edge)) {
      keep(edge, section, find_stretches(section, patches_));
      return;
    }
    const std::uint32_t second = table_.uses[edge.begin + 1].triangle;
    const double opening = section.opening();
    if (std::abs(opening - pi) <= flat_tolerance) return;
    if (opening < pi) {
      add(report_.concave, section.length);
      // What is free can only be less; of a sheet, the other side is free too.
      if (surroundings_.solid[first] && surroundings_.solid[second]) return;
    } else {
      add(material_[first] == material_[second] ? report_.within_material : report_.across_materials, section.length);
    }
    const auto stretches = find_stretches(section, patches_);
    if (opening > pi) count_filled(opening, stretches);
    keep(edge, section, stretches);
  }

  const std::vector<WedgePiece>& pieces() const { return pieces_; }
  const WedgeReport& report() const { return report_; }

 private:
  bool is_rim(const Edge& edge, const Sector& s) const {
    return edge.valence() == 1 && s.angle() > 2 * pi - same_angle &&
           patches_.triangle_patch[s.triangle0] == patches_.triangle_patch[s.trianglen];
  }

  /// What of the edge lies on no other surface, whether or not it is inside a solid.
  void count_rim(const EdgeSection& section) {
    constexpr double step = 0.5;  // m
    double length = 0;
    const auto& breaks = section.breaks();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double size = breaks[i + 1] - breaks[i];
      const bool alone = !section.has_others(0.5 * (breaks[i] + breaks[i + 1]));
      const double parts = alone ? 1 : std::ceil(size / step);
      for (double k = 0; k < parts; ++k) {
        if (alone || section.is_one_sided(breaks[i] + size * ((k + 0.5) / parts), same_angle)) length += size / parts;
      }
    }
    if (length > 0) add(report_.free_rims, length);
  }

  void count_filled(double opening, const std::vector<Stretch>& stretches) {
    double length = 0;
    for (const Stretch& stretch : stretches) {
      const bool whole = std::any_of(stretch.sectors.begin(), stretch.sectors.end(),
                                     [&](const Sector& s) { return std::abs(s.angle() - opening) < same_angle; });
      if (!whole) length += stretch.to - stretch.from;
    }
    if (length > 0) add(report_.filled, length);
  }

  void keep(const Edge& edge, const EdgeSection& section, const std::vector<Stretch>& stretches) {
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& stretch = stretches[i];
      for (const Sector& sector : stretch.sectors) {
        WedgePiece piece;
        Wedge& w = piece.wedge;
        w.start = section.start + stretch.from * section.direction;
        w.direction = section.direction;
        w.length = stretch.to - stretch.from;
        const double c = std::cos(sector.from), s = std::sin(sector.from);
        w.along0 = c * section.across + s * section.up;
        w.normal0 = c * section.up - s * section.across;
        w.exterior_angle = sector.angle();
        w.patch0 = patches_.triangle_patch[sector.triangle0];
        w.patchn = patches_.triangle_patch[sector.trianglen];
        w.material0 = material_[sector.triangle0];
        w.materialn = material_[sector.trianglen];
        w.vertex_start = i == 0 ? edge.vertex0 : no_index;
        w.vertex_end = i + 1 == stretches.size() ? edge.vertex1 : no_index;
        w.free_rim = is_rim(edge, sector);
        piece.triangles = stretch.triangles;
        for (std::uint32_t u = edge.begin; u < edge.end; ++u) piece.triangles.push_back(table_.uses[u].triangle);
        pieces_.push_back(std::move(piece));
      }
    }
  }

  const Surroundings& surroundings_;
  const EdgeTable& table_;
  const std::vector<std::uint32_t>& material_;
  const Patches& patches_;
  std::vector<WedgePiece> pieces_;
  WedgeReport report_;
};

/// The wedges of each triangle, in compressed rows.
void list_by_triangle(const std::vector<WedgePiece>& pieces, std::size_t triangle_count, Wedges& wedges) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t w = 0; w < pieces.size(); ++w) {
    for (const std::uint32_t t : pieces[w].triangles) pairs.push_back({t, w});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  wedges.triangle_wedge_begin.assign(triangle_count + 1, 0);
  for (const auto& [t, w] : pairs) {
    ++wedges.triangle_wedge_begin[t + 1];
    wedges.triangle_wedge.push_back(w);
  }
  for (std::size_t t = 0; t < triangle_count; ++t) wedges.triangle_wedge_begin[t + 1] += wedges.triangle_wedge_begin[t];
}

/// Forgets the vertices at which a wedge ends alone: a corner is where wedges meet.
void keep_corners(std::size_t vertex_count, std::vector<Wedge>& wedges) {
  std::vector<std::uint32_t> ends(vertex_count, 0);
  for (const Wedge& wedge : wedges)
    for (const std::uint32_t vertex : {wedge.vertex_start, wedge.vertex_end})
      if (vertex != no_index) ++ends[vertex];
  for (Wedge& wedge : wedges)
    for (std::uint32_t* vertex : {&wedge.vertex_start, &wedge.vertex_end})
      if (*vertex != no_index && ends[*vertex] < 2) *vertex = no_index;
}

}  // namespace

Wedges find_wedges(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   const std::vector<std::uint32_t>& triangle_material, const Patches& patches,
                   const std::vector<std::array<std::uint32_t, 2>>& artificial_edges) {
  GRIMALDI_EXPECT(triangles.size() == triangle_material.size() && triangles.size() == patches.triangle_patch.size());
  std::vector<std::array<std::uint32_t, 2>> artificial;
  for (const auto& [a, b] : artificial_edges) artificial.push_back({std::min(a, b), std::max(a, b)});
  std::sort(artificial.begin(), artificial.end());

  const EdgeTable table = make_edge_table(vertices.size(), triangles);
  const Surroundings surroundings(vertices, triangles, table);
  WedgeSearch search(surroundings, table, triangle_material, patches);
  for (const Edge& edge : table.edges) {
    if (!std::binary_search(artificial.begin(), artificial.end(), std::array{edge.vertex0, edge.vertex1})) {
      search.look_at(edge);
    }
  }

  Wedges result;
  result.report = search.report();
  const std::vector<WedgePiece> merged = merge_pieces(search.pieces());
  for (const WedgePiece& piece : merged) {
    Wedge& wedge = result.wedges.emplace_back(piece.wedge);
    wedge.sin_exterior = std::sin(wedge.exterior_angle);
    wedge.cos_exterior = std::cos(wedge.exterior_angle);
    wedge.sin_half = std::sin(0.5 * wedge.exterior_angle);
    wedge.cos_half = std::cos(0.5 * wedge.exterior_angle);
    add(result.report.propagating, piece.wedge.length);
  }
  keep_corners(vertices.size(), result.wedges);
  find_feet(surroundings, result.wedges);
  list_by_triangle(merged, triangles.size(), result);
  return result;
}

}  // namespace grimaldi
