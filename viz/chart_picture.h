// Charts as pictures: the SVG charts of viz/page, in pixels.
#pragma once
#include "viz/page/line_chart.h"

namespace voussoir {

/// Draws the chart into a PNG file with the given width in pixels, text and lines in proportion. Throws InputError if
/// there is nothing to draw or the x and y of a curve differ in number, RunError if the file cannot be written.
void write_picture(const LineChart& chart, const std::string& png, int width = 1500);

}  // namespace voussoir
