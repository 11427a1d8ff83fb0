#include "propagation/fermat.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/edge_model.h"

namespace grimaldi {
namespace {

/// Two vertices of a path nearer than this are one point: no direction between them.
constexpr double shortest_leg = 1e-6;
/// Between two edges: where they meet, the shortest way over both goes through their corner, and is no path of two.
constexpr double shortest_between = 1e-3;
/// Sine of the angle to an edge below which a ray runs along it.
constexpr double along_edge = 1e-6;
/// Newton's last step, m: convergence is quadratic, so what it leaves is far below a nanometre, and the length errs by
/// its square.
constexpr double last_step = 1e-5;
/// Beyond an end of an edge its wave is kept while v_V is below this (physics: line 6 of the edge's law).
constexpr double end_parameter_limit = 3;

/// Of the shortest way from a to b over a line of unit direction (its two half-planes unfolded), m.
double length_over(const Vec3& start, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const Vec3 pa = a - start, pb = b - start;
  const double za = dot(pa, direction), zb = dot(pb, direction);
  const double ra2 = std::max(0.0, norm2(pa) - za * za), rb2 = std::max(0.0, norm2(pb) - zb * zb);
  return std::sqrt((za - zb) * (za - zb) + ra2 + rb2 + 2 * std::sqrt(ra2 * rb2));
}

/// Bounding boxes only sort out; the ray decides.
bool in_box(const Patch& patch, const Vec3& point) {
  constexpr double slack = 0.01;
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < patch.low[axis] - slack || point[axis] > patch.high[axis] + slack) return false;
  return true;
}

Vec3 mirrored_direction(const Vec3& direction, const Patch& patch) {
  return direction - 2 * dot(direction, patch.normal) * patch.normal;
}

}  // namespace

double crossing(const Vec3& start, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const Vec3 pa = a - start, pb = b - start;
  const double za = dot(pa, direction), zb = dot(pb, direction);
  const double ra = norm(pa - za * direction), rb = norm(pb - zb * direction);
  return ra + rb > 0 ? (za * rb + zb * ra) / (ra + rb) : 0.5 * (za + zb);
}

Vec3 mirrored(const Vec3& point, const Patch& patch) {
  return point - 2 * (dot(point, patch.normal) - patch.offset) * patch.normal;
}

bool crosses_box(const Patch& patch, const Vec3& image, const Vec3& to) {
  const double above = dot(patch.normal, to) - patch.offset, below = dot(patch.normal, image) - patch.offset;
  return above * below < 0 && in_box(patch, to + (above / (above - below)) * (image - to));
}

UnfoldedSequence::UnfoldedSequence(const Scene& scene, const Vec3& source, std::span<const Interaction> interactions,
                                   const SmallObjects* objects)
    : scene_(&scene), objects_(objects), interactions_(interactions), source_(source), image_(source) {
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
        edge.normaln = mirrored_direction(edge.normaln, patch);
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
    edges_[edge_count_++] = {index_of(here), i, wedge.start, wedge.direction, wedge.along0, wedge.normal0,
                             wedge.normaln()};
  }
}

void UnfoldedSequence::look_from(double along1, double along2) {
  const UnfoldedEdge &first = edges_[0], &second = edges_[1];
  pair_.from1 = along1;
  pair_.from2 = along2;
  const Vec3 on_first = first.point(along1);
  const Vec3 between = second.point(along2) - on_first, source_way = image_ - on_first;
  pair_.cosine = dot(first.direction, second.direction);
  pair_.offset1 = dot(between, first.direction);
  pair_.offset2 = dot(between, second.direction);
  pair_.apart2 = norm2(between);
  pair_.source_along = dot(source_way, first.direction);
  pair_.source_off = norm(source_way - pair_.source_along * first.direction);
  last_ = {};
  has_last_ = true;
}

void UnfoldedSequence::begin_at(std::span<const double> along) {
  if (edge_count_ == 2) {
    look_from(along[0], along[1]);
  } else {
    std::copy(along.begin(), along.end(), last_.begin());
    has_last_ = true;
  }
}

bool UnfoldedSequence::two_fermat_points(const Vec3& receiver, double& along1, double& along2) {
  if (has_last_ && descend(receiver, along1, along2)) return true;
  // Each edge for itself between the ends, from the source on; where that falls into the corner of two edges that meet,
  // from the receiver on.
  const auto between = [&](std::size_t edge, const Vec3& a, const Vec3& b) {
    return crossing(edges_[edge].start, edges_[edge].direction, a, b);
  };
  const double first = between(0, image_, receiver);
  look_from(first, between(1, edges_[0].point(first), receiver));
  if (descend(receiver, along1, along2)) return true;
  const double last = between(1, image_, receiver);
  look_from(between(0, image_, edges_[1].point(last)), last);
  return has_last_ = descend(receiver, along1, along2);
}

bool UnfoldedSequence::descend(const Vec3& receiver, double& along1, double& along2) {
  const UnfoldedEdge& second = edges_[1];
  const Vec3 way = receiver - second.point(pair_.from2);
  const double z1 = pair_.source_along, r1 = pair_.source_off;
  const double z2 = dot(way, second.direction), r2 = norm(way - z2 * second.direction);
  const double c = pair_.cosine;
  struct Legs {
    double in, middle, out;
    double sum() const { return in + middle + out; }
  };
  const auto legs_at = [&](double t1, double t2) {
    const double middle2 =
        pair_.apart2 + t1 * t1 + t2 * t2 - 2 * c * t1 * t2 + 2 * (pair_.offset2 * t2 - pair_.offset1 * t1);
    return Legs{std::sqrt(r1 * r1 + (t1 - z1) * (t1 - z1)), std::sqrt(std::max(0.0, middle2)),
                std::sqrt(r2 * r2 + (t2 - z2) * (t2 - z2))};
  };
  double t1 = last_[0], t2 = last_[1];
  Legs legs = legs_at(t1, t2);
  for (int iteration = 0; iteration < 60; ++iteration) {
    if (legs.in < shortest_leg || legs.middle < shortest_leg || legs.out < shortest_leg) return false;
    const double inverse = 1 / legs.middle;
    const double a = (t1 - z1) / legs.in, d = (t2 - z2) / legs.out;
    const double b1 = (t1 - c * t2 - pair_.offset1) * inverse, b2 = (t2 - c * t1 + pair_.offset2) * inverse;
    const double g1 = a + b1, g2 = b2 + d;
    const double h11 = (1 - a * a) / legs.in + (1 - b1 * b1) * inverse;
    const double h22 = (1 - b2 * b2) * inverse + (1 - d * d) / legs.out;
    const double h12 = (-c - b1 * b2) * inverse;
    const double determinant = h11 * h22 - h12 * h12;
    // Positive definite unless the path runs along an edge.
    if (!(h11 > 0) || !(determinant > 1e-12 * h11 * h22)) return false;
    const double step1 = (h12 * g2 - h22 * g1) / determinant, step2 = (h12 * g1 - h11 * g2) / determinant;
    // Beside a corner where the edges meet, small against the way between them too.
    if (std::max(std::abs(step1), std::abs(step2)) < last_step * std::min(1.0, legs.middle)) {
      last_[0] = t1 + step1;
      last_[1] = t2 + step2;
      along1 = pair_.from1 + last_[0];
      along2 = pair_.from2 + last_[1];
      has_last_ = true;
      return true;
    }
    // A full Newton step, halved while it does not shorten the way.
    double share = 1;
    Legs next = legs_at(t1 + step1, t2 + step2);
    while (next.sum() > legs.sum() && share > 1e-9) {
      share *= 0.5;
      next = legs_at(t1 + share * step1, t2 + share * step2);
    }
    if (next.sum() > legs.sum()) return false;
    t1 += share * step1;
    t2 += share * step2;
    legs = next;
  }
  return false;
}

bool UnfoldedSequence::fermat_points(const Vec3& receiver, std::array<double, max_edges>& along) {
  if (edge_count_ == 1) {
    along[0] = crossing(edges_[0].start, edges_[0].direction, image_, receiver);
    return true;
  }
  if (edge_count_ == 2) return two_fermat_points(receiver, along[0], along[1]);
  // Start: each edge for itself between the ends, then Newton on the convex length with a tridiagonal Hessian.
  for (std::size_t i = 0; i < edge_count_; ++i) {
    if (has_last_) {
      along = last_;
      break;
    }
    const Vec3 before = i == 0 ? image_ : edges_[i - 1].point(along[i - 1]);
    along[i] = crossing(edges_[i].start, edges_[i].direction, before, receiver);
  }
  struct Way {
    std::array<Vec3, max_edges + 2> vertex;
    std::array<double, max_edges + 1> leg;
    double length = 0;
  };
  const auto walk = [&](const std::array<double, max_edges>& t, Way& way) {
    way.length = 0;
    for (std::size_t i = 0; i < edge_count_; ++i) way.vertex[i + 1] = edges_[i].point(t[i]);
    for (std::size_t i = 0; i <= edge_count_; ++i)
      way.length += way.leg[i] = distance(way.vertex[i], way.vertex[i + 1]);
  };
  Way way, shorter;
  way.vertex[0] = shorter.vertex[0] = image_;
  way.vertex[edge_count_ + 1] = shorter.vertex[edge_count_ + 1] = receiver;
  walk(along, way);
  for (int iteration = 0; iteration < 60; ++iteration) {
    std::array<double, max_edges> gradient{}, diagonal{}, upper{};
    for (std::size_t leg = 0; leg <= edge_count_; ++leg) {
      const double s = way.leg[leg];
      if (s < shortest_leg) return false;
      const double inverse = 1 / s;
      const Vec3 u = inverse * (way.vertex[leg + 1] - way.vertex[leg]);
      const double a = leg > 0 ? dot(u, edges_[leg - 1].direction) : 0;
      const double b = leg < edge_count_ ? dot(u, edges_[leg].direction) : 0;
      if (leg > 0) {
        gradient[leg - 1] -= a;
        diagonal[leg - 1] += (1 - a * a) * inverse;
      }
      if (leg < edge_count_) {
        gradient[leg] += b;
        diagonal[leg] += (1 - b * b) * inverse;
      }
      if (leg > 0 && leg < edge_count_)
        upper[leg - 1] = (a * b - dot(edges_[leg - 1].direction, edges_[leg].direction)) * inverse;
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
    for (double share = 1; share > 1e-9; share *= 0.5) {
      for (std::size_t i = 0; i < edge_count_; ++i) next[i] = along[i] + share * step[i];
      walk(next, shorter);
      if (shorter.length <= way.length) break;
    }
    if (shorter.length > way.length) return false;
    along = next;
    way = shorter;
  }
  return false;
}

bool UnfoldedSequence::passage(std::size_t i, std::span<const Vec3> way, double along, double wavelength,
                               EdgePassage& out) const {
  const UnfoldedEdge& edge = edges_[i];
  const Wedge& wedge = scene_->wedges.wedges[edge.wedge];
  const Vec3 &before = way[i], &q = way[i + 1], &after = way[i + 2];
  const Vec3 in = before - q, away = after - q;
  out.wedge = edge.wedge;
  out.along = along;
  out.s_in = norm(in);
  out.s_out = norm(away);
  const double shortest_in = i > 0 ? shortest_between : shortest_leg;
  const double shortest_out = i + 1 < edge_count_ ? shortest_between : shortest_leg;
  if (out.s_in < shortest_in || out.s_out < shortest_out) return false;
  const double cos_beta = dot(in, edge.direction) / out.s_in;
  out.sin_beta = std::sqrt(std::max(0.0, 1 - cos_beta * cos_beta));
  if (out.sin_beta < along_edge) return false;
  // Rounding may put an end that lies on face 0 a hair below it.
  constexpr double rounding = 1e-9;
  for (const Vec3* leg : {&in, &away}) {
    const double hair = -10 * rounding * (std::abs(leg->x) + std::abs(leg->y) + std::abs(leg->z));
    if (dot(*leg, edge.normal0) < hair && dot(*leg, edge.normaln) < hair) return false;
  }
  out.inside = along >= 0 && along <= wedge.length;
  const Vec3 ends[2] = {edge.start, edge.point(wedge.length)};
  // The points on the neighbouring edges move with the end.
  const auto longer = [&](const Vec3& end, std::size_t neighbour, const Vec3& vertex, const Vec3* beyond, double leg) {
    if (beyond == nullptr) return distance(end, vertex) - leg;
    const UnfoldedEdge& next = edges_[neighbour];
    return length_over(next.start, next.direction, end, *beyond) - leg - distance(vertex, *beyond);
  };
  const auto detour = [&](const Vec3& end) {
    return std::max(0.0, longer(end, i - 1, before, i > 0 ? &way[i - 1] : nullptr, out.s_in) +
                             longer(end, i + 1, after, i + 1 < edge_count_ ? &way[i + 3] : nullptr, out.s_out));
  };
  out.detour_start = detour(ends[0]);
  out.detour_end = detour(ends[1]);
  if (!out.inside && (along < 0 ? wedge.stands_at_start : wedge.stands_at_end)) return false;
  if (!out.inside &&
      2 * std::sqrt((along < 0 ? out.detour_start : out.detour_end) / wavelength) >= end_parameter_limit) {
    const Vec3& end = ends[along < 0 ? 0 : 1];
    if (objects_ == nullptr || edge_count_ != 1 ||
        !shines_through(*objects_, edge.wedge, distance(before, end), distance(end, after), wavelength))
      return false;
  }
  for (auto [leg, phi] : {std::pair{&in, &out.phi_in}, std::pair{&away, &out.phi_out}}) {
    *phi = std::atan2(dot(*leg, edge.normal0), dot(*leg, edge.along0));
    if (*phi < -rounding) *phi += 2 * pi;
    if (*phi > wedge.exterior_angle + rounding) return false;
    *phi = std::clamp(*phi, 0.0, wedge.exterior_angle);
  }
  return true;
}

bool UnfoldedSequence::mirror_points(std::size_t first, std::size_t last, PathGeometry& geometry,
                                     bool in_planes) const {
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
    if (!in_planes && !in_box(patch, point)) return false;
    geometry.points[i + 1] = to = point;
  }
  return true;
}

bool UnfoldedSequence::solve(const Vec3& receiver, double wavelength, PathGeometry& geometry, bool in_planes) {
  if (!possible_) return false;
  const std::size_t n = interactions_.size();
  geometry.count = n + 2;
  geometry.edge_count = edge_count_;
  geometry.points[0] = source_;
  geometry.points[n + 1] = receiver;
  if (edge_count_ == 0) {
    geometry.length = distance(image_, receiver);
    return geometry.length > shortest_leg && mirror_points(0, n, geometry, in_planes);
  }
  std::array<double, max_edges> along{};
  if (!fermat_points(receiver, along)) return false;
  geometry.length = 0;
  std::array<Vec3, max_edges + 2> way;
  way[0] = image_;
  for (std::size_t i = 0; i < edge_count_; ++i) way[i + 1] = edges_[i].point(along[i]);
  way[edge_count_ + 1] = receiver;
  for (std::size_t i = 0; i < edge_count_; ++i) {
    EdgePassage& passed = geometry.edges[i];
    if (!passage(i, way, along[i], wavelength, passed)) return false;
    const Wedge& wedge = scene_->wedges.wedges[passed.wedge];
    const double seen = std::clamp(along[i], 0.0, wedge.length);
    geometry.points[edges_[i].position + 1] = wedge.point(seen);
    geometry.length += passed.s_in;
    if (i + 1 == edge_count_) geometry.length += passed.s_out;
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i <= edge_count_; ++i) {
    const std::size_t last = i < edge_count_ ? edges_[i].position : n;
    if (last > first && !mirror_points(first, last, geometry, in_planes)) return false;
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
      const Vec3 leg = geometry.points[next] - geometry.points[here];
      if (norm2(cross(direction, leg)) < along_edge * along_edge * norm2(leg)) return false;
    }
  }
  return true;
}

}  // namespace grimaldi
