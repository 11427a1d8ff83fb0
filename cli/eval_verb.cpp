#include "cli/eval_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>

#include "cli/messages.h"
#include "scenes/file_contents.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;

/// Rows whose faults are told one by one; a faulty file is faulty in every row as a rule.
constexpr std::size_t most_faulty_rows = 10;

std::string range_of(double low, double high, bool above_low = false) {
  if (std::isinf(low) && std::isinf(high)) return "any finite number";
  if (std::isinf(high)) return fmt::format("{} {:g}", above_low ? "above" : "at least", low);
  if (std::isinf(low)) return fmt::format("at most {:g}", high);
  return fmt::format("{}{:g} ... {:g}", above_low ? "above " : "", low, high);
}

std::string kind_of(const EvalInput& input) {
  if (input.kind == EvalInput::Kind::text) return "text";
  const std::string range = range_of(input.low, input.high, input.above_low);
  return input.kind == EvalInput::Kind::ratio ? range + " (3/2 is a number too)" : range;
}

/// The whole of `text` as a finite number.
bool read_number(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, value);
  return fault == std::errc() && rest == end && std::isfinite(value);
}

/// Reads one field; false with a fault.
bool read_field(const EvalInput& input, const std::string& text, EvalRow::Value& value, Diagnostics& faults) {
  value.text = text;
  const auto refuse = [&](const std::string& problem, const std::string& why) {
    faults.error("", 0, input.name, problem, why, fmt::format("write a number: {}", kind_of(input)));
    return false;
  };
  if (text.empty()) {
    faults.error("", 0, input.name, "an empty field", fmt::format("{} needs {}", input.name, input.meaning),
                 "fill it, or take the row away");
    return false;
  }
  if (input.kind == EvalInput::Kind::text) return true;
  const std::size_t slash = input.kind == EvalInput::Kind::ratio ? text.find('/') : std::string::npos;
  if (slash == std::string::npos) {
    if (!read_number(text, value.numerator)) {
      const char* digits = "0123456789";
      const bool unit = std::isdigit(static_cast<unsigned char>(text.front())) != 0 && text.find_first_of(digits) == 0;
      return refuse(fmt::format("\"{}\" is not a finite number", text),
                    unit ? "units stand in the name of the column, not in its fields" : input.meaning);
    }
  } else {
    const std::string_view whole = text;
    if (!read_number(whole.substr(0, slash), value.numerator) ||
        !read_number(whole.substr(slash + 1), value.denominator) || value.denominator == 0)
      return refuse(fmt::format("\"{}\" is not a ratio of two numbers", text), input.meaning);
  }
  value.number = value.numerator / value.denominator;
  const bool low = input.above_low ? value.number <= input.low : value.number < input.low;
  if (low || value.number > input.high || !std::isfinite(value.number))
    return refuse(fmt::format("{} is out of range", text), input.meaning);
  return true;
}

/// Puts in_ before `name`, and before the column that has that name already.
void rename_column(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return;
  rename_column(names, "in_" + name);
  *found = "in_" + name;
}

std::vector<std::string> output_names(const EvalFunction& function, const CsvRows& input) {
  std::vector<std::string> names = input.names;
  for (const std::string& output : function.outputs) rename_column(names, output);
  names.insert(names.end(), function.outputs.begin(), function.outputs.end());
  return names;
}

/// The columns of the function's inputs; faults for those that are missing.
std::vector<std::size_t> find_columns(const EvalFunction& function, const CsvRows& input, Diagnostics& diagnostics) {
  std::vector<std::size_t> columns;
  for (const EvalInput& needed : function.inputs) {
    const auto column = input.column(needed.name);
    if (column)
      columns.push_back(*column);
    else
      diagnostics.error(input.file, input.names_line, needed.name, "no such column",
                        fmt::format("{} needs it: {}", function.name, needed.meaning),
                        did_you_mean(needed.name, input.names));
  }
  return columns;
}

std::string function_help(const EvalFunction& function) {
  std::string text =
      fmt::format("grimaldi eval {0}: {1}\n\n  grimaldi eval {0} --in ROWS.csv --out ROWS.csv\n\nReads\n",
                  function.name, function.summary);
  for (const EvalInput& input : function.inputs)
    text += fmt::format("  {:<22}{}; {}\n", input.name, input.meaning, kind_of(input));
  text += fmt::format("Adds\n  {}\n\n{}\n", fmt::join(function.outputs, ", "), function.remarks);
  text +=
      "\nTime exp(+j omega t) unless said otherwise. Columns by name, in any order; others are carried through, and "
      "one\n"
      "that has the name of an output is renamed in_NAME. Lines that begin with # are dropped. - is stdin or stdout.\n"
      "Numbers have 17 digits.\n";
  return text;
}

std::string function_list() {
  std::string text;
  for (const EvalFunction& function : eval_functions())
    text += fmt::format("{:<24}{}\n", function.name, function.summary);
  return text;
}

const EvalFunction& find_function(const std::string& name) {
  std::vector<std::string> known;
  for (const EvalFunction& function : eval_functions()) {
    if (function.name == name) return function;
    known.push_back(function.name);
  }
  if (name.empty()) input_error("", 0, "eval", "no function given", "", "name one; grimaldi eval --list names all");
  input_error("", 0, "eval " + name, "unknown function", "", did_you_mean(name, known));
}

CsvRows read_input(const std::string& name, Diagnostics& diagnostics) {
  const auto all_of = [](std::istream& stream) { return std::string{std::istreambuf_iterator<char>(stream), {}}; };
  if (name == "-") return read_csv(all_of(std::cin), "stdin", diagnostics);
  std::error_code fault;
  if (fs::is_fifo(name, fault) || fs::is_character_file(name, fault)) {  // <(…), /dev/stdin
    std::ifstream stream(name, std::ios::binary);
    return read_csv(all_of(stream), name, diagnostics);
  }
  const std::optional<std::string> text = read_file_contents(name, diagnostics);
  return text ? read_csv(*text, name, diagnostics) : CsvRows{};
}

/// Writes under a temporary name beside the final one, then renames: a file of that name is whole or not there.
void write_output(const std::string& name, const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    input_error(name, 0, "--out", "cannot be written", why, "choose another file, or - for stdout");
  };
  if (name == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  std::error_code fault;
  if (fs::is_directory(name, fault)) refuse("it is a folder");
  // What is no file of its own is written in place: a device, a pipe, and what stands under /dev and /proc.
  const std::string whole = fs::absolute(name, fault).lexically_normal().string();
  const bool device = whole.rfind("/dev/", 0) == 0 || whole.rfind("/proc/", 0) == 0 ||
                      (fs::exists(name, fault) && !fs::is_regular_file(name, fault));
  // A link stays a link: the file that it names is replaced.
  fs::path target = name;
  if (!device && fs::is_symlink(fs::symlink_status(name, fault))) {
    target = fs::weakly_canonical(name, fault);
    if (fault || fs::is_symlink(fs::symlink_status(target, fault))) refuse("it is a link that leads nowhere");
  }
  const std::string written = device ? name : fmt::format("{}.{}.partial", target.string(), getpid());
  std::ofstream stream(written, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    const bool folder_there = target.has_parent_path() ? fs::is_directory(target.parent_path(), fault) : true;
    if (!device) fs::remove(written, fault);
    refuse(folder_there ? "no permission, or the disk is full" : "its folder is not there");
  }
  if (device) return;
  fs::rename(written, target, fault);
  if (fault) {
    const std::string why = fault.message();
    fs::remove(written, fault);
    refuse(why);
  }
}

}  // namespace

const std::vector<EvalFunction>& eval_functions() {
  static const std::vector<EvalFunction> functions = [] {
    std::vector<EvalFunction> list = kernel_functions();
    for (EvalFunction& function : reference_functions()) list.push_back(std::move(function));
    return list;
  }();
  return functions;
}

CsvRows evaluate_rows(const EvalFunction& function, const CsvRows& input, Diagnostics& diagnostics) {
  CsvRows output;
  output.file = input.file;
  const std::vector<std::size_t> columns = find_columns(function, input, diagnostics);
  if (columns.size() != function.inputs.size()) return output;
  output.names = output_names(function, input);
  std::size_t faulty = 0;
  std::set<std::string> warned;
  for (std::size_t r = 0; r < input.rows.size(); ++r) {
    Diagnostics faults;
    std::vector<EvalRow::Value> values(columns.size());
    bool readable = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const EvalInput& needed = function.inputs[i];
      readable &= read_field(needed, input.rows[r][columns[i]], values[i], faults);
      const double number = values[i].number;
      if (readable && needed.kind != EvalInput::Kind::text &&
          (number < needed.stated_low || number > needed.stated_high))
        faults.warning("", 0, needed.name, fmt::format("{:g} lies outside the range that the formula states", number),
                       range_of(needed.stated_low, needed.stated_high), "the formula is used as it is");
    }
    std::vector<double> results;
    try {
      if (readable) results = function.evaluate(EvalRow(function.inputs, values, faults));
    } catch (const InputErrors& errors) {
      for (const Diagnostic& error : errors.diagnostics()) faults.add(error);
    }
    if (readable && !faults.has_errors())
      for (const double result : results)
        if (!std::isfinite(result)) {
          faults.error("", 0, function.inputs[0].name, "no finite result",
                       "the numbers of this row lead beyond all bounds", "check the row");
          break;
        }
    for (Diagnostic fault : faults.all()) {
      fault.file = input.file, fault.line = input.lines[r];
      // One warning for each column is enough; errors all count.
      if (fault.severity == Severity::error ? faulty < most_faulty_rows : warned.insert(fault.option).second)
        diagnostics.add(fault);
    }
    faulty += faults.has_errors();
    if (faulty > 0) continue;
    std::vector<std::string> fields = input.rows[r];
    for (const double result : results) fields.push_back(csv_number(result));
    output.rows.push_back(std::move(fields));
    output.lines.push_back(input.lines[r]);
  }
  if (faulty > most_faulty_rows)
    diagnostics.error(input.file, 0, "", fmt::format("{} more rows have faults", faulty - most_faulty_rows), "",
                      "mend the rows above first");
  return output;
}

int eval_verb(const Arguments& arguments) {
  if (arguments.list) {
    fmt::print("{}", function_list());
    return 0;
  }
  const EvalFunction& function = find_function(arguments.input);
  if (arguments.help) {
    fmt::print("{}", function_help(function));
    return 0;
  }
  Diagnostics diagnostics;
  const CsvRows input = read_input(arguments.rows_in, diagnostics);
  diagnostics.throw_if_errors();
  const CsvRows output = evaluate_rows(function, input, diagnostics);
  diagnostics.throw_if_errors();
  const std::vector<Diagnostic> warnings = warnings_of(diagnostics);
  if (!arguments.quiet) print_warnings(warnings, 0);
  std::string text = csv_line(output.names);
  for (const auto& row : output.rows) text += csv_line(row);
  write_output(arguments.rows_out, text);
  return 0;
}

}  // namespace grimaldi
