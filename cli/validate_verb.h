#pragma once
// `grimaldi validate`: how far the program is from the truth.

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "validation/cases/case.h"

namespace grimaldi {

/// The table for people: cases of one question below one another, error, tolerance, verdict and time of each, then the
/// counts.
std::string validation_table(const std::vector<CaseResult>& results, double seconds);

/// validate.json: `cases` [{name, suite, quantity, reference, error, unit, tolerance, at_least, reason, passed,
/// seconds, note, digits}], `passed`, `failed`, `seconds`. An error that is not finite is null; digits only for errors
/// without unit.
std::string validation_json(const std::vector<CaseResult>& results, double seconds);

/// Runs the verb: DIR/validate.json, report.html and the figures as PNG. Returns 0, or 3 if a case misses; throws
/// InputErrors.
int validate_verb(const Arguments& arguments);

}  // namespace grimaldi
