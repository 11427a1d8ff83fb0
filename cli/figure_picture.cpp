#include "cli/figure_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/axes.h"

namespace grimaldi {
namespace {

constexpr double sheet_width = 1600, margin = 36, gap = 40, bar_width = 30;
constexpr Colour grid_colour{225, 225, 225}, unknown_colour{200, 200, 200}, truth_colour{150, 150, 150};

/// Colours that people with any colour vision can tell apart. Source: Okabe and Ito, "Color Universal Design" (2008).
constexpr std::array<Colour, 6> palette{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}}};

/// Where a value lies on an axis of the panel.
struct Axis {
  ValueRange range;
  double from, to;  ///< px
  double at(double value) const { return from + (to - from) * (value - range.low) / (range.high - range.low); }
};

/// Whole powers of ten on an axis of their logarithms, as numbers.
std::string decade_text(int exponent) {
  if (exponent >= 0 && exponent <= 4) return fmt::format("{:.0f}", std::pow(10, exponent));
  if (exponent < 0 && exponent >= -4) return fmt::format("{:.{}f}", std::pow(10, exponent), -exponent);
  return fmt::format("1e{}", exponent);
}

std::vector<int> decades(const ValueRange& range) {
  std::vector<int> all;
  const int step = std::max(1, int((range.high - range.low) / 8));
  for (int e = int(std::ceil(range.low - 1e-9)); e <= range.high + 1e-9; e += step) all.push_back(e);
  return all;
}

void draw_decades_below(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const std::string& name) {
  const Axis axis{range, panel.left, panel.right};
  for (const int e : decades(range)) {
    canvas.line({axis.at(e), panel.bottom}, {axis.at(e), panel.bottom + 0.32 * small_size}, black, small_size / 11);
    canvas.text({axis.at(e), panel.bottom + 1.07 * small_size}, decade_text(e), {.size = small_size}, Align::middle);
  }
  canvas.text({(panel.left + panel.right) / 2, panel.bottom + 2.42 * small_size}, name, {.size = small_size},
              Align::middle);
}

void draw_decades_left(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const std::string& name) {
  const Axis axis{range, panel.bottom, panel.top};
  for (const int e : decades(range)) {
    canvas.line({panel.left - 0.32 * small_size, axis.at(e)}, {panel.left, axis.at(e)}, black, small_size / 11);
    canvas.text({panel.left - 0.62 * small_size, axis.at(e)}, decade_text(e), {.size = small_size}, Align::end);
  }
  canvas.text({panel.left - 4.2 * small_size, (panel.top + panel.bottom) / 2}, name,
              {.size = small_size, .upwards = true}, Align::middle);
}

double left_margin(const ValueRange& range, bool is_decades, double length) {
  return is_decades ? 5 * small_size : y_axis_width(axis_ticks(range, length, small_size, false), small_size);
}

void draw_axes(Canvas& canvas, const PlotBox& panel, const ValueRange& x, const ValueRange& y, bool x_decades,
               bool y_decades, const std::string& x_name, const std::string& y_name) {
  if (x_decades)
    draw_decades_below(canvas, panel, x, x_name);
  else
    draw_x_axis(canvas, panel, x, axis_ticks(x, panel.width(), small_size, true), x_name, small_size);
  if (y_decades)
    draw_decades_left(canvas, panel, y, y_name);
  else
    draw_y_axis(canvas, panel, y, axis_ticks(y, panel.height(), small_size, false), y_name, y_name, small_size);
}

void draw_title(Canvas& canvas, const std::string& title) {
  canvas.text({margin, margin + 0.4 * title_size}, shorten(title, sheet_width - 2 * margin, title_size, true),
              {.size = title_size, .bold = true});
}

Canvas draw(const LineChart& chart) {
  constexpr double height = 620;
  const ValueRange y{chart.low, chart.high};
  ValueRange x{INFINITY, -INFINITY};
  for (const Curve& curve : chart.curves)
    for (const double value : curve.x) x.low = std::min(x.low, value), x.high = std::max(x.high, value);
  if (!(x.high > x.low)) x = {0, 1};
  const double top = margin + 1.6 * title_size + 1.8 * small_size;
  const PlotBox panel{std::round(margin + left_margin(y, false, height)), std::round(top), sheet_width - margin,
                      std::round(top + height)};
  Canvas canvas(int(sheet_width), int(panel.bottom + x_axis_height(small_size) + margin / 2));
  draw_title(canvas, chart.title);
  for (const double value : axis_ticks(y, height, small_size, false).at) {
    const double line = Axis{y, panel.bottom, panel.top}.at(value);
    canvas.line({panel.left, line}, {panel.right, line}, grid_colour, 1);
  }
  const Axis across{x, panel.left, panel.right}, up{y, panel.bottom, panel.top};
  double legend = panel.left;
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    const Curve& curve = chart.curves[c];
    const Colour colour = c == 0 ? truth_colour : palette[(c - 1) % palette.size()];
    const double width = c == 0 ? 8 : 2.5;
    std::vector<std::pair<PlotPoint, PlotPoint>> segments;
    for (std::size_t i = 1; i < curve.y.size(); ++i) {
      if (std::isnan(curve.y[i - 1]) || std::isnan(curve.y[i])) continue;
      // Far outside the panel the numbers of the picture would overflow.
      const auto kept = [&](double value) { return std::clamp(value, y.low - (y.high - y.low), 2 * y.high - y.low); };
      segments.push_back(
          {{across.at(curve.x[i - 1]), up.at(kept(curve.y[i - 1]))}, {across.at(curve.x[i]), up.at(kept(curve.y[i]))}});
    }
    canvas.lines(segments, panel, colour, width);
    canvas.line({legend, top - 1.2 * small_size}, {legend + 36, top - 1.2 * small_size}, colour, width);
    canvas.text({legend + 46, top - 1.2 * small_size}, curve.name, {.size = small_size});
    legend += 46 + text_width(curve.name, small_size) + 40;
  }
  canvas.frame(panel, black, 2);
  draw_axes(canvas, panel, x, y, chart.decades, false, chart.x_name, chart.y_name);
  return canvas;
}

void draw_raster(Canvas& canvas, const PlotBox& panel, const Raster& raster, const ValueRange& scale) {
  const std::size_t rows = raster.values.size() / std::max<std::size_t>(1, raster.columns);
  const int wide = int(panel.width()), high = int(panel.height());
  std::vector<Colour> pixels(std::size_t(wide) * std::size_t(high), unknown_colour);
  for (int v = 0; v < high && rows > 0; ++v)
    for (int u = 0; u < wide; ++u) {
      const auto column = std::size_t((u + 0.5) / wide * double(raster.columns));
      const auto row = std::size_t((high - v - 0.5) / high * double(rows));
      const double value = raster.values[row * raster.columns + column];
      if (!std::isnan(value)) pixels[std::size_t(v) * std::size_t(wide) + std::size_t(u)] = colour_of(value, scale);
    }
  canvas.image(int(panel.left), int(panel.top), wide, pixels);
  canvas.frame(panel, black, 2);
}

Canvas draw(const RasterRow& row) {
  const ValueRange x{row.left, row.right}, y{row.bottom, row.top}, scale{row.low, row.high};
  const auto count = double(row.panels.size());
  const double axis = left_margin(y, row.y_decades, 400),
               bar_room = bar_width + colour_bar_margin(scale, 400, small_size);
  // One y axis at the left, one bar at the right, panels in equal shares between.
  const double wide =
      std::floor((sheet_width - 2 * margin - axis - gap / 2 - bar_room - (count - 1) * gap) / std::max(1.0, count));
  const bool same_unit = !row.x_decades && !row.y_decades;
  const double ratio = same_unit ? (row.top - row.bottom) / (row.right - row.left) : 0.85;
  const double high = std::round(std::clamp(wide * ratio, 200.0, 900.0));
  const double top = std::round(margin + 1.6 * title_size + 1.6 * small_size);
  Canvas canvas(int(sheet_width), int(top + high + x_axis_height(small_size) + margin / 2));
  draw_title(canvas, row.title);
  bool below = false, above = false;
  for (std::size_t i = 0; i < row.panels.size(); ++i) {
    const Raster& raster = row.panels[i];
    for (const double value : raster.values) below |= value<row.low, above |= value> row.high;
    const double left = std::round(margin + axis + double(i) * (wide + gap));
    const PlotBox panel{left, top, left + wide, top + high};
    draw_raster(canvas, panel, raster, scale);
    canvas.text({left + wide / 2, top - 0.9 * small_size}, shorten(raster.name, wide + gap - 8, small_size),
                {.size = small_size}, Align::middle);
    if (i == 0)
      draw_axes(canvas, panel, x, y, row.x_decades, row.y_decades, row.x_name, row.y_name);
    else if (row.x_decades)
      draw_decades_below(canvas, panel, x, row.x_name);
    else
      draw_x_axis(canvas, panel, x, axis_ticks(x, panel.width(), small_size, true), row.x_name, small_size);
  }
  const double bar = margin + axis + count * (wide + gap) - gap / 2;
  draw_colour_bar(canvas, {bar, top, bar + bar_width, top + high}, scale, row.scale_name, below, above, small_size);
  return canvas;
}

}  // namespace

Canvas figure_picture(const Figure& figure) {
  return std::visit([](const auto& drawing) { return draw(drawing); }, figure.drawing);
}

}  // namespace grimaldi
