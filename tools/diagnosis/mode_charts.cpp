// Periods, residuals of frequencies and modal assurance, a row each mode.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnosis/chart_rows.h"
#include "tools/diagnosis/diagnosis_charts.h"
#include "tools/diagnosis/diagnosis_values.h"

namespace voussoir {

namespace {

std::vector<const ModeComparison*> pointers(const std::vector<ModeComparison>& modes) {
  std::vector<const ModeComparison*> all;
  for (const ModeComparison& mode : modes) all.push_back(&mode);
  return all;
}

ChartAxis periods_axis(const std::vector<ModeComparison>& modes, double begin, double end) {
  std::vector<double> values;
  for (const ModeComparison& m : modes) {
    values.insert(values.end(), {m.measured, m.measured + 2.0 * m.std});
    if (m.measured > 2.0 * m.std) values.push_back(m.measured - 2.0 * m.std);
    for (double t : {m.before, m.after})
      if (t > 0.0) values.push_back(t);
  }
  return axis_around(values, begin, end);
}

void draw_period(SvgDrawing& drawing, const ChartAxis& axis, double y, const ModeComparison& m) {
  const auto hint = [&](const std::string& words) { return fmt::format("{}: {}", mode_title(m), words); };
  const double low = std::max(m.measured - 2.0 * m.std, axis.low);
  drawing.error_bar(axis.at(low), y, axis.at(m.measured + 2.0 * m.std), y, measured_colour());
  drawing.marker(Marker::circle, axis.at(m.measured), y, measured_colour(), hint("measured"));
  if (m.before > 0.0) drawing.marker(Marker::square, axis.at(m.before), y - 11.0, before_colour(), m.words_before);
  if (m.after > 0.0) drawing.marker(Marker::triangle, axis.at(m.after), y + 12.0, after_colour(), m.words_after);
}

/// A period, its frequency and a remark below each other.
void draw_period_number(SvgDrawing& drawing, double x, double y, double period, const std::string& remark) {
  if (period <= 0.0) return draw_column_number(drawing, x, y, "none", "");
  drawing.text(x, y - 8.0, fmt::format("{:#.4g} s", period), {.anchor = "end"});
  drawing.text(x, y + 6.0, fmt::format("{:#.4g} Hz", 1.0 / period), {.anchor = "end", .size = 12.0});
  drawing.text(x, y + 20.0, remark, {.anchor = "end", .size = 12.0});
}

/// Two values a mode, joined by a line. Those that are not finite are "none".
struct Dumbbell {
  const ModeComparison* mode = nullptr;
  double before = 0.0, after = 0.0;
};

struct DumbbellChart {
  std::string description, title;  // of the axis
  ChartAxis axis;
  double band_low = 0.0, band_high = 0.0;  // where all is well
  std::string (*number)(double) = nullptr;
};

std::string assurance_number(double value) {
  return fmt::format("{:.2f}", value);
}
std::string deviation_number(double value) {
  return signed_number(value);
}

void draw_dumbbell(SvgDrawing& drawing, const ChartAxis& axis, double y, const Dumbbell& d) {
  const bool both = std::isfinite(d.before) && std::isfinite(d.after);
  if (both) drawing.line(axis.at(d.before), y, axis.at(d.after), y, kFrameColour, 2.0);
  if (std::isfinite(d.before)) drawing.marker(Marker::square, axis.at(d.before), y, before_colour());
  if (std::isfinite(d.after)) drawing.marker(Marker::triangle, axis.at(d.after), y, after_colour());
}

std::string dumbbell_chart(const DumbbellChart& chart, const std::vector<Dumbbell>& dumbbells) {
  const ChartRows rows = {kLegendHeight, 36.0, dumbbells.size()};
  SvgDrawing drawing(kChartWidth, rows.bottom() + kAxisHeight, chart.description);
  std::vector<const ModeComparison*> modes;
  for (const Dumbbell& d : dumbbells) modes.push_back(d.mode);
  draw_mode_rows(drawing, rows, modes);
  drawing.rectangle(chart.axis.at(chart.band_low), rows.top,
                    chart.axis.at(chart.band_high) - chart.axis.at(chart.band_low), rows.bottom() - rows.top,
                    filled_with(kBandColour));
  draw_axis_below(drawing, chart.axis, rows.top, rows.bottom(), chart.title);
  draw_legend(drawing, kLabelWidth, 16.0, {before_entry(), after_entry()});
  draw_column_heading(drawing, kChartWidth - 90.0, 16.0, "before");
  draw_column_heading(drawing, kChartWidth - 4.0, 16.0, "after");
  const auto number = [&](double value) { return std::isfinite(value) ? chart.number(value) : std::string("none"); };
  for (std::size_t i = 0; i < dumbbells.size(); ++i) {
    draw_dumbbell(drawing, chart.axis, rows.middle(i), dumbbells[i]);
    draw_column_number(drawing, kChartWidth - 90.0, rows.middle(i), number(dumbbells[i].before), "");
    draw_column_number(drawing, kChartWidth - 4.0, rows.middle(i), number(dumbbells[i].after), "");
  }
  return drawing.finished();
}

}  // namespace

std::string periods_chart(const std::vector<ModeComparison>& modes) {
  const ChartRows rows = {kLegendHeight, 50.0, modes.size()};
  SvgDrawing drawing(kChartWidth, rows.bottom() + kAxisHeight, "Measured and computed periods and frequencies");
  draw_mode_rows(drawing, rows, pointers(modes));
  const ChartAxis axis = periods_axis(modes, kLabelWidth, 700.0);
  draw_axis_below(drawing, axis, rows.top, rows.bottom(),
                  axis.kind == ChartAxis::Kind::logarithmic ? "period, s (logarithmic scale)"
                                                            : "period, s (linear scale that does not start at 0)");
  draw_legend(drawing, 0.0, 16.0, {measured_entry(), before_entry(), after_entry()});
  const double columns[] = {800.0, 908.0, kChartWidth - 4.0};
  const char* const headings[] = {"measured", "before", "after"};
  for (std::size_t k = 0; k < 3; ++k) draw_column_heading(drawing, columns[k], 16.0, headings[k]);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const ModeComparison& m = modes[i];
    draw_period(drawing, axis, rows.middle(i), m);
    const auto change = [&](double t) { return signed_number(100.0 * (t / m.measured - 1.0)) + " %"; };
    draw_period_number(drawing, columns[0], rows.middle(i), m.measured,
                       fmt::format("± {:.2g} %", 100.0 * m.std / m.measured));
    draw_period_number(drawing, columns[1], rows.middle(i), m.before, change(m.before));
    draw_period_number(drawing, columns[2], rows.middle(i), m.after, change(m.after));
  }
  return drawing.finished();
}

std::string deviations_chart(const std::vector<ModeComparison>& modes) {
  std::vector<Dumbbell> dumbbells;
  double most = 3.0;
  for (const ModeComparison& m : modes) {
    dumbbells.push_back(
        {&m, m.before > 0.0 ? m.deviations_before : std::nan(""), m.after > 0.0 ? m.deviations_after : std::nan("")});
    for (double d : {dumbbells.back().before, dumbbells.back().after})
      if (std::isfinite(d)) most = std::max(most, 1.1 * std::abs(d));
  }
  const bool far = most > 9.0;
  const ChartAxis axis = {far ? ChartAxis::Kind::squeezed : ChartAxis::Kind::linear, -most, most, kLabelWidth, 840.0};
  return dumbbell_chart(
      {"Residuals of the frequencies",
       far ? "◂ model too stiff or too light | standard deviations (compressed beyond ± 2) | too soft or too heavy ▸"
           : "◂ model too stiff or too light | standard deviations | too soft or too heavy ▸",
       axis, -2.0, 2.0, deviation_number},
      dumbbells);
}

std::string assurance_chart(const std::vector<ModeComparison>& modes) {
  std::vector<Dumbbell> dumbbells;
  for (const ModeComparison& m : modes)
    if (std::isfinite(m.mac_before) || std::isfinite(m.mac_after)) dumbbells.push_back({&m, m.mac_before, m.mac_after});
  if (dumbbells.empty()) return "";
  return dumbbell_chart({"Modal assurance of each measured mode and its computed partner",
                         "modal assurance criterion, MAC (grey: 0.9 and above)",
                         {ChartAxis::Kind::linear, 0.0, 1.0, kLabelWidth, 840.0},
                         0.9,
                         1.0,
                         assurance_number},
                        dumbbells);
}

}  // namespace voussoir
