#pragma once
// A case of the validation: a question to which the truth is known, and how near to it the program must come.

#include <functional>
#include <string>
#include <vector>

#include "validation/cases/figure.h"

namespace grimaldi {

/// What a case measured.
struct Outcome {
  double error = 0;             ///< ≥ 0, in the unit of the case; anything not finite is a miss
  std::string note;             ///< what else was seen, in plain words; may be empty
  std::vector<Figure> figures;  ///< for the report
};

struct Case {
  /// Parts between slashes, [A-Za-z0-9.-]: the suite first, e.g. apertures/square/D10/N0.1/fsd.
  std::string name;
  std::string quantity;   ///< what is compared, and by which measure
  std::string reference;  ///< with what
  std::string unit;       ///< of error and tolerance: "dB", or "1" for a number without unit
  double tolerance = 0;   ///< the error may not exceed it
  std::string reason;     ///< why this much
  /// The error may not fall below this either: > 0 where a theory fails by nature and its failure is recorded as a
  /// fact. Such a case misses when the theory, or the measure, is not what it was.
  double at_least = 0;
  /// One thread. May throw: a miss, told by what().
  std::function<Outcome()> run;
};

/// One case that was run.
struct CaseResult {
  const Case* subject = nullptr;
  Outcome outcome;
  bool passed = false;
  double seconds = 0;  ///< wall time
};

/// Whether `error` lies in [at_least, tolerance].
bool within_tolerance(const Case& subject, double error);

/// −lg of an error without unit, at most 17; what a table calls correct digits.
double correct_digits(double error);

}  // namespace grimaldi
