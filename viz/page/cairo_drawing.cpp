// The only place that knows cairo.
#include "viz/page/cairo_drawing.h"

#include <cairo-pdf.h>
#include <cairo.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <sstream>

#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"

namespace voussoir {

namespace {

using Path = Drawing::Path;
using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

bool is_finite(const std::pair<double, double>& p) {
  return std::isfinite(p.first) && std::isfinite(p.second);
}

class CairoDrawing : public Drawing {
 public:
  explicit CairoDrawing(cairo_t* to) : to_(to) {
    cairo_set_line_join(to_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(to_, CAIRO_LINE_CAP_BUTT);
  }

  void curve(const Path& points, const std::string& colour, double width, const char* pattern) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_finite(points[i])) continue;
      const bool after = i > 0 && is_finite(points[i - 1]);
      (after ? cairo_line_to : cairo_move_to)(to_, points[i].first, points[i].second);
    }
    set_colour(colour);
    cairo_set_line_width(to_, width);
    const std::vector<double> dashes = dashes_of(pattern);
    cairo_set_dash(to_, dashes.data(), int(dashes.size()), 0.0);
    cairo_stroke(to_);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool before = i > 0 && is_finite(points[i - 1]), after = i + 1 < points.size() && is_finite(points[i + 1]);
      if (is_finite(points[i]) && !before && !after) disc(points[i], std::max(2.0, width), colour);  // by itself
    }
  }

  void area(const Path& points, const std::string& fill) override { areas({points}, fill); }

  void areas(const std::vector<Path>& outlines, const std::string& fill) override {
    for (const Path& outline : outlines) {
      bool first = true;
      for (const auto& p : outline)
        if (is_finite(p)) (first ? cairo_move_to : cairo_line_to)(to_, p.first, p.second), first = false;
      if (!first) cairo_close_path(to_);
    }
    set_colour(fill);
    cairo_fill(to_);
  }

  void rectangle(double x, double y, double width, double height, const ShapeStyle& style, std::string_view) override {
    width = std::max(width, 0.0), height = std::max(height, 0.0);
    const Path corners = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}};
    if (style.fill != "none") area(corners, style.fill);
    if (style.stroke != "none") curve(corners, style.stroke, style.width, style.dashes.c_str());
  }

  void text(double x, double y, std::string_view words, const TextStyle& style) override {
    const std::string text(words), anchor = style.anchor;
    cairo_select_font_face(to_, "Arial", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(to_, style.size);
    cairo_text_extents_t extents;
    cairo_text_extents(to_, text.c_str(), &extents);
    const double back = anchor == "start" ? 0.0 : anchor == "end" ? extents.x_advance : 0.5 * extents.x_advance;
    cairo_save(to_);
    cairo_translate(to_, x, y);
    cairo_rotate(to_, style.turn * pi / 180.0);
    cairo_move_to(to_, -back, 0.0);
    set_colour(colour_code(style.colour));
    cairo_show_text(to_, text.c_str());
    cairo_restore(to_);
    cairo_new_path(to_);
  }

  void marker(Marker marker, double x, double y, const std::string& colour, std::string_view, double half) override {
    const double r = 1.3 * half;
    switch (marker) {
      case Marker::circle:
        return disc({x, y}, half, colour);
      case Marker::square:
        return rectangle(x - half + 0.5, y - half + 0.5, 2.0 * half - 1.0, 2.0 * half - 1.0,
                         {"#ffffff", colour, 2.0, {}}, {});
      case Marker::triangle:
        return area({{x, y - 1.2 * half}, {x + 1.2 * half, y + 0.9 * half}, {x - 1.2 * half, y + 0.9 * half}}, colour);
      case Marker::diamond:
        const Path corners = {{x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, {x, y - r}};
        area(corners, "#ffffff");
        return curve(corners, colour, 2.0, "");
    }
  }

 private:
  static std::vector<double> dashes_of(const char* pattern) {
    std::istringstream words(pattern);
    std::vector<double> lengths;
    double sum = 0.0;
    for (double length; words >> length; sum += length) lengths.push_back(length);
    return sum > 0.0 ? lengths : std::vector<double>{};
  }

  /// The colour of a code "#0072b2".
  void set_colour(const std::string& code) {
    unsigned rgb = 0;
    std::from_chars(code.data() + 1, code.data() + code.size(), rgb, 16);
    cairo_set_source_rgb(to_, double(rgb >> 16) / 255.0, double(rgb >> 8 & 255) / 255.0, double(rgb & 255) / 255.0);
  }

  void disc(const std::pair<double, double>& middle, double radius, const std::string& colour) {
    cairo_new_sub_path(to_);
    cairo_arc(to_, middle.first, middle.second, radius, 0.0, 2.0 * pi);
    set_colour(colour);
    cairo_fill(to_);
  }

  cairo_t* to_;
};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check_drawn(cairo_status_t status, const std::string& file) {
  if (status != CAIRO_STATUS_SUCCESS) throw RunError("{} cannot be drawn: {}", file, cairo_status_to_string(status));
}

void write_drawn(const std::string& file, const std::string& bytes) {
  make_folder_of(file);
  write_atomically(file, bytes);
}

}  // namespace

void write_pdf(const std::vector<DrawOn>& pages, double width, double height, const std::string& pdf) {
  constexpr double points = 72.0 / 96.0;  // a px
  std::string bytes;
  {
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, points * width, points * height),
                          cairo_surface_destroy);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
    for (const DrawOn& draw_on : pages) {
      const Context context(cairo_create(surface.get()), cairo_destroy);
      cairo_scale(context.get(), points, points);
      CairoDrawing drawing(context.get());
      draw_on(drawing);
      check_drawn(cairo_status(context.get()), pdf);
      cairo_show_page(context.get());
    }
    cairo_surface_finish(surface.get());
    check_drawn(cairo_surface_status(surface.get()), pdf);
  }
  write_drawn(pdf, bytes);
}

void write_png(const DrawOn& draw_on, double width, double height, const std::string& png, int pixels) {
  const double scale = pixels / width;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels, int(std::lround(scale * height))),
                        cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  cairo_scale(context.get(), scale, scale);
  CairoDrawing drawing(context.get());
  draw_on(drawing);
  check_drawn(cairo_status(context.get()), png);
  std::string bytes;
  check_drawn(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), png);
  write_drawn(png, bytes);
}

}  // namespace voussoir
