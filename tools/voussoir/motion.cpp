// voussoir motion: the list of its parts, and the functions that they share.
#include "tools/voussoir/motion.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "io/records/table.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/motion/baseline.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace fs = std::filesystem;

const char* const axis_colour[3] = {"#0072b2", "#d55e00", "#009e73"};
const char* const axis_word[3] = {"x", "y", "z"};

namespace {

const std::vector<Verb>& motion_parts() {
  static const std::vector<Verb> list = {
      {"info", "print what records hold, and their intensity measures", motion_info},
      {"spectrum", "compute response spectra, with --target also the spectrum of a code", motion_spectrum},
      {"process", "process records and join their components: taper, band-pass filter, baseline correction, resampling",
       motion_process},
      {"select", "select records whose mean spectrum fits that of a code", motion_select},
      {"synthesize", "make artificial records with the spectrum of a code", motion_synthesize},
  };
  return list;
}

int motion(const std::vector<std::string>& arguments) {
  const std::string asked = arguments.empty() ? "--help" : arguments.front();
  if (asked == "--help" || asked == "-h") {
    fmt::print("Usage: voussoir motion PART …\n\n");
    for (const Verb& part : motion_parts()) fmt::print("  {:<12}{}\n", part.name, part.summary);
    fmt::print(
        "\nvoussoir motion PART --help lists the options of a part. All parts take --help, --threads N and "
        "--quiet.\n\nExample: voussoir motion info records -o measures\n");
    return 0;
  }
  std::vector<std::string> names;
  for (const Verb& part : motion_parts()) {
    if (asked == part.name) return part.run({arguments.begin() + 1, arguments.end()});
    names.emplace_back(part.name);
  }
  throw InputError("motion: '{}' is not one of its parts{}. See voussoir motion --help", asked,
                   suggestion(asked, names));
}

}  // namespace

Verb motion_verb() {
  return {"motion", "measure, process, select and synthesize ground motions", motion, motion_parts()};
}

void add_columns_options(CommandLine& line) {
  line.described.add_options()("units", options::value<std::string>()->default_value("m/s2"),
                               "unit of files of plain columns: m/s2, g or cm/s2")(
      "dt", options::value<double>()->default_value(0.005, "0.005"), "time step of files without times, s")(
      "columns", options::value<std::vector<std::string>>()->multitoken(),
      "names of the columns of a table: t, x, y, z, or - for a column to skip");
}

ColumnsMeaning columns_asked(const options::variables_map& values) {
  ColumnsMeaning meaning{values["units"].as<std::string>(), values["dt"].as<double>()};
  acceleration_unit(meaning.units);
  if (!(meaning.dt >= 1e-5 && meaning.dt <= 1.0))
    throw InputError("--dt is {} s. It must be from 1e-5 to 1 s", meaning.dt);
  if (values.count("columns"))
    for (const std::string& word : values["columns"].as<std::vector<std::string>>()) {
      meaning.columns.push_back(word == "-" ? "" : word);
      if (std::ranges::find(column_words(), meaning.columns.back()) == column_words().end())
        throw InputError("--columns contains '{}'. Give t, x, y, z, or - for a column to skip", word);
    }
  return meaning;
}

void add_target_options(CommandLine& line) {
  line.described.add_options()("target", options::value<std::string>()->value_name("CODE"),
                               "code of the target spectrum: ntc2018, en1998-1 or en1998-2 (EN 1998-1, type 1 or 2)")(
      "ag", options::value<double>(), "peak ground acceleration on rock, g")(
      "f0", options::value<double>(), "NTC 2018: largest spectral amplification F0 on rock")(
      "tc", options::value<double>(), "NTC 2018: corner period Tc* on rock, s")(
      "soil", options::value<char>(), "soil class, A to E")("topography", options::value<int>()->default_value(1),
                                                            "topographic class, 1 to 4 (T1 to T4)")(
      "damping", options::value<double>()->default_value(0.05, "0.05"), "damping ratio of the spectra");
}

std::optional<TargetSpectrum> target_asked(const options::variables_map& values) {
  if (!values.count("target")) return std::nullopt;
  const std::string code = values["target"].as<std::string>();
  const auto at = std::ranges::find(target_codes(), code);
  if (at == target_codes().end()) throw InputError("--target is {}{}", code, suggestion(code, target_codes()));
  TargetSpectrum t;
  t.code = TargetCode(at - target_codes().begin());
  const auto required = [&](const char* key) {
    if (!values.count(key)) throw InputError("--target {} needs --{}", code, key);
  };
  required("ag"), required("soil");
  t.ag = values["ag"].as<double>();
  t.soil = values["soil"].as<char>();
  if (t.code == TargetCode::ntc2018) {
    required("f0"), required("tc");
    t.f0 = values["f0"].as<double>(), t.tc = values["tc"].as<double>();
  }
  t.topography = values["topography"].as<int>();
  t.damping = values["damping"].as<double>();
  check_target(t);
  return t;
}

std::string target_text(const TargetSpectrum& t) {
  const std::string ntc = t.code == TargetCode::ntc2018 ? fmt::format(", F0 {:g}, Tc* {:g} s", t.f0, t.tc) : "";
  const char* const names[] = {"NTC 2018", "EN 1998-1 type 1", "EN 1998-1 type 2"};
  return fmt::format("{}: ag {:g} g{}, soil {}, T{}, damping {:g} %", names[std::size_t(t.code)], t.ag, ntc, t.soil,
                     t.topography, 100.0 * t.damping);
}

nlohmann::json target_json(const TargetSpectrum& t) {
  nlohmann::json json = {{"code", target_codes()[std::size_t(t.code)]},
                         {"ag_g", t.ag},
                         {"soil", std::string(1, t.soil)},
                         {"topography", t.topography},
                         {"damping", t.damping}};
  if (t.code == TargetCode::ntc2018) json["f0"] = t.f0, json["tc"] = t.tc;
  return json;
}

std::vector<double> target_values(const TargetSpectrum& target, const std::vector<double>& periods) {
  std::vector<double> values;
  for (const double period : periods) values.push_back(standard_gravity * spectral_acceleration(target, period));
  return values;
}

std::vector<RecordSet> records_asked(const std::vector<std::string>& paths, const ColumnsMeaning& meaning, bool quiet) {
  std::vector<RecordSet> sets;
  std::error_code ignored;
  if (paths.size() == 1 && !fs::is_regular_file(paths[0], ignored)) {
    RecordFolder folder = read_record_folder(paths[0], meaning);
    if (!quiet)
      for (const std::string& text : folder.left_out) fmt::print(stderr, "left out: {}\n", text);
    sets = std::move(folder.sets);
  } else {
    if (paths.size() > 3)
      throw InputError("{} paths are given. Give a folder of records, or up to three files for x, y and z",
                       paths.size());
    std::array<std::string, 3> files;
    std::ranges::copy(paths, files.begin());
    sets.push_back(read_record_set(files, meaning));
  }
  const auto told = [](const RecordSet& set) { return set.dt > 0.0; };
  if (!quiet && std::ranges::any_of(sets, [](const RecordSet& set) { return !set.units.empty(); }))
    fmt::print(stderr, "Files of plain columns are taken to be in {}{}.\n", meaning.units,
               std::ranges::any_of(sets, told)
                   ? fmt::format(". Files with one column have a time step of {:g} s", meaning.dt)
                   : "");
  return sets;
}

std::string short_period_remark(const std::vector<RecordSet>& sets, double shortest) {
  constexpr double steps = 10.0;
  double longest = 0.0;
  std::size_t coarse = 0;
  for (const RecordSet& set : sets) {
    longest = std::max(longest, set.motion.dt);
    coarse += shortest < steps * set.motion.dt;
  }
  if (coarse == 0) return "";
  return fmt::format(
      "The spectra of {} of {} records may be too low at periods below {:g} s, which is ten of their time steps ({:g} "
      "s), because peaks between samples are not recorded",
      coarse, sets.size(), steps * longest, longest);
}

std::vector<double> chart_periods() {
  std::vector<double> periods;
  for (int k = 0; k <= 104; ++k) periods.push_back(0.01 * std::pow(400.0, k / 104.0));
  return periods;
}

bool shaken(const GroundMotion& motion, int axis) {
  return std::ranges::any_of(motion.acceleration, [axis](const Vec3& a) { return a[axis] != 0.0; });
}

std::array<std::vector<double>, 3> spectra_of(const GroundMotion& motion, const std::vector<double>& periods,
                                              double damping) {
  std::array<std::vector<double>, 3> spectra;
  for (int axis = 0; axis < 3; ++axis)
    if (shaken(motion, axis))
      spectra[std::size_t(axis)] = response_spectrum(component(motion, axis), motion.dt, periods, damping);
  return spectra;
}

std::array<Intensity, 3> intensities_of(const GroundMotion& motion) {
  std::array<Intensity, 3> of;
  for (int axis = 0; axis < 3; ++axis) of[std::size_t(axis)] = intensity_of(component(motion, axis), motion.dt);
  return of;
}

nlohmann::json intensity_json(const Intensity& i) {
  return {{"pga", i.pga}, {"pgv", i.pgv}, {"arias", i.arias}, {"cav", i.cav}, {"d595", i.significant()}};
}

nlohmann::json record_json(const RecordSet& set, const std::string& relative_to) {
  nlohmann::json files = nlohmann::json::array();
  for (const std::string& file : set.files) {
    std::error_code trouble;
    const fs::path near = file.empty() ? fs::path() : fs::relative(file, relative_to, trouble);
    files.push_back(trouble || (near.empty() && !file.empty()) ? fs::absolute(file).string() : near.string());
  }
  return {{"name", set.name}, {"event", set.event},    {"station", set.station},
          {"files", files},   {"format", set.format},  {"units", set.units},
          {"dt", set.dt},     {"step", set.motion.dt}, {"duration", set.motion.duration()}};
}

std::string measures_heading() {
  return fmt::format("{:<24} {:>4} {:>9} {:>9} {:>10} {:>8} {:>9}\n", "record", "axis", "PGA (g)", "PGV (m/s)",
                     "Arias(m/s)", "D5-95(s)", "CAV (m/s)");
}

std::string measures_row(const std::string& name, const std::array<Intensity, 3>& of, double f) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Intensity& i = of[axis];
    if (i.pga == 0.0) continue;
    text += fmt::format("{:<24} {:>4} {:>9.4f} {:>9.4f} {:>10.4f} {:>8.2f} {:>9.3f}\n", text.empty() ? name : "",
                        axis_word[axis], f * i.pga / standard_gravity, f * i.pgv, f * f * i.arias, i.significant(),
                        f * i.cav);
  }
  return text;
}

std::string measures_table(const std::vector<std::string>& names, const std::vector<std::array<Intensity, 3>>& of,
                           const std::vector<double>& factors) {
  std::string text = "<table>\n" + table_row({words_cell("record"),
                                              {"factor", true},
                                              words_cell("axis"),
                                              {"PGA, g", true},
                                              {"PGV, m/s", true},
                                              {"Arias intensity, m/s", true},
                                              {"D5–95, s", true},
                                              {"CAV, m/s", true}},
                                             "th");
  for (std::size_t r = 0; r < of.size(); ++r) {
    bool first = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Intensity& i = of[r][axis];
      if (i.pga == 0.0) continue;
      const double f = factors[r];
      const auto number = [](double v) { return Cell{fmt::format("{:.3f}", v), true}; };
      text +=
          table_row({words_cell(first ? names[r] : ""), first ? number(f) : words_cell(""), words_cell(axis_word[axis]),
                     number(f * i.pga / standard_gravity), number(f * i.pgv), number(f * f * i.arias),
                     Cell{fmt::format("{:.2f}", i.significant()), true}, number(f * i.cav)},
                    "td");
      first = false;
    }
  }
  return text + "</table>\n" +
         note(
             "PGA, PGV: peak ground acceleration and velocity. D5–95: time from 5 to 95 % of the Arias intensity. CAV: "
             "cumulative absolute velocity.");
}

std::string histories_figure(const std::string& name, const GroundMotion& motion) {
  std::string text = fmt::format("<h3>{}</h3>\n", escaped(name));
  const char* const labels[] = {"Acceleration, g", "Velocity, m/s", "Displacement, m"};
  std::array<LineChart, 3> charts;
  for (std::size_t k = 0; k < 3; ++k) {
    charts[k].height = 190.0;
    charts[k].x_label = k == 2 ? "Time, s" : "";
    charts[k].y_label = labels[k];
  }
  std::vector<double> time(motion.acceleration.size());
  for (std::size_t i = 0; i < time.size(); ++i) time[i] = double(i) * motion.dt;
  for (int axis = 0; axis < 3; ++axis) {
    if (!shaken(motion, axis)) continue;
    const std::vector<double> a = component(motion, axis), v = integrate(a, motion.dt), u = integrate(v, motion.dt);
    const std::vector<double>* values[] = {&a, &v, &u};
    for (std::size_t k = 0; k < 3; ++k) {
      ChartCurve curve{k == 0 ? axis_word[axis] : "", time, *values[k], axis_colour[axis], 1.0, ""};
      if (k == 0)
        for (double& value : curve.y) value /= standard_gravity;
      charts[k].curves.push_back(thinned(curve));
    }
  }
  for (const LineChart& chart : charts) text += figure(line_chart(chart));
  return text;
}

std::array<std::string, 3> write_motion_files(const std::string& directory, const std::string& name,
                                              const GroundMotion& motion, const std::string& about) {
  std::array<std::string, 3> files;
  for (int axis = 0; axis < 3; ++axis) {
    if (!shaken(motion, axis)) continue;
    std::string text = fmt::format("# {}\n# time (s), acceleration along {} (m/s2)\n", about, axis_word[axis]);
    for (std::size_t i = 0; i < motion.acceleration.size(); ++i)
      text += fmt::format("{:.9g} {:.9g}\n", double(i) * motion.dt, motion.acceleration[i][axis]);
    files[std::size_t(axis)] = fmt::format("{}/{}_{}.txt", directory, name, axis_word[axis]);
    write_atomically(files[std::size_t(axis)], text);
  }
  return files;
}

}  // namespace voussoir
