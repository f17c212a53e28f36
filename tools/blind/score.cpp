#include "tools/blind/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "solver/base/counted.h"

namespace voussoir {

namespace {

using nlohmann::json;

struct Named {
  std::string name, where;
  std::map<std::string, double> values;
};
/// "abutment_restraint both stiffness_share=0.5".
Named parse_named(const std::string& text) {
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

/// Whether the kind is also the same: a late clock is not a wrong gain.
bool same(const json& effect, const Named& hidden) {
  const bool sort = std::all_of(hidden.values.begin(), hidden.values.end(),
                                [&](const auto& value) { return effect["parameters"].contains(value.first); });
  return effect["name"] == hidden.name && effect["where"] == hidden.where && sort;
}

/// A hidden value in the terms of the case. A share of, or a factor on, the stiffness of single masonry joints
/// represents a stiffness per area. If the true bridge has smaller blocks, its joints are stiffer for the same
/// material. The interface with the fill does not depend on the block size.
double in_terms_of_case(const Named& hidden, const std::string& name, double value, double mesh) {
  const bool joints = name == "stiffness_share" || hidden.name == "spandrel_separation";
  return joints ? value / mesh : value;
}

/// Number of hidden values that the program gives within two of its standard deviations. A value that it does not fit,
/// such as the gain of a reversed channel, must be equal.
void score_values(const json& effect, const Named& hidden, Outcome& o) {
  for (const auto& [name, said] : hidden.values) {
    if (!effect["parameters"].contains(name)) continue;
    const double value = in_terms_of_case(hidden, name, said, o.trial->mesh);
    const json& found = effect["parameters"][name];
    ++o.values;
    o.values_right += std::abs(found["value"].get<double>() - value) <= 2.0 * found["std"].get<double>() + 1e-9;
  }
}

bool named_place(const json& d, const std::string& list, const std::string& where) {
  return d.contains(list) && !d[list].empty() &&
         d[list][0]["where"].get<std::string>().find(where) != std::string::npos;
}

/// Score out of the library. Effects excluded from the diagnosis must end unexplained. Changes that no effect
/// describes are also right under the name of an effect that acts on the same part, because only the place counts.
void score_outside(const json& d, double confident, Outcome& o) {
  const BlindTrial& trial = *o.trial;
  const bool unexplained = d["verdict"] == "unexplained" && named_place(d, "nameless", trial.where);
  const bool named = d["verdict"] == "found" && named_place(d, "effects", trial.where);
  o.placed = unexplained || named;
  o.score = unexplained || (named && !trial.loosened.empty()) ? 1.0 : 0.0;
  o.wrong = d["verdict"] == "found" && o.score == 0.0 && o.probability > confident;
}

void score_named(const json& d, double confident, Outcome& o) {
  double right = 0.0;
  for (const std::string& text : o.effects) {
    const Named hidden = parse_named(text);
    bool named = false, tied = false;
    for (const json& e : d["effects"])
      if (same(e, hidden)) named = true, score_values(e, hidden, o);
    for (const json& e : d["ties"]) tied |= same(e, hidden);
    right += named ? 1.0 : tied ? 0.5 : 0.0;
    if (hidden.name == "sensor_fault") o.faults_right += named;
  }
  // Additional effects count against the score.
  o.score = right / double(std::max(d["effects"].size(), o.effects.size()));
  o.wrong = right == 0.0 && d["verdict"] == "found" && o.probability > confident;
}

std::string row_of(const Outcome& o) {
  switch (kind_of(*o.trial)) {
    case TrialKind::nothing:
      return "nothing";
    case TrialKind::outside:
      return "out of the library";
    case TrialKind::two:
      return "two effects";
    default:
      return parse_named(o.trial->effects[0]).name;
  }
}

/// Of all outcomes.
struct Sums {
  int hidden = 0, wrong = 0, none = 0, alarms = 0, values = 0, values_right = 0, low = 0, named = 0, shown = 0,
      faults = 0, faults_right = 0, outside = 0, placed = 0, failed = 0;
  double right = 0.0, shown_right = 0.0, seconds = 0.0;
};
Sums sums_of(const std::vector<Outcome>& all) {
  Sums s;
  for (const Outcome& o : all) {
    const TrialKind kind = kind_of(*o.trial);
    s.seconds += o.seconds;
    s.failed += o.said.starts_with("failed");
    if (kind == TrialKind::nothing) {
      ++s.none, s.alarms += o.false_alarm;
      continue;
    }
    ++s.hidden, s.right += o.score, s.wrong += o.wrong;
    if (o.trace > shows) ++s.shown, s.shown_right += o.score;
    s.values += o.values, s.values_right += o.values_right;
    s.faults += o.faults, s.faults_right += o.faults_right;
    if (kind == TrialKind::outside)
      ++s.outside, s.placed += o.placed;
    else
      ++s.named, s.low += o.held_back < 1.5;
  }
  return s;
}

}  // namespace

std::string said_text(const json& d) {
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

void score(const TrialRun& run, double confident, Outcome& o) {
  o.effects = run.effects;
  o.trace = run.trace;
  for (const std::string& effect : run.effects) o.faults += effect.starts_with("sensor_fault ");
  if (run.diagnosis.is_null()) {
    o.said = fmt::format("failed: see {}", run.log);
    return;
  }
  const json& d = run.diagnosis;
  o.said = said_text(d);
  o.gap_before = d["gap"]["fit"]["before"];
  o.gap_after = d["gap"]["fit"]["after"];
  o.held_back = d["gap"]["held_back"]["after"];
  if (!d["effects"].empty()) o.probability = d["effects"][0]["probability"];
  const TrialKind kind = kind_of(*o.trial);
  if (kind == TrialKind::nothing) {
    o.score = d["verdict"] == "consistent";
    o.false_alarm = d["verdict"] != "consistent";
  } else if (kind == TrialKind::outside) {
    score_outside(d, confident, o);
  } else {
    score_named(d, confident, o);
  }
}

std::string scores_table(const std::vector<Outcome>& all, const Suite& suite) {
  const Sums s = sums_of(all);
  const auto share = [](double a, double b) { return b > 0.0 ? fmt::format("{:.0f} %", 100.0 * a / b) : "-"; };
  std::string text = "| score | reached | aim |\n| --- | --- | --- |\n";
  text += fmt::format("| name and place right (in a tie: half), of {} with something hidden | {} | |\n", s.hidden,
                      share(s.right, s.hidden));
  text += fmt::format("| the same, of {} whose trace is above {:.0f}: it shows in these modes | {} | ≥ {:.0f} % |\n",
                      s.shown, shows, share(s.shown_right, s.shown), suite.right);
  text += fmt::format("| confident (above {:g}) and wrong | {} | ≤ {:.0f} % |\n", suite.confident,
                      share(s.wrong, s.hidden), suite.wrong);
  text += fmt::format("| false alarms, of {} with nothing hidden | {} | ≤ {:.0f} % |\n", s.none,
                      share(s.alarms, s.none), suite.false_alarms);
  text += fmt::format("| value within two standard deviations, of {} | {} | {:.0f} to {:.0f} % |\n", s.values,
                      share(s.values_right, s.values), suite.values_low, suite.values_high);
  text += fmt::format("| faults of sensors named, of {} | {} | ≥ {:.0f} % |\n", s.faults,
                      share(s.faults_right, s.faults), suite.faults);
  text += fmt::format("| out of the library: the place right, of {} | {} | |\n", s.outside, share(s.placed, s.outside));
  text += fmt::format("| gap on held-back data below 1.5, of {} in the library | {} | all |\n", s.named,
                      share(s.low, s.named));
  if (s.failed > 0) text += fmt::format("\n{} failed\n", counted(s.failed, "trial"));
  return text + fmt::format("\n{}, {:.0f} s of work\n", counted(all.size(), "trial"), s.seconds);
}

std::string confusion_table(const std::vector<Outcome>& all) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Outcome& o : all) {
    const std::string column = o.score == 1.0  ? "right"
                               : o.score > 0.0 ? "half"
                                               : o.said.substr(0, o.said.find_first_of(";:"));
    ++counts[row_of(o)][column.starts_with("found") ? "another" : column];
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

std::string trials_table(const std::vector<Outcome>& all) {
  std::string text =
      "| # | bridge | sensors | noise % | true bridge | hidden | trace | said | score | gap before | after | held back "
      "|\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Outcome& o : all)
    text += fmt::format("| {} | {} | {} | {:g} | {} | {} | {} | {} | {:.2g}{} | {:.2f} | {:.2f} | {:.2f} |\n", o.number,
                        o.trial->bridge, o.trial->sensors, 100.0 * o.trial->noise, truth_text(*o.trial),
                        hidden_text(*o.trial, o.effects), o.trace >= 0.0 ? fmt::format("{:.0f}", o.trace) : "-", o.said,
                        o.score, o.wrong ? " (confident and wrong)" : "", o.gap_before, o.gap_after, o.held_back);
  return text;
}

}  // namespace voussoir
