#pragma once
// What a case has to show: numbers for a diagram, not yet drawn.

#include <string>
#include <variant>
#include <vector>

namespace grimaldi {

/// A line through points; NaN in y breaks it.
struct Curve {
  std::string name;
  std::vector<double> x, y;  ///< of one length
};

/// Curves over one abscissa.
struct LineChart {
  std::string title, x_name, y_name;
  std::vector<Curve> curves;  ///< the truth first: drawn below the others, wide and grey
  double low = 0, high = 1;   ///< of the y axis; what lies outside is cut off
  bool decades = false;       ///< x = lg of what the axis tells
};

/// Values over a rectangle.
struct Raster {
  std::string name;
  std::size_t columns = 0;
  std::vector<double> values;  ///< rows from the bottom; NaN: nothing is known there
};

/// Rasters of one extent on one scale, side by side.
struct RasterRow {
  std::string title, x_name, y_name, scale_name;
  std::vector<Raster> panels;
  double left = 0, right = 1, bottom = 0, top = 1;  ///< the extent
  double low = 0, high = 1;                         ///< ends of the colours
  bool x_decades = false, y_decades = false;        ///< the axis is the lg of what it tells
};

struct Figure {
  std::string file;     ///< name without folder and ending, [a-z0-9-]
  std::string caption;  ///< what it shows, in plain words
  std::variant<LineChart, RasterRow> drawing;
};

}  // namespace grimaldi
