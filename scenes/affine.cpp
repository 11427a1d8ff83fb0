#include "scenes/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grimaldi {

Vec3 Affine::operator()(const Vec3& p) const {
  const auto along = [&](const std::array<double, 4>& r) { return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]; };
  return {along(row[0]), along(row[1]), along(row[2])};
}

double Affine::determinant() const {
  const auto linear = [&](int i) { return Vec3{row[i][0], row[i][1], row[i][2]}; };
  return dot(linear(0), cross(linear(1), linear(2)));
}

Affine then(const Affine& first, const Affine& next) {
  Affine both;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      both.row[i][j] = j == 3 ? next.row[i][3] : 0;
      for (int k = 0; k < 3; ++k) both.row[i][j] += next.row[i][k] * first.row[k][j];
    }
  }
  return both;
}

Affine rotation(const Vec3& u, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), v = 1 - c;
  return {{{{c + u.x * u.x * v, u.x * u.y * v - u.z * s, u.x * u.z * v + u.y * s, 0},
            {u.y * u.x * v + u.z * s, c + u.y * u.y * v, u.y * u.z * v - u.x * s, 0},
            {u.z * u.x * v - u.y * s, u.z * u.y * v + u.x * s, c + u.z * u.z * v, 0}}}};
}

void transform(MeshDescription& mesh, const Affine& map) {
  for (Vec3& vertex : mesh.vertices) vertex = map(vertex);
  if (map.determinant() < 0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
}

std::size_t first_not_finite(const MeshDescription& mesh) {
  const auto bad =
      std::find_if_not(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& v) { return is_finite(v); });
  return static_cast<std::size_t>(bad - mesh.vertices.begin());
}

}  // namespace grimaldi
