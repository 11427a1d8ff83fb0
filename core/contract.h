#pragma once
// What a function asks of its caller (EXPECT, ENSURE: checked in debug builds), and what the program
// says to people about their input (Diagnostic: where, what, why, what to do).
//
// Readers append to a Diagnostics and go on as far as they can, so that all faults of an input are
// reported at once; `throw_if_errors` ends the reading with one InputErrors that carries the list.

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace grimaldi {

enum class Severity { warning, error };

/// One message to a person. Empty fields are left out of the text.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string file;        ///< the file at fault, as the user wrote it
  int line = 0;            ///< 1-based; 0 = no line
  std::string option;      ///< the option or key at fault, e.g. "coverage.cell_size" or "--tx"
  std::string problem;     ///< what is wrong, e.g. "unknown key"
  std::string why;         ///< why it is wrong, e.g. "a distance is needed here, 5GHz is a frequency"
  std::string suggestion;  ///< what to do, e.g. "did you mean cell_size?"
};

/// "error: city.toml:12: coverage.cell_size: PROBLEM (WHY); SUGGESTION". One line, no trailing newline.
std::string to_string(const Diagnostic& diagnostic);

/// An error that carries every fault found in the input. what() = the messages, one per line.
class InputErrors : public std::runtime_error {
 public:
  explicit InputErrors(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// The list that readers append to.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic) { list_.push_back(std::move(diagnostic)); }
  /// The same with severity error or warning and the fields in the order of the struct.
  void error(std::string file, int line, std::string option, std::string problem, std::string why = {},
             std::string suggestion = {});
  void warning(std::string file, int line, std::string option, std::string problem, std::string why = {},
               std::string suggestion = {});
  bool has_errors() const;
  const std::vector<Diagnostic>& all() const { return list_; }
  /// Throws InputErrors with all errors (not the warnings) if there is one.
  void throw_if_errors() const;

 private:
  std::vector<Diagnostic> list_;
};

/// Throws InputErrors with this one error.
[[noreturn]] void input_error(std::string file, int line, std::string option, std::string problem, std::string why = {},
                              std::string suggestion = {});

/// The member of `candidates` nearest to `word` by edit distance (Damerau-Levenshtein, case-insensitive) if it is
/// near enough to be a slip (at most a third of the letters), as "did you mean X?"; else "known: A, B, C" (at most 20).
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// Prints the broken condition with its place to stderr and aborts.
[[noreturn]] void contract_violation(const char* kind, const char* condition, const char* file, int line);

}  // namespace grimaldi

#ifdef NDEBUG
#define GRIMALDI_EXPECT(condition) static_cast<void>(0)
#define GRIMALDI_ENSURE(condition) static_cast<void>(0)
#else
#define GRIMALDI_EXPECT(condition) \
  ((condition) ? static_cast<void>(0) : ::grimaldi::contract_violation("EXPECT", #condition, __FILE__, __LINE__))
#define GRIMALDI_ENSURE(condition) \
  ((condition) ? static_cast<void>(0) : ::grimaldi::contract_violation("ENSURE", #condition, __FILE__, __LINE__))
#endif
