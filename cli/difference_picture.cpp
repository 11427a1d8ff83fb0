#include "cli/difference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "cli/axes.h"
#include "cli/map_picture.h"
#include "cli/plan_words.h"

namespace grimaldi {
namespace {

constexpr double margin = 36, gap = 44, bar_height = 30;

using Sort = Comparison::Sort;

/// One of the three maps: its title, its scale and the level of each cell (NaN: not reached).
struct Panel {
  std::string title, scale_name;
  std::vector<double> levels;
  ValueRange scale;
  ColourScale colours = colour_of;
  bool difference = false;
  bool below = false, above = false;
};

std::vector<double> levels_of(const Plan& plan, const CoverageMap& map) {
  const ShownQuantity quantity = shown_quantity(plan);
  std::vector<double> levels(plan.grid.size(), NAN);
  for (std::size_t cell = 0; cell < levels.size(); ++cell) {
    double sum = 0;
    for (std::size_t t = 0; t < quantity.weight.size(); ++t)
      sum += quantity.weight[t] * map.path_gain[t * plan.bands() * levels.size() + cell];
    if (sum > 0) levels[cell] = 10 * std::log10(sum);
  }
  return levels;
}

std::array<Panel, 3> make_panels(const Plan& plan, const Result& fsd, const Result& utd, const Comparison& comparison) {
  const ShownQuantity quantity = shown_quantity(plan);
  const std::string name = quantity.name + " (" + quantity.unit + ")";
  std::array<Panel, 3> panels;
  panels[0] = {"FSD", name, levels_of(plan, *fsd.coverage), {}};
  panels[1] = {"UTD", name, levels_of(plan, *utd.coverage), {}};
  std::vector<double> reached;
  for (std::size_t i = 0; i < 2; ++i)
    for (const double level : panels[i].levels)
      if (!std::isnan(level)) reached.push_back(level);
  const ValueRange scale = reached.empty() ? ValueRange{-10, 0} : colour_range(reached);
  panels[0].scale = panels[1].scale = scale;
  const double half = difference_scale(comparison.first().all.p95_abs);
  panels[2] = {
      "FSD − UTD", "difference (dB), red: FSD stronger", comparison.difference_dB, {-half, half}, diverging_colour_of,
      true};
  for (Panel& panel : panels)
    for (const double level : panel.levels) {
      panel.below |= level < panel.scale.low;
      panel.above |= level > panel.scale.high;
    }
  return panels;
}

Colour hatched(int i, int j) { return (i + j) % 10 < 2 ? unreached_hatch_colour : unreached_colour; }

void draw_cells(Canvas& canvas, const MapFrame& frame, const Panel& panel, const std::vector<Sort>& sort) {
  std::vector<Colour> pixels(std::size_t(frame.columns) * std::size_t(frame.rows));
  for (int j = 0; j < frame.rows; ++j)
    for (int i = 0; i < frame.columns; ++i) {
      const std::size_t cell = frame.cell_at(i, j);
      Colour& pixel = pixels[std::size_t(j) * std::size_t(frame.columns) + std::size_t(i)];
      if (sort[cell] == Sort::inside) {
        pixel = inside_colour;
      } else if (!std::isnan(panel.levels[cell])) {
        pixel = panel.colours(panel.levels[cell], panel.scale);
      } else if (panel.difference && sort[cell] == Sort::only_fsd) {
        pixel = only_fsd_colour;
      } else if (panel.difference && sort[cell] == Sort::only_utd) {
        pixel = only_utd_colour;
      } else {
        pixel = hatched(i, j);
      }
    }
  canvas.image(frame.left, frame.top, frame.columns, pixels);
}

struct LegendEntry {
  std::string words;
  std::function<Colour(int, int)> colour;
};

std::vector<LegendEntry> legend_entries(const Comparison& comparison) {
  const auto count = [&](Sort sort) {
    return std::size_t(std::count(comparison.sort.begin(), comparison.sort.end(), sort));
  };
  const auto plain = [](Colour colour) { return [colour](int, int) { return colour; }; };
  std::vector<LegendEntry> entries;
  const auto add = [&](Sort sort, const char* words, std::function<Colour(int, int)> colour) {
    if (count(sort) > 0)
      entries.push_back(
          {fmt::format("{} ({} {})", words, count(sort), count(sort) == 1 ? "cell" : "cells"), std::move(colour)});
  };
  add(Sort::inside, "inside a building", plain(inside_colour));
  add(Sort::neither, "reached by neither", hatched);
  add(Sort::only_fsd, "reached by FSD alone", plain(only_fsd_colour));
  add(Sort::only_utd, "reached by UTD alone", plain(only_utd_colour));
  return entries;
}

void draw_legend(Canvas& canvas, double y, const std::vector<LegendEntry>& entries) {
  constexpr int wide = 40, high = 24;
  double x = margin;
  for (const LegendEntry& entry : entries) {
    const int left = int(x), top = int(y) - high / 2;
    std::vector<Colour> pixels;
    for (int j = 0; j < high; ++j)
      for (int i = 0; i < wide; ++i) pixels.push_back(entry.colour(i, j));
    canvas.image(left, top, wide, pixels);
    canvas.frame({double(left), double(top), double(left + wide), double(top + high)}, black, 1.5);
    canvas.text({x + wide + 10, y}, entry.words, {.size = small_size});
    x += wide + 10 + text_width(entry.words, small_size) + 34;
  }
}

}  // namespace

double difference_scale(double p95_abs) {
  for (const double half : {1.0, 2.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0})
    if (!(p95_abs > half)) return half;
  return 40;
}

Canvas difference_picture(const Scene& scene, const Plan& plan, const Result& fsd, const Result& utd,
                          const Comparison& comparison) {
  const std::array<Panel, 3> panels = make_panels(plan, fsd, utd, comparison);
  const double nx = double(plan.grid.nx), ny = double(plan.grid.ny);
  const bool stacked = nx >= 2 * ny;
  const double scale = std::min((stacked ? 1500 : 620) / nx, (stacked ? 750 : 1100) / ny);
  const int columns = std::max(1, int(std::lround(nx * scale))), rows = std::max(1, int(std::lround(ny * scale)));
  const ValueRange x{plan.grid.x0, plan.grid.x0 + nx * plan.grid.cell},
      y{plan.grid.y0, plan.grid.y0 + ny * plan.grid.cell};
  const Ticks x_ticks = axis_ticks(x, columns, small_size, true), y_ticks = axis_ticks(y, rows, small_size, false);
  const double axis = y_axis_width(y_ticks, small_size), head = 2 * small_size;
  const double wide = std::max(axis + columns, 420.0);  // a narrow map still needs a bar that can be read
  const double high = head + rows + x_axis_height(small_size) + 16 + bar_height + x_axis_height(small_size);
  const double title_high = 1.5 * title_size + 2.0 * body_size;
  const double content = std::max(stacked ? wide : 3 * wide + 2 * gap, 1300.0);
  const double top = margin + title_high;
  const double legend = top + (stacked ? 3 * high + 2 * gap / 2 : high) + 26;
  Canvas canvas(int(std::ceil(content + 2 * margin)), int(std::ceil(legend + 14 + margin)));

  std::vector<std::string> second = method_words(plan);
  second.front() = "depth " + std::to_string(plan.request.depth);
  second.erase(second.begin() + 1);
  second.push_back(fmt::format("cells of {:g} m", plan.grid.cell));
  second.push_back("the same beams, two laws of diffraction");
  const std::string title =
      fmt::format("Two theories of diffraction: FSD less UTD{}{}{}{}{}{}", title_separator, scene_words(scene),
                  title_separator, band_words(plan), title_separator, transmitter_words(plan));
  canvas.text({margin, margin + 0.4 * title_size}, shorten(title, content, title_size, true),
              {.size = title_size, .bold = true});
  canvas.text({margin, margin + 1.5 * title_size + 0.3 * body_size},
              shorten(fmt::format("{}", fmt::join(second, title_separator)), content, body_size),
              {.size = body_size, .colour = {60, 60, 60}});

  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Panel& panel = panels[k];
    MapFrame frame;
    frame.grid = plan.grid;
    frame.columns = columns;
    frame.rows = rows;
    frame.left = int(std::lround(margin + axis + (stacked ? 0 : double(k) * (wide + gap))));
    frame.top = int(std::lround(top + head + (stacked ? double(k) * (high + gap / 2) : 0)));
    const PlotBox box{double(frame.left), double(frame.top), double(frame.left + columns), double(frame.top + rows)};
    canvas.text({box.left, box.top - 0.9 * small_size}, panel.title, {.size = body_size, .bold = true});
    draw_cells(canvas, frame, panel, comparison.sort);
    draw_buildings(canvas, scene, frame, 0.8);
    canvas.frame({box.left - 1, box.top - 1, box.right + 1, box.bottom + 1}, black, 2);
    draw_x_axis(canvas, box, x, x_ticks, "x, east (m)", small_size);
    draw_y_axis(canvas, box, y, y_ticks, "y, north (m)", "y (m)", small_size);
    for (const Transmitter& t : plan.request.transmitters)
      if (t.position.x >= x.low && t.position.x <= x.high && t.position.y >= y.low && t.position.y <= y.high)
        draw_transmitter(canvas, {frame.x(t.position.x), frame.y(t.position.y)}, 0.8);
    const double bar = box.bottom + x_axis_height(small_size) + 16;
    const double length = std::min(900.0, std::max(double(columns), wide - axis));
    draw_colour_bar(canvas, {box.left, bar, box.left + length, bar + bar_height}, panel.scale, panel.scale_name,
                    panel.below, panel.above, small_size, panel.colours);
  }
  draw_legend(canvas, legend, legend_entries(comparison));
  return canvas;
}

}  // namespace grimaldi
