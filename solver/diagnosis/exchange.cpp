#include "solver/diagnosis/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/parallel.h"
#include "solver/diagnosis/rounds.h"

namespace voussoir {

void drop_superseded(const DiagnosisProblem& problem, const DiagnosisSettings& settings, Fit& current,
                     std::size_t before, std::vector<Round>& rounds,
                     const std::function<void(const std::string&)>& say) {
  for (std::size_t i = before; i + 1 < current.hypothesis.effects.size();) {
    const Candidate out = current.hypothesis.effects[i];
    const std::optional<Fit> less =
        fit_if_possible(problem, without(current.hypothesis, i), without(current, i), settings.iterations);
    if (!less || less->log_evidence < current.log_evidence + std::log(out.prior) + settings.margin) {
      ++i;
      continue;
    }
    say(fmt::format("  {} is no longer needed", out.full_text()));
    current = *less;
    std::size_t accepted = before;
    for (Round& round : rounds)
      if (round.accepted && accepted++ == i) {
        round.accepted = false;
        round.superseded = true;
        break;
      }
  }
}

namespace {

/// A fit's hypothesis with another candidate, as it was fitted by itself, in the place of one of its effects; materials
/// as the case has them.
Trial in_place_of(const Fit& fit, std::size_t effect, const Trial& other) {
  Trial t;
  t.candidate = other.candidate;
  t.fit.hypothesis = fit.hypothesis;
  t.fit.hypothesis.effects[effect] = other.candidate;
  const Eigen::VectorXd rest = without(fit, effect);
  auto at = Eigen::Index(fit.hypothesis.materials.size());
  for (std::size_t i = 0; i < effect; ++i) at += Eigen::Index(fit.hypothesis.effects[i].parameters.size());
  const auto own = Eigen::Index(other.candidate.parameters.size());
  t.fit.best.x.resize(rest.size() + own);
  t.fit.best.x << rest.head(at), other.fit.best.x.tail(own), rest.tail(rest.size() - at);
  t.fit.best.x = at_usual_materials(t.fit);
  return t;
}

/// The best of a few other trials of a round in the place of the effect that it has added.
std::optional<Trial> best_in_place(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const Fit& fit,
                                   std::size_t effect, const Round& round) {
  constexpr std::size_t most = 4;
  std::vector<Trial> trials;
  for (std::size_t k = 1; k < round.trials.size() && trials.size() < most; ++k) {
    const Candidate& c = round.trials[k].candidate;
    bool beside = !c.of_sensors();
    for (std::size_t i = 0; i < fit.hypothesis.effects.size(); ++i)
      beside = beside && (i == effect || !excludes(fit.hypothesis.effects[i], c));
    if (beside) trials.push_back(in_place_of(fit, effect, round.trials[k]));
  }
  std::vector<std::optional<Fit>> fits(trials.size());
  for_all(trials.size(), settings.threads, [&](std::size_t i) {
    fits[i] = fit_if_possible(problem, trials[i].fit.hypothesis, trials[i].fit.best.x, settings.iterations);
  });
  std::optional<Trial> best;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!fits[i]) continue;
    trials[i].fit = std::move(*fits[i]);
    const auto worth = [](const Trial& t) { return t.fit.log_evidence + std::log(t.candidate.prior); };
    if (!best || worth(trials[i]) > worth(*best)) best = std::move(trials[i]);
  }
  return best;
}

}  // namespace

void exchange(DiagnosisProblem& problem, const DiagnosisSettings& settings, SearchPoint& standing, std::size_t before,
              std::vector<Round>& rounds, const std::function<void(const std::string&)>& say) {
  std::size_t next = before;
  for (Round& round : rounds) {
    if (!round.accepted) continue;
    const std::size_t effect = next++;
    const Hypothesis& there = standing.fit.hypothesis;
    if (effect + 1 >= there.effects.size()) return;
    if (there.effects[effect].of_sensors()) continue;
    const std::optional<Trial> other = best_in_place(problem, settings, standing.fit, effect, round);
    if (!other) continue;
    const double better = other->fit.log_evidence + std::log(other->candidate.prior) - standing.fit.log_evidence -
                          std::log(there.effects[effect].prior);
    if (better <= 0.0) continue;
    say(fmt::format("  {} replaces {}: evidence {:+.1f}", other->candidate.full_text(),
                    there.effects[effect].full_text(), better));
    const auto at = std::find_if(round.trials.begin(), round.trials.end(), [&](const Trial& t) {
      return t.candidate.text() == other->candidate.text() && t.candidate.kind == other->candidate.kind;
    });
    std::iter_swap(round.trials.begin(), at);
    round.trials[0].probability = 1.0 / (1.0 + std::exp(-better));
    at->probability = 1.0 - round.trials[0].probability;
    round.trials[0].tie = false, at->tie = at->probability > round.trials[0].probability / 5.0;
    standing = adopt(problem, settings, *other, standing);
  }
}

}  // namespace voussoir
