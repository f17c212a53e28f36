#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>

#include "io/case/sections.h"
#include "io/records/curve.h"
#include "solver/base/atomic_file.h"

namespace voussoir {

namespace {

/// A missing file is no error: the plot is drawn without it, and the log of the run says so.
MeasuredCurve read_measured(TableReader& table, const Case& c) {
  MeasuredCurve curve;
  const std::string file = table.required_text("file");
  curve.file = relative_to(c.path, file);
  curve.label = table.text("label", std::filesystem::path(file).stem().string());
  table.finish();
  std::error_code ignored;  // an error counts as a missing file
  if (std::filesystem::is_regular_file(curve.file, ignored)) {
    curve.text = read_text(curve.file);
    parse_curve(curve.text, curve.file);
  }
  return curve;
}

bool file_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name[0] != '.' &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char ch) { return std::isalnum(ch) || std::strchr("-_.", ch); });
}

}  // namespace

std::string measured_file_name(std::size_t plot, std::size_t curve) {
  return fmt::format("measured_{}_{}.txt", plot + 1, curve + 1);
}

void read_plots(TableReader& root, Case& c) {
  for (TableReader& table : root.tables("plot")) {
    PlotSpec plot;
    plot.name = table.required_text("name");
    if (!file_name(plot.name))
      table.fail("name",
                 fmt::format("is \"{}\". It becomes the name of a file: use only letters, digits, - and _", plot.name));
    for (const PlotSpec& other : c.plots)
      if (other.name == plot.name)
        table.fail("name", fmt::format("is \"{}\", which another plot has. Each plot needs its own name.", plot.name));
    plot.title = table.text("title", "");
    plot.label = table.text("label", plot.label);
    plot.x = table.text("x", plot.x);
    plot.y = table.required_text("y");
    plot.x_factor = table.number("x_factor", 1.0, {-1e15, 1e15, ""});
    plot.y_factor = table.number("y_factor", 1.0, {-1e15, 1e15, ""});
    plot.x_label = table.text("x_label", "");
    plot.y_label = table.text("y_label", "");
    for (TableReader& measured : table.tables("measured")) plot.measured.push_back(read_measured(measured, c));
    table.finish();
    c.plots.push_back(std::move(plot));
  }
}

}  // namespace voussoir
