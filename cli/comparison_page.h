#pragma once
// What a comparison says in plain words, and its report page.

#include <string>
#include <vector>

#include "cli/comparison.h"

namespace grimaldi {

/// Where the two theories disagree, by how much, and which one to believe: a paragraph each, with the numbers of this
/// run.
std::vector<std::string> comparison_words(const Plan& plan, const Comparison& comparison, const Result& fsd,
                                          const Result& utd);

/// The bytes of the pictures of a comparison, PNG.
struct ComparisonPictures {
  std::string difference, fsd, utd;
};

/// report.html, complete in itself: style and pictures are in it, no script. UTF-8.
std::string comparison_page(const Scene& scene, const Plan& plan, const Comparison& comparison, const Result& fsd,
                            const Result& utd, const ComparisonPictures& pictures);

}  // namespace grimaldi
