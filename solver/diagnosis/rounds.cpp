#include "solver/diagnosis/rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/parallel.h"

namespace voussoir {

namespace {

/// Least deviation of a gain that counts as a fault. Mountings and errors of the model shapes cause smaller deviations.
constexpr double least_gain_fault = 0.1;

/// Reason why a fitted channel fault is not a fault; empty if it is one.
std::string no_fault(const Fit& fit) {
  const Candidate& added = fit.hypothesis.effects.back();
  if (added.kind != Candidate::Kind::gain || added.parameters.empty()) return {};
  const double gain = added.parameters[0].value(fit.best.x[fit.best.x.size() - 1]);
  if (std::abs(gain - 1.0) >= least_gain_fault) return {};
  return fmt::format("a gain of {:.2f} cannot be distinguished from 1", gain);
}

/// Removes gains that would be too near 1 to be faults. Readings are linear in the gain.
void drop_small_gains(const std::vector<Candidate>& candidates, std::vector<Signature>& all) {
  for (Signature& s : all) {
    const Candidate& c = candidates[s.candidate];
    if (!s.possible || c.kind != Candidate::Kind::gain || c.parameters.empty()) continue;
    const double change = s.share * (c.parameters[0].value(c.starts[s.start][0]) - 1.0);
    s.possible = std::abs(change) >= 0.5 * least_gain_fault;
  }
}

/// The best start of each candidate, best first; at most `count`.
std::vector<Signature> shortlist(std::vector<Signature> all, std::size_t count) {
  std::erase_if(all, [](const Signature& s) { return !s.possible; });
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
  std::vector<Signature> best;
  for (const Signature& s : all)
    if (best.size() < count &&
        std::none_of(best.begin(), best.end(), [&](const auto& other) { return other.candidate == s.candidate; }))
      best.push_back(s);
  return best;
}

/// Sets the materials to their usual values, because they may have compensated for the effect of the candidate.
Eigen::VectorXd beginning(const Fit& current, const Candidate& candidate, const std::vector<double>& start) {
  Eigen::VectorXd x = current.best.x;
  x.head(Eigen::Index(current.hypothesis.materials.size())).setZero();
  Eigen::VectorXd more(x.size() + Eigen::Index(candidate.parameters.size()));
  more << x, Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index(start.size()));
  return more;
}

/// Probabilities of the trials and of "none", whose prior is equal to the sum over all candidates.
void weigh(Round& round, const Fit& current) {
  double most = current.log_evidence;
  for (const Trial& t : round.trials) most = std::max(most, t.fit.log_evidence + std::log(t.candidate.prior));
  round.none = std::exp(current.log_evidence - most);
  double sum = round.none;
  for (Trial& t : round.trials)
    sum += t.probability = std::exp(t.fit.log_evidence + std::log(t.candidate.prior) - most);
  round.none /= sum;
  for (Trial& t : round.trials) t.probability /= sum;
  std::stable_sort(round.trials.begin(), round.trials.end(),
                   [](const Trial& a, const Trial& b) { return a.probability > b.probability; });
}

void mark_ties(Round& round, const std::vector<Signature>& signatures, const std::vector<Candidate>& candidates) {
  const auto of = [&](const Trial& trial) {
    return std::find_if(signatures.begin(), signatures.end(), [&](const Signature& s) {
      const Candidate& c = candidates[s.candidate];
      return s.possible && c.text() == trial.candidate.text() && c.kind == trial.candidate.kind &&
             c.parameters.size() == trial.candidate.parameters.size();
    });
  };
  for (Trial& trial : round.trials) {
    const auto a = of(round.trials[0]), b = of(trial);
    if (a != signatures.end() && b != signatures.end()) trial.signature = collinearity(*a, *b);
    trial.tie = &trial != &round.trials[0] && trial.probability > round.trials[0].probability / 5.0;
  }
}

}  // namespace

double gain_of(const Trial& trial, const Fit& current) {
  return trial.fit.log_evidence + std::log(trial.candidate.prior) - current.log_evidence;
}

bool excludes(const Candidate& there, const Candidate& c) {
  if (there.text() == c.text()) return there.kind == c.kind;
  const auto on_springs = [](const Candidate& a, const Candidate& b) {
    return a.name == "foundation_flexibility" && b.kind == Candidate::Kind::motion &&
           (a.where == b.where || a.where == "all");
  };
  return on_springs(there, c) || on_springs(c, there);
}

Round run_round(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const SearchPoint& standing,
                const std::vector<Candidate>& all_candidates, const std::function<void(const std::string&)>& say) {
  const Fit& current = standing.fit;
  Round round;
  std::vector<Candidate> candidates;  // without those already present
  for (const Candidate& c : all_candidates)
    if (std::none_of(current.hypothesis.effects.begin(), current.hypothesis.effects.end(),
                     [&](const Candidate& there) { return excludes(there, c); }))
      candidates.push_back(c);
  const Eigen::VectorXd x = at_usual_materials(current);
  std::vector<Signature> all =
      signatures(problem, current.hypothesis, x, candidates, settings.threads, *standing.origin, standing.shared);
  drop_small_gains(candidates, all);
  for (const Signature& s : shortlist(all, all.size()))
    round.screened.emplace_back(candidates[s.candidate].full_text(), s.explained);
  const std::vector<Signature> chosen = shortlist(all, std::size_t(settings.fits));
  say(fmt::format("screened {}; fitting {}", counted(round.screened.size(), "candidate"), chosen.size()));
  std::vector<std::optional<Trial>> trials(chosen.size());
  std::vector<std::string> failures(chosen.size());
  for_all(chosen.size(), settings.threads, [&](std::size_t i) {
    const Candidate& candidate = candidates[chosen[i].candidate];
    Trial trial;
    trial.candidate = candidate;
    try {
      trial.fit = fit(problem, current.hypothesis.with(candidate),
                      beginning(current, candidate, candidate.starts[chosen[i].start]), settings.iterations,
                      *standing.origin, standing.shared);
      failures[i] = no_fault(trial.fit);
      if (failures[i].empty()) trials[i] = std::move(trial);
    } catch (const std::runtime_error& error) {  // the model with it is not a valid bridge, so it is not an explanation
      failures[i] = error.what();
    }
  });
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (trials[i]) round.trials.push_back(std::move(*trials[i]));
    if (!failures[i].empty()) round.not_fitted.emplace_back(candidates[chosen[i].candidate].full_text(), failures[i]);
  }
  for (const auto& [candidate, why] : round.not_fitted)
    say(fmt::format("  {} is not an explanation: {}", candidate, why));
  weigh(round, current);
  if (!round.trials.empty()) mark_ties(round, all, candidates);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, round.trials.size()); ++i) {
    const Trial& t = round.trials[i];
    say(fmt::format(
        "  {}: probability {:.2f}, gap {:.2f}, predicted {:.2f}, evidence {:+.1f}, errors × {:.2f}, of shapes × {:.2f}",
        t.candidate.full_text(), t.probability, t.fit.gap, t.fit.predicted_gap, gain_of(t, current),
        t.fit.scale.structure, t.fit.scale.shapes));
  }
  return round;
}

}  // namespace voussoir
