// voussoir motion select.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>

#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "solver/base/parallel.h"
#include "solver/motion/select.h"
#include "tools/voussoir/motion.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {
constexpr double period_step = 0.01;  // s, distance of the periods that are compared

struct SelectRequest {
  std::string folder, out;
  TargetSpectrum target;
  SelectionProblem problem;
  std::array<double, 2> range = {};  // s
  ColumnsMeaning columns;
  int threads = 1;
  bool quiet = false;
};

std::array<double, 2> pair_of(const options::variables_map& values, const char* key) {
  const auto list = values[key].as<std::vector<double>>();
  if (list.size() != 2)
    throw InputError("--{} has {}. Give two, the least and the largest", key, counted(list.size(), "number"));
  for (const double value : list)
    if (!std::isfinite(value)) throw InputError("--{} has {}. Give finite numbers", key, value);
  return {list[0], list[1]};
}

/// Pseudo-accelerations of the arithmetic mean of the two horizontal components (m/s2): one column a record.
Eigen::MatrixXd horizontal_spectra(const std::vector<RecordSet>& sets, const std::vector<double>& periods,
                                   double damping, int threads) {
  Eigen::MatrixXd spectra(Eigen::Index(periods.size()), Eigen::Index(sets.size()));
  for_each(sets.size(), threads, 1, [&](std::size_t r) {
    const GroundMotion& motion = sets[r].motion;
    const std::vector<double> x = response_spectrum(component(motion, 0), motion.dt, periods, damping),
                              y = response_spectrum(component(motion, 1), motion.dt, periods, damping);
    for (std::size_t k = 0; k < periods.size(); ++k) spectra(Eigen::Index(k), Eigen::Index(r)) = 0.5 * (x[k] + y[k]);
  });
  return spectra;
}

std::vector<double> compared_periods(std::array<double, 2> range) {
  std::vector<double> periods;
  const auto n = std::size_t(std::ceil((range[1] - range[0]) / period_step - 1e-9));
  for (std::size_t k = 0; k <= n; ++k) periods.push_back(range[0] + (range[1] - range[0]) * double(k) / double(n));
  return periods;
}

/// A selection with the data that its page and its files need.
struct Selected {
  const SelectRequest& request;
  const std::vector<RecordSet>& sets;
  const Selection& selection;
  std::vector<double> periods;  // compared
  std::vector<std::string> names;
  std::vector<std::array<Intensity, 3>> measures;  // at factor 1
};

nlohmann::json selection_json(const Selected& s) {
  const SelectionProblem& p = s.request.problem;
  nlohmann::json json = {{"format", "voussoir-selection"},
                         {"format_version", 1},
                         {"found", s.selection.found},
                         {"target", target_json(s.request.target)},
                         {"range", s.request.range},
                         {"bounds", {p.low, p.high}},
                         {"factor_bounds", {p.least, p.most}},
                         {"per_event", p.per_event},
                         {"score", s.selection.score},
                         {"sets_tried", s.selection.tried},
                         {"all_tried", s.selection.all_tried},
                         {"mean_of", "arithmetic mean of the two horizontal components, then of the records"},
                         {"periods", s.periods},
                         {"target_sa", target_values(s.request.target, s.periods)},
                         {"ratio", s.selection.mean},
                         {"records", nlohmann::json::array()}};
  for (std::size_t i = 0; i < s.selection.records.size(); ++i) {
    nlohmann::json record = record_json(s.sets[s.selection.records[i]], s.request.out);
    record["factor"] = s.selection.factors[i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (s.measures[i][axis].pga > 0.0)
        record["measures_unscaled"][axis_word[axis]] = intensity_json(s.measures[i][axis]);
    json["records"].push_back(record);
  }
  return json;
}

/// Spectra of the chosen records at their factors, their mean, the target and its band.
std::string spectra_figure(const Selected& s) {
  const std::vector<double> periods = chart_periods();
  std::vector<RecordSet> chosen;
  for (const std::size_t r : s.selection.records) chosen.push_back(s.sets[r]);
  const Eigen::MatrixXd spectra =
      horizontal_spectra(chosen, periods, s.request.target.damping, s.request.threads) / standard_gravity;
  LineChart chart;
  chart.title = "Spectra of the selection: mean of the two horizontal components at the record's factor";
  chart.x_label = "Period, s";
  chart.y_label = fmt::format("Pseudo-acceleration ({:g} % damping), g", 100.0 * s.request.target.damping);
  chart.height = 470.0, chart.log_x = true, chart.y_low = 0.0;
  std::vector<double> target = target_values(s.request.target, periods), mean(periods.size(), 0.0);
  for (double& v : target) v /= standard_gravity;
  ChartBand band{fmt::format("{:g} to {:g} of the target, {:g} to {:g} s", s.request.problem.low,
                             s.request.problem.high, s.request.range[0], s.request.range[1]),
                 {},
                 {},
                 {},
                 "#dfe3ea"};
  for (const double period : s.periods) {
    const double value = spectral_acceleration(s.request.target, period);
    band.x.push_back(period);
    band.low.push_back(s.request.problem.low * value), band.high.push_back(s.request.problem.high * value);
  }
  chart.bands.push_back(band);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double f = s.selection.factors[i];
    ChartCurve curve{fmt::format("{} × {:.2f}", s.names[i], f), periods, {}, colour_code(line_colour(i)), 1.2, ""};
    if (i >= kLineColours) curve.dashes = "3 3";
    for (std::size_t k = 0; k < periods.size(); ++k) {
      curve.y.push_back(f * spectra(Eigen::Index(k), Eigen::Index(i)));
      mean[k] += curve.y.back() / double(chosen.size());
    }
    chart.curves.push_back(curve);
  }
  chart.curves.push_back({"target", periods, target, "#1f1f24", 2.4, "8 4"});
  chart.curves.push_back({"mean", periods, mean, "#1f1f24", 3.0, ""});
  return line_chart(chart);
}

std::string ratio_figure(const Selected& s) {
  LineChart chart;
  chart.title = "Ratio of the mean to the target";
  chart.x_label = "Period, s", chart.y_label = "Ratio";
  chart.height = 240.0;
  const std::vector<double> low(s.periods.size(), s.request.problem.low),
      high(s.periods.size(), s.request.problem.high);
  chart.bands.push_back({"bounds", s.periods, low, high, "#dfe3ea"});
  chart.curves.push_back({"mean / target", s.periods, s.selection.mean, "#1f1f24", 2.2, ""});
  chart.curves.push_back({"", {s.periods.front(), s.periods.back()}, {1.0, 1.0}, "#8a8a92", 1.0, "4 4"});
  return figure(line_chart(chart));
}

/// PGA, PGV and D5–95 of the records at their factors, the larger horizontal one full, the others hollow.
std::string measures_figure(const Selected& s) {
  std::string text;
  struct Measure {
    const char* title;
    double (*of)(const Intensity&);
    bool scales;
  };
  const Measure measures[] = {{"PGA, g", [](const Intensity& i) { return i.pga / standard_gravity; }, true},
                              {"PGV, m/s", [](const Intensity& i) { return i.pgv; }, true},
                              {"D5–95, s", [](const Intensity& i) { return i.significant(); }, false}};
  const Marker markers[] = {Marker::circle, Marker::square, Marker::triangle};
  for (const Measure& measure : measures) {
    LineChart chart;
    chart.width = 480.0, chart.height = 250.0;
    chart.title = measure.title;
    chart.x_label = "Record, in the order of the table", chart.y_label = measure.title;
    chart.y_low = 0.0;
    chart.x_low = 0.5, chart.x_high = double(s.names.size()) + 0.5;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ChartDots dots{axis_word[axis], {}, {}, {}, axis_colour[axis], markers[axis]};
      for (std::size_t i = 0; i < s.names.size(); ++i) {
        if (s.measures[i][axis].pga == 0.0) continue;
        dots.x.push_back(double(i + 1));
        dots.y.push_back((measure.scales ? s.selection.factors[i] : 1.0) * measure.of(s.measures[i][axis]));
        dots.hints.push_back(fmt::format("{} {}: {:.3g}", s.names[i], axis_word[axis], dots.y.back()));
      }
      if (!dots.x.empty()) chart.dots.push_back(dots);
    }
    text += figure(line_chart(chart));
  }
  return "<div class=\"many\">" + text + "</div>\n";
}

std::string selection_page(const Selected& s, const std::string& spectra) {
  const SelectionProblem& p = s.request.problem;
  const auto [low, high] = std::ranges::minmax(s.selection.mean);
  std::string body = paragraph("Target: " + target_text(s.request.target) + ".");
  body += paragraph(fmt::format(
      "{} of {} selected, at most {} of one event, with factors from {:g} to {:g}. The ratio of their mean to the "
      "target is {:.3f} to {:.3f} at periods from {:g} to {:g} s ({:g} to {:g} is allowed). {} {} tried{}.",
      p.count, counted(s.sets.size(), "record is", "records are"), p.per_event, p.least, p.most, low, high,
      s.request.range[0], s.request.range[1], p.low, p.high, s.selection.tried,
      s.selection.tried == 1.0 ? "set was" : "sets were", s.selection.all_tried ? " (all possible sets)" : ""));
  if (!s.selection.found) body += paragraph("No set keeps all bounds. This is the closest one.");
  body += figure(spectra) + ratio_figure(s) + heading("Measures, multiplied by the factors") + measures_figure(s);
  body += measures_table(s.names, s.measures, s.selection.factors) + heading("Histories, as recorded");
  for (const std::size_t r : s.selection.records) body += histories_figure(s.sets[r].name, s.sets[r].motion);
  return html_page("Selection of ground motions", body);
}

std::string selection_text(const Selected& s, double seconds) {
  const auto [low, high] = std::ranges::minmax(s.selection.mean);
  std::string text = fmt::format("target: {}\n\n{:<24} {:<16} {:>7} {:>18}\n", target_text(s.request.target), "record",
                                 "event", "factor", "PGA x, y, z (g)");
  for (std::size_t i = 0; i < s.names.size(); ++i) {
    const RecordSet& set = s.sets[s.selection.records[i]];
    const double f = s.selection.factors[i] / standard_gravity;
    text +=
        fmt::format("{:<24} {:<16} {:>7.3f} {:>6.3f}{:>6.3f}{:>6.3f}\n", set.name, set.event, s.selection.factors[i],
                    f * s.measures[i][0].pga, f * s.measures[i][1].pga, f * s.measures[i][2].pga);
  }
  return text + fmt::format(
                    "\nratio of the mean to the target {:.3f} to {:.3f} at periods from {:g} to {:g} s; {:.0f} sets "
                    "tried{}, {:.1f} s\n",
                    low, high, s.request.range[0], s.request.range[1], s.selection.tried,
                    s.selection.all_tried ? " (all)" : "", seconds);
}

SelectRequest select_request(const options::variables_map& values) {
  SelectRequest r;
  r.folder = values["DIR"].as<std::string>();
  r.out = values.count("output") ? values["output"].as<std::string>() : "selection";
  const std::optional<TargetSpectrum> target = target_asked(values);
  if (!target) throw InputError("--target is missing. Give ntc2018, en1998-1 or en1998-2");
  r.target = *target;
  const auto whole = [&](const char* key) {
    const int value = values[key].as<int>();
    if (value < 1) throw InputError("--{} is {}. It must be 1 or more", key, value);
    return std::size_t(value);
  };
  SelectionProblem& p = r.problem;
  p.count = whole("count"), p.per_event = whole("per-event"), p.tries = whole("tries");
  p.seed = std::uint64_t(values["seed"].as<int>());
  r.range = pair_of(values, "range");
  if (!(r.range[0] > 0.0 && r.range[0] < r.range[1] && r.range[1] <= 20.0))
    throw InputError("--range is {} {}. It must be two periods in s: 0 < first < second <= 20", r.range[0], r.range[1]);
  std::tie(p.low, p.high) = std::tuple_cat(pair_of(values, "bounds"));
  std::tie(p.least, p.most) = std::tuple_cat(pair_of(values, "factors"));
  r.columns = columns_asked(values);
  r.threads = threads_asked(values);
  r.quiet = values.count("quiet") > 0;
  return r;
}

int select(SelectRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<RecordSet> sets = records_asked({request.folder}, request.columns, request.quiet);
  const std::vector<double> periods = compared_periods(request.range);
  std::map<std::string, int> events;
  for (const RecordSet& set : sets)
    request.problem.events.push_back(events.try_emplace(set.event, int(events.size())).first->second);
  request.problem.ratios = horizontal_spectra(sets, periods, request.target.damping, request.threads);
  const std::vector<double> target = target_values(request.target, periods);
  for (std::size_t k = 0; k < periods.size(); ++k) request.problem.ratios.row(Eigen::Index(k)) /= target[k];
  const std::string remark = short_period_remark(sets, request.range[0]);
  if (!request.quiet && !remark.empty()) fmt::print(stderr, "{}\n", remark);
  if (!request.quiet)
    fmt::print(stderr, "{} of {} in {}\n", counted(sets.size(), "record"), counted(events.size(), "event"),
               request.folder);
  const Selection selection = select_records(request.problem);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  Selected selected{request, sets, selection, periods, {}, {}};
  for (const std::size_t r : selection.records) {
    selected.names.push_back(sets[r].name);
    selected.measures.push_back(intensities_of(sets[r].motion));
  }
  make_folder_of(request.out + "/selection.json");
  write_json(request.out + "/selection.json", selection_json(selected));
  const std::string spectra = spectra_figure(selected);
  write_atomically(request.out + "/selection.html", selection_page(selected, spectra));
  write_atomically(request.out + "/spectra.svg", spectra);
  if (!request.quiet)
    fmt::print("{}\n{}/selection.json, selection.html, spectra.svg\n", selection_text(selected, seconds), request.out);
  if (selection.found) return 0;
  const auto [low, high] = std::ranges::minmax(selection.mean);
  throw RunError(
      "no set of {} keeps its mean spectrum within {:g} to {:g} times the target at periods from {:g} to {:g} s{}. The "
      "closest set is written to {}/selection.json with \"found\": false; its ratio is {:.3f} to {:.3f}. Widen "
      "--bounds or --factors, narrow --range, allow more records of one event with --per-event, or give more records",
      counted(request.problem.count, "record"), request.problem.low, request.problem.high, request.range[0],
      request.range[1], selection.all_tried ? "" : " among those tried", request.out, low, high);
}

}  // namespace

int motion_select(const std::vector<std::string>& arguments) {
  CommandLine line("motion select", "motion select DIR --target CODE … [--range LOW HIGH] [-o OUT]",
                   "voussoir motion select records --count 7 --target ntc2018 --ag 0.2607 --f0 2.360 --tc 0.350 "
                   "--soil D --range 0.15 1.2 --bounds 0.9 1.3 -o selection");
  add_target_options(line);
  add_columns_options(line);
  using Numbers = std::vector<double>;
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"),
                               "folder to write to (default: selection)")(
      "count,n", options::value<int>()->default_value(7), "number of records")(
      "range", options::value<Numbers>()->multitoken()->default_value({0.15, 2.0}, "0.15 2"),
      "range of the periods that are compared, s")(
      "bounds", options::value<Numbers>()->multitoken()->default_value({0.9, 1.3}, "0.9 1.3"),
      "bounds on the ratio of the mean spectrum to the target")(
      "factors", options::value<Numbers>()->multitoken()->default_value({0.3, 3.0}, "0.3 3"),
      "bounds on the factor of each record")("per-event", options::value<int>()->default_value(3),
                                             "largest number of records of one event")(
      "tries", options::value<int>()->default_value(1'000'000), "largest number of sets to try")(
      "seed", options::value<int>()->default_value(1), "seed of the search, used if there are more sets than --tries");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  SelectRequest request = select_request(values);
  return select(request);
}

}  // namespace voussoir
