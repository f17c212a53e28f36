// Comparison of modal analyses.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/hdf5/modes_file.h"
#include "tools/compare/compare.h"
#include "tools/modal/modal_report.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

ModesFile modes_of(const std::string& path) {
  return read_modes(std::filesystem::is_directory(path) ? path + "/modes.h5" : path);
}

/// A chart of the periods of each analysis, over the number of the mode of the first analysis with the same shape.
std::string period_chart(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows) {
  LineChart chart;
  chart.title = "Periods of the modes with the same shape", chart.x_label = "mode of " + names.front();
  chart.y_label = "Period, s", chart.width = 760.0, chart.height = 320.0, chart.y_low = 0.0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    ChartCurve curve{.name = names[i]};
    for (std::size_t m = 0; m < rows.size(); ++m)
      curve.x.push_back(double(m + 1)), curve.y.push_back(rows[m].values[i]);
    curve.dots = true;
    chart.curves.push_back(curve);
  }
  number_curves(chart);
  return figure(line_chart(chart));
}

}  // namespace

Comparison compare_modes(const CompareRequest& request, const std::vector<std::string>& names) {
  std::vector<ModesFile> files;
  for (const std::string& path : request.from) files.push_back(modes_of(path));
  Comparison c;
  c.title = "Comparison of modal analyses";
  const ModesFile& first = files.front();
  for (std::size_t m = 0; m < first.modes.size(); ++m)
    c.rows.push_back({fmt::format("mode {}: {}", m + 1, first.modes[m].words.text()), "s", {first.modes[m].period()}});
  std::string pairs =
      "<table>\n" +
      table_row({words_cell("mode of " + names.front()), words_cell("has the same shape as"), {"MAC", true}}, "th");
  for (std::size_t i = 1; i < files.size(); ++i) {
    const Pairing pairing = pair_modes(files[i], first);
    for (std::size_t m = 0; m < first.modes.size(); ++m) {
      const std::int64_t like = pairing.ours[m];
      c.rows[m].values.push_back(like < 0 ? NAN : files[i].modes[std::size_t(like)].period());
      pairs +=
          table_row({words_cell(std::to_string(m + 1)),
                     words_cell(like < 0 ? "no mode of " + names[i] : fmt::format("mode {} of {}", like + 1, names[i])),
                     formatted_cell(like < 0 ? pairing.assurance.col(Eigen::Index(m)).maxCoeff()
                                             : pairing.assurance(like, Eigen::Index(m)),
                                    "{:.3f}")},
                    "td");
    }
  }
  c.html = heading("Periods") + difference_table(names, c.rows) + period_chart(names, c.rows) + heading("Pairs") +
           pairs + "</table>\n" +
           note("Two modes are paired if their modal assurance criterion (MAC) is the largest and at least 0.5.");
  for (std::size_t i = 0; i < files.size(); ++i) c.html += note(names[i] + ": " + files[i].about);
  return c;
}

}  // namespace voussoir
