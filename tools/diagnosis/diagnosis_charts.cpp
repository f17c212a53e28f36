#include "tools/diagnosis/diagnosis_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnosis/chart_rows.h"
#include "tools/diagnosis/diagnosis_values.h"

namespace voussoir {

namespace {

/// Bars of the case before the diagnosis: a light fill, so that they stay lighter in a grey print.
ShapeStyle before_bar() {
  return {"#fbe3d3", before_colour(), 1.2, ""};
}

/// The parts of both locations; those with the largest share before come first.
std::vector<std::string> parts_of(const Location& before, const Location& after) {
  constexpr std::size_t most = 14;
  std::vector<std::string> parts;
  for (const Location* location : {&before, &after})
    for (const PartResidual& p : location->parts)
      if (std::find(parts.begin(), parts.end(), p.part) == parts.end()) parts.push_back(p.part);
  if (parts.size() > most) parts.resize(most);
  return parts;
}

const PartResidual* part_in(const Location& location, const std::string& part) {
  for (const PartResidual& p : location.parts)
    if (p.part == part) return &p;
  return nullptr;
}

double largest_share(const Location& before, const Location& after) {
  double most = 0.01;
  for (const Location* location : {&before, &after})
    for (const PartResidual& p : location->parts) most = std::max(most, p.share);
  return most;
}

struct SharePanel {
  double begin = 0.0, width = 300.0;  // of the largest bar
  double most = 1.0;
  ShapeStyle style;
};

void draw_share(SvgDrawing& drawing, const SharePanel& panel, double y, const PartResidual* part) {
  if (!part) return drawing.text(panel.begin + 6.0, y + 5.0, "nothing");
  const double width = panel.width * part->share / panel.most;
  drawing.rectangle(panel.begin, y - 8.0, width, 16.0, panel.style);
  drawing.text(panel.begin + width + 6.0, y + 5.0, fmt::format("{:.0f} % ({})", 100.0 * part->share, part->axis));
}

std::string size_text(double size) {
  if (size >= 0.1) return fmt::format("{:.0f} %", 100.0 * size);
  return fmt::format("{:.2g} %", 100.0 * size);
}

struct ProbabilityRow {
  std::string name, mark;
  double probability = 0.0;
  ShapeStyle style;
};

std::vector<ProbabilityRow> probability_rows(const Round& round) {
  const ShapeStyle chosen = filled_with(after_colour()), other = {"#cfe3f2", after_colour(), 1.0, ""},
                   none = {"#ffffff", measured_colour(), 1.0, "3 2"};
  std::vector<ProbabilityRow> rows;
  for (std::size_t i = 0; i < round.trials.size(); ++i) {
    const Trial& t = round.trials[i];
    const bool added = i == 0 && round.accepted;
    rows.push_back({t.candidate.full_text(),
                    added   ? "added"
                    : t.tie ? "tie"
                            : "",
                    t.probability, added ? chosen : other});
  }
  rows.push_back({"none of them", "", round.none, none});
  return rows;
}

/// The likely range: one and two standard deviations about the usual value.
void draw_prior(SvgDrawing& drawing, const ChartAxis& axis, double y) {
  drawing.rectangle(axis.at(-2.0), y - 10.0, axis.at(2.0) - axis.at(-2.0), 20.0, filled_with(kBandColour));
  drawing.rectangle(axis.at(-1.0), y - 10.0, axis.at(1.0) - axis.at(-1.0), 20.0, filled_with("#d3d3da"));
  drawing.line(axis.at(0.0), y - 10.0, axis.at(0.0), y + 10.0, "#ffffff", 2.0);
}

void draw_material(SvgDrawing& drawing, const ChartAxis& axis, double y, const Fit& fit, std::size_t i, Marker marker,
                   const std::string& colour) {
  const double x = fit.best.x[Eigen::Index(i)], std = fit.std[Eigen::Index(i)];
  drawing.error_bar(axis.at(std::max(x - std, axis.low)), y, axis.at(std::min(x + std, axis.high)), y, colour);
  drawing.marker(marker, axis.at(x), y, colour);
}

std::string material_number(const Fit& fit, std::size_t i) {
  const FitParameter& p = fit.hypothesis.materials[i].parameter;
  const double x = fit.best.x[Eigen::Index(i)], std = fit.std[Eigen::Index(i)];
  return with_std(p.value(x), 0.5 * (p.value(x + std) - p.value(x - std)));
}

ChartAxis materials_axis(const Diagnosis& d, double begin, double end) {
  double most = 3.0;
  for (const Fit* fit : {&d.calibrated, &d.best})
    for (std::size_t i = 0; i < fit->hypothesis.materials.size(); ++i)
      most = std::max(most, std::abs(fit->best.x[Eigen::Index(i)]) + fit->std[Eigen::Index(i)] + 0.1);
  return {ChartAxis::Kind::linear, -most, most, begin, end};
}

ChartAxis gap_axis(const std::vector<GapRow>& rows, double begin, double end) {
  std::vector<double> values = {0.5, 2.0};
  for (const GapRow& row : rows)
    for (double gap : {row.before, row.materials, row.after})
      if (std::isfinite(gap) && gap > 0.0) values.push_back(gap);
  return axis_around(values, begin, end);
}

}  // namespace

std::vector<GapRow> gap_rows(const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  std::vector<GapRow> rows = {{"the fitted data", result.before.gap, d.calibrated.gap, result.after.gap}};
  const bool held = std::any_of(result.modes.begin(), result.modes.end(), [](const auto& m) { return m.held_back; });
  if (held) rows.push_back({"modes held back", result.before.held_gap, d.calibrated.held_gap, result.after.held_gap});
  rows.push_back({"modes left out", result.before.gap, d.calibrated.predicted_gap, d.best.predicted_gap});
  return rows;
}

std::string gap_chart(const std::vector<GapRow>& gaps) {
  const ChartRows rows = {kLegendHeight, 34.0, gaps.size()};
  SvgDrawing drawing(kChartWidth, rows.bottom() + kAxisHeight, "Gap between measurement and model");
  const ChartAxis axis = gap_axis(gaps, kLabelWidth, 700.0);
  if (axis.low < 1.0)
    drawing.rectangle(axis.begin, rows.top, axis.at(std::min(1.0, axis.high)) - axis.begin, rows.bottom() - rows.top,
                      filled_with(kBandColour));
  draw_row_lines(drawing, rows);
  draw_axis_below(drawing, axis, rows.top, rows.bottom(),
                  "gap, standard deviations (grey: at most 1, as good as noise)");
  draw_legend(drawing, kLabelWidth, 16.0,
              {before_entry(), {Marker::diamond, materials_colour(), "materials fitted"}, after_entry()});
  const double columns[] = {800.0, 908.0, kChartWidth - 4.0};
  const char* const headings[] = {"before", "materials", "after"};
  for (std::size_t k = 0; k < 3; ++k) draw_column_heading(drawing, columns[k], 16.0, headings[k]);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double y = rows.middle(i);
    draw_row_label(drawing, y, gaps[i].data, "");
    const double values[] = {gaps[i].before, gaps[i].materials, gaps[i].after};
    const Marker markers[] = {Marker::square, Marker::diamond, Marker::triangle};
    const std::string* const colours[] = {&before_colour(), &materials_colour(), &after_colour()};
    for (std::size_t k = 0; k < 3; ++k) {
      draw_column_number(drawing, columns[k], y, gap_text(values[k]), "");
      if (std::isfinite(values[k]) && values[k] > 0.0) drawing.marker(markers[k], axis.at(values[k]), y, *colours[k]);
    }
  }
  return drawing.finished();
}

std::string where_chart(const Location& before, const Location& after) {
  const std::vector<std::string> parts = parts_of(before, after);
  if (parts.empty()) return "";
  const ChartRows rows = {44.0, 26.0, parts.size()};
  SvgDrawing drawing(kChartWidth, rows.bottom() + 6.0, "Where the model disagrees with the measured modes");
  const double most = largest_share(before, after);
  const bool little = after.size < 0.1 * before.size;
  const ShapeStyle pale = {"#e6f0f8", after_colour(), 1.0, "3 2"};
  const SharePanel left = {kLabelWidth, 320.0, most, before_bar()},
                   right = {620.0, 320.0, most, little ? pale : filled_with(after_colour())};
  drawing.text(left.begin, 16.0, "the case as it is", {.bold = true});
  drawing.text(left.begin, 33.0, fmt::format("size of the correction: {}", size_text(before.size)));
  drawing.text(right.begin, 16.0, "the corrected case", {.bold = true});
  drawing.text(right.begin, 33.0,
               fmt::format("size of the correction: {}{}", size_text(after.size), little ? " (little is left)" : ""));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    draw_row_label(drawing, rows.middle(i), parts[i], "");
    draw_share(drawing, left, rows.middle(i), part_in(before, parts[i]));
    draw_share(drawing, right, rows.middle(i), part_in(after, parts[i]));
  }
  drawing.line(left.begin, rows.top, left.begin, rows.bottom(), kFrameColour);
  drawing.line(right.begin, rows.top, right.begin, rows.bottom(), kFrameColour);
  return drawing.finished();
}

std::string probability_chart(const Round& round) {
  const std::vector<ProbabilityRow> bars = probability_rows(round);
  constexpr double begin = 340.0;
  const ChartRows rows = {4.0, 26.0, bars.size()};
  SvgDrawing drawing(kChartWidth, rows.bottom() + kAxisHeight, "Probabilities of the candidates");
  const ChartAxis axis = {ChartAxis::Kind::linear, 0.0, 1.0, begin, 860.0};
  draw_axis_below(drawing, axis, rows.top, rows.bottom(), "probability");
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const ProbabilityRow& bar = bars[i];
    const double y = rows.middle(i), end = axis.at(std::clamp(bar.probability, 0.0, 1.0));
    drawing.text(begin - 8.0, y + 5.0, shortened(bar.name, 42), {.anchor = "end", .bold = bar.mark == "added"});
    drawing.rectangle(begin, y - 8.0, end - begin, 16.0, bar.style);
    drawing.text(end + 7.0, y + 5.0,
                 probability_text(bar.probability) + (bar.mark.empty() ? "" : fmt::format(", {}", bar.mark)),
                 {.bold = bar.mark == "added"});
  }
  return drawing.finished();
}

std::string materials_chart(const Diagnosis& d) {
  const std::size_t count = d.calibrated.hypothesis.materials.size();
  if (count == 0) return "";
  const bool added = !d.best.hypothesis.effects.empty();
  const ChartRows rows = {kLegendHeight, 36.0, count};
  SvgDrawing drawing(kChartWidth, rows.bottom() + kAxisHeight, "Fitted materials");
  const ChartAxis axis = materials_axis(d, kLabelWidth, 690.0);
  draw_row_lines(drawing, rows);
  draw_axis_below(drawing, axis, rows.top, rows.bottom(),
                  "deviation from the usual value, standard deviations of the likely range");
  std::vector<LegendEntry> legend = {{Marker::diamond, materials_colour(), "materials alone"}};
  if (added) legend.push_back({Marker::triangle, after_colour(), "with the effects found"});
  draw_legend(drawing, kLabelWidth, 16.0, legend);
  draw_column_heading(drawing, added ? 856.0 : kChartWidth - 4.0, 16.0, "factor, alone");
  if (added) draw_column_heading(drawing, kChartWidth - 4.0, 16.0, "with the effects");
  for (std::size_t i = 0; i < count; ++i) {
    const double y = rows.middle(i);
    const FitParameter& p = d.calibrated.hypothesis.materials[i].parameter;
    draw_row_label(drawing, y, p.name, fmt::format("likely {:.2f} to {:.2f}", p.value(-2.0), p.value(2.0)));
    draw_prior(drawing, axis, y);
    draw_material(drawing, axis, added ? y - 6.0 : y, d.calibrated, i, Marker::diamond, materials_colour());
    draw_column_number(drawing, added ? 856.0 : kChartWidth - 4.0, y, material_number(d.calibrated, i), "");
    if (!added) continue;
    draw_material(drawing, axis, y + 6.0, d.best, i, Marker::triangle, after_colour());
    draw_column_number(drawing, kChartWidth - 4.0, y, material_number(d.best, i), "");
  }
  return drawing.finished();
}

}  // namespace voussoir
