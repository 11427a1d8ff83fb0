#include "propagation/edge_visibility.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace grimaldi {
namespace {

/// More corners are not worth the time.
constexpr std::size_t most_corners = 12;

/// The corners of the outline of triangles, all wound one way, if that is a single loop.
std::optional<std::vector<std::uint32_t>> single_loop(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& corners : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (const auto back = sides.find({to, from}); back != sides.end())
        sides.erase(back);
      else if (++sides[{from, to}] > 1)
        return std::nullopt;
    }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [side, count] : sides)
    if (!next.emplace(side.first, side.second).second) return std::nullopt;
  std::vector<std::uint32_t> loop;
  if (next.empty() || next.size() > most_corners) return std::nullopt;
  const std::uint32_t first = next.begin()->first;
  for (std::uint32_t corner = first;;) {
    loop.push_back(corner);
    const auto found = next.find(corner);
    if (found == next.end() || loop.size() > next.size()) return std::nullopt;
    corner = found->second;
    if (corner == first) break;
  }
  return loop.size() == next.size() ? std::optional(loop) : std::nullopt;
}

/// True if `point`, in the plane of a convex loop, lies inside by more than `margin`. `normal` need not be a unit
/// vector.
template <typename Corner>
bool lies_inside(std::size_t count, const Corner& corner, const Vec3& normal, const Vec3& point, double margin) {
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &from = corner(i), &to = corner(i + 1 == count ? 0 : i + 1);
    const Vec3 inward = cross(normal, to - from);
    if (dot(inward, point - from) < margin * norm(inward)) return false;
  }
  return true;
}

}  // namespace

ConvexFaces::ConvexFaces(const Scene& scene) : scene_(scene), faces_(scene.patches.patches.size()) {
  std::vector<std::vector<std::array<std::uint32_t, 3>>> triangles(faces_.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    triangles[scene.patches.triangle_patch[t]].push_back(scene.triangles[t]);
  for (std::size_t p = 0; p < faces_.size(); ++p) {
    const Patch& patch = scene.patches.patches[p];
    const auto vertex = [&](std::uint32_t corner) { return scene.vertices[corner]; };
    double uneven = 0;
    // Wound all one way, so that the loop around them covers each point inside once.
    for (auto& corners : triangles[p]) {
      const Vec3 a = vertex(corners[0]), b = vertex(corners[1]), c = vertex(corners[2]);
      if (dot(cross(b - a, c - a), patch.normal) < 0) std::swap(corners[1], corners[2]);
      for (const Vec3& v : {a, b, c}) uneven = std::max(uneven, std::abs(dot(patch.normal, v) - patch.offset));
    }
    const auto loop = single_loop(triangles[p]);
    if (!loop) continue;
    const auto corner = [&](std::size_t i) { return vertex((*loop)[i]); };
    // Corners on a straight side are off it by rounding.
    const double rounding = 1e-6;
    if (!std::all_of(loop->begin(), loop->end(), [&](std::uint32_t v) {
          return lies_inside(loop->size(), corner, patch.normal, vertex(v), -rounding);
        }))
      continue;
    faces_[p] = {static_cast<std::uint32_t>(corners_.size()), static_cast<std::uint32_t>(loop->size()), uneven};
    for (const std::uint32_t v : *loop) corners_.push_back(vertex(v));
  }
}

bool ConvexFaces::hides(std::uint32_t triangle, const std::array<Vec3, 2>& from, const std::array<Vec3, 2>& to,
                        double gap) const {
  const std::uint32_t number = scene_.patches.triangle_patch[triangle];
  const Face& face = faces_[number];
  const Patch& patch = scene_.patches.patches[number];
  const auto& corners = scene_.triangles[triangle];
  const bool whole = face.count > 0;
  const Vec3& first = scene_.vertices[corners[0]];
  const Vec3 normal = whole
                          ? patch.normal
                          : normalized(cross(scene_.vertices[corners[1]] - first, scene_.vertices[corners[2]] - first));
  const double offset = whole ? patch.offset : dot(normal, first), uneven = whole ? face.uneven : 0;
  const double near = 2 * gap + uneven;
  std::array<Vec3, 4> points;
  double margin = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = from[i / 2], way = to[i % 2] - a;
    const double above = dot(normal, a) - offset, fall = -dot(normal, way);
    if (!(above > near && above - fall < -near) && !(above < -near && above - fall > near)) return false;
    points[i] = a + above / fall * way;
    margin = std::max(margin, (gap + uneven) * norm(way) / std::abs(fall));
  }
  const auto inside = [&](std::size_t count, const auto& corner) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& point) { return lies_inside(count, corner, normal, point, margin); });
  };
  if (whole) return inside(face.count, [&](std::size_t i) -> const Vec3& { return corners_[face.first + i]; });
  return inside(3, [&](std::size_t i) -> const Vec3& { return scene_.vertices[corners[i]]; });
}

EdgeVisibility::EdgeVisibility(const Scene& scene, const Tracer& tracer, std::size_t most_bytes)
    : scene_(scene),
      tracer_(tracer),
      faces_(scene),
      words_((scene.wedges.wedges.size() + pairs_per_word - 1) / pairs_per_word),
      most_rows_(words_ == 0 ? 0 : most_bytes / (words_ * sizeof(Word))),
      wedges_(scene.wedges.wedges.size()),
      rows_(std::make_unique<std::atomic<Word*>[]>(wedges_)) {}

EdgeVisibility::~EdgeVisibility() {
  for (std::size_t i = 0; i < wedges_; ++i) delete[] rows_[i].load();
}

bool EdgeVisibility::visible(std::uint32_t a, double share_a, std::uint32_t b, double share_b) const {
  if (known_hidden(a, b)) return false;
  const Wedge &first = scene_.wedges.wedges[a], &second = scene_.wedges.wedges[b];
  const Vec3 from = seen(first, share_a), way = seen(second, share_b) - from;
  const double gap = tracer_.surface_gap(), length = norm(way);
  if (length <= 2 * gap) return true;
  const Vec3 direction = way / length;
  const Hit hit = tracer_.nearest(from + gap * direction, direction);
  if (hit.triangle == no_index || hit.distance >= length - 2 * gap) return true;
  if (faces_.hides(hit.triangle, {seen(first, 0), seen(first, 1)}, {seen(second, 0), seen(second, 1)}, gap))
    keep_hidden(a, b);
  return false;
}

void EdgeVisibility::keep_hidden(std::uint32_t a, std::uint32_t b) const {
  Word* row = rows_[a].load(std::memory_order_acquire);
  if (row == nullptr) {
    if (rows_kept_ >= most_rows_) return;
    auto fresh = std::make_unique<Word[]>(words_);
    if (rows_[a].compare_exchange_strong(row, fresh.get(), std::memory_order_acq_rel)) {
      row = fresh.release();
      ++rows_kept_;
    }
  }
  row[b / pairs_per_word].fetch_or(std::uint64_t(1) << b % pairs_per_word, std::memory_order_relaxed);
}

Vec3 EdgeVisibility::seen(const Wedge& wedge, double share) const {
  return wedge.point(share * wedge.length) + 3 * tracer_.surface_gap() * wedge.bisector();
}

}  // namespace grimaldi
