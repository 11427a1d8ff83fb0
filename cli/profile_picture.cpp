#include "cli/profile_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/axes.h"
#include "cli/plan_words.h"
#include "core/contract.h"
#include "propagation/result_file.h"

namespace grimaldi {
namespace {

constexpr double sheet_width = 1600, outer_margin = 36, column_gap = 44, panel_gap = 34;
constexpr double line_height = 1.4 * small_size;
constexpr std::size_t told_paths = 3;        ///< paths whose story is written out
constexpr std::size_t most_total_lines = 3;  ///< lines of totals in a heading
constexpr Colour grey{60, 60, 60};

/// Colours that people with any colour vision can tell apart. Source: Okabe and Ito, "Color Universal Design" (2008);
/// yellow darkened for white paper.
constexpr std::array<Colour, 8> palette{{{0, 114, 178},
                                         {213, 94, 0},
                                         {0, 158, 115},
                                         {204, 121, 167},
                                         {86, 180, 233},
                                         {230, 159, 0},
                                         {120, 120, 120},
                                         {150, 140, 0}}};
Colour transmitter_colour(std::size_t t) { return palette[t % palette.size()]; }

/// A delay of the first band's scale: seconds → ns or ms.
struct DelayUnit {
  double per_second;
  const char* name;
};

DelayUnit delay_unit(const Plan& plan) {
  return plan.request.kind == WaveKind::radio ? DelayUnit{1e9, "ns"} : DelayUnit{1e3, "ms"};
}

/// Decimals that show a length of time to 1 % of the bins' width, at most three.
int delay_decimals(const Plan& plan) {
  const double bin = plan.request.profile.resolution * delay_unit(plan).per_second;
  return std::clamp(1 - int(std::floor(std::log10(bin))), 0, 3);
}

std::string delay_text(double seconds, const Plan& plan) {
  const DelayUnit unit = delay_unit(plan);
  return number_text(seconds * unit.per_second, delay_decimals(plan)) + " " + unit.name;
}

struct ShownPath {
  std::size_t transmitter;
  const PathStory* story;
  double decibels;
};

/// The paths of a receiver with the power in its polarisation(s), strongest first.
std::vector<ShownPath> shown_paths(const Plan& plan, const ReceiverProfile& profile, const ShownQuantity& quantity) {
  Polarisation wanted = Polarisation::both;
  for (const Receiver& receiver : plan.request.receivers) {
    if (receiver.name == profile.name) wanted = receiver.polarisation;
  }
  std::vector<ShownPath> shown;
  for (std::size_t t = 0; t < profile.paths.size(); ++t) {
    for (const PathStory& story : profile.paths[t]) {
      double gain = 0;
      for (std::size_t p = 0; p < plan.polarisations(); ++p) {
        const bool other = plan.polarisations() == 2 && ((wanted == Polarisation::vertical && p == 1) ||
                                                         (wanted == Polarisation::horizontal && p == 0));
        if (!other) gain += std::norm(story.amplitude[p * plan.bands()]);
      }
      if (gain > 0) shown.push_back({t, &story, quantity.decibels(t, gain)});
    }
  }
  std::stable_sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.decibels > b.decibels; });
  return shown;
}

struct Panel {
  const ReceiverProfile* profile;
  std::vector<ShownPath> paths;
  std::vector<std::string> totals;
  std::vector<std::size_t> total_transmitter;
  std::optional<ValueRange> decibels, delay;  ///< nothing if nothing arrived; delay in the picture's unit
  std::size_t heading_lines() const { return totals.size() + std::min(told_paths, paths.size()); }
};

std::string totals_text(const Plan& plan, const ReceiverProfile& profile, const ShownQuantity& quantity,
                        std::size_t t) {
  const std::size_t i = t * plan.bands();
  std::string text;
  if (plan.request.transmitters.size() > 1) text = plan.request.transmitters[t].name + ": ";
  if (!std::isfinite(profile.total[i])) return text + "total is not a number: a fault of the program";
  text += fmt::format("total {} dB", number_text(quantity.decibels(t, profile.total[i]), 1));
  if (profile.total_coherent[i] > 0) {
    text += fmt::format(", coherent {} dB", number_text(quantity.decibels(t, profile.total_coherent[i]), 1));
  }
  if (std::isfinite(profile.mean_delay[i])) {
    text += fmt::format("{}mean delay {}", title_separator, delay_text(profile.mean_delay[i], plan));
  }
  if (std::isfinite(profile.rms_delay_spread[i])) {
    text += fmt::format(", spread {}", delay_text(profile.rms_delay_spread[i], plan));
  }
  return text;
}

double bin_width(const Plan& plan, const ReceiverProfile& profile) {
  return profile.delay.size() > 1 ? profile.delay[1] - profile.delay[0] : plan.request.profile.resolution;
}

Panel make_panel(const Plan& plan, const ReceiverProfile& profile, const ShownQuantity& quantity) {
  const std::size_t transmitters = plan.request.transmitters.size(), bands = plan.bands(), bins = profile.delay.size();
  GRIMALDI_EXPECT(profile.power.size() == transmitters * bands * bins && profile.total.size() == transmitters * bands);
  Panel panel{&profile, shown_paths(plan, profile, quantity), {}, {}, {}, {}};

  std::vector<std::pair<double, std::size_t>> strongest;
  for (std::size_t t = 0; t < transmitters; ++t) {
    const double total = profile.total[t * bands];
    if (total > 0) strongest.emplace_back(-quantity.decibels(t, total), t);
    // Not hidden, and before all others.
    if (!std::isfinite(total)) strongest.emplace_back(-std::numeric_limits<double>::infinity(), t);
  }
  std::sort(strongest.begin(), strongest.end());
  for (std::size_t i = 0; i < std::min(strongest.size(), most_total_lines); ++i) {
    panel.totals.push_back(totals_text(plan, profile, quantity, strongest[i].second));
    panel.total_transmitter.push_back(strongest[i].second);
  }
  if (strongest.size() > most_total_lines) {
    panel.totals.back() += fmt::format("{}and {} weaker", title_separator, strongest.size() - most_total_lines);
  }

  // Everything that can be drawn: value, first and last moment.
  double top = -std::numeric_limits<double>::infinity();
  for (const ShownPath& path : panel.paths) top = std::max(top, path.decibels);
  const auto value_of = [&](std::size_t t, std::size_t bin) {
    const double power = profile.power[t * bands * bins + bin];
    return power > 0 ? quantity.decibels(t, power) : -std::numeric_limits<double>::infinity();
  };
  for (std::size_t t = 0; t < transmitters; ++t) {
    for (std::size_t bin = 0; bin < bins; ++bin) top = std::max(top, value_of(t, bin));
  }
  if (!std::isfinite(top)) return panel;
  const double high = 10 * std::floor(top / 10) + 10;
  panel.decibels =
      ValueRange{high - 10 * std::ceil(std::clamp(plan.request.profile.dynamic_range, 40.0, 200.0) / 10), high};

  const double half = bin_width(plan, profile) / 2;
  double first = std::numeric_limits<double>::infinity(), last = 0;
  const auto spans = [&](double from, double to) {
    first = std::min(first, from);
    last = std::max(last, to);
  };
  for (const ShownPath& path : panel.paths) {
    if (path.decibels > panel.decibels->low) spans(path.story->delay, path.story->delay);
  }
  for (std::size_t t = 0; t < transmitters; ++t) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      if (value_of(t, bin) > panel.decibels->low) spans(profile.delay[bin] - half, profile.delay[bin] + half);
    }
  }
  const double pad = std::max(0.04 * (last - first), 5 * half);
  const double unit = delay_unit(plan).per_second;
  panel.delay = ValueRange{std::max(0.0, first - pad) * unit, (last + pad) * unit};
  return panel;
}

void draw_bars_and_stems(Canvas& canvas, const Plan& plan, const Panel& panel, const ShownQuantity& quantity,
                         const PlotBox& box) {
  const ReceiverProfile& profile = *panel.profile;
  const double unit = delay_unit(plan).per_second, half = bin_width(plan, profile) / 2;
  const auto x_of = [&](double seconds) {
    return box.left + box.width() * (seconds * unit - panel.delay->low) / (panel.delay->high - panel.delay->low);
  };
  const auto y_of = [&](double decibels) {
    return box.bottom - box.height() * (decibels - panel.decibels->low) / (panel.decibels->high - panel.decibels->low);
  };
  const std::size_t bins = profile.delay.size(), transmitters = plan.request.transmitters.size();
  for (std::size_t t = 0; t < transmitters; ++t) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      const double power = profile.power[t * plan.bands() * bins + bin];
      if (!(power > 0) || quantity.decibels(t, power) <= panel.decibels->low) continue;
      const double left = std::max(box.left, x_of(profile.delay[bin] - half));
      const double right = std::min(box.right, std::max(x_of(profile.delay[bin] + half), left + 1));
      canvas.fill({left, y_of(quantity.decibels(t, power)), right, box.bottom}, mix(transmitter_colour(t), white, 0.6),
                  transmitters > 1 ? 0.7 : 1);
    }
  }
  const auto foot = [&](const ShownPath& path) { return PlotPoint{x_of(path.story->delay), box.bottom}; };
  const auto tip = [&](const ShownPath& path) { return PlotPoint{x_of(path.story->delay), y_of(path.decibels)}; };
  LabelPlacer placer(box);
  // Weakest first, so that the strongest lie on top.
  for (auto path = panel.paths.rbegin(); path != panel.paths.rend(); ++path) {
    if (path->decibels <= panel.decibels->low) continue;
    canvas.line(foot(*path), tip(*path), transmitter_colour(path->transmitter), 1.5);
    canvas.disc(tip(*path), 3, transmitter_colour(path->transmitter), white, 1);
  }
  for (std::size_t i = 0; i < std::min(told_paths, panel.paths.size()); ++i) {
    const PlotPoint p = tip(panel.paths[i]);
    placer.keep_off({p.x - 5, p.y - 5, p.x + 5, p.y + 5});
  }
  for (std::size_t i = 0; i < std::min(told_paths, panel.paths.size()); ++i) {
    const std::string number = std::to_string(i + 1);
    const double size = small_size, width = text_width(number, size, true);
    if (const auto place = placer.place(tip(panel.paths[i]), width, size, 7, 60)) {
      canvas.text({place->left, (place->top + place->bottom) / 2}, number, {.size = size, .bold = true, .halo = 3});
    }
  }
}

/// The panel's heading; returns where it ends.
double draw_heading(Canvas& canvas, const Plan& plan, const Panel& panel, double left, double top, double width) {
  const bool many = plan.request.transmitters.size() > 1;
  const Vec3& p = panel.profile->position;
  const std::string place =
      fmt::format(" ({}, {}, {}) m", number_text(p.x, 1), number_text(p.y, 1), number_text(p.z, 1));
  const double place_width = text_width(place, small_size);
  const std::string name = shorten(panel.profile->name, width - place_width, body_size, true);
  double y = top + 0.5 * body_size;
  canvas.text({left, y}, name, {.size = body_size, .bold = true});
  canvas.text({left + text_width(name, body_size, true), y}, place, {.size = small_size, .colour = grey});
  y += 1.45 * body_size;
  for (std::size_t i = 0; i < panel.totals.size(); ++i) {
    const Colour colour = many ? mix(transmitter_colour(panel.total_transmitter[i]), black, 0.25) : black;
    canvas.text({left, y}, shorten(panel.totals[i], width, small_size), {.size = small_size, .colour = colour});
    y += line_height;
  }
  for (std::size_t i = 0; i < std::min(told_paths, panel.paths.size()); ++i) {
    const ShownPath& path = panel.paths[i];
    const std::string from = many ? plan.request.transmitters[path.transmitter].name + ", " : "";
    const std::string figures =
        fmt::format("{} dB, {}", number_text(path.decibels, 1), delay_text(path.story->delay, plan));
    const std::string story = path.story->interactions.empty() ? "direct" : path.story->interactions;
    canvas.text({left, y}, std::to_string(i + 1), {.size = small_size, .bold = true});
    const double indent = 24;
    const double figures_width = text_width(figures, small_size);
    canvas.text({left + width, y}, figures, {.size = small_size, .colour = grey}, Align::end);
    canvas.text({left + indent, y}, shorten(from + story, width - indent - figures_width - 20, small_size),
                {.size = small_size, .colour = grey});
    y += line_height;
  }
  return y;
}

}  // namespace

Canvas profile_picture(const Plan& plan, const Result& result) {
  const ShownQuantity quantity = shown_quantity(plan);
  const std::size_t count = std::min(result.profiles.size(), most_profiles);
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < count; ++i) panels.push_back(make_panel(plan, result.profiles[i], quantity));

  // One column for up to three receivers, two for more.
  const std::size_t columns = count > 3 ? 2 : 1, rows = (count + columns - 1) / columns;
  const double width = (sheet_width - 2 * outer_margin - double(columns - 1) * column_gap) / double(columns);
  const double plot_height = columns == 1 ? 380 : 300;
  std::vector<double> heading(rows, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    heading[i / columns] =
        std::max(heading[i / columns], 1.6 * body_size + double(panels[i].heading_lines()) * line_height + 8);
  }
  const double title_height = 1.35 * title_size + 1.4 * body_size + 26;
  double height = outer_margin + title_height + outer_margin;
  for (const double h : heading) height += h + plot_height + x_axis_height(small_size) + panel_gap;
  const std::size_t left_out = result.profiles.size() - count;
  height += left_out > 0 || count == 0 ? 1.5 * body_size : -panel_gap;

  Canvas canvas(int(sheet_width), int(std::ceil(height)));
  const std::string noun = plan.request.kind == WaveKind::radio ? "Power-delay profiles" : "Echograms";
  const double room = sheet_width - 2 * outer_margin;
  std::string title = noun + " at " + band_words(plan);
  std::string subtitle;
  for (const std::string& part : method_words(plan)) subtitle += (subtitle.empty() ? "" : title_separator) + part;
  if (plan.request.transmitters.size() == 1) title += title_separator + transmitter_words(plan);
  if (result.interrupted) title += std::string(title_separator) + "interrupted run";
  canvas.text({outer_margin, outer_margin + 0.4 * title_size}, shorten(title, room, title_size, true),
              {.size = title_size, .bold = true});
  canvas.text({outer_margin, outer_margin + 1.75 * title_size}, shorten(subtitle, room, body_size),
              {.size = body_size, .colour = grey});

  double top = outer_margin + title_height;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns && row * columns + column < count; ++column) {
      const Panel& panel = panels[row * columns + column];
      const double left = outer_margin + double(column) * (width + column_gap);
      draw_heading(canvas, plan, panel, left, top, width);
      PlotBox box{left, std::round(top + heading[row]), std::round(left + width), 0};
      box.bottom = box.top + plot_height;
      if (!panel.decibels) {
        canvas.frame(box, {150, 150, 150}, 2);
        canvas.text({(box.left + box.right) / 2, (box.top + box.bottom) / 2}, "nothing arrived",
                    {.size = body_size, .colour = grey}, Align::middle);
        continue;
      }
      const Ticks y_ticks = axis_ticks(*panel.decibels, box.height(), small_size, false);
      box.left = std::round(left + y_axis_width(y_ticks, small_size));
      const Ticks x_ticks = axis_ticks(*panel.delay, box.width(), small_size, true);
      for (const double value : y_ticks.at) {
        const double y = std::round(box.bottom - box.height() * (value - panel.decibels->low) /
                                                     (panel.decibels->high - panel.decibels->low));
        canvas.line({box.left, y}, {box.right, y}, {225, 225, 225}, 1);
      }
      draw_bars_and_stems(canvas, plan, panel, quantity, box);
      canvas.frame(box, black, 2);
      draw_x_axis(canvas, box, *panel.delay, x_ticks, std::string("delay (") + delay_unit(plan).name + ")", small_size);
      draw_y_axis(canvas, box, *panel.decibels, y_ticks, quantity.name + " (" + quantity.unit + ")", "level (dB)",
                  small_size);
    }
    top += heading[row] + plot_height + x_axis_height(small_size) + panel_gap;
  }
  if (left_out > 0 || count == 0) {
    const std::string note =
        count == 0 ? "no receivers" : fmt::format("{} more receivers are left out here; result.h5 has them.", left_out);
    canvas.text({outer_margin, height - outer_margin - 0.4 * body_size}, note, {.size = body_size, .colour = grey});
  }
  return canvas;
}

void draw_profiles(const std::filesystem::path& file, const Plan& plan, const Result& result) {
  write_text(file, profile_picture(plan, result).png());
}

}  // namespace grimaldi
