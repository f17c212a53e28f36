#include "tools/run/plot_chart.h"

#include <fmt/format.h>

#include "io/records/curve.h"

namespace voussoir {

namespace {

/// A label as given, or the channel with its unit.
std::string axis_label(const std::string& label, const std::string& name, double factor, const History& history) {
  if (!label.empty()) return label;
  for (const Channel& channel : history.channels())
    if (channel.path == name)
      return factor == 1.0 ? fmt::format("{} ({})", name, channel.unit)
                           : fmt::format("{} ({:g} {})", name, 1.0 / factor, channel.unit);
  return name;
}

std::vector<double> in_units(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

}  // namespace

LineChart plot_chart(const PlotSpec& plot, const History& history) {
  LineChart chart{.title = plot.title,
                  .x_label = axis_label(plot.x_label, plot.x, plot.x_factor, history),
                  .y_label = axis_label(plot.y_label, plot.y, plot.y_factor, history)};
  for (const MeasuredCurve& measured : plot.measured)
    if (!measured.text.empty()) {
      Curve curve = parse_curve(measured.text, measured.file);
      chart.curves.push_back({.name = measured.label, .x = std::move(curve.x), .y = std::move(curve.y)});
    }
  chart.curves.push_back({.name = plot.label,
                          .x = in_units(history.values(plot.x), plot.x_factor),
                          .y = in_units(history.values(plot.y), plot.y_factor)});
  number_curves(chart);
  return chart;
}

}  // namespace voussoir
