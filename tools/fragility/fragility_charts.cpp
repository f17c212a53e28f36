#include "tools/fragility/fragility_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "tools/fragility/fragility_words.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

using Points = std::vector<std::pair<double, double>>;

constexpr double kWidth = 860.0, kPlotHeight = 360.0, kLeft = 74.0, kRight = 20.0, kBelow = 46.0;  // px
constexpr double kEntry = 22.0, kRug = 9.0;                                                        // px, a row

/// The plot area of a chart: below its legend, and next to or between the marks of the runs.
struct Plot {
  double top = 0.0, bottom = 0.0;
  ChartAxis x, y;
};

std::string case_colour(std::size_t index) {
  return colour_code(line_colour(index));
}

/// Transparent, so that overlapping bands are both visible.
std::string tint(std::size_t index) {
  const Colour c = line_colour(index);
  return fmt::format("rgba({:.0f},{:.0f},{:.0f},0.16)", 255.0 * c[0], 255.0 * c[1], 255.0 * c[2]);
}

void draw_left_axis(SvgDrawing& drawing, const Plot& plot, const std::string& title) {
  for (double v : plot.y.ticks(30.0)) {
    drawing.line(plot.x.begin, plot.y.at(v), plot.x.end, plot.y.at(v), kGridColour);
    drawing.text(plot.x.begin - 6.0, plot.y.at(v) + 4.5, tick_text(v), {.anchor = "end"});
  }
  drawing.line(plot.x.begin, plot.top, plot.x.begin, plot.bottom, kFrameColour);
  drawing.text(16.0, 0.5 * (plot.top + plot.bottom), title, {.anchor = "middle", .turn = -90.0});
}

Marker case_marker(std::size_t index) {
  constexpr Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  return markers[index % 4];
}

/// A line with its words, one below the other.
void draw_entry(SvgDrawing& drawing, double y, std::size_t index, const std::string& words) {
  drawing.rectangle(kLeft, y - 11.0, 34.0, 13.0, {tint(index), "none", 1.0, ""});
  drawing.line(kLeft, y - 4.5, kLeft + 34.0, y - 4.5, case_colour(index), 2.4);
  drawing.text(kLeft + 42.0, y, words);
}

std::string entry_words(const Fragility& f) {
  if (f.chosen.identified != Identified::yes)
    return shortened(f.case_name + ": no curve, " + unknown_words(f.chosen, f.im), 96);
  std::string text = fmt::format("{}: θ = {}, β = {:.2f}", f.case_name, with_unit(f.chosen.theta, f.im), f.chosen.beta);
  return text + fmt::format(" ({}; {} of {} the limit)", method_words(f), f.selection.beyond,
                            counted(f.selection.trials.size(), "run exceeds", "runs exceed"));
}

void draw_curve(SvgDrawing& drawing, const Plot& plot, const Fragility& f, std::size_t index) {
  Points middle, low, high;
  for (const CurvePoint& p : f.curve) {
    const double x = plot.x.at(p.im);
    middle.emplace_back(x, plot.y.at(p.probability));
    low.emplace_back(x, plot.y.at(p.band.low)), high.emplace_back(x, plot.y.at(p.band.high));
  }
  high.insert(high.end(), low.rbegin(), low.rend());
  drawing.area(high, tint(index));
  drawing.curve(middle, case_colour(index), 2.4);
}

/// The share at each level, with the number of its runs.
void draw_levels(SvgDrawing& drawing, const Plot& plot, const Fragility& f, std::size_t index) {
  for (const Count& c : f.counts)
    drawing.marker(case_marker(index), plot.x.at(c.im), plot.y.at(c.beyond / c.runs), case_colour(index),
                   fmt::format("{}: {:.0f} of {} at {}", f.case_name, c.beyond, counted(std::int64_t(c.runs), "run"),
                               with_unit(c.im, f.im)));
}

/// A mark for each run, in a row for each case: above the plot if it exceeds the limit, below if not.
void draw_rug(SvgDrawing& drawing, const Plot& plot, const Fragility& f, std::size_t index) {
  for (const CloudRun& t : f.selection.trials) {
    const double x = plot.x.at(t.im), row = kRug * double(index);
    const double y = t.beyond ? plot.top - kRug - row : plot.bottom + row + 2.0;
    drawing.line(x, y, x, y + kRug - 2.0, case_colour(index), 1.2);
  }
}

/// Range of the curves: the runs, and the rise of the curves.
ChartAxis intensity_axis(const std::vector<const Fragility*>& curves) {
  std::vector<double> values;
  for (const Fragility* f : curves) {
    for (const CloudRun& t : f->selection.trials) values.push_back(t.im);
    for (const CurvePoint& p : f->curve)
      if (p.probability > 0.002 && p.probability < 0.998) values.push_back(p.im);
  }
  return axis_around(values, kLeft, kWidth - kRight);
}

bool any_trials(const std::vector<const Fragility*>& curves) {
  return std::any_of(curves.begin(), curves.end(), [](const Fragility* f) { return !f->selection.trials.empty(); });
}

/// The part of a curve that an axis shows.
Fragility cut_to(const Fragility& f, const ChartAxis& x) {
  Fragility cut = f;
  std::erase_if(cut.curve, [&](const CurvePoint& p) { return p.im < x.low || p.im > x.high; });
  return cut;
}

double sized(double demand) {
  return demand > 0.0 ? demand : std::nan("");
}

void draw_line_of(SvgDrawing& drawing, const Plot& plot, const Line& line, std::size_t index) {
  if (!line.known()) return;
  for (double off : {-line.scatter, 0.0, line.scatter}) {
    Points points;
    for (int i = 0; i <= 60; ++i) {  // in pieces, so that parts outside are left out
      const double im = plot.x.low * std::pow(plot.x.high / plot.x.low, i / 60.0);
      const double y = std::exp(line.intercept + line.slope * std::log(im) + off);
      points.emplace_back(plot.x.at(im), y >= plot.y.low && y <= plot.y.high ? plot.y.at(y) : std::nan(""));
    }
    drawing.curve(points, case_colour(index), off == 0.0 ? 2.2 : 1.2, off == 0.0 ? "" : "6 4");
  }
}

void draw_runs(SvgDrawing& drawing, const Plot& plot, const Fragility& f, std::size_t index) {
  for (const CloudRun& t : f.selection.trials) {
    const std::string hint =
        fmt::format("{}, {}: {}", f.case_name, f.selection.records[t.record], with_unit(t.im, f.im));
    if (t.collapsed)
      drawing.marker(Marker::triangle, plot.x.at(t.im), plot.top - 8.0, case_colour(index), hint + ", collapsed", 4.0);
    else if (t.demand > 0.0)
      drawing.marker(case_marker(index % 2), plot.x.at(t.im), plot.y.at(t.demand), case_colour(index), hint, 3.4);
  }
}

ChartAxis logarithmic(ChartAxis axis) {
  if (axis.low > 0.0) axis.kind = ChartAxis::Kind::logarithmic;
  return axis;
}

}  // namespace

std::string curves_chart(const std::vector<const Fragility*>& curves) {
  if (!any_trials(curves)) return "";
  const bool any_cloud =
      std::any_of(curves.begin(), curves.end(), [](const Fragility* f) { return f->levels.empty(); });
  const double rugs = any_cloud ? kRug * double(curves.size()) + 4.0 : 0.0;
  Plot plot;
  plot.top = kEntry * double(curves.size()) + 12.0 + rugs;
  plot.bottom = plot.top + kPlotHeight;
  plot.x = intensity_axis(curves);
  plot.y = {ChartAxis::Kind::linear, 0.0, 1.0, plot.bottom, plot.top};
  const Fragility& first = *curves.front();
  SvgDrawing drawing(kWidth, plot.bottom + rugs + kBelow,
                     fmt::format("Fragility curves: {} over {}", limit_words(first.limit), measure_label(first.im)));
  draw_left_axis(drawing, plot, fmt::format("probability that {}", limit_words(first.limit)));
  draw_axis_below(drawing, plot.x, plot.top, plot.bottom + rugs, measure_label(first.im));
  drawing.line(plot.x.begin, plot.bottom, plot.x.end, plot.bottom, kFrameColour);
  for (std::size_t i = 0; i < curves.size(); ++i) draw_curve(drawing, plot, cut_to(*curves[i], plot.x), i);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    draw_entry(drawing, 18.0 + kEntry * double(i), i, entry_words(*curves[i]));
    if (!curves[i]->levels.empty())
      drawing.marker(case_marker(i), kLeft + 17.0, 13.5 + kEntry * double(i), case_colour(i));
    if (curves[i]->levels.empty())
      draw_rug(drawing, plot, *curves[i], i);
    else
      draw_levels(drawing, plot, *curves[i], i);
  }
  return drawing.finished();
}

std::string demand_chart(const std::vector<const Fragility*>& curves) {
  std::vector<double> im, demand;
  for (const Fragility* f : curves)
    for (const CloudRun& t : f->selection.trials) im.push_back(t.im), demand.push_back(sized(t.demand));
  if (std::none_of(demand.begin(), demand.end(), [](double v) { return v > 0.0; })) return "";
  const Fragility& first = *curves.front();
  demand.push_back(first.limit.threshold);
  Plot plot;
  plot.top = kEntry * double(curves.size()) + 28.0;
  plot.bottom = plot.top + kPlotHeight;
  plot.x = logarithmic(axis_around(im, kLeft, kWidth - kRight));
  plot.y = logarithmic(axis_around(demand, plot.bottom, plot.top));
  SvgDrawing drawing(kWidth, plot.bottom + kBelow,
                     fmt::format("{} over {}", measure_label(first.limit.demand), measure_label(first.im)));
  draw_left_axis(drawing, plot, measure_label(first.limit.demand));
  draw_axis_below(drawing, plot.x, plot.top, plot.bottom, measure_label(first.im));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Line& line = curves[i]->cloud.line;
    draw_runs(drawing, plot, *curves[i], i);
    draw_line_of(drawing, plot, line, i);
    drawing.marker(case_marker(i % 2), kLeft + 17.0, 13.5 + kEntry * double(i), case_colour(i), {}, 3.4);
    drawing.text(kLeft + 42.0, 18.0 + kEntry * double(i),
                 line.known() ? fmt::format("{}: slope {:.2f}, scatter {:.2f} (of the logarithm), R² = {:.2f}",
                                            curves[i]->case_name, line.slope, line.scatter, line.r2)
                              : fmt::format("{}: no line", curves[i]->case_name));
  }
  const double y = plot.y.at(first.limit.threshold);
  drawing.line(plot.x.begin, y, plot.x.end, y, colour_code(kInk), 1.6, "2 3");
  drawing.text(plot.x.end - 4.0, y - 6.0,
               fmt::format("{}: {}", first.limit.name, with_unit(first.limit.threshold, first.limit.demand)),
               {.anchor = "end"});
  return drawing.finished();
}

}  // namespace voussoir
