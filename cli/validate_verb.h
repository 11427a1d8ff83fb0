#pragma once
// `grimaldi validate`: how far the program is from the truth.

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "validation/cases/case.h"

namespace grimaldi {

/// The table for people: cases of one question below one another, error, tolerance, verdict and time of each, then the
/// counts and what missed. Inputs: wall time of the whole, s.
std::string validation_table(const std::vector<CaseResult>& results, double seconds);

/// Exit code of a validation: 0, or 3 if a case misses.
int validation_exit_code(const std::vector<CaseResult>& results);

/// Runs the verb: DIR/validate.json, report.html and its figures as figure-*.png. Returns
/// validation_exit_code; throws InputErrors.
int validate_verb(const Arguments& arguments);

}  // namespace grimaldi
