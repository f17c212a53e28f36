// Line charts of histories for reports: energies, displacements of a keystone, spectra.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct Series {
  std::string name;          // in the legend; empty: not listed
  std::vector<double> x, y;  // same length; points that are not finite break the line
};

struct PlotOptions {
  std::string title;
  int width = 1500, height = 900;  // pixels
  bool log_x = false, log_y = false;
  bool markers = false;  // a dot at each point, for few points
};

/// Draws the series into a PNG file. Labels carry the unit: "time (s)". Needs no display: see viz/display.h. Throws
/// InputError when a series is empty or its x and y differ in length, RunError when the file cannot be written.
void plot_lines(const std::vector<Series>& series, const std::string& x_label, const std::string& y_label,
                const PlotOptions& options, const std::string& png);
void plot_lines(const std::vector<Series>& series, const std::string& x_label, const std::string& y_label,
                const std::string& title, const std::string& png);

}  // namespace voussoir
