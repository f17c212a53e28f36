#include "solver/diagnosis/detectable.h"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

constexpr double not_found = std::numeric_limits<double>::quiet_NaN();

/// How far the rows of two models are apart, in standard deviations of what neither errors nor materials explain.
class Distance {
 public:
  Distance(const Extended& all, const Hypothesis& hypothesis, const Eigen::VectorXd& x, const Origin& origin,
           const Vectors& shared, const ErrorScale& scale)
      : rows_(residual_rows(all.problem)), had_(all.had) {
    const DiagnosisProblem& p = all.problem;
    ModelFamily family(origin, p.base, hypothesis, question_of(p, all.plain), x, ModelFamily::Use::often);
    family.append(shared);
    const ModelFamily::Member member = family.member(x);
    const Evaluation at = evaluate(p, rows_, hypothesis, family, member);
    const Eigen::MatrixXd j = p.colouring * jacobian(p, rows_, hypothesis, family, member, at);
    covariance_ = p.covariance.at(scale) + j * j.transpose();
    white_ = whitening_of(Eigen::MatrixXd(covariance_(had_, had_)));
  }
  const std::vector<ResidualRow>& rows() const { return rows_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  double of(const Eigen::VectorXd& trace) const { return (white_ * Eigen::VectorXd(trace(had_))).norm(); }
  /// With these rows too.
  Distance with(const std::vector<int>& rows) const {
    Distance d = *this;
    d.had_.insert(d.had_.end(), rows.begin(), rows.end());
    d.white_ = whitening_of(Eigen::MatrixXd(covariance_(d.had_, d.had_)));
    return d;
  }

 private:
  std::vector<ResidualRow> rows_;
  std::vector<int> had_;
  Eigen::MatrixXd covariance_, white_;
};

/// The effect's first parameter from where it changes nothing to a bound.
struct Way {
  double neutral = 0.0, bound = 0.0;
  double at(double share, const FitParameter& p) const {
    return p.logarithmic ? neutral * std::pow(bound / neutral, share) : neutral + share * (bound - neutral);
  }
};

/// Models with any amount of an effect in addition to a hypothesis at x.
class Amounts {
 public:
  Amounts(const Extended& all, const Hypothesis& hypothesis, const Eigen::VectorXd& x, const Origin& origin,
          const Candidate& candidate, const Distance& distance)
      : all_(&all), candidate_(&candidate), hypothesis_(hypothesis.with(candidate)), distance_(&distance), x_(x) {
    first_ = x_.size();
    x_.conservativeResize(Eigen::Index(hypothesis_.size()));
    x_.tail(x_.size() - first_) = Eigen::Map<const Eigen::VectorXd>(candidate.starts[0].data(), x_.size() - first_);
    if (candidate.kind != Candidate::Kind::effect) return;
    family_ = std::make_unique<ModelFamily>(origin, all.problem.base, hypothesis_, question_of(all.problem, all.plain),
                                            x_, ModelFamily::Use::often);
    family_->converge(x_, 1e-3);
  }
  /// Measured − computed, and which computed mode each measured one is.
  struct Rows {
    Eigen::VectorXd values;
    std::vector<int> computed;
  };
  Rows rows_at(double value) const {
    const DiagnosisProblem& p = all_->problem;
    Eigen::VectorXd x = x_;
    x[first_] = candidate_->parameters[0].x(value);
    const Response response = family_ ? family_->response(family_->member(x)) : all_->plain;
    const Observed seen = hypothesis_.observe(response, p.damping, x);
    const ModePairs pairs = pair_features(p.features, response, seen.readings);
    return {differences(p, distance_->rows(), pairs, seen), pairs.computed};
  }
  /// What changes from one to the other. Of a further mode that is taken for another one then, nothing is promised.
  Eigen::VectorXd trace(const Rows& from, const Rows& to) const {
    Eigen::VectorXd rows = to.values - from.values;
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      const auto mode = std::size_t(distance_->rows()[std::size_t(i)].mode);
      if (all_->further.size() > mode && all_->further[mode] && from.computed[mode] != to.computed[mode]) rows[i] = 0.0;
    }
    return rows;
  }

 private:
  const Extended* all_;
  const Candidate* candidate_;
  Hypothesis hypothesis_;
  const Distance* distance_;
  Eigen::VectorXd x_;
  Eigen::Index first_ = 0;
  std::unique_ptr<ModelFamily> family_;
};

/// The evidence for an amount that is there exceeds half the square of its distance, less what freedom costs, with the
/// probability ½; 1.28 standard deviations farther with 0.9.
double distance_needed(const Candidate& c, double margin, double slope) {
  const double occam = 0.5 * std::log(1.0 + slope * slope);  // slope: of the distance over x
  return 1.2816 + std::sqrt(2.0 * std::max(margin - std::log(c.prior) + occam, 0.0));
}

/// The least value on the way at which the distance is as large as needed, and the trace it leaves; that of the bound
/// where no value is found.
struct Least {
  double value = not_found;
  Trace trace;
};
Least least_on(const Way& way, const Amounts& amounts, const Distance& distance, const Candidate& c, double margin) {
  constexpr int most = 8;
  constexpr double near = 0.03, least_share = 1e-5;
  const FitParameter& p = c.parameters[0];
  const Amounts::Rows none = amounts.rows_at(way.neutral);
  Least least;
  least.trace.name = c.name, least.trace.where = c.where;
  // The logarithm of the distance over what is needed: distances grow like powers. The last that is found, or else the
  // bound, is kept.
  const auto excess = [&](double share) {
    const double value = way.at(share, p), steps = std::abs(p.x(value) - p.x(way.neutral));
    Eigen::VectorXd rows = amounts.trace(none, amounts.rows_at(value));
    const double apart = distance.of(rows), needed = distance_needed(c, margin, steps > 0.0 ? apart / steps : 0.0);
    if (apart >= needed) least.value = value;
    if (apart >= needed || share >= 1.0) least.trace.rows = std::move(rows), least.trace.needed = needed;
    return std::log(std::max(apart, 1e-12) / needed);
  };
  // Along u, in which it is nearly straight: the share of the way of a logarithmic parameter, the logarithm of the
  // share of another.
  const auto share_at = [&](double u) { return p.logarithmic ? u : std::pow(least_share, 1.0 - u); };
  double low = 0.0, high = 1.0, above = excess(1.0), below = 0.0;  // below 0: not known
  if (above < 0.0) return least;
  double reached = above;  // at `high`
  // Halves, until both sides are known; then regula falsi, of which a side that stays counts for half (Illinois: Dowell
  // & Jarratt 1971).
  for (int i = 0, side = 0; i < most && reached > near; ++i) {
    const double part = below < 0.0 ? std::clamp(-below / (above - below), 0.1, 0.9) : 0.5;
    const double at = low + part * (high - low), own = excess(share_at(at));
    if (own >= 0.0) {
      if (side > 0) below *= 0.5;
      high = at, above = reached = own, side = 1;
    } else {
      if (side < 0) above *= 0.5;
      low = at, below = own, side = -1;
    }
  }
  return least;
}

/// Of one candidate: both sides of where it changes nothing, or (`side` −1, 1) below or above it alone.
struct Found {
  Detectable least;
  std::vector<Trace> traces;
};
Found look_for(const Candidate& c, const Amounts& amounts, const Distance& distance, double damping, double margin,
               int side = 0) {
  const EffectParameter& p = find_effect(c.name).parameters[0];
  const FitParameter& own = c.parameters[0];
  Found f = {{c.name, c.where, p.name, p.unit, p.neutral, not_found, not_found}, {}};
  if (c.kind == Candidate::Kind::damping) f.least.neutral = damping;
  const double neutral = std::clamp(f.least.neutral, own.low, own.high);
  const auto look = [&](double bound, double& value) {
    Least least = least_on({neutral, bound}, amounts, distance, c, margin);
    value = least.value;
    least.trace.above = bound > neutral;
    f.traces.push_back(std::move(least.trace));
  };
  if (side <= 0 && own.low < neutral) look(own.low, f.least.below);
  if (side >= 0 && own.high > neutral) look(own.high, f.least.above);
  return f;
}

/// By which a least value falls: by the logarithm of the amount where the parameter is a factor on what is there.
double fall(const Detectable& before, const Detectable& after, bool above) {
  const double had = above ? before.above : before.below, has = above ? after.above : after.below;
  const double none = before.neutral;
  return none > 0.0 ? std::log(has / none) / std::log(had / none) : has / had;
}

}  // namespace

Detection detection(const DiagnosisProblem& problem, const Fit& fit, const Origin& origin, const Vectors& shared,
                    const std::vector<Candidate>& candidates, const DetectionSettings& settings) {
  std::vector<const Candidate*> asked;
  for (const Candidate& c : candidates)
    if ((c.kind == Candidate::Kind::effect || c.kind == Candidate::Kind::damping) && !c.parameters.empty())
      asked.push_back(&c);
  Eigen::VectorXd x = fit.best.x;
  x.head(Eigen::Index(fit.hypothesis.materials.size())).setZero();
  const Extended all = extended(problem, origin, fit.hypothesis, x, settings.further > 0, settings.threads);
  const Distance distance(all, fit.hypothesis, x, origin, shared, fit.scale);
  std::vector<std::optional<Found>> found(asked.size());
  for_all(asked.size(), settings.threads, [&](std::size_t i) {
    try {
      const Amounts amounts(all, fit.hypothesis, x, origin, *asked[i], distance);
      found[i] = look_for(*asked[i], amounts, distance, problem.damping, settings.margin);
    } catch (const std::runtime_error&) {
      // Its place is taken by an effect that is there already.
    }
  });
  Detection d;
  std::vector<Trace> traces;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) continue;
    d.least.push_back(found[i]->least);
    for (Trace& trace : found[i]->traces) trace.candidate = i, traces.push_back(std::move(trace));
  }
  for (const bool sensors : {true, false})
    for (Addition& a : best_additions(all, sensors, distance.covariance(), traces, settings.further))
      d.further.push_back(std::move(a));
  // Distances are not exactly proportional, so the effects that each addition helps most are determined again.
  std::vector<std::pair<Addition::Helped*, const std::vector<int>*>> helped;
  for (Addition& a : d.further)
    for (Addition::Helped& h : a.most) helped.emplace_back(&h, &a.rows);
  for_all(helped.size(), settings.threads, [&](std::size_t i) {
    auto [h, rows] = helped[i];
    const Trace& trace = traces[h->trace];
    const Candidate& c = *asked[trace.candidate];
    const Amounts amounts(all, fit.hypothesis, x, origin, c, distance);
    const Found more =
        look_for(c, amounts, distance.with(*rows), problem.damping, settings.margin, trace.above ? 1 : -1);
    const double factor = fall(found[trace.candidate]->least, more.least, trace.above);
    if (std::isfinite(factor)) h->factor = std::min(factor, 1.0);
  });
  for (Addition& a : d.further)
    std::stable_sort(a.most.begin(), a.most.end(), [](const auto& p, const auto& q) { return p.factor < q.factor; });
  return d;
}

}  // namespace voussoir
