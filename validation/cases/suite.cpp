#include "validation/cases/suite.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>

#include "core/blocks.h"
#include "validation/cases/families.h"

namespace grimaldi {
namespace {

std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t to = std::min(name.find('/', from), name.size());
    parts.push_back(name.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

/// Whether `word` is a run of whole parts of `name`.
bool names(const std::string& word, const std::string& name) {
  return !word.empty() && ("/" + name + "/").find("/" + word + "/") != std::string::npos;
}

CaseResult run_case(const Case& subject) {
  CaseResult result;
  result.subject = &subject;
  const auto start = std::chrono::steady_clock::now();
  try {
    result.outcome = subject.run();
  } catch (const std::exception& fault) {
    result.outcome.error = std::numeric_limits<double>::quiet_NaN();
    result.outcome.note = fault.what();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.passed = within_tolerance(subject, result.outcome.error);
  return result;
}

}  // namespace

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> list;
    for (const auto& family : {aperture_cases,       validity_cases,      wedge_cases,
                               engine_wedge_cases,   engine_corner_cases, impedance_wedge_cases,
                               knife_edge_cases,     double_edge_cases,   screen_cases,
                               auto_cases,           roof_cases,          walk_cases,
                               reciprocity_cases,    exhaustive_cases,    energy_cases,
                               published_cases,      material_cases,      invariance_cases,
                               extreme_kernel_cases, extreme_engine_cases})
      for (Case& one : family()) list.push_back(std::move(one));
    return list;
  }();
  return cases;
}

std::vector<std::string> suite_names() {
  std::vector<std::string> suites;
  for (const Case& one : all_cases()) {
    const std::string suite = parts_of(one.name).front();
    if (suites.empty() || suites.back() != suite) suites.push_back(suite);
  }
  return suites;
}

std::vector<const Case*> select_cases(const std::vector<std::string>& words, Diagnostics& diagnostics) {
  const std::vector<Case>& cases = all_cases();
  std::vector<bool> chosen(cases.size(), words.empty());
  for (const std::string& word : words) {
    bool found = false;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (names(word, cases[i].name)) chosen[i] = found = true;
    if (found) continue;
    // Suites first: they stand in the list that a word unlike any other is answered with.
    std::vector<std::string> known = suite_names();
    const std::size_t suites = known.size();
    for (const Case& one : cases) {
      for (const std::string& part : parts_of(one.name))
        if (std::find(known.begin(), known.end(), part) == known.end()) known.push_back(part);
      if (word.find('/') != std::string::npos) known.push_back(one.name);
    }
    std::string hint = did_you_mean(word, known);
    if (!hint.starts_with("did you mean"))
      hint = did_you_mean(word, {known.begin(), known.begin() + std::ptrdiff_t(suites)});
    diagnostics.error("", 0, word, "unknown case", "", hint + "; --list names all");
  }
  std::vector<const Case*> selected;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (chosen[i]) selected.push_back(&cases[i]);
  return selected;
}

std::vector<CaseResult> run_cases(const std::vector<const Case*>& cases, unsigned threads,
                                  const std::function<void(const CaseResult&)>& ended) {
  std::vector<CaseResult> results(cases.size());
  std::mutex telling;
  // The last cases of the list are the long ones (the engine): they begin first, so that no thread waits for one alone.
  for_each_block(cases.size(), threads, [&](std::size_t block, unsigned) {
    const std::size_t i = cases.size() - 1 - block;
    results[i] = run_case(*cases[i]);
    if (!ended) return;
    const std::lock_guard lock(telling);
    ended(results[i]);
  });
  return results;
}

}  // namespace grimaldi
