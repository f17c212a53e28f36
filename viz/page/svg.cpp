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

/// 1, 2 or 5 times a power of ten, so that steps are at least `apart` px.
double round_step(const SvgAxis& axis, double apart) {
  const double least = apart * (axis.high - axis.low) / std::abs(axis.end - axis.begin);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10.0 * power;
}

std::vector<double> linear_values(const SvgAxis& axis, double apart) {
  const double step = round_step(axis, apart);
  std::vector<double> values;
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
    values.push_back(k * step);
  return values;
}

/// The roundest first.
std::vector<double> decade_values(const SvgAxis& axis) {
  std::vector<double> values;
  const double first = std::floor(std::log10(axis.low)), last = std::floor(std::log10(axis.high));
  for (double factor : {1.0, 2.0, 5.0, 3.0, 1.5, 7.0})
    for (double decade = first; decade <= last; ++decade) {
      const double value = factor * std::pow(10.0, decade);
      if (value >= axis.low && value <= axis.high) values.push_back(value);
    }
  return values;
}

/// From 0 outwards to both sides; ±1 where there is room.
std::vector<double> squeezed_values(const SvgAxis& axis) {
  std::vector<double> sizes;
  for (double power = 1.0; power < 1e7; power *= 10.0)
    for (double factor : {2.0, 5.0, 10.0}) sizes.push_back(factor * power);
  sizes.push_back(1.0);
  std::vector<double> values = {0.0};
  for (double size : sizes)
    for (double v : {size, -size})
      if (v >= axis.low && v <= axis.high) values.push_back(v);
  return values;
}

/// The earlier ones are kept.
std::vector<double> thinned(const SvgAxis& axis, const std::vector<double>& values, double apart) {
  std::vector<double> kept;
  for (double v : values)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](double other) { return std::abs(axis.at(other) - axis.at(v)) < apart; }))
      kept.push_back(v);
  return kept;
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
        // Control characters are nothing that a page may hold.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') safe += c;
    }
  return safe;
}

std::string colour_code(const Colour& colour) {
  const auto byte = [&](std::size_t i) { return int(std::lround(255.0 * std::clamp(colour[i], 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

std::size_t characters(std::string_view text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string shortened(const std::string& text, std::size_t most) {
  if (characters(text) <= most) return text;
  std::size_t seen = 0, end = 0;
  for (; end < text.size(); ++end)
    if ((text[end] & 0xC0) != 0x80 && ++seen == std::max<std::size_t>(most, 1)) break;
  return text.substr(0, end) + "…";
}

double text_width(std::string_view text, double size) {
  return 0.6 * size * double(characters(text));
}

SvgDrawing::SvgDrawing(double width, double height, std::string_view description) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\" aria-label=\"{2}\" font-family=\"Helvetica Neue, Arial, Liberation Sans, DejaVu Sans, "
      "sans-serif\">\n",
      width, height, escaped(description));
}

void SvgDrawing::line(double x1, double y1, double x2, double y2, const std::string& colour, double width,
                      const char* dashes) {
  text_ += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"{}/>\n", x1, y1, x2, y2,
                       shape_attributes({"none", colour, width, dashes}));
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
  std::string path;
  for (const auto& [x, y] : points)
    if (std::isfinite(x) && std::isfinite(y)) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
  if (!path.empty()) text_ += fmt::format("<path d=\"{}z\" fill=\"{}\" stroke=\"none\"/>\n", path, fill);
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

void SvgDrawing::error_bar(double x1, double y1, double x2, double y2, const std::string& colour, double half) {
  const double across = x1 == x2 ? half : 0.0, up = x1 == x2 ? 0.0 : half;
  line(x1, y1, x2, y2, colour, 1.6);
  line(x1 - across, y1 - up, x1 + across, y1 + up, colour, 1.6);
  line(x2 - across, y2 - up, x2 + across, y2 + up, colour, 1.6);
}

std::string SvgDrawing::finished() const {
  return text_ + "</svg>\n";
}

double SvgAxis::at(double value) const {
  const auto place = [this](double v) {
    if (kind == Kind::logarithmic) return std::log(v);
    return kind == Kind::squeezed ? std::asinh(0.5 * v) : v;
  };
  return begin + (end - begin) * (place(value) - place(low)) / (place(high) - place(low));
}

std::vector<double> SvgAxis::ticks(double apart) const {
  if (kind == Kind::linear) return linear_values(*this, apart);
  if (kind == Kind::squeezed) return thinned(*this, squeezed_values(*this), 0.7 * apart);
  const std::vector<double> values = thinned(*this, decade_values(*this), apart);
  return values.size() > 1 ? values : linear_values(*this, 2.0 * apart);
}

SvgAxis axis_around(const std::vector<double>& values, double begin, double end) {
  double low = INFINITY, high = -INFINITY;
  for (double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return {SvgAxis::Kind::linear, 0.0, 1.0, begin, end};
  if (low > 0.0 && high > 2.5 * low) {
    const double more = std::pow(high / low, 0.05);
    return {SvgAxis::Kind::logarithmic, low / more, high * more, begin, end};
  }
  const double more = std::max(0.06 * (high - low), 0.02 * std::max(std::abs(high), std::abs(low)));
  return {SvgAxis::Kind::linear, low - more, high + std::max(more, 1e-12), begin, end};
}

std::string tick_text(double value) {
  std::string text = fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

void draw_axis_below(SvgDrawing& drawing, const SvgAxis& axis, double top, double bottom, std::string_view title) {
  for (double v : axis.ticks()) {
    drawing.line(axis.at(v), top, axis.at(v), bottom, kGridColour);
    drawing.text(axis.at(v), bottom + 17.0, tick_text(v), {.anchor = "middle"});
  }
  drawing.line(axis.begin, bottom, axis.end, bottom, kFrameColour);
  drawing.text(0.5 * (axis.begin + axis.end), bottom + 36.0, title, {.anchor = "middle"});
}

void draw_legend(SvgDrawing& drawing, double x, double y, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    drawing.marker(entry.marker, x + 6.0, y - 4.5, entry.colour);
    drawing.text(x + 18.0, y, entry.text);
    x += 18.0 + text_width(entry.text) + 24.0;
  }
}

}  // namespace voussoir
