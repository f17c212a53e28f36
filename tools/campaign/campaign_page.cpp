#include "tools/campaign/campaign_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "io/vtk/series.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/campaign/table.h"
#include "tools/run/damage_words.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"
#include "viz/page/palette.h"
#include "viz/render.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The value of a column in a row; NaN if the table has no such column.
double value_at(const CampaignTable& table, const std::string& column, std::size_t run) {
  const NumberColumn* found = table.find(column);
  return found ? found->values[run] : NAN;
}

std::string facts(const CampaignTable& table) {
  std::map<RunStatus, int> count;
  double seconds = 0.0;
  for (const CampaignRun& run : table.runs) {
    ++count[run.status];
    if (std::isfinite(run.seconds)) seconds += run.seconds;
  }
  std::string text = fmt::format("{}: {} done", counted(table.runs.size(), "run"), count[RunStatus::done]);
  for (const auto& [status, words] :
       {std::pair{RunStatus::collapsed, "ended because the bridge fell"}, std::pair{RunStatus::failed, "failed"},
        std::pair{RunStatus::missing, "not run yet"}})
    if (count[status] > 0) text += fmt::format(", {} {}", count[status], words);
  text = paragraph(text + fmt::format("; computing time {:.0f} min.", seconds / 60.0));
  std::vector<std::string> failures;
  for (const CampaignRun& run : table.runs)
    if (run.status == RunStatus::failed) failures.push_back(fmt::format("{}: {}", run.run, run.reason));
  return failures.empty() ? text : text + heading("Runs that failed") + list(failures);
}

/// A demand that the page shows.
struct Demand {
  std::string column, file, title, label;  // file: name of the picture of the chart; label: of its axis
  std::string residual() const { return column + ".residual"; }
};

/// The means over the keystones and over the spandrel walls. A table without them has other demands, of sensors and
/// places, and the page shows the first ones of these.
std::vector<Demand> demands_of(const CampaignTable& table) {
  constexpr std::size_t most = 4;
  const std::string mean = "largest relative displacement, mean over the places, mm";
  std::vector<Demand> demands = {{"edp.keystone_x", "keystones", "Keystones, longitudinal", mean},
                                 {"edp.spandrel_y", "spandrels", "Spandrel walls, transverse", mean}};
  std::erase_if(demands, [&](const Demand& demand) { return !table.find(demand.column); });
  if (!demands.empty()) return demands;
  for (const std::string& column : table.names("edp."))
    if (!column.ends_with(".residual") && demands.size() < most)
      demands.push_back({column, fmt::format("demand_{}", demands.size() + 1), column,
                         fmt::format("{}, largest relative displacement, mm", column)});
  return demands;
}

/// "short × 0.5", "short × 0.5, sample 2".
std::string motion_words(const CampaignRun& run) {
  return fmt::format("{} × {:g}{}{}", run.record, run.scale, run.sample.empty() ? "" : ", sample ", run.sample);
}

/// One demand against the peak ground acceleration, one series for each case.
std::string demand_chart(const CampaignTable& table, const Demand& shown) {
  if (!table.find("im.pga")) return "";
  const Marker markers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
  LineChart chart;
  chart.title = shown.title;
  chart.x_label = "PGA of the scaled motion, geometric mean of the horizontal components, g";
  chart.y_label = shown.label;
  chart.width = 820.0, chart.height = 420.0, chart.x_low = 0.0;
  const std::vector<std::string> cases = table.cases();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    ChartDots dots{cases[c], {}, {}, {}, colour_code(line_colour(c)), markers[c % 4]};
    for (std::size_t r = 0; r < table.runs.size(); ++r) {
      const double pga = value_at(table, "im.pga", r) / standard_gravity,
                   demand = 1e3 * value_at(table, shown.column, r);
      if (table.runs[r].case_name != cases[c] || !has_result(table.runs[r]) || !std::isfinite(pga + demand)) continue;
      dots.x.push_back(pga), dots.y.push_back(demand);
      dots.hints.push_back(
          fmt::format("{}, {}: {} at {:.3f} g", cases[c], motion_words(table.runs[r]), mm_text(1e-3 * demand, 1), pga));
    }
    if (!dots.x.empty()) chart.dots.push_back(dots);
  }
  double least = INFINITY, most = 0.0;
  for (const ChartDots& dots : chart.dots)
    for (const double y : dots.y) least = std::min(least, y), most = std::max(most, y);
  chart.log_y = least > 0.0 && most > 30.0 * least;  // so that a bridge that falls and one that stands are both
                                                     // readable
  if (!chart.log_y) chart.y_low = 0.0;
  return chart.dots.empty() ? "" : line_chart(chart);
}

/// The first demand of a run that has a value, spandrel walls before keystones; NaN without any.
double main_demand(const CampaignTable& table, std::size_t run) {
  std::vector<Demand> demands = demands_of(table);
  std::ranges::stable_sort(demands, {}, [](const Demand& one) { return one.column != "edp.spandrel_y"; });
  for (const Demand& one : demands)
    if (const double value = value_at(table, one.column, run); std::isfinite(value)) return value;
  return NAN;
}

/// The record and scale with the largest demands, as the mean over the cases of the share of the largest demand of
/// each case.
std::pair<std::string, double> worst_shaking(const CampaignTable& table) {
  std::map<std::string, double> largest;  // by case
  const auto demand = [&](std::size_t r) { return main_demand(table, r); };
  for (std::size_t r = 0; r < table.runs.size(); ++r)
    if (has_result(table.runs[r]) && std::isfinite(demand(r)))
      largest[table.runs[r].case_name] = std::max(largest[table.runs[r].case_name], demand(r));
  std::map<std::pair<std::string, double>, double> sums;
  for (std::size_t r = 0; r < table.runs.size(); ++r)
    if (const double most = largest[table.runs[r].case_name]; most > 0.0 && std::isfinite(demand(r)))
      sums[{table.runs[r].record, table.runs[r].scale}] += demand(r) / most;
  const auto worst = std::ranges::max_element(sums, {}, [](const auto& entry) { return entry.second; });
  return worst == sums.end() ? std::pair<std::string, double>() : worst->first;
}

/// Upper end of a scale of openings (mm) that distinguishes these runs: 1, 2 or 5 times a power of ten near the
/// geometric mean of their largest openings.
double common_range(const CampaignTable& table, const std::vector<std::size_t>& runs) {
  double sum = 0.0;
  int count = 0;
  for (const std::size_t r : runs) {
    double most = 0.0;
    for (const char* component : {"arch", "spandrel", "pier", "wall", "block"})
      if (const double o = value_at(table, fmt::format("damage.{}.largest_opening", component), r); o > most) most = o;
    if (most > 0.0) sum += std::log(1e3 * most), ++count;
  }
  if (count == 0) return 10.0;
  const double mean = std::clamp(std::exp(sum / count), 1.0, 1000.0),
               decade = std::pow(10.0, std::floor(std::log10(mean)));
  return decade * (mean < 1.5 * decade ? 1.0 : mean < 3.5 * decade ? 2.0 : mean < 7.5 * decade ? 5.0 : 10.0);
}

/// The run of each case, of one sample, with the largest demand under this record and scale.
std::vector<std::size_t> worst_runs(const CampaignTable& table, const std::string& record, double scale) {
  std::map<std::string, std::size_t> worst;  // by case
  for (std::size_t r = 0; r < table.runs.size(); ++r) {
    const CampaignRun& run = table.runs[r];
    if (run.record != record || run.scale != scale || !has_result(run)) continue;
    const auto [at, first] = worst.try_emplace(run.case_name, r);
    if (!first && main_demand(table, r) > main_demand(table, at->second)) at->second = r;
  }
  std::vector<std::size_t> runs;
  for (const std::string& name : table.cases())
    if (const auto found = worst.find(name); found != worst.end()) runs.push_back(found->second);
  return runs;
}

/// Pictures of the last frame of the worst run of each case, all with the same scale.
std::string damage_pictures(const CampaignTable& table, const std::string& directory) {
  const auto [record, scale] = worst_shaking(table);
  const std::vector<std::size_t> runs = worst_runs(table, record, scale);
  RenderOptions o;
  o.range = common_range(table, runs);
  std::vector<PagePicture> pictures;
  std::string without;
  for (const std::size_t r : runs) {
    const CampaignRun& run = table.runs[r];
    const std::string folder = directory + "/runs/" + run.run,
                      png = fmt::format("{}/images/{}.png", directory, run.run);
    try {
      const VtkSeries series(folder);
      const auto& frames = series.blocks().frames();
      if (frames.empty()) throw RunError("{} has no frames", folder);
      render_picture(PictureFiles{series.blocks().file_path(frames.back()), series.joints().file_at(frames.back().time),
                                  series.fill().file_at(frames.back().time)},
                     o, png);
      pictures.push_back({run.case_name + (run.sample.empty() ? "" : ", sample " + run.sample),
                          fmt::format("{}colours: largest opening of joints; deformations are doubled",
                                      run.status == RunStatus::collapsed ? "bridge fell; " : ""),
                          png});
    } catch (const std::exception& error) {  // a page without pictures is better than none
      without += note(fmt::format("The program could not draw {}: {}", run.run, error.what()));
    }
  }
  return pictures_section(pictures, fmt::format("Damage under the worst record, {} × {:g}", record, scale)) + without;
}

std::string number_text(double value, double factor, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", factor * value, digits) : "–";
}

/// A column of numbers in the table of the runs.
struct RunsColumn {
  std::string head, column;
  double factor = 1.0;
  int decimals = 3;
};

/// The intensity, the demands, and the values that were drawn for a sample, in the unit of the case.
std::vector<RunsColumn> runs_columns(const CampaignTable& table) {
  std::vector<RunsColumn> columns = {{"PGA, g", "im.pga", 1.0 / standard_gravity, 3}};
  for (const Demand& demand : demands_of(table)) {
    const std::string name = demand.file == "keystones"   ? "keystones x"
                             : demand.file == "spandrels" ? "spandrels y"
                                                          : demand.column;
    columns.push_back({name + ", mm", demand.column, 1e3, 1});
    if (table.find(demand.residual())) columns.push_back({"at the end, mm", demand.residual(), 1e3, 1});
  }
  return columns;
}

std::string runs_section(const CampaignTable& table) {
  constexpr std::string_view prefix = "material.";
  const std::vector<RunsColumn> columns = runs_columns(table);
  const std::vector<std::string> sampled = table.names(prefix);
  const bool samples = std::ranges::any_of(table.runs, [](const CampaignRun& run) { return !run.sample.empty(); });
  std::vector<Cell> head = {words_cell("case"), words_cell("record"), {"scale", true}};
  if (samples) head.push_back({"sample", true});
  for (const std::string& name : sampled) head.push_back({words_cell(name.substr(prefix.size())).html, true});
  for (const RunsColumn& column : columns) head.push_back({words_cell(column.head).html, true});
  head.push_back(words_cell("status"));
  std::string text = table_row(head, "th");
  for (std::size_t r = 0; r < table.runs.size(); ++r) {
    const CampaignRun& run = table.runs[r];
    std::vector<Cell> cells = {
        words_cell(run.case_name), words_cell(run.record), {number_text(run.scale, 1.0, 3), true}};
    if (samples) cells.push_back({words_cell(run.sample).html, true});
    for (const std::string& name : sampled) {
      const double value = value_at(table, name, r);
      cells.push_back({std::isfinite(value) ? fmt::format("{:.4g}", value) : "–", true});
    }
    for (const RunsColumn& column : columns)
      cells.push_back({number_text(value_at(table, column.column, r), column.factor, column.decimals), true});
    cells.push_back(words_cell(run_status_name(run.status)));
    text += table_row(cells, "td");
  }
  return heading("Runs") + "<div class=\"wide\"><table>\n" + text + "</table></div>\n" +
         (sampled.empty() ? "" : note("Values that were drawn for a sample are in the unit of the case."));
}

/// "18 mm, severe".
std::string median_text(std::vector<double> openings) {
  std::ranges::sort(openings);
  const double median = 0.5 * (openings[(openings.size() - 1) / 2] + openings[openings.size() / 2]);
  return median >= 1.0 ? fmt::format("more than 1 m, {}", damage_word(median))
                       : fmt::format("{}, {}", mm_text(median, 1), damage_word(median));
}

/// Means over the runs of a case; empty cells if a case has no such component.
std::string damage_section(const CampaignTable& table) {
  constexpr std::string_view ending = ".broken_share";
  std::vector<std::string> components;
  for (const std::string& name : table.names("damage."))
    if (name.ends_with(ending)) components.push_back(name.substr(7, name.size() - 7 - ending.size()));
  if (components.empty()) return "";
  std::vector<Cell> top = {words_cell("joints within a component or between two")};
  const std::vector<std::string> cases = table.cases();
  for (const std::string& name : cases) top.push_back(words_cell(name));
  std::string text = heading("Damage by joints") + "<table>\n" + table_row(top, "th");
  for (const std::string& component : components) {
    std::vector<Cell> row = {words_cell(component)};
    for (const std::string& name : cases) {
      double share = 0.0;
      std::vector<double> openings;
      int runs = 0;
      for (std::size_t r = 0; r < table.runs.size(); ++r) {
        if (table.runs[r].case_name != name || !has_result(table.runs[r])) continue;
        const double s = value_at(table, "damage." + component + ".broken_share", r),
                     o = value_at(table, "damage." + component + ".largest_opening", r);
        if (std::isfinite(s)) share += s, openings.push_back(std::isfinite(o) ? o : 0.0), ++runs;
      }
      row.push_back(
          words_cell(runs == 0 ? "–" : fmt::format("{:.1f} %, {}", 100.0 * share / runs, median_text(openings))));
    }
    text += table_row(row, "td");
  }
  return text + "</table>\n" +
         note(
             "Values over the runs of a case: the mean share of the bonded joint area that broke; the median of the "
             "largest joint opening, and its damage class after Burland, Broms & de Mello (1977).");
}

}  // namespace

void write_campaign_page(const std::string& directory) {
  const CampaignTable table = read_table(directory + "/table.csv");
  std::string body = facts(table);
  std::error_code ignored;  // the error occurs again when the page is written
  fs::create_directories(directory + "/images", ignored);
  for (const Demand& demand : demands_of(table))
    if (const std::string svg = demand_chart(table, demand); !svg.empty()) {
      body += figure(svg);
      write_atomically(fmt::format("{}/images/{}.svg", directory, demand.file), svg);
    }
  body += damage_pictures(table, directory) + damage_section(table) + runs_section(table);
  write_atomically(directory + "/report.html",
                   html_page("Campaign " + fs::weakly_canonical(directory).filename().string(), body));
}

}  // namespace voussoir
