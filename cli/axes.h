#pragma once
// What a diagram is made of: round ticks, axes, a colour scale and its bar, labels that do not cover one another.

#include <optional>
#include <string>
#include <vector>

#include "cli/plot.h"

namespace grimaldi {

/// Sizes of type, px, for a picture about 1600 px wide.
inline constexpr double title_size = 27, body_size = 22, small_size = 19;

struct ValueRange {
  double low = 0, high = 1;
};

/// Multiples of a round step (1, 2 or 5 times a power of ten).
struct Ticks {
  double step = 1;
  std::vector<double> at;  ///< ascending, each the nearest double to the decimal number that it stands for
};

/// The finest round ticks in [range.low, range.high] of which there are at most `most`.
/// Requires finite low < high with a distance that doubles resolve (high − low > 1e-12·max(|low|, |high|)), and most
/// ≥ 1.
Ticks round_ticks(const ValueRange& range, int most);

/// `value` with `decimals` decimals, a true minus sign (U+2212) and, from five digits before the point on, thin spaces
/// between thousands. −0 is written as 0.
std::string number_text(double value, int decimals);

/// The label of a tick: as many decimals as the step needs.
std::string tick_text(double value, double step);

/// The colour of `value` on the scale "viridis" stretched over `range`; values outside take the colour of the end.
/// Source: S. van der Walt and N. Smith, matplotlib's colour map viridis, released under CC0; every 17th of its 256
/// entries. Requires low < high, value not NaN.   Error: at most 7 of 255 in any channel against the full table.
Colour colour_of(double value, const ValueRange& range);

/// The colour of `value` on a scale that diverges from the middle of `range`: blue below, near white, red above.
/// Source: C. Brewer, ColorBrewer 2.0, scheme RdBu of 11 classes (safe for the colour-blind). Requires low < high,
/// value not NaN.
Colour diverging_colour_of(double value, const ValueRange& range);

using ColourScale = Colour (*)(double value, const ValueRange& range);

/// Ticks along `length` px whose labels of size `size` px do not touch; labels stand side by side (x axis) or above one
/// another (y axis).
Ticks axis_ticks(const ValueRange& range, double length, double size, bool side_by_side);

/// Width that draw_y_axis needs left of the panel, px.
double y_axis_width(const Ticks& ticks, double size);
/// Height that draw_x_axis needs below the panel, px.
double x_axis_height(double size);

/// Ticks, their labels and the axis's name, outside `panel`. Where `name` is longer than the y axis its short form
/// stands, or nothing.
void draw_x_axis(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const Ticks& ticks,
                 const std::string& name, double size);
void draw_y_axis(Canvas& canvas, const PlotBox& panel, const ValueRange& range, const Ticks& ticks,
                 const std::string& name, const std::string& short_name, double size);

/// A bar of the scale `colours` with ticks and a name: upright (ticks to its right) if it is higher than wide, else
/// lying (ticks below). `below` and `above` add a point at an end: there are values beyond it. The points lie within
/// `bar`.
void draw_colour_bar(Canvas& canvas, const PlotBox& bar, const ValueRange& range, const std::string& name, bool below,
                     bool above, double size, ColourScale colours = colour_of);
/// Width that an upright bar needs right of itself for ticks and name, px.
double colour_bar_margin(const ValueRange& range, double length, double size);

/// Finds room for labels beside their points.
class LabelPlacer {
 public:
  /// Labels lie within `room`.
  explicit LabelPlacer(const PlotBox& room) : room_(room) {}
  /// Keeps labels off `box`.
  void keep_off(const PlotBox& box) { taken_.push_back(box); }
  /// The place nearest to `point` for a label of that size: right, left, above, below, then the diagonals, then further
  /// away, up to `reach` px; nothing if all are taken. `clearance`: distance from the point, px. The place is kept off
  /// from then on.
  std::optional<PlotBox> place(PlotPoint point, double width, double height, double clearance, double reach);

 private:
  PlotBox room_;
  std::vector<PlotBox> taken_;
};

}  // namespace grimaldi
