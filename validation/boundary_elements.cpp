#include "validation/boundary_elements.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/constants.h"
#include "core/contract.h"
#include "validation/hankel.h"
#include "validation/quadrature.h"

namespace grimaldi {
namespace {

using Complex = std::complex<double>;
using Point = PolygonBody::Point;

constexpr int order = 8;           ///< nodes of a panel
constexpr double step = 0.25;      ///< length of a panel over that of the next one away from the corner
constexpr double tail = 6;         ///< wavelengths of an endless side beyond its real part
constexpr double tail_panel = .5;  ///< longest panel there, wavelengths: the phase runs faster
constexpr double far = 0.6;        ///< lengths of a panel from which on its own nodes do
constexpr Complex out_of_real{1, -1};
constexpr std::size_t no_side = ~std::size_t(0);

/// A point of an outline, perhaps off the real axis.
struct Place {
  Complex x, y;
};

/// A straight piece of an outline: middle + half t, −1 ≤ t ≤ 1.
struct Panel {
  Place middle, half;
  Point normal;  ///< out of the body
  std::size_t side;
  double half_length() const { return std::sqrt(std::norm(half.x) + std::norm(half.y)); }
  /// ds/dt: the tangent is the normal turned, of length 1.
  Complex speed() const { return half.y * normal.x - half.x * normal.y; }
  Place at(double t) const { return {middle.x + half.x * t, middle.y + half.y * t}; }
};

/// Value of the n-th Lagrange polynomial over the nodes of a panel, for all n.
std::array<double, order> lagrange(double t) {
  const auto& nodes = gauss_legendre(order);
  std::array<double, order> value;
  for (std::size_t n = 0; n < order; ++n) {
    value[n] = 1;
    for (std::size_t m = 0; m < order; ++m)
      if (m != n) value[n] *= (t - nodes[m].x) / (nodes[n].x - nodes[m].x);
  }
  return value;
}

/// What one point of a panel gives to one point of the plane, for the unknown of either condition.
struct Kernel {
  Complex soft;  ///< G, or ∂G/∂n of the receiving point
  Complex hard;  ///< ∂G/∂n'
};

/// A point that receives: in the plane, or on an outline with its normal.
struct Target {
  Place place;
  const Point* normal = nullptr;
};

Kernel kernel(double k, const Target& to, const Place& from, const Point& normal_from) {
  const Complex x = to.place.x - from.x, y = to.place.y - from.y, r = std::sqrt(x * x + y * y);
  const HankelPair h = hankel2_pair(k * r);
  const Complex slope = Complex(0, 0.25 * k) * h.one / r;
  return {to.normal ? slope * (x * to.normal->x + y * to.normal->y) : Complex(0, -0.25) * h.zero,
          -slope * (x * normal_from.x + y * normal_from.y)};
}

/// Integrals over all outlines as rows over the nodes.
struct Rows {
  std::vector<Complex> soft, hard;
};

/// ∫ kernel × (Lagrange polynomial n) ds over [from, to] of the panel, added to the rows from `first` on.
void add_integral(double k, const Target& target, const Panel& panel, double from, double to, int depth,
                  std::size_t first, Rows& rows) {
  const double centre = 0.5 * (from + to), half = 0.5 * (to - from);
  const Place middle = panel.at(centre);
  const double apart = std::sqrt(std::norm(target.place.x - middle.x) + std::norm(target.place.y - middle.y));
  const double length = 2 * half * panel.half_length();
  if (apart < (far + 0.5) * length && depth < 60) {
    add_integral(k, target, panel, from, centre, depth + 1, first, rows);
    add_integral(k, target, panel, centre, to, depth + 1, first, rows);
    return;
  }
  const auto& nodes = gauss_legendre(order);
  for (std::size_t i = 0; i < order; ++i) {
    const double t = centre + half * nodes[i].x;
    const Kernel value = kernel(k, target, panel.at(t), panel.normal);
    const Complex weight = nodes[i].weight * half * panel.speed();
    if (depth == 0) {
      rows.soft[first + i] += weight * value.soft, rows.hard[first + i] += weight * value.hard;
      continue;
    }
    const auto shares = lagrange(t);
    for (std::size_t n = 0; n < order; ++n) {
      rows.soft[first + n] += weight * value.soft * shares[n];
      rows.hard[first + n] += weight * value.hard * shares[n];
    }
  }
}

/// Fractions of a side at which it is cut: equal panels, those at corners once more and again.
std::vector<double> cuts(double length, double longest, bool corner_first, bool corner_last, int levels) {
  const int equal =
      std::max(levels > 0 && corner_first && corner_last ? 2 : 1, static_cast<int>(std::ceil(length / longest)));
  std::vector<double> at;
  for (int i = 0; i <= equal; ++i) at.push_back(double(i) / equal);
  for (int level = 1; level <= levels; ++level) {
    const double near = std::pow(step, level) / equal;
    if (corner_first) at.push_back(near);
    if (corner_last) at.push_back(1 - near);
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// The outline of a body as panels; sides are numbered on from `side`.
void append_panels(const PolygonBody& body, double wavelength, const BoundaryMesh& mesh, std::size_t& side,
                   std::vector<Panel>& panels) {
  const auto append_side = [&](const Place& a, const Place& b, const Point& direction, const std::vector<double>& at) {
    for (std::size_t i = 1; i < at.size(); ++i) {
      const double m = 0.5 * (at[i] + at[i - 1]), h = 0.5 * (at[i] - at[i - 1]);
      const Complex dx = b.x - a.x, dy = b.y - a.y;
      panels.push_back({{a.x + dx * m, a.y + dy * m}, {dx * h, dy * h}, {direction.y, -direction.x}, side});
    }
  };
  // An endless side from its corner outwards; `inwards`: the outline comes along it.
  const auto append_endless = [&](const Point& corner, const Point& away, bool inwards) {
    const double reach = mesh.reach * wavelength, beyond = tail * wavelength;
    const Place near{corner.x, corner.y}, joint{corner.x + away.x * reach, corner.y + away.y * reach};
    const Place end{joint.x + away.x * beyond * out_of_real, joint.y + away.y * beyond * out_of_real};
    const Point along = inwards ? Point{-away.x, -away.y} : away;
    const auto real = cuts(reach, mesh.panel * wavelength, !inwards, inwards, mesh.levels);
    const auto complex = cuts(beyond, tail_panel * wavelength, false, false, 0);
    if (inwards) {
      append_side(end, joint, along, complex);
      append_side(joint, near, along, real);
    } else {
      append_side(near, joint, along, real);
      append_side(joint, end, along, complex);
    }
    ++side;
  };
  const std::size_t count = body.corners.size();
  if (body.endless) append_endless(body.corners.front(), body.first, true);
  for (std::size_t i = 0; i + (body.endless ? 1 : 0) < count; ++i, ++side) {
    const Point &a = body.corners[i], &b = body.corners[(i + 1) % count];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    append_side({a.x, a.y}, {b.x, b.y}, {(b.x - a.x) / length, (b.y - a.y) / length},
                cuts(length, mesh.panel * wavelength, true, true, mesh.levels));
  }
  if (body.endless) append_endless(body.corners.back(), body.last, false);
}

/// The body as a closed polygon, endless sides cut off at `reach`.
std::vector<Point> closed_outline(const PolygonBody& body, double reach) {
  if (!body.endless) return body.corners;
  std::vector<Point> outline = {
      {body.corners.front().x + reach * body.first.x, body.corners.front().y + reach * body.first.y}};
  outline.insert(outline.end(), body.corners.begin(), body.corners.end());
  outline.push_back({body.corners.back().x + reach * body.last.x, body.corners.back().y + reach * body.last.y});
  return outline;
}

double signed_area(const std::vector<Point>& outline) {
  double sum = 0;
  for (std::size_t i = 0, last = outline.size() - 1; i < outline.size(); last = i++)
    sum += 0.5 * (outline[last].x * outline[i].y - outline[i].x * outline[last].y);
  return sum;
}

bool inside(const std::vector<Point>& outline, const Point& p) {
  bool odd = false;
  for (std::size_t i = 0, last = outline.size() - 1; i < outline.size(); last = i++) {
    const Point &a = outline[last], &b = outline[i];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

/// Points spread over the inside, one for `area_each` and between 8 and 60 of them (a lattice of irrational steps).
void append_inner_points(const std::vector<Point>& outline, double area_each, std::vector<Point>& points) {
  double x0 = outline[0].x, x1 = x0, y0 = outline[0].y, y1 = y0;
  for (const Point& p : outline)
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  const std::size_t wanted = std::size_t(std::clamp(signed_area(outline) / area_each, 8.0, 60.0));
  for (std::size_t i = 1, found = 0; found < wanted && i < 100000; ++i) {
    const double u = std::fmod(0.7548776662466927 * double(i), 1.0), v = std::fmod(0.5698402909980532 * double(i), 1.0);
    const Point p{x0 + u * (x1 - x0), y0 + v * (y1 - y0)};
    if (inside(outline, p)) points.push_back(p), ++found;
  }
}

}  // namespace

struct BoundaryElements::System {
  using Matrix = Eigen::MatrixXcd;
  using Vector = Eigen::VectorXcd;
  double k;
  bool endless = false;
  std::vector<std::vector<Point>> outlines;
  std::vector<Panel> panels;
  std::vector<Point> inner;
  std::vector<double> scale;  ///< √|weight| of each node
  double inner_scale = 1;
  Eigen::HouseholderQR<Matrix> soft, hard;

  Place node(std::size_t i) const { return panels[i / order].at(gauss_legendre(order)[i % order].x); }
  const Point& normal(std::size_t i) const { return panels[i / order].normal; }
  std::size_t nodes() const { return panels.size() * order; }

  /// Panels of `own_side` are left out: a straight side gives nothing to itself.
  Rows rows(const Target& target, std::size_t own_side) const {
    Rows values{std::vector<Complex>(nodes()), std::vector<Complex>(nodes())};
    for (std::size_t p = 0; p < panels.size(); ++p)
      if (panels[p].side != own_side) add_integral(k, target, panels[p], -1, 1, 0, p * order, values);
    return values;
  }

  void factorise() {
    const std::size_t n = nodes(), m = inner.size();
    scale.resize(n);
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = std::abs(panels[i / order].speed()) * gauss_legendre(order)[i % order].weight;
      scale[i] = std::sqrt(weight), total += weight;
    }
    inner_scale = std::sqrt(total / double(m));
    // Unknowns: soft √|w| q/k, hard √|w| u.
    Matrix soft_matrix(n + m, n), hard_matrix(n + m, n);
    const auto fill = [&](std::size_t i, const Rows& values, double soft_factor, double row_scale) {
      for (std::size_t c = 0; c < n; ++c) {
        const double factor = row_scale / scale[c];
        soft_matrix(Eigen::Index(i), Eigen::Index(c)) = factor * soft_factor * values.soft[c];
        hard_matrix(Eigen::Index(i), Eigen::Index(c)) = -factor * values.hard[c];
      }
    };
    for (std::size_t i = 0; i < n; ++i) {
      fill(i, rows({node(i), &normal(i)}, panels[i / order].side), 1, scale[i]);
      soft_matrix(Eigen::Index(i), Eigen::Index(i)) += 0.5;
      hard_matrix(Eigen::Index(i), Eigen::Index(i)) += 0.5;
    }
    for (std::size_t i = 0; i < m; ++i) fill(n + i, rows({Place{inner[i].x, inner[i].y}}, no_side), k, inner_scale);
    soft.compute(soft_matrix);
    hard.compute(hard_matrix);
  }

  /// Incident wave and its derivatives.
  struct Incident {
    Complex value, x, y;
  };

  template <typename Wave>
  std::vector<WedgeField> solve(const Wave& wave, const std::vector<Point>& receivers) const {
    Diagnostics faults;
    for (const Point& receiver : receivers) refuse_inside(receiver, "receiver", faults);
    faults.throw_if_errors();
    const std::size_t n = nodes(), m = inner.size();
    Vector soft_side(n + m), hard_side(n + m);
    for (std::size_t i = 0; i < n; ++i) {
      const Incident in = wave(node(i));
      soft_side[Eigen::Index(i)] = scale[i] / k * (in.x * normal(i).x + in.y * normal(i).y);
      hard_side[Eigen::Index(i)] = scale[i] * in.value;
    }
    for (std::size_t i = 0; i < m; ++i)
      soft_side[Eigen::Index(n + i)] = hard_side[Eigen::Index(n + i)] =
          inner_scale * wave(Place{inner[i].x, inner[i].y}).value;
    const Vector q = soft.solve(soft_side), u = hard.solve(hard_side);
    std::vector<WedgeField> fields;
    for (const Point& receiver : receivers) {
      const Place target{receiver.x, receiver.y};
      const Rows values = rows({target}, no_side);
      WedgeField field{wave(target).value, wave(target).value};
      for (std::size_t i = 0; i < n; ++i) {
        field.soft -= values.soft[i] * q[Eigen::Index(i)] * (k / scale[i]);
        field.hard += values.hard[i] * u[Eigen::Index(i)] / scale[i];
      }
      fields.push_back(field);
    }
    return fields;
  }

  void refuse_inside(const Point& point, const char* name, Diagnostics& faults) const {
    for (const auto& outline : outlines)
      if (inside(outline, point))
        faults.error({}, 0, name, fmt::format("({:g}, {:g}) lies inside a body", point.x, point.y));
  }
};

BoundaryElements::BoundaryElements(const std::vector<PolygonBody>& bodies, double k, const BoundaryMesh& mesh)
    : system_(std::make_unique<System>()) {
  Diagnostics faults;
  if (!(k > 0 && std::isfinite(k))) faults.error({}, 0, "k", fmt::format("{} is no wavenumber", k));
  faults.throw_if_errors();
  const double wavelength = 2 * pi / k;
  std::size_t side = 0;
  system_->k = k;
  for (const PolygonBody& body : bodies) {
    if (body.corners.size() < (body.endless ? 1u : 3u)) {
      faults.error({}, 0, "bodies", "a body of too few corners");
      continue;
    }
    system_->outlines.push_back(closed_outline(body, mesh.reach * wavelength));
    if (!(signed_area(system_->outlines.back()) > 0))
      faults.error({}, 0, "bodies", "an outline that does not run counter-clockwise", {}, "turn it round");
    system_->endless = system_->endless || body.endless;
    append_panels(body, wavelength, mesh, side, system_->panels);
    append_inner_points(system_->outlines.back(), 0.5 * wavelength * wavelength, system_->inner);
  }
  if (bodies.empty()) faults.error({}, 0, "bodies", "no body");
  faults.throw_if_errors();
  system_->factorise();
}

BoundaryElements::~BoundaryElements() = default;
BoundaryElements::BoundaryElements(BoundaryElements&&) noexcept = default;
BoundaryElements& BoundaryElements::operator=(BoundaryElements&&) noexcept = default;

std::vector<WedgeField> BoundaryElements::line_source(const Point& source, const std::vector<Point>& receivers) const {
  Diagnostics faults;
  system_->refuse_inside(source, "source", faults);
  faults.throw_if_errors();
  const double k = system_->k;
  return system_->solve(
      [&](const Place& at) -> System::Incident {
        const Complex x = at.x - source.x, y = at.y - source.y, r = std::sqrt(x * x + y * y);
        const HankelPair h = hankel2_pair(k * r);
        const Complex slope = Complex(0, 0.25 * k) * h.one / r;
        return {Complex(0, -0.25) * h.zero, slope * x, slope * y};
      },
      receivers);
}

std::vector<WedgeField> BoundaryElements::plane_wave(double azimuth, const std::vector<Point>& receivers) const {
  if (system_->endless)
    input_error({}, 0, "bodies", "a plane wave on an endless body", "it does not fall off along its sides",
                "give a line source");
  const double k = system_->k, cx = std::cos(azimuth), cy = std::sin(azimuth);
  return system_->solve(
      [&](const Place& at) -> System::Incident {
        const Complex value = std::exp(Complex(0, -k) * (at.x * cx + at.y * cy));
        return {value, Complex(0, -k * cx) * value, Complex(0, -k * cy) * value};
      },
      receivers);
}

std::size_t BoundaryElements::nodes() const { return system_->nodes(); }

Complex line_source_free_field(double k, const Point& a, const Point& b) {
  return Complex(0, -0.25) * hankel2_pair(k * std::hypot(a.x - b.x, a.y - b.y)).zero;
}

}  // namespace grimaldi
