// A chart of curves over a common axis: histories, spectra, fragilities. As SVG here, as a picture in
// viz/chart_picture.h.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viz/page/drawing.h"

namespace voussoir {

struct ChartCurve {
  std::string name = {};               // in the legend; empty: not listed
  std::vector<double> x = {}, y = {};  // values that are not finite interrupt the curve
  std::string colour = "#1f1f24";
  double width = 1.8;       // px
  std::string dashes = {};  // "6 3"
  bool dots = false;        // a dot at each point, for few points
};

struct ChartBand {
  std::string name = {};
  std::vector<double> x = {}, low = {}, high = {};
  std::string colour = "#d6e6f2";
};

struct ChartDots {
  std::string name = {};
  std::vector<double> x = {}, y = {};
  std::vector<std::string> hints = {};  // one a dot, or none
  std::string colour = "#1f1f24";
  Marker marker = Marker::circle;
};

struct LineChart {
  std::string title = {}, x_label = {}, y_label = {};  // labels with units: "period, s"
  double width = 1000.0, height = 380.0;               // px, without the legend above
  bool log_x = false, log_y = false;
  // Limits of the axes; without a value the axis encloses the data.
  std::optional<double> x_low = {}, x_high = {}, y_low = {}, y_high = {};
  std::vector<ChartBand> bands = {};  // drawn first
  std::vector<ChartCurve> curves = {};
  std::vector<ChartDots> dots = {};
};

/// Height of the drawing, px: the chart and its legend above.
double height_of(const LineChart& chart);
void draw(Drawing& drawing, const LineChart& chart);

/// The chart as SVG; empty if there is nothing to show.
std::string line_chart(const LineChart& chart);

/// Gives the curves the line colours in turn, and dashes when all colours are used.
void number_curves(LineChart& chart);

/// The curve with only the smallest and the largest value of each of `shares` equal parts, in the order of the curve.
/// A picture cannot show more points. A curve of at most 2 × `shares` points is not changed.
ChartCurve thinned(const ChartCurve& curve, std::size_t shares = 900);

}  // namespace voussoir
