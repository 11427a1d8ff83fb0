#include "scenes/wedge_merge.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/constants.h"
#include "scenes/surroundings.h"

namespace grimaldi {
namespace {

constexpr double on_line = 1e-3;               // m; see merge_pieces
constexpr double same_angle = 0.5 * pi / 180;  // rad

/// The same wedge seen from its other face: the edge runs backward.
void turn_round(Wedge& w) {
  const double c = std::cos(w.exterior_angle), s = std::sin(w.exterior_angle);
  const Vec3 along_n = c * w.along0 + s * w.normal0, normal_n = s * w.along0 - c * w.normal0;
  w.start = w.end();
  w.direction = -w.direction;
  w.along0 = along_n;
  w.normal0 = normal_n;
  std::swap(w.patch0, w.patchn);
  std::swap(w.material0, w.materialn);
  std::swap(w.vertex_start, w.vertex_end);
}

auto group_of(const Wedge& w) { return std::make_tuple(w.patch0, w.patchn, w.free_rim); }

/// Where a piece lies on the line of another.
struct Place {
  std::uint32_t piece;
  double from, to;  // m
  double off;       // greatest distance of its ends from the line, m
};

/// True if `piece` belongs to the line and sector of `line`; it is turned round if it runs against it.
bool place_on(const Wedge& line, Wedge& piece, Place& place) {
  if (std::abs(line.exterior_angle - piece.exterior_angle) > same_angle) return false;
  const auto off = [&](const Vec3& p) {
    const Vec3 d = p - line.start;
    return norm(d - dot(d, line.direction) * line.direction);
  };
  place.off = std::max(off(piece.start), off(piece.end()));
  if (place.off > contact_distance) return false;
  // Only faces of one patch (a free rim, a thin plate) leave the direction open.
  if (piece.patch0 == piece.patchn && dot(line.direction, piece.direction) < 0) turn_round(piece);
  if (dot(line.along0, piece.along0) < std::cos(same_angle) || dot(line.direction, piece.direction) < 0) return false;
  place.from = dot(piece.start - line.start, line.direction);
  place.to = dot(piece.end() - line.start, line.direction);
  return true;
}

/// `line` stretched to the ends of the first and the last of its parts.
Wedge stretch(Wedge line, const Wedge& first, const Wedge& last) {
  const Vec3 end = last.end();
  line.start = first.start;
  line.vertex_start = first.vertex_start;
  line.vertex_end = last.vertex_end;
  line.length = distance(line.start, end);
  line.direction = (end - line.start) / line.length;
  line.along0 = normalized(line.along0 - dot(line.along0, line.direction) * line.direction);
  line.normal0 = cross(line.direction, line.along0);
  return line;
}

}  // namespace

std::vector<WedgePiece> merge_pieces(std::vector<WedgePiece> pieces) {
  for (WedgePiece& p : pieces) {
    if (p.wedge.patch0 > p.wedge.patchn) turn_round(p.wedge);
  }
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Wedge &wa = pieces[a].wedge, &wb = pieces[b].wedge;
    if (group_of(wa) != group_of(wb)) return group_of(wa) < group_of(wb);
    return wa.length != wb.length ? wa.length > wb.length : a < b;
  });

  struct Merged {
    std::uint32_t rank;  // smallest piece
    WedgePiece piece;
  };
  std::vector<Merged> merged;
  std::vector<std::uint8_t> used(pieces.size(), 0);
  std::vector<Place> places;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (used[order[i]]) continue;
    const Wedge line = pieces[order[i]].wedge;
    places.clear();
    for (std::size_t j = i; j < order.size() && group_of(pieces[order[j]].wedge) == group_of(line); ++j) {
      Place place{order[j], 0, 0, 0};
      if (!used[order[j]] && place_on(line, pieces[order[j]].wedge, place)) places.push_back(place);
    }
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.from != b.from ? a.from < b.from : a.piece < b.piece; });
    // The run of parts about the longest piece; parts beyond a gap are left for a later turn.
    const auto self = std::find_if(places.begin(), places.end(), [&](const Place& p) { return p.piece == order[i]; });
    double from = self->from, to = self->to;
    const Place *first = &*self, *last = &*self;
    std::vector<std::uint32_t> members{order[i]};
    used[order[i]] = 1;
    const auto take = [&](const Place& p) {
      const double overlap = std::min(to, p.to) - std::max(from, p.from);
      const bool joins = p.off <= on_line ? overlap >= -on_line : overlap >= 0.5 * (p.to - p.from);
      if (used[p.piece] || !joins) return false;
      used[p.piece] = 1;
      members.push_back(p.piece);
      if (p.from < from - on_line) from = p.from, first = &p;
      if (p.to > to + on_line) to = p.to, last = &p;
      return true;
    };
    for (bool grows = true; grows;) {
      grows = false;
      for (const Place& p : places) grows = take(p) || grows;
      for (auto p = places.rbegin(); p != places.rend(); ++p) grows = take(*p) || grows;
    }

    Merged result{*std::min_element(members.begin(), members.end()), {}};
    const bool single = first == &*self && last == &*self;
    result.piece.wedge = single ? line : stretch(line, pieces[first->piece].wedge, pieces[last->piece].wedge);
    for (const std::uint32_t m : members) {
      const auto& t = pieces[m].triangles;
      result.piece.triangles.insert(result.piece.triangles.end(), t.begin(), t.end());
    }
    merged.push_back(std::move(result));
  }
  std::sort(merged.begin(), merged.end(), [](const Merged& a, const Merged& b) { return a.rank < b.rank; });
  std::vector<WedgePiece> result;
  result.reserve(merged.size());
  for (Merged& m : merged) result.push_back(std::move(m.piece));
  return result;
}

}  // namespace grimaldi
