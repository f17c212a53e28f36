#include "tools/diagnosis/diagnosis_report.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/diagnosis/detection_report.h"
#include "tools/diagnosis/diagnosis_values.h"
#include "tools/diagnosis/three_sentences.h"

namespace voussoir {

namespace {

using nlohmann::json;

/// Value and standard deviation of a parameter from those of x.
json parameter_json(const FitParameter& p, double x, double std) {
  const double value = p.value(x), spread = 0.5 * (p.value(x + std) - p.value(x - std));
  return {{"value", value}, {"std", spread}, {"unit", p.unit}};
}

json parameters_json(const Fit& fit, std::size_t index) {
  json parameters = json::object();
  for (const FittedValue& v : fitted_values(fit, index))
    parameters[v.name] = {{"value", v.value}, {"std", v.std}, {"unit", v.unit}};
  return parameters;
}

json effect_json(const Fit& fit, std::size_t index, double probability) {
  const Candidate& c = fit.hypothesis.effects[index];
  return {
      {"name", c.name}, {"where", c.where}, {"parameters", parameters_json(fit, index)}, {"probability", probability}};
}

json trial_json(const Trial& trial) {
  json j = effect_json(trial.fit, trial.fit.hypothesis.effects.size() - 1, trial.probability);
  j["log_evidence"] = trial.fit.log_evidence;
  j["gap"] = trial.fit.gap;
  j["predicted_gap"] = trial.fit.predicted_gap;
  j["collinearity"] = trial.signature;
  j["tie"] = trial.tie;
  return j;
}

json materials_json(const Fit& fit, const Fit& corrected) {
  json all = json::object();
  for (std::size_t i = 0; i < fit.hypothesis.materials.size(); ++i) {
    const auto at = Eigen::Index(i);
    all[fit.hypothesis.materials[i].parameter.name] =
        parameter_json(fit.hypothesis.materials[i].parameter, fit.best.x[at], fit.std[at]);
    all[fit.hypothesis.materials[i].parameter.name]["corrected"] =
        corrected.hypothesis.materials[i].parameter.value(corrected.best.x[at]);
  }
  return all;
}

json rounds_json(const std::vector<Round>& rounds) {
  json all = json::array();
  for (const Round& round : rounds) {
    json j = {{"none", round.none},
              {"accepted", round.accepted},
              {"superseded", round.superseded},
              {"trials", json::array()}};
    for (const Trial& trial : round.trials) j["trials"].push_back(trial_json(trial));
    for (const auto& [name, explained] : round.screened)
      j["screened"].push_back({{"candidate", name}, {"explains", explained}});
    for (const auto& [name, why] : round.not_fitted) j["not_fitted"].push_back({{"candidate", name}, {"why", why}});
    all.push_back(j);
  }
  return all;
}

json where_json(const Location& location) {
  json all = json::array();
  for (const PartResidual& p : location.parts)
    all.push_back({{"part", p.part}, {"share", p.share}, {"axis", std::string(1, p.axis)}});
  return all;
}

/// Rounds whose effects are named: where effects do not explain enough, those of channels that were set right.
std::vector<Round> named_rounds(const Diagnosis& d) {
  std::vector<Round> rounds = d.rounds;
  if (d.verdict == Diagnosis::Verdict::unexplained) std::erase_if(rounds, [](const Round& r) { return !r.accepted; });
  return rounds;
}

/// The best explanation that was not chosen, in the round of the last effect.
json runner_up_json(const Diagnosis& d) {
  for (auto round = d.rounds.rbegin(); round != d.rounds.rend(); ++round) {
    const std::size_t next = round->accepted ? 1 : 0;
    if (round->trials.size() > next && (round->accepted || d.best.hypothesis.effects.empty()) &&
        d.verdict != Diagnosis::Verdict::unexplained)
      return trial_json(round->trials[next]);
  }
  return nullptr;
}

json ties_json(const Diagnosis& d) {
  json all = json::array();
  for (const Round& round : named_rounds(d))
    if (round.accepted)
      for (const Trial& trial : round.trials)
        if (trial.tie) all.push_back(trial_json(trial));
  return all;
}

/// d ln f/d ln k and d ln f/d ln m of each part of the bridge, in the case as it is.
void add_sensitivities(const Evaluation& e, json& modes) {
  for (std::size_t m = 0; m < e.pairing.computed.size(); ++m) {
    if (e.pairing.computed[m] < 0) continue;
    for (const PartSensitivity& s : sensitivities(e, e.pairing.computed[m]))
      modes[m]["sensitivity"][s.part] = {{"stiffness", s.stiffness}, {"mass", s.mass}};
  }
}

double period(const Evaluation& e, int computed) {
  return computed < 0 ? 0.0 : std::exp(-e.response.log_frequency[computed]);
}

std::string words(const Evaluation& e, int computed) {
  return computed < 0 ? "none" : e.response.words[std::size_t(computed)].text();
}

/// Of periods in s, in Hz; null where there is none.
json frequencies_json(const ModeComparison& m) {
  const auto hertz = [](double t) { return t > 0.0 ? json(1.0 / t) : json(nullptr); };
  return {{"measured", hertz(m.measured)},
          {"std", m.std / (m.measured * m.measured)},
          {"before", hertz(m.before)},
          {"after", hertz(m.after)}};
}

json about_json(const Measured& m) {
  json more = json::object();
  for (const Note& note : m.more) more[note.key] = note.text;
  return {{"what", m.what}, {"when", m.when}, {"notes", m.notes}, {"more", more}};
}

json recorded_json(const RecordedMatch& m) {
  json j = {{"record", m.record},
            {"from", m.from},
            {"duration", m.duration},
            {"error", {{"before", m.error_before}, {"after", m.error_after}}},
            {"transfer_functions", {{"before", m.transfer_before}, {"after", m.transfer_after}}},
            {"channels", json::array()},
            {"seconds", m.seconds}};
  for (const ChannelMatch& c : m.channels)
    j["channels"].push_back(
        {{"channel", c.channel}, {"size", c.size}, {"before", c.error_before}, {"after", c.error_after}});
  return j;
}

}  // namespace

std::vector<ModeComparison> compare_modes(const DiagnosisProblem& problem, const Fit& before,
                                          const DiagnosisProblem& judged, const Fit& after) {
  const std::vector<ResidualRow> rows = residual_rows(problem);
  std::vector<ModeComparison> all;
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const MeasuredFeature& mode = problem.features.modes[m];
    ModeComparison c;
    c.name = mode.name;
    c.direction = mode.direction;
    c.held_back = mode.held_back;
    c.measured = 1.0 / mode.frequency;
    c.std = c.measured * mode.frequency_std;
    const int b = before.best.pairing.computed[m], a = after.best.pairing.computed[m];
    c.before = period(before.best, b), c.after = period(after.best, a);
    c.mac_before = before.best.pairing.assurance[m], c.mac_after = after.best.pairing.assurance[m];
    c.words_before = words(before.best, b), c.words_after = words(after.best, a);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].mode == int(m) && rows[i].kind == ResidualRow::Kind::frequency) {
        c.deviations_before = before.best.differences[Eigen::Index(i)] / problem.covariance.std[Eigen::Index(i)];
        c.deviations_after = after.best.differences[Eigen::Index(i)] / judged.covariance.std[Eigen::Index(i)];
      }
    all.push_back(c);
  }
  return all;
}

nlohmann::json diagnosis_json(const DiagnosisInput& input, const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  json j;
  j["verdict"] = verdict_name(d.verdict);
  const ThreeSentences said = three_sentences(result);
  j["summary"] = {{"found", said.found}, {"how_sure", said.sure}, {"next_on_site", said.next}};
  j["effects"] = json::array();
  std::size_t index = 0;
  for (const Round& round : named_rounds(d))
    if (round.accepted) {
      j["effects"].push_back(effect_json(d.best, index, round.trials[0].probability));
      ++index;
    }
  j["runner_up"] = runner_up_json(d);
  j["ties"] = ties_json(d);
  j["gap"]["fit"] = {{"before", result.before.gap}, {"after", result.after.gap}};
  const bool held = std::any_of(result.modes.begin(), result.modes.end(), [](const auto& m) { return m.held_back; });
  // Without modes that were kept out: each mode as the others predict it.
  j["gap"]["held_back"] =
      held ? json{{"before", result.before.held_gap}, {"after", result.after.held_gap}, {"by", "modes held back"}}
           : json{{"before", result.before.gap},
                  {"after", d.best.predicted_gap},
                  {"by", "leaving each mode out in turn"}};
  j["gap"]["materials_only"] = {{"fit", d.calibrated.gap}, {"held_back", d.calibrated.predicted_gap}};
  j["where"] = where_json(result.where);
  j["where_after"] = where_json(result.where_after);
  j["alarms"] = d.alarms;
  j["materials"] = materials_json(d.best, result.calibrated);
  j["advice"] = json::array();
  for (const Advice& a : d.advice) j["advice"].push_back({{"against", a.against}, {"would_tell", a.text}});
  for (const ModeComparison& m : result.modes)
    j["modes"].push_back({{"mode", m.name},
                          {"direction", m.direction},
                          {"held_back", m.held_back},
                          {"measured", m.measured},
                          {"std", m.std},
                          {"before", m.before},
                          {"after", m.after},
                          {"frequency", frequencies_json(m)},
                          {"deviations_before", m.deviations_before},
                          {"deviations_after", m.deviations_after},
                          {"mac_before", number(m.mac_before)},
                          {"mac_after", number(m.mac_after)},
                          {"computed_before", m.words_before},
                          {"computed_after", m.words_after}});
  add_sensitivities(result.before.best, j["modes"]);
  j["rounds"] = rounds_json(d.rounds);
  if (d.verdict == Diagnosis::Verdict::unexplained) {
    j["nameless"] = json::array();
    std::size_t at = 0;
    for (const Round& round : d.nameless)
      if (round.accepted) {
        j["nameless"].push_back(effect_json(d.nameless_best, at, round.trials[0].probability));
        ++at;
      }
    j["gap"]["nameless"] = d.nameless_best.gap;
  }
  j["about"] = about_json(input.measured);
  for (const SetAside& s : input.measured.set_aside) j["set_aside"].push_back({{"place", s.place}, {"what", s.what}});
  j["remarks"] = input.measured.remarks;
  j["model_error"] = {{"frequency", input.problem.error.frequency},
                      {"shape", input.problem.error.shape},
                      {"mesh_shift", input.problem.mesh.shift},
                      {"mesh_scatter", input.problem.mesh.scatter}};
  j["model_error"]["scale"] = d.best.scale.structure;
  j["model_error"]["scale_of_shapes"] = d.best.scale.shapes;
  for (const Sensitivity& n : d.judged.covariance.nuisances)
    j["model_error"]["not_exactly_known"].push_back(
        {{"name", n.name}, {"unit", n.unit}, {"std", n.spread}, {"left_out", n.why}});
  add_detection(d.detection, j);
  if (result.recorded) j["recorded"] = recorded_json(*result.recorded);
  j["without"] = input.without;
  j["seconds"] = d.seconds;
  return j;
}

std::string diagnosis_text(const DiagnosisInput& input, const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  std::string text =
      fmt::format("{:>6} {:>12} {:>9} {:>7} {:>8} {:>7} {:>9} {:>8} {:>6} {:>9} {:>8} {:>6} {:>5}  computed\n", "mode",
                  "direction", "measured", "±", "", "±", "before", "", "", "after", "", "", "MAC");
  text += fmt::format("{:>6} {:>12} {:>9} {:>7} {:>8} {:>7} {:>9} {:>8} {:>6} {:>9} {:>8} {:>6}\n", "", "", "s", "s",
                      "Hz", "Hz", "s", "Hz", "%", "s", "Hz", "%");
  for (const ModeComparison& m : result.modes) {
    const auto columns = [&](double t) {
      if (!(t > 0.0)) return fmt::format("{:>9} {:>8} {:>6}", "-", "-", "-");
      return fmt::format("{:>9.4f} {:>8.3f} {:>+6.1f}", t, 1.0 / t, 100.0 * (t / m.measured - 1.0));
    };
    text += fmt::format("{:>6} {:>12} {:>9.4f} {:>7.4f} {:>8.3f} {:>7.3f} {} {} {:>5}  {}{}\n", m.name,
                        m.direction.empty() ? "-" : m.direction, m.measured, m.std, 1.0 / m.measured,
                        m.std / (m.measured * m.measured), columns(m.before), columns(m.after),
                        std::isfinite(m.mac_after) ? fmt::format("{:.2f}", m.mac_after) : "-", m.words_after,
                        m.held_back ? " (held back)" : "");
  }
  text += "where the case disagrees:";
  for (std::size_t i = 0; i < std::min<std::size_t>(4, result.where.parts.size()); ++i)
    text += fmt::format("{} {} {:.0f} % ({})", i ? "," : "", result.where.parts[i].part,
                        100.0 * result.where.parts[i].share, result.where.parts[i].axis);
  text += "\n";
  for (const std::string& alarm : d.alarms) text += fmt::format("compensation: {}\n", alarm);
  text += fmt::format("verdict: {}\n", verdict_name(d.verdict));
  const ThreeSentences said = three_sentences(result);
  text += fmt::format("{}\n{}\n{}\n", said.found, said.sure, said.next);
  std::size_t index = 0;
  for (const Round& round : named_rounds(d)) {
    if (!round.accepted) continue;
    const Trial& best = round.trials[0];
    text += fmt::format("  {} (probability {:.2f})", best.candidate.full_text(), best.probability);
    const json parameters = parameters_json(d.best, index);
    for (const auto& [name, p] : parameters.items())
      text += fmt::format(", {} {:.3g} ± {:.2g}", name, p["value"].get<double>(), p["std"].get<double>());
    text += "\n";
    for (const Trial& trial : round.trials)
      if (trial.tie)
        text += fmt::format("    tie with {} (probability {:.2f})\n", trial.candidate.full_text(), trial.probability);
    ++index;
  }
  if (d.verdict == Diagnosis::Verdict::unexplained)
    for (std::size_t i = 0; i < d.nameless_best.hypothesis.effects.size(); ++i)
      text += fmt::format("  {} (cause unknown)\n", nameless_text(d.nameless_best, i));
  for (const Advice& a : d.advice) text += fmt::format("to distinguish it from {}: {}\n", a.against, a.text);
  text += detection_text(d.detection);
  for (const SetAside& s : input.measured.set_aside) text += fmt::format("set aside: {}: {}\n", s.place, s.what);
  for (const std::string& remark : input.measured.remarks) text += fmt::format("remark: {}\n", remark);
  if (const auto& m = result.recorded)
    text += fmt::format(
        "response to {:.1f} s of {}: accelerations differ by {:.0f} % before, {:.0f} % after; transfer functions by "
        "{:.1f} and {:.1f} standard deviations\n",
        m->duration, m->record, 100.0 * m->error_before, 100.0 * m->error_after, m->transfer_before, m->transfer_after);
  text += fmt::format("gap: {:.2f} before, {:.2f} with fitted materials, {:.2f} after; predicted {:.2f} ({:.1f} s)\n",
                      result.before.gap, d.calibrated.gap, result.after.gap, d.best.predicted_gap, d.seconds);
  return text;
}

}  // namespace voussoir
