#include "propagation/edge_shadow.h"

#include <algorithm>
#include <cmath>

namespace grimaldi {

EdgeShadow::EdgeShadow(const Wedge& wedge, const Vec3& eye, double gap) : eye_(eye) {
  const Vec3 way = eye - wedge.start;
  inside_ = dot(way, wedge.normal0) < -gap && dot(way, wedge.normaln()) < -gap;
  start_ = wedge.start + 3 * gap * wedge.bisector() - eye;
  end_ = start_ + wedge.length * wedge.direction;
  normal_ = cross(start_, end_);
  size_ = norm2(normal_);
  end_on_ = std::sqrt(size_) < gap * wedge.length;
  if (!end_on_) near_ = std::min(0.5, 4 * gap * wedge.length / std::sqrt(size_));
}

void EdgeShadow::add(const Scene& scene, std::size_t triangle) {
  Vec3 corner[3];
  double side[3];
  for (std::size_t i = 0; i < 3; ++i) {
    corner[i] = scene.vertices[scene.triangles[triangle][i]] - eye_;
    side[i] = dot(normal_, corner[i]);
  }
  if ((side[0] > 0) == (side[1] > 0) && (side[1] > 0) == (side[2] > 0)) return;
  double alpha[2], beta[2];
  for (std::size_t i = 0, found = 0; i < 3 && found < 2; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((side[i] > 0) == (side[j] > 0)) continue;
    const Vec3 cut = corner[i] + (side[i] / (side[i] - side[j])) * (corner[j] - corner[i]);
    alpha[found] = dot(cross(cut, end_), normal_) / size_;
    beta[found++] = dot(cross(start_, cut), normal_) / size_;
  }
  double from = 0, to = 1;                         // along the cut
  const auto keep = [&](double at0, double at1) {  // where a linear function is ≥ 0
    if (at0 < 0 && at1 < 0) to = -1;
    if (at0 < 0 && at1 >= 0) from = std::max(from, at0 / (at0 - at1));
    if (at0 >= 0 && at1 < 0) to = std::min(to, at0 / (at0 - at1));
  };
  const double first = alpha[0] + beta[0], last = alpha[1] + beta[1];
  keep(first - near_, last - near_);
  keep(1 - near_ - first, 1 - near_ - last);
  if (!(from < to)) return;
  const auto share = [&](double t) { return (beta[0] + t * (beta[1] - beta[0])) / (first + t * (last - first)); };
  add_dark(std::min(share(from), share(to)), std::max(share(from), share(to)));
}

bool EdgeShadow::is_dark(double share) const {
  for (const auto& [from, to] : dark_)
    if (share >= from && share <= to) return true;
  return false;
}

void EdgeShadow::add_dark(double from, double to) {
  constexpr double crack = 1e-12;  // two triangles of one wall leave none but by rounding
  const auto first =
      std::find_if(dark_.begin(), dark_.end(), [&](const auto& part) { return part.second >= from - crack; });
  auto last = first;
  for (; last != dark_.end() && last->first <= to + crack; ++last) {
    from = std::min(from, last->first);
    to = std::max(to, last->second);
  }
  dark_.insert(dark_.erase(first, last), {from, to});
}

}  // namespace grimaldi
