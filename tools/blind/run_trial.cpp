#include "tools/blind/run_trial.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "solver/base/child.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"

namespace voussoir {

namespace {

namespace fs = std::filesystem;

/// The trace from answer.toml, which is its first entry.
double trace_in(const std::string& file) {
  std::ifstream text(file);
  std::string name, equals;
  double value = 0.0;
  return text >> name >> equals >> value && name == "trace" ? value : -1.0;
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The rows of sensors.csv as voussoir hide writes it: id, x, y, z, direction.
std::vector<std::vector<std::string>> sensor_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// The arguments of hide except the hidden effects.
std::vector<std::string> hide_words(const BlindTrial& t, const std::string& program, const std::string& model,
                                    const std::string& output) {
  std::vector<std::string> words = {program, "hide", model, "-o", output};
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  add("--sensors", t.sensors);
  add("--noise", fmt::format("{}", t.noise));
  add("--seed", fmt::format("{}", t.seed));
  add("--mesh", fmt::format("{}", t.mesh));
  add("--defects", fmt::format("{}", t.defects));
  add("--scatter", fmt::format("{}", t.scatter));
  for (const std::string& key : t.truth) add("--truth", key);
  if (t.parapet_gaps > 0) add("--parapet-gaps", fmt::format("{}", t.parapet_gaps));
  return words;
}

/// The effects of the trial, with channels of its sensor plan.
std::vector<std::string> effects_of(const BlindTrial& t, const std::string& program, const std::string& model,
                                    const std::string& folder, const std::string& log) {
  std::vector<std::string> effects = t.effects;
  std::string sensors;
  for (std::string& effect : effects) {
    if (effect.find('{') == std::string::npos) continue;
    if (sensors.empty()) {
      std::vector<std::string> words = hide_words(t, program, model, folder + "/plan");
      words.insert(words.end(), {"--modes", "1"});
      if (execute(words, log) != 0) throw RunError("voussoir hide failed. See {}", log);
      sensors = text_of(folder + "/plan/measured/sensors.csv");
    }
    effect = with_channels(effect, sensors);
  }
  return effects;
}

}  // namespace

int execute(const std::vector<std::string>& words, const std::string& log) {
  const LogFile output(log);
  return wait_for(start({.words = words, .out = output.descriptor, .err = output.descriptor})).status;
}

std::string with_channels(const std::string& effect, const std::string& sensors) {
  const std::size_t open = effect.find('{'), gap = effect.find(' ', open), close = effect.find('}', open);
  if (open == std::string::npos || gap == std::string::npos || close == std::string::npos) return effect;
  const std::string which = effect.substr(open + 1, gap - open - 1);
  const double share = std::stod(effect.substr(gap + 1, close - gap - 1));
  const auto rows = sensor_rows(sensors);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool upright = rows[i][4].find('z') != std::string::npos;
    if (which == "any" || (which == "flat" && !upright) || (which == "upright" && upright)) found.push_back(rows[i][0]);
    for (std::size_t j = i + 1; which == "pair" && j < rows.size(); ++j)
      if (std::equal(rows[i].begin() + 1, rows[i].begin() + 4, rows[j].begin() + 1))
        found.push_back(rows[i][0] + " " + rows[j][0]);
  }
  if (found.empty()) throw RunError("{}: the sensor plan has no such channel", effect);
  const auto at = std::min(found.size() - 1, std::size_t(share * double(found.size())));
  return effect.substr(0, open) + found[at] + effect.substr(close + 1);
}

nlohmann::json diagnose(const BlindTrial& trial, const std::string& program, const std::string& model,
                        const std::string& measured, const std::string& said, const std::string& log) {
  std::vector<std::string> words = {program,     "diagnose", model,       "--measured",         measured,
                                    "--threads", "1",        "--no-page", "--no-least-amounts", "--run-seconds",
                                    "0",         "-o",       said};
  if (!trial.without.empty()) words.insert(words.end(), {"--without", trial.without});
  return execute(words, log) == 0 ? read_json(said + "/diagnosis.json") : nlohmann::json();
}

TrialRun run_trial(const BlindTrial& t, const std::string& program, const std::string& folder) {
  TrialRun run;
  run.log = folder + "/log.txt";
  fs::remove_all(folder);
  fs::create_directories(folder + "/seen");
  // The case and the measurements are kept apart from the answer.
  const std::string model = folder + "/seen/case.toml";
  std::ofstream(model) << case_of(t);
  run.effects = effects_of(t, program, model, folder, run.log);
  std::vector<std::string> words = hide_words(t, program, model, folder + "/sealed");
  for (const std::string& effect : run.effects) words.insert(words.end(), {"--effect", effect});
  for (const std::string& l : t.loosened) words.insert(words.end(), {"--loosen", l});
  if (t.noise_said != 1.0) words.insert(words.end(), {"--noise-said", fmt::format("{}", t.noise_said)});
  if (t.minutes > 0.0) words.insert(words.end(), {"--minutes", fmt::format("{}", t.minutes)});
  if (t.shaken > 0.0) words.insert(words.end(), {"--shaken", fmt::format("{}", t.shaken)});
  if (t.minutes == 0.0 && t.shaken == 0.0) words.emplace_back("--trace");
  if (execute(words, run.log) != 0) throw RunError("voussoir hide failed. See {}", run.log);
  run.trace = trace_in(folder + "/sealed/answer.toml");
  fs::rename(folder + "/sealed/measured", folder + "/seen/measured");
  run.diagnosis = diagnose(t, program, model, folder + "/seen/measured", folder + "/said", run.log);
  return run;
}

}  // namespace voussoir
