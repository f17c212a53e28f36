// Comparison of campaigns, motion by motion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "solver/base/error.h"
#include "tools/campaign/table.h"
#include "tools/compare/compare.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

using Motion = std::tuple<std::string, std::string, double, std::string>;  // case, record, scale, sample

/// Rows of a table by motion. If each table has only one case, the names of the cases are ignored.
std::map<Motion, std::size_t> rows_of(const CampaignTable& table, bool by_case) {
  std::map<Motion, std::size_t> rows;
  for (std::size_t r = 0; r < table.runs.size(); ++r) {
    const CampaignRun& run = table.runs[r];
    rows[{by_case ? run.case_name : std::string(), run.record, run.scale, run.sample}] = r;
  }
  return rows;
}

std::string motion_words(const Motion& motion) {
  const auto& [name, record, scale, sample] = motion;
  return fmt::format("{}{}{} × {:g}{}{}", name, name.empty() ? "" : ", ", record, scale,
                     sample.empty() ? "" : ", sample ", sample);
}

/// Unit and factor of a demand: displacements in mm.
std::pair<const char*, double> unit_of(const std::string& column) {
  return column.starts_with("edp.") ? std::pair{"mm", 1e3} : std::pair{"", 1.0};
}

/// A chart of one demand: each point is a motion, with the value in the first campaign and in another one. A line shows
/// equal values.
std::string scatter(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows,
                    const std::string& what) {
  LineChart chart;
  chart.title = what, chart.x_label = names.front() + ", mm", chart.y_label = "Other campaigns, mm";
  chart.width = 640.0, chart.height = 420.0;
  const Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  double least = 1e300, most = 0.0;
  for (std::size_t i = 1; i < names.size(); ++i) {
    ChartDots dots{.name = names[i], .colour = colour_code(line_colour(i - 1)), .marker = markers[(i - 1) % 4]};
    for (const ComparedRow& row : rows)
      if (std::isfinite(row.values[0]) && std::isfinite(row.values[i])) {
        dots.x.push_back(row.values[0]), dots.y.push_back(row.values[i]);
        dots.hints.push_back(fmt::format("{}: {} and {} mm", row.what, compared_text(row, row.values[0]),
                                         compared_text(row, row.values[i])));
        least = std::min({least, row.values[0], row.values[i]}), most = std::max({most, row.values[0], row.values[i]});
      }
    if (!dots.x.empty()) chart.dots.push_back(dots);
  }
  if (chart.dots.empty()) return "";
  chart.log_x = chart.log_y = least > 0.0 && most > 30.0 * least;
  chart.curves.push_back(
      {.name = "equal", .x = {least, most}, .y = {least, most}, .colour = kFrameColour, .dashes = "5 3"});
  return figure(line_chart(chart));
}

/// Median of the ratios to the first campaign over the motions that both have, and the number of these motions. NaN and
/// 0 if there are none.
std::pair<double, std::size_t> median_ratio(const std::vector<ComparedRow>& rows, std::size_t i) {
  std::vector<double> ratios;
  for (const ComparedRow& row : rows)
    if (row.values[0] > 0.0 && std::isfinite(row.values[i])) ratios.push_back(row.values[i] / row.values[0]);
  if (ratios.empty()) return {NAN, 0};
  std::ranges::sort(ratios);
  const std::size_t n = ratios.size();
  return {0.5 * (ratios[(n - 1) / 2] + ratios[n / 2]), n};
}

std::string status_table(const std::vector<std::string>& names, const std::vector<CampaignTable>& tables) {
  std::string text =
      "<table>\n" +
      table_row(
          {words_cell("campaign"), {"runs", true}, {"done", true}, {"fell", true}, {"failed", true}, {"missing", true}},
          "th");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    std::map<RunStatus, int> count;
    for (const CampaignRun& run : tables[i].runs) ++count[run.status];
    const auto number = [&](RunStatus status) { return Cell{std::to_string(count[status]), true}; };
    text += table_row({words_cell(names[i]),
                       {std::to_string(tables[i].runs.size()), true},
                       number(RunStatus::done),
                       number(RunStatus::collapsed),
                       number(RunStatus::failed),
                       number(RunStatus::missing)},
                      "td");
  }
  return text + "</table>\n";
}

}  // namespace

Comparison compare_campaigns(const CompareRequest& request, const std::vector<std::string>& names) {
  std::vector<CampaignTable> tables;
  for (const std::string& path : request.from)
    tables.push_back(read_table(std::filesystem::is_directory(path) ? path + "/table.csv" : path));
  const bool by_case = std::ranges::any_of(tables, [](const CampaignTable& t) { return t.cases().size() > 1; });
  std::vector<std::map<Motion, std::size_t>> rows;
  for (const CampaignTable& table : tables) rows.push_back(rows_of(table, by_case));
  Comparison c;
  c.title = "Comparison of campaigns";
  std::string medians, details;
  for (const std::string& column : tables.front().names("edp.")) {
    const auto [unit, factor] = unit_of(column);
    std::vector<ComparedRow> of;
    for (const auto& [motion, row] : rows.front()) {
      ComparedRow one{motion_words(motion), unit, {}};
      for (std::size_t i = 0; i < tables.size(); ++i) {
        const auto found = rows[i].find(motion);
        const NumberColumn* values = tables[i].find(column);
        one.values.push_back(found == rows[i].end() || !values ? NAN : factor * values->values[found->second]);
      }
      of.push_back(one);
    }
    std::vector<Cell> cells = {words_cell(column)};
    for (std::size_t i = 1; i < names.size(); ++i) {
      const auto [ratio, count] = median_ratio(of, i);
      cells.push_back(formatted_cell(ratio, "{:.3f}")), cells.push_back({std::to_string(count), true});
    }
    medians += table_row(cells, "td");
    details += heading(column) + scatter(names, of, column) + difference_table(names, of);
    for (ComparedRow& row : of) row.what = column + ", " + row.what, c.rows.push_back(row);
  }
  if (c.rows.empty()) throw InputError("{} has no column edp.…, so there is nothing to compare", tables.front().path);
  std::vector<Cell> head = {words_cell("demand")};
  for (std::size_t i = 1; i < names.size(); ++i)
    head.push_back({words_cell(names[i] + " / " + names[0]).html, true}), head.push_back({"motions", true});
  c.html = status_table(names, tables) + heading("Medians of the ratios over the motions that both campaigns have") +
           "<table>\n" + table_row(head, "th") + medians + "</table>\n" + details;
  return c;
}

}  // namespace voussoir
