#include "solver/diagnosis/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/diagnosis/misfit.h"

namespace voussoir {

namespace {

using Say = std::function<void(const std::string&)>;

int fitted_rows(const DiagnosisProblem& problem) {
  int n = 0;
  for (const ResidualRow& row : residual_rows(problem)) n += !problem.features.modes[std::size_t(row.mode)].held_back;
  return n;
}

/// Least fault of a gain that is one: less is what mountings and the model's shapes leave.
constexpr double least_gain_fault = 0.1;

/// Why a fitted fault of a channel is none; empty: it is one.
std::string no_fault(const Fit& fit) {
  const Candidate& added = fit.hypothesis.effects.back();
  if (added.kind != Candidate::Kind::gain || added.parameters.empty()) return {};
  const double gain = added.parameters[0].value(fit.best.x[fit.best.x.size() - 1]);
  if (std::abs(gain - 1.0) >= least_gain_fault) return {};
  return fmt::format("a gain of {:.2f} is not told from 1", gain);
}

/// The model of a hypothesis at x; that of the base is there already.
std::shared_ptr<const Origin> origin_at(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                        const Eigen::VectorXd& x) {
  if (problem.origin && hypothesis.effects.empty() && x.isZero(0.0)) return problem.origin;
  return std::make_shared<Origin>(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                                  problem.features.driven());
}

/// x of a fit with its materials as the case has them.
Eigen::VectorXd at_usual_materials(const Fit& fit) {
  Eigen::VectorXd x = fit.best.x;
  x.head(Eigen::Index(fit.hypothesis.materials.size())).setZero();
  return x;
}

bool is_noise(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const Fit& fit) {
  return tail(problem, fit).probability > settings.consistent;
}

/// Takes out wrong gains that would come out too near 1 to be faults: readings are linear in them.
void drop_small_gains(const std::vector<Candidate>& candidates, std::vector<Signature>& all) {
  for (Signature& s : all) {
    const Candidate& c = candidates[s.candidate];
    if (!s.possible || c.kind != Candidate::Kind::gain || c.parameters.empty()) continue;
    const double change = s.share * (c.parameters[0].value(c.starts[s.start][0]) - 1.0);
    s.possible = std::abs(change) >= 0.5 * least_gain_fault;
  }
}

/// Of each candidate its best start, best first; at most `count`.
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

/// Materials back at their usual values: they may have paid for what the candidate now brings.
Eigen::VectorXd beginning(const Fit& current, const Candidate& candidate, const std::vector<double>& start) {
  Eigen::VectorXd x = current.best.x;
  x.head(Eigen::Index(current.hypothesis.materials.size())).setZero();
  Eigen::VectorXd more(x.size() + Eigen::Index(candidate.parameters.size()));
  more << x, Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index(start.size()));
  return more;
}

/// Probabilities of the trials and of none, whose prior is as much as that of all candidates together.
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

Hypothesis without(Hypothesis hypothesis, std::size_t effect) {
  hypothesis.effects.erase(hypothesis.effects.begin() + std::ptrdiff_t(effect));
  return hypothesis;
}

/// x of a fit without the parameters of one of its effects.
Eigen::VectorXd without(const Fit& fit, std::size_t effect) {
  auto at = Eigen::Index(fit.hypothesis.materials.size());
  for (std::size_t i = 0; i < effect; ++i) at += Eigen::Index(fit.hypothesis.effects[i].parameters.size());
  const auto gone = Eigen::Index(fit.hypothesis.effects[effect].parameters.size());
  Eigen::VectorXd x(fit.best.x.size() - gone);
  x << fit.best.x.head(at), fit.best.x.tail(fit.best.x.size() - at - gone);
  return x;
}

double gain_of(const Trial& trial, const Fit& current) {
  return trial.fit.log_evidence + std::log(trial.candidate.prior) - current.log_evidence;
}

/// By how much a further effect beside those of a hypothesis must be better than none.
double margin_beside(const Hypothesis& hypothesis, const DiagnosisSettings& settings) {
  return settings.margin + (hypothesis.effects.empty() ? 0.0 : settings.further);
}

bool accepts(const Round& round, const Fit& current, const DiagnosisSettings& settings) {
  if (round.trials.empty()) return false;
  const Fit& best = round.trials[0].fit;
  const bool predicts = !settings.predict || best.predicted_gap < current.predicted_gap;
  return gain_of(round.trials[0], current) > margin_beside(current.hypothesis, settings) && predicts &&
         best.gap < current.gap;
}

/// Whether the others, and the model, do not believe these channels as they are and do once the fault is put right;
/// none of the others being as far off.
bool is_certain(const DiagnosisProblem& problem, const Round& round, const Fit& current,
                const DiagnosisSettings& settings) {
  if (round.trials.empty() || gain_of(round.trials[0], current) < settings.certain) return false;
  // An effect that acts near one sensor looks like several faults of it, and like none altogether.
  if (round.trials[0].probability < 0.95) return false;
  const std::vector<LeftOutSensor> before = leave_out_sensors(problem, current),
                                   after = leave_out_sensors(problem, round.trials[0].fit);
  std::vector<double> others;  // mean squares
  const std::vector<std::size_t>& own = round.trials[0].candidate.sensors;
  for (std::size_t s = 0; s < before.size(); ++s)
    if (before[s].rows > 0 && std::find(own.begin(), own.end(), s) == own.end())
      others.push_back(before[s].misfit / before[s].rows);
  std::nth_element(others.begin(), others.begin() + std::ptrdiff_t(others.size() / 2), others.end());
  const double usual = others.empty() ? 1.0 : others[others.size() / 2];
  return std::all_of(own.begin(), own.end(), [&](std::size_t s) {
    const double mean = before[s].misfit / std::max(before[s].rows, 1);
    return before[s].rows >= 2 && chi_square_tail(before[s].misfit, before[s].rows) < 1e-6 && mean > 3.0 * usual &&
           after[s].misfit < 0.3 * before[s].misfit && chi_square_tail(after[s].misfit, after[s].rows) > 1e-4;
  });
}

/// The same thing, or one that cannot be beside it: a base on springs is no base that could be driven.
bool excludes(const Candidate& there, const Candidate& c) {
  if (there.text() == c.text()) return there.kind == c.kind;
  const auto on_springs = [](const Candidate& a, const Candidate& b) {
    return a.name == "foundation_flexibility" && b.kind == Candidate::Kind::motion &&
           (a.where == b.where || a.where == "all");
  };
  return on_springs(there, c) || on_springs(c, there);
}

/// A fit, the model it has with usual materials, about which candidates are tried, and what materials do to that.
struct Standing {
  Fit fit;
  std::shared_ptr<const Origin> origin;
  Vectors shared;
};

Vectors shared_by_fits(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                       const Eigen::VectorXd& x) {
  return material_vectors(origin, problem.base, hypothesis, x, question_of(problem, origin.response()).wanted);
}

Round run_round(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const Standing& standing,
                const std::vector<Candidate>& all_candidates, const Say& say) {
  const Fit& current = standing.fit;
  Round round;
  std::vector<Candidate> candidates;  // those that are not there already
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
  say(fmt::format("screened {} candidates; fitting {}", round.screened.size(), chosen.size()));
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
    } catch (const std::runtime_error& error) {  // it leaves no bridge that stands: no explanation either
      failures[i] = error.what();
    }
  });
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (trials[i]) round.trials.push_back(std::move(*trials[i]));
    if (!failures[i].empty()) round.not_fitted.emplace_back(candidates[chosen[i].candidate].full_text(), failures[i]);
  }
  for (const auto& [candidate, why] : round.not_fitted) say(fmt::format("  {} is no explanation: {}", candidate, why));
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

/// A fit from x about the model there; nothing where that is no bridge that stands, or the fit does not converge.
std::optional<Fit> fit_if_possible(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                   const Eigen::VectorXd& x, int iterations) {
  try {
    const Origin own(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                     problem.features.driven());
    return fit(problem, hypothesis, x, iterations, own, shared_by_fits(problem, own, hypothesis, x));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// The same about the standing model.
std::optional<Fit> fit_again(const DiagnosisProblem& problem, const Standing& s, int iterations) {
  try {
    return fit(problem, s.fit.hypothesis, s.fit.best.x, iterations, *s.origin, s.shared);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

/// Takes out an effect that a later one has made needless: an early choice may have stood in for it.
void drop_superseded(const DiagnosisProblem& problem, const DiagnosisSettings& settings, Fit& current,
                     std::vector<Round>& rounds, const Say& say) {
  for (std::size_t i = 0; i + 1 < current.hypothesis.effects.size();) {
    const Candidate out = current.hypothesis.effects[i];
    const std::optional<Fit> less =
        fit_if_possible(problem, without(current.hypothesis, i), without(current, i), settings.iterations);
    if (!less || less->log_evidence < current.log_evidence + std::log(out.prior) + settings.margin) {
      ++i;
      continue;
    }
    say(fmt::format("  {} is not needed any more", out.full_text()));
    current = *less;
    std::size_t accepted = 0;
    for (Round& round : rounds)
      if (round.accepted && accepted++ == i) {
        round.accepted = false;
        round.superseded = true;
        break;
      }
  }
}

/// The fit of a round's best trial, its model, and what the mesh and all that is not exactly known do to that.
Standing adopt(DiagnosisProblem& problem, const DiagnosisSettings& settings, const Trial& trial,
               const Standing& before) {
  Standing s = {trial.fit, before.origin, before.shared};
  const Eigen::VectorXd x = at_usual_materials(s.fit);
  if (!trial.candidate.of_sensors()) {
    s.origin = origin_at(problem, s.fit.hypothesis, x);
    s.shared = shared_by_fits(problem, *s.origin, s.fit.hypothesis, x);
    set_mesh_error(problem, s.origin->response(), s.fit.hypothesis, x);
  }
  set_covariance(problem, *s.origin, s.fit.hypothesis, x, settings.threads);
  set_scale(problem, {1.0, s.fit.scale.shapes});
  if (std::optional<Fit> again = fit_again(problem, s, settings.iterations)) s.fit = std::move(*again);
  return s;
}

void say_of(const DiagnosisProblem& problem, const Trial& added, const Fit& current, const Say& say) {
  say(fmt::format("with {}: gap {:.2f}, model error {:.1f} % of frequencies, {:.1f} % of shapes; {}",
                  added.candidate.full_text(), current.gap, 100.0 * problem.error.frequency,
                  100.0 * problem.error.shape, misfit_text(tail(problem, current))));
  for (const std::string& alarm : alarms_of(current)) say("  compensation: " + alarm);
}

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

/// Alone, an effect may have stood in for its neighbour and a later one: what its round has fitted besides takes its
/// place if that is better beside the others.
void exchange(DiagnosisProblem& problem, const DiagnosisSettings& settings, Standing& standing,
              std::vector<Round>& rounds, const Say& say) {
  std::size_t next = 0;
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
    say(fmt::format("  {} in the place of {}: evidence {:+.1f}", other->candidate.full_text(),
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

/// Faults of channels that are certain, before anything else is judged.
void set_channels_right(DiagnosisProblem& problem, const DiagnosisSettings& settings, Standing& standing,
                        const std::vector<Candidate>& all, std::vector<Round>& rounds, const Say& say) {
  std::vector<Candidate> faults = all;
  std::erase_if(faults, [](const Candidate& c) { return !c.of_sensors(); });
  DiagnosisSettings few = settings;
  few.fits = std::min(settings.fits, 4);
  while (!faults.empty()) {
    Round round = run_round(problem, few, standing, faults, say);
    round.accepted = is_certain(problem, round, standing.fit, settings);
    if (!round.accepted) return;
    standing = adopt(problem, settings, round.trials[0], standing);
    say_of(problem, round.trials[0], standing.fit, say);
    rounds.push_back(std::move(round));
  }
}

/// Adds candidates one by one while each one pays.
void add_greedily(DiagnosisProblem& problem, const DiagnosisSettings& settings, Standing& standing, int most,
                  const std::vector<Candidate>& candidates, std::vector<Round>& rounds, const Say& say) {
  for (int added = 0; added < most; ++added) {
    rounds.push_back(run_round(problem, settings, standing, candidates, say));
    Round& round = rounds.back();
    round.accepted = accepts(round, standing.fit, settings);
    if (!round.accepted) break;
    standing = adopt(problem, settings, round.trials[0], standing);
    exchange(problem, settings, standing, rounds, say);
    const std::size_t effects = standing.fit.hypothesis.effects.size();
    drop_superseded(problem, settings, standing.fit, rounds, say);
    if (standing.fit.hypothesis.effects.size() < effects) {
      const Eigen::VectorXd x = at_usual_materials(standing.fit);
      standing.origin = origin_at(problem, standing.fit.hypothesis, x);
      standing.shared = shared_by_fits(problem, *standing.origin, standing.fit.hypothesis, x);
    }
    say_of(problem, rounds.back().trials[0], standing.fit, say);
  }
}

/// What would tell the best trial of each accepted round from those that are as good.
void add_advice(const DiagnosisProblem& problem, Diagnosis& d) {
  for (Round& round : d.rounds) {
    if (!round.accepted) continue;
    const bool tied = std::any_of(round.trials.begin(), round.trials.end(), [](const Trial& t) { return t.tie; });
    if (tied) make_whole(problem, round.trials[0].fit);
    for (Trial& other : round.trials) {
      if (!other.tie) continue;
      make_whole(problem, other.fit);
      d.advice.push_back(advise(problem, round.trials[0], other));
    }
  }
}

void check(const DiagnosisProblem& problem) {
  if (problem.features.modes.empty())
    throw InputError("there are no measured modes to compare with; give measured/modes.csv, or recordings");
  if (fitted_rows(problem) == 0) throw InputError("all measured modes are held back; leave some to be fitted");
}

}  // namespace

const char* verdict_name(Diagnosis::Verdict verdict) {
  static const char* const names[] = {"consistent", "found", "unexplained"};
  return names[int(verdict)];
}

Diagnosis diagnose(const DiagnosisProblem& asked, const DiagnosisSettings& settings, const Say& say) {
  const auto begin = std::chrono::steady_clock::now();
  check(asked);
  DiagnosisProblem problem = asked;
  Diagnosis d;
  const Hypothesis none = {calibrations(problem.base), {}};
  const Eigen::VectorXd usual = Eigen::VectorXd::Zero(Eigen::Index(none.size()));
  if (!problem.origin) problem.origin = origin_at(problem, none, usual);
  const std::shared_ptr<const Origin> base_model = problem.origin;
  const Origin& origin = *base_model;
  if (problem.covariance.own.size() == 0) set_covariance(problem, origin, none, usual, settings.threads);
  const Vectors shared = shared_by_fits(problem, origin, none, usual);
  d.calibrated = fit(problem, none, usual, 2 * settings.iterations, origin, shared);
  set_scale(problem, {1.0, d.calibrated.scale.shapes});
  d.plain = fit(problem, none, usual, 0, origin, shared);
  d.plain.best = evaluate(problem, residual_rows(problem), none, usual, origin);
  say(fmt::format("the case as it is: gap {:.2f}; shapes are as if known {:.2f} times as badly as said", d.plain.gap,
                  problem.scale.shapes));
  d.calibrated = fit(problem, none, d.calibrated.best.x, settings.iterations, origin, shared);
  d.alarms = alarms_of(d.calibrated);
  say(fmt::format("materials fitted: gap {:.2f}, {} alarm{}; {}", d.calibrated.gap, d.alarms.size(),
                  d.alarms.size() == 1 ? "" : "s", misfit_text(tail(problem, d.calibrated))));
  CandidateChoice choice;
  choice.without = settings.without;
  choice.driven = problem.features.driven();
  for (const MeasuredFeature& mode : problem.features.modes) {
    choice.damping |= mode.damping.has_value();
    choice.clocks |= mode.quadrature.size() > 0;
  }
  const std::vector<Candidate> all = candidates(problem.base, problem.features.sensors, choice);
  Standing standing = {d.calibrated, base_model, shared};
  set_channels_right(problem, settings, standing, all, d.rounds, say);
  const Standing sound = standing;
  const DiagnosisProblem with_sound_channels = problem;
  const std::size_t faults = d.rounds.size();
  add_greedily(problem, settings, standing, settings.effects, all, d.rounds, say);
  d.best = standing.fit;
  const DiagnosisProblem final_problem = problem;
  const bool added = !d.best.hypothesis.effects.empty();
  if (is_noise(problem, settings, d.best) || (added && tail(problem, d.best).probability > settings.credible))
    d.verdict = added ? Diagnosis::Verdict::found : Diagnosis::Verdict::consistent;
  if (d.verdict == Diagnosis::Verdict::unexplained) {
    d.best = sound.fit;  // what only helps is not named
    for (std::size_t i = faults; i < d.rounds.size(); ++i) d.rounds[i].accepted = false;
    say("no effect of the library brings the residuals to noise: looking where stiffness or mass is missing");
    problem = with_sound_channels;
    // They say where something is missing, not what: no prediction is asked of them, and several are as likely as one.
    DiagnosisSettings lenient = settings;
    lenient.predict = false;
    lenient.further = 0.0;
    Standing nameless = sound;
    add_greedily(problem, lenient, nameless, 3, nameless_factors(problem.base), d.nameless, say);
    d.nameless_best = nameless.fit;
  }
  if (d.verdict == Diagnosis::Verdict::found) add_advice(problem, d);
  const Standing& judged = d.verdict == Diagnosis::Verdict::unexplained ? sound : standing;
  const DiagnosisProblem& by = d.verdict == Diagnosis::Verdict::unexplained ? with_sound_channels : final_problem;
  if (settings.detectable) {
    const DetectionSettings asked_for = {margin_beside(judged.fit.hypothesis, settings), settings.further_measurements,
                                         settings.threads};
    d.detection = detection(by, judged.fit, *judged.origin, judged.shared, all, asked_for);
    say(fmt::format("least amounts of {} effects that these data would show", d.detection.least.size()));
  }
  d.judged = by;
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return d;
}

}  // namespace voussoir
