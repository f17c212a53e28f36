// Charts as pictures: what viz/page draws as SVG, in pixels.
#pragma once
#include "viz/page/line_chart.h"

namespace voussoir {

/// Draws the chart into a PNG file so many pixels wide, text and lines in proportion. Throws InputError when there is
/// nothing to draw or the x and y of a curve differ in number, RunError when the file cannot be written.
void write_picture(const LineChart& chart, const std::string& png, int width = 1500);

}  // namespace voussoir
