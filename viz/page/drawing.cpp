#include "viz/page/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

/// 1, 2 or 5 times a power of ten, so that values are at least `apart` px apart.
double round_step(const ChartAxis& axis, double apart) {
  const double least = apart * (axis.high - axis.low) / std::abs(axis.end - axis.begin);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10.0 * power;
}

std::vector<double> linear_values(const ChartAxis& axis, double apart) {
  const double step = round_step(axis, apart);
  std::vector<double> values;
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
    values.push_back(k * step);
  return values;
}

/// The roundest first.
std::vector<double> decade_values(const ChartAxis& axis) {
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
std::vector<double> squeezed_values(const ChartAxis& axis) {
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
std::vector<double> thinned(const ChartAxis& axis, const std::vector<double>& values, double apart) {
  std::vector<double> kept;
  for (double v : values)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](double other) { return std::abs(axis.at(other) - axis.at(v)) < apart; }))
      kept.push_back(v);
  return kept;
}

}  // namespace

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

void Drawing::line(double x1, double y1, double x2, double y2, const std::string& colour, double width,
                   const char* dashes) {
  curve({{x1, y1}, {x2, y2}}, colour, width, dashes);
}

void Drawing::areas(const std::vector<Path>& outlines, const std::string& fill) {
  for (const Path& outline : outlines) area(outline, fill);
}

void Drawing::error_bar(double x1, double y1, double x2, double y2, const std::string& colour, double half) {
  const double across = x1 == x2 ? half : 0.0, up = x1 == x2 ? 0.0 : half;
  line(x1, y1, x2, y2, colour, 1.6);
  line(x1 - across, y1 - up, x1 + across, y1 + up, colour, 1.6);
  line(x2 - across, y2 - up, x2 + across, y2 + up, colour, 1.6);
}

double ChartAxis::at(double value) const {
  const auto place = [this](double v) {
    if (kind == Kind::logarithmic) return std::log(v);
    return kind == Kind::squeezed ? std::asinh(0.5 * v) : v;
  };
  return begin + (end - begin) * (place(value) - place(low)) / (place(high) - place(low));
}

std::vector<double> ChartAxis::ticks(double apart) const {
  if (kind == Kind::linear) return linear_values(*this, apart);
  if (kind == Kind::squeezed) return thinned(*this, squeezed_values(*this), 0.7 * apart);
  const std::vector<double> values = thinned(*this, decade_values(*this), apart);
  return values.size() > 1 ? values : linear_values(*this, 2.0 * apart);
}

ChartAxis axis_around(const std::vector<double>& values, double begin, double end) {
  double low = INFINITY, high = -INFINITY;
  for (double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return {ChartAxis::Kind::linear, 0.0, 1.0, begin, end};
  if (low > 0.0 && high > 2.5 * low) {
    const double more = std::pow(high / low, 0.05);
    return {ChartAxis::Kind::logarithmic, low / more, high * more, begin, end};
  }
  const double more = std::max(0.06 * (high - low), 0.02 * std::max(std::abs(high), std::abs(low)));
  return {ChartAxis::Kind::linear, low - more, high + std::max(more, 1e-12), begin, end};
}

std::string tick_text(double value) {
  std::string text = fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

void draw_axis_below(Drawing& drawing, const ChartAxis& axis, double top, double bottom, std::string_view title) {
  for (double v : axis.ticks()) {
    drawing.line(axis.at(v), top, axis.at(v), bottom, kGridColour);
    drawing.text(axis.at(v), bottom + 17.0, tick_text(v), {.anchor = "middle"});
  }
  drawing.line(axis.begin, bottom, axis.end, bottom, kFrameColour);
  drawing.text(0.5 * (axis.begin + axis.end), bottom + 36.0, title, {.anchor = "middle"});
}

void draw_legend(Drawing& drawing, double x, double y, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    drawing.marker(entry.marker, x + 6.0, y - 4.5, entry.colour);
    drawing.text(x + 18.0, y, entry.text);
    x += 18.0 + text_width(entry.text) + 24.0;
  }
}

}  // namespace voussoir
