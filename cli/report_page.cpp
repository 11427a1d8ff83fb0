#include "cli/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "cli/html.h"
#include "cli/theory_words.h"
#include "cli/version.h"

namespace grimaldi {
namespace {

std::string suite_of(const CaseResult& result) {
  return result.subject->name.substr(0, result.subject->name.find('/'));
}

std::string unit_of(const Case& subject) { return subject.unit == "1" ? "" : " " + subject.unit; }

std::string bound_text(const Case& subject) {
  const std::string unit = unit_of(subject);
  return subject.at_least > 0 ? fmt::format("{:.2g} … {:.2g}{}", subject.at_least, subject.tolerance, unit)
                              : fmt::format("≤ {:.2g}{}", subject.tolerance, unit);
}

/// A fact records a known weakness: it has to lie in its band, and is no merit.
const char* verdict_words(const CaseResult& result) {
  if (!result.passed) return "MISS";
  return result.subject->at_least > 0 ? "as known" : "pass";
}

/// The parts of apertures/square/D10/N0.1/fsd.
struct ApertureKey {
  std::string shape, size, number, theory;
};
std::optional<ApertureKey> aperture_key(const CaseResult& result) {
  std::array<std::string, 5> part;
  std::size_t from = 0;
  const std::string& name = result.subject->name;
  for (std::string& one : part) {
    if (from > name.size()) return std::nullopt;
    const std::size_t to = std::min(name.find('/', from), name.size());
    one = name.substr(from, to - from);
    from = to + 1;
  }
  if (part[0] != "apertures" || part[4].empty()) return std::nullopt;
  return ApertureKey{part[1], part[2].substr(1), part[3].substr(1), part[4]};
}

/// Errors of the openings as coloured cells: shape by size, Fresnel number across, both theories.
std::string aperture_heat(const std::vector<CaseResult>& results) {
  std::vector<std::string> lines, numbers;
  std::map<std::string, std::map<std::string, const CaseResult*>> cells;  // line → theory and number
  for (const CaseResult& result : results) {
    const auto key = aperture_key(result);
    if (!key) continue;
    const std::string line = key->shape + "</td><td class=h>" + key->size + " λ";
    if (!cells.contains(line)) lines.push_back(line);
    if (std::find(numbers.begin(), numbers.end(), key->number) == numbers.end()) numbers.push_back(key->number);
    cells[line][key->theory + key->number] = &result;
  }
  if (lines.empty()) return {};
  const std::array<std::pair<const char*, const char*>, 2> theories{
      {{"fsd", "polygon form of the BSDF (far field)"}, {"edges", "connected edges (repaired BSDF = UTD)"}}};
  std::string html =
      "<h3>Error of the openings</h3><p class=why>N = (D/2)²/λz, the Fresnel number of an opening of size D at the "
      "distance z. Green: 0.03 dB and less; red: 10 dB and more.</p>\n"
      "<div class=scroll><table class=heat><tr><th rowspan=2>opening<th rowspan=2>size";
  for (const auto& [key, name] : theories) html += fmt::format("<th colspan={}>{}, error in dB", numbers.size(), name);
  html += "</tr><tr>";
  for (std::size_t t = 0; t < theories.size(); ++t)
    for (const std::string& number : numbers) html += "<th>N = " + number;
  html += "</tr>\n";
  for (const std::string& line : lines) {
    html += "<tr><td class=h>" + line + "</td>";
    for (const auto& [key, name] : theories)
      for (const std::string& number : numbers) {
        const auto found = cells[line].find(key + number);
        if (found == cells[line].end()) {
          html += "<td></td>";
          continue;
        }
        // 0.03 dB and less green, 10 dB and more red, on the logarithm.
        const double error = found->second->outcome.error;
        const double hue =
            130 * (1 - std::clamp(std::log10(std::max(error, 1e-3) / 0.03) / std::log10(300.0), 0.0, 1.0));
        html += fmt::format("<td style=\"background:hsl({:.0f} 62% 82%)\">{}</td>", std::isfinite(error) ? hue : 0,
                            error < 0.1 ? fmt::format("{:.2f}", error) : fmt::format("{:.1f}", error));
      }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string figures_html(const std::vector<DrawnFigure>& figures, const std::string& suite) {
  std::string html;
  for (const DrawnFigure& figure : figures) {
    if (figure.subject->name.rfind(suite + "/", 0) != 0) continue;
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        escaped(figure.figure->caption), base64(figure.png));
  }
  return html;
}

std::string table_html(const std::vector<CaseResult>& results, const std::string& suite) {
  std::string html;
  const Case* before = nullptr;
  for (const CaseResult& result : results) {
    if (suite_of(result) != suite) continue;
    const Case& subject = *result.subject;
    const bool same_heading =
        before != nullptr && before->quantity == subject.quantity && before->reference == subject.reference;
    if (!same_heading) {
      if (before) html += "</table>\n";
      html += fmt::format(
          "<h3>{}</h3><p class=why>against: {}</p>\n<table><tr><th>case<th class=n>error<th class=n>allowed<th><th "
          "class=n>time<th>"
          "why this much</tr>\n",
          escaped(subject.quantity), escaped(subject.reference));
    }
    const std::string digits = subject.unit == "1" && result.outcome.error < 0.1
                                   ? fmt::format(" ({:.1f} digits)", correct_digits(result.outcome.error))
                                   : "";
    html += fmt::format(
        "<tr{}><td><code>{}</code><td class=n>{:.3g}{}{}<td class=n>{}<td class=v>{}<td class=n>{:.2f} "
        "s<td>{}{}</tr>\n",
        !result.passed ? " class=miss" : (subject.at_least > 0 ? " class=known" : ""), escaped(subject.name),
        result.outcome.error, unit_of(subject), digits, bound_text(subject), verdict_words(result), result.seconds,
        same_heading && before->reason == subject.reason ? "<span class=note>as above</span>" : escaped(subject.reason),
        result.outcome.note.empty() ? "" : "<div class=note>" + escaped(result.outcome.note) + "</div>");
    before = &subject;
  }
  return before ? html + "</table>\n" : html;
}

std::vector<std::string> suites_of(const std::vector<CaseResult>& results) {
  std::vector<std::string> suites;
  for (const CaseResult& result : results)
    if (suites.empty() || suites.back() != suite_of(result)) suites.push_back(suite_of(result));
  return suites;
}

}  // namespace

std::string report_page(const std::vector<CaseResult>& results, const std::vector<DrawnFigure>& figures,
                        double seconds) {
  const auto passed = std::count_if(results.begin(), results.end(), [](const CaseResult& r) { return r.passed; });
  const auto missed = std::ptrdiff_t(results.size()) - passed;
  const std::vector<std::string> suites = suites_of(results);
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width,initial-scale=1\"><title>Grimaldi: validation</title><style>{}</style></head><body>"
      "<main>\n<h1>How far from the truth</h1><p class=lead>Validation of grimaldi {}: {} cases in {:.1f} s</p>\n"
      "<p><span class=\"verdict{}\">{}</span></p>\n<p class=why>A case passes if its error is as "
      "small as allowed. Where a theory is known to fail the case says \"as known\": its error has to lie between the "
      "two values allowed, no better and no worse.</p>\n<nav>",
      page_style, escaped(program_version()), results.size(), seconds, missed > 0 ? " bad" : "",
      missed > 0 ? fmt::format("{} of {} cases miss", missed, results.size())
                 : fmt::format("all {} cases pass", results.size()));
  for (const std::string& suite : suites) html += fmt::format("<a href=\"#{0}\">{0}</a>", escaped(suite));
  html += "</nav>\n";
  if (missed > 0) {
    html += "<h2>What misses</h2>\n<table><tr><th>case<th class=n>error<th class=n>allowed<th>what was seen</tr>\n";
    for (const CaseResult& result : results)
      if (!result.passed)
        html += fmt::format("<tr class=miss><td><code>{}</code><td class=n>{:.3g}{}<td class=n>{}<td>{}</tr>\n",
                            escaped(result.subject->name), result.outcome.error, unit_of(*result.subject),
                            bound_text(*result.subject), escaped(result.outcome.note));
    html += "</table>\n";
  }
  html += "<h2 id=theories>Where each theory is good, and where it fails</h2>\n";
  for (const std::string& sentence : theory_words(results)) html += "<p>" + marked(sentence) + "</p>\n";
  html += aperture_heat(results);
  for (const std::string& suite : suites) {
    html += fmt::format("<h2 id=\"{0}\">{0}</h2>\n", escaped(suite));
    const std::string sentence = suite_words(suite);
    if (!sentence.empty()) html += "<p>" + marked(sentence) + "</p>\n";
    html += figures_html(figures, suite) + table_html(results, suite);
  }
  return html + "</main></body></html>\n";
}

}  // namespace grimaldi
