#include "tools/run/stress_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "solver/base/atomic_file.h"
#include "solver/base/csv.h"
#include "tools/run/thrust.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

using Rings = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<const BedJoint*>>;  // by vault and ring

Rings rings_of(const std::vector<BedJoint>& beds) {
  Rings rings;
  for (const BedJoint& bed : beds) rings[{bed.vault, bed.ring}].push_back(&bed);
  return rings;
}

double over_depth(const BedJoint& bed) {
  return bed.eccentricity / bed.depth;
}

/// A chart of a value along each ring, over the position along the bridge.
template <class Value>
LineChart along_rings(const Rings& rings, const std::string& title, const std::string& label, const Value& value) {
  LineChart chart;
  chart.title = title, chart.x_label = "x, m", chart.y_label = label;
  chart.height = 280.0;
  for (const auto& [which, beds] : rings) {
    ChartCurve curve;
    curve.name = rings.size() > 1 ? fmt::format("vault {} ring {}", which.first, which.second) : std::string();
    for (const BedJoint* bed : beds) curve.x.push_back(bed->centre.x()), curve.y.push_back(value(*bed));
    curve.dots = true;
    chart.curves.push_back(curve);
  }
  number_curves(chart);
  return chart;
}

/// The eccentricity with the kern and the edges of the ring. The curve is interrupted where the thrust lies far
/// outside, because the bond is in tension and hardly any compression acts.
LineChart eccentricity_chart(const Rings& rings) {
  constexpr double far = 1.0;
  LineChart chart =
      along_rings(rings, "Eccentricity: extrados above, intrados below", "Eccentricity divided by depth",
                  [](const BedJoint& bed) { return std::abs(over_depth(bed)) < far ? over_depth(bed) : no_number; });
  double most = 0.5;
  for (const ChartCurve& curve : chart.curves)
    for (const double e : curve.y)
      if (std::isfinite(e)) most = std::max(most, std::abs(e));
  chart.y_low = -1.1 * most, chart.y_high = 1.1 * most;
  double low = 1e300, high = -1e300;
  for (const ChartCurve& curve : chart.curves)
    for (const double x : curve.x) low = std::min(low, x), high = std::max(high, x);
  chart.bands.push_back({"kern, middle third", {low, high}, {-1.0 / 6.0, -1.0 / 6.0}, {1.0 / 6.0, 1.0 / 6.0}});
  for (const double edge : {-0.5, 0.5}) {
    ChartCurve line;
    line.x = {low, high}, line.y = {edge, edge};
    line.width = 1.0, line.dashes = "6 3";
    if (edge < 0.0) line.name = "intrados and extrados";
    chart.curves.push_back(line);
  }
  return chart;
}

/// The largest value over a ring, and its position; "none" if no joint has a value.
template <class Value>
Cell most_cell(const std::vector<const BedJoint*>& beds, const Value& value, const char* format) {
  const BedJoint* most = nullptr;
  for (const BedJoint* bed : beds)
    if (std::isfinite(value(*bed)) && (!most || std::abs(value(*bed)) > std::abs(value(*most)))) most = bed;
  if (!most) return {"none", true};
  return {fmt::format(fmt::runtime(format), value(*most)) + fmt::format(" at x = {:.2f} m", most->centre.x()), true};
}

std::string most_table(const Rings& rings) {
  std::string text = "<table>\n";
  text += table_row({words_cell("vault, ring"),
                     {"largest normal force, kN", true},
                     {"largest eccentricity e/d", true},
                     {"largest utilisation", true},
                     {"largest compression, MPa", true}},
                    "th");
  for (const auto& [which, beds] : rings)
    text += table_row({words_cell(fmt::format("{}, {}", which.first, which.second)),
                       most_cell(
                           beds, [](const BedJoint& bed) { return 1e-3 * bed.normal; }, "{:.1f}"),
                       most_cell(beds, over_depth, "{:+.3f}"),
                       most_cell(
                           beds, [](const BedJoint& bed) { return bed.utilisation; }, "{:.3f}"),
                       most_cell(
                           beds, [](const BedJoint& bed) { return 1e-6 * bed.largest_compression; }, "{:.3f}")},
                      "td");
  return text + "</table>\n";
}

}  // namespace

std::string stress_section(const std::string& directory) {
  const std::string path = directory + "/joints.csv";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return "";
  const std::vector<BedJoint> beds = bed_joints_from_table({path, "joints.csv", read_text(path)});
  const Rings rings = rings_of(beds);
  std::string text = heading("Thrust in the vaults") + most_table(rings);
  const bool with_axes = !beds.front().d.isZero(0.0);
  if (with_axes) text += figure(thrust_chart({{"line of thrust", beds}}));
  text += figure(line_chart(
      along_rings(rings, "Normal force", "Normal force, kN", [](const BedJoint& bed) { return 1e-3 * bed.normal; })));
  text += figure(line_chart(eccentricity_chart(rings)));
  text +=
      figure(line_chart(along_rings(rings, "Utilisation: shear divided by the shear that friction and cohesion allow",
                                    "Utilisation", [](const BedJoint& bed) { return bed.utilisation; })));
  return text +
         note(
             "The values are those of the bed joints over the whole width of the vault at the end of the run. "
             "joints.csv has these values, and stresses.csv has those of each joint patch. e is the distance of the "
             "thrust from the middle of the joint, positive towards the extrados, and d is the depth of the ring. The "
             "lines between the dots are straight.") +
         (with_axes ? "" : note("The lines of thrust are missing, because an earlier version wrote joints.csv."));
}

}  // namespace voussoir
