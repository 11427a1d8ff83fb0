#include "scenes/demo_city.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace grimaldi {
namespace {

// The grid: blocks between these lines, A … F and 1 … 6. What lies between them is street; C|D|E and 2|3|4 leave the
// square.
constexpr std::array<std::array<double, 2>, 6> columns{
    {{-294, -218}, {-204, -130}, {-114, -40}, {-26, 26}, {40, 152}, {170, 294}}};
constexpr std::array<std::array<double, 2>, 6> rows{
    {{-294, -176}, {-160, -40}, {-26, 26}, {40, 110}, {132, 206}, {220, 294}}};

constexpr double wing = 13;    // depth of a building round a courtyard, m
constexpr double passage = 6;  // way into a courtyard, m
constexpr double bar = 12;     // depth of a gabled row of houses, m

/// A plot seen from one of its sides: u runs along that side, v away from it into the plot, both from 0.
struct Plot {
  std::string block;  ///< "B5"
  double x0, y0, x1, y1;
  int side = 0;  ///< the side at v = 0: 0 south, 1 east, 2 north, 3 west

  double along() const { return side % 2 ? y1 - y0 : x1 - x0; }
  double across() const { return side % 2 ? x1 - x0 : y1 - y0; }
  PlanPoint at(double u, double v) const {
    switch (side) {
      case 0:
        return {x0 + u, y0 + v};
      case 1:
        return {x1 - v, y0 + u};
      case 2:
        return {x1 - u, y1 - v};
      default:
        return {x0 + v, y1 - u};
    }
  }
  std::vector<PlanPoint> polygon(const std::vector<PlanPoint>& uv) const {
    std::vector<PlanPoint> result;
    for (const PlanPoint& p : uv) result.push_back(at(p.x, p.y));
    return result;
  }
  std::vector<PlanPoint> rectangle(double u0, double v0, double u1, double v1) const {
    return polygon({{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}});
  }
};

Plot plot(char column, int row, int side = 0) {
  const auto& x = columns.at(static_cast<std::size_t>(column - 'A'));
  const auto& y = rows.at(static_cast<std::size_t>(row - 1));
  return {column + std::to_string(row), x[0], y[0], x[1], y[1], side};
}

/// The part of a plot between two fractions of its width (x) and of its depth (y), `gap` m apart from the other parts.
Plot part(Plot p, int column, int columns_in_all, int row, int rows_in_all, int side, double gap = 7) {
  const double width = (p.x1 - p.x0 - gap * (columns_in_all - 1)) / columns_in_all;
  const double depth = (p.y1 - p.y0 - gap * (rows_in_all - 1)) / rows_in_all;
  const double x = p.x0 + column * (width + gap), y = p.y0 + row * (depth + gap);
  return {p.block, x, y, x + width, y + depth, side};
}

/// 32 well mixed bits of a small number. Source: C. Wellons, "Prospecting for hash functions" (2018), lowbias32.
std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// The part of a convex polygon where a x + b y ≤ c (Sutherland and Hodgman 1974).
std::vector<PlanPoint> clipped(const std::vector<PlanPoint>& polygon, double a, double b, double c) {
  std::vector<PlanPoint> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = a * p.x + b * p.y - c, at_q = a * q.x + b * q.y - c;
    if (at_p <= 0) result.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      const double t = at_p / (at_p - at_q);
      result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return result;
}

/// A convex polygon moved inward by `depth` m on every side; empty if a side would become shorter than 6 m.
std::vector<PlanPoint> inset(const std::vector<PlanPoint>& outline, double depth) {
  const std::size_t n = outline.size();
  std::vector<PlanPoint> along(n), result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PlanPoint &p = outline[i], &q = outline[(i + 1) % n];
    const double length = std::sqrt((q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y));
    along[i] = {(q.x - p.x) / length, (q.y - p.y) / length};
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PlanPoint &s = along[(i + n - 1) % n], &t = along[i];
    const double stretch = depth / (1 + s.x * t.x + s.y * t.y);  // the inward normals are (−s.y, s.x), (−t.y, t.x)
    result[i] = {outline[i].x - stretch * (s.y + t.y), outline[i].y + stretch * (s.x + t.x)};
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PlanPoint &p = result[i], &q = result[(i + 1) % n];
    if ((q.x - p.x) * along[i].x + (q.y - p.y) * along[i].y < 6) return {};
  }
  return result;
}

/// Collects the buildings, and gives each what follows from its number and place: height, materials, name.
class Quarter {
 public:
  std::vector<Building> take() { return std::move(buildings_); }

  /// A building of that outline. Height by its number and distance from the square, unless given.
  Building& add(const Plot& p, std::vector<PlanPoint> outline, std::vector<PlanPoint> courtyard = {},
                std::optional<double> height = {}) {
    const std::uint32_t hash = mixed(static_cast<std::uint32_t>(buildings_.size()) + 1);
    const double x = (p.x0 + p.x1) / 2, y = (p.y0 + p.y1) / 2, far2 = x * x + y * y;
    const int lowest = far2 < 150.0 * 150 ? 5 : far2 < 260.0 * 260 ? 3 : 2;
    const int landmark = outline.size() <= 8 && courtyard.empty() && hash / 64 % 7 == 0 ? 4 : 0;
    const int floors = lowest + static_cast<int>(hash % 5) + landmark;
    Building building;
    building.outline = std::move(outline);
    building.courtyard = std::move(courtyard);
    building.height = height ? *height : 2 + 3.0 * floors;
    building.wall_material = landmark ? "glass" : hash / 8 % 8 < 5 ? "brick" : "concrete";
    building.roof_material = hash / 32 % 2 ? "metal" : "concrete";
    number_ = p.block == block_ ? number_ + 1 : 1;
    block_ = p.block;
    building.name = block_ + " " + std::to_string(number_);
    buildings_.push_back(std::move(building));
    return buildings_.back();
  }

  /// Round a courtyard without a way in (or solid where there is no room for one), cut by the avenue.
  void ring(const Plot& p) {
    const std::vector<PlanPoint> whole = p.rectangle(0, 0, p.along(), p.across());
    for (const double side : {1.0, -1.0}) {
      std::vector<PlanPoint> piece = clipped(whole, -3 * side, 4 * side, -60);
      if (piece.size() >= 3) add(p, piece, inset(piece, wing));
    }
  }

  /// The whole plot as one solid, cut by the avenue.
  void solid(const Plot& p, std::optional<double> height = {}) {
    const std::vector<PlanPoint> whole = p.rectangle(0, 0, p.along(), p.across());
    for (const double side : {1.0, -1.0}) {
      const std::vector<PlanPoint> piece = clipped(whole, -3 * side, 4 * side, -60);
      if (piece.size() >= 3) add(p, piece, {}, height);
    }
  }

  /// Round a courtyard with a passage through the middle of its side.
  void gate(const Plot& p) {
    const double w = p.along(), d = p.across(), a = (w - passage) / 2, b = (w + passage) / 2;
    add(p, p.polygon({{0, 0},
                      {a, 0},
                      {a, wing},
                      {wing, wing},
                      {wing, d - wing},
                      {w - wing, d - wing},
                      {w - wing, wing},
                      {b, wing},
                      {b, 0},
                      {w, 0},
                      {w, d},
                      {0, d}}));
  }

  /// Three wings, open to the side.
  Building& u_shape(const Plot& p, double depth = wing) {
    const double w = p.along(), d = p.across();
    return add(
        p,
        p.polygon(
            {{0, 0}, {depth, 0}, {depth, d - depth}, {w - depth, d - depth}, {w - depth, 0}, {w, 0}, {w, d}, {0, d}}));
  }

  /// Two L-shapes round a courtyard with two passages at opposite corners.
  void l_shapes(const Plot& p) {
    const double w = p.along(), d = p.across(), a = w - wing - passage, b = d - wing - passage;
    add(p, p.polygon({{0, 0}, {a, 0}, {a, wing}, {wing, wing}, {wing, b}, {0, b}}));
    add(p, p.polygon({{w, d}, {0, d}, {0, d - wing}, {w - wing, d - wing}, {w - wing, 0}, {w, 0}}));
  }

  /// `count` parallel rows of houses along the side, gabled, spread over the plot.
  void gabled(const Plot& p, int count) {
    const double pitch = count > 1 ? (p.across() - bar) / (count - 1) : 0;
    for (int i = 0; i < count; ++i) {
      Building& row = add(p, p.rectangle(0, i * pitch, p.along(), i * pitch + bar));
      row.height = 8 + 3.0 * (mixed(static_cast<std::uint32_t>(buildings_.size())) % 2);
      row.rise = 5;
      row.wall_material = "brick";
      row.roof_material = "metal";
    }
  }

 private:
  std::vector<Building> buildings_;
  std::string block_;
  int number_ = 0;
};

/// West of the square.
void build_west(Quarter& city) {
  city.ring(plot('A', 1));
  city.ring(part(plot('A', 2), 0, 1, 0, 2, 0));
  city.u_shape(part(plot('A', 2), 0, 1, 1, 2, 1));
  city.ring(plot('A', 3));
  city.l_shapes(plot('A', 4));
  city.gabled(plot('A', 5), 3);
  city.gabled(plot('A', 6, 1), 3);
  city.l_shapes(plot('B', 1));
  city.ring(plot('B', 2));
  city.u_shape(plot('B', 3, 3));
  city.ring(plot('B', 4));
  city.u_shape(plot('B', 5, 1));
  const Plot yard{"B5", -196, 155, -152, 183, 1};
  Building& workshop = city.add(yard, yard.rectangle(8, 0, 20, 36), {}, 8);
  workshop.wall_material = "wood";
  workshop.roof_material = "metal";
  city.ring(plot('B', 6));
  city.gate(plot('C', 1, 2));
  city.ring({"C2", -114, -160, -40, -108, 0});
  city.ring({"C2", -114, -98, -40, -40, 0});
  city.solid({"C3", -114, -26, -82, 26, 0});
  city.solid({"C3", -74, -26, -40, 26, 0}, 23);
  city.gate(plot('C', 4, 1));
  city.ring(plot('C', 5));
  city.l_shapes(plot('C', 6, 1));
}

/// North and south of the square.
void build_middle(Quarter& city) {
  city.gate(plot('D', 1));
  city.gate(part(plot('D', 2), 0, 1, 1, 2, 2));
  city.ring(part(plot('D', 2), 0, 1, 0, 2, 0));
  Building& town_hall = city.u_shape({"D4", -26, 40, 26, 74, 0}, 12);
  town_hall.height = 20;
  town_hall.wall_material = "marble";
  const Plot behind{"D4", -26, 84, 26, 110, 0};
  Building& hall = city.add(behind, behind.rectangle(0, 0, 52, 26), {}, 14);
  hall.rise = 9;
  hall.wall_material = "marble";
  hall.roof_material = "metal";
  city.ring(plot('D', 5));
  city.solid(part(plot('D', 6), 0, 2, 0, 1, 0, 16));
  city.solid(part(plot('D', 6), 1, 2, 0, 1, 0, 16));
}

/// East of the square.
void build_east(Quarter& city) {
  city.gabled(part(plot('E', 1), 0, 2, 0, 1, 1, 14), 2);
  city.gate(part(plot('E', 1), 1, 2, 0, 1, 0, 14));
  const Plot corner{"E2", 44, -76, 76, -44, 0};
  Building& tower = city.add(
      corner, corner.polygon({{9, 0}, {23, 0}, {32, 9}, {32, 23}, {23, 32}, {9, 32}, {0, 23}, {0, 9}}), {}, 90);
  tower.wall_material = "glass";
  tower.roof_material = "concrete";
  city.l_shapes({"E2", 40, -160, 152, -92, 0});
  city.u_shape({"E2", 90, -82, 152, -40, 3});
  city.solid({"E3", 40, -26, 86, 26, 0});
  city.u_shape({"E3", 94, -26, 152, 26, 3});
  city.ring(plot('E', 4));
  city.gate(part(plot('E', 5), 0, 2, 0, 1, 3));
  city.u_shape(part(plot('E', 5), 1, 2, 0, 1, 1));
  city.l_shapes(plot('E', 6));
  for (const int row : {1, 2}) {  // the street canyon, x 228 … 240
    const Plot whole = plot('F', row);
    const double y0 = whole.y0, y1 = whole.y1;
    city.gabled({whole.block, 170, y0, 204, y1, 1}, 1);
    city.add(whole, Plot{whole.block, 214, y0, 228, y1, 0}.rectangle(0, 0, 14, y1 - y0), {}, 25).wall_material =
        "brick";
    city.add(whole, Plot{whole.block, 240, y0, 254, y1, 0}.rectangle(0, 0, 14, y1 - y0), {}, 25).wall_material =
        "brick";
    city.u_shape({whole.block, 264, y0, 294, y1, 3}, 10);
  }
  city.gate(plot('F', 3, 2));
  city.l_shapes(plot('F', 4));
  city.ring(plot('F', 5));
  city.u_shape(part(plot('F', 6), 0, 2, 0, 1, 0));
  city.ring(part(plot('F', 6), 1, 2, 0, 1, 0));
}

}  // namespace

std::vector<Building> demo_city_buildings() {
  Quarter city;
  build_west(city);
  build_middle(city);
  build_east(city);
  return city.take();
}

SceneDescription demo_city() {
  SceneDescription scene;
  scene.name = "demo-city";
  scene.meshes.push_back(ground_sheet({-350, -350}, {350, 350}, "concrete"));
  scene.meshes.back().file = scene.name;
  for (const Building& building : demo_city_buildings()) append_building(building, scene);
  return scene;
}

}  // namespace grimaldi
