#include "validation/cases/results_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace grimaldi {

std::string results_json(const std::vector<CaseResult>& results, double seconds) {
  using Json = nlohmann::ordered_json;
  Json cases = Json::array();
  for (const CaseResult& result : results) {
    const Case& subject = *result.subject;
    Json one;
    one["name"] = subject.name;
    one["suite"] = subject.name.substr(0, subject.name.find('/'));
    one["quantity"] = subject.quantity;
    one["reference"] = subject.reference;
    one["error"] = result.outcome.error;  // not finite: null
    one["unit"] = subject.unit;
    one["tolerance"] = subject.tolerance;
    one["at_least"] = subject.at_least;
    one["reason"] = subject.reason;
    one["passed"] = result.passed;
    one["seconds"] = result.seconds;
    one["note"] = result.outcome.note;
    if (subject.unit == "1" && std::isfinite(result.outcome.error))
      one["digits"] = correct_digits(result.outcome.error);
    cases.push_back(std::move(one));
  }
  const auto passed = std::count_if(results.begin(), results.end(), [](const CaseResult& r) { return r.passed; });
  Json json;
  json["cases"] = std::move(cases);
  json["passed"] = passed;
  json["failed"] = std::ptrdiff_t(results.size()) - passed;
  json["seconds"] = seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace grimaldi
