// voussoir motion synthesize.
#include <fmt/format.h>

#include <cmath>

#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "solver/base/parallel.h"
#include "solver/motion/synthesis.h"
#include "tools/voussoir/motion.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {

double target_at(const TargetSpectrum& target, int axis, double period) {
  return axis == 2 ? vertical_spectral_acceleration(target, period) : spectral_acceleration(target, period);
}

/// Periods at which the fit is judged. They differ from those of the fit and end at a quarter of the duration.
std::vector<double> judged_periods(const SyntheticSettings& settings) {
  std::vector<double> periods;
  for (double period = 0.05; period < std::min(3.0, settings.duration / 4.0); period *= 1.05) periods.push_back(period);
  return periods;
}

LineChart fit_chart(const SyntheticSettings& settings, const GroundMotion& motion) {
  LineChart chart;
  chart.title = fmt::format("Response spectra, seed {}", settings.seed);
  chart.x_label = "Period, s";
  chart.y_label = fmt::format("Pseudo-acceleration ({:g} % damping), g", 100.0 * settings.spectrum->damping);
  chart.log_x = true, chart.y_low = 0.0;
  const std::vector<double> periods = chart_periods();
  const auto spectra = spectra_of(motion, periods, settings.spectrum->damping);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = std::size_t(axis);
    if (spectra[i].empty()) continue;
    ChartCurve curve{axis_word[i], periods, spectra[i], axis_colour[i], 1.5, ""};
    for (double& v : curve.y) v /= standard_gravity;
    chart.curves.push_back(curve);
  }
  for (const int axis : {0, 2}) {
    if (axis == 2 && spectra[2].empty()) continue;
    ChartCurve curve{
        axis == 2 ? "target, vertical" : "target, horizontal", periods, {}, "#1f1f24", 2.2, axis == 2 ? "3 3" : "8 4"};
    for (const double period : periods) curve.y.push_back(target_at(*settings.spectrum, axis, period));
    chart.curves.push_back(curve);
  }
  return chart;
}

/// The smallest and the largest ratio of the response spectrum to the target.
std::pair<double, double> fit_of(const SyntheticSettings& settings, const GroundMotion& motion, int axis) {
  const std::vector<double> periods = judged_periods(settings);
  const std::vector<double> response =
      response_spectrum(component(motion, axis), motion.dt, periods, settings.spectrum->damping);
  double least = INFINITY, most = 0.0;
  for (std::size_t k = 0; k < periods.size(); ++k) {
    const double ratio = response[k] / (standard_gravity * target_at(*settings.spectrum, axis, periods[k]));
    least = std::min(least, ratio), most = std::max(most, ratio);
  }
  return {least, most};
}

}  // namespace

int motion_synthesize(const std::vector<std::string>& arguments) {
  CommandLine line("motion synthesize", "motion synthesize --target CODE … [-o OUT]",
                   "voussoir motion synthesize --target ntc2018 --ag 0.2607 --f0 2.36 --tc 0.35 --soil D --count 7 "
                   "--seed 1 -o synthetic");
  add_target_options(line);
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"),
                               "folder to write to (default: synthetic)")(
      "count,n", options::value<int>()->default_value(1), "number of records, each of three components")(
      "seed", options::value<int>()->default_value(1),
      "seed of the first record; each further record has the next number")(
      "duration", options::value<double>()->default_value(25.0), "length of each record, s")(
      "step", options::value<double>()->default_value(0.005, "0.005"), "time step of the records, s");
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::optional<TargetSpectrum> target = target_asked(values);
  if (!target) throw InputError("--target is missing. Give ntc2018, en1998-1 or en1998-2");
  const int count = values["count"].as<int>(), seed = values["seed"].as<int>();
  if (count < 1 || count > 1000 || seed < 0)
    throw InputError("--count is {} and --seed is {}. The count must be from 1 to 1000, and the seed 0 or more", count,
                     seed);
  const bool quiet = values.count("quiet") > 0;
  std::vector<SyntheticSettings> settings(static_cast<std::size_t>(count));
  std::vector<GroundMotion> motions(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    settings[i].spectrum = target;
    settings[i].axes = {true, true, true};
    settings[i].seed = std::uint64_t(seed) + i;
    settings[i].duration = values["duration"].as<double>(), settings[i].dt = values["step"].as<double>();
  }
  motions[0] = synthesize(settings[0]);  // before the threads start, so that wrong options are reported here
  for_each(settings.size() - 1, threads_asked(values), 1,
           [&](std::size_t i) { motions[i + 1] = synthesize(settings[i + 1]); });

  const std::string out = values.count("output") ? values["output"].as<std::string>() : "synthetic";
  make_folder_of(out + "/synthetic.json");
  nlohmann::json json = {{"format", "voussoir-selection"},
                         {"format_version", 1},
                         {"synthetic", true},
                         {"target", target_json(*target)},
                         {"records", nlohmann::json::array()}};
  std::string body = paragraph("These are artificial motions that have the spectrum of " + target_text(*target) +
                               ". They were not recorded in an earthquake.");
  if (!quiet) fmt::print("{}", measures_heading());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::string name = fmt::format("synthetic_{:04}", settings[i].seed);
    const auto files = write_motion_files(out, name, motions[i],
                                          fmt::format("synthetic, not recorded: {}, seed {}, {:g} s",
                                                      target_text(*target), settings[i].seed, settings[i].duration));
    nlohmann::json record = {{"name", name}, {"event", name}, {"factor", 1.0}, {"units", "m/s2"}, {"dt", 0.0}};
    record["synthetic"] = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record["files"].push_back(files[axis].substr(out.size() + 1));
      const auto [least, most] = fit_of(settings[i], motions[i], int(axis));
      record["response_over_target"][axis_word[axis]] = {least, most};
      if (!quiet && axis == 0) fmt::print("{}", measures_row(name, intensities_of(motions[i])));
      if (!quiet) fmt::print("{:<24} {:>4} response over target {:.3f} to {:.3f}\n", "", axis_word[axis], least, most);
    }
    json["records"].push_back(record);
    body += figure(line_chart(fit_chart(settings[i], motions[i]))) + histories_figure(name, motions[i]);
  }
  write_json(out + "/synthetic.json", json);
  write_atomically(out + "/synthetic.html", html_page("Synthetic ground motions", body));
  if (!quiet) fmt::print("\n{}/synthetic.json, synthetic.html\n", out);
  return 0;
}

}  // namespace voussoir
