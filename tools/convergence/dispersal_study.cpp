// The study of load dispersal by a fill: pressures at a rigid base compared with closed forms and rules of codes.
#include <fmt/format.h>

#include "tools/convergence/studies.h"
#include "tools/ladder/dispersal.h"

namespace voussoir {

namespace {

using ladder::BasePressure;
using ladder::Dispersal;

/// One row of the comparison over the depths: computed, or a closed form. A row that coincides with another curve is
/// not drawn.
struct Spread {
  std::string name;
  std::function<BasePressure(Dispersal)> of;
  bool drawn = true;
};

const std::vector<Spread>& spreads() {
  const auto computed = [](bool rough, bool yields, double pressure) {
    return [=](Dispersal d) {
      d.rough = rough, d.yields = yields, d.pressure = pressure;
      return ladder::base_pressure(d);
    };
  };
  static const std::vector<Spread> all = {
      {"half-space (Boussinesq 1885)", [](const Dispersal& d) { return profile(d, ladder::half_space_pressure); }},
      {"elastic layer on a smooth base (Filon 1903)",
       [](const Dispersal& d) { return profile(d, ladder::smooth_base_pressure); }},
      {"computed, elastic, smooth base", computed(false, false, 1e5), false},
      {"computed, elastic, rough base", computed(true, false, 1e5)},
      {"computed, Mohr-Coulomb, rough base, 100 kPa", computed(true, true, 1e5)},
      {"computed, Mohr-Coulomb, rough base, 200 kPa", computed(true, true, 2e5)}};
  return all;
}

struct CodeRule {
  const char* name;
  double slope;
};
const std::vector<CodeRule>& code_rules() {
  static const std::vector<CodeRule> all = {{"2:1 (CS 454)", ladder::cs454_slope},
                                            {"30 degrees (EN 1991-2, fill)", ladder::ec1_fill_slope},
                                            {"4:1 (EN 1991-2, ballast)", ladder::ec1_ballast_slope}};
  return all;
}

void add_patch(bool wheel, Study& study) {
  const char* const patch = wheel ? "Wheel of 0.3 m × 0.3 m" : "Strip 0.3 m wide";
  Table table = {fmt::format("{}: largest pressure at the base divided by that of the patch; width with at least half "
                             "of the largest pressure; and the {} that carries the load at the largest pressure.",
                             patch, wheel ? "side of the square" : "width"),
                 {"depth, m", "fill", "pressure", "half width, m", "equivalent width, m"},
                 {}};
  StudyChart chart = {wheel ? "dispersal_wheel" : "dispersal_strip",
                      {.title = fmt::format("{}: width that carries the load", patch),
                       .x_label = "depth of the fill, m",
                       .y_label = "equivalent width at the base, m",
                       .width = 900.0,
                       .height = 540.0,
                       .y_low = 0.0}};
  for (const CodeRule& rule : code_rules()) {
    ChartCurve line = {.name = rule.name};
    for (const double depth : {0.3, 1.0}) {
      line.x.push_back(depth), line.y.push_back(ladder::spread_width({.depth = depth}, rule.slope));
    }
    chart.chart.curves.push_back(line);
  }
  for (const Spread& spread : spreads()) {
    ChartCurve curve = {.name = spread.name};
    for (std::size_t i = 0; i < std::size(ladder::dispersal_depths); ++i) {
      const Dispersal d{.depth = ladder::dispersal_depths[i], .wheel = wheel, .cells = ladder::dispersal_cells[i]};
      const BasePressure found = spread.of(d);
      const double share = wheel ? 4.0 * ladder::patch_half * ladder::patch_half : 2.0 * ladder::patch_half;
      const double ratio = found.peak() * share / found.load;
      table.rows.push_back({fmt::format("{:.1f}", d.depth), spread.name + (found.at_rest ? "" : " (not at rest)"),
                            fmt::format("{:.3f}", ratio), fmt::format("{:.2f}", found.half_width()),
                            fmt::format("{:.2f}", found.equivalent(wheel))});
      curve.x.push_back(d.depth), curve.y.push_back(found.equivalent(wheel));
    }
    if (spread.drawn) chart.chart.curves.push_back(curve);
  }
  for (const CodeRule& rule : code_rules())
    for (const double depth : ladder::dispersal_depths) {
      const double width = ladder::spread_width({.depth = depth}, rule.slope), b = 2.0 * ladder::patch_half;
      table.rows.push_back({fmt::format("{:.1f}", depth), rule.name,
                            fmt::format("{:.3f}", wheel ? b * b / (width * width) : b / width),
                            fmt::format("{:.2f}", width), fmt::format("{:.2f}", width)});
    }
  study.tables.push_back(table);
  study.charts.push_back(chart);
}

}  // namespace

Study study_of_dispersal() {
  Study study;
  study.title = "Dispersal of a load by the fill";
  add_patch(false, study), add_patch(true, study);
  return study;
}

}  // namespace voussoir
