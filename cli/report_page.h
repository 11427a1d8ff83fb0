#pragma once
// report.html: the table of a validation, what it means in plain words, and its figures, in one file.

#include <string>
#include <vector>

#include "cli/figure_picture.h"
#include "validation/cases/case.h"

namespace grimaldi {

/// A figure drawn: the bytes of its PNG.
struct DrawnFigure {
  const Figure* figure = nullptr;
  const Case* subject = nullptr;
  std::string png;
};

/// The page, complete in itself: style and pictures are in it, no script. UTF-8.
std::string report_page(const std::vector<CaseResult>& results, const std::vector<DrawnFigure>& figures,
                        double seconds);

}  // namespace grimaldi
