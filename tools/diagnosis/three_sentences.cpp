#include "tools/diagnosis/three_sentences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tools/diagnosis/diagnosis_values.h"

namespace voussoir {

namespace {

ThreeSentences of_found(const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  const std::vector<const Round*> rounds = accepted_rounds(d.rounds);
  std::vector<std::string> what, sure, ties, next;
  for (std::size_t i = 0; i < std::min(rounds.size(), d.best.hypothesis.effects.size()); ++i) {
    const Candidate& c = d.best.hypothesis.effects[i];
    const std::string values = fitted_text(d.best, i);
    const Effect& effect = find_effect(c.name);
    what.push_back(fmt::format("{} ({}{}{})", effect.help, plain_name(c), values.empty() ? "" : ": ", values));
    sure.push_back(probability_text(rounds[i]->trials[0].probability));
    for (const Trial& trial : rounds[i]->trials)
      if (trial.tie)
        ties.push_back(
            fmt::format("{} (probability {})", plain_name(trial.candidate), probability_text(trial.probability)));
    if (std::find(next.begin(), next.end(), effect.on_site) == next.end()) next.push_back(effect.on_site);
  }
  ThreeSentences s;
  s.found = fmt::format("The following is missing from the case: {}.", fmt::join(what, "; and "));
  s.sure = fmt::format("{} {}. The gap falls from {} to {} (1 is noise)",
                       what.size() == 1 ? "The probability of this explanation among all candidates tried is"
                                        : "The probabilities of these explanations among all candidates tried are",
                       fmt::join(sure, " and "), gap_text(result.before.gap), gap_text(result.after.gap));
  s.sure +=
      ties.empty() ? "." : fmt::format(". These measurements cannot distinguish it from {}.", fmt::join(ties, ", "));
  s.next = fmt::format("{}", fmt::join(next, " "));
  for (const Advice& a : d.advice) s.next += fmt::format(" To distinguish it from {}: {}.", a.against, a.text);
  return s;
}

/// The largest least amount of an effect over its places that are one support or one part; empty where one place has
/// no least amount.
std::string at_worst(const std::vector<Detectable>& all, const std::string& name, const std::string& place,
                     const std::string& words) {
  double worst = 0.0;
  std::string unit;
  for (const Detectable& d : all) {
    if (d.name != name || !d.where.starts_with(place)) continue;
    if (!std::isfinite(d.above)) return "";
    worst = std::max(worst, d.above), unit = d.unit;
  }
  if (worst == 0.0) return "";
  return fmt::format("{} above {:.2g}{}", words, worst, unit == "-" ? "" : " " + unit);
}

/// The best further sensor and the best further mode.
std::string next_measurements(const Detection& d) {
  std::vector<std::string> best;
  for (const bool sensor : {true, false}) {
    const auto first =
        std::find_if(d.further.begin(), d.further.end(), [&](const Addition& a) { return a.sensor.empty() != sensor; });
    if (first != d.further.end()) best.push_back(first->text);
  }
  return best.empty() ? "" : fmt::format(" Further measurements that would show more: {}.", fmt::join(best, "; or "));
}

ThreeSentences of_consistent(const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  ThreeSentences s;
  s.found = fmt::format(
      "The measurements agree with {} within the uncertainties of measurement and model. They do not show that an "
      "effect is missing.",
      d.calibrated.gap < 0.9 * d.plain.gap ? "the case with its materials adjusted in their likely range"
                                           : "the case as it is");
  std::vector<std::string> seen;
  for (const std::string& text :
       {at_worst(d.detection.least, "abutment_restraint", "both", "a restraint of both abutments"),
        at_worst(d.detection.least, "scour", "pier", "a share of bearing lost at any pier"),
        at_worst(d.detection.least, "added_mass", "deck", "added mass"),
        at_worst(d.detection.least, "tie_rods", "all", "stiffness of tie rods")})
    if (!text.empty()) seen.push_back(text);
  const auto hidden = std::count_if(d.detection.least.begin(), d.detection.least.end(), [](const Detectable& least) {
    return !std::isfinite(least.below) && !std::isfinite(least.above);
  });
  s.sure = seen.empty()
               ? std::string("The table of least amounts gives what they would have shown with a probability of 0.9.")
               : fmt::format(
                     "With a probability of 0.9 they would have shown {}. The table of least amounts gives the others.",
                     fmt::join(seen, ", "));
  s.next = hidden > 0 ? fmt::format(
                            "The measurements give no reason to inspect the bridge. They could not show {} of {} "
                            "effects and places at any amount, so inspect these by eye.",
                            hidden, d.detection.least.size())
                      : std::string("The measurements give no reason to inspect the bridge.");
  s.next += next_measurements(d.detection);
  return s;
}

ThreeSentences of_unexplained(const DiagnosisResult& result) {
  const Diagnosis& d = result.diagnosis;
  ThreeSentences s;
  s.found =
      "The case and the measurements disagree by more than their errors, and no effect of the library explains the "
      "difference.";
  s.sure = fmt::format("The gap is {} before and {} with fitted materials (1 is noise).", gap_text(result.before.gap),
                       gap_text(d.calibrated.gap));
  std::vector<std::string> asked, parts;
  for (std::size_t i = 0; i < d.nameless_best.hypothesis.effects.size(); ++i)
    asked.push_back(nameless_text(d.nameless_best, i));
  for (std::size_t i = 0; i < std::min<std::size_t>(3, result.where_after.parts.size()); ++i)
    parts.push_back(result.where_after.parts[i].part);
  if (asked.empty() && parts.empty())
    s.next = "Check the measurements and the dimensions of the case.";
  else
    s.next = asked.empty()
                 ? fmt::format("Inspect {} first: there the model disagrees most.", fmt::join(parts, ", "))
                 : fmt::format("Inspect first where stiffness or mass is missing: {}.", fmt::join(asked, "; "));
  const std::vector<const Round*> rounds = accepted_rounds(d.rounds);
  for (std::size_t i = 0; i < std::min(rounds.size(), d.best.hypothesis.effects.size()); ++i)
    s.next += fmt::format(" Before that, check for {}: {}", plain_name(d.best.hypothesis.effects[i]),
                          find_effect(d.best.hypothesis.effects[i].name).on_site);
  return s;
}

}  // namespace

ThreeSentences three_sentences(const DiagnosisResult& result) {
  using Verdict = Diagnosis::Verdict;
  const Verdict verdict = result.diagnosis.verdict;
  return verdict == Verdict::found        ? of_found(result)
         : verdict == Verdict::consistent ? of_consistent(result)
                                          : of_unexplained(result);
}

}  // namespace voussoir
