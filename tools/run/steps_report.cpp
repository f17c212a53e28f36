#include "tools/run/steps_report.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/base/csv.h"
#include "solver/statics/stops.h"

namespace voussoir {

namespace {

/// Channels of the table; those of the increments come first.
std::vector<const Channel*> table_columns(const History& history) {
  std::vector<const Channel*> columns;
  for (const char* family : {"steps/", "reactions/", "places/", "deck/"})
    for (const Channel& channel : history.channels())
      if (channel.path.starts_with(family)) columns.push_back(&channel);
  return columns;
}

std::vector<double> values_at(const History& history, const std::string& channel, const std::vector<std::size_t>& rows,
                              double factor) {
  std::vector<double> values;
  for (const std::size_t row : rows) values.push_back(factor * history.values(channel)[row]);
  return values;
}

/// One channel over another, in these rows and units.
ChartCurve curve_of(const std::string& name, const History& history, const std::vector<std::size_t>& rows,
                    const std::string& x, double x_factor, const std::string& y, double y_factor) {
  ChartCurve curve;
  curve.name = name;
  curve.x = values_at(history, x, rows, x_factor), curve.y = values_at(history, y, rows, y_factor);
  return curve;
}

std::string stage_name(const std::vector<StageSettings>& stages, std::size_t number) {
  return fmt::format("{}. {}", number, stages[number - 1].label);
}

}  // namespace

std::map<std::size_t, std::vector<std::size_t>> step_rows(const std::vector<StageSettings>& stages,
                                                          const History& history) {
  std::map<std::size_t, std::vector<std::size_t>> rows;
  if (!history.has("steps/share")) return rows;
  const std::vector<double>& stage = history.values("stage");
  for (std::size_t row = 0; row < stage.size(); ++row) {
    const auto number = std::size_t(stage[row]);
    if (number >= 1 && number <= stages.size() && stages[number - 1].kind == StageSettings::Kind::quasi_static)
      rows[number].push_back(row);
  }
  return rows;
}

std::string steps_table(const std::vector<StageSettings>& stages, const History& history) {
  const std::vector<const Channel*> columns = table_columns(history);
  std::string text = "stage,label";
  for (const Channel* column : columns)
    text += "," + csv_cell(column->unit == "-" ? column->path : fmt::format("{} ({})", column->path, column->unit));
  text += "\n";
  for (const auto& [number, rows] : step_rows(stages, history))
    for (const std::size_t row : rows) {
      text += fmt::format("{},{}", number, csv_cell(stages[number - 1].label));
      for (const Channel* column : columns) text += fmt::format(",{:.10g}", history.values(column->path)[row]);
      text += "\n";
    }
  return text;
}

nlohmann::json steps_json(const std::vector<StageSettings>& stages, const History& history) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& [number, rows] : step_rows(stages, history)) {
    const std::vector<double>&share = history.values("steps/share"), &force = history.values("steps/force"),
          &displacement = history.values("steps/displacement"), &multiplier = history.values("steps/multiplier");
    std::size_t peak = rows.front();
    for (const std::size_t row : rows)
      if (std::abs(force[row]) > std::abs(force[peak])) peak = row;
    const double asked = stages[number - 1].quasi_static.path.back();
    const std::size_t last = rows.back();
    json.push_back({{"stage", number},
                    {"label", stages[number - 1].label},
                    {"equilibria", rows.size()},
                    {"share", share[last]},
                    {"whole", share[last] == asked && rows.size() > stops_of(stages[number - 1].quasi_static).size()},
                    {"multiplier", multiplier[last]},
                    {"displacement", displacement[last]},
                    {"force", force[last]},
                    {"largest_force", force[peak]},
                    {"largest_force_at", displacement[peak]},
                    {"largest_multiplier", multiplier[peak]}});
  }
  return json;
}

LineChart capacity_chart(const std::vector<StageSettings>& stages, const History& history) {
  LineChart chart;
  chart.title = "Capacity curve: each point an equilibrium";
  chart.x_label = "Displacement since the beginning of the stage, mm", chart.y_label = "Force, kN";
  for (const auto& [number, rows] : step_rows(stages, history)) {
    chart.curves.push_back(
        curve_of(stage_name(stages, number), history, rows, "steps/displacement", 1e3, "steps/force", 1e-3));
    chart.curves.back().dots = true;
  }
  number_curves(chart);
  return chart;
}

LineChart deck_chart(const std::vector<StageSettings>& stages, const History& history) {
  LineChart chart;
  chart.title = "Settlement along the deck at the end of the stage, since its beginning (up is positive)";
  chart.x_label = "x, m", chart.y_label = "Vertical displacement, mm";
  for (const auto& [number, rows] : step_rows(stages, history)) {
    ChartCurve curve;
    curve.name = stage_name(stages, number);
    for (const Channel& channel : history.channels()) {
      if (!channel.path.starts_with("deck/")) continue;
      const std::vector<double>& z = history.values(channel.path);
      curve.x.push_back(std::stod(channel.path.substr(5)));
      curve.y.push_back(1e3 * (z[rows.back()] - z[rows.front()]));
    }
    if (!curve.x.empty()) chart.curves.push_back(curve);
  }
  number_curves(chart);
  return chart;
}

LineChart reaction_chart(const std::vector<StageSettings>& stages, const History& history) {
  LineChart chart;
  chart.title = "Vertical reactions";
  chart.x_label = "Share of the loads and settlements", chart.y_label = "Reaction, kN";
  const auto all = step_rows(stages, history);
  for (const auto& [number, rows] : all)
    for (const Channel& channel : history.channels()) {
      if (!channel.path.starts_with("reactions/") || !channel.path.ends_with("_z")) continue;
      const std::string group = channel.path.substr(10, channel.path.size() - 12);
      const std::string name = all.size() > 1 ? fmt::format("{}: {}", number, group) : group;
      const ChartCurve curve = curve_of(name, history, rows, "steps/share", 1.0, channel.path, 1e-3);
      const bool acts = std::ranges::any_of(curve.y, [](double v) { return v != 0.0; });
      if (acts) chart.curves.push_back(curve);
    }
  number_curves(chart);
  return chart;
}

}  // namespace voussoir
