#pragma once
// A sheet of pixels to draw on. The one door to cairo.
//
// Coordinates are pixels from the upper left corner, y downwards; pixel (i, j) covers [i, i + 1] × [j, j + 1].

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grimaldi {

/// A colour of the sRGB space.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

inline constexpr Colour black{0, 0, 0}, white{255, 255, 255};

/// `a` with the share `t` (0 … 1) of `b` mixed in, rounded to 8 bits.
Colour mix(Colour a, Colour b, double t);

struct PlotPoint {
  double x = 0, y = 0;
};

struct PlotBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool overlaps(const PlotBox& b) const { return left < b.right && b.left < right && top < b.bottom && b.top < bottom; }
  bool contains(const PlotBox& b) const {
    return left <= b.left && b.right <= right && top <= b.top && b.bottom <= bottom;
  }
};

enum class Align { start, middle, end };

struct TextStyle {
  double size = 22;  ///< of the font, px
  bool bold = false;
  Colour colour = black;
  double halo = 0;       ///< width of a white rim around the letters, px
  bool upwards = false;  ///< turned by 90°, read from below
};

/// Advance width of a line of text, px, in DejaVu Sans (or the system's sans serif where that is not installed).
/// `text` is UTF-8; what is not valid, and control characters, are drawn and measured as U+FFFD.
double text_width(std::string_view text, double size, bool bold = false);

/// `text` if it is no wider than `width` px, else as much of its beginning and end as fits, with an ellipsis between:
/// names that differ in their last letters stay different.
std::string shorten(std::string_view text, double width, double size, bool bold = false);

/// `text` with every byte that is not part of valid UTF-8, and every control character, replaced by U+FFFD.
std::string printable(std::string_view text);

class Canvas {
 public:
  /// A white sheet. Requires 1 ≤ width, height ≤ 32767 (the limit of cairo's image surfaces). Throws std::bad_alloc.
  Canvas(int width, int height);
  ~Canvas();
  Canvas(Canvas&&) noexcept;

  int width() const { return width_; }
  int height() const { return height_; }

  void fill(const PlotBox& box, Colour colour, double opacity = 1);
  /// The outline of `box`, the line centred on it.
  void frame(const PlotBox& box, Colour colour, double line_width);
  void line(PlotPoint a, PlotPoint b, Colour colour, double line_width, double opacity = 1);
  /// Many separate lines with round ends, cut off at `clip`.
  void lines(std::span<const std::pair<PlotPoint, PlotPoint>> segments, const PlotBox& clip, Colour colour,
             double line_width, double opacity = 1);
  /// A filled polygon with an outline around it (outline_width = 0: none).
  void polygon(std::span<const PlotPoint> corners, Colour fill, Colour outline, double outline_width);
  void disc(PlotPoint centre, double radius, Colour fill, Colour outline, double outline_width);
  /// One line of text. `at` is its start, middle or end along the line, and half the height of its capitals across it.
  void text(PlotPoint at, std::string_view text, const TextStyle& style, Align align = Align::start);
  /// Sets the pixels [left, left + columns) × [top, top + pixels.size()/columns) exactly to `pixels`, rows from the
  /// top. Requires that they lie on the sheet.
  void image(int left, int top, int columns, std::span<const Colour> pixels);

  /// The colour of a pixel as it is now. Requires 0 ≤ x < width, 0 ≤ y < height.
  Colour pixel(int x, int y) const;
  /// The picture as the bytes of a PNG file (8-bit RGB). Throws std::runtime_error if cairo reports a fault.
  std::string png() const;

 private:
  struct Sheet;
  int width_, height_;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace grimaldi
