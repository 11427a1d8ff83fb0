#include "propagation/lit_edges.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "propagation/fermat.h"

namespace grimaldi {

Vec3 outside_of_edge(const Tracer& tracer, const Wedge& wedge, const Vec3& point) {
  return point + 3 * tracer.surface_gap() * wedge.bisector();
}

LitEdges::LitEdges(const Scene& scene, const Plan& plan, const Transmitter& transmitter, double wavelength, int before,
                   double end_parameter)
    : scene_(scene), faces_(plan.request.reflection), wavelength_(wavelength), end_parameter_(end_parameter) {
  add_lamps(transmitter.position, before);
  double sum = 0;
  for (std::uint32_t l = 0; l < lamps_.size(); ++l)
    for (std::uint32_t w = 0; w < scene_.wedges.wedges.size(); ++w) {
      LitEdge lit{};
      lit.lamp = l;
      lit.wedge = w;
      if (!lights(lamps_[l], scene_.wedges.wedges[w], lit)) continue;
      const double nearest = lit.angle_from > 0 ? lit.radial / std::cos(lit.angle_from)
                             : lit.angle_to < 0 ? lit.radial / std::cos(lit.angle_to)
                                                : lit.radial;
      lit.probability = (lit.angle_to - lit.angle_from) / std::sqrt(nearest);
      lit.cumulative = sum += lit.probability;
      edges_.push_back(lit);
    }
  for (LitEdge& lit : edges_) {
    lit.probability /= sum;
    lit.cumulative /= sum;
  }
}

const LitEdge& LitEdges::choose(double u) const {
  const auto found =
      std::lower_bound(edges_.begin(), edges_.end(), u, [](const LitEdge& a, double x) { return a.cumulative < x; });
  return found == edges_.end() ? edges_.back() : *found;
}

EdgePoint LitEdges::draw_point(const LitEdge& edge, double u) const {
  const double angle = edge.angle_from + u * (edge.angle_to - edge.angle_from);
  EdgePoint drawn;
  drawn.along = edge.axial + edge.radial * std::tan(angle);
  drawn.point = scene_.wedges.wedges[edge.wedge].point(drawn.along);
  drawn.sin_beta = std::cos(angle);
  drawn.s_in = edge.radial / drawn.sin_beta;
  drawn.density = edge.probability * edge.radial / (drawn.s_in * drawn.s_in * (edge.angle_to - edge.angle_from));
  return drawn;
}

void LitEdges::add_lamps(const Vec3& transmitter, int before) {
  lamps_.push_back({transmitter, {}, {transmitter}});
  std::size_t first = 0;
  for (int order = 0; order < before; ++order) {
    const std::size_t last = lamps_.size();
    for (std::size_t l = first; l < last; ++l)
      for (std::uint32_t p = 0; p < scene_.patches.patches.size(); ++p) {
        if (!lamps_[l].patches.empty() && lamps_[l].patches.back() == p) continue;
        Lamp next = lamps_[l];
        next.position = mirrored(next.position, scene_.patches.patches[p]);
        next.patches.push_back(p);
        next.images.push_back(next.position);
        lamps_.push_back(std::move(next));
      }
    first = last;
  }
}

bool LitEdges::lights(const Lamp& lamp, const Wedge& wedge, LitEdge& lit) const {
  if (!lamp.patches.empty()) {
    const std::uint32_t last = lamp.patches.back();
    if (last == wedge.patch0 || last == wedge.patchn) return false;
    // Some of the edge lies before the last mirror: on the side away from the image.
    const Patch& patch = scene_.patches.patches[last];
    const double image = dot(patch.normal, lamp.position) - patch.offset;
    const double ends[2] = {dot(patch.normal, wedge.start) - patch.offset,
                            dot(patch.normal, wedge.end()) - patch.offset};
    if (!(image * ends[0] < 0 || image * ends[1] < 0)) return false;
  }
  const Vec3 way = lamp.position - wedge.start;
  lit.axial = dot(way, wedge.direction);
  const Vec3 across = way - lit.axial * wedge.direction;
  lit.radial = norm(across);
  if (lit.radial < 1e-6) return false;
  constexpr double rounding = 1e-9;  // of a lamp that lies in the plane of a face
  double phi = std::atan2(dot(across, wedge.normal0), dot(across, wedge.along0));
  if (phi < -rounding) phi += 2 * pi;
  if (phi > wedge.exterior_angle + rounding) return false;
  lit.sector = {wedge.exterior_angle, std::clamp(phi, 0.0, wedge.exterior_angle), wedge.free_rim, faces_};
  lit.angle_from = std::atan((-beyond_end(lit.axial, lit.radial) - lit.axial) / lit.radial);
  const double last = wedge.length - lit.axial;
  lit.angle_to = std::atan((last + beyond_end(last, lit.radial)) / lit.radial);
  return true;
}

/// Length beyond an end, `towards` m along the edge from the source's foot to it, up to which v_V is below the
/// parameter for a receiver at any distance: the detour over the end is least for the farthest one, |SV| − |SQ| + a cos
/// β; it grows with a. At most 10 |SV|.
double LitEdges::beyond_end(double towards, double radial) const {
  if (end_parameter_ == 0) return 0;
  const double most = end_parameter_ * end_parameter_ * wavelength_ / 4;
  const double to_end = std::hypot(towards, radial);
  const auto detour = [&](double a) {
    const double s = std::hypot(towards + a, radial);
    return to_end - s + a * (towards + a) / s;
  };
  double low = 0, high = 10 * to_end;
  if (detour(high) < most) return high;
  while (high - low > 1e-3 * high) (detour(0.5 * (low + high)) < most ? low : high) = 0.5 * (low + high);
  return high;
}

}  // namespace grimaldi
