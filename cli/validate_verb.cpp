#include "cli/validate_verb.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "cli/output_folder.h"
#include "cli/progress.h"
#include "cli/report_page.h"
#include "cli/theory_words.h"
#include "propagation/result_file.h"
#include "validation/cases/results_file.h"
#include "validation/cases/suite.h"

namespace grimaldi {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Error and bound of a case as a table tells them.
std::string error_text(const CaseResult& result) {
  const Case& subject = *result.subject;
  const std::string unit = subject.unit == "1" ? "" : " " + subject.unit;
  const std::string bound = subject.at_least > 0
                                ? fmt::format("{:.2g} ... {:.2g}{}", subject.at_least, subject.tolerance, unit)
                                : fmt::format("{:.2g}{}", subject.tolerance, unit);
  return fmt::format("{:>10}{:<3} {:<16}", fmt::format("{:.3g}", result.outcome.error), unit, bound);
}

std::string list_text(const std::vector<const Case*>& cases) {
  std::string text;
  for (const Case* one : cases) text += fmt::format("{:<44} {}\n", one->name, one->quantity);
  return text;
}

/// Lines of at most `width` bytes, cut at blanks.
std::string wrapped(const std::string& text, std::size_t width) {
  std::string out, line;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    from = to + 1;
  }
  return out + line + "\n";
}

/// The figures, drawn, with names that are unique in the folder.
std::vector<DrawnFigure> drawn(const std::vector<CaseResult>& results) {
  std::vector<DrawnFigure> figures;
  for (const CaseResult& result : results)
    for (const Figure& figure : result.outcome.figures)
      figures.push_back({&figure, result.subject, figure_picture(figure).png()});
  return figures;
}

std::string file_of(const Figure& figure) { return "figure-" + figure.file + ".png"; }

void remove_old_figures(const fs::path& folder, const std::vector<DrawnFigure>& figures) {
  std::error_code fault;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, fault)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name.starts_with("figure-") && name.ends_with(".png");
    if (ours && std::none_of(figures.begin(), figures.end(), [&](const auto& f) { return file_of(*f.figure) == name; }))
      old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file, fault);
}

}  // namespace

std::string validation_table(const std::vector<CaseResult>& results, double seconds) {
  std::string text;
  const Case* before = nullptr;
  for (const CaseResult& result : results) {
    const Case& subject = *result.subject;
    if (before == nullptr || before->quantity != subject.quantity || before->reference != subject.reference)
      text += fmt::format("{}{}\n  against: {}\n", before ? "\n" : "", subject.quantity, subject.reference);
    text += fmt::format("  {} {:<44}{}{:>7.2f} s\n", result.passed ? "pass" : "MISS", subject.name, error_text(result),
                        result.seconds);
    before = &subject;
  }
  const auto passed = std::count_if(results.begin(), results.end(), [](const CaseResult& r) { return r.passed; });
  const auto missed = std::ptrdiff_t(results.size()) - passed;
  if (missed > 0) text += "\nMissed:\n";
  for (const CaseResult& result : results)
    if (!result.passed)
      text += fmt::format("  {}: error {:.3g}, allowed {:.3g}{} ({}){}\n", result.subject->name, result.outcome.error,
                          result.subject->tolerance, result.subject->unit == "1" ? "" : " " + result.subject->unit,
                          result.subject->reason, result.outcome.note.empty() ? "" : "; " + result.outcome.note);
  const auto facts = std::count_if(results.begin(), results.end(),
                                   [](const CaseResult& result) { return result.subject->at_least > 0; });
  text += fmt::format("\n{} of {} cases pass, {} miss, {:.1f} s\n", passed, results.size(), missed, seconds);
  if (facts > 0)
    text +=
        fmt::format("{} of them record how far a theory errs where it is known to fail: bounds from ... to\n", facts);
  return text;
}

int validation_exit_code(const std::vector<CaseResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const CaseResult& r) { return r.passed; }) ? 0 : 3;
}

int validate_verb(const Arguments& arguments) {
  const Clock::time_point start = Clock::now();
  Diagnostics diagnostics;
  const std::vector<const Case*> cases = select_cases(arguments.cases, diagnostics);
  if (arguments.list) {
    diagnostics.throw_if_errors();
    fmt::print("{}", list_text(cases));
    return 0;
  }
  OutputFolder folder(arguments.output.empty() ? "validate.out" : arguments.output, {"validate.json", "report.html"});
  folder.check(arguments.overwrite, diagnostics);
  diagnostics.throw_if_errors();

  std::optional<Progress> progress;
  if (!arguments.quiet && (arguments.progress || stderr_is_terminal())) progress.emplace(stderr_is_terminal());
  std::size_t ended = 0;
  const std::vector<CaseResult> results = run_cases(cases, arguments.threads, [&](const CaseResult&) {
    ++ended;
    if (progress) progress->show("validate", double(ended) / double(cases.size()));
  });
  progress.reset();
  const std::vector<DrawnFigure> figures = drawn(results);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const std::string json = results_json(results, seconds);

  // Everything is known before the first file is written.
  folder.create();
  for (const DrawnFigure& figure : figures) write_text(folder.file(file_of(*figure.figure)), figure.png);
  remove_old_figures(folder.path(), figures);
  write_text(folder.file("report.html"), report_page(results, figures, seconds));
  write_text(folder.file("validate.json"), json);
  if (arguments.json) {
    fmt::print("{}", json);
  } else if (!arguments.quiet) {
    fmt::print("{}\n", validation_table(results, seconds));
    if (arguments.cases.empty())
      for (const std::string& paragraph : theory_words(results)) fmt::print("{}\n", wrapped(paragraph, 110));
    fmt::print("{}\n", folder.file("report.html").string());
  }
  return validation_exit_code(results);
}

}  // namespace grimaldi
