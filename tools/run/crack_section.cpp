#include "tools/run/crack_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/csv.h"
#include "tools/run/bridge_damage.h"
#include "tools/run/run_files.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {

constexpr int kRows = 20;

/// The map as wide as the page; printed on a separate sheet.
std::string map_figure(const std::string& directory) {
  const std::string svg = text_if_any(directory + "/images/crack_map.svg");
  if (!svg.starts_with("<svg ")) return "";
  return sheet_figure(svg) +
         note(
             "The map shows the largest openings and slips since the start, on the stones as built. "
             "images/crack_map.pdf prints to scale. It also has the present state, if that differs.");
}

/// A number of the table with few digits; text unchanged.
std::string shown_number(std::string_view word, std::size_t column) {
  double value = 0.0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (column < 3 || failed != std::errc() || end != word.data() + word.size()) return std::string(word);
  return column == 8   ? fmt::format("{:.0f}", value)
         : column == 3 ? fmt::format("{:.2f}", value)
                       : fmt::format("{:.{}f}", value, value < 9.95 ? 2 : 1);
}

/// The first rows of cracks.csv.
std::string crack_rows(const std::string& directory) {
  const TextFile file{directory + "/cracks.csv", "cracks.csv", text_if_any(directory + "/cracks.csv")};
  if (file.text.empty()) return "";
  constexpr std::size_t columns = 9;  // without area and box
  CsvReader reader(file);
  const auto cell = [](std::string_view word, std::size_t k) { return Cell{words_cell(word).html, k != 1 && k != 2}; };
  std::vector<Cell> cells;
  for (const char* head :
       {"", "where", "direction", "length, m", "opened, mm", "slid, mm", "open now, mm", "slid now, mm", "joints"})
    cells.push_back(cell(head, cells.size()));
  std::string text = "<table>\n" + table_row(cells, "th");
  int rows = 0;
  while (reader.next_row()) {
    cells.clear();
    std::string_view word;
    for (std::size_t k = 0; reader.next_cell(word); ++k)
      if (k < columns) cells.push_back(cell(shown_number(word, k), k));
    if (++rows <= kRows) text += table_row(cells, "td");
  }
  text += "</table>\n";
  return text + note(rows > kRows
                         ? fmt::format("These are the widest {} of {} cracks. All are in cracks.csv.", kRows, rows)
                         : std::string("This table is also in cracks.csv."));
}

std::string findings_table(const nlohmann::json& damage) {
  const nlohmann::json findings = damage.value("findings", nlohmann::json::array());
  if (!damage.contains("class")) return "";
  std::string text = paragraph("Class of the bridge: " + damage.value("class", std::string()) +
                               (findings.empty() ? " (there is no damage of the class \"slight\" or worse)." : "."));
  if (!findings.empty()) {
    text += "<table>\n" + table_row({words_cell("class"), words_cell("finding")}, "th");
    int rows = 0;
    for (const nlohmann::json& f : findings)
      if (++rows <= kRows)
        text +=
            table_row({words_cell(f.value("class", std::string())), words_cell(f.value("words", std::string()))}, "td");
    text += "</table>\n";
    if (rows > kRows)
      text += note(fmt::format("{} in summary.json.", counted(rows - kRows, "more finding is", "more findings are")));
  }
  return text + note(
                    "The classes are defined by this program. They follow from the width of cracks and from their "
                    "consequences for the load-bearing structure of a bridge (docs/theory/crack-map.md). The words of "
                    "Burland's classification above are made for houses.");
}

}  // namespace

std::string crack_section(const std::string& directory, const nlohmann::json& summary) {
  const std::string text = findings_table(summary.value("bridge_damage", nlohmann::json::object())) +
                           map_figure(directory) + crack_rows(directory);
  return text.empty() ? text : heading("Cracks") + text;
}

}  // namespace voussoir
