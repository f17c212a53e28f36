// Shared parts of the charts of a diagnosis: colours, and rows with names on the left and numbers on the right.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"
#include "viz/page/svg.h"

namespace voussoir {

constexpr double kChartWidth = 1020.0, kLabelWidth = 190.0, kLegendHeight = 30.0, kAxisHeight = 46.0;  // px

const std::string& measured_colour();
const std::string& before_colour();
const std::string& materials_colour();
const std::string& after_colour();
LegendEntry measured_entry();
LegendEntry before_entry();
LegendEntry after_entry();
ShapeStyle filled_with(const std::string& colour);

/// The rows of a chart, in px: one row for each mode or data set.
struct ChartRows {
  double top = 0.0, height = 0.0;
  std::size_t count = 0;
  double middle(std::size_t i) const { return top + (double(i) + 0.5) * height; }
  double bottom() const { return top + double(count) * height; }
};
void draw_row_lines(SvgDrawing& drawing, const ChartRows& rows);
/// Writes the title of a row and, in smaller letters below it, `note`, which may be empty.
void draw_row_label(SvgDrawing& drawing, double y, const std::string& title, const std::string& note);
/// Writes the names of the modes. Rows of modes that are held back are shaded.
void draw_mode_rows(SvgDrawing& drawing, const ChartRows& rows, const std::vector<const ModeComparison*>& modes);

/// Heading of a column of numbers that ends at x.
void draw_column_heading(SvgDrawing& drawing, double x, double y, const std::string& text);
/// Writes a number that ends at x and `small` below it, which may be empty.
void draw_column_number(SvgDrawing& drawing, double x, double y, const std::string& number, const std::string& small);
/// "+1.2", "−0.4"; 0.0 without a sign.
std::string signed_number(double value);

}  // namespace voussoir
