#include "cli/map_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/plan_words.h"
#include "core/contract.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

constexpr Colour transmitter_colour{214, 39, 40}, receiver_colour{255, 255, 255};
constexpr double widest_panel = 1250, highest_panel = 1150;  ///< aimed at, px
constexpr int most_pixels = 3000;                            ///< a side of the panel, px
constexpr double least_content = 1150;                       ///< room that the title needs, px
constexpr double outer_margin = 36, bar_width = 34, least_bar_gap = 30, name_clearance = 17;

/// What is shown of each cell, and how many there are of each sort.
struct Shown {
  enum class Sort : std::uint8_t { inside, unreached, reached, fault };
  std::vector<double> decibels;  ///< of reached cells; 0 for the others
  std::vector<Sort> sort;
  std::size_t inside = 0, unreached = 0, reached = 0, fault = 0;
  bool below = false, above = false;  ///< there are values beyond the scale
  ValueRange scale;
};

Shown shown_cells(const Plan& plan, const CoverageMap& map, const ShownQuantity& quantity) {
  const std::size_t cells = plan.grid.size(), transmitters = quantity.weight.size();
  GRIMALDI_EXPECT(cells > 0 && map.path_gain.size() == transmitters * plan.bands() * cells &&
                  map.inside_fraction.size() == cells);
  Shown shown;
  shown.decibels.assign(cells, 0.0);
  shown.sort.assign(cells, Shown::Sort::unreached);
  std::vector<double> values;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    double sum = 0;
    for (std::size_t t = 0; t < transmitters; ++t)
      sum += quantity.weight[t] * map.path_gain[t * plan.bands() * cells + cell];
    if (std::isnan(sum)) {
      const bool inside = map.inside_fraction[cell] >= 1;
      shown.sort[cell] = inside ? Shown::Sort::inside : Shown::Sort::fault;
      ++(inside ? shown.inside : shown.fault);
    } else if (sum > 0) {
      shown.sort[cell] = Shown::Sort::reached;
      shown.decibels[cell] = 10 * std::log10(sum);
      values.push_back(shown.decibels[cell]);
    }
  }
  shown.reached = values.size();
  shown.unreached = cells - shown.inside - shown.reached - shown.fault;
  if (!values.empty()) {
    shown.scale = colour_range(values);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    shown.below = *least < shown.scale.low;
    shown.above = *most > shown.scale.high;
  }
  return shown;
}

/// Parts joined by the separator into as few lines as fit.
std::vector<std::string> wrap(const std::vector<std::string>& parts, double width, double size, bool bold) {
  std::vector<std::string> lines;
  for (const std::string& part : parts) {
    const std::string longer = lines.empty() ? part : lines.back() + title_separator + part;
    if (!lines.empty() && text_width(longer, size, bold) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(shorten(part, width, size, bold));
    }
  }
  return lines;
}

std::string share_words(std::size_t part, std::size_t whole) {
  const double percent = 100.0 * double(part) / double(whole);
  return percent > 0 && percent < 0.1 ? "< 0.1 %" : number_text(percent, percent < 10 ? 1 : 0) + " %";
}

using Segments = std::vector<std::pair<PlotPoint, PlotPoint>>;

/// Where the plane of the receivers cuts the triangles of the scene.
Segments section(const Scene& scene, const MapFrame& frame) {
  Segments segments;
  const double z = frame.grid.z;
  for (const auto& triangle : scene.triangles) {
    // A corner at or above the plane is above: a triangle that lies in the plane or only touches it from above is not
    // cut.
    PlotPoint ends[2];
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = scene.vertices[triangle[std::size_t(k)]], &b = scene.vertices[triangle[std::size_t((k + 1) % 3)]];
      if ((a.z >= z) == (b.z >= z)) continue;
      const Vec3 p = a + (z - a.z) / (b.z - a.z) * (b - a);
      ends[found++] = {frame.x(p.x), frame.y(p.y)};
    }
    if (found == 2) segments.emplace_back(ends[0], ends[1]);
  }
  return segments;
}

/// Wedges seen from above, as far as they lie above the receivers. Upright ones are points and left out.
Segments roof_lines(const Scene& scene, const MapFrame& frame) {
  Segments segments;
  const double z = frame.grid.z;
  for (const Wedge& wedge : scene.wedges.wedges) {
    Vec3 a = wedge.start, b = wedge.end();
    if (a.z < z && b.z < z) continue;
    if (a.z < z) a = a + (z - a.z) / (b.z - a.z) * (b - a);
    if (b.z < z) b = b + (z - b.z) / (a.z - b.z) * (a - b);
    const PlotPoint from{frame.x(a.x), frame.y(a.y)}, to{frame.x(b.x), frame.y(b.y)};
    constexpr double visible = 0.1;  // px: shorter lines leave no mark
    if (std::hypot(to.x - from.x, to.y - from.y) > visible) segments.emplace_back(from, to);
  }
  return segments;
}

void draw_receiver(Canvas& canvas, PlotPoint at, double unit) {
  canvas.disc(at, 6.5 * unit, receiver_colour, black, 3 * unit);
}

struct Marker {
  PlotPoint at;
  std::string name;
  bool transmitter;
};

/// A rectangle of the pattern of a sort of cells.
void paint_unreached(std::vector<Colour>& pixels, int columns, int rows, int unit,
                     const std::function<bool(std::size_t)>& wanted) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::size_t k = std::size_t(j) * std::size_t(columns) + std::size_t(i);
      if (wanted(k)) pixels[k] = (i + j) % (10 * unit) < 2 * unit ? unreached_hatch_colour : unreached_colour;
    }
  }
}

/// Everything that has to be known before the first line is drawn.
struct Layout {
  double unit = 1;  ///< scale of type and lines: large grids give large pictures
  int width = 0, height = 0;
  MapFrame frame;
  bool upright_bar = true;
  double bar_gap = 0;  ///< between the panel and an upright bar; names find room in it where the panel is narrow
  double title_type = 0;
  double text_left = 0, text_width = 0;
  double legend_top = 0, bar_top = 0;
  Ticks x_ticks, y_ticks;
  ValueRange x_range, y_range;
  std::vector<std::string> title, subtitle;
  PlotBox panel() const {
    return {double(frame.left), double(frame.top), double(frame.left + frame.columns), double(frame.top + frame.rows)};
  }
};

/// Pixels of a panel for nx × ny cells.
std::pair<int, int> panel_pixels(const GridLayout& grid) {
  const double nx = double(grid.nx), ny = double(grid.ny);
  const double aim = std::min(widest_panel / nx, highest_panel / ny);
  const double limit = most_pixels / std::max(nx, ny);
  const double side = limit >= 1 ? std::clamp(std::round(aim), 1.0, std::floor(limit)) : limit;
  return {std::max(1, int(std::lround(side * nx))), std::max(1, int(std::lround(side * ny)))};
}

struct LegendEntry {
  std::string words;
  std::function<void(Canvas&, PlotPoint)> symbol;  ///< draws at the centre of its symbol
};

/// Rows of a legend of that width: the entry's index and its left end.
std::vector<std::vector<std::pair<std::size_t, double>>> legend_rows(const std::vector<LegendEntry>& entries,
                                                                     double width, double unit) {
  std::vector<std::vector<std::pair<std::size_t, double>>> rows;
  double x = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double needed = 52 * unit + text_width(entries[i].words, small_size * unit);
    if (rows.empty() || x + needed > width) {
      rows.emplace_back();
      x = 0;
    }
    rows.back().emplace_back(i, x);
    x += needed + 32 * unit;
  }
  return rows;
}

Layout make_layout(const Scene& scene, const Plan& plan, const Result& result, const Shown& shown,
                   const ShownQuantity& quantity) {
  Layout layout;
  layout.frame.grid = plan.grid;
  std::tie(layout.frame.columns, layout.frame.rows) = panel_pixels(plan.grid);
  const double columns = layout.frame.columns, rows = layout.frame.rows;
  layout.unit = std::max(1.0, std::max(columns / 1800, rows / 1800));
  const double u = layout.unit, size = body_size * u;
  layout.x_range = {plan.grid.x0, plan.grid.x0 + double(plan.grid.nx) * plan.grid.cell};
  layout.y_range = {plan.grid.y0, plan.grid.y0 + double(plan.grid.ny) * plan.grid.cell};
  layout.x_ticks = axis_ticks(layout.x_range, columns, size, true);
  layout.y_ticks = axis_ticks(layout.y_range, rows, size, false);
  layout.upright_bar = rows >= 400 * u;

  const double axis_width = y_axis_width(layout.y_ticks, size);
  double group = axis_width + columns;
  layout.bar_gap = (least_bar_gap + (columns < 500 * u ? 240 : 0)) * u;
  if (layout.upright_bar && shown.reached > 0) {
    group += layout.bar_gap + bar_width * u + colour_bar_margin(shown.scale, rows, size);
  } else if (!layout.x_ticks.at.empty()) {
    // The last label may stand out by half.
    group += text_width(tick_text(layout.x_ticks.at.back(), layout.x_ticks.step), size) / 2;
  }
  const double content = std::max(group, least_content * u);
  layout.width = int(std::ceil(content + 2 * outer_margin * u));
  layout.frame.left = int(std::lround(outer_margin * u + (content - group) / 2 + axis_width));
  const bool wide = columns >= 0.6 * content;
  layout.text_left = wide ? layout.frame.left : outer_margin * u;
  layout.text_width = layout.width - outer_margin * u - layout.text_left;

  std::vector<std::string> first{scene_words(scene), quantity.name + " at " + band_words(plan),
                                 transmitter_words(plan)};
  if (result.interrupted) first.push_back("interrupted run");
  std::erase(first, std::string());
  std::vector<std::string> second = method_words(plan);
  const double height = plan.request.coverage ? plan.request.coverage->height : plan.grid.z;
  second.push_back(fmt::format("cells of {:g} m", plan.grid.cell));
  second.push_back(fmt::format("{:g} m above the ground", height));
  // A title a little too long for one line is set smaller, a longer one is wrapped.
  constexpr double smallest = 0.82;
  const double one_line =
      grimaldi::text_width(fmt::format("{}", fmt::join(first, title_separator)), title_size * u, true);
  const double shrink = layout.text_width / one_line;
  layout.title_type = title_size * u * (shrink >= smallest ? std::min(1.0, shrink) : 1.0);
  layout.title = wrap(first, layout.text_width, layout.title_type, true);
  layout.subtitle = wrap(second, layout.text_width, size, false);
  layout.frame.top = int(std::ceil((outer_margin + 14) * u + double(layout.title.size()) * 1.35 * title_size * u +
                                   double(layout.subtitle.size()) * 1.4 * size));
  layout.bar_top = layout.frame.top + rows + x_axis_height(size) + 22 * u;
  layout.legend_top = layout.bar_top;
  if (!layout.upright_bar && shown.reached > 0) layout.legend_top += bar_width * u + x_axis_height(size) + 14 * u;
  return layout;
}

void draw_cells(Canvas& canvas, const Layout& layout, const Shown& shown) {
  const MapFrame& frame = layout.frame;
  std::vector<Colour> pixels(std::size_t(frame.columns) * std::size_t(frame.rows), unreached_colour);
  const auto cell_of = [&](std::size_t k) {
    return frame.cell_at(int(k % std::size_t(frame.columns)), int(k / std::size_t(frame.columns)));
  };
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const std::size_t cell = cell_of(k);
    if (shown.sort[cell] == Shown::Sort::inside) pixels[k] = inside_colour;
    if (shown.sort[cell] == Shown::Sort::fault) pixels[k] = fault_colour;
    if (shown.sort[cell] == Shown::Sort::reached) pixels[k] = colour_of(shown.decibels[cell], shown.scale);
  }
  paint_unreached(pixels, frame.columns, frame.rows, int(std::lround(layout.unit)),
                  [&](std::size_t k) { return shown.sort[cell_of(k)] == Shown::Sort::unreached; });
  canvas.image(frame.left, frame.top, frame.columns, pixels);
}

/// Finds a place for each name; nothing where there is no room.
std::vector<std::optional<PlotBox>> place_names(const Layout& layout, std::vector<Marker>& markers) {
  const double u = layout.unit, size = small_size * u;
  // Names may leave a panel that is too small for them, but not for the axes below and to the left.
  PlotBox room = layout.panel();
  room.right += layout.bar_gap - least_bar_gap * u;
  if (room.height() < 120 * u) room.top -= 24 * u;
  LabelPlacer placer(room);
  for (const Marker& marker : markers) {
    const double r = 15 * u;
    placer.keep_off({marker.at.x - r, marker.at.y - r, marker.at.x + r, marker.at.y + r});
  }
  std::vector<std::optional<PlotBox>> places;
  for (Marker& marker : markers) {
    marker.name = shorten(marker.name, 330 * u, size, marker.transmitter);
    const double width = text_width(marker.name, size, marker.transmitter) + 6 * u;
    places.push_back(placer.place(marker.at, width, 1.25 * size, name_clearance * u, 120 * u));
  }
  return places;
}

void draw_markers(Canvas& canvas, double u, const std::vector<Marker>& markers,
                  const std::vector<std::optional<PlotBox>>& places) {
  // Backwards, so that the transmitters, the first of the list, lie on top.
  for (auto marker = markers.rbegin(); marker != markers.rend(); ++marker) {
    marker->transmitter ? draw_transmitter(canvas, marker->at, u) : draw_receiver(canvas, marker->at, u);
  }
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (!places[i]) continue;
    const PlotBox& box = *places[i];
    const PlotPoint at = markers[i].at;
    const PlotPoint near{std::clamp(at.x, box.left, box.right), std::clamp(at.y, box.top, box.bottom)};
    const double away = std::hypot(near.x - at.x, near.y - at.y);
    if (away > 1.5 * name_clearance * u) {  // far from its point: a line shows whose name it is
      const double t = 12 * u / away;
      const PlotPoint from{at.x + t * (near.x - at.x), at.y + t * (near.y - at.y)};
      canvas.line(from, near, white, 4 * u, 0.85);
      canvas.line(from, near, black, 1.5 * u);
    }
  }
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (!places[i]) continue;
    const PlotBox& box = *places[i];
    canvas.text({box.left + 3 * u, (box.top + box.bottom) / 2}, markers[i].name,
                {.size = small_size * u, .bold = markers[i].transmitter, .halo = 3.5 * u});
  }
}

/// `nameless`: markers whose names found no room; `outside`: names of those that lie off the map.
std::vector<LegendEntry> legend_entries(const Plan& plan, const Shown& shown, std::size_t transmitters,
                                        std::size_t receivers, std::size_t nameless,
                                        const std::vector<std::string>& outside, double unit) {
  std::vector<LegendEntry> entries;
  const int w = int(std::lround(40 * unit)), h = int(std::lround(24 * unit));
  const auto corner = [w, h](PlotPoint at) { return std::pair{int(at.x) - w / 2, int(at.y) - h / 2}; };
  const auto outline = [w, h, unit, corner](Canvas& canvas, PlotPoint at) {
    const auto [left, top] = corner(at);
    canvas.frame({double(left), double(top), double(left + w), double(top + h)}, black, 1.5 * unit);
  };
  const auto plain = [=](Colour colour) {
    return [=](Canvas& canvas, PlotPoint at) {
      const auto [left, top] = corner(at);
      canvas.image(left, top, w, std::vector<Colour>(std::size_t(w * h), colour));
      outline(canvas, at);
    };
  };
  if (shown.inside > 0) {
    entries.push_back(
        {"inside a building (" + share_words(shown.inside, plan.grid.size()) + " of the cells)", plain(inside_colour)});
  }
  if (shown.fault > 0) {
    entries.push_back({"not a number: a fault of the program (" + share_words(shown.fault, plan.grid.size()) + ")",
                       plain(fault_colour)});
  }
  if (shown.unreached > 0) {
    entries.push_back(
        {"not reached (" + share_words(shown.unreached, plan.grid.size()) + ")", [=](Canvas& canvas, PlotPoint at) {
           const auto [left, top] = corner(at);
           std::vector<Colour> pixels(std::size_t(w * h));
           paint_unreached(pixels, w, h, int(std::lround(unit)), [](std::size_t) { return true; });
           canvas.image(left, top, w, pixels);
           outline(canvas, at);
         }});
  }
  if (transmitters > 0) {
    entries.push_back(
        {plan.request.kind == WaveKind::radio ? "transmitter" : "source", [unit](Canvas& canvas, PlotPoint at) {
           draw_transmitter(canvas, {at.x, at.y + 3 * unit}, unit);
         }});
  }
  if (receivers > 0) {
    entries.push_back({"receiver", [unit](Canvas& canvas, PlotPoint at) { draw_receiver(canvas, at, unit); }});
  }
  if (nameless > 0) {
    entries.push_back({fmt::format("{} without room for a name", nameless), [unit](Canvas& canvas, PlotPoint at) {
                         canvas.text(at, "…", {.size = body_size * unit, .bold = true}, Align::middle);
                       }});
  }
  if (!outside.empty()) {
    std::string words = "outside the map: ";
    constexpr std::size_t named = 3;
    for (std::size_t i = 0; i < std::min(named, outside.size()); ++i) {
      words += (i > 0 ? ", " : "") + shorten(outside[i], 250 * unit, small_size * unit);
    }
    if (outside.size() > named) words += fmt::format(" and {} more", outside.size() - named);
    entries.push_back({words, [unit](Canvas& canvas, PlotPoint at) {
                         canvas.text(at, "→", {.size = body_size * unit}, Align::middle);
                       }});
  }
  return entries;
}

}  // namespace

ValueRange colour_range(std::span<const double> values) {
  GRIMALDI_EXPECT(!values.empty());
  std::vector<double> sorted(values.begin(), values.end());
  const auto percentile = [&](double p) {
    const auto rank = std::size_t(std::max(1.0, std::ceil(p * double(sorted.size())))) - 1;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(rank), sorted.end());
    return sorted[rank];
  };
  ValueRange range{10 * std::floor(percentile(0.01) / 10), 10 * std::ceil(percentile(0.99) / 10)};
  if (range.high <= range.low) range.high = range.low + 10;
  range.low = std::max(range.low, range.high - 120);
  return range;
}

void draw_transmitter(Canvas& canvas, PlotPoint at, double unit) {
  const double r = 13 * unit;
  const std::array<PlotPoint, 3> corners{
      {{at.x, at.y - r}, {at.x + 0.866 * r, at.y + 0.5 * r}, {at.x - 0.866 * r, at.y + 0.5 * r}}};
  canvas.polygon(corners, black, black, 4.5 * unit);
  canvas.polygon(corners, transmitter_colour, white, 3 * unit);
}

void draw_buildings(Canvas& canvas, const Scene& scene, const MapFrame& frame, double unit) {
  const PlotBox panel{double(frame.left), double(frame.top), double(frame.left + frame.columns),
                      double(frame.top + frame.rows)};
  const double pixels_per_metre = frame.columns / (double(frame.grid.nx) * frame.grid.cell);
  const double wall =
      std::clamp(0.5 * pixels_per_metre, 1.2, 2.4) * unit;  // half a metre thick, as long as that can be seen
  canvas.lines(roof_lines(scene, frame), panel, {35, 35, 35}, 0.6 * wall, 0.6);
  canvas.lines(section(scene, frame), panel, {25, 25, 25}, wall);
}

MapPicture coverage_picture(const Scene& scene, const Plan& plan, const Result& result) {
  GRIMALDI_EXPECT(result.coverage.has_value());
  const ShownQuantity quantity = shown_quantity(plan);
  const Shown shown = shown_cells(plan, *result.coverage, quantity);
  Layout layout = make_layout(scene, plan, result, shown, quantity);
  const double u = layout.unit, size = body_size * u;
  const PlotBox panel = layout.panel();

  std::vector<Marker> markers;
  std::size_t marked[2] = {0, 0};
  std::vector<std::string> outside;
  const auto mark = [&](const Vec3& position, const std::string& name, bool transmitter) {
    if (position.x < layout.x_range.low || position.x > layout.x_range.high || position.y < layout.y_range.low ||
        position.y > layout.y_range.high) {
      outside.push_back(name);
      return;
    }
    markers.push_back({{layout.frame.x(position.x), layout.frame.y(position.y)}, name, transmitter});
    ++marked[transmitter];
  };
  for (const Transmitter& t : plan.request.transmitters) mark(t.position, t.name, true);
  for (const Receiver& r : plan.request.receivers) mark(r.position, r.name, false);

  const auto places = place_names(layout, markers);
  const auto nameless = std::size_t(std::count(places.begin(), places.end(), std::nullopt));
  const std::vector<LegendEntry> legend =
      legend_entries(plan, shown, marked[true], marked[false], nameless, outside, u);
  const auto rows = legend_rows(legend, layout.text_width, u);
  layout.height = int(std::ceil(layout.legend_top + double(rows.size()) * 38 * u + outer_margin * u - 8 * u));

  Canvas canvas(layout.width, layout.height);
  double y = outer_margin * u + 0.4 * title_size * u;
  for (const std::string& line : layout.title) {
    canvas.text({layout.text_left, y}, line, {.size = layout.title_type, .bold = true});
    y += 1.35 * title_size * u;
  }
  for (const std::string& line : layout.subtitle) {
    canvas.text({layout.text_left, y}, line, {.size = size, .colour = {60, 60, 60}});
    y += 1.4 * size;
  }

  draw_cells(canvas, layout, shown);
  draw_buildings(canvas, scene, layout.frame, u);
  canvas.frame({panel.left - u, panel.top - u, panel.right + u, panel.bottom + u}, black, 2 * u);
  draw_x_axis(canvas, panel, layout.x_range, layout.x_ticks, "x, east (m)", size);
  draw_y_axis(canvas, panel, layout.y_range, layout.y_ticks, "y, north (m)", "y (m)", size);
  draw_markers(canvas, u, markers, places);

  if (shown.reached > 0) {
    const PlotBox bar = layout.upright_bar ? PlotBox{panel.right + layout.bar_gap, panel.top,
                                                     panel.right + layout.bar_gap + bar_width * u, panel.bottom}
                                           : PlotBox{layout.text_left, layout.bar_top,
                                                     layout.text_left + std::min(900 * u, layout.text_width),
                                                     layout.bar_top + bar_width * u};
    draw_colour_bar(canvas, bar, shown.scale, quantity.name + " (" + quantity.unit + ")", shown.below, shown.above,
                    size);
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double middle = layout.legend_top + (double(row) + 0.5) * 38 * u;
    for (const auto& [entry, x] : rows[row]) {
      legend[entry].symbol(canvas, {layout.text_left + x + 20 * u, middle});
      canvas.text({layout.text_left + x + 52 * u, middle}, legend[entry].words, {.size = small_size * u});
    }
  }
  return {std::move(canvas), layout.frame, shown.scale};
}

void draw_coverage(const std::filesystem::path& file, const Scene& scene, const Plan& plan, const Result& result) {
  write_text(file, coverage_picture(scene, plan, result).canvas.png());
}

}  // namespace grimaldi
