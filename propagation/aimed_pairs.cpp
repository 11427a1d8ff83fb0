#include "propagation/aimed_pairs.h"

#include <algorithm>
#include <cmath>

#include "propagation/fermat.h"

namespace grimaldi {
namespace {

/// Rays from which on every pair is asked, and those for each further round.
constexpr double rays_of_all_pairs = 1.25e5, rays_of_a_round = 1e6;
/// Beams that look for the transmitter's faces, besides one to each triangle.
constexpr std::uint64_t beams_of_the_view = 65536;

/// Shares of the sides of a triangle, of the length of a wedge: spread evenly (additive sequences of the plastic number
/// and of the golden ratio), and nowhere where a regular city has corners in a row.
struct Place {
  double first, second;
};
double fraction(double x) { return x - std::floor(x); }
Place place_of(std::uint64_t round) {
  const double u = fraction(0.7548776662466927 * double(round + 1)),
               v = fraction(0.5698402909980532 * double(round + 1));
  return u + v > 1 ? Place{1 - u, 1 - v} : Place{u, v};
}
double share_of(std::uint64_t round) { return fraction(0.6180339887498949 * double(round + 1)); }

/// The numbers below `count` that belong to every `stride`-th pair, where this row of pairs begins at `row` × `count`.
std::uint64_t first_asked(std::uint64_t row, std::uint64_t count, std::uint64_t stride) {
  return (stride - row * count % stride) % stride;
}

std::uint64_t rounds_of(const Plan& plan) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(plan.request.rays / rays_of_a_round)));
}

std::uint64_t share_asked(const Plan& plan) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(rays_of_all_pairs / plan.request.rays)));
}

}  // namespace

AimedPairs::AimedPairs(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                       std::uint64_t stride, std::uint64_t& rays)
    : scene_(scene),
      source_(plan.request.transmitters[transmitter].position),
      second_edges_(most_edges(plan.request) > 1),
      rounds_(rounds_of(plan)),
      stride_(stride * share_asked(plan)),
      view_(scene, tracer, source_, plan.request.reflection && plan.request.max_reflections > 0 ? 1 : 0,
            beams_of_the_view, rays) {}

std::uint64_t AimedPairs::row_of(std::size_t block, std::uint64_t round) const {
  const std::size_t wedges = scene_.wedges.wedges.size(), edges = view_.edges().size();
  const std::uint64_t row =
      block < edges ? view_.edges()[block].wedge : wedges + view_.mirrors()[block - edges].patches.front();
  return round * (wedges + scene_.patches.patches.size()) + row;
}

void AimedPairs::walk_block(std::size_t block, Walker& walker) const {
  if (block < view_.edges().size())
    walk_edge(block, walker);
  else
    walk_mirror(block - view_.edges().size(), walker);
}

void AimedPairs::walk_edge(std::size_t number, Walker& walker) const {
  const EndView::Edge& edge = view_.edges()[number];
  const Wedge& wedge = scene_.wedges.wedges[edge.wedge];
  const bool faces = !view_.mirrors().empty();
  // Where the shortest way from the transmitter to `target` passes the edge, if the transmitter sees that place and the
  // target may.
  const auto along_to = [&](const Vec3& target) {
    const Vec3 way = target - wedge.start;
    if (dot(way, wedge.normal0) <= 0 && dot(way, wedge.normaln()) <= 0) return -1.0;
    const double along = crossing(wedge.start, wedge.direction, source_, target);
    return along > 0 && along < wedge.length && !edge.shadow.is_dark(along / wedge.length) ? along : -1.0;
  };
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    const std::uint64_t row = row_of(number, round), name = row << 32;
    const auto [u, v] = place_of(round);
    const std::uint64_t triangles = faces ? scene_.triangles.size() : 0;
    for (std::uint64_t t = first_asked(row, triangles, stride_); t < triangles; t += stride_) {
      const std::uint32_t patch = scene_.patches.triangle_patch[t];
      if (patch == wedge.patch0 || patch == wedge.patchn) continue;
      const auto& corners = scene_.triangles[t];
      const Vec3 &a = scene_.vertices[corners[0]], &b = scene_.vertices[corners[1]], &c = scene_.vertices[corners[2]];
      const Vec3 target = a + u * (b - a) + v * (c - a);
      const double along = along_to(target);
      if (along > 0) walker.walk_over_edge(source_, edge.wedge, along, target, name | t);
    }
    const std::uint64_t wedges = second_edges_ ? scene_.wedges.wedges.size() : 0;
    for (std::uint64_t w = first_asked(row, wedges, stride_); w < wedges; w += stride_) {
      if (w == edge.wedge) continue;
      const Wedge& second = scene_.wedges.wedges[w];
      const double share = share_of(round);
      const double along = along_to(second.point(share * second.length));
      if (along > 0)
        walker.walk_to_second_edge(source_, edge.wedge, along, static_cast<std::uint32_t>(w), share,
                                   name | 1u << 31 | w);
    }
  }
}

void AimedPairs::walk_mirror(std::size_t number, Walker& walker) const {
  const EndView::Mirror& mirror = view_.mirrors()[number];
  const std::uint32_t patch_number = mirror.patches.front();
  const Patch& patch = scene_.patches.patches[patch_number];
  const std::uint64_t wedges = scene_.wedges.wedges.size();
  for (std::uint64_t round = 0; round < rounds_; ++round) {
    const std::uint64_t row = row_of(view_.edges().size() + number, round), name = row << 32;
    const double share = share_of(round);
    for (std::uint64_t w = first_asked(row, wedges, stride_); w < wedges; w += stride_) {
      const Wedge& wedge = scene_.wedges.wedges[w];
      if (wedge.patch0 == patch_number || wedge.patchn == patch_number) continue;
      if (crosses_box(patch, mirror.image, wedge.point(share * wedge.length)))
        walker.walk_by_mirror(source_, patch_number, static_cast<std::uint32_t>(w), share, name | w);
    }
  }
}

}  // namespace grimaldi
