#include "viz/page/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viz/page/svg.h"

namespace voussoir {

namespace {

constexpr double left = 76.0, right = 20.0, above = 26.0, below = 52.0, row = 22.0, line_length = 34.0;  // px

/// Where legend entries lie: in rows that fit the width.
struct Legend {
  double width, x = left, y = 18.0;
  /// The place of an entry of this width, its left end.
  std::pair<double, double> place(double wide) {
    if (x > left && x + wide > width - right) x = left, y += row;
    const std::pair<double, double> here = {x, y};
    x += wide + 24.0;
    return here;
  }
  double bottom() const { return y + 8.0; }
};

double entry_width(const std::string& name) {
  return line_length + 8.0 + text_width(name);
}

double legend_height(const LineChart& chart) {
  Legend legend{chart.width};
  bool any = false;
  const auto add = [&](const auto& entries) {
    for (const auto& e : entries)
      if (!e.name.empty()) legend.place(entry_width(e.name)), any = true;
  };
  add(chart.bands), add(chart.curves), add(chart.dots);
  return any ? legend.bottom() : 0.0;
}

void draw_legend_of(Drawing& drawing, const LineChart& chart) {
  Legend legend{chart.width};
  const auto entry = [&](const std::string& name, const auto& symbol) {
    if (name.empty()) return;
    const auto [x, y] = legend.place(entry_width(name));
    symbol(x, y - 4.5);
    drawing.text(x + line_length + 8.0, y, name);
  };
  for (const ChartBand& b : chart.bands)
    entry(b.name, [&](double x, double y) { drawing.rectangle(x, y - 6.0, line_length, 12.0, {b.colour}); });
  for (const ChartCurve& c : chart.curves)
    entry(c.name, [&](double x, double y) {
      drawing.line(x, y, x + line_length, y, c.colour, std::max(c.width, 1.4), c.dashes.c_str());
    });
  for (const ChartDots& d : chart.dots)
    entry(d.name, [&](double x, double y) { drawing.marker(d.marker, x + 0.5 * line_length, y, d.colour); });
}

ChartAxis axis_of(std::vector<double> values, bool logarithmic, std::optional<double> low, std::optional<double> high,
                  double begin, double end) {
  if (logarithmic) std::erase_if(values, [](double v) { return !(v > 0.0); });
  ChartAxis axis = axis_around(values, begin, end);
  double least = INFINITY, most = -INFINITY;
  for (const double v : values)
    if (std::isfinite(v)) least = std::min(least, v), most = std::max(most, v);
  axis.kind = logarithmic ? ChartAxis::Kind::logarithmic : ChartAxis::Kind::linear;
  if (!logarithmic && least <= most) {
    const double more = least < most ? 0.05 * (most - least) : std::max(1e-12, 0.1 * std::abs(most));
    axis.low = least - more, axis.high = most + more;
  }
  if (logarithmic && !(least < most)) axis.low = 0.5 * (least > 0.0 ? least : 1.0), axis.high = 2.0 * axis.low * 2.0;
  if (low) axis.low = *low;
  if (high) axis.high = *high;
  return axis;
}

struct Axes {
  ChartAxis x, y;
  /// In pixels; what lies outside the axes is put on their edge for y, left out for x.
  std::pair<double, double> at(double vx, double vy) const {
    const bool shown = std::isfinite(vx) && std::isfinite(vy) && vx >= x.low - 1e-12 && vx <= x.high + 1e-12 &&
                       (x.kind != ChartAxis::Kind::logarithmic || vx > 0.0) &&
                       (y.kind != ChartAxis::Kind::logarithmic || vy > 0.0);
    if (!shown) return {NAN, NAN};
    return {x.at(vx), y.at(std::clamp(vy, y.low, y.high))};
  }
};

void draw_frame(Drawing& drawing, const LineChart& chart, const Axes& axes, double top, double bottom) {
  draw_axis_below(drawing, axes.x, top, bottom, chart.x_label);
  for (const double v : axes.y.ticks(30.0)) {
    drawing.line(axes.x.begin, axes.y.at(v), axes.x.end, axes.y.at(v), kGridColour);
    drawing.text(axes.x.begin - 6.0, axes.y.at(v) + 4.5, tick_text(v), {.anchor = "end"});
  }
  drawing.line(axes.x.begin, top, axes.x.begin, bottom, kFrameColour);
  drawing.text(18.0, 0.5 * (top + bottom), chart.y_label, {.anchor = "middle", .turn = -90.0});
  drawing.text(axes.x.begin, top - 9.0, chart.title, {.bold = true});
}

Axes axes_of(const LineChart& chart, double top, double bottom) {
  std::vector<double> xs, ys;
  const auto more = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const ChartBand& b : chart.bands) more(xs, b.x), more(ys, b.low), more(ys, b.high);
  for (const ChartCurve& c : chart.curves) more(xs, c.x), more(ys, c.y);
  for (const ChartDots& d : chart.dots) more(xs, d.x), more(ys, d.y);
  const auto [low, high] = xs.empty() ? std::pair{0.0, 1.0} : std::pair{std::ranges::min(xs), std::ranges::max(xs)};
  // Curves run from edge to edge; dots stay off the edges.
  const bool dotted =
      !chart.dots.empty() || std::ranges::any_of(chart.curves, [](const ChartCurve& c) { return c.dots; });
  const bool tight = !dotted && low < high && (!chart.log_x || low > 0.0);
  return {axis_of(xs, chart.log_x,
                  chart.x_low ? chart.x_low
                  : tight     ? std::optional(low)
                              : std::nullopt,
                  chart.x_high ? chart.x_high
                  : tight      ? std::optional(high)
                               : std::nullopt,
                  left, chart.width - right),
          axis_of(ys, chart.log_y, chart.y_low, chart.y_high, bottom, top)};
}

}  // namespace

ChartCurve thinned(const ChartCurve& curve, std::size_t shares) {
  if (curve.x.size() <= 2 * shares) return curve;
  ChartCurve thin = curve;
  thin.x.clear(), thin.y.clear();
  for (std::size_t k = 0; k < shares; ++k) {
    const std::size_t begin = k * curve.x.size() / shares, end = (k + 1) * curve.x.size() / shares;
    const auto [low, high] =
        std::minmax_element(curve.y.begin() + std::ptrdiff_t(begin), curve.y.begin() + std::ptrdiff_t(end));
    auto first = std::size_t(low - curve.y.begin()), second = std::size_t(high - curve.y.begin());
    if (first > second) std::swap(first, second);
    for (const std::size_t i : {first, second}) thin.x.push_back(curve.x[i]), thin.y.push_back(curve.y[i]);
  }
  return thin;
}

double height_of(const LineChart& chart) {
  return legend_height(chart) + chart.height;
}

void draw(Drawing& drawing, const LineChart& chart) {
  const double bottom = height_of(chart) - below, top = legend_height(chart) + above;
  const Axes axes = axes_of(chart, top, bottom);
  for (const ChartBand& b : chart.bands) {
    Drawing::Path outline;
    for (std::size_t i = 0; i < b.x.size(); ++i) outline.push_back(axes.at(b.x[i], b.high[i]));
    for (std::size_t i = b.x.size(); i-- > 0;) outline.push_back(axes.at(b.x[i], b.low[i]));
    drawing.area(outline, b.colour);
  }
  draw_frame(drawing, chart, axes, top, bottom);
  for (const ChartCurve& whole : chart.curves) {
    const ChartCurve c = thinned(whole);
    Drawing::Path points;
    for (std::size_t i = 0; i < c.x.size(); ++i) points.push_back(axes.at(c.x[i], c.y[i]));
    drawing.curve(points, c.colour, c.width, c.dashes.c_str());
    for (const auto& [x, y] : points)
      if (c.dots && std::isfinite(x)) drawing.marker(Marker::circle, x, y, c.colour, {}, 4.0);
  }
  for (const ChartDots& d : chart.dots)
    for (std::size_t i = 0; i < d.x.size(); ++i)
      if (const auto [x, y] = axes.at(d.x[i], d.y[i]); std::isfinite(x))
        drawing.marker(d.marker, x, y, d.colour, i < d.hints.size() ? d.hints[i] : std::string());
  draw_legend_of(drawing, chart);
}

std::string line_chart(const LineChart& chart) {
  if (chart.curves.empty() && chart.dots.empty() && chart.bands.empty()) return "";
  SvgDrawing drawing(chart.width, height_of(chart), chart.title);
  draw(drawing, chart);
  return drawing.finished();
}

void number_curves(LineChart& chart) {
  const char* dashes[] = {"", "6 3", "2 2"};
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    chart.curves[i].colour = colour_code(line_colour(i));
    chart.curves[i].dashes = dashes[i / kLineColours % 3];
  }
}

}  // namespace voussoir
