#include "viz/page/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

std::string shape_attributes(const ShapeStyle& s) {
  std::string text = fmt::format(" fill=\"{}\" stroke=\"{}\"", s.fill, s.stroke);
  if (s.stroke != "none") text += fmt::format(" stroke-width=\"{:g}\"", s.width);
  if (!s.dashes.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", s.dashes);
  return text;
}

std::string hint_element(std::string_view hint) {
  return hint.empty() ? std::string() : fmt::format("<title>{}</title>", escaped(hint));
}

std::string triangle(double x, double y, double half) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}h{:.1f}z\"", x, y - 1.2 * half, 1.2 * half, 2.1 * half,
                     -2.4 * half);
}

std::string diamond(double x, double y, double half) {
  const double r = 1.3 * half;
  return fmt::format("<path d=\"M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}l{3:.1f} {2:.1f}l{3:.1f} {3:.1f}z\"", x, y - r, r, -r);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (char c : text) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        // Control characters are not allowed in a page.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') safe += c;
    }
  return safe;
}

SvgDrawing::SvgDrawing(double width, double height, std::string_view description) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\" aria-label=\"{2}\" font-family=\"Helvetica Neue, Arial, Liberation Sans, DejaVu Sans, "
      "sans-serif\">\n",
      width, height, escaped(description));
}

void SvgDrawing::curve(const std::vector<std::pair<double, double>>& points, const std::string& colour, double width,
                       const char* dashes) {
  std::string path;
  bool down = false;
  for (const auto& [x, y] : points) {
    const bool here = std::isfinite(x) && std::isfinite(y);
    if (here) path += fmt::format("{}{:.1f} {:.1f}", down ? 'L' : 'M', x, y);
    down = here;
  }
  text_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"", path, colour, width);
  if (*dashes) text_ += fmt::format(" stroke-dasharray=\"{}\"", dashes);
  text_ += "/>\n";
}

void SvgDrawing::area(const std::vector<std::pair<double, double>>& points, const std::string& fill) {
  areas({points}, fill);
}

void SvgDrawing::areas(const std::vector<Path>& outlines, const std::string& fill) {
  std::string paths;
  for (const Path& points : outlines) {
    std::string path;
    for (const auto& [x, y] : points)
      if (std::isfinite(x) && std::isfinite(y)) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
    if (!path.empty()) paths += path + 'z';
  }
  if (!paths.empty()) text_ += fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"none\"/>\n", paths, fill);
}

void SvgDrawing::rectangle(double x, double y, double width, double height, const ShapeStyle& style,
                           std::string_view hint) {
  text_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"{}>{}</rect>\n", x, y,
                       std::max(width, 0.0), std::max(height, 0.0), shape_attributes(style), hint_element(hint));
}

void SvgDrawing::text(double x, double y, std::string_view words, const TextStyle& style) {
  text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" fill=\"{}\"", x, y, style.size,
                       colour_code(style.colour));
  if (std::string_view(style.anchor) != "start") text_ += fmt::format(" text-anchor=\"{}\"", style.anchor);
  if (style.bold) text_ += " font-weight=\"bold\"";
  if (style.turn != 0.0) text_ += fmt::format(" transform=\"rotate({:g} {:.1f} {:.1f})\"", style.turn, x, y);
  text_ += fmt::format(">{}</text>\n", escaped(words));
}

void SvgDrawing::marker(Marker marker, double x, double y, const std::string& colour, std::string_view hint,
                        double half) {
  const std::string full = shape_attributes({colour, "#ffffff", 0.7, ""});
  const std::string hollow = shape_attributes({"#ffffff", colour, 2.0, ""});
  switch (marker) {
    case Marker::circle:
      text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"{}>{}</circle>\n", x, y, half, full,
                           hint_element(hint));
      return;
    case Marker::square:
      return rectangle(x - half + 0.5, y - half + 0.5, 2.0 * half - 1.0, 2.0 * half - 1.0, {"#ffffff", colour, 2.0, ""},
                       hint);
    case Marker::triangle:
      text_ += fmt::format("{}{}>{}</path>\n", triangle(x, y, half), full, hint_element(hint));
      return;
    case Marker::diamond:
      text_ += fmt::format("{}{}>{}</path>\n", diamond(x, y, half), hollow, hint_element(hint));
      return;
  }
}

std::string SvgDrawing::finished() const {
  return text_ + "</svg>\n";
}

}  // namespace voussoir
