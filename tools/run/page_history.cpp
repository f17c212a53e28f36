// The charts of a run's page over time, and the section on quasi-static stages.
#include <fmt/format.h>

#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "tools/run/page_sections.h"
#include "tools/run/plot_chart.h"
#include "tools/run/steps_report.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"
#include "viz/page/palette.h"

namespace voussoir {

namespace {

constexpr double chart_width = 760.0;  // px; letters have a size of 8 points on A4

using Named = std::vector<std::pair<std::string, std::string>>;  // channel, name in the legend

bool time_passes(const History& history) {
  return history.rows() > 2 && history.time().back() > history.time().front();
}

/// A chart of channels. Channels that never reach `least` are left out; empty if none reaches it.
std::string channels_chart(const RunFiles& run, const std::string& title, const std::string& label,
                           const Named& channels, double factor, double least) {
  LineChart chart;
  chart.title = title, chart.x_label = "Time, s", chart.y_label = label;
  chart.width = chart_width, chart.height = 280.0;
  for (const auto& [path, name] : channels) {
    if (!run.history.has(path)) continue;
    const std::vector<double>& values = run.history.values(path);
    if (std::ranges::none_of(values, [&](double v) { return std::abs(v) > least; })) continue;
    ChartCurve curve{.name = name, .x = run.history.time(), .y = values, .width = 1.2};
    for (double& y : curve.y) y *= factor;
    chart.curves.push_back(std::move(curve));
  }
  number_curves(chart);
  return figure(line_chart(chart));
}

Named demand_channels(const RunFiles& run, const std::string& kind) {
  Named channels;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("demand/" + kind)) {
      const std::string name = channel.path.substr(7);
      channels.emplace_back(channel.path, name.substr(0, name.size() - 2));  // without its axis
    }
  return channels;
}

/// A hundredth of the largest displacement of any demand, m. Smaller curves would not be visible in the chart.
double least_displacement(const RunFiles& run) {
  double most = 0.0;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("demand/"))
      for (const double u : run.history.values(channel.path)) most = std::max(most, std::abs(u));
  return std::max(1e-6, 0.01 * most);
}

std::string sensor_charts(const RunFiles& run) {
  std::string text;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("sensors/") && channel.path.ends_with("/displacement"))
      text += channels_chart(run, "Sensor " + channel.path.substr(8, channel.path.size() - 21), "Displacement, mm",
                             {{channel.path, ""}}, 1e3, 1e-7);
  return text;
}

Named damage_channels(const RunFiles& run) {
  Named channels;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("damage/"))
      channels.emplace_back(channel.path, channel.path.substr(7, channel.path.rfind('/') - 7));
  return channels;
}

}  // namespace

std::string histories_section(const RunFiles& run) {
  if (!time_passes(run.history)) return "";
  const double least = least_displacement(run);
  std::string text =
      channels_chart(run, "Acceleration of the base", "Acceleration, g",
                     {{"base/acceleration_x", "x"}, {"base/acceleration_y", "y"}, {"base/acceleration_z", "z"}},
                     1.0 / standard_gravity, 0.0);
  text += channels_chart(run, "Keystones, longitudinal", "Displacement along x relative to the base, mm",
                         demand_channels(run, "keystone"), 1e3, least);
  text += channels_chart(run, "Spandrel walls, transverse", "Displacement along y relative to the base, mm",
                         demand_channels(run, "spandrel"), 1e3, least);
  text += sensor_charts(run);
  text += channels_chart(run, "Lost bond of the joints within a component or between two components",
                         "Share of the bonded joint area, %", damage_channels(run), 100.0, 0.0);
  text += channels_chart(run, "Energy since the start", "Energy, kJ",
                         {{"energy/kinetic", "kinetic"},
                          {"energy/elastic", "elastic"},
                          {"energy/friction", "friction"},
                          {"energy/fracture", "fracture"},
                          {"energy/plastic", "plastic work in the fill"},
                          {"energy/joint_damping", "joint damping"},
                          {"energy/external_work", "work of loads and base"}},
                         1e-3, 1e-9);
  return text.empty() ? "" : heading("Histories") + text;
}

std::string plots_section(const RunFiles& run) {
  if (run.history.rows() < 2) return "";
  std::string text;
  for (const PlotSpec& plot : run.c.plots) try {
      LineChart chart = plot_chart(plot, run.history);
      chart.width = chart_width, chart.height = 340.0;
      text += figure(line_chart(chart));
    } catch (const InputError& error) {
      text += note(fmt::format("{}: {}", plot.title, error.what()));
    }
  return text.empty() ? "" : heading("Plots of the case") + text;
}

std::string steps_section(const RunFiles& run) {
  const std::vector<StageSettings>& stages = run.stages();
  const nlohmann::json all = steps_json(stages, run.history);
  if (all.empty()) return "";
  std::string text = heading("Quasi-static stages") + "<table>\n";
  text += table_row({words_cell("stage"),
                     words_cell("path"),
                     {"largest force, kN", true},
                     {"at displacement, mm", true},
                     {"last force, kN", true},
                     {"at displacement, mm", true}},
                    "th");
  for (const nlohmann::json& one : all) {
    const auto number = [&](const char* key, double factor) {
      return Cell{fmt::format("{:.4g}", factor * one.value(key, NAN)), true};
    };
    text += table_row({words_cell(fmt::format("{}. {}", one.value("stage", 0), one.value("label", std::string()))),
                       words_cell(one.value("whole", false)
                                      ? "completed"
                                      : fmt::format("no equilibrium beyond the share {:.4g}", one.value("share", 0.0))),
                       number("largest_force", 1e-3), number("largest_force_at", 1e3), number("force", 1e-3),
                       number("displacement", 1e3)},
                      "td");
  }
  text += "</table>\n" +
          note("Each row of history.h5 in these stages is an equilibrium. steps.csv has these rows as a table.");
  for (LineChart chart :
       {capacity_chart(stages, run.history), deck_chart(stages, run.history), reaction_chart(stages, run.history)}) {
    chart.width = chart_width;
    text += figure(line_chart(chart));
  }
  return text;
}

}  // namespace voussoir
