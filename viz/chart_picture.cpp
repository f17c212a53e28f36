#include "viz/chart_picture.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "solver/base/error.h"
#include "viz/display.h"
#include "viz/offscreen.h"
#include "viz/overlay.h"

namespace voussoir {

namespace {

using Path = Drawing::Path;

/// The colour of a code "#0072b2".
Colour colour_of(const std::string& code) {
  unsigned rgb = 0;
  std::from_chars(code.data() + 1, code.data() + code.size(), rgb, 16);
  return {double(rgb >> 16) / 255.0, double(rgb >> 8 & 255) / 255.0, double(rgb & 255) / 255.0};
}

/// The pieces of a line that dashes leave, `on` and `off` long.
std::vector<Path> dashes(const Path& line, double on, double off) {
  std::vector<Path> pieces;
  bool drawing = false;
  double left = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    auto [x, y] = line[i];
    const auto [x1, y1] = line[i + 1];
    for (double length = std::hypot(x1 - x, y1 - y); length > 0.0;) {
      if (left <= 0.0) {
        drawing = !drawing, left = drawing ? on : off;
        if (drawing) pieces.push_back({{x, y}});
      }
      const double part = std::min(left, length);
      x += (x1 - x) * part / length, y += (y1 - y) * part / length;
      left -= part, length -= part;
      if (drawing) pieces.back().emplace_back(x, y);
    }
  }
  return pieces;
}

/// The parts of a path between points that are not finite.
std::vector<Path> unbroken(const Path& points) {
  std::vector<Path> parts(1);
  for (const auto& p : points)
    if (std::isfinite(p.first) && std::isfinite(p.second))
      parts.back().push_back(p);
    else if (!parts.back().empty())
      parts.emplace_back();
  return parts;
}

/// A drawing on an overlay, whose pixels count from the lower left and are `scale` to one of the drawing's.
class PictureDrawing : public Drawing {
 public:
  PictureDrawing(vtkRenderer* renderer, double height, double scale)
      : overlay_(renderer), height_(height), scale_(scale) {}

  void curve(const Path& points, const std::string& colour, double width, const char* pattern) override {
    double on = 0.0, off = 0.0;
    std::istringstream(pattern) >> on >> off;
    std::vector<Path> lines;
    for (const Path& part : unbroken(points)) {
      if (part.size() == 1) disc(part[0].first, part[0].second, std::max(2.0, width), colour);
      if (part.size() < 2) continue;
      for (const Path& piece : on > 0.0 ? dashes(part, on, off) : std::vector<Path>{part})
        lines.push_back(placed(piece));
    }
    if (!lines.empty()) overlay_.polylines(lines, scale_ * width, colour_of(colour));
  }

  void area(const Path& points, const std::string& fill) override {
    Path outline;
    for (const Path& part : unbroken(points)) outline.insert(outline.end(), part.begin(), part.end());
    if (outline.size() > 2) overlay_.polygon(placed(outline), colour_of(fill));
  }

  void areas(const std::vector<Path>& outlines, const std::string& fill) override {
    std::vector<Path> there;
    for (const Path& outline : outlines)
      if (outline.size() > 2) there.push_back(placed(outline));
    if (!there.empty()) overlay_.polygons(there, colour_of(fill));
  }

  void rectangle(double x, double y, double width, double height, const ShapeStyle& style, std::string_view) override {
    const Path corners = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}};
    if (style.fill != "none") area(corners, style.fill);
    if (style.stroke != "none") curve(corners, style.stroke, style.width, style.dashes.c_str());
  }

  void text(double x, double y, std::string_view words, const TextStyle& style) override {
    const std::string_view anchor = style.anchor;
    const Align align = anchor == "start" ? Align::left : anchor == "end" ? Align::right : Align::centre;
    // Upright text is centred on its place; the baseline is a third of its height beside that.
    if (style.turn != 0.0)
      return overlay_.upright_text(scale_ * (x - style.size / 3.0), up(y), std::string(words), scale_ * style.size);
    // Text stands on the lowest of its letters.
    overlay_.text(scale_ * x, up(y + 0.22 * style.size), std::string(words), scale_ * style.size, align, style.colour,
                  style.bold);
  }

  void marker(Marker marker, double x, double y, const std::string& colour, std::string_view, double half) override {
    const double r = 1.3 * half;
    switch (marker) {
      case Marker::circle:
        return disc(x, y, half, colour);
      case Marker::square:
        return rectangle(x - half + 0.5, y - half + 0.5, 2.0 * half - 1.0, 2.0 * half - 1.0, {"#ffffff", colour, 2.0},
                         {});
      case Marker::triangle:
        return area({{x, y - 1.2 * half}, {x + 1.2 * half, y + 0.9 * half}, {x - 1.2 * half, y + 0.9 * half}}, colour);
      case Marker::diamond:
        const Path corners = {{x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, {x, y - r}};
        area(corners, "#ffffff");
        return curve(corners, colour, 2.0, "");
    }
  }

 private:
  double up(double y) const { return scale_ * (height_ - y); }
  Path placed(const Path& points) const {
    Path there;
    for (const auto& [x, y] : points) there.emplace_back(scale_ * x, up(y));
    return there;
  }
  void disc(double x, double y, double radius, const std::string& colour) {
    overlay_.disc(scale_ * x, up(y), scale_ * radius, colour_of(colour));
  }

  Overlay overlay_;
  double height_, scale_;
};

bool shows(const LineChart& chart, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && !(chart.log_x && x <= 0.0) && !(chart.log_y && y <= 0.0);
}

void check(const LineChart& chart) {
  if (chart.curves.empty()) throw InputError("chart '{}': there is nothing to plot", chart.title);
  bool any = false;
  for (const ChartCurve& c : chart.curves) {
    if (c.x.size() != c.y.size())
      throw InputError("chart '{}': series '{}' has {} x and {} y values; give as many of each", chart.title, c.name,
                       c.x.size(), c.y.size());
    if (c.x.empty()) throw InputError("chart '{}': series '{}' is empty", chart.title, c.name);
    for (std::size_t i = 0; i < c.x.size(); ++i) any = any || shows(chart, c.x[i], c.y[i]);
  }
  if (!any)
    throw InputError("chart '{}': no point can be drawn{}", chart.title,
                     chart.log_x || chart.log_y ? "; logarithmic axes need values above 0" : "; all are NaN");
}

}  // namespace

void write_picture(const LineChart& chart, const std::string& png, int width) {
  check(chart);
  write_picture([&](Drawing& drawing) { draw(drawing, chart); }, chart.width, height_of(chart), png, width);
}

void write_picture(const std::function<void(Drawing&)>& draw_on, double drawn_width, double height,
                   const std::string& png, int width) {
  const Display display;
  const double scale = width / drawn_width;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  PictureDrawing drawing(renderer, height, scale);
  draw_on(drawing);
  const auto window = offscreen_window(width, int(std::lround(scale * height)));
  window->AddRenderer(renderer);
  write_png(window, png);
}

}  // namespace voussoir
