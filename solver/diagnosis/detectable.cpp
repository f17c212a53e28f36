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
  Distance(const DiagnosisProblem& problem, const Fit& fit) : rows_(residual_rows(problem)) {
    fitted_ = split_rows(problem, rows_).fitted;
    const Eigen::MatrixXd j = (problem.colouring * fit.jacobian)(fitted_, Eigen::all);
    white_ = whitening_of(problem.covariance.at(fit.scale)(fitted_, fitted_) + j * j.transpose());
  }
  const std::vector<ResidualRow>& rows() const { return rows_; }
  double between(const Eigen::VectorXd& one, const Eigen::VectorXd& other) const {
    return (white_ * Eigen::VectorXd(one(fitted_) - other(fitted_))).norm();
  }

 private:
  std::vector<ResidualRow> rows_;
  std::vector<int> fitted_;
  Eigen::MatrixXd white_;
};

/// The effect's first parameter from where it changes nothing to a bound.
struct Way {
  double neutral = 0.0, bound = 0.0;
  double at(double share, const FitParameter& p) const {
    return p.logarithmic ? neutral * std::pow(bound / neutral, share) : neutral + share * (bound - neutral);
  }
};

/// Models with an effect of any amount beside the hypothesis of a fit.
class Amounts {
 public:
  Amounts(const DiagnosisProblem& problem, const Fit& fit, const Origin& origin, const Candidate& candidate,
          const Distance& distance)
      : problem_(&problem), candidate_(&candidate), hypothesis_(fit.hypothesis.with(candidate)), distance_(&distance) {
    x_ = fit.best.x;
    x_.head(Eigen::Index(fit.hypothesis.materials.size())).setZero();
    first_ = x_.size();
    x_.conservativeResize(Eigen::Index(hypothesis_.size()));
    x_.tail(x_.size() - first_) = Eigen::Map<const Eigen::VectorXd>(candidate.starts[0].data(), x_.size() - first_);
    if (candidate.kind == Candidate::Kind::effect) {
      family_ = std::make_unique<ModelFamily>(origin, problem.base, hypothesis_,
                                              question_of(problem, origin.response()), x_, ModelFamily::Use::often);
      family_->converge(x_, 1e-3);
    }
    response_ = origin.response();
  }
  /// Measured − computed.
  Eigen::VectorXd rows_at(double value) const {
    Eigen::VectorXd x = x_;
    x[first_] = candidate_->parameters[0].x(value);
    const Response response = family_ ? family_->response(family_->member(x)) : response_;
    const Observed seen = hypothesis_.observe(response, problem_->damping, x);
    return differences(*problem_, distance_->rows(), pair_features(problem_->features, response, seen.readings), seen);
  }

 private:
  const DiagnosisProblem* problem_;
  const Candidate* candidate_;
  Hypothesis hypothesis_;
  const Distance* distance_;
  Eigen::VectorXd x_;
  Eigen::Index first_ = 0;
  std::unique_ptr<ModelFamily> family_;
  Response response_;
};

/// The evidence for an amount that is there exceeds half the square of its distance, less what freedom costs, with the
/// probability ½; 1.28 standard deviations farther with 0.9.
double distance_needed(const Candidate& c, double margin, double slope) {
  const double occam = 0.5 * std::log(1.0 + slope * slope);  // slope: of the distance over x
  return 1.2816 + std::sqrt(2.0 * std::max(margin - std::log(c.prior) + occam, 0.0));
}

/// Least value on the way at which the distance is as large as needed.
double least_on(const Way& way, const Amounts& amounts, const Distance& distance, const Candidate& c, double margin) {
  constexpr int halvings = 6;
  const FitParameter& p = c.parameters[0];
  const Eigen::VectorXd none = amounts.rows_at(way.neutral);
  const auto is_found = [&](double share) {
    const double value = way.at(share, p), apart = distance.between(amounts.rows_at(value), none);
    const double steps = std::abs(p.x(value) - p.x(way.neutral));
    return apart >= distance_needed(c, margin, steps > 0.0 ? apart / steps : 0.0);
  };
  if (!is_found(1.0)) return not_found;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (is_found(middle) ? high : low) = middle;
  }
  return way.at(high, p);
}

}  // namespace

std::vector<Detectable> least_amounts(const DiagnosisProblem& problem, const Fit& fit, const Origin& origin,
                                      const std::vector<Candidate>& candidates, const DetectionSettings& settings) {
  std::vector<const Candidate*> asked;
  for (const Candidate& c : candidates)
    if ((c.kind == Candidate::Kind::effect || c.kind == Candidate::Kind::damping) && !c.parameters.empty())
      asked.push_back(&c);
  const Distance distance(problem, fit);
  std::vector<std::optional<Detectable>> found(asked.size());
  for_all(asked.size(), settings.threads, [&](std::size_t i) {
    const Candidate& c = *asked[i];
    const EffectParameter& p = find_effect(c.name).parameters[0];
    const FitParameter& own = c.parameters[0];
    Detectable d = {c.name, c.where, p.name, p.unit, p.neutral, not_found, not_found};
    if (c.kind == Candidate::Kind::damping) d.neutral = problem.damping;
    try {
      const Amounts amounts(problem, fit, origin, c, distance);
      const double neutral = std::clamp(d.neutral, own.low, own.high);
      if (own.low < neutral) d.below = least_on({neutral, own.low}, amounts, distance, c, settings.margin);
      if (own.high > neutral) d.above = least_on({neutral, own.high}, amounts, distance, c, settings.margin);
      found[i] = d;
    } catch (const std::runtime_error&) {
      // Its place is taken by an effect that is there already.
    }
  });
  std::vector<Detectable> all;
  for (const auto& d : found)
    if (d) all.push_back(*d);
  return all;
}

}  // namespace voussoir
