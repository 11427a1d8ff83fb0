#pragma once
// `grimaldi eval`: one kernel over the rows of a table.

#include <string>

#include "cli/arguments.h"
#include "cli/csv_rows.h"
#include "cli/eval_function.h"

namespace grimaldi {

/// Every function, those of the references too, in the order of `--list`.
const std::vector<EvalFunction>& eval_functions();

/// The table with the function's outputs behind the columns of `input`; a column of theirs that has the name of an
/// output is renamed in_NAME. Faults of the table to `diagnostics` (column missing, field not a number, out of range;
/// at most ten rows of them and the count of the others), then the result is not complete. Warnings: a formula outside
/// its stated range.
CsvRows evaluate_rows(const EvalFunction& function, const CsvRows& input, Diagnostics& diagnostics);

/// Runs the verb. Returns 0; throws InputErrors.
int eval_verb(const Arguments& arguments);

}  // namespace grimaldi
