#pragma once
// The functions of `grimaldi eval`: each one kernel over the rows of a table.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/contract.h"

namespace grimaldi {

/// A column that a function reads.
struct EvalInput {
  enum class Kind {
    number,  ///< 0.25, 1e-3
    ratio,   ///< a number, or 3/2
    text
  };
  std::string name, meaning;
  Kind kind = Kind::number;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool above_low = false;  ///< low itself does not belong to the range
  /// Where the source of the formula states it; a warning outside.
  double stated_low = -std::numeric_limits<double>::infinity(), stated_high = std::numeric_limits<double>::infinity();
};

/// One row, its fields read and within their ranges; in the order of the function's inputs.
class EvalRow {
 public:
  struct Value {
    double number = 0, numerator = 0, denominator = 1;  ///< number = numerator/denominator
    std::string text;
  };
  EvalRow(const std::vector<EvalInput>& inputs, std::vector<Value> values, Diagnostics& faults)
      : inputs_(inputs), values_(std::move(values)), faults_(faults) {}

  double number(std::size_t input) const { return values_[input].number; }
  const std::string& text(std::size_t input) const { return values_[input].text; }
  /// The ratio times `unit` with one rounding: 5/3 · 180 is 300.
  double times(std::size_t input, double unit) const {
    return unit * values_[input].numerator / values_[input].denominator;
  }
  const EvalInput& input(std::size_t i) const { return inputs_[i]; }

  /// A fault of this row that shows only with its other fields; the row then has no result. An error without file and
  /// line, the column as its option.
  void fault(std::size_t input, std::string problem, std::string why, std::string suggestion) const {
    faults_.error("", 0, inputs_[input].name, std::move(problem), std::move(why), std::move(suggestion));
  }
  /// Where a kernel writes its own warnings and errors.
  Diagnostics& diagnostics() const { return faults_; }

 private:
  const std::vector<EvalInput>& inputs_;
  std::vector<Value> values_;
  Diagnostics& faults_;
};

struct EvalFunction {
  std::string name, summary;
  std::vector<EvalInput> inputs;
  std::vector<std::string> outputs;
  std::string remarks;  ///< conventions, for `--help`
  /// The outputs in their order, or nothing if a fault was reported.
  std::function<std::vector<double>(const EvalRow&)> evaluate;
};

/// Those that evaluate the engine's own kernels.
std::vector<EvalFunction> kernel_functions();

/// Those that evaluate the references that the kernels are checked with.
std::vector<EvalFunction> reference_functions();

}  // namespace grimaldi
