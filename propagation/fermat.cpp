#include "propagation/fermat.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace grimaldi {
namespace {

/// Two vertices of a path nearer than this are one point: no direction between them.
constexpr double shortest_leg = 1e-6;
/// Sine of the angle to an edge below which a ray runs along it.
constexpr double along_edge = 1e-6;
/// Newton's last step, m: convergence is quadratic, so what it leaves is far below a nanometre, and the length errs by
/// its square.
constexpr double last_step = 1e-5;
/// Beyond an end of an edge its wave is kept while v_V is below this (physics: line 6 of the edge's law).
constexpr double end_parameter_limit = 3;

Vec3 mirrored_direction(const Vec3& direction, const Patch& patch) {
  return direction - 2 * dot(direction, patch.normal) * patch.normal;
}

}  // namespace

Vec3 mirrored(const Vec3& point, const Patch& patch) {
  return point - 2 * (dot(point, patch.normal) - patch.offset) * patch.normal;
}

UnfoldedSequence::UnfoldedSequence(const Scene& scene, const Vec3& source, std::span<const Interaction> interactions)
    : scene_(&scene), interactions_(interactions), source_(source), image_(source) {
  for (std::size_t i = 0; i < interactions.size(); ++i) {
    const Interaction here = interactions[i];
    if (i > 0 && interactions[i - 1] == here) possible_ = false;
    if (!is_edge(here)) {
      const Patch& patch = scene.patches.patches[here];
      image_ = mirrored(image_, patch);
      for (std::size_t e = 0; e < edge_count_; ++e) {
        UnfoldedEdge& edge = edges_[e];
        edge.start = mirrored(edge.start, patch);
        edge.direction = mirrored_direction(edge.direction, patch);
        edge.along0 = mirrored_direction(edge.along0, patch);
        edge.normal0 = mirrored_direction(edge.normal0, patch);
      }
      continue;
    }
    if (edge_count_ == max_edges) {
      possible_ = false;
      return;
    }
    const Wedge& wedge = scene.wedges.wedges[index_of(here)];
    for (const std::size_t j : {i - 1, i + 1})
      if (j < interactions.size() && (interactions[j] == wedge.patch0 || interactions[j] == wedge.patchn))
        possible_ = false;
    edges_[edge_count_++] = {index_of(here), i, wedge.start, wedge.direction, wedge.along0, wedge.normal0};
  }
}

bool UnfoldedSequence::fermat_points(const Vec3& receiver, std::array<double, max_edges>& along) {
  const auto closed_form = [&](const UnfoldedEdge& edge, const Vec3& a, const Vec3& b) {
    const Vec3 pa = a - edge.start, pb = b - edge.start;
    const double za = dot(pa, edge.direction), zb = dot(pb, edge.direction);
    const double ra = norm(pa - za * edge.direction), rb = norm(pb - zb * edge.direction);
    return ra + rb > 0 ? (za * rb + zb * ra) / (ra + rb) : 0.5 * (za + zb);
  };
  if (edge_count_ == 1) {
    along[0] = closed_form(edges_[0], image_, receiver);
    return true;
  }
  // Start: each edge for itself between the ends, then Newton on the convex length with a tridiagonal Hessian.
  for (std::size_t i = 0; i < edge_count_; ++i) {
    if (has_last_) {
      along = last_;
      break;
    }
    const Vec3 before = i == 0 ? image_ : edges_[i - 1].point(along[i - 1]);
    along[i] = closed_form(edges_[i], before, receiver);
  }
  const auto vertex = [&](std::size_t i, const std::array<double, max_edges>& t) {
    return i == 0 ? image_ : i > edge_count_ ? receiver : edges_[i - 1].point(t[i - 1]);
  };
  const auto length = [&](const std::array<double, max_edges>& t) {
    double sum = 0;
    for (std::size_t i = 0; i <= edge_count_; ++i) sum += distance(vertex(i, t), vertex(i + 1, t));
    return sum;
  };
  double current = length(along);
  for (int iteration = 0; iteration < 60; ++iteration) {
    std::array<double, max_edges> gradient{}, diagonal{}, upper{};
    for (std::size_t leg = 0; leg <= edge_count_; ++leg) {
      const Vec3 way = vertex(leg + 1, along) - vertex(leg, along);
      const double s = norm(way);
      if (s < shortest_leg) return false;
      const Vec3 u = way / s;
      const double a = leg > 0 ? dot(u, edges_[leg - 1].direction) : 0;
      const double b = leg < edge_count_ ? dot(u, edges_[leg].direction) : 0;
      if (leg > 0) {
        gradient[leg - 1] -= a;
        diagonal[leg - 1] += (1 - a * a) / s;
      }
      if (leg < edge_count_) {
        gradient[leg] += b;
        diagonal[leg] += (1 - b * b) / s;
      }
      if (leg > 0 && leg < edge_count_)
        upper[leg - 1] = (a * b - dot(edges_[leg - 1].direction, edges_[leg].direction)) / s;
    }
    // Thomas' algorithm; the Hessian is positive definite unless the path runs along an edge.
    std::array<double, max_edges> d = diagonal, step{};
    for (std::size_t i = 0; i < edge_count_; ++i) {
      step[i] = -gradient[i];
      if (i > 0) {
        const double factor = upper[i - 1] / d[i - 1];
        d[i] -= factor * upper[i - 1];
        step[i] -= factor * step[i - 1];
      }
      if (!(d[i] > 1e-12 * diagonal[i]) || diagonal[i] == 0) return false;
    }
    for (std::size_t i = edge_count_; i-- > 0;) {
      if (i + 1 < edge_count_) step[i] -= upper[i] * step[i + 1];
      step[i] /= d[i];
    }
    double largest = 0;
    for (std::size_t i = 0; i < edge_count_; ++i) largest = std::max(largest, std::abs(step[i]));
    if (largest < last_step) {
      for (std::size_t i = 0; i < edge_count_; ++i) along[i] += step[i];
      last_ = along;
      has_last_ = true;
      return true;
    }
    // A full Newton step, halved while it does not shorten the way.
    std::array<double, max_edges> next;
    double shorter = current;
    for (double share = 1; share > 1e-9; share *= 0.5) {
      for (std::size_t i = 0; i < edge_count_; ++i) next[i] = along[i] + share * step[i];
      shorter = length(next);
      if (shorter <= current) break;
    }
    if (shorter > current) return false;
    along = next;
    current = shorter;
  }
  return false;
}

bool UnfoldedSequence::passage(std::size_t i, const Vec3& before, double along, const Vec3& after,
                               EdgePassage& out) const {
  const UnfoldedEdge& edge = edges_[i];
  const Wedge& wedge = scene_->wedges.wedges[edge.wedge];
  const Vec3 q = edge.point(along);
  const Vec3 in = before - q, away = after - q;
  out.wedge = edge.wedge;
  out.along = along;
  out.s_in = norm(in);
  out.s_out = norm(away);
  if (out.s_in < shortest_leg || out.s_out < shortest_leg) return false;
  const double cos_beta = dot(in, edge.direction) / out.s_in;
  out.sin_beta = std::sqrt(std::max(0.0, 1 - cos_beta * cos_beta));
  if (out.sin_beta < along_edge) return false;
  // Rounding may put an end that lies on face 0 a hair below it.
  constexpr double rounding = 1e-9;
  for (auto [way, phi] : {std::pair{&in, &out.phi_in}, std::pair{&away, &out.phi_out}}) {
    *phi = std::atan2(dot(*way, edge.normal0), dot(*way, edge.along0));
    if (*phi < -rounding) *phi += 2 * pi;
    if (*phi > wedge.exterior_angle + rounding) return false;
    *phi = std::clamp(*phi, 0.0, wedge.exterior_angle);
  }
  out.inside = along >= 0 && along <= wedge.length;
  const double over = out.s_in + out.s_out;
  const Vec3 ends[2] = {edge.start, edge.point(wedge.length)};
  out.detour_start = std::max(0.0, distance(before, ends[0]) + distance(ends[0], after) - over);
  out.detour_end = std::max(0.0, distance(before, ends[1]) + distance(ends[1], after) - over);
  return true;
}

bool UnfoldedSequence::mirror_points(std::size_t first, std::size_t last, PathGeometry& geometry) const {
  // Interactions first … last−1 are faces between the vertices points[first] and points[last + 1] (points[i + 1]
  // belongs to interaction i): images of the first vertex, then back from the last one.
  std::array<Vec3, max_depth + 1> images;
  Vec3 image = geometry.points[first];
  for (std::size_t i = first; i < last; ++i)
    images[i] = image = mirrored(image, scene_->patches.patches[interactions_[i]]);
  Vec3 to = geometry.points[last + 1];
  for (std::size_t i = last; i-- > first;) {
    const Patch& patch = scene_->patches.patches[interactions_[i]];
    const double above = dot(patch.normal, to) - patch.offset;
    const double below = dot(patch.normal, images[i]) - patch.offset;
    if (!(above * below < 0)) return false;
    const Vec3 point = to + (above / (above - below)) * (images[i] - to);
    constexpr double slack = 0.01;  // bounding boxes only sort out; the ray decides
    for (int axis = 0; axis < 3; ++axis)
      if (point[axis] < patch.low[axis] - slack || point[axis] > patch.high[axis] + slack) return false;
    geometry.points[i + 1] = to = point;
  }
  return true;
}

bool UnfoldedSequence::solve(const Vec3& receiver, double wavelength, PathGeometry& geometry) {
  if (!possible_) return false;
  const std::size_t n = interactions_.size();
  geometry.count = n + 2;
  geometry.edge_count = edge_count_;
  geometry.points[0] = source_;
  geometry.points[n + 1] = receiver;
  if (edge_count_ == 0) {
    geometry.length = distance(image_, receiver);
    return geometry.length > shortest_leg && mirror_points(0, n, geometry);
  }
  std::array<double, max_edges> along{};
  if (!fermat_points(receiver, along)) return false;
  geometry.length = 0;
  Vec3 before = image_;
  for (std::size_t i = 0; i < edge_count_; ++i) {
    const Vec3 after = i + 1 < edge_count_ ? edges_[i + 1].point(along[i + 1]) : receiver;
    EdgePassage& passed = geometry.edges[i];
    if (!passage(i, before, along[i], after, passed)) return false;
    const Wedge& wedge = scene_->wedges.wedges[passed.wedge];
    double seen = along[i];
    if (!passed.inside) {
      const double detour = along[i] < 0 ? passed.detour_start : passed.detour_end;
      if (2 * std::sqrt(detour / wavelength) >= end_parameter_limit) return false;
      seen = std::clamp(along[i], 0.0, wedge.length);
    }
    geometry.points[edges_[i].position + 1] = wedge.point(seen);
    geometry.length += passed.s_in;
    before = edges_[i].point(along[i]);
    if (i + 1 == edge_count_) geometry.length += passed.s_out;
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i <= edge_count_; ++i) {
    const std::size_t last = i < edge_count_ ? edges_[i].position : n;
    if (last > first && !mirror_points(first, last, geometry)) return false;
    first = last + 1;
  }
  // Two edges of one corner, both passed at the corner itself, leave no leg between them.
  for (std::size_t i = 0; i + 1 < geometry.count; ++i)
    if (distance(geometry.points[i], geometry.points[i + 1]) < shortest_leg) return false;
  // Nor has a ray that runs along an edge, from a corner at one end to a corner at the other, a cone about it.
  for (std::size_t i = 0; i < edge_count_; ++i) {
    const std::size_t here = edges_[i].position + 1;
    const Vec3& direction = scene_->wedges.wedges[edges_[i].wedge].direction;
    for (const std::size_t next : {here - 1, here + 1}) {
      const Vec3 way = geometry.points[next] - geometry.points[here];
      if (norm2(cross(direction, way)) < along_edge * along_edge * norm2(way)) return false;
    }
  }
  return true;
}

}  // namespace grimaldi
