// Flat drawing on top of a picture: text, lines, filled rectangles, in pixels of the finished picture from its lower
// left.
#pragma once
#include <vtkRenderer.h>

#include <string>
#include <utility>
#include <vector>

#include "viz/page/palette.h"

namespace voussoir {

enum class Align { left, centre, right };

class Overlay {
 public:
  explicit Overlay(vtkRenderer* renderer) : renderer_(renderer) {}

  /// Baseline of the text at (x, y); `size` is the font's height in pixels.
  void text(double x, double y, const std::string& words, double size, Align align = Align::left,
            const Colour& colour = kInk, bool bold = false);
  /// The same, rotated to read upwards and centred on (x, y).
  void upright_text(double x, double y, const std::string& words, double size);
  /// Width in pixels that text() takes.
  static double text_width(const std::string& words, double size);
  void line(double x0, double y0, double x1, double y1, double width, const Colour& colour = kInk);
  void rectangle(double x, double y, double width, double height, const Colour& colour);
  /// A line through (x, y) pairs.
  void polyline(const std::vector<std::pair<double, double>>& points, double width, const Colour& colour);
  /// Many lines, one through each list of points.
  void polylines(const std::vector<std::vector<std::pair<double, double>>>& lines, double width, const Colour& colour);
  void disc(double x, double y, double radius, const Colour& colour);
  /// A filled polygon, convex or not; (x, y) pairs.
  void polygon(const std::vector<std::pair<double, double>>& corners, const Colour& colour);
  void polygons(const std::vector<std::vector<std::pair<double, double>>>& outlines, const Colour& colour);

 private:
  vtkRenderer* renderer_;
};

/// The largest of 1, 2, 5 × 10^n that is not above `limit` (> 0).
double nice_below(double limit);
/// The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10^n that is not below `value` (> 0). On a scale with this
/// upper end the value is at least at two thirds of the scale.
double nice_above(double value);

}  // namespace voussoir
