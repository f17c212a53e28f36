// Measured and computed shapes: the matrix of modal assurance, and readings sensor by sensor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tools/diagnosis/chart_rows.h"
#include "tools/diagnosis/diagnosis_charts.h"
#include "tools/diagnosis/diagnosis_values.h"

namespace voussoir {

namespace {

/// Modal assurance over the sensors that were measured; not finite where there are none.
double assurance_of(const Eigen::VectorXd& measured, const Eigen::VectorXd& computed) {
  double mc = 0.0, mm = 0.0, cc = 0.0;
  for (Eigen::Index i = 0; i < std::min(measured.size(), computed.size()); ++i) {
    if (!std::isfinite(measured[i]) || !std::isfinite(computed[i])) continue;
    mc += measured[i] * computed[i], mm += measured[i] * measured[i], cc += computed[i] * computed[i];
  }
  return mm > 0.0 && cc > 0.0 ? mc * mc / (mm * cc) : std::nan("");
}

constexpr double kCell = 40.0;

/// Number, period and words of the computed modes, upright above their columns.
void draw_computed_modes(SvgDrawing& drawing, const Evaluation& at, Eigen::Index columns, double top) {
  for (Eigen::Index c = 0; c < columns; ++c) {
    const double x = kLabelWidth + (double(c) + 0.5) * kCell;
    const ModeWords& words = at.response.words[std::size_t(c)];
    const std::string text = fmt::format("{:#.4g} s {}{}", std::exp(-at.response.log_frequency[c]), words.direction,
                                         words.order > 0 ? fmt::format(" {}", words.order) : std::string());
    drawing.text(x + 4.0, top - 24.0, shortened(text, 24), {.size = 12.0, .turn = -90.0});
    drawing.text(x, top - 7.0, fmt::format("{}", c + 1), {.anchor = "middle", .bold = true});
  }
}

void draw_assurance_row(SvgDrawing& drawing, const Evaluation& at, const Eigen::VectorXd& shape, int partner,
                        Eigen::Index columns, double y) {
  for (Eigen::Index c = 0; c < columns; ++c) {
    const double x = kLabelWidth + double(c) * kCell, mac = assurance_of(shape, at.readings.col(c));
    if (!std::isfinite(mac)) continue;
    drawing.rectangle(x + 0.5, y + 0.5, kCell - 1.0, kCell - 1.0, filled_with(colour_code(scale_colour(mac))),
                      at.response.words[std::size_t(c)].text());
    drawing.text(x + 0.5 * kCell, y + 0.5 * kCell + 4.5, fmt::format("{:.2f}", mac),
                 {.anchor = "middle", .size = 12.0, .colour = mac > 0.45 ? Colour{1.0, 1.0, 1.0} : kInk});
    if (int(c) == partner)
      drawing.rectangle(x + 1.5, y + 1.5, kCell - 3.0, kCell - 3.0, {"none", colour_code(line_colour(4)), 3.0, ""});
  }
}

/// A measured mode's shape with the computed ones in its scale.
struct SensorValue {
  std::size_t sensor = 0;
  int axis = 3;  // 3: along none
  double measured = 0.0, std = 0.0;
  double before = 0.0, after = 0.0;  // not finite: no such mode
};

int axis_of(const Vec3& direction) {
  int axis = 0;
  return direction.cwiseAbs().maxCoeff(&axis) > 0.9 * direction.norm() ? axis : 3;
}

/// The factor that brings the readings nearest to the shape.
double best_scale(const Eigen::VectorXd& shape, const Eigen::VectorXd& readings) {
  double sr = 0.0, rr = 0.0;
  for (Eigen::Index i = 0; i < std::min(shape.size(), readings.size()); ++i)
    if (std::isfinite(shape[i])) sr += shape[i] * readings[i], rr += readings[i] * readings[i];
  return rr > 0.0 ? sr / rr : 0.0;
}

Eigen::VectorXd scaled_readings(const Fit& fit, std::size_t mode, const Eigen::VectorXd& shape) {
  const int computed = fit.best.pairing.computed[mode];
  if (computed < 0 || computed >= fit.best.readings.cols())
    return Eigen::VectorXd::Constant(shape.size(), std::nan(""));
  const Eigen::VectorXd readings = fit.best.readings.col(computed);
  return best_scale(shape, readings) * readings;
}

/// By axis, then along the bridge, across it and upwards: neighbours on paper are neighbours on the bridge.
void sort_sensors(const std::vector<Sensor>& sensors, std::vector<SensorValue>& values) {
  const auto key = [&](const SensorValue& v) {
    const Vec3& p = sensors[v.sensor].position;
    return std::make_tuple(v.axis, p.x(), p.y(), p.z());
  };
  std::stable_sort(values.begin(), values.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

std::vector<SensorValue> sensor_values(const DiagnosisInput& input, const DiagnosisResult& result, std::size_t mode) {
  const MeasuredFeature& feature = input.problem.features.modes[mode];
  const std::vector<Sensor>& sensors = input.problem.features.sensors;
  double largest = 0.0;
  for (double v : feature.shape)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  if (largest <= 0.0) return {};
  const Eigen::VectorXd shape = feature.shape / largest;
  const Eigen::VectorXd before = scaled_readings(result.before, mode, shape),
                        after = scaled_readings(result.after, mode, shape);
  std::vector<SensorValue> values;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const auto i = Eigen::Index(s);
    if (i < shape.size() && std::isfinite(shape[i]))
      values.push_back(
          {s, axis_of(sensors[s].direction), shape[i], feature.shape_std[i] / largest, before[i], after[i]});
  }
  sort_sensors(sensors, values);
  return values;
}

ChartAxis shape_axis(const std::vector<SensorValue>& values, double top, double bottom) {
  double most = 1.0;
  for (const SensorValue& v : values) {
    most = std::max(most, std::abs(v.measured) + 2.0 * v.std);
    for (double computed : {v.before, v.after})
      if (std::isfinite(computed)) most = std::max(most, std::abs(computed));
  }
  return {ChartAxis::Kind::linear, -1.08 * most, 1.08 * most, bottom, top};
}

/// Of all shapes beside the plots.
struct ShapePlot {
  double left = 46.0, step = 24.0, top = 24.0, bottom = 204.0;
  double x(std::size_t i) const { return left + (double(i) + 0.5) * step; }
};

/// Dashed between sensors along different axes, with the axis' letter above.
void draw_groups(SvgDrawing& drawing, const ShapePlot& plot, const std::vector<SensorValue>& values) {
  static const char* const names[] = {"x", "y", "z", "oblique"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && values[i].axis == values[i - 1].axis) continue;
    const double x = plot.left + double(i) * plot.step;
    if (i > 0) drawing.line(x, plot.top - 16.0, x, plot.bottom, kFrameColour, 1.0, "3 3");
    drawing.text(x + 4.0, plot.top - 6.0, names[values[i].axis], {.bold = true});
  }
}

void draw_sensor(SvgDrawing& drawing, const ChartAxis& axis, double x, const SensorValue& v, const std::string& name) {
  drawing.rectangle(x - 2.0, std::min(axis.at(0.0), axis.at(v.measured)), 4.0,
                    std::abs(axis.at(v.measured) - axis.at(0.0)), filled_with("#c9c9cf"));
  drawing.error_bar(x, axis.at(v.measured - 2.0 * v.std), x, axis.at(v.measured + 2.0 * v.std), measured_colour(), 3.5);
  drawing.marker(Marker::circle, x, axis.at(v.measured), measured_colour(),
                 fmt::format("{}: measured {}", name, with_std(v.measured, v.std)), 3.2);
  if (std::isfinite(v.before))
    drawing.rectangle(x - 10.5, axis.at(v.before) - 3.0, 6.0, 6.0, {"#ffffff", before_colour(), 1.3, ""},
                      fmt::format("{}: the case as it is {:.2f}", name, v.before));
  if (std::isfinite(v.after))
    drawing.marker(Marker::triangle, x + 7.0, axis.at(v.after), after_colour(),
                   fmt::format("{}: the corrected case {:.2f}", name, v.after), 4.0);
}

}  // namespace

std::string assurance_matrix(const DiagnosisInput& input, const DiagnosisResult& result) {
  constexpr double top = 190.0;
  const Evaluation& at = result.after.best;
  std::vector<std::size_t> shaped;
  int last = 3;
  for (std::size_t m = 0; m < input.problem.features.modes.size(); ++m) {
    if (input.problem.features.modes[m].shape.size() == 0) continue;
    shaped.push_back(m);
    last = std::max(last, at.pairing.computed[m]);
  }
  const Eigen::Index columns = std::min<Eigen::Index>({at.readings.cols(), last + 3, 20});
  if (shaped.empty() || columns == 0) return "";
  SvgDrawing drawing(std::max(kLabelWidth + double(columns) * kCell + 4.0, 560.0),
                     top + double(shaped.size()) * kCell + 4.0,
                     "Modal assurance criterion of measured and computed modes");
  drawing.text(0.0, top - 24.0, "measured", {.size = 12.0});
  drawing.text(0.0, top - 7.0, "computed, corrected case ▸", {.size = 12.0});
  draw_computed_modes(drawing, at, columns, top);
  for (std::size_t i = 0; i < shaped.size(); ++i) {
    const double y = top + double(i) * kCell;
    draw_row_label(drawing, y + 0.5 * kCell, mode_title(result.modes[shaped[i]]), mode_motion(result.modes[shaped[i]]));
    draw_assurance_row(drawing, at, input.problem.features.modes[shaped[i]].shape, at.pairing.computed[shaped[i]],
                       columns, y);
  }
  return drawing.finished();
}

std::string shape_chart(const DiagnosisInput& input, const DiagnosisResult& result, std::size_t mode) {
  const std::vector<SensorValue> values = sensor_values(input, result, mode);
  if (values.empty()) return "";
  const std::vector<Sensor>& sensors = input.problem.features.sensors;
  const ShapePlot plot;
  std::size_t longest = 1;
  for (const SensorValue& v : values) longest = std::max(longest, characters(shortened(sensors[v.sensor].id, 12)));
  const double right = plot.left + double(values.size()) * plot.step;
  SvgDrawing drawing(right + 8.0, plot.bottom + 16.0 + 0.6 * 12.0 * double(longest),
                     fmt::format("Shape of {} at the sensors", mode_title(result.modes[mode])));
  const ChartAxis axis = shape_axis(values, plot.top, plot.bottom);
  for (double v : axis.ticks(30.0)) {
    drawing.line(plot.left, axis.at(v), right, axis.at(v), kGridColour);
    drawing.text(plot.left - 6.0, axis.at(v) + 4.5, tick_text(v), {.anchor = "end", .size = 12.0});
  }
  drawing.line(plot.left, axis.at(0.0), right, axis.at(0.0), kFrameColour);
  draw_groups(drawing, plot, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = sensors[values[i].sensor].id;
    draw_sensor(drawing, axis, plot.x(i), values[i], name);
    drawing.text(plot.x(i) + 4.0, plot.bottom + 8.0, shortened(name, 12),
                 {.anchor = "end", .size = 12.0, .turn = -90.0});
  }
  return drawing.finished();
}

}  // namespace voussoir
