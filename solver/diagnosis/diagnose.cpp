#include "solver/diagnosis/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/diagnosis/exchange.h"
#include "solver/diagnosis/misfit.h"
#include "solver/diagnosis/rounds.h"

namespace voussoir {

namespace {

using Say = std::function<void(const std::string&)>;

int fitted_rows(const DiagnosisProblem& problem) {
  int n = 0;
  for (const ResidualRow& row : residual_rows(problem)) n += !problem.features.modes[std::size_t(row.mode)].held_back;
  return n;
}

bool is_noise(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const Fit& fit) {
  return tail(problem, fit).probability > settings.consistent;
}

/// Margin by which a further effect must be better than "none", in addition to the effects of a hypothesis.
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

void say_of(const DiagnosisProblem& problem, const Trial& added, const Fit& current, const Say& say) {
  say(fmt::format("with {}: gap {:.2f}, model error {:.1f} % of frequencies, {:.1f} % of shapes; {}",
                  added.candidate.full_text(), current.gap, 100.0 * problem.error.frequency,
                  100.0 * problem.error.shape, misfit_text(tail(problem, current))));
  for (const std::string& alarm : alarms_of(current)) say("  compensation: " + alarm);
}

/// Corrects certain faults of channels before the search for effects.
void set_channels_right(DiagnosisProblem& problem, const DiagnosisSettings& settings, SearchPoint& standing,
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

/// Adds candidates one by one as long as each one is accepted.
void add_greedily(DiagnosisProblem& problem, const DiagnosisSettings& settings, SearchPoint& standing, int most,
                  const std::vector<Candidate>& candidates, std::vector<Round>& rounds, const Say& say) {
  const auto accepted = std::size_t(std::ranges::count_if(rounds, &Round::accepted));
  const std::size_t before = standing.fit.hypothesis.effects.size() - accepted;  // found by rounds that are not here
  for (int added = 0; added < most; ++added) {
    rounds.push_back(run_round(problem, settings, standing, candidates, say));
    Round& round = rounds.back();
    round.accepted = accepts(round, standing.fit, settings);
    if (!round.accepted) break;
    standing = adopt(problem, settings, round.trials[0], standing);
    exchange(problem, settings, standing, before, rounds, say);
    const std::size_t effects = standing.fit.hypothesis.effects.size();
    drop_superseded(problem, settings, standing.fit, before, rounds, say);
    if (standing.fit.hypothesis.effects.size() < effects) {
      const Eigen::VectorXd x = at_usual_materials(standing.fit);
      standing.origin = origin_at(problem, standing.fit.hypothesis, x);
      standing.shared = shared_by_fits(problem, *standing.origin, standing.fit.hypothesis, x);
    }
    say_of(problem, rounds.back().trials[0], standing.fit, say);
  }
}

/// Adds advice to distinguish the best trial of each accepted round from equally good trials.
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
    throw InputError("there are no measured modes. Give measured/modes.csv, or recordings.");
  if (fitted_rows(problem) == 0)
    throw InputError("all measured modes are held back. Leave at least one mode for the fit.");
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
  say(fmt::format(
      "the case without changes: gap {:.2f}; the errors of the shapes appear {:.2f} times as large as stated",
      d.plain.gap, problem.scale.shapes));
  d.calibrated = fit(problem, none, d.calibrated.best.x, settings.iterations, origin, shared);
  d.alarms = alarms_of(d.calibrated);
  say(fmt::format("materials fitted: gap {:.2f}, {}; {}", d.calibrated.gap, counted(d.alarms.size(), "alarm"),
                  misfit_text(tail(problem, d.calibrated))));
  CandidateChoice choice;
  choice.without = settings.without;
  choice.driven = problem.features.driven();
  for (const MeasuredFeature& mode : problem.features.modes) {
    choice.damping |= mode.damping.has_value();
    choice.clocks |= mode.quadrature.size() > 0;
  }
  const std::vector<Candidate> all = candidates(problem.base, problem.features.sensors, choice);
  SearchPoint standing = {d.calibrated, base_model, shared};
  set_channels_right(problem, settings, standing, all, d.rounds, say);
  const SearchPoint sound = standing;
  const DiagnosisProblem with_sound_channels = problem;
  const std::size_t faults = d.rounds.size();
  add_greedily(problem, settings, standing, settings.effects, all, d.rounds, say);
  d.best = standing.fit;
  const DiagnosisProblem final_problem = problem;
  const bool added = !d.best.hypothesis.effects.empty();
  if (is_noise(problem, settings, d.best) || (added && tail(problem, d.best).probability > settings.credible))
    d.verdict = added ? Diagnosis::Verdict::found : Diagnosis::Verdict::consistent;
  if (d.verdict == Diagnosis::Verdict::unexplained) {
    d.best = sound.fit;  // effects that only reduce the misfit are not named
    for (std::size_t i = faults; i < d.rounds.size(); ++i) d.rounds[i].accepted = false;
    say("no effect of the library reduces the residuals to noise: the search for missing stiffness or mass begins");
    problem = with_sound_channels;
    // These factors show the location of a missing effect, not its kind. They need not improve predictions, and several
    // are as probable as one.
    DiagnosisSettings lenient = settings;
    lenient.predict = false;
    lenient.further = 0.0;
    SearchPoint nameless = sound;
    add_greedily(problem, lenient, nameless, 3, nameless_factors(problem.base), d.nameless, say);
    d.nameless_best = nameless.fit;
  }
  if (d.verdict == Diagnosis::Verdict::found) add_advice(problem, d);
  const SearchPoint& judged = d.verdict == Diagnosis::Verdict::unexplained ? sound : standing;
  const DiagnosisProblem& by = d.verdict == Diagnosis::Verdict::unexplained ? with_sound_channels : final_problem;
  if (settings.detectable) {
    const DetectionSettings asked_for = {margin_beside(judged.fit.hypothesis, settings), settings.further_measurements,
                                         settings.threads};
    d.detection = detection(by, judged.fit, *judged.origin, judged.shared, all, asked_for);
    say(fmt::format("computed the least detectable amounts of {}", counted(d.detection.least.size(), "effect")));
  }
  d.judged = by;
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return d;
}

}  // namespace voussoir
