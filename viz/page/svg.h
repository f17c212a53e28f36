// Small charts as SVG text, to stand inside an HTML page: a drawing with the few shapes that charts need, and axes.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viz/palette.h"

namespace voussoir {

/// Text for HTML and SVG, in attributes too.
std::string escaped(std::string_view text);
/// "#0072b2".
std::string colour_code(const Colour& colour);
/// At most this many characters, the last one … where some are left out.
std::string shortened(const std::string& text, std::size_t most);
/// Characters, not bytes.
std::size_t characters(std::string_view text);

constexpr double kTextSize = 13.0;  // px
/// A width that the text surely fits into; fonts differ.
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

class SvgDrawing {
 public:
  /// `description` is what a screen reader says.
  SvgDrawing(double width, double height, std::string_view description);
  void line(double x1, double y1, double x2, double y2, const std::string& colour, double width = 1.0,
            const char* dashes = "");
  /// Through points (px); those that are not finite break it.
  void curve(const std::vector<std::pair<double, double>>& points, const std::string& colour, double width = 1.0,
             const char* dashes = "");
  /// A filled outline.
  void area(const std::vector<std::pair<double, double>>& points, const std::string& fill);
  /// `hint` is shown under the mouse.
  void rectangle(double x, double y, double width, double height, const ShapeStyle& style, std::string_view hint = {});
  void text(double x, double y, std::string_view text, const TextStyle& style = {});
  /// `half` is half its size, px.
  void marker(Marker marker, double x, double y, const std::string& colour, std::string_view hint = {},
              double half = 5.0);
  /// Horizontal or vertical bar with end strokes of twice `half`.
  void error_bar(double x1, double y1, double x2, double y2, const std::string& colour, double half = 4.0);
  std::string finished() const;

 private:
  std::string text_;
};

/// Where a value stands between two places of a drawing.
struct SvgAxis {
  enum class Kind { linear, logarithmic, squeezed };  // squeezed: linear near 0, logarithmic far off (asinh)
  Kind kind = Kind::linear;
  double low = 0.0, high = 1.0;     // values
  double begin = 0.0, end = 100.0;  // px

  double at(double value) const;
  /// Round values, not closer to each other than `apart` px.
  std::vector<double> ticks(double apart = 44.0) const;
};
/// Wide enough for all finite values, and a little more; logarithmic where they differ much and all are above 0.
SvgAxis axis_around(const std::vector<double>& values, double begin, double end);
/// "0.15", without zeros at the end.
std::string tick_text(double value);

/// Grid lines, numbers and title of a horizontal axis below a plot from y `top` to `bottom`.
void draw_axis_below(SvgDrawing& drawing, const SvgAxis& axis, double top, double bottom, std::string_view title);

/// Markers with their words in a row; takes 20 px.
struct LegendEntry {
  Marker marker;
  std::string colour, text;
};
void draw_legend(SvgDrawing& drawing, double x, double y, const std::vector<LegendEntry>& entries);

constexpr const char *kGridColour = "#dcdce0", *kBandColour = "#ececf0", *kFrameColour = "#8a8a92";

}  // namespace voussoir
