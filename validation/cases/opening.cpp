#include "validation/cases/opening.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "core/contract.h"
#include "propagation/laws/free_space_diffraction.h"
#include "validation/fraunhofer.h"
#include "validation/rayleigh_sommerfeld.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Point = Aperture::Point;

constexpr double wavenumber = 2 * pi;  // λ = 1
constexpr Complex j{0, 1};

Aperture::Loop polygon(int corners, double radius, double inner, double first) {
  Aperture::Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = first + 2 * pi * i / corners, r = i % 2 == 0 ? radius : inner;
    loop.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return loop;
}

Aperture::Loop box(double x0, double x1, double y0, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// Corner, next corner and `apex` as triangles; the loop is seen whole from the apex.
void add_fan(const Aperture::Loop& loop, const Point& apex, TriangleAperture& triangles) {
  const std::size_t centre = triangles.vertices.size();
  triangles.vertices.push_back({apex.x, apex.y});
  for (const Point& p : loop) triangles.vertices.push_back({p.x, p.y});
  for (std::size_t i = 0; i < loop.size(); ++i)
    triangles.triangles.push_back({centre, centre + 1 + i, centre + 1 + (i + 1) % loop.size()});
}

/// The strip between two loops of as many corners.
void add_ring(const Aperture::Loop& outer, const Aperture::Loop& inner, TriangleAperture& triangles) {
  for (const auto* loop : {&outer, &inner})
    for (const Point& p : *loop) triangles.vertices.push_back({p.x, p.y});
  const std::size_t n = outer.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    triangles.triangles.push_back({i, next, n + i});
    triangles.triangles.push_back({next, n + next, n + i});
  }
}

void finish(Opening& opening) {
  opening.triangles.amplitudes.assign(opening.triangles.vertices.size(), 1.0);
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  opening.shortest = INFINITY;
  for (const Aperture::Loop& loop : opening.aperture.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
      low_x = std::min(low_x, a.x), high_x = std::max(high_x, a.x);
      low_y = std::min(low_y, a.y), high_y = std::max(high_y, a.y);
      opening.shortest = std::min(opening.shortest, std::hypot(b.x - a.x, b.y - a.y));
    }
  opening.wide = high_x - low_x, opening.high = high_y - low_y;
}

Opening of_loops(std::string name, double size, std::vector<Aperture::Loop> loops) {
  Opening result{std::move(name), size, 0, 0, 0, {std::move(loops), {}}, {}};
  for (const Aperture::Loop& loop : result.aperture.loops) {
    Point centre{0, 0};
    for (const Point& p : loop) centre.x += p.x / double(loop.size()), centre.y += p.y / double(loop.size());
    add_fan(loop, centre, result.triangles);
  }
  finish(result);
  return result;
}

double cosine(const Vec3& point) { return point.z / norm(point); }

PlanePoint direction(const Vec3& point) {
  const double r = norm(point);
  return {point.x / r, point.y / r};
}

/// ψ of the BSDF's sign (exp(−iωt), R = 1) as the field at the point.
Complex engineering(const Complex& psi, const Vec3& point) {
  const double r = norm(point);
  return j * std::conj(psi) * std::sqrt(cosine(point)) * std::polar(1 / r, -std::fmod(wavenumber * r, 2 * pi));
}

/// The wave of one edge a → b, the opening on its left.
Complex edge_field(const Point& a, const Point& b, const Vec3& point, EdgeEnds ends) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0)) return 0;
  const double ex = (b.x - a.x) / length, ey = (b.y - a.y) / length;
  const double along = (point.x - a.x) * ex + (point.y - a.y) * ey;
  const double beyond = (point.x - a.x) * ey - (point.y - a.y) * ex;  // > 0: outside the opening, in shadow
  const double s = std::hypot(beyond, point.z), epsilon = std::atan2(beyond, point.z);
  const bool inside_a = along >= 0, inside_b = along <= length;
  Complex weight = inside_a && inside_b ? 1.0 : 0.0;
  if (ends == EdgeEnds::waves) {
    const auto end = [&](double t, bool inside) {
      const double detour = t * t / (std::hypot(s, t) + s);
      return edge_end_wave(detour, 1, wavenumber, inside);
    };
    weight += 0.5 * (end(along, inside_a) + end(length - along, inside_b));
  }
  if (weight == 0.0) return 0;
  // A plane wave: L = s; it meets the edge at right angles with phase 0.
  const Complex wave = edge_wave(fresnel_parameter(s, 1, 1, epsilon), epsilon >= 0);
  return weight * wave * std::polar(1.0, -std::fmod(wavenumber * s, 2 * pi));
}

}  // namespace

const std::vector<std::string>& opening_names() {
  static const std::vector<std::string> names = {"square", "slit", "triangle", "star", "ring", "double-slit", "circle"};
  return names;
}

Opening opening(const std::string& name, double size) {
  const double r = size / 2;
  if (name == "square") return of_loops(name, size, {box(-r, r, -r, r)});
  if (name == "slit") return of_loops(name, size, {box(-r, r, -r / 5, r / 5)});
  if (name == "triangle") return of_loops(name, size, {polygon(3, r, r, pi / 2)});
  if (name == "star") {
    Aperture::Loop tips = polygon(10, r, 0.4 * r, pi / 2);
    return of_loops(name, size, {tips});
  }
  if (name == "circle") return of_loops(name, size, {polygon(96, r, r, pi / 96)});
  if (name == "double-slit")
    return of_loops(name, size, {box(-r, -0.6 * r, -r / 2, r / 2), box(0.6 * r, r, -r / 2, r / 2)});
  GRIMALDI_EXPECT(name == "ring");
  Opening ring{name, size, 0, 0, 0, {}, {}};
  const Aperture::Loop outer = polygon(32, r, r, pi / 32), inner = polygon(32, r / 2, r / 2, pi / 32);
  ring.aperture.loops = {outer, Aperture::Loop(inner.rbegin(), inner.rend())};
  add_ring(outer, inner, ring.triangles);
  finish(ring);
  return ring;
}

double distance_of(double size, double fresnel_number) { return size * size / (4 * fresnel_number); }

Complex true_field(const Opening& opening, const Vec3& point) {
  return rayleigh_sommerfeld(opening.aperture, wavenumber, point);
}

Complex fraunhofer_field(const Opening& opening, const Vec3& point) {
  const double r = norm(point);
  const Complex integral = fraunhofer_integral(opening.aperture, wavenumber * point.x / r, wavenumber * point.y / r);
  return j * integral * std::sqrt(cosine(point)) * std::polar(1 / r, -std::fmod(wavenumber * r, 2 * pi));
}

Complex polygon_field(const Opening& opening, const Vec3& point) {
  return engineering(aperture_field(opening.triangles, wavenumber, direction(point)), point);
}

Complex printed_field(const Opening& opening, const Vec3& point) {
  Complex sum = 0;
  for (const PublishedEdge& edge : boundary_edges(opening.triangles))
    sum += published_edge_wave(wavenumber, edge, direction(point));
  return engineering(sum, point);
}

Complex connected_field(const Opening& opening, const Vec3& point, EdgeEnds ends) {
  Complex field = contains(opening.aperture, {point.x, point.y})
                      ? std::polar(1.0, -std::fmod(wavenumber * point.z, 2 * pi))
                      : Complex(0);
  for (const Aperture::Loop& loop : opening.aperture.loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      field += edge_field(loop[i], loop[(i + 1) % loop.size()], point, ends);
  return field;
}

std::vector<Vec3> observation_points(const Opening& opening, double z, int count) {
  constexpr double tan_60 = 1.7320508075688772, golden = 0.6180339887498949;
  // Slits of a double slit are narrower than the whole; the fringes that count are those of the whole.
  const double wide = std::min(opening.wide / 2 + 3 * z / opening.wide, z * tan_60);
  const double high = std::min(opening.high / 2 + 3 * z / opening.high, z * tan_60);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count, v = i * golden - std::floor(i * golden);
    const Vec3 point{(2 * u - 1) * wide, (2 * v - 1) * high, z};
    if (std::hypot(point.x, point.y) <= z * tan_60) points.push_back(point);
  }
  return points;
}

PatternError pattern_error(const std::vector<double>& intensity, const std::vector<double>& truth) {
  GRIMALDI_EXPECT(intensity.size() == truth.size() && !truth.empty());
  const double floor = 0.01 * *std::max_element(truth.begin(), truth.end());
  std::vector<double> differences;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (truth[i] >= floor) differences.push_back(std::abs(10 * std::log10(intensity[i] / truth[i])));
  std::sort(differences.begin(), differences.end());
  const std::size_t n = differences.size();
  return {differences[n / 2], differences[std::min(n - 1, std::size_t(0.9 * double(n)))], n};
}

}  // namespace grimaldi
