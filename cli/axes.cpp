#include "cli/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/contract.h"

namespace grimaldi {
namespace {

constexpr double tick_length = 0.32;  ///< over the size of the type

/// A round step m·10^exponent, m = 1, 2 or 5.
struct RoundStep {
  int mantissa, exponent;
  /// i steps, rounded once: a product or a quotient of whole numbers and a power of ten.
  double times(double i) const {
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent >= 0 ? i * mantissa * power : i * mantissa / power;
  }
  RoundStep next() const {
    return mantissa == 1 ? RoundStep{2, exponent} : mantissa == 2 ? RoundStep{5, exponent} : RoundStep{1, exponent + 1};
  }
};

std::vector<double> multiples(const RoundStep& step, const ValueRange& range) {
  // An end that is a tick up to rounding (of a division and a product: a few ulp of the count) is one.
  const double size = step.times(1), slack = 1e-9;
  const double first = std::ceil(range.low / size - slack), last = std::floor(range.high / size + slack);
  std::vector<double> at;
  for (double i = first; i <= last; ++i) at.push_back(i == 0 ? 0.0 : step.times(i));
  return at;
}

double widest(const Ticks& ticks, double size) {
  double width = 0;
  for (const double value : ticks.at) width = std::max(width, text_width(tick_text(value, ticks.step), size));
  return width;
}

}  // namespace

Ticks round_ticks(const ValueRange& range, int most) {
  const double span = range.high - range.low;
  GRIMALDI_EXPECT(std::isfinite(span) && span > 1e-12 * std::max(std::abs(range.low), std::abs(range.high)) &&
                  most >= 1);
  // One decade below the first step that can be right; each of its tries counts before it lists.
  RoundStep step{1, int(std::floor(std::log10(span / most))) - 1};
  while (span / step.times(1) > most + 1) step = step.next();
  std::vector<double> at = multiples(step, range);
  while (at.size() > std::size_t(most)) {
    step = step.next();
    at = multiples(step, range);
  }
  return {step.times(1), std::move(at)};
}

std::string number_text(double value, int decimals) {
  std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  if (whole >= 5) {
    for (std::size_t i = whole; i > 3; i -= 3) digits.insert(i - 3, "\u2009");
  }
  return (value < 0 && !zero ? "−" : "") + digits;
}

std::string tick_text(double value, double step) {
  // 1e-9: the step is a rounded decimal number, its logarithm misses the whole number by a few ulp at most.
  return number_text(value, std::max(0, -int(std::floor(std::log10(step) + 1e-9))));
}

Colour colour_of(double value, const ValueRange& range) {
  static constexpr std::array<std::array<double, 3>, 16> viridis{{{0.267004, 0.004874, 0.329415},
                                                                  {0.282656, 0.100196, 0.422160},
                                                                  {0.277134, 0.185228, 0.489898},
                                                                  {0.253935, 0.265254, 0.529983},
                                                                  {0.221989, 0.339161, 0.548752},
                                                                  {0.190631, 0.407061, 0.556089},
                                                                  {0.163625, 0.471133, 0.558148},
                                                                  {0.139147, 0.533812, 0.555298},
                                                                  {0.120565, 0.596422, 0.543611},
                                                                  {0.134692, 0.658636, 0.517649},
                                                                  {0.208030, 0.718701, 0.472873},
                                                                  {0.327796, 0.773980, 0.406640},
                                                                  {0.477504, 0.821444, 0.318195},
                                                                  {0.647257, 0.858400, 0.209861},
                                                                  {0.824940, 0.884720, 0.106217},
                                                                  {0.993248, 0.906157, 0.143936}}};
  GRIMALDI_EXPECT(range.low < range.high && !std::isnan(value));
  const double place = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0) * (viridis.size() - 1);
  const std::size_t i = std::min<std::size_t>(std::size_t(place), viridis.size() - 2);
  const double t = place - double(i);
  const auto channel = [&](std::size_t k) {
    return static_cast<std::uint8_t>(std::lround(255 * ((1 - t) * viridis[i][k] + t * viridis[i + 1][k])));
  };
  return {channel(0), channel(1), channel(2)};
}

Colour diverging_colour_of(double value, const ValueRange& range) {
  static constexpr std::array<Colour, 11> classes{{{5, 48, 97},
                                                   {33, 102, 172},
                                                   {67, 147, 195},
                                                   {146, 197, 222},
                                                   {209, 229, 240},
                                                   {247, 247, 247},
                                                   {253, 219, 199},
                                                   {244, 165, 130},
                                                   {214, 96, 77},
                                                   {178, 24, 43},
                                                   {103, 0, 31}}};
  GRIMALDI_EXPECT(range.low < range.high && !std::isnan(value));
  const double place = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0) * (classes.size() - 1);
  const std::size_t i = std::min<std::size_t>(std::size_t(place), classes.size() - 2);
  return mix(classes[i], classes[i + 1], place - double(i));
}

Ticks axis_ticks(const ValueRange& range, double length, double size, bool side_by_side) {
  // Not nearer than a reader needs: 90 px across, 70 px up, for type of 22 px.
  int most = std::max(3, 1 + int(length / (side_by_side ? 4.1 * size : 3.2 * size)));
  for (;; --most) {
    Ticks ticks = round_ticks(range, most);
    const double apart = length * ticks.step / (range.high - range.low);
    const double needed = side_by_side ? widest(ticks, size) + size : 1.5 * size;
    if (most <= 2 || apart >= needed || ticks.at.size() < 2) return ticks;
  }
}

double y_axis_width(const Ticks& ticks, double size) { return widest(ticks, size) + (tick_length + 2.1) * size; }

double x_axis_height(double size) { return (tick_length + 3.0) * size; }

void draw_x_axis(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const Ticks& ticks,
                 const std::string& name, double size) {
  for (const double value : ticks.at) {
    const double x = panel.left + panel.width() * (value - range.low) / (range.high - range.low);
    const double line = std::clamp(std::round(x), panel.left, panel.right);
    canvas.line({line, panel.bottom}, {line, panel.bottom + tick_length * size}, black, size / 11);
    canvas.text({x, panel.bottom + (tick_length + 0.75) * size}, tick_text(value, ticks.step), {.size = size},
                Align::middle);
  }
  canvas.text({(panel.left + panel.right) / 2, panel.bottom + (tick_length + 2.1) * size}, name, {.size = size},
              Align::middle);
}

void draw_y_axis(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const Ticks& ticks,
                 const std::string& name, const std::string& short_name, double size) {
  for (const double value : ticks.at) {
    const double y = panel.bottom - panel.height() * (value - range.low) / (range.high - range.low);
    const double line = std::clamp(std::round(y), panel.top, panel.bottom);
    canvas.line({panel.left - tick_length * size, line}, {panel.left, line}, black, size / 11);
    canvas.text({panel.left - (tick_length + 0.3) * size, y}, tick_text(value, ticks.step), {.size = size}, Align::end);
  }
  // A name longer than the panel would run into the labels of the x axis.
  const std::string& fitting = text_width(name, size) <= panel.height() ? name : short_name;
  if (text_width(fitting, size) > panel.height()) return;
  canvas.text({panel.left - y_axis_width(ticks, size) + 0.6 * size, (panel.top + panel.bottom) / 2}, fitting,
              {.size = size, .upwards = true}, Align::middle);
}

void draw_colour_bar(Canvas& canvas, const PlotBox& bar, const ValueRange& range, const std::string& name, bool below,
                     bool above, double size, ColourScale colours) {
  const bool upright = bar.height() > bar.width();
  const double point = upright ? bar.width() : bar.height();  // length of an end's point
  PlotBox body = bar;
  if (upright) {
    body.top += above ? point : 0, body.bottom -= below ? point : 0;
  } else {
    body.left += below ? point : 0, body.right -= above ? point : 0;
  }
  body = {std::round(body.left), std::round(body.top), std::round(body.right), std::round(body.bottom)};
  const int columns = int(body.width()), rows = int(body.height());
  std::vector<Colour> pixels(std::size_t(columns) * std::size_t(rows));
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double share = upright ? (rows - j - 0.5) / rows : (i + 0.5) / columns;
      pixels[std::size_t(j) * std::size_t(columns) + std::size_t(i)] = colours(share, {0, 1});
    }
  }
  canvas.image(int(body.left), int(body.top), columns, pixels);

  std::vector<PlotPoint> rim;
  const auto end_point = [&](PlotPoint a, PlotPoint tip, PlotPoint b, double value, bool there) {
    rim.push_back(a);
    if (there) {
      const std::array<PlotPoint, 3> corners{a, tip, b};
      canvas.polygon(corners, colours(value, {0, 1}), black, 0);
      rim.push_back(tip);
    }
    rim.push_back(b);
  };
  const PlotPoint middle{(body.left + body.right) / 2, (body.top + body.bottom) / 2};
  if (upright) {
    end_point({body.left, body.top}, {middle.x, bar.top}, {body.right, body.top}, 1, above);
    end_point({body.right, body.bottom}, {middle.x, bar.bottom}, {body.left, body.bottom}, 0, below);
  } else {
    end_point({body.right, body.top}, {bar.right, middle.y}, {body.right, body.bottom}, 1, above);
    end_point({body.left, body.bottom}, {bar.left, middle.y}, {body.left, body.top}, 0, below);
  }
  for (std::size_t i = 0; i < rim.size(); ++i) canvas.line(rim[i], rim[(i + 1) % rim.size()], black, size / 11);

  const Ticks ticks = axis_ticks(range, upright ? body.height() : body.width(), size, !upright);
  if (!upright) {
    draw_x_axis(canvas, body, range, ticks, name, size);
    return;
  }
  for (const double value : ticks.at) {
    const double y = body.bottom - body.height() * (value - range.low) / (range.high - range.low);
    const double line = std::clamp(std::round(y), body.top, body.bottom);
    canvas.line({body.right, line}, {body.right + tick_length * size, line}, black, size / 11);
    canvas.text({body.right + (tick_length + 0.3) * size + widest(ticks, size), y}, tick_text(value, ticks.step),
                {.size = size}, Align::end);
  }
  canvas.text({body.right + (tick_length + 1.3) * size + widest(ticks, size), middle.y}, name,
              {.size = size, .upwards = true}, Align::middle);
}

double colour_bar_margin(const ValueRange& range, double length, double size) {
  return widest(axis_ticks(range, length, size, false), size) + (tick_length + 1.8) * size;
}

std::optional<PlotBox> LabelPlacer::place(PlotPoint point, double width, double height, double clearance,
                                          double reach) {
  // Directions in the order of preference; x and y are where the label lies from the point.
  constexpr std::array<std::array<int, 2>, 8> directions{
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
  for (double away = clearance; away <= reach; away += height / 2) {
    for (const auto& [right, down] : directions) {
      // On a diagonal both distances shrink so that the corner lies `away` from the point.
      const double d = right != 0 && down != 0 ? away / std::sqrt(2.0) : away;
      const double x = right == 0 ? point.x - width / 2 : right > 0 ? point.x + d : point.x - d - width;
      const double y = down == 0 ? point.y - height / 2 : down > 0 ? point.y + d : point.y - d - height;
      const PlotBox box{x, y, x + width, y + height};
      if (!room_.contains(box)) continue;
      if (std::any_of(taken_.begin(), taken_.end(), [&](const PlotBox& taken) { return taken.overlaps(box); }))
        continue;
      taken_.push_back(box);
      return box;
    }
  }
  return std::nullopt;
}

}  // namespace grimaldi
