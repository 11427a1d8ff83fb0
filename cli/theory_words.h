#pragma once
// What a validation says in plain words.

#include <string>
#include <vector>

#include "validation/cases/case.h"

namespace grimaldi {

/// Where each theory is good and where it fails, a paragraph each, with the numbers of this run (those of cases that
/// were not run are left out).
std::vector<std::string> theory_words(const std::vector<CaseResult>& results);

/// What a suite is about, one paragraph; empty for a name that is none.
std::string suite_words(const std::string& suite);

}  // namespace grimaldi
