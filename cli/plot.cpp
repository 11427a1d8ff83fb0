#include "cli/plot.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <stdexcept>

#include "core/contract.h"

#ifdef __SANITIZE_ADDRESS__
// fontconfig keeps about 1 kB for its fonts until the program ends (its cache has no other owner than the process).
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace grimaldi {
namespace {

/// Half the height of a capital over the size of the font: DejaVu Sans has capitals of 0.729 em.
constexpr double half_capital = 0.3645;

/// Length of the valid UTF-8 sequence at text[i] (RFC 3629: no overlong forms, no surrogates, up to U+10FFFF); 0 if
/// there is none.
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u; };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !follows(1)) return 0;
  if (first < 0xE0) return 2;
  if (first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second > 0x9F;
    return follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  const bool overlong = first == 0xF0 && second < 0x90, beyond = first == 0xF4 && second > 0x8F;
  return follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
}

void set_font(cairo_t* cairo, double size, bool bold) {
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
  // Positions do not depend on the size's rounding, edges are grey on any screen: the same picture everywhere.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

void set_colour(cairo_t* cairo, Colour colour, double opacity = 1) {
  cairo_set_source_rgba(cairo, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0, opacity);
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Colour mix(Colour a, Colour b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    // C0 controls, delete, and the C1 controls U+0080 … U+009F (0xC2 0x80 … 0x9F).
    const bool control = first < 0x20 || first == 0x7F ||
                         (length == 2 && first == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0);
    if (length == 0 || control) {
      result += "\uFFFD";
    } else {
      result += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

struct Canvas::Sheet {
  cairo_surface_t* surface;
  cairo_t* cairo;
  Sheet(int width, int height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), cairo(cairo_create(surface)) {}
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  ~Sheet() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }
};

double text_width(std::string_view text, double size, bool bold) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  cairo_t* cairo = cairo_create(surface);
  set_font(cairo, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, printable(text).c_str(), &extents);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return extents.x_advance;
}

std::string shorten(std::string_view text, double width, double size, bool bold) {
  const std::string whole = printable(text);
  if (text_width(whole, size, bold) <= width) return whole;
  std::vector<std::size_t> starts;  // of the characters, and the end
  for (std::size_t i = 0; i < whole.size(); i += sequence_length(whole, i)) starts.push_back(i);
  starts.push_back(whole.size());
  const auto keep = [&](std::size_t count) {
    const std::size_t tail = count / 2, head = count - tail;
    return whole.substr(0, starts[head]) + "…" + whole.substr(starts[starts.size() - 1 - tail]);
  };
  std::size_t fits = 0, too_many = starts.size() - 1;
  while (too_many - fits > 1) {
    const std::size_t count = (fits + too_many) / 2;
    (text_width(keep(count), size, bold) <= width ? fits : too_many) = count;
  }
  return keep(fits);
}

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
  GRIMALDI_EXPECT(width >= 1 && width <= 32767 && height >= 1 && height <= 32767);
  sheet_ = std::make_unique<Sheet>(width, height);
  if (cairo_status(sheet_->cairo) == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  fill({0, 0, double(width), double(height)}, white);
}
Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;

void Canvas::fill(const PlotBox& box, Colour colour, double opacity) {
  set_colour(sheet_->cairo, colour, opacity);
  cairo_rectangle(sheet_->cairo, box.left, box.top, box.width(), box.height());
  cairo_fill(sheet_->cairo);
}

void Canvas::frame(const PlotBox& box, Colour colour, double line_width) {
  set_colour(sheet_->cairo, colour);
  cairo_set_line_width(sheet_->cairo, line_width);
  cairo_set_line_join(sheet_->cairo, CAIRO_LINE_JOIN_MITER);
  cairo_rectangle(sheet_->cairo, box.left, box.top, box.width(), box.height());
  cairo_stroke(sheet_->cairo);
}

void Canvas::line(PlotPoint a, PlotPoint b, Colour colour, double line_width, double opacity) {
  set_colour(sheet_->cairo, colour, opacity);
  cairo_set_line_width(sheet_->cairo, line_width);
  cairo_set_line_cap(sheet_->cairo, CAIRO_LINE_CAP_BUTT);
  cairo_move_to(sheet_->cairo, a.x, a.y);
  cairo_line_to(sheet_->cairo, b.x, b.y);
  cairo_stroke(sheet_->cairo);
}

void Canvas::lines(std::span<const std::pair<PlotPoint, PlotPoint>> segments, const PlotBox& clip, Colour colour,
                   double line_width, double opacity) {
  cairo_t* cairo = sheet_->cairo;
  cairo_save(cairo);
  cairo_rectangle(cairo, clip.left, clip.top, clip.width(), clip.height());
  cairo_clip(cairo);
  set_colour(cairo, colour, opacity);
  cairo_set_line_width(cairo, line_width);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  // cairo's time grows faster than the length of a path, so a city is stroked in pieces.
  constexpr std::size_t piece = 64;
  std::size_t in_path = 0;
  for (const auto& [a, b] : segments) {
    const PlotBox extent{std::min(a.x, b.x) - line_width, std::min(a.y, b.y) - line_width,
                         std::max(a.x, b.x) + line_width, std::max(a.y, b.y) + line_width};
    if (!extent.overlaps(clip)) continue;
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
    if (++in_path % piece == 0) cairo_stroke(cairo);
  }
  cairo_stroke(cairo);
  cairo_restore(cairo);
}

void Canvas::polygon(std::span<const PlotPoint> corners, Colour fill, Colour outline, double outline_width) {
  cairo_t* cairo = sheet_->cairo;
  cairo_new_path(cairo);
  for (const PlotPoint& p : corners) cairo_line_to(cairo, p.x, p.y);
  cairo_close_path(cairo);
  if (outline_width > 0) {
    // Twice the width under the filling leaves the whole width outside, so that the shape keeps its size.
    set_colour(cairo, outline);
    cairo_set_line_width(cairo, 2 * outline_width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(cairo);
  }
  set_colour(cairo, fill);
  cairo_fill(cairo);
}

void Canvas::disc(PlotPoint centre, double radius, Colour fill, Colour outline, double outline_width) {
  cairo_t* cairo = sheet_->cairo;
  cairo_new_path(cairo);
  cairo_arc(cairo, centre.x, centre.y, radius + outline_width, 0, 2 * std::numbers::pi);
  set_colour(cairo, outline);
  cairo_fill(cairo);
  cairo_arc(cairo, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
  set_colour(cairo, fill);
  cairo_fill(cairo);
}

void Canvas::text(PlotPoint at, std::string_view text, const TextStyle& style, Align align) {
  cairo_t* cairo = sheet_->cairo;
  const std::string line = printable(text);
  set_font(cairo, style.size, style.bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, line.c_str(), &extents);
  const double shift = align == Align::start ? 0 : align == Align::middle ? -extents.x_advance / 2 : -extents.x_advance;
  cairo_save(cairo);
  // Whole pixels for the base line: crisp stems.
  if (style.upwards) {
    cairo_translate(cairo, std::round(at.x + half_capital * style.size), std::round(at.y - shift));
    cairo_rotate(cairo, -std::numbers::pi / 2);
  } else {
    cairo_translate(cairo, std::round(at.x + shift), std::round(at.y + half_capital * style.size));
  }
  cairo_move_to(cairo, 0, 0);
  if (style.halo > 0) {
    cairo_text_path(cairo, line.c_str());
    set_colour(cairo, white, 0.85);
    cairo_set_line_width(cairo, 2 * style.halo);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
    cairo_move_to(cairo, 0, 0);
  }
  set_colour(cairo, style.colour);
  cairo_show_text(cairo, line.c_str());
  cairo_new_path(cairo);
  cairo_restore(cairo);
}

void Canvas::image(int left, int top, int columns, std::span<const Colour> pixels) {
  GRIMALDI_EXPECT(columns > 0 && left >= 0 && top >= 0 && left + columns <= width_);
  GRIMALDI_EXPECT(std::size_t(top) + pixels.size() / std::size_t(columns) <= std::size_t(height_));
  cairo_surface_flush(sheet_->surface);
  unsigned char* data = cairo_image_surface_get_data(sheet_->surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(sheet_->surface);
  const std::ptrdiff_t rows = std::ptrdiff_t(pixels.size()) / columns;
  for (std::ptrdiff_t j = 0; j < rows; ++j) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + (top + j) * stride) + left;
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
      const Colour& c = pixels[std::size_t(j * columns + i)];
      row[i] = std::uint32_t(c.red) << 16 | std::uint32_t(c.green) << 8 | c.blue;
    }
  }
  cairo_surface_mark_dirty(sheet_->surface);
}

Colour Canvas::pixel(int x, int y) const {
  GRIMALDI_EXPECT(x >= 0 && x < width_ && y >= 0 && y < height_);
  cairo_surface_flush(sheet_->surface);
  const unsigned char* data = cairo_image_surface_get_data(sheet_->surface);
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(sheet_->surface);
  const std::uint32_t value = reinterpret_cast<const std::uint32_t*>(data + y * stride)[x];
  return {std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

std::string Canvas::png() const {
  cairo_status_t status = cairo_status(sheet_->cairo);
  std::string bytes;
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png_stream(sheet_->surface, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("the picture could not be drawn (cairo: ") + cairo_status_to_string(status) +
                             ")");
  }
  return bytes;
}

}  // namespace grimaldi
