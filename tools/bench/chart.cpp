// voussoir-bench-chart: a chart of the cost of scenes with several programs, from the bench.json of each.
#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/program.h"
#include "tools/bench/scenes.h"
#include "viz/page/svg.h"

namespace voussoir {
namespace {

/// A program and its cost of each scene, µs per block and time step: the median of its files.
struct Program {
  std::string name;
  std::map<std::string, double> cost;
};

struct Options {
  std::vector<std::pair<std::string, std::string>> files;  // name of the program, bench.json
  std::map<std::string, double> aims;                      // targets of scenes, µs per block and time step
  std::string to;
};

/// Splits "NAME=REST".
std::pair<std::string, std::string> named(const std::string& text, const std::string& example) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError("\"{}\" does not have the form {}", text, example);
  return {text.substr(0, at), text.substr(at + 1)};
}

std::map<std::string, double> costs_in(const std::string& file) {
  std::map<std::string, double> costs;
  try {
    const nlohmann::json all = read_json(file);
    for (const auto& [scene, result] : all.items()) costs[scene] = result.at("us_per_block_step").get<double>();
  } catch (const nlohmann::json::exception& e) {
    throw InputError("{} is not a bench.json ({})", file, e.what());
  }
  return costs;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// The programs, in the order in which they are first named.
std::vector<Program> programs_of(const Options& options) {
  std::vector<Program> programs;
  std::map<std::string, std::map<std::string, std::vector<double>>> all;
  for (const auto& [name, file] : options.files) {
    if (!all.count(name)) programs.push_back({name, {}});
    for (const auto& [scene, cost] : costs_in(file)) all[name][scene].push_back(cost);
  }
  for (Program& program : programs)
    for (const auto& [scene, costs] : all[program.name]) program.cost[scene] = median(costs);
  return programs;
}

/// The scenes of all programs, in the order of voussoir-bench --list. Scenes that are not listed come last.
std::vector<std::string> scenes_of(const std::vector<Program>& programs) {
  std::map<std::size_t, std::vector<std::string>> by_place;
  std::map<std::string, bool> seen;
  for (const Program& program : programs)
    for (const auto& [scene, cost] : program.cost) {
      if (std::exchange(seen[scene], true)) continue;
      const auto listed = std::find_if(scenes().begin(), scenes().end(), [&scene = scene](const Scene& s) {
        return s.name == scene.substr(0, scene.find('@'));
      });
      by_place[std::size_t(listed - scenes().begin())].push_back(scene);
    }
  std::vector<std::string> names;
  for (const auto& [place, of] : by_place) names.insert(names.end(), of.begin(), of.end());
  return names;
}

std::string chart(const std::vector<Program>& programs, const std::map<std::string, double>& aims) {
  constexpr double width = 900.0, label = 170.0, head = 34.0, bar = 15.0, gap = 12.0, foot = 48.0;
  const std::vector<std::string> names = scenes_of(programs);
  const double row = bar * double(programs.size()) + gap, bottom = head + row * double(names.size());
  double most = 0.0;
  for (const Program& program : programs)
    for (const auto& [scene, cost] : program.cost) most = std::max(most, cost);
  for (const auto& [scene, aim] : aims) most = std::max(most, aim);
  const ChartAxis axis = {ChartAxis::Kind::linear, 0.0, most, label, width - 60.0};
  SvgDrawing drawing(width, bottom + foot, "Cost of a time step");
  draw_axis_below(drawing, axis, head, bottom, "µs per block and time step");
  std::vector<LegendEntry> legend;
  for (std::size_t p = 0; p < programs.size(); ++p)
    legend.push_back({Marker::circle, colour_code(line_colour(p)), programs[p].name});
  if (!aims.empty()) legend.push_back({Marker::triangle, colour_code(kInk), "aimed for"});
  draw_legend(drawing, label, 18.0, legend);
  for (std::size_t s = 0; s < names.size(); ++s) {
    const double top = head + row * double(s) + 0.5 * gap, below = top + row - gap;
    drawing.text(label - 10.0, 0.5 * (top + below) + 4.5, names[s], {.anchor = "end"});
    if (const auto aim = aims.find(names[s]); aim != aims.end()) {
      const double x = axis.at(aim->second);
      drawing.line(x, top - 3.0, x, below + 3.0, colour_code(kInk), 1.6, "4 3");
      drawing.marker(Marker::triangle, x, below + 6.0, colour_code(kInk), fmt::format("aimed for: {}", aim->second),
                     4.0);
    }
    for (std::size_t p = 0; p < programs.size(); ++p) {
      const auto cost = programs[p].cost.find(names[s]);
      if (cost == programs[p].cost.end()) continue;
      const double y = top + bar * double(p) + 1.0, end = axis.at(cost->second), height = bar - 2.0;
      drawing.rectangle(label, y, end - label, height, {.fill = colour_code(line_colour(p))},
                        fmt::format("{}, {}", names[s], programs[p].name));
      const std::string number = fmt::format("{:.3f}", cost->second);
      drawing.rectangle(end + 2.0, y, text_width(number, 11.0) + 4.0, height, {.fill = "#ffffff"});
      drawing.text(end + 5.0, y + bar - 4.5, number, {.size = 11.0});
    }
  }
  return drawing.finished();
}

Options parse(int argc, char** argv, bool& done) {
  namespace po = boost::program_options;
  po::options_description described(
      "voussoir-bench-chart PROGRAM=bench.json… [--aim SCENE=VALUE…] -o FILE.svg: draws the cost of scenes with "
      "several programs. If a program has several files, their median is drawn");
  described.add_options()("help,h", "print this help")("aim", po::value<std::vector<std::string>>()->composing(),
                                                       "target of a scene, µs per block and time step")(
      "output,o", po::value<std::string>()->default_value("bench.svg"), "picture to write")(
      "file", po::value<std::vector<std::string>>(), "programs and their bench.json");
  po::positional_options_description places;
  places.add("file", -1);
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(described).positional(places).run(), values);
    po::notify(values);
  } catch (const po::error& e) {
    throw InputError("{}. See voussoir-bench-chart --help", e.what());
  }
  Options o;
  done = values.count("help") > 0;
  if (done) return std::cout << described << "\n", o;
  if (!values.count("file")) throw InputError("no bench.json is given. See voussoir-bench-chart --help");
  for (const std::string& text : values["file"].as<std::vector<std::string>>())
    o.files.push_back(named(text, "PROGRAM=bench.json"));
  if (values.count("aim"))
    for (const std::string& text : values["aim"].as<std::vector<std::string>>()) {
      const auto [scene, value] = named(text, "SCENE=0.20");
      char* end = nullptr;
      const double aim = std::strtod(value.c_str(), &end);
      if (*end || !(aim > 0.0) || !std::isfinite(aim))
        throw InputError("--aim {}: the value is \"{}\". It must be a number above 0", text, value);
      o.aims[scene] = aim;
    }
  o.to = values["output"].as<std::string>();
  return o;
}

int run(int argc, char** argv) {
  bool done = false;
  const Options o = parse(argc, argv, done);
  if (done) return 0;
  const std::vector<Program> programs = programs_of(o);
  if (scenes_of(programs).empty()) throw InputError("no bench.json has a scene. Run voussoir-bench first");
  for (const auto& [scene, aim] : o.aims)
    if (std::none_of(programs.begin(), programs.end(),
                     [&scene = scene](const Program& p) { return p.cost.count(scene); }))
      throw InputError("--aim {}: no bench.json has that scene", scene);
  std::ofstream out(o.to);
  out << chart(programs, o.aims);
  if (!out.flush()) throw InputError("{} cannot be written", o.to);
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-bench-chart", voussoir::run, argc, argv);
}
