// voussoir motion info, spectrum, process.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "solver/base/parallel.h"
#include "tools/voussoir/motion.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {

std::vector<std::string> paths_of(const options::variables_map& values) {
  std::vector<std::string> paths = {values["RECORDS"].as<std::string>()};
  if (values.count("more"))
    for (const std::string& path : values["more"].as<std::vector<std::string>>()) paths.push_back(path);
  return paths;
}

void take_paths(CommandLine& line) {
  line.positional = line.required = {"RECORDS"};
  line.rest = "more";
  add_columns_options(line);
}

/// A remark on a time step that the file gives with few digits: some AT2 files give 1/409.6 s as .0024.
std::string step_remark(const RecordSet& set) {
  const double rate = 1.0 / set.motion.dt;
  if (set.format != "PEER AT2" || std::abs(rate - std::round(rate)) < 1e-6 * rate) return "";
  return fmt::format(
      "\n  The file may give a rounded time step, so times may be wrong by up to {:.1f} %. If you know the sampling "
      "rate, give 'dt' in the case",
      100.0 * 0.5e-4 / set.motion.dt);
}

std::string set_text(const RecordSet& set) {
  std::string components;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!set.files[axis].empty() || !set.components[axis].empty())
      components += fmt::format("{}{} = {}", components.empty() ? "" : ", ", axis_word[axis],
                                set.components[axis].empty() ? "?" : set.components[axis]);
  return fmt::format("{}: {}, event {}{}, {:.6g} s at time steps of {:.6g} s, {}{}", set.name, set.format, set.event,
                     set.station.empty() ? "" : ", station " + set.station, set.motion.duration(), set.motion.dt,
                     components, step_remark(set));
}

LineChart spectra_chart(const RecordSet& set, const std::optional<TargetSpectrum>& target,
                        const std::vector<double>& periods, const std::array<std::vector<double>, 3>& spectra,
                        double damping) {
  LineChart chart;
  chart.title = set.name;
  chart.x_label = "Period, s";
  chart.y_label = fmt::format("Pseudo-acceleration ({:g} % damping), g", 100.0 * damping);
  chart.log_x = true;
  chart.y_low = 0.0;
  const auto in_g = [](std::vector<double> values) {
    for (double& v : values) v /= standard_gravity;
    return values;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!spectra[axis].empty())
      chart.curves.push_back({axis_word[axis], periods, in_g(spectra[axis]), axis_colour[axis], 1.8, ""});
  if (target) chart.curves.push_back({"target", periods, in_g(target_values(*target, periods)), "#1f1f24", 2.2, "7 4"});
  return chart;
}

/// CSV of the spectra: the period (s), then x, y, z of each set (m/s2).
std::string spectra_csv(const std::vector<RecordSet>& sets, const std::vector<double>& periods,
                        const std::vector<std::array<std::vector<double>, 3>>& spectra,
                        const std::optional<TargetSpectrum>& target) {
  std::string text = "period_s";
  for (std::size_t r = 0; r < sets.size(); ++r)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!spectra[r][axis].empty()) {
        std::string name = sets[r].name;
        std::ranges::replace(name, ',', ' ');
        text += fmt::format(",{}_{}_m/s2", name, axis_word[axis]);
      }
  text += target ? ",target_m/s2\n" : "\n";
  const std::vector<double> wanted = target ? target_values(*target, periods) : std::vector<double>();
  for (std::size_t k = 0; k < periods.size(); ++k) {
    text += fmt::format("{:.6g}", periods[k]);
    for (const auto& of : spectra)
      for (const std::vector<double>& axis : of)
        if (!axis.empty()) text += fmt::format(",{:.6g}", axis[k]);
    text += target ? fmt::format(",{:.6g}\n", wanted[k]) : "\n";
  }
  return text;
}

}  // namespace

int motion_info(const std::vector<std::string>& arguments) {
  CommandLine line("motion info", "motion info DIR|FILE [FILE FILE] [-o OUT]",
                   "voussoir motion info records -o measures");
  take_paths(line);
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"),
                               "folder for motion.json and motion.html with the histories (default: no files)");
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const bool quiet = values.count("quiet") > 0;
  const std::vector<RecordSet> sets = records_asked(paths_of(values), columns_asked(values), quiet);
  std::vector<std::array<Intensity, 3>> of;
  std::vector<std::string> names;
  std::string text = "\n" + measures_heading();
  for (const RecordSet& set : sets) {
    of.push_back(intensities_of(set.motion));
    names.push_back(set.name);
    text += measures_row(set.name, of.back());
    if (!quiet) fmt::print("{}\n", set_text(set));
  }
  if (!quiet) fmt::print("{}", text);
  if (!values.count("output")) return 0;

  const std::string out = values["output"].as<std::string>();
  make_folder_of(out + "/motion.json");
  nlohmann::json json = {{"records", nlohmann::json::array()}};
  std::string body = measures_table(names, of, std::vector<double>(sets.size(), 1.0)) + heading("Histories");
  for (std::size_t r = 0; r < sets.size(); ++r) {
    nlohmann::json record = record_json(sets[r], out);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (of[r][axis].pga > 0.0) record["measures"][axis_word[axis]] = intensity_json(of[r][axis]);
    json["records"].push_back(record);
    body += histories_figure(sets[r].name, sets[r].motion);
  }
  write_json(out + "/motion.json", json);
  write_atomically(out + "/motion.html", html_page("Ground motions", body));
  if (!quiet) fmt::print("\n{0}/motion.json, {0}/motion.html\n", out);
  return 0;
}

int motion_spectrum(const std::vector<std::string>& arguments) {
  CommandLine line("motion spectrum", "motion spectrum DIR|FILE [FILE FILE] [-o OUT] [--target …]",
                   "voussoir motion spectrum records --target ntc2018 --ag 0.2607 --f0 2.36 --tc 0.35 --soil D -o OUT");
  take_paths(line);
  add_target_options(line);
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"),
                               "folder for spectra.csv and spectra.html (default: spectra)");
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const bool quiet = values.count("quiet") > 0;
  const std::optional<TargetSpectrum> target = target_asked(values);
  const double damping = values["damping"].as<double>();
  if (!(damping > 0.0 && damping < 1.0)) throw InputError("--damping is {}. It must be above 0 and below 1", damping);
  const std::vector<RecordSet> sets = records_asked(paths_of(values), columns_asked(values), quiet);
  const std::vector<double> periods = chart_periods();
  std::vector<std::array<std::vector<double>, 3>> spectra(sets.size());
  for_each(sets.size(), threads_asked(values), 1,
           [&](std::size_t r) { spectra[r] = spectra_of(sets[r].motion, periods, damping); });
  const std::string out = values.count("output") ? values["output"].as<std::string>() : "spectra";
  make_folder_of(out + "/spectra.csv");
  std::string body = target ? paragraph("Target: " + target_text(*target)) : "";
  for (std::size_t r = 0; r < sets.size(); ++r)
    body += figure(line_chart(spectra_chart(sets[r], target, periods, spectra[r], damping)));
  const std::string remark = short_period_remark(sets, periods.front());
  if (!remark.empty()) body = paragraph(remark) + body;
  write_atomically(out + "/spectra.csv", spectra_csv(sets, periods, spectra, target));
  write_atomically(out + "/spectra.html", html_page("Response spectra", body));
  if (!quiet && !remark.empty()) fmt::print(stderr, "{}\n", remark);
  if (!quiet) fmt::print("{}; {}/spectra.csv, {}/spectra.html\n", counted(sets.size(), "record"), out, out);
  return 0;
}

int motion_process(const std::vector<std::string>& arguments) {
  CommandLine line("motion process", "motion process DIR|FILE [FILE FILE] -o OUT [--taper …]",
                   "voussoir motion process a_EW.AT2 a_NS.AT2 a_UP.AT2 --band 0.1 25 --baseline -o OUT");
  take_paths(line);
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"), "folder to write to")(
      "taper", options::value<double>()->default_value(0.0), "taper at each end, as a share of the record")(
      "band", options::value<std::vector<double>>()->multitoken(),
      "two corner frequencies of the band-pass filter, Hz; 0: no limit on that side")(
      "order", options::value<int>()->default_value(4), "order of the band-pass filter")(
      "baseline", "correct the baseline, so that the motion ends at rest")(
      "step", options::value<double>()->default_value(0.0), "time step of the result, s; 0: as recorded");
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (!values.count("output")) throw InputError("-o OUT is missing. Usage: voussoir {}", line.usage);
  MotionProcessing asked;
  asked.taper = values["taper"].as<double>(), asked.order = values["order"].as<int>();
  asked.baseline = values.count("baseline") > 0, asked.dt = values["step"].as<double>();
  if (values.count("band")) {
    const auto band = values["band"].as<std::vector<double>>();
    if (band.size() != 2)
      throw InputError("--band has {}. Give two corner frequencies in Hz", counted(band.size(), "number"));
    asked.low = band[0], asked.high = band[1];
    for (const double corner : band)
      if (!(corner >= 0.0 && corner <= 1e5))
        throw InputError("--band has {} Hz. It must be from 0 (no limit on that side) to 1e5 Hz", corner);
  }
  if (!(asked.taper >= 0.0 && asked.taper <= 0.5))
    throw InputError("--taper is {}. It must be a share from 0 to 0.5", asked.taper);
  if (asked.order < 1 || asked.order > 16) throw InputError("--order is {}. It must be from 1 to 16", asked.order);
  if (asked.dt != 0.0 && !(asked.dt >= 1e-5 && asked.dt <= 1.0))
    throw InputError("--step is {} s. It must be from 1e-5 to 1 s, or 0 to keep the recorded time step", asked.dt);
  const bool quiet = values.count("quiet") > 0;
  const std::string out = values["output"].as<std::string>();
  make_folder_of(out + "/motion.html");
  std::string body;
  for (const RecordSet& set : records_asked(paths_of(values), columns_asked(values), quiet)) {
    const GroundMotion done = process(set.motion, asked);
    std::string name = set.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '.'; }, '_');
    write_motion_files(out, name, done,
                       fmt::format("{}: taper {:g}, band {:g} to {:g} Hz of order {}, baseline {}", set.name,
                                   asked.taper, asked.low, asked.high, asked.order, asked.baseline ? "yes" : "no"));
    if (!quiet) fmt::print("{}", measures_row(set.name, intensities_of(done)));
    body += histories_figure(set.name + ", processed", done) + histories_figure(set.name + ", as recorded", set.motion);
  }
  write_atomically(out + "/motion.html", html_page("Processed ground motions", body));
  return 0;
}

}  // namespace voussoir
