#pragma once
// coverage.png: the map as a planner would put it into a report.

#include <cstddef>
#include <filesystem>
#include <span>

#include "cli/axes.h"
#include "cli/plot.h"
#include "propagation/plan.h"
#include "propagation/result.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Fill of cells wholly inside a solid (path_gain NaN).
inline constexpr Colour inside_colour{150, 150, 150};
/// Fill of cells that are not wholly inside a solid and have no number all the same: a fault of the program, never
/// hidden.
inline constexpr Colour fault_colour{230, 0, 200};
/// Cells asked but not reached are white with diagonal lines of this colour.
inline constexpr Colour unreached_colour = white, unreached_hatch_colour{190, 190, 190};

/// Where the cells of a map lie on its picture. A cell is a square of a whole number of pixels as long as the picture
/// stays below 3,000 px; of larger grids each pixel shows the cell at its centre.
struct MapFrame {
  int left = 0, top = 0, columns = 0, rows = 0;  ///< the panel, px
  GridLayout grid;
  double x(double east) const { return left + columns * (east - grid.x0) / (double(grid.nx) * grid.cell); }
  double y(double north) const { return top + rows - rows * (north - grid.y0) / (double(grid.ny) * grid.cell); }
  /// Index of the cell shown at pixel (column, row) of the panel, row 0 at the top (north).
  std::size_t cell_at(int column, int row) const {
    const auto ix = std::size_t((column + 0.5) / columns * double(grid.nx));
    const auto iy = std::size_t((rows - row - 0.5) / rows * double(grid.ny));
    return iy * grid.nx + ix;
  }
};

/// Buildings on a map: what the plane of the receivers cuts, and the wedges above it. `unit`: scale of lines.
void draw_buildings(Canvas& canvas, const Scene& scene, const MapFrame& frame, double unit);
/// The triangle that marks a transmitter.
void draw_transmitter(Canvas& canvas, PlotPoint at, double unit);

struct MapPicture {
  Canvas canvas;
  MapFrame frame;
  ValueRange scale;  ///< of the colours, dB; meaningless if no cell was reached
};

/// 1st to 99th percentile (nearest rank) of `values`, rounded outwards to 10, at least 10 and at most 120 wide (the
/// lower end gives way). Requires at least one value; all finite.
ValueRange colour_range(std::span<const double> values);

/// Draws the coverage of the sum over transmitters at the first band: path gain in dB (radio) or sound pressure level
/// (sound) on the scale of `colour_of` over `colour_range` of the reached cells, colour bar with round steps in dB,
/// axes in metres with round ticks, north up, equal aspect. Buildings: what the plane of the receivers cuts (dark
/// lines) and the wedges above it (thin lines: roof edges and ridges); cells wholly inside a solid in one neutral grey.
/// Cells asked but not reached are hatched. Transmitters are triangles with names, receivers discs with names; a legend
/// says so and counts. A title of two lines or more says scene, frequency, transmitter(s), mechanisms, model, depth,
/// rays, cell size and height. Requires result.coverage with the shapes of `plan`.
MapPicture coverage_picture(const Scene& scene, const Plan& plan, const Result& result);

/// Writes coverage_picture to `file` as PNG under a temporary name and renames. Throws InputErrors if it cannot be
/// written.
void draw_coverage(const std::filesystem::path& file, const Scene& scene, const Plan& plan, const Result& result);

}  // namespace grimaldi
