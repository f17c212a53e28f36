#include "tools/diagnosis/diagnosis_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/effects/effect.h"
#include "tools/diagnosis/detection_report.h"
#include "tools/diagnosis/diagnosis_charts.h"
#include "tools/diagnosis/diagnosis_values.h"
#include "tools/diagnosis/measured_features.h"
#include "tools/diagnosis/recorded_charts.h"
#include "tools/diagnosis/three_sentences.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

// What was found, in sentences.

std::string verdict_box(const DiagnosisResult& result) {
  const ThreeSentences said = three_sentences(result);
  std::string text;
  const auto sentence = [&](const char* head, const std::string& words) {
    text += fmt::format("<p><strong>{}</strong> {}</p>\n", head, escaped(words));
  };
  using Verdict = Diagnosis::Verdict;
  const Verdict verdict = result.diagnosis.verdict;
  sentence(verdict == Verdict::found        ? "Found."
           : verdict == Verdict::consistent ? "Consistent."
                                            : "Unexplained.",
           said.found);
  sentence("Certainty.", said.sure);
  sentence("Next step on site.", said.next);
  return fmt::format("<div class=\"verdict {}\">\n{}</div>\n", verdict_name(verdict), text);
}

std::string facts(const DiagnosisInput& input, const DiagnosisResult& result) {
  std::string text = "<dl>\n";
  const auto fact = [&](const char* name, const std::string& words) {
    if (!words.empty()) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escaped(words));
  };
  const Measured& m = input.measured;
  fact("case", std::filesystem::path(input.c.path).filename().string());
  fact("measured", m.what);
  fact("when", m.when);
  fact("notes", m.notes);
  for (const Note& note : m.more) fact(escaped(note.key).c_str(), note.text);
  fact("folder", m.directory);
  const auto held = std::size_t(
      std::count_if(result.modes.begin(), result.modes.end(), [](const auto& mode) { return mode.held_back; }));
  fact("data", fmt::format("{} at {}{}", counted(result.modes.size(), "mode"), sensors_used(input.problem.features),
                           held ? fmt::format("; {} held back, to be predicted", held) : std::string()));
  return text + "</dl>\n";
}

std::string gap_section(const DiagnosisResult& result) {
  const std::vector<GapRow> rows = gap_rows(result);
  std::string text = "<p>Gap ";
  for (const GapRow& row : rows)
    text += fmt::format("{}of {}: <strong>{}</strong> before → {} with fitted materials → <strong>{}</strong> after",
                        &row == &rows.front() ? "" : "; ", row.data, gap_text(row.before), gap_text(row.materials),
                        gap_text(row.after));
  text += ".</p>\n";
  text += note(
      "The gap is the root mean square residual, in standard deviations of measurement and model together. A gap of "
      "about 1 is noise. “Modes left out”: each mode in turn is predicted from the others.");
  return text + figure(gap_chart(rows));
}

// The modes.

std::string unpaired_note(const std::vector<ModeComparison>& modes) {
  const bool any = std::any_of(modes.begin(), modes.end(), [](const auto& m) { return m.before <= 0 || m.after <= 0; });
  return any ? note("“none”: no computed mode is like the measured one. It counts as 5 standard deviations.")
             : std::string();
}

std::string modes_section(const std::vector<ModeComparison>& modes) {
  std::string text = heading("Periods and frequencies") + figure(periods_chart(modes)) + unpaired_note(modes);
  text += heading("Residuals of the frequencies");
  text += note(
      "Measured minus computed frequency, divided by the standard deviation of measurement and model together. Grey: ± "
      "2.");
  return text + figure(deviations_chart(modes));
}

std::string scale_key() {
  SvgDrawing key(210.0, 18.0, "Colour scale of the modal assurance criterion");
  for (int i = 0; i < 21; ++i)
    key.rectangle(10.0 * i, 0.0, 10.3, 18.0, {colour_code(scale_colour(0.05 * i)), "none", 1.0, ""});
  return fmt::format(
      "<div class=\"key\"><span>MAC 0</span>{}<span>1; framed: the pair of modes that is compared</span></div>\n",
      key.finished());
}

std::string shapes_section(const DiagnosisInput& input, const DiagnosisResult& result) {
  const std::string partners = assurance_chart(result.modes), matrix = assurance_matrix(input, result);
  if (partners.empty() && matrix.empty())
    return heading("Shapes") + paragraph("No mode shapes were measured. Modes are paired by direction and order.");
  std::string text = heading("Mode shapes: modal assurance criterion (MAC)") + figure(partners);
  if (!matrix.empty()) text += fmt::format("{}{}", figure(matrix), scale_key());
  std::string charts;
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const std::string chart = shape_chart(input, result, m);
    if (chart.empty()) continue;
    const ModeComparison& mode = result.modes[m];
    const auto mac = [](double x) { return std::isfinite(x) ? fmt::format("{:.2f}", x) : std::string("none"); };
    charts += fmt::format(
        "<figure><figcaption><strong>{}</strong>, {}{}; MAC {} → {}</figcaption><div class=\"wide\">{}"
        "</div></figure>\n",
        escaped(mode_title(mode)), escaped(mode_motion(mode)), mode.held_back ? ", held back" : "",
        mac(mode.mac_before), mac(mode.mac_after), chart);
  }
  if (charts.empty()) return text;
  text += heading("Mode shapes at the sensors");
  text += note(
      "Black circles: measured, with ± 2 standard deviations of the measurement; the largest component is 1. Blue "
      "triangles: the corrected case. Small hollow squares: the case as it is. Computed shapes are scaled for the best "
      "fit. The sensors of each axis are in order of their position along the bridge.");
  return text + fmt::format("<div class=\"many\">\n{}</div>\n", charts);
}

std::string where_section(const DiagnosisResult& result) {
  const std::string chart = where_chart(result.where, result.where_after);
  std::string text = heading("Where the model disagrees with the measurements");
  if (chart.empty())
    return text +
           paragraph("No disagreement could be located, because no measured mode is paired with a computed mode.");
  text += note(
      "The share of each part in the strain energy of the displacements that would correct the computed shapes of the "
      "measured modes. In brackets: the axis along which the residual force does most work. The size of the correction "
      "is this energy divided by the strain energy of the modes: 1 % is about 10 % of the squared frequency. Where the "
      "size is small, the shares are noise.");
  return text + figure(chart);
}

// Candidates.

std::string help_of(const Candidate& c) {
  return c.kind == Candidate::Kind::factor ? std::string() : find_effect(c.name).help;
}

Cell candidate_cell(const Candidate& c) {
  const std::string help = help_of(c);
  return {help.empty() ? escaped(c.full_text())
                       : fmt::format("{}<br><span class=\"note\">{}</span>", escaped(c.full_text()), escaped(help))};
}

Cell parameters_cell(const Fit& fit, std::size_t index) {
  std::string html;
  for (const FittedValue& v : fitted_values(fit, index)) html += (html.empty() ? "" : "<br>") + escaped(v.text());
  return {html};
}

std::string trials_table(const Round& round, const Fit& current) {
  std::string text = "<table>\n" + table_row({{"candidate"},
                                              {"probability", true},
                                              {"prior", true},
                                              {"log evidence<br>above none", true},
                                              {"gap", true},
                                              {"predicted<br>gap", true},
                                              {"collinear with<br>the best", true},
                                              {"parameters"}},
                                             "th");
  for (std::size_t i = 0; i < round.trials.size(); ++i) {
    const Trial& t = round.trials[i];
    const bool added = i == 0 && round.accepted;
    const std::string mark = added ? " (added)" : t.tie ? " (tie)" : "";
    text += table_row({candidate_cell(t.candidate),
                       {escaped(probability_text(t.probability)) + mark, true},
                       {fmt::format("{:.2g}", t.candidate.prior), true},
                       signed_cell(t.fit.log_evidence - current.log_evidence),
                       number_cell(t.fit.gap),
                       number_cell(t.fit.predicted_gap),
                       number_cell(t.signature, "-"),
                       parameters_cell(t.fit, t.fit.hypothesis.effects.size() - 1)},
                      "td", added ? "best" : "");
  }
  text += table_row({{"none of them"},
                     {probability_text(round.none), true},
                     {"1", true},
                     {"0", true},
                     number_cell(current.gap),
                     number_cell(current.predicted_gap),
                     {"", true},
                     {""}},
                    "td");
  return text + "</table>\n";
}

std::string screening_table(const Round& round) {
  if (round.screened.empty()) return "";
  std::string text = fmt::format(
      "<details><summary>All {} screened, with the share of the misfit that each could remove</summary>\n<table>\n",
      counted(round.screened.size(), "candidate"));
  text += table_row({{"candidate"}, {"explains", true}}, "th");
  for (const auto& [name, explained] : round.screened)
    text += table_row({words_cell(name), {fmt::format("{:.0f} %", 100.0 * explained), true}}, "td");
  return text + "</table>\n</details>\n";
}

std::string not_fitted(const Round& round) {
  std::string text;
  for (const auto& [name, why] : round.not_fitted)
    text += note(fmt::format("{} could not be fitted: {}", name, with_full_stop(why)));
  return text;
}

std::string round_section(const Round& round, const Fit& current, std::size_t index) {
  std::string text = fmt::format(
      "<h3>Round {}: {}</h3>\n", index + 1,
      round.accepted ? escaped(plain_name(round.trials[0].candidate)) + " is added" : std::string("nothing is added"));
  return text + figure(probability_chart(round)) + trials_table(round, current) + not_fitted(round) +
         screening_table(round);
}

std::string candidates_section(const Diagnosis& d) {
  std::string text = heading("Candidates");
  if (d.rounds.empty())
    return text +
           paragraph("None was tried. With its materials in their likely range, the case explains the measurements.");
  text += note(
      "Each candidate is fitted together with the materials. The probabilities follow from the evidence (the quality "
      "of the fit, minus the cost of its freedom) and from how often such an effect occurs. “None of them” is the "
      "model without a further effect. Collinearity 1: these sensors cannot distinguish the two candidates. A tie is "
      "at least a fifth as probable as the best candidate.");
  const Fit* current = &d.calibrated;
  for (std::size_t i = 0; i < d.rounds.size(); ++i) {
    text += round_section(d.rounds[i], *current, i);
    if (d.rounds[i].accepted) current = &d.rounds[i].trials[0].fit;
  }
  return text;
}

/// What is left when no effect has a name: factors on parts, and springs to the ground.
std::string nameless_section(const Diagnosis& d) {
  if (d.verdict != Diagnosis::Verdict::unexplained) return "";
  std::string text = heading("Where stiffness or mass is missing (cause unknown)");
  const Fit& fit = d.nameless_best;
  if (fit.hypothesis.effects.empty())
    return text + paragraph(
                      "A factor on the stiffness or mass of a part, or a spring to the ground, does not improve the "
                      "model either.");
  const std::vector<const Round*> rounds = accepted_rounds(d.nameless);
  text += "<table>\n" + table_row({{"part"}, {"quantity"}, {"value", true}, {"probability", true}}, "th");
  for (std::size_t i = 0; i < fit.hypothesis.effects.size(); ++i) {
    const FittedValue value = fitted_values(fit, i).front();
    const std::string unit = value.name == "factor" ? "×" : value.unit, bound = value.at_bound ? " (at its bound)" : "";
    text += table_row({words_cell(fit.hypothesis.effects[i].where),
                       words_cell(fit.hypothesis.effects[i].name),
                       {fmt::format("{} {}{}", with_std(value.value, value.std), unit, bound), true},
                       {i < rounds.size() ? probability_text(rounds[i]->trials[0].probability) : std::string(), true}},
                      "td");
  }
  text += fmt::format("</table>\n<p>Gap with these: {:.2f}.</p>\n", fit.gap);
  return text + note("A factor above 1 means that the bridge has more stiffness or mass than the model.");
}

std::string materials_section(const Diagnosis& d) {
  const std::string chart = materials_chart(d);
  if (chart.empty()) return "";
  std::string text = heading("Fitted materials") + figure(chart);
  text += note(
      "Bands: one and two standard deviations of the likely range. “Likely” gives the factors at two standard "
      "deviations. Bars: one standard deviation after the fit.");
  if (d.alarms.empty()) return text + paragraph("Fitted without effects, all materials stay in their likely range.");
  text += paragraph(
      "Fitted without effects, these materials leave their likely range. They compensate for something that the model "
      "lacks.");
  return text + list(d.alarms);
}

// The rest.

std::string advice_section(const Diagnosis& d) {
  if (d.advice.empty()) return "";
  std::string text = heading("Measurements that would distinguish the candidates") + "<ul>\n";
  for (const Advice& a : d.advice)
    text += fmt::format("<li>from <strong>{}</strong>: {}</li>\n", escaped(a.against), escaped(a.text));
  return text + "</ul>\n";
}

std::string model_error_text(const DiagnosisInput& input) {
  std::string text = fmt::format(
      "The program assumes that a correct model is accurate to {:.1f} % of frequencies and to {:.1f} % of the largest "
      "component of a shape.",
      100.0 * input.problem.error.frequency, 100.0 * input.problem.error.shape);
  if (input.problem.mesh.scatter > 0.0 || input.problem.mesh.shift != 0.0)
    text += fmt::format(
        " Blocks 1.25 times as large shift all frequencies by {:+.1f} % on average, scatter them by {:.1f} % and "
        "change shapes by {:.1f} %.",
        100.0 * input.problem.mesh.shift, 100.0 * input.problem.mesh.scatter, 100.0 * input.problem.mesh.shape);
  return text;
}

/// Runs of the explicit solver against the recording.
std::string recorded_section(const DiagnosisInput& input, const DiagnosisResult& result) {
  if (!result.recorded) return "";
  const RecordedMatch& m = *result.recorded;
  std::string text = heading("Response to the recorded ground motion");
  text += paragraph(
      fmt::format("The explicit solver computed the response to {:.1f} s of {}, from {:.1f} s on. It started from rest "
                  "under gravity and used the mesh of the search ({:.0f} s of computing). Below {:.1f} Hz, computed "
                  "accelerations differ from the recorded ones by {:.0f} % of these before and by {:.0f} % after. "
                  "Transfer functions differ by {:.1f} standard deviations before and by {:.1f} after.",
                  m.duration, m.record, m.from, m.seconds, m.highest_frequency, 100.0 * m.error_before,
                  100.0 * m.error_after, m.transfer_before, m.transfer_after));
  text += figure(transfer_chart(input, m));
  text += note(
      "Acceleration of a sensor divided by the ground acceleration along its axis. Grey: two standard deviations of "
      "the measured transfer function. All three are estimated in the same way.");
  text += figure(history_chart(input, m));
  text += "<table>\n" +
          table_row({{"channel"}, {"rms, m/s²", true}, {"difference before, %", true}, {"after, %", true}}, "th");
  for (const ChannelMatch& c : m.channels)
    text += table_row({words_cell(c.channel),
                       {fmt::format("{:.3g}", c.size), true},
                       {fmt::format("{:.0f}", 100.0 * c.error_before), true},
                       {fmt::format("{:.0f}", 100.0 * c.error_after), true}},
                      "td");
  return text + "</table>\n" +
         note(
             "The difference is its root mean square divided by that of the recording. A resonant response with a "
             "small time shift differs by as much as the response itself.");
}

std::string identification_section(const DiagnosisInput& input) {
  if (!input.identification.ambient) return "";
  return heading("Modes identified from the recordings") +
         figure(stabilisation_chart(*input.identification.ambient, *input.identification.spectra)) +
         note(
             "Stochastic subspace identification. Full circle: a stable pole, whose frequency, damping and shape agree "
             "with those of the previous model order. Small square: any other pole. Lines mark the identified modes. "
             "The curve is the first singular value of the spectra (frequency-domain decomposition), on its own "
             "scale.");
}

std::string data_section(const DiagnosisInput& input) {
  std::string text = heading("Data and model error") + paragraph(model_error_text(input));
  if (!input.without.empty())
    text += paragraph(fmt::format("Effects left out at the request of the user: {}.", fmt::join(input.without, ", ")));
  std::vector<std::string> items;
  for (const SetAside& s : input.measured.set_aside) items.push_back(fmt::format("set aside: {}: {}", s.place, s.what));
  for (const std::string& remark : input.measured.remarks) items.push_back(fmt::format("remark: {}", remark));
  return items.empty() ? text : text + list(items);
}

std::string corrected_section(const DiagnosisInput& input, const DiagnosisResult& result) {
  const std::string& all = result.corrected_text;
  const std::size_t own = all.starts_with(input.c.text) ? input.c.text.size() : all.size();
  std::string text = heading("The corrected case, corrected.toml");
  text += fmt::format("<pre>{}", escaped(std::string_view(all).substr(0, own)));
  if (own < all.size())
    text += fmt::format("<span class=\"added\">{}</span>", escaped(std::string_view(all).substr(own)));
  return text + "</pre>\n";
}

}  // namespace

std::string diagnosis_page(const DiagnosisInput& input, const DiagnosisResult& result,
                           const std::vector<PagePicture>& pictures) {
  const Diagnosis& d = result.diagnosis;
  const std::string name = std::filesystem::path(input.c.path).stem().string();
  std::string page = verdict_box(result) + gap_section(result) + facts(input, result);
  page += modes_section(result.modes) + shapes_section(input, result) + recorded_section(input, result);
  page += where_section(result);
  page += nameless_section(d) + candidates_section(d) + materials_section(d) + advice_section(d);
  page += detection_section(d.detection, "Effects that these data could have shown");
  page += pictures_section(pictures) + identification_section(input) + data_section(input) +
          corrected_section(input, result);
  return html_page(fmt::format("Diagnosis of {}", name), page);
}

}  // namespace voussoir
