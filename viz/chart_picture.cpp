#include "viz/chart_picture.h"

#include <cmath>

#include "solver/base/error.h"
#include "viz/page/cairo_drawing.h"

namespace voussoir {

namespace {

bool shows(const LineChart& chart, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && !(chart.log_x && x <= 0.0) && !(chart.log_y && y <= 0.0);
}

void check(const LineChart& chart) {
  if (chart.curves.empty()) throw InputError("chart '{}': there is nothing to plot", chart.title);
  bool any = false;
  for (const ChartCurve& c : chart.curves) {
    if (c.x.size() != c.y.size())
      throw InputError("chart '{}': series '{}' has {} x and {} y values. Give the same number of both", chart.title,
                       c.name, c.x.size(), c.y.size());
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
  write_png([&](Drawing& drawing) { draw(drawing, chart); }, chart.width, height_of(chart), png, width);
}

}  // namespace voussoir
