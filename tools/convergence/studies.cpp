#include "tools/convergence/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/convergence/specimens.h"

namespace voussoir {

namespace {

const std::vector<int> point_counts = {3, 4, 5};
const std::vector<double> stiffnesses = {1e9, 1e10, 1e11, 1e12};           // Pa/m
const std::vector<double> step_shares = {0.8, 0.4, 0.2, 0.1, 0.05};        // of the critical step
constexpr double reference_share = 0.00625;                                // of the critical step
const std::vector<double> durations = {0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10};  // s

/// 1/kn, m/Pa: the errors of near rigid blocks are proportional to it.
std::vector<double> compliances() {
  std::vector<double> values;
  for (double kn : stiffnesses) values.push_back(1.0 / kn);
  return values;
}

std::string power_of_ten(double value) {
  return fmt::format("1e{}", std::lround(std::log10(value)));
}

ChartCurve falling(const std::string& name, const std::vector<double>& x, const std::vector<double>& errors) {
  ChartCurve series = {.name = name, .x = x};
  for (double e : errors) series.y.push_back(100.0 * std::abs(e));
  return series;
}

/// Order from the row before; empty in the first row.
std::string order_here(const std::vector<double>& x, const std::vector<double>& errors, std::size_t i) {
  return i == 0 ? "" : order_text(measured_order(errors[i], errors[i - 1], x[i], x[i - 1]));
}

/// The size of all charts of studies.
StudyChart study_chart(const std::string& name, const std::string& title, const std::string& x_label,
                       const std::string& y_label) {
  return {name, {.title = title, .x_label = x_label, .y_label = y_label, .width = 900.0, .height = 540.0}};
}

/// The same for decreasing errors.
StudyChart log_log(const std::string& name, const std::string& title, const std::string& x_label,
                   const std::string& y_label) {
  StudyChart chart = study_chart(name, title, x_label, y_label);
  chart.chart.log_x = chart.chart.log_y = true;
  return chart;
}

// --- Points per side ---

/// Largest absolute value of a series up to `end`.
double largest(const ChartCurve& series, double end) {
  double most = 0.0;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (series.x[i] <= end + 1e-9) most = std::max(most, std::abs(series.y[i]));
  return most;
}

/// Outside the kern, e/b = 1/6; in small increments, because the error oscillates.
StudyChart bed_chart() {
  StudyChart chart = study_chart("points", "Partly open square joint: rotation against the closed form",
                                 "eccentricity / side", "error of the rotation, %");
  for (int points : point_counts) {
    ChartCurve series = {.name = fmt::format("{} points per side", points)};
    for (int i = 20; i <= 90; ++i) {
      const double e = 0.005 * i;
      series.x.push_back(e);
      series.y.push_back(100.0 * (computed_bed(e, points).turn / exact_bed(e).turn - 1.0));
    }
    chart.chart.curves.push_back(series);
  }
  return chart;
}

void add_bed(Study& study) {
  Table table = {
      "Rigid block on a square bed without tension: rotation, and displacement of the bed's middle (its error over the "
      "edge's displacement).",
      {"e/b", "closed share", "rotation, 3 points", "4 points", "5 points", "displacement, 3 points", "4 points",
       "5 points"},
      {}};
  for (double e : {0.10, 1.0 / 6.0, 0.20, 0.25, 0.30, 0.35, 0.40, 0.45}) {
    const Bed exact = exact_bed(e);
    const double edge = exact.sinking + 0.5 * bed_side * exact.turn;
    std::vector<std::string> turns, sinkings;
    for (int points : point_counts) {
      const Bed bed = computed_bed(e, points);
      turns.push_back(percent(bed.turn / exact.turn - 1.0));
      sinkings.push_back(percent((bed.sinking - exact.sinking) / edge));
    }
    table.rows.push_back({fmt::format("{:.4g}", e), fmt::format("{:.3f}", std::min(1.0, 3.0 * (0.5 - e)))});
    for (const auto& cells : {turns, sinkings})
      table.rows.back().insert(table.rows.back().end(), cells.begin(), cells.end());
  }
  study.tables.push_back(table);
  const StudyChart chart = bed_chart();
  Table summary = {
      "Largest error of the rotation, in steps of 0.005.", {"points per side", "e/b up to 0.30", "up to 0.45"}, {}};
  for (std::size_t i = 0; i < point_counts.size(); ++i)
    summary.rows.push_back({std::to_string(point_counts[i]),
                            fmt::format("{:.1f} %", largest(chart.chart.curves[i], 0.3)),
                            fmt::format("{:.1f} %", largest(chart.chart.curves[i], 0.45))});
  study.tables.push_back(summary);
  study.charts.push_back(chart);
}

void add_torsion(Study& study) {
  Table table = {
      "Moment at which a square joint under uniform pressure slides about its normal, divided by the exact moment.",
      {"points per side", "computed / exact", "error"},
      {}};
  for (int points : point_counts) {
    const double share = torsion_capacity(points);
    table.rows.push_back({std::to_string(points), fmt::format("{:.4f}", share), percent(share - 1.0)});
  }
  study.tables.push_back(table);
}

void add_arch(Study& study) {
  Table table = {fmt::format("Oppenheim's arch, multiplier; rigid voussoirs: {}.", oppenheim_rigid), {"kn, Pa/m"}, {}};
  for (int points : point_counts) table.columns.push_back(fmt::format("{} points", points));
  for (int points : point_counts) table.columns.push_back(fmt::format("error, {} points", points));
  for (double kn : stiffnesses) {
    std::vector<std::string> row = {power_of_ten(kn)}, errors;
    for (int points : point_counts) {
      const double got = arch_multiplier(kn, points);
      row.push_back(fmt::format("{:.5f}", got));
      errors.push_back(percent(got / oppenheim_rigid - 1.0));
    }
    row.insert(row.end(), errors.begin(), errors.end());
    table.rows.push_back(row);
  }
  study.tables.push_back(table);
}

// --- Joint stiffness ---

void add_slab(Study& study, StudyChart& chart) {
  Table table = {
      "A block of 1 × 4 m under increasing horizontal acceleration; rigid: B/H = 0.25. In brackets: the loss according "
      "to the closed form of the point joint.",
      {"kn, Pa/m"},
      {}};
  for (int points : point_counts) {
    table.columns.push_back(fmt::format("error, {} points", points));
    table.columns.push_back("order");
  }
  table.columns.push_back("a face elastic everywhere");
  table.columns.push_back("order");
  const double rigid = slab_width / slab_height;
  std::vector<std::vector<double>> errors(point_counts.size());
  std::vector<double> elastic;
  for (std::size_t k = 0; k < stiffnesses.size(); ++k) {
    const double kn = stiffnesses[k];
    std::vector<std::string> row = {power_of_ten(kn)};
    for (std::size_t i = 0; i < point_counts.size(); ++i) {
      errors[i].push_back(slab_multiplier(kn, point_counts[i]) / rigid - 1.0);
      row.push_back(percent(errors[i].back()) + " (" + percent(-slab_loss(kn, point_counts[i]) / rigid) + ")");
      row.push_back(order_here(compliances(), errors[i], k));
    }
    elastic.push_back(-slab_loss_of_an_elastic_face(kn) / rigid);
    row.push_back(percent(elastic.back()));
    row.push_back(order_here(compliances(), elastic, k));
    table.rows.push_back(row);
  }
  study.tables.push_back(table);
  for (std::size_t i = 0; i < point_counts.size(); ++i)
    chart.chart.curves.push_back(falling(fmt::format("slab, {} points", point_counts[i]), stiffnesses, errors[i]));
  chart.chart.curves.push_back(falling("slab, elastic face (theory)", stiffnesses, elastic));
}

void add_rigid_arch(Study& study, StudyChart& chart) {
  Table table = {fmt::format("Oppenheim's arch, 3 points per side; rigid: {}.", oppenheim_rigid),
                 {"kn, Pa/m", "multiplier", "error", "order"},
                 {}};
  std::vector<double> errors;
  for (std::size_t k = 0; k < stiffnesses.size(); ++k) {
    const double got = arch_multiplier(stiffnesses[k], 3);
    errors.push_back(got / oppenheim_rigid - 1.0);
    table.rows.push_back({power_of_ten(stiffnesses[k]), fmt::format("{:.5f}", got), percent(errors.back()),
                          order_here(compliances(), errors, k)});
  }
  study.tables.push_back(table);
  chart.chart.curves.push_back(falling("Oppenheim's arch, 3 points", stiffnesses, errors));
}

void add_rocking(Study& study, StudyChart& chart) {
  const double exact = exact_rocking_quarter();
  Table table = {fmt::format("Quarter of the rocking cycle from α/2; rigid: {:.5f} s. With the default settings of the "
                             "program, and with re-clipping off (reclip_angle = 0.5 rad).",
                             exact),
                 {"kn, Pa/m", "quarter cycle, s", "error", "order", "without re-clipping, s", "error", "order"},
                 {}};
  std::vector<double> with, without;
  for (std::size_t k = 0; k < stiffnesses.size(); ++k) {
    const double t1 = rocking_quarter(stiffnesses[k], true), t2 = rocking_quarter(stiffnesses[k], false);
    with.push_back(t1 / exact - 1.0);
    without.push_back(t2 / exact - 1.0);
    table.rows.push_back({power_of_ten(stiffnesses[k]), fmt::format("{:.6f}", t1), percent(with[k]),
                          order_here(compliances(), with, k), fmt::format("{:.6f}", t2), percent(without[k]),
                          order_here(compliances(), without, k)});
  }
  study.tables.push_back(table);
  chart.chart.curves.push_back(falling("rocking, quarter cycle", stiffnesses, with));
}

// --- Time step ---

void add_let_go(Study& study, StudyChart& chart) {
  Table table = {
      "One bonded block, released: its frequency against √(kn A/m) and against the frequency of the leapfrog scheme, 2 "
      "asin(½ω Δt)/Δt; its displacement after 1¼ cycles, divided by the initial one, against the exact motion.",
      {"Δt / critical", "ω Δt", "frequency", "leapfrog", "order", "displacement", "order"},
      {}};
  std::vector<double> dt, frequency, displacement;
  for (double share : step_shares) {
    const LetGo one = let_go(share);
    dt.push_back(one.dt);
    frequency.push_back(one.frequency / one.exact - 1.0);
    displacement.push_back(one.displacement - one.expected);
    const double x = one.exact * one.dt;
    const std::size_t i = dt.size() - 1;
    table.rows.push_back({fmt::format("{:.3g}", share), fmt::format("{:.4f}", x), percent(frequency[i]),
                          percent(2.0 * std::asin(0.5 * x) / x - 1.0), order_here(dt, frequency, i),
                          percent(displacement[i]), order_here(dt, displacement, i)});
  }
  study.tables.push_back(table);
  chart.chart.curves.push_back(falling("frequency of one block", step_shares, frequency));
  chart.chart.curves.push_back(falling("released block, displacement", step_shares, displacement));
}

void add_responses(Study& study, StudyChart& chart) {
  Table table = {
      fmt::format("Displacement of the top under a smooth pulse of the base: largest difference from a run with {} of "
                  "the critical time step, divided by the largest displacement.",
                  reference_share),
      {"Δt / critical", "bonded column of 10", "order", "rocking block", "order", "its energy balance", "order"},
      {}};
  const PulseResponse column = column_response(reference_share), rocking = rocking_response(reference_share);
  std::vector<double> column_errors, rocking_errors, balance;
  for (std::size_t i = 0; i < step_shares.size(); ++i) {
    const PulseResponse one = rocking_response(step_shares[i]);
    column_errors.push_back(difference(column_response(step_shares[i]), column));
    rocking_errors.push_back(difference(one, rocking));
    balance.push_back(one.worst_balance);
    table.rows.push_back({fmt::format("{:.3g}", step_shares[i]), percent(column_errors[i]),
                          order_here(step_shares, column_errors, i), percent(rocking_errors[i]),
                          order_here(step_shares, rocking_errors, i), percent(balance[i]),
                          order_here(step_shares, balance, i)});
  }
  study.tables.push_back(table);
  chart.chart.curves.push_back(falling("bonded column", step_shares, column_errors));
  chart.chart.curves.push_back(falling("rocking block", step_shares, rocking_errors));
}

void add_wall(Study& study, StudyChart& chart) {
  Table table = {fmt::format("Dry wall of 4 × 4 blocks that slides and opens under such a pulse: displacement of the "
                             "top course, compared with a run with {} of the critical time step. Last row: a pulse "
                             "stronger by one millionth, compared with the row above.",
                             reference_share),
                 {"Δt / critical", "largest displacement, mm", "difference", "largest difference at any time",
                  "energy balance", "order"},
                 {}};
  const auto add = [&](const std::string& name, const PulseResponse& one, const PulseResponse& other,
                       const std::string& order) {
    table.rows.push_back({name, fmt::format("{:.3f}", 1e3 * peak(one)), percent(peak(one) / peak(other) - 1.0),
                          percent(difference(one, other)), percent(one.worst_balance), order});
  };
  const PulseResponse reference = wall_response(reference_share);
  std::vector<double> errors, balance;
  PulseResponse last;
  for (std::size_t i = 0; i < step_shares.size(); ++i) {
    last = wall_response(step_shares[i]);
    errors.push_back(difference(last, reference));
    balance.push_back(last.worst_balance);
    add(fmt::format("{:.3g}", step_shares[i]), last, reference, order_here(step_shares, balance, i));
  }
  add(fmt::format("{:.3g}, pulse × (1 + 1e-6)", step_shares.back()), wall_response(step_shares.back(), 1.0 + 1e-6),
      last, "");
  study.tables.push_back(table);
  chart.chart.curves.push_back(falling("dry wall, displacement", step_shares, errors));
  chart.chart.curves.push_back(falling("dry wall, energy balance", step_shares, balance));
}

}  // namespace

Study study_of_points() {
  Study study;
  study.title = "Points per side";
  add_bed(study);
  add_torsion(study);
  add_arch(study);
  return study;
}

Study study_of_stiffness() {
  Study study;
  study.title = "Joint stiffness";
  StudyChart chart = log_log("stiffness", "Near rigid blocks: errors against the joint stiffness", "kn, Pa/m",
                             "error against rigid blocks, %");
  add_slab(study, chart);
  add_rigid_arch(study, chart);
  add_rocking(study, chart);
  study.charts.push_back(chart);
  return study;
}

Study study_of_steps() {
  Study study;
  study.title = "Time step";
  StudyChart chart = log_log("step", "Errors against the time step", "time step / critical time step", "error, %");
  add_let_go(study, chart);
  add_responses(study, chart);
  add_wall(study, chart);
  chart.chart.curves.push_back({.name = "slope of order 2", .x = {0.05, 1.0}, .y = {0.0015, 0.6}});
  study.charts.push_back(chart);
  return study;
}

Study study_of_rates() {
  Study study;
  study.title = "Load rate";
  Table table = {
      "Dry wall, beam driven by 10 mm within the time T: largest reaction, its difference from the slowest damped run, "
      "and the reaction at the end.",
      {"T, s", "damped (local 0.7), kN", "difference", "at the end, kN", "undamped, kN", "difference",
       "at the end, kN"},
      {}};
  std::vector<Push> damped, free;
  for (double t : durations) damped.push_back(push_wall(t, 0.7)), free.push_back(push_wall(t, 0.0));
  StudyChart chart =
      study_chart("rate", "Dry wall under 100 kN, pushed 10 mm", "duration of the stroke, s", "largest reaction, kN");
  chart.chart.log_x = true;
  chart.chart.curves = {{.name = "local damping 0.7", .x = durations}, {.name = "undamped", .x = durations}};
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const double slowest = damped.back().peak;
    table.rows.push_back({fmt::format("{:.3g}", durations[i]), fmt::format("{:.3f}", 1e-3 * damped[i].peak),
                          percent(damped[i].peak / slowest - 1.0), fmt::format("{:.3f}", 1e-3 * damped[i].end),
                          fmt::format("{:.3f}", 1e-3 * free[i].peak), percent(free[i].peak / slowest - 1.0),
                          fmt::format("{:.3f}", 1e-3 * free[i].end)});
    chart.chart.curves[0].y.push_back(1e-3 * damped[i].peak);
    chart.chart.curves[1].y.push_back(1e-3 * free[i].peak);
  }
  study.tables.push_back(table);
  study.charts.push_back(chart);
  return study;
}

const std::vector<NamedStudy>& convergence_studies() {
  static const std::vector<NamedStudy> list = {
      {"points", "points per joint side: partly open joint, torsion, an arch", study_of_points},
      {"stiffness", "joint stiffness: multipliers and rocking against rigid blocks", study_of_stiffness},
      {"step", "time step: frequency, responses, energy balance", study_of_steps},
      {"rate", "load rate: the speed at which a wall may be pushed", study_of_rates},
      {"dispersal", "dispersal of a wheel load by a fill, compared with the rules of codes (docs/theory/fill.md)",
       study_of_dispersal}};
  return list;
}

}  // namespace voussoir
