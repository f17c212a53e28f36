// The section of a run's page on ground motions.
#include <fmt/format.h>

#include <cmath>

#include "solver/base/constants.h"
#include "solver/motion/intensity.h"
#include "tools/run/page_sections.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"
#include "viz/page/palette.h"

namespace voussoir {

namespace {

std::vector<double> along(const GroundMotion& motion, int axis) {
  std::vector<double> a;
  for (const Vec3& x : motion.acceleration) a.push_back(x[axis]);
  return a;
}

bool moves(const std::vector<double>& a) {
  return std::ranges::any_of(a, [](double x) { return x != 0.0; });
}

std::string scaling_text(const MotionSource& source) {
  std::string text = source.scale == 1.0 ? "as recorded" : fmt::format("times {:g}", source.scale);
  if (source.kind != MotionSource::Kind::record && source.scale == 1.0) text = "as synthesized";
  if (source.pga > 0.0)
    text = fmt::format("to a PGA of {:.3g} m/s²{}", source.pga,
                       source.scale == 1.0 ? "" : fmt::format(", then times {:g}", source.scale));
  if (source.begin > 0.0) text += fmt::format(", from {:g} s", source.begin);
  return text + (source.correct ? ", baseline corrected" : "");
}

std::string motion_rows(const StageSettings& stage, const MotionSource& source) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> a = along(stage.motion, axis);
    if (!moves(a)) continue;
    const Intensity of = intensity_of(a, stage.motion.dt);
    text +=
        table_row({words_cell(text.empty() ? stage.label : ""), words_cell(text.empty() ? scaling_text(source) : ""),
                   words_cell(std::string(1, "xyz"[axis])), formatted_cell(of.pga, "{:.3f}"),
                   formatted_cell(of.pga / standard_gravity, "{:.3f}"), formatted_cell(of.pgv, "{:.3f}"),
                   formatted_cell(of.arias, "{:.3f}"), formatted_cell(of.significant(), "{:.2f}")},
                  "td");
  }
  return text;
}

/// 5 % response spectra.
std::string spectra(const StageSettings& stage) {
  LineChart chart;
  chart.title = "Response spectra of the ground, 5 % damping: " + stage.label;
  chart.x_label = "Period, s", chart.y_label = "Pseudo-acceleration, g";
  chart.width = 760.0, chart.height = 300.0, chart.log_x = true, chart.y_low = 0.0;
  std::vector<double> periods;
  for (int k = 0; k <= 80; ++k) periods.push_back(std::max(0.05, 4.0 * stage.motion.dt) * std::pow(60.0, k / 80.0));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> a = along(stage.motion, axis);
    if (!moves(a)) continue;
    ChartCurve curve{.name = std::string(1, "xyz"[axis]),
                     .x = periods,
                     .y = response_spectrum(a, stage.motion.dt, periods),
                     .colour = colour_code(line_colour(std::size_t(axis)))};
    for (double& v : curve.y) v /= standard_gravity;
    chart.curves.push_back(curve);
  }
  return figure(line_chart(chart));
}

}  // namespace

std::string motion_section(const RunFiles& run) {
  std::string rows, charts;
  for (std::size_t i = 0; i < run.stages().size(); ++i) {
    const StageSettings& stage = run.stages()[i];
    if (stage.kind != StageSettings::Kind::motion || stage.motion.acceleration.size() < 20) continue;
    rows += motion_rows(stage, run.c.motions[i]);
    charts += spectra(stage);
  }
  if (rows.empty()) return "";
  return heading("Ground motion") + "<table>\n" +
         table_row({words_cell("stage"),
                    words_cell("scaled"),
                    words_cell("axis"),
                    {"PGA, m/s²", true},
                    {"PGA, g", true},
                    {"PGV, m/s", true},
                    {"Arias intensity, m/s", true},
                    {"D5–95, s", true}},
                   "th") +
         rows + "</table>\n" +
         note("PGA, PGV: peak ground acceleration and velocity. D5–95: time from 5 to 95 % of the Arias intensity.") +
         charts;
}

}  // namespace voussoir
