#pragma once
// What the program tells people on stderr.

#include <string>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

/// The warnings among `diagnostics`, in their order.
std::vector<Diagnostic> warnings_of(const Diagnostics& diagnostics);

/// Prints warnings from number `shown` on, at most ten in all over the calls of a run; returns how many of `warnings`
/// are printed.
std::size_t print_warnings(const std::vector<Diagnostic>& warnings, std::size_t shown);

/// "and N more (WHERE lists all)" if not all of `warnings` were printed.
void print_rest(const std::vector<Diagnostic>& warnings, std::size_t shown, const std::string& where);

}  // namespace grimaldi
