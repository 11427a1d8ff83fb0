#include "core/contract.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdio>

namespace grimaldi {
namespace {

// A message stays on one line whatever the user's names hold: control characters become blanks. Bytes of UTF-8 stay.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = ' ';
  }
  return text;
}

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(d);
  }
  return text;
}

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Damerau-Levenshtein distance in the form of the optimal string alignment: insert, delete, replace, swap of neighbours
// cost 1 each. Source: Boytsov, "Indexing methods for approximate dictionary searching", ACM JEA 16 (2011),
// section 2.2.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.severity == Severity::error ? "error: " : "warning: ";
  if (!diagnostic.file.empty()) {
    text += diagnostic.file;
    if (diagnostic.line > 0) text += ":" + std::to_string(diagnostic.line);
    text += ": ";
  } else if (diagnostic.line > 0) {
    text += "line " + std::to_string(diagnostic.line) + ": ";
  }
  if (!diagnostic.option.empty()) text += diagnostic.option + ": ";
  text += diagnostic.problem;
  if (!diagnostic.why.empty()) text += " (" + diagnostic.why + ")";
  if (!diagnostic.suggestion.empty()) text += "; " + diagnostic.suggestion;
  return on_one_line(std::move(text));
}

InputErrors::InputErrors(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

void Diagnostics::error(std::string file, int line, std::string option, std::string problem, std::string why,
                        std::string suggestion) {
  add({Severity::error, std::move(file), line, std::move(option), std::move(problem), std::move(why),
       std::move(suggestion)});
}

void Diagnostics::warning(std::string file, int line, std::string option, std::string problem, std::string why,
                          std::string suggestion) {
  add({Severity::warning, std::move(file), line, std::move(option), std::move(problem), std::move(why),
       std::move(suggestion)});
}

bool Diagnostics::has_errors() const {
  return std::any_of(list_.begin(), list_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
}

void Diagnostics::throw_if_errors() const {
  std::vector<Diagnostic> errors;
  for (const Diagnostic& d : list_)
    if (d.severity == Severity::error) errors.push_back(d);
  if (!errors.empty()) throw InputErrors(std::move(errors));
}

void input_error(std::string file, int line, std::string option, std::string problem, std::string why,
                 std::string suggestion) {
  throw InputErrors({{Severity::error, std::move(file), line, std::move(option), std::move(problem), std::move(why),
                      std::move(suggestion)}});
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string* nearest = nullptr;
  std::size_t smallest = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t shorter = std::min(word.size(), candidate.size());
    if (3 * (longer - shorter) > longer) continue;  // the distance is at least the difference of the lengths
    const std::size_t distance = edit_distance(word, candidate);
    if (3 * distance <= longer && (nearest == nullptr || distance < smallest)) {
      nearest = &candidate;
      smallest = distance;
    }
  }
  if (nearest != nullptr) return "did you mean " + *nearest + "?";
  if (candidates.empty()) return {};
  constexpr std::size_t most = 20;
  std::string text = "known: ";
  for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i) text += (i > 0 ? ", " : "") + candidates[i];
  if (candidates.size() > most) text += ", and " + std::to_string(candidates.size() - most) + " more";
  return text;
}

void contract_violation(const char* kind, const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: %s(%s) does not hold: a fault of the program, not of its input\n", file, line, kind,
               condition);
  std::fflush(stderr);
  std::abort();
}

}  // namespace grimaldi
