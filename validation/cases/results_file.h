#pragma once
// validate.json.

#include <string>
#include <vector>

#include "validation/cases/case.h"

namespace grimaldi {

/// The text (UTF-8, one object): `cases` [{name, suite, quantity, reference, error, unit, tolerance, at_least, reason,
/// passed, seconds, note, digits}], `passed`, `failed`, `seconds`. An error that is not finite is null; digits only for
/// errors without unit. Inputs: wall time of the whole, s.
std::string results_json(const std::vector<CaseResult>& results, double seconds);

}  // namespace grimaldi
