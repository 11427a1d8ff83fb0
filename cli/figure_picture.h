#pragma once
// The figures of a validation as pictures.

#include "cli/plot.h"
#include "validation/cases/figure.h"

namespace grimaldi {

/// Draws a figure, 1600 px wide: curves with axes and a legend, or rasters side by side with one colour bar.
Canvas figure_picture(const Figure& figure);

}  // namespace grimaldi
