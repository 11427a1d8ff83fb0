#include "cli/comparison_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/axes.h"
#include "cli/html.h"
#include "cli/plan_words.h"
#include "cli/version.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

std::string dB(double value) { return std::isfinite(value) ? number_text(value, 2) + " dB" : "–"; }

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  return number_text(100 * share, share > 0 && share < 0.1 ? 1 : 0) + " %";
}

std::string count_text(std::uint64_t count) { return number_text(double(count), 0); }

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count_text(count), noun, count == 1 ? "" : "s");
}

/// As the words write it: "UTD" or "either".
std::string believed(const Belief& belief) { return belief.model == "utd" ? "UTD" : belief.model; }

std::string delay(double seconds, WaveKind kind) {
  if (!std::isfinite(seconds)) return "–";
  return kind == WaveKind::radio ? number_text(1e9 * seconds, 1) + " ns" : number_text(1e3 * seconds, 1) + " ms";
}

/// "FSD is stronger by 0.3 dB in the median", or that neither is.
std::string who_is_stronger(const DifferenceFigures& f) {
  if (std::abs(f.median) < 0.05) return "in the median neither is stronger (less than 0.05 dB)";
  return fmt::format("in the median {} is stronger by {}", f.median > 0 ? "FSD" : "UTD", dB(std::abs(f.median)));
}

/// The columns of `figures_head` and, with noise, that of `noise_head`.
std::string figures_cells(const DifferenceFigures& f, bool noise) {
  return fmt::format("<td class=n>{}<td class=n>{}<td class=n>{}<td class=n>{}{}", count_text(f.cells), dB(f.median),
                     dB(f.median_abs), dB(f.p95_abs), noise ? "<td class=n>" + percent(f.beyond_noise) : "");
}

constexpr const char* figures_head =
    "<th class=n>cells<th class=n>FSD − UTD, median<th class=n>half differ<br>by less than<th class=n>95 % "
    "differ<br>by "
    "less than";
constexpr const char* noise_head = "<th class=n>beyond twice<br>the noise";

std::string picture_html(const std::string& png, const std::string& caption) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(caption), base64(png));
}

std::string region_table(const Comparison& comparison) {
  static constexpr const char* meaning[region_count] = {
      "v below −2.25: the line from the transmitter is free, an edge's wave is more than 20 dB weaker",
      "v from −2.25 to 2.25: around the shadow boundary",
      "v from 2.25 to 22.5: one edge leads around; a knife edge would cost 20 to 40 dB",
      "v above 22.5, or two and more edges to pass"};
  std::string html = fmt::format("<div class=scroll><table><tr><th>region<th>what it is{}{}<th>believe<th>why</tr>\n",
                                 figures_head, noise_head);
  for (std::size_t r = 0; r < region_count; ++r) {
    const Belief& belief = comparison.beliefs[r];
    html +=
        fmt::format("<tr><td>{}<td>{}{}<td class=v>{}<td>{}</tr>\n", region_names[r], meaning[r],
                    figures_cells(comparison.first().regions[r], true), escaped(believed(belief)), escaped(belief.why));
  }
  return html + "</table></div>\n";
}

std::string mechanism_table(const BandComparison& band) {
  std::string html = fmt::format("<table class=narrow><tr><th>mechanism{}</tr>\n", figures_head);
  for (std::size_t m = 0; m < mechanism_count; ++m)
    if (band.mechanisms[m].cells > 0)
      html += fmt::format("<tr><td>{}{}</tr>\n", mechanism_names[m], figures_cells(band.mechanisms[m], false));
  return html + "</table>\n";
}

/// All cells and each region, band by band.
std::string band_table(const Plan& plan, const Comparison& comparison) {
  std::string html = fmt::format("<table class=narrow><tr><th>band<th>region{}{}</tr>\n", figures_head, noise_head);
  for (std::size_t b = 0; b < comparison.bands.size(); ++b) {
    const BandComparison& band = comparison.bands[b];
    html += fmt::format("<tr><td>{}<td>all{}</tr>\n", escaped(frequency_words(plan, b)), figures_cells(band.all, true));
    for (std::size_t r = 0; r < region_count; ++r)
      if (band.regions[r].cells > 0)
        html += fmt::format("<tr><td><td>{}{}</tr>\n", region_names[r], figures_cells(band.regions[r], true));
  }
  return html + "</table>\n";
}

std::string model_row(const char* name, const Plan& plan, const Result& result) {
  const MapFigures map = map_figures(plan, *result.coverage);
  const RunFigures& run = result.figures;
  return fmt::format(
      "<tr><td>{}<td class=n>{:.2f} s<td class=n>{:.2f} s<td class=n>{:.2f} s<td class=n>{}<td class=n>{}<td "
      "class=n>{} of {}<td class=n>{:.3f} dB</tr>\n",
      name, run.wall_seconds, run.trace_seconds, run.cpu_seconds, count_text(run.segments), count_text(run.shadow_rays),
      count_text(map.reached), count_text(map.asked), map.median_standard_error_dB);
}

std::string receiver_table(const Plan& plan, const Comparison& comparison) {
  const WaveKind kind = plan.request.kind;
  std::string html =
      "<div class=scroll><table class=narrow><tr><th>receiver<th>band<th class=n>level, FSD<th class=n>level, UTD<th "
      "class=n>FSD − UTD<th class=n>delay spread,<br>FSD<th class=n>delay spread,<br>UTD<th class=n>FSD − UTD</tr>\n";
  for (std::size_t r = 0; r < comparison.receivers.size(); ++r)
    for (std::size_t b = 0; b < comparison.bands.size(); ++b) {
      const ReceiverFigures &f = comparison.bands[b].fsd[r], &u = comparison.bands[b].utd[r];
      html += fmt::format(
          "<tr><td>{}<td>{}<td class=n>{}<td class=n>{}<td class=n>{}<td class=n>{}<td class=n>{}<td class=n>{}</tr>\n",
          b == 0 ? escaped(comparison.receivers[r]) : "", escaped(frequency_words(plan, b)), dB(f.level_dB),
          dB(u.level_dB), dB(f.level_dB - u.level_dB), delay(f.delay_spread_s, kind), delay(u.delay_spread_s, kind),
          delay(f.delay_spread_s - u.delay_spread_s, kind));
    }
  return html + "</table></div>\n";
}

/// What is found, without whom to believe.
std::vector<std::string> finding_words(const Plan& plan, const Comparison& comparison) {
  std::vector<std::string> words;
  const std::string where = plan.bands() > 1 ? fmt::format("At {}, over", frequency_words(plan, 0)) : "Over";
  const DifferenceFigures& all = comparison.first().all;
  if (all.cells == 0) {
    words.push_back("No cell is reached by both theories: there is nothing to compare.");
  } else if (all.p95_abs < 0.05) {
    words.push_back(fmt::format("{} {} that both theories reach they say the same: 95 % differ by less than 0.05 dB.",
                                where, counted(all.cells, "cell")));
  } else {
    words.push_back(
        fmt::format("{} {} that both theories reach, {}; half of them differ by less than {}, 95 % by less than {}.",
                    where, counted(all.cells, "cell"), who_is_stronger(all), dB(all.median_abs), dB(all.p95_abs)));
    words.push_back(fmt::format(
        "{} of them differ by more than twice the standard errors of both runs together: there the theories disagree; "
        "elsewhere the sampling may be all of the difference.",
        percent(all.beyond_noise)));
  }
  if (comparison.first().only_fsd + comparison.first().only_utd > 0)
    words.push_back(fmt::format("{} reached by FSD alone, {} by UTD alone.",
                                counted(comparison.first().only_fsd, "cell"),
                                counted(comparison.first().only_utd, "cell")));
  std::size_t worst = region_count;
  for (std::size_t r = 0; r < region_count; ++r)
    if (comparison.first().regions[r].cells > 0 &&
        (worst == region_count || comparison.first().regions[r].p95_abs > comparison.first().regions[worst].p95_abs))
      worst = r;
  if (worst < region_count && comparison.first().regions[worst].p95_abs >= 0.1) {
    const DifferenceFigures& f = comparison.first().regions[worst];
    words.push_back(fmt::format("They disagree most in the {} region: {}, {}, 95 % within {}.", region_names[worst],
                                counted(f.cells, "cell"), who_is_stronger(f), dB(f.p95_abs)));
  } else if (worst < region_count) {
    words.push_back("They agree everywhere: in each region 95 % of the cells differ by less than 0.1 dB.");
  }
  if (comparison.bands.size() > 1) {
    const auto most = std::max_element(
        comparison.bands.begin(), comparison.bands.end(),
        [](const BandComparison& a, const BandComparison& b) { return a.all.p95_abs < b.all.p95_abs; });
    if (most->all.cells > 0)
      words.push_back(fmt::format("Of the {} bands they disagree most at {}: {}, 95 % within {}.",
                                  comparison.bands.size(),
                                  frequency_words(plan, std::size_t(most - comparison.bands.begin())),
                                  who_is_stronger(most->all), dB(most->all.p95_abs)));
  }
  return words;
}

/// Whom to believe, a sentence per region.
std::vector<std::string> belief_words(const Comparison& comparison) {
  std::vector<std::string> words;
  for (std::size_t r = 0; r < region_count; ++r) {
    if (comparison.first().regions[r].cells == 0) continue;
    const Belief& belief = comparison.beliefs[r];
    words.push_back(fmt::format("Believe {} in the {} region ({}, 95 % within {}). {}", believed(belief),
                                region_names[r], counted(comparison.first().regions[r].cells, "cell"),
                                dB(comparison.first().regions[r].p95_abs), belief.why));
  }
  return words;
}

/// On what edges the belief rests.
std::string edge_words(const Comparison& comparison) {
  return comparison.solid
             ? "Most edges of this scene belong to solids, so what `grimaldi validate` measures behind solid wedges "
               "applies."
             : "Most edges of this scene are rims of thin screens: there FSD and UTD are one law, and what remains is "
               "the same wave written twice.";
}

}  // namespace

std::vector<std::string> comparison_words(const Plan& plan, const Comparison& comparison, const Result& fsd,
                                          const Result& utd) {
  std::vector<std::string> words = finding_words(plan, comparison);
  for (std::string& sentence : belief_words(comparison)) words.push_back(std::move(sentence));
  words.push_back(edge_words(comparison));
  for (std::size_t r = 0; r < comparison.receivers.size(); ++r) {
    const ReceiverFigures &f = comparison.first().fsd[r], &u = comparison.first().utd[r];
    if (!std::isfinite(f.level_dB) || !std::isfinite(u.level_dB)) continue;
    words.push_back(fmt::format("At {} FSD gives {} and UTD {} ({} apart), delay spread {} and {}.",
                                comparison.receivers[r], dB(f.level_dB), dB(u.level_dB), dB(f.level_dB - u.level_dB),
                                delay(f.delay_spread_s, plan.request.kind),
                                delay(u.delay_spread_s, plan.request.kind)));
  }
  words.push_back(
      fmt::format("FSD took {:.2f} s with a median standard error of {:.3f} dB, UTD {:.2f} s with {:.3f} dB.",
                  fsd.figures.wall_seconds, map_figures(plan, *fsd.coverage).median_standard_error_dB,
                  utd.figures.wall_seconds, map_figures(plan, *utd.coverage).median_standard_error_dB));
  return words;
}

std::string comparison_page(const Scene& scene, const Plan& plan, const Comparison& comparison, const Result& fsd,
                            const Result& utd, const ComparisonPictures& pictures) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width,initial-scale=1\"><title>Grimaldi: FSD and "
      "UTD</title><style>{}</style></head><body>"
      "<main>\n<h1>Two theories of diffraction, one scene</h1><p class=lead>{} · {} · {} · grimaldi {}</p>\n",
      page_style, escaped(scene_words(scene)), escaped(band_words(plan)), escaped(transmitter_words(plan)),
      escaped(program_version()));
  html +=
      "<p>FSD (free-space diffraction BSDF) and UTD (uniform theory of diffraction) are two laws for the wave that "
      "bends around an edge. Both were run over the same scene with the same beams, so that what differs is the law. "
      "Differences are FSD − UTD: positive where FSD predicts the stronger signal.</p>\n<h2>What was found</h2>\n";
  for (const std::string& sentence : finding_words(plan, comparison)) html += "<p>" + marked(sentence) + "</p>\n";
  html += picture_html(pictures.difference,
                       "FSD, UTD and their difference in dB, with the same beams. Red: FSD is stronger; blue: "
                       "UTD is stronger.");
  html +=
      "<h2>Which theory to believe where</h2>\n<p>" + marked(edge_words(comparison)) + "</p>\n" +
      region_table(comparison) +
      "<p class=why>The regions go by v, the parameter of one knife edge between the transmitter that brings a cell "
      "most and the cell's centre: v = ±2 √(Δ/λ), Δ the detour over the edge, negative where the line is free. The "
      "edge is the one that leads around with the least detour and sees both ends; it is not asked whether the "
      "strongest path of the run takes it. Where no single edge leads around, the cell is in deep shadow. Reflections "
      "are not asked: where one fills a shadow, both theories say nearly the same. Soft and "
      "hard: the electric field lies along the edge, or across it; walls are hard for sound.</p>\n";
  if (comparison.bands.size() > 1)
    html += "<h2>By band</h2>\n<p>Pictures, words and the tables of regions and mechanisms show the first band.</p>\n" +
            band_table(plan, comparison);
  html +=
      "<h2>By mechanism</h2>\n<p>What each mechanism brings, over the cells where it does so in both maps "
      "(interference "
      "may be negative, and is then left out).</p>\n" +
      mechanism_table(comparison.first());
  if (!comparison.receivers.empty()) html += "<h2>Receivers</h2>\n" + receiver_table(plan, comparison);
  html +=
      "<h2>Time and noise of each</h2>\n<table class=narrow><tr><th>theory<th class=n>wall time<th class=n>of it "
      "tracing<th class=n>CPU time<th class=n>segments<th class=n>shadow rays<th class=n>cells reached<th "
      "class=n>median standard error</tr>\n" +
      model_row("FSD", plan, fsd) + model_row("UTD", plan, utd) +
      "</table>\n<p class=why>Noise of a cell: the square root of the sum of both squared standard errors. Both runs "
      "send the same beams and find mostly the same paths, so that their errors go together: the noise of the "
      "difference is smaller.</p>\n<h2>Each map</h2>\n" +
      picture_html(pictures.fsd, "Free-space diffraction BSDF (FSD): three black edges stand for a solid wedge.") +
      picture_html(pictures.utd, "Uniform theory of diffraction (UTD): the four terms of Kouyoumjian and Pathak.");
  return html + "</main></body></html>\n";
}

}  // namespace grimaldi
