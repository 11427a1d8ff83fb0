#include "cli/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace grimaldi {
namespace {

// A screen holds these without hiding the result.
constexpr std::size_t most_warnings = 10;

}  // namespace

std::vector<Diagnostic> warnings_of(const Diagnostics& diagnostics) {
  std::vector<Diagnostic> warnings;
  for (const auto& diagnostic : diagnostics.all())
    if (diagnostic.severity == Severity::warning) warnings.push_back(diagnostic);
  return warnings;
}

std::size_t print_warnings(const std::vector<Diagnostic>& warnings, std::size_t shown) {
  const std::size_t end = std::min(warnings.size(), most_warnings);
  for (std::size_t i = shown; i < end; ++i) fmt::print(stderr, "{}\n", to_string(warnings[i]));
  return std::max(shown, end);
}

void print_rest(const std::vector<Diagnostic>& warnings, std::size_t shown, const std::string& where) {
  if (warnings.size() > shown) fmt::print(stderr, "and {} more ({} lists all)\n", warnings.size() - shown, where);
}

}  // namespace grimaldi
