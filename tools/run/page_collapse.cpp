// The section of a run's page on a collapse stage.
#include <fmt/format.h>

#include <cmath>

#include "solver/base/counted.h"
#include "tools/run/page_sections.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

using nlohmann::json;

std::string row(const std::string& what, const std::string& value) {
  return table_row({words_cell(what), words_cell(value)}, "td");
}

std::string answer(const json& answer, const char* yes, const char* no, const char* none) {
  return answer.is_boolean() ? (answer.get<bool>() ? yes : no) : none;
}

std::string factor_table(const json& c) {
  std::string text = "<table>\n";
  text += row("largest multiplier with an equilibrium", fmt::format("{:.5g}", c.value("multiplier", NAN)));
  text += row("smallest multiplier without an equilibrium", c["above"].is_number()
                                                                ? fmt::format("{:.5g}", c["above"].get<double>())
                                                                : std::string("none up to the limit of the stage"));
  if (c.contains("tilt_degrees"))
    text += row("this multiplier as an angle of tilt", fmt::format("{:.3f}°", c["tilt_degrees"].get<double>()));
  if (c.value("force", 0.0) > 0.0)
    text += row("forces of the pattern at that multiplier",
                fmt::format("{:.4g} kN, {:.3g} of the weight", 1e-3 * c.value("force", NAN),
                            c.value("force_over_weight", NAN)));
  if (c.value("acceleration_over_gravity", 0.0) > 0.0)
    text += row("acceleration of the pattern", fmt::format("{:.4g} g", c.value("acceleration_over_gravity", NAN)));
  text += row("found by",
              fmt::format("relaxation to equilibrium at {} (static)", counted(c.value("tries", 0), "multiplier")));
  text +=
      row("a dynamic run just below the multiplier",
          answer(c.value("stands_below", json()), "stands", "falls, which contradicts the static result", "not made"));
  text +=
      row("a dynamic run just above the multiplier",
          answer(c.value("falls_above", json()), "falls", "stands, which contradicts the static result", "not made"));
  if (c.contains("moving"))
    text += row("moving part",
                fmt::format("{}, {:.1f} % of the mass that can move", c["moving"].value("part", std::string()),
                            100.0 * c["moving"].value("share_of_mass", NAN)));
  if (c.contains("rest_stands"))
    text += row("rest of the bridge, if this part is held and its loads are removed",
                c["rest_stands"].get<bool>() ? "stands" : "falls too");
  return text + "</table>\n";
}

/// Hinges by their numbers in the picture of the mechanism.
std::string hinge_table(const json& c) {
  const json hinges = c.value("hinges", json::array());
  if (hinges.empty()) return "";
  std::string text = "<h3>Hinges and sliding joints of the mechanism</h3>\n<table>\n";
  text += table_row({{"number", true},
                     words_cell("kind"),
                     words_cell("where"),
                     {"x, m", true},
                     {"y, m", true},
                     {"z, m", true},
                     {"joints", true},
                     {"opening", true},
                     {"slip", true}},
                    "th");
  for (const json& h : hinges) {
    const std::string edge = h.value("edge", std::string());
    text += table_row({{std::to_string(h.value("number", 0)), true},
                       words_cell(h.value("kind", std::string()) + (edge.empty() ? "" : ", closed at the " + edge)),
                       words_cell(h.value("where", std::string())),
                       formatted_cell(h["place"][0].get<double>(), "{:.2f}"),
                       formatted_cell(h["place"][1].get<double>(), "{:.2f}"),
                       formatted_cell(h["place"][2].get<double>(), "{:.2f}"),
                       {std::to_string(h.value("joints", 1)), true},
                       formatted_cell(h.value("opening", NAN), "{:.3f}"),
                       formatted_cell(h.value("slip", NAN), "{:.3f}")},
                      "td");
  }
  return text + "</table>\n" +
         note(
             "The coordinates are those of the bridge as built; for a hinge, of the middle of the edge that stays "
             "closed. Neighbouring joints count as one. Opening and slip are shares of the largest displacement of the "
             "mechanism.");
}

std::string curve(const json& c) {
  LineChart chart;
  chart.title = "Equilibria on the way to the collapse load",
  chart.x_label = "Displacement since the multiplier was zero, mm";
  chart.y_label = "Multiplier", chart.width = 760.0, chart.height = 340.0, chart.y_low = 0.0;
  ChartCurve along{.name = "loaded points, along the load"}, largest{.name = "largest of any block"};
  for (const json& p : c.value("curve", json::array())) {
    along.x.push_back(1e3 * p.value("along", NAN)), along.y.push_back(p.value("multiplier", NAN));
    largest.x.push_back(1e3 * p.value("largest", NAN)), largest.y.push_back(p.value("multiplier", NAN));
  }
  if (along.x.size() < 2) return "";
  along.dots = largest.dots = true;
  chart.curves = {along, largest};
  number_curves(chart);
  return figure(line_chart(chart));
}

}  // namespace

std::string collapse_section(const RunFiles& run) {
  if (!run.summary.contains("collapse")) return "";
  const json& c = run.of("collapse");
  return heading("Collapse") + factor_table(c) + hinge_table(c) + curve(c);
}

}  // namespace voussoir
