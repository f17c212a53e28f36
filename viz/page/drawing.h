// Drawing functions of charts: shapes in pixels from the upper left, for any output (SVG in a page, pixels of a
// picture), and axes.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viz/page/palette.h"

namespace voussoir {

/// "#0072b2".
std::string colour_code(const Colour& colour);
/// The text with at most this many characters; the last one is … if some are left out.
std::string shortened(const std::string& text, std::size_t most);
/// Characters, not bytes.
std::size_t characters(std::string_view text);

constexpr double kTextSize = 13.0;  // px
/// Upper bound of the width of a text, px. Fonts differ.
double text_width(std::string_view text, double size = kTextSize);

enum class Marker { circle, square, triangle, diamond };  // full, hollow, full, hollow

struct TextStyle {
  const char* anchor = "start";  // start, middle, end
  bool bold = false;
  double size = kTextSize;
  double turn = 0.0;  // degrees, clockwise
  Colour colour = kInk;
};

struct ShapeStyle {
  std::string fill = "none", stroke = "none";  // codes
  double width = 1.0;                          // of the stroke
  std::string dashes = {};                     // "4 3"
};

class Drawing {
 public:
  using Path = std::vector<std::pair<double, double>>;
  virtual ~Drawing() = default;
  /// A line through points (px), interrupted at those that are not finite. Dashes: "4 3", on and off.
  virtual void curve(const Path& points, const std::string& colour, double width = 1.0, const char* dashes = "") = 0;
  /// A filled outline.
  virtual void area(const Path& points, const std::string& fill) = 0;
  /// Filled outlines that do not overlap, or that all have the same orientation.
  virtual void areas(const std::vector<Path>& outlines, const std::string& fill);
  /// `hint` is shown under the mouse, if it is not empty.
  virtual void rectangle(double x, double y, double width, double height, const ShapeStyle& style,
                         std::string_view hint = {}) = 0;
  /// Text whose baseline begins, ends or is centred at (x, y).
  virtual void text(double x, double y, std::string_view text, const TextStyle& style = {}) = 0;
  /// `half` is half its size, px.
  virtual void marker(Marker marker, double x, double y, const std::string& colour, std::string_view hint = {},
                      double half = 5.0) = 0;

  void line(double x1, double y1, double x2, double y2, const std::string& colour, double width = 1.0,
            const char* dashes = "");
  /// Horizontal or vertical bar with end strokes of twice `half`.
  void error_bar(double x1, double y1, double x2, double y2, const std::string& colour, double half = 4.0);
};

/// The position of a value between two points of a drawing.
struct ChartAxis {
  enum class Kind { linear, logarithmic, squeezed };  // squeezed: linear near 0, logarithmic for large values (asinh)
  Kind kind = Kind::linear;
  double low = 0.0, high = 1.0;     // values
  double begin = 0.0, end = 100.0;  // px

  double at(double value) const;
  /// Round values at distances of at least `apart` px.
  std::vector<double> ticks(double apart = 44.0) const;
};
/// An axis for all finite values with a margin; logarithmic if the values are all positive and differ much.
ChartAxis axis_around(const std::vector<double>& values, double begin, double end);
/// "0.15", without trailing zeros.
std::string tick_text(double value);

/// Grid lines, numbers and title of a horizontal axis below a plot from y `top` to `bottom`.
void draw_axis_below(Drawing& drawing, const ChartAxis& axis, double top, double bottom, std::string_view title);

/// Markers with their texts in a row, 20 px high.
struct LegendEntry {
  Marker marker;
  std::string colour, text;
};
void draw_legend(Drawing& drawing, double x, double y, const std::vector<LegendEntry>& entries);

constexpr const char *kGridColour = "#dcdce0", *kBandColour = "#ececf0", *kFrameColour = "#8a8a92";

}  // namespace voussoir
