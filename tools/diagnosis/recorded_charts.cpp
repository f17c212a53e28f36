#include "tools/diagnosis/recorded_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnosis/chart_rows.h"

namespace voussoir {

namespace {

using Points = std::vector<std::pair<double, double>>;

constexpr double kPanelHeight = 190.0, kPanelGap = 34.0, kLeft = 70.0, kRight = 20.0;  // px
constexpr std::size_t kPanels = 4;

const char* before_dashes() {
  return "6 3";
}

/// A panel of a chart: where it lies and its axes.
struct Panel {
  double top = 0.0;
  ChartAxis x, y;
  double bottom() const { return top + kPanelHeight; }
};

void draw_lines_legend(SvgDrawing& drawing) {
  struct Entry {
    const char* text;
    const std::string& colour;
    const char* dashes;
  };
  double x = kLeft;
  for (const Entry& e :
       {Entry{"measured", measured_colour(), ""}, Entry{"case as it is", before_colour(), before_dashes()},
        Entry{"corrected", after_colour(), ""}}) {
    drawing.line(x, 14.0, x + 34.0, 14.0, e.colour, 2.2, e.dashes);
    drawing.text(x + 42.0, 18.5, e.text);
    x += 42.0 + text_width(e.text) + 28.0;
  }
}

/// Before what is drawn in it: grid, title, numbers on the left.
void draw_frame(SvgDrawing& drawing, const Panel& panel, const std::string& title, const std::string& unit) {
  for (double v : panel.x.ticks()) drawing.line(panel.x.at(v), panel.top, panel.x.at(v), panel.bottom(), kGridColour);
  for (double v : panel.y.ticks(26.0)) {
    drawing.line(panel.x.begin, panel.y.at(v), panel.x.end, panel.y.at(v), kGridColour);
    drawing.text(panel.x.begin - 6.0, panel.y.at(v) + 4.5, tick_text(v), {.anchor = "end"});
  }
  drawing.text(panel.x.begin, panel.top - 8.0, title, {.bold = true});
  drawing.text(16.0, 0.5 * (panel.top + panel.bottom()), unit, {.anchor = "middle", .turn = -90.0});
}

/// A sensor and the base channel along its axis, and how high the measured transfer function rises.
struct Resonance {
  Eigen::Index output = 0, input = 0;
  double peak = 0.0;
};

/// Of each sensor with the ground along its own axis, highest first.
std::vector<Resonance> resonances(const DiagnosisInput& input, const TransferFunctions& h) {
  std::vector<Resonance> all;
  for (std::size_t o = 0; o < h.outputs.size(); ++o)
    for (std::size_t i = 0; i < h.inputs.size(); ++i) {
      const auto& sensors = input.measured.sensors;
      const auto sensor = std::find_if(sensors.begin(), sensors.end(), [&](auto& s) { return s.id == h.outputs[o]; });
      if (sensor == sensors.end() || std::abs(sensor->direction[h.inputs[i].back() - 'x']) < 0.7) continue;
      Resonance r = {Eigen::Index(o), Eigen::Index(i), 0.0};
      for (std::size_t k = 0; k < h.values.size(); ++k) {
        const double size = std::abs(h.values[k](r.output, r.input));
        if (std::isfinite(size) && h.magnitude_std[k](r.output, r.input) < 0.3 * size) r.peak = std::max(r.peak, size);
      }
      all.push_back(r);
    }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.peak > b.peak; });
  return all;
}

/// The highest of each axis in turn: three sensors side by side would say the same.
std::vector<Resonance> shown(const DiagnosisInput& input, const TransferFunctions& h) {
  const std::vector<Resonance> all = resonances(input, h);
  std::vector<Resonance> chosen;
  for (std::size_t turn = 0; turn < all.size() && chosen.size() < kPanels; ++turn)
    for (Eigen::Index axis = 0; axis < Eigen::Index(h.inputs.size()) && chosen.size() < kPanels; ++axis) {
      std::size_t seen = 0;
      for (const Resonance& r : all)
        if (r.input == axis && seen++ == turn) chosen.push_back(r);
    }
  return chosen;
}

Points curve_of(const TransferFunctions& h, const Resonance& r, const Panel& panel) {
  Points points;
  for (std::size_t k = 0; k < h.values.size(); ++k) {
    const double size = std::clamp(std::abs(h.values[k](r.output, r.input)), panel.y.low, panel.y.high);
    points.emplace_back(panel.x.at(h.frequencies[Eigen::Index(k)]), panel.y.at(size));
  }
  return points;
}

Points band_of(const TransferFunctions& h, const Resonance& r, const Panel& panel) {
  Points upper, lower;
  for (std::size_t k = 0; k < h.values.size(); ++k) {
    const double size = std::abs(h.values[k](r.output, r.input)), std = h.magnitude_std[k](r.output, r.input);
    const double x = panel.x.at(h.frequencies[Eigen::Index(k)]);
    upper.emplace_back(x, panel.y.at(std::clamp(size + 2.0 * std, panel.y.low, panel.y.high)));
    lower.emplace_back(x, panel.y.at(std::clamp(size - 2.0 * std, panel.y.low, panel.y.high)));
  }
  upper.insert(upper.end(), lower.rbegin(), lower.rend());
  return upper;
}

/// Of the measured curve, and a little more.
ChartAxis magnitude_axis(const TransferFunctions& h, const Resonance& r, double begin, double end) {
  double low = 1e300, high = 0.0;
  for (const Eigen::MatrixXcd& line : h.values)
    if (const double size = std::abs(line(r.output, r.input)); std::isfinite(size) && size > 0.0)
      low = std::min(low, size), high = std::max(high, size);
  return {ChartAxis::Kind::logarithmic, std::max(0.5 * low, 1e-3 * high), 2.0 * std::max(high, 1e-6), begin, end};
}

/// Rows about the largest measured value.
struct Window {
  Eigen::Index first = 0, count = 0;
};
Window about_largest(const Eigen::VectorXd& y, double dt) {
  Eigen::Index peak = 0;
  y.cwiseAbs().maxCoeff(&peak);
  Window w;
  w.count = std::min(y.size(), Eigen::Index(4.0 / dt));
  w.first = std::clamp<Eigen::Index>(peak - w.count / 3, 0, y.size() - w.count);
  return w;
}

Points curve_of(const Recording& record, Eigen::Index column, const Window& w, double from, const Panel& panel) {
  Points points;
  for (Eigen::Index i = w.first; i < w.first + w.count; ++i)
    points.emplace_back(panel.x.at(from + double(i) * record.dt), panel.y.at(record.values(i, column)));
  return points;
}

}  // namespace

std::string transfer_chart(const DiagnosisInput& input, const RecordedMatch& match) {
  const TransferFunctions& h = match.measured_h;
  const std::vector<Resonance> panels = shown(input, h);
  if (panels.empty()) return "";
  const double step = kPanelHeight + kPanelGap, top = kLegendHeight + kPanelGap;
  const double height = top + double(panels.size()) * step - kPanelGap + kAxisHeight;
  SvgDrawing drawing(kChartWidth, height, "Transfer functions from the ground to sensors: measured, before and after");
  draw_lines_legend(drawing);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Panel panel;
    panel.top = top + double(i) * step;
    panel.x = {ChartAxis::Kind::linear, 0.0, h.frequencies[h.frequencies.size() - 1], kLeft, kChartWidth - kRight};
    panel.y = magnitude_axis(h, panels[i], panel.bottom(), panel.top);
    const std::string &output = h.outputs[std::size_t(panels[i].output)],
                      &ground = h.inputs[std::size_t(panels[i].input)];
    draw_frame(drawing, panel, fmt::format("{} to {}", ground, output), "(m/s²)/(m/s²)");
    drawing.area(band_of(h, panels[i], panel), "#c9c9cf");
    if (i + 1 == panels.size()) draw_axis_below(drawing, panel.x, panel.bottom(), panel.bottom(), "frequency, Hz");
    drawing.curve(curve_of(match.before_h, panels[i], panel), before_colour(), 1.6, before_dashes());
    drawing.curve(curve_of(h, panels[i], panel), measured_colour(), 1.6);
    drawing.curve(curve_of(match.after_h, panels[i], panel), after_colour(), 2.0);
  }
  return drawing.finished();
}

std::string stabilisation_chart(const SsiResult& ssi, const Fdd& spectra) {
  Panel panel;
  panel.top = kLegendHeight;
  const double bottom = kLegendHeight + 360.0;
  int orders = 2;
  double highest = 1.0;
  for (const Pole& pole : ssi.poles)
    orders = std::max(orders, pole.order), highest = std::max(highest, pole.frequency());
  panel.x = {ChartAxis::Kind::linear, 0.0, 1.02 * highest, kLeft, kChartWidth - kRight};
  panel.y = {ChartAxis::Kind::linear, 0.0, double(orders) + 2.0, bottom, panel.top};
  SvgDrawing drawing(kChartWidth, bottom + kAxisHeight, "Stabilisation diagram");
  draw_legend(drawing, kLeft, 18.0,
              {{Marker::circle, after_colour(), "stable pole"}, {Marker::square, before_colour(), "other pole"}});
  for (double v : panel.y.ticks(30.0)) {
    drawing.line(panel.x.begin, panel.y.at(v), panel.x.end, panel.y.at(v), kGridColour);
    drawing.text(panel.x.begin - 6.0, panel.y.at(v) + 4.5, tick_text(v), {.anchor = "end"});
  }
  drawing.text(16.0, 0.5 * (panel.top + bottom), "model order", {.anchor = "middle", .turn = -90.0});
  draw_axis_below(drawing, panel.x, panel.top, bottom, "frequency, Hz");
  const Eigen::VectorXd first = spectra.singular.col(0);
  const ChartAxis power = {ChartAxis::Kind::logarithmic, std::max(first.minCoeff(), 1e-9 * first.maxCoeff()),
                           2.0 * first.maxCoeff(), bottom, panel.top};
  Points curve;
  for (Eigen::Index k = 0; k < first.size() && spectra.frequencies[k] <= panel.x.high; ++k)
    curve.emplace_back(panel.x.at(spectra.frequencies[k]), power.at(std::max(first[k], power.low)));
  drawing.curve(curve, "#8a8a92", 1.4);
  for (const IdentifiedMode& mode : ssi.modes)
    drawing.line(panel.x.at(mode.frequency), panel.top, panel.x.at(mode.frequency), bottom, measured_colour(), 1.0,
                 "2 3");
  for (const Pole& pole : ssi.poles) {
    const double x = panel.x.at(pole.frequency()), y = panel.y.at(pole.order);
    if (pole.stable())
      drawing.marker(Marker::circle, x, y, after_colour(),
                     fmt::format("{:.3f} Hz, {:.4f} s", pole.frequency(), 1.0 / pole.frequency()), 3.0);
    else
      drawing.marker(Marker::square, x, y, before_colour(), {}, 2.2);
  }
  return drawing.finished();
}

std::string history_chart(const DiagnosisInput& input, const RecordedMatch& match) {
  std::vector<std::string> channels;
  for (const Resonance& r : shown(input, match.measured_h))
    channels.push_back(match.measured_h.outputs[std::size_t(r.output)]);
  for (const ChannelMatch& c : match.channels)
    if (channels.size() < 2) channels.push_back(c.channel);
  if (channels.empty()) return "";
  channels.resize(std::min<std::size_t>(channels.size(), 3));
  const Recording& m = match.measured;
  const double step = kPanelHeight + kPanelGap + kAxisHeight, top = kLegendHeight + kPanelGap;
  SvgDrawing drawing(kChartWidth, top + double(channels.size()) * step - kPanelGap,
                     "Accelerations of sensors: measured, before and after");
  draw_lines_legend(drawing);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Eigen::Index column = column_of(m, channels[i]);
    const Window w = about_largest(m.values.col(column), m.dt);
    double most = 1e-12;
    for (const Recording* r : {&m, &match.before, &match.after})
      most = std::max(most, r->values.col(column).segment(w.first, w.count).cwiseAbs().maxCoeff());
    Panel panel;
    panel.top = top + double(i) * step;
    const double begin = match.from + double(w.first) * m.dt;
    panel.x = {ChartAxis::Kind::linear, begin, begin + double(w.count) * m.dt, kLeft, kChartWidth - kRight};
    panel.y = {ChartAxis::Kind::linear, -1.05 * most, 1.05 * most, panel.bottom(), panel.top};
    draw_frame(drawing, panel, channels[i], "m/s²");
    draw_axis_below(drawing, panel.x, panel.bottom(), panel.bottom(), "time, s");
    drawing.curve(curve_of(match.before, column, w, match.from, panel), before_colour(), 1.4, before_dashes());
    drawing.curve(curve_of(m, column, w, match.from, panel), measured_colour(), 1.6);
    drawing.curve(curve_of(match.after, column, w, match.from, panel), after_colour(), 1.6);
  }
  return drawing.finished();
}

}  // namespace voussoir
