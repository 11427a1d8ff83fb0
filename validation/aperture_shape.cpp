#include "validation/aperture_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {
namespace {

constexpr double most_corners = 10000;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The column `params`, asked key by key; what nobody asked for is a fault.
class Parameters {
 public:
  explicit Parameters(std::string_view text) : text_(text) {
    while (!text.empty()) {
      const auto end = std::min(text.find(';'), text.size());
      read(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  /// A length above 0.
  double length(const std::string& key, const std::string& other = {}) {
    const double value = required(key, other);
    if (!(value > 0)) fault(fmt::format("{} = {} is no length", key, value), "it must be above 0");
    return value;
  }
  double whole(const std::string& key, double least) {
    const double value = required(key, {});
    check_whole(key, value, least);
    return value;
  }
  void check_whole(const std::string& what, double value, double least) {
    if (!(value >= least && value <= most_corners && value == std::floor(value)))
      fault(fmt::format("{} = {} is not allowed", what, value),
            fmt::format("a whole number from {} to {} is needed", least, most_corners));
  }
  /// An angle; 0 if it is not given or if the text says that the first vertex lies on +x.
  double angle(const std::string& key) {
    known_.push_back(key);
    const auto found = values_.find(key);
    return found == values_.end() ? 0 : as_number(key, found->second);
  }
  std::vector<double> numbers(const std::string& key) {
    known_.push_back(key);
    const auto found = values_.find(key);
    if (found == values_.end()) return missing(key), std::vector<double>{};
    std::vector<double> list;
    for (std::string_view rest = trimmed(found->second); !rest.empty();) {
      const auto end = std::min(rest.find_first_of(" \t"), rest.size());
      list.push_back(as_number(key, rest.substr(0, end)));
      rest = trimmed(rest.substr(end));
    }
    return list;
  }
  void fault(std::string problem, std::string why) {
    faults_.error({}, 0, "params", std::move(problem), std::move(why));
  }
  /// Throws if there was a fault, unknown keys included.
  void finish() {
    for (const auto& [key, value] : values_)
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        faults_.error({}, 0, "params", fmt::format("unknown key \"{}\"", key), {}, did_you_mean(key, known_));
    faults_.throw_if_errors();
  }
  bool sound() const { return !faults_.has_errors(); }

 private:
  void read(std::string_view pair) {
    if (pair.empty() || pair == "first vertex on +x") return;
    const auto equals = pair.find('=');
    if (equals == std::string_view::npos)
      return fault(fmt::format("\"{}\" is no key=value", pair), "params are key=value pairs between semicolons");
    const std::string key(trimmed(pair.substr(0, equals)));
    if (!values_.emplace(key, trimmed(pair.substr(equals + 1))).second)
      fault(fmt::format("\"{}\" is given twice", key), fmt::format("in \"{}\"", text_));
  }
  double required(const std::string& key, const std::string& other) {
    known_.push_back(key);
    if (!other.empty()) known_.push_back(other);
    auto found = values_.find(key);
    if (found == values_.end() && !other.empty()) found = values_.find(other);
    if (found == values_.end()) return missing(key), 1;  // 1: no further fault follows from this one
    return as_number(found->first, found->second);
  }
  void missing(const std::string& key) { fault(fmt::format("{} is missing", key), fmt::format("in \"{}\"", text_)); }
  double as_number(const std::string& key, std::string_view text) {
    const auto value = number(text);
    if (!value) fault(fmt::format("{}: \"{}\" is not a finite number", key, text), {});
    return value.value_or(1);
  }

  std::string text_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> known_;
  Diagnostics faults_;
};

Aperture::Loop rectangle(double x, double wx, double wy) {
  return {{x - wx / 2, -wy / 2}, {x + wx / 2, -wy / 2}, {x + wx / 2, wy / 2}, {x - wx / 2, wy / 2}};
}

/// Corners at equal angles, their distances taken in turn from the one and the other.
Aperture::Loop corners(double count, double radius, double other, double first_angle) {
  Aperture::Loop loop;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const double angle = first_angle + 2 * pi * i / count, r = i % 2 == 0 ? radius : other;
    loop.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return loop;
}

// Each maker asks for its keys; where one is at fault it may return anything.

Aperture rect(Parameters& p) {
  const double wx = p.length("wx"), wy = p.length("wy");
  return {{rectangle(0, wx, wy)}, {}};
}

Aperture square(Parameters& p) {
  const double w = p.length("w");
  return {{rectangle(0, w, w)}, {}};
}

Aperture circle(Parameters& p) { return {{}, {{p.length("radius"), 1}}}; }

Aperture annulus(Parameters& p) {
  const double outer = p.length("outer"), inner = p.length("inner");
  if (p.sound() && !(inner < outer))
    p.fault(fmt::format("inner = {} is not below outer = {}", inner, outer), "nothing is left of the ring");
  return {{}, {{outer, 1}, {inner, -1}}};
}

Aperture regular(Parameters& p, double count) {
  const double radius = p.length("circumradius", "R"), angle = p.angle("first_vertex_angle_rad");
  if (!p.sound()) return {};
  return {{corners(count, radius, radius, angle)}, {}};
}

Aperture regular_polygon(Parameters& p) { return regular(p, p.whole("N", 3)); }

Aperture star(Parameters& p, double tips) {
  const double outer = p.length("R", "circumradius"), inner = p.length("r", "inner");
  const double angle = p.angle("first_outer_vertex_angle_rad");
  if (p.sound() && !(inner < outer))
    p.fault(fmt::format("r = {} is not below R = {}", inner, outer), "the tips of a star lie outside");
  if (!p.sound()) return {};
  return {{corners(2 * tips, outer, inner, angle)}, {}};
}

Aperture star_polygon(Parameters& p) { return star(p, p.whole("N", 2)); }

Aperture double_slit(Parameters& p) {
  const double width = p.length("width"), height = p.length("height"), spacing = p.length("centre_spacing");
  if (p.sound() && !(spacing >= width))
    p.fault(fmt::format("centre_spacing = {} is below width = {}", spacing, width), "the slits would overlap");
  return {{rectangle(-spacing / 2, width, height), rectangle(spacing / 2, width, height)}, {}};
}

Aperture polygon(Parameters& p) {
  const std::vector<double> list = p.numbers("vertices");
  Aperture::Loop loop;
  for (std::size_t i = 0; i + 1 < list.size(); i += 2) loop.push_back({list[i], list[i + 1]});
  if (list.size() % 2 == 1 || loop.size() < 3)
    p.fault(fmt::format("{} numbers are no polygon", list.size()), "three or more pairs x y are needed");
  else if (area(loop) == 0)
    p.fault("the polygon has no area", {});
  if (area(loop) < 0) std::reverse(loop.begin(), loop.end());
  return {{loop}, {}};
}

struct Shape {
  std::string name;
  std::function<Aperture(Parameters&)> make;
};

const std::vector<Shape>& shapes() {
  const auto of = [](double count) { return [count](Parameters& p) { return regular(p, count); }; };
  static const std::vector<Shape> table = {
      {"rect", rect},
      {"square", square},
      {"circle", circle},
      {"circle_on_axis", circle},
      {"circle_off_axis", circle},
      {"annulus", annulus},
      {"regular_polygon", regular_polygon},
      {"triangle", of(3)},
      {"pentagon", of(5)},
      {"hexagon", of(6)},
      {"heptagon", of(7)},
      {"octagon", of(8)},
      {"star_polygon", star_polygon},
      {"star5", [](Parameters& p) { return star(p, 5); }},
      {"double_slit", double_slit},
      {"polygon", polygon},
  };
  return table;
}

}  // namespace

const std::vector<std::string>& aperture_shape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Shape& shape : shapes()) list.push_back(shape.name);
    return list;
  }();
  return names;
}

Aperture aperture_shape(std::string_view shape, std::string_view params) {
  const std::string name(trimmed(shape));
  Parameters parameters(params);
  Aperture aperture;
  const bool named_star = name.size() > 4 && name.compare(0, 4, "star") == 0;
  const double tips = named_star ? number(std::string_view(name).substr(4)).value_or(0) : 0;
  const auto known =
      std::find_if(shapes().begin(), shapes().end(), [&](const Shape& candidate) { return candidate.name == name; });
  if (known != shapes().end()) {
    aperture = known->make(parameters);
  } else if (tips != 0) {
    parameters.check_whole("the number in \"" + name + "\"", tips, 2);
    aperture = star(parameters, tips);
  } else {
    input_error({}, 0, "shape", fmt::format("unknown shape \"{}\"", name), {},
                did_you_mean(name, aperture_shape_names()));
  }
  parameters.finish();
  return aperture;
}

}  // namespace grimaldi
