#include "tools/diagnosis/chart_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/diagnosis/diagnosis_values.h"

namespace voussoir {

const std::string& measured_colour() {
  static const std::string code = colour_code(kInk);
  return code;
}

const std::string& before_colour() {
  static const std::string code = colour_code(line_colour(1));
  return code;
}

const std::string& materials_colour() {
  static const std::string code = colour_code(line_colour(2));
  return code;
}

const std::string& after_colour() {
  static const std::string code = colour_code(line_colour(0));
  return code;
}

LegendEntry measured_entry() {
  return {Marker::circle, measured_colour(), "measured, ± 2 standard deviations"};
}

LegendEntry before_entry() {
  return {Marker::square, before_colour(), "the case as it is"};
}

LegendEntry after_entry() {
  return {Marker::triangle, after_colour(), "the corrected case"};
}

ShapeStyle filled_with(const std::string& colour) {
  return {colour, "none", 1.0, ""};
}

void draw_row_lines(SvgDrawing& drawing, const ChartRows& rows) {
  for (std::size_t i = 0; i <= rows.count; ++i) {
    const double y = rows.top + double(i) * rows.height;
    drawing.line(0.0, y, kChartWidth, y, kGridColour);
  }
}

void draw_row_label(SvgDrawing& drawing, double y, const std::string& title, const std::string& note) {
  const auto most = std::size_t(kLabelWidth / text_width("m", kTextSize)) - 1;
  if (note.empty()) return drawing.text(0.0, y + 5.0, shortened(title, most), {.bold = true});
  drawing.text(0.0, y - 3.0, shortened(title, most), {.bold = true});
  drawing.text(0.0, y + 13.0, shortened(note, most + 4), {.size = 12.0});
}

void draw_mode_rows(SvgDrawing& drawing, const ChartRows& rows, const std::vector<const ModeComparison*>& modes) {
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (modes[i]->held_back)
      drawing.rectangle(0.0, rows.middle(i) - 0.5 * rows.height, kChartWidth, rows.height, filled_with("#f6f1df"));
  draw_row_lines(drawing, rows);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const std::string motion = mode_motion(*modes[i]);
    draw_row_label(drawing, rows.middle(i), mode_title(*modes[i]),
                   modes[i]->held_back ? fmt::format("held back; {}", motion) : motion);
  }
}

void draw_column_heading(SvgDrawing& drawing, double x, double y, const std::string& text) {
  drawing.text(x, y, text, {.anchor = "end", .bold = true});
}

void draw_column_number(SvgDrawing& drawing, double x, double y, const std::string& number, const std::string& small) {
  drawing.text(x, small.empty() ? y + 5.0 : y - 3.0, number, {.anchor = "end"});
  if (!small.empty()) drawing.text(x, y + 13.0, small, {.anchor = "end", .size = 12.0});
}

std::string signed_number(double value) {
  if (std::abs(value) < 0.05) return "0.0";
  return fmt::format("{}{:.1f}", value < 0.0 ? "−" : "+", std::abs(value));
}

}  // namespace voussoir
