// voussoir-blind: hides effects in measurements, has them diagnosed by the program, which is given nothing but the case
// and the measurements, and scores what it says.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "solver/base/child.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/program.h"
#include "tools/blind/trials.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace voussoir {
namespace {

struct Outcome {
  std::size_t number = 0;
  const BlindTrial* trial = nullptr;
  std::string said;          // verdict and effects, in words
  double score = 0.0;        // 0 also of a trial that failed
  double probability = 0.0;  // of the first effect
  bool wrong = false, false_alarm = true;
  int values = 0, values_right = 0;
  double gap_before = 0.0, gap_after = 0.0, held_back = 1e9;
  double trace = -1.0;  // of what is hidden: see voussoir hide --trace; below 0: not known of recordings
  double seconds = 0.0;
};

/// A candidate pays about 5 for being one of 150 places and must win by 2.3 (log probabilities): no evidence can name
/// what leaves less than twice that.
constexpr double shows = 15.0;

/// Runs a program without a shell, its output in a file; its exit status.
int execute(const std::vector<std::string>& words, const std::string& log) {
  const LogFile output(log);
  return wait_for(start({.words = words, .out = output.descriptor, .err = output.descriptor})).status;
}

void write_case(const std::string& bridge, const std::string& file) {
  std::ofstream(file) << fmt::format(
      "[bridge]\ngenerator = \"{}\"\nabutments = \"free\"\nbackfill = \"rigid\"\nblock_scale = {}\n", bridge,
      bridge == "cs1" ? 3.0 : 1.8);
}

struct Named {
  std::string name, where;
  std::map<std::string, double> values;
};
/// "abutment_restraint both stiffness_share=0.5".
Named parse(const std::string& text) {
  Named n;
  std::istringstream words(text);
  words >> n.name;
  for (std::string word; words >> word;)
    if (const std::size_t at = word.find('='); at != std::string::npos)
      n.values[word.substr(0, at)] = std::stod(word.substr(at + 1));
    else
      n.where += (n.where.empty() ? "" : " ") + word;
  return n;
}

/// Also of the same sort: a late clock is not a wrong gain.
bool same(const json& effect, const Named& hidden) {
  const bool sort = std::all_of(hidden.values.begin(), hidden.values.end(),
                                [&](const auto& value) { return effect["parameters"].contains(value.first); });
  return effect["name"] == hidden.name && effect["where"] == hidden.where && sort;
}

std::string said(const json& d) {
  std::string text = d["verdict"];
  for (const json& e : d["effects"])
    text += fmt::format("; {} at {} ({:.2f})", e["name"].get<std::string>(), e["where"].get<std::string>(),
                        e["probability"].get<double>());
  for (const json& e : d["ties"])
    text += fmt::format(" ~ {} at {}", e["name"].get<std::string>(), e["where"].get<std::string>());
  if (d.contains("nameless"))
    for (const json& e : d["nameless"])
      text += fmt::format("; {} of {}", e["name"].get<std::string>(), e["where"].get<std::string>());
  return text;
}

/// A hidden value in the terms of the case. What is a share of, or a factor on, the stiffness of single joints stands
/// for a stiffness per area; joints of the true bridge, whose blocks are smaller, are stiffer for the same material.
double in_terms_of_case(const Named& hidden, const std::string& name, double value) {
  constexpr double mesh = 0.85;  // hide's
  const bool joints =
      name == "stiffness_share" || hidden.name == "fill_interface" || hidden.name == "spandrel_separation";
  return joints ? value / mesh : value;
}

/// Of the hidden values, how many the program has within two of its standard deviations.
void score_values(const json& effect, const Named& hidden, Outcome& o) {
  for (const auto& [name, said] : hidden.values) {
    if (!effect["parameters"].contains(name)) continue;
    const double value = in_terms_of_case(hidden, name, said);
    const json& found = effect["parameters"][name];
    ++o.values;
    o.values_right += std::abs(found["value"].get<double>() - value) <= 2.0 * found["std"].get<double>() + 1e-9;
  }
}

void score(const json& d, Outcome& o) {
  const BlindTrial& trial = *o.trial;
  const std::string verdict = d["verdict"];
  o.said = said(d);
  o.gap_before = d["gap"]["fit"]["before"];
  o.gap_after = d["gap"]["fit"]["after"];
  o.held_back = d["gap"]["held_back"]["after"];
  if (!d["effects"].empty()) o.probability = d["effects"][0]["probability"];
  if (trial.effects.empty()) {
    o.score = verdict == "consistent";
    o.false_alarm = verdict != "consistent";
    return;
  }
  if (!trial.without.empty()) {
    const bool place = d.contains("nameless") && !d["nameless"].empty() &&
                       d["nameless"][0]["where"].get<std::string>().find(trial.where) != std::string::npos;
    o.score = verdict == "unexplained" && place ? 1.0 : 0.0;
    o.wrong = verdict == "found" && o.probability > 0.9;
    return;
  }
  double right = 0.0;
  for (const std::string& text : trial.effects) {
    const Named hidden = parse(text);
    bool named = false, tied = false;
    for (const json& e : d["effects"])
      if (same(e, hidden)) named = true, score_values(e, hidden, o);
    for (const json& e : d["ties"]) tied |= same(e, hidden);
    right += named ? 1.0 : tied ? 0.5 : 0.0;
  }
  // What is named beside the truth counts against it.
  const double named = double(std::max(d["effects"].size(), trial.effects.size()));
  o.score = right / named;
  o.wrong = right == 0.0 && verdict == "found" && o.probability > 0.9;
}

/// Of answer.toml, which says it first.
double trace_in(const std::string& file) {
  std::ifstream text(file);
  std::string name, equals;
  double value = 0.0;
  return text >> name >> equals >> value && name == "trace" ? value : -1.0;
}

Outcome run_trial(std::size_t number, const std::string& program, const std::string& directory) {
  Outcome o;
  o.number = number;
  o.trial = &blind_trials()[number];
  const auto begin = std::chrono::steady_clock::now();
  const std::string folder = fmt::format("{}/{:02}", directory, number + 1), log = folder + "/log.txt";
  fs::remove_all(folder);
  fs::create_directories(folder + "/seen");
  // The case and the measurements lie apart from the answer.
  const std::string model = folder + "/seen/case.toml";
  write_case(o.trial->bridge, model);
  const bool recorded = o.trial->minutes > 0.0 || o.trial->shaken > 0.0;
  std::vector<std::string> hide = {program,
                                   "hide",
                                   model,
                                   "--sensors",
                                   o.trial->sensors,
                                   "--noise",
                                   fmt::format("{}", o.trial->noise),
                                   "--seed",
                                   fmt::format("{}", 1000 + number),
                                   "-o",
                                   folder + "/sealed"};
  for (const std::string& effect : o.trial->effects) hide.insert(hide.end(), {"--effect", effect});
  if (!recorded) hide.push_back("--trace");
  if (o.trial->minutes > 0.0) hide.insert(hide.end(), {"--minutes", fmt::format("{}", o.trial->minutes)});
  if (o.trial->shaken > 0.0) hide.insert(hide.end(), {"--shaken", fmt::format("{}", o.trial->shaken)});
  if (execute(hide, log) != 0) throw RunError("trial {}: hide failed; see {}", number + 1, log);
  o.trace = trace_in(folder + "/sealed/answer.toml");
  fs::rename(folder + "/sealed/measured", folder + "/seen/measured");
  std::vector<std::string> diagnose = {
      program,     "diagnose",      model, "--measured", folder + "/seen/measured", "--threads", "1",
      "--no-page", "--run-seconds", "0",   "-o",         folder + "/said"};
  if (!o.trial->without.empty()) diagnose.insert(diagnose.end(), {"--without", o.trial->without});
  if (execute(diagnose, log) != 0) {
    o.said = fmt::format("failed: see {}", log);
  } else {
    score(read_json(folder + "/said/diagnosis.json"), o);
  }
  o.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return o;
}

std::string hidden_text(const BlindTrial& t) {
  std::string text;
  for (const std::string& e : t.effects) text += (text.empty() ? "" : " + ") + e;
  if (text.empty()) text = "nothing";
  if (t.minutes > 0.0) text += fmt::format(", {:g} min recorded", t.minutes);
  if (t.shaken > 0.0) text += fmt::format(", {:g} s of an earthquake", t.shaken);
  return t.without.empty() ? text : fmt::format("{}, out of the library", text);
}

std::string table(const std::vector<Outcome>& all) {
  std::string text =
      "| # | bridge | sensors | noise % | hidden | trace | said | score | gap before | after | held back |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Outcome& o : all)
    text += fmt::format("| {} | {} | {} | {:g} | {} | {} | {} | {:.2g}{} | {:.2f} | {:.2f} | {:.2f} |\n", o.number + 1,
                        o.trial->bridge, o.trial->sensors, 100.0 * o.trial->noise, hidden_text(*o.trial),
                        o.trace >= 0.0 ? fmt::format("{:.0f}", o.trace) : "-", o.said, o.score,
                        o.wrong ? " (confident and wrong)" : "", o.gap_before, o.gap_after, o.held_back);
  return text;
}

std::string confusion(const std::vector<Outcome>& all) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::vector<std::string> columns;
  for (const Outcome& o : all) {
    std::string hidden = o.trial->effects.empty()       ? "nothing"
                         : !o.trial->without.empty()    ? "out of the library"
                         : o.trial->effects.size() > 1u ? "two effects"
                                                        : parse(o.trial->effects[0]).name;
    const std::string column = o.score == 1.0  ? "right"
                               : o.score > 0.0 ? "half"
                                               : o.said.substr(0, o.said.find_first_of(";:"));
    ++counts[hidden][column.starts_with("found") ? "another" : column];
  }
  const std::vector<std::string> heads = {"right", "half", "another", "consistent", "unexplained", "failed"};
  std::string text = "| hidden |";
  for (const std::string& head : heads) text += fmt::format(" {} |", head);
  text += "\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (auto& [hidden, row] : counts) {
    text += fmt::format("| {} |", hidden);
    for (const std::string& head : heads) text += fmt::format(" {} |", row.contains(head) ? row[head] : 0);
    text += "\n";
  }
  return text;
}

std::string scores(const std::vector<Outcome>& all) {
  double right = 0.0, hidden = 0.0, wrong = 0.0, none = 0.0, alarms = 0.0, values = 0.0, values_right = 0.0, low = 0.0,
         named = 0.0, seconds = 0.0, shown = 0.0, shown_right = 0.0;
  for (const Outcome& o : all) {
    const bool nothing = o.trial->effects.empty();
    seconds += o.seconds;
    if (nothing) {
      ++none;
      alarms += o.false_alarm;
      continue;
    }
    ++hidden;
    right += o.score;
    if (o.trace > shows) ++shown, shown_right += o.score;
    wrong += o.wrong;
    values += o.values, values_right += o.values_right;
    if (o.trial->without.empty()) {
      ++named;
      low += o.held_back < 1.5;
    }
  }
  const auto share = [](double a, double b) { return b > 0.0 ? 100.0 * a / b : 0.0; };
  return fmt::format(
      "| score | reached | target |\n| --- | --- | --- |\n"
      "| name and place right (in a tie: half), of {} with something hidden | {:.0f} % | ≥ 90 % |\n"
      "| the same, of {} whose trace is above {:.0f}: it shows in these modes | {:.0f} % | |\n"
      "| confident (above 0.9) and wrong | {:.0f} % | ≤ 5 % |\n"
      "| false alarms, of {} with nothing hidden | {:.0f} % | ≤ 5 % |\n"
      "| value within two standard deviations, of {} | {:.0f} % | (95 %) |\n"
      "| gap on held-back data below 1.5, of {} in the library | {:.0f} % | all |\n"
      "\n{} trials, {:.0f} s of work\n",
      int(hidden), share(right, hidden), int(shown), shows, share(shown_right, shown), share(wrong, hidden), int(none),
      share(alarms, none), int(values), share(values_right, values), int(named), share(low, named), all.size(),
      seconds);
}

int run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::string directory = "blind";
  int jobs = int(std::max(1u, std::thread::hardware_concurrency())), first = 1, last = int(blind_trials().size());
  po::options_description described("Options");
  described.add_options()("help,h", "this text")(
      "output,o", po::value<std::string>(&directory)->default_value(directory), "where to")(
      "jobs,j", po::value<int>(&jobs)->default_value(jobs), "trials at a time, one thread each")(
      "first", po::value<int>(&first)->default_value(first), "trial")(
      "last", po::value<int>(&last)->default_value(last), "trial");
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, described), values);
  po::notify(values);
  if (values.count("help")) {
    std::cout << "Usage: voussoir-blind [-o DIR] [--jobs N]\n\n" << described;
    return 0;
  }
  if (first < 1 || last > int(blind_trials().size()) || first > last || jobs < 1)
    throw InputError("trials are 1 to {}, jobs 1 or more", blind_trials().size());
  const std::string program = (fs::canonical("/proc/self/exe").parent_path() / "voussoir").string();
  std::vector<Outcome> all(std::size_t(last - first + 1));
  std::atomic<std::size_t> next{0};
  std::mutex printing;
  std::vector<std::thread> workers;
  for (int worker = 0; worker < jobs; ++worker)
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < all.size(); i = next++) {
        const std::size_t number = std::size_t(first - 1) + i;
        try {
          all[i] = run_trial(number, program, directory);
        } catch (const std::exception& e) {
          all[i].number = number;
          all[i].trial = &blind_trials()[number];
          all[i].said = fmt::format("failed: {}", e.what());
        }
        const std::lock_guard lock(printing);
        fmt::print("{:2} {:4} {:40} {:.1f} {} ({:.0f} s)\n", number + 1, all[i].trial->bridge,
                   hidden_text(*all[i].trial), all[i].score, all[i].said, all[i].seconds);
        std::fflush(stdout);
      }
    });
  for (std::thread& worker : workers) worker.join();
  const std::string report = fmt::format("{}\n{}\n{}", scores(all), confusion(all), table(all));
  std::ofstream(directory + "/blind.md") << report;
  fmt::print("\n{}", report);
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-blind", voussoir::run, argc, argv);
}
