#include "viz/plot.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "viz/axis.h"
#include "viz/display.h"
#include "viz/offscreen.h"
#include "viz/overlay.h"
#include "viz/palette.h"

namespace voussoir {
namespace {

/// Most points a line needs: two per pixel column and more, so that peaks keep their height.
constexpr std::size_t kMostPoints = 20000;

void check(const std::vector<Series>& series, const PlotOptions& options) {
  if (series.empty()) throw InputError("chart '{}': there is nothing to plot", options.title);
  for (const Series& s : series) {
    if (s.x.size() != s.y.size())
      throw InputError("chart '{}': series '{}' has {} x and {} y values; give as many of each", options.title, s.name,
                       s.x.size(), s.y.size());
    if (s.x.empty()) throw InputError("chart '{}': series '{}' is empty", options.title, s.name);
  }
}

bool drawable(double x, double y, const PlotOptions& options) {
  return std::isfinite(x) && std::isfinite(y) && !(options.log_x && x <= 0.0) && !(options.log_y && y <= 0.0);
}

/// Long series thinned to the smallest and largest value of each stretch, in their order.
Series thinned(const Series& full) {
  const std::size_t n = full.x.size();
  if (n <= kMostPoints) return full;
  Series thin{full.name, {}, {}};
  const std::size_t stretches = kMostPoints / 2;
  for (std::size_t k = 0; k < stretches; ++k) {
    const auto begin = full.y.begin() + std::ptrdiff_t(k * n / stretches);
    const auto end = full.y.begin() + std::ptrdiff_t((k + 1) * n / stretches);
    auto [low, high] = std::minmax_element(begin, end);
    if (high < low) std::swap(low, high);
    for (const auto at : {low, high}) {
      thin.x.push_back(full.x[std::size_t(at - full.y.begin())]);
      thin.y.push_back(*at);
    }
  }
  return thin;
}

/// Where things lie on the sheet, in pixels.
struct Layout {
  double letter = 0.0;
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;  // of the plotted area
  double title = 0.0, legend = 0.0;                         // baselines: of the title, of the legend's first row
  Axis x, y;
  std::pair<double, double> place(double vx, double vy) const {
    return {left + (right - left) * x.share(vx), bottom + (top - bottom) * y.share(vy)};
  }
};

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
};

void set_axes(Layout& layout, const std::vector<Series>& series, const PlotOptions& options) {
  Range x, y;
  for (const Series& s : series)
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (drawable(s.x[i], s.y[i], options)) x.add(s.x[i]), y.add(s.y[i]);
  if (x.low > x.high)
    throw InputError("chart '{}': no point can be drawn{}", options.title,
                     options.log_x || options.log_y ? "; logarithmic axes need values above 0" : "; all are NaN");
  layout.x = make_axis(x.low, x.high, options.log_x, false, 8);
  layout.y = make_axis(y.low, y.high, options.log_y, true, 7);
}

/// Entries of the legend in rows: the x of each entry's sample line, and its row.
struct Legend {
  struct Entry {
    std::size_t series = 0;
    double x = 0.0;
    int row = 0;
  };
  std::vector<Entry> entries;
  int rows = 0;
};

Legend lay_out_legend(const std::vector<Series>& series, double letter, double left, double right) {
  Legend legend;
  double x = left;
  for (std::size_t i = 0; i < series.size() && series.size() > 1; ++i) {
    if (series[i].name.empty()) continue;
    const double width = 4.0 * letter + Overlay::text_width(series[i].name, letter);
    if (legend.rows == 0) legend.rows = 1;
    if (x + width > right && x > left) x = left, ++legend.rows;
    legend.entries.push_back({i, x, legend.rows - 1});
    x += width;
  }
  return legend;
}

using Path = std::vector<std::pair<double, double>>;

/// Once the colours are used up, lines are dashed.
bool dashed(std::size_t index) {
  return index / kLineColours % 2 == 1;
}

/// The pieces of a line that dashes leave, `on` and `off` long (pixels).
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

void draw_line(Overlay& overlay, const Path& line, std::size_t index, double width, double letter) {
  if (!dashed(index)) return overlay.polyline(line, width, line_colour(index));
  for (const Path& piece : dashes(line, 0.5 * letter, 0.3 * letter))
    if (piece.size() > 1) overlay.polyline(piece, width, line_colour(index));
}

void draw_legend(Overlay& overlay, const Layout& layout, const Legend& legend, const std::vector<Series>& series) {
  const double s = layout.letter;
  for (const auto& entry : legend.entries) {
    const double y = layout.legend - 1.6 * s * entry.row;
    draw_line(overlay, {{entry.x, y + 0.6 * s}, {entry.x + 2.0 * s, y + 0.6 * s}}, entry.series, 0.16 * s, s);
    overlay.text(entry.x + 2.5 * s, y, series[entry.series].name, s);
  }
}

void draw_frame(Overlay& overlay, const Layout& l, const std::string& x_label, const std::string& y_label,
                const std::string& title) {
  const double s = l.letter, tick = 0.35 * s;
  const Colour grid = {0.88, 0.88, 0.88}, faint = {0.94, 0.94, 0.94};
  for (const double v : l.x.minor)
    overlay.line(l.place(v, l.y.low).first, l.bottom, l.place(v, l.y.low).first, l.top, 0.8, faint);
  for (const double v : l.y.minor)
    overlay.line(l.left, l.place(l.x.low, v).second, l.right, l.place(l.x.low, v).second, 0.8, faint);
  for (const double v : l.x.ticks) {
    const double x = l.place(v, l.y.low).first;
    overlay.line(x, l.bottom, x, l.top, 0.8, grid);
    overlay.line(x, l.bottom - tick, x, l.bottom, 1.2);
    overlay.text(x, l.bottom - tick - 1.35 * s, tick_label(l.x, v), s, Align::centre);
  }
  for (const double v : l.y.ticks) {
    const double y = l.place(l.x.low, v).second;
    overlay.line(l.left, y, l.right, y, 0.8, grid);
    overlay.line(l.left - tick, y, l.left, y, 1.2);
    overlay.text(l.left - 1.8 * tick, y - 0.6 * s, tick_label(l.y, v), s, Align::right);
  }
  overlay.text(0.5 * (l.left + l.right), 0.7 * s, x_label, 1.1 * s, Align::centre);
  overlay.upright_text(1.4 * s, 0.5 * (l.bottom + l.top), y_label, 1.1 * s);
  overlay.text(l.left, l.title, title, 1.25 * s, Align::left, kInk, true);
}

/// Drawn after the lines, so that they end under it.
void draw_border(Overlay& overlay, const Layout& l) {
  overlay.line(l.left, l.bottom, l.right, l.bottom, 1.2);
  overlay.line(l.left, l.bottom, l.left, l.top, 1.2);
}

void draw_series(Overlay& overlay, const Layout& layout, const Series& full, std::size_t index,
                 const PlotOptions& options) {
  const Series series = thinned(full);
  Path run;
  const double dot = 0.28 * layout.letter;
  const auto finish_run = [&] {
    if (run.size() > 1) draw_line(overlay, run, index, 0.1 * layout.letter, layout.letter);
    if (options.markers || run.size() == 1)
      for (const auto& [x, y] : run) overlay.disc(x, y, dot, line_colour(index));
    run.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (drawable(series.x[i], series.y[i], options))
      run.push_back(layout.place(series.x[i], series.y[i]));
    else
      finish_run();
  }
  finish_run();
}

Layout lay_out(const std::vector<Series>& series, const PlotOptions& options, Legend& legend) {
  Layout l;
  const double s = l.letter = std::clamp(options.width / 68.0, 9.0, 60.0);
  set_axes(l, series, options);
  double widest = 0.0;
  for (const double v : l.y.ticks) widest = std::max(widest, Overlay::text_width(tick_label(l.y, v), s));
  l.left = widest + 4.0 * s;
  l.right = options.width - 2.0 * s;
  l.bottom = 4.2 * s;
  l.title = options.height - 2.2 * s;
  legend = lay_out_legend(series, s, l.left, l.right);
  l.top = options.height - (options.title.empty() ? 1.0 : 3.0) * s - 1.6 * s * legend.rows;
  l.legend = l.top + 0.7 * s + 1.6 * s * std::max(0, legend.rows - 1);
  return l;
}

}  // namespace

void plot_lines(const std::vector<Series>& series, const std::string& x_label, const std::string& y_label,
                const PlotOptions& options, const std::string& png) {
  check(series, options);
  const Display display;
  Legend legend;
  const Layout layout = lay_out(series, options, legend);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  Overlay overlay(renderer);
  draw_frame(overlay, layout, x_label, y_label, options.title);
  for (std::size_t i = 0; i < series.size(); ++i) draw_series(overlay, layout, series[i], i, options);
  draw_border(overlay, layout);
  draw_legend(overlay, layout, legend, series);
  const auto window = offscreen_window(options.width, options.height);
  window->AddRenderer(renderer);
  write_png(window, png);
}

void plot_lines(const std::vector<Series>& series, const std::string& x_label, const std::string& y_label,
                const std::string& title, const std::string& png) {
  PlotOptions options;
  options.title = title;
  plot_lines(series, x_label, y_label, options, png);
}

}  // namespace voussoir
