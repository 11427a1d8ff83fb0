#pragma once
// The list of all cases, and how they are chosen and run.

#include <functional>
#include <string>
#include <vector>

#include "core/contract.h"
#include "validation/cases/case.h"

namespace grimaldi {

/// Every case, suite by suite. Names are unique.
const std::vector<Case>& all_cases();

/// The suites in the order of `all_cases`: the first parts of the names.
std::vector<std::string> suite_names();

/// The cases that `words` name, in the order of `all_cases`, each once; all of them if there is no word. A word names a
/// case by its whole name, or all cases that have it, one part or several in a row, in their names: "extremes",
/// "square", "square/D10". A word that names nothing is an error of `diagnostics` (did you mean).
std::vector<const Case*> select_cases(const std::vector<std::string>& words, Diagnostics& diagnostics);

/// Runs the cases, several at once on `threads` threads (0 = all processors). `ended` is told of each case that has
/// ended, from one thread at a time, in no stated order. The results stand in the order of `cases`.
std::vector<CaseResult> run_cases(const std::vector<const Case*>& cases, unsigned threads,
                                  const std::function<void(const CaseResult&)>& ended = {});

}  // namespace grimaldi
