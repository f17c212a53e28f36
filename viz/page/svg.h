// A drawing as SVG text for use in an HTML page.
#pragma once
#include "viz/page/drawing.h"

namespace voussoir {

/// Text for HTML and SVG, in attributes too.
std::string escaped(std::string_view text);

class SvgDrawing : public Drawing {
 public:
  /// `description` is the text for screen readers.
  SvgDrawing(double width, double height, std::string_view description);
  void curve(const Path& points, const std::string& colour, double width = 1.0, const char* dashes = "") override;
  void area(const Path& points, const std::string& fill) override;
  void areas(const std::vector<Path>& outlines, const std::string& fill) override;
  void rectangle(double x, double y, double width, double height, const ShapeStyle& style,
                 std::string_view hint = {}) override;
  void text(double x, double y, std::string_view text, const TextStyle& style = {}) override;
  void marker(Marker marker, double x, double y, const std::string& colour, std::string_view hint = {},
              double half = 5.0) override;
  std::string finished() const;

 private:
  std::string text_;
};

}  // namespace voussoir
