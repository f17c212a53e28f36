#include "solver/motion/select.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/random.h"

namespace voussoir {

namespace {

using Set = std::vector<std::size_t>;
constexpr std::size_t kept = 3000;  // sets that go on to the second part

struct Candidate {
  double score = 0.0;
  Set records;
  bool operator<(const Candidate& other) const {
    return score != other.score ? score < other.score : records < other.records;
  }
};

/// Score of a set as half xᵀAx − bᵀx + constant in its factors x.
struct Quadratic {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  double constant = 0.0;
  double at(const Eigen::VectorXd& x) const { return 0.5 * x.dot(a * x) - b.dot(x) + constant; }
};

/// Products of the columns once for all sets.
struct Products {
  const SelectionProblem& problem;
  Eigen::MatrixXd gram;  // ratios^T ratios / periods
  Eigen::VectorXd sums;  // ratios^T 1 / periods

  explicit Products(const SelectionProblem& p)
      : problem(p),
        gram(p.ratios.transpose() * p.ratios / double(p.ratios.rows())),
        sums(p.ratios.colwise().sum().transpose() / double(p.ratios.rows())) {}

  Quadratic of(const Set& set) const {
    const auto n = Eigen::Index(set.size());
    const double w = problem.weight / double(n);
    Quadratic q{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), 1.0 + problem.weight};
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto ri = Eigen::Index(set[std::size_t(i)]);
      q.b[i] = 2.0 * (sums[ri] / double(n) + w);
      for (Eigen::Index j = 0; j < n; ++j)
        q.a(i, j) = 2.0 * gram(ri, Eigen::Index(set[std::size_t(j)])) / double(n * n) + (i == j ? 2.0 * w : 0.0);
    }
    return q;
  }

  /// Least score within the bounds of the factors alone.
  double best_within_factors(const Set& set) const {
    const Quadratic q = of(set);
    Eigen::VectorXd x = Eigen::VectorXd::Constant(q.b.size(), std::clamp(1.0, problem.least, problem.most));
    for (int sweep = 0; sweep < 60; ++sweep) {
      double change = 0.0;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double next = std::clamp(x[i] + (q.b[i] - q.a.row(i).dot(x)) / q.a(i, i), problem.least, problem.most);
        change = std::max(change, std::abs(next - x[i]));
        x[i] = next;
      }
      if (change < 1e-4) break;
    }
    return q.at(x);
  }
};

/// The best sets seen, each once.
class Best {
 public:
  void add(double score, const Set& set) {
    if (sets_.size() == kept && score >= sets_.rbegin()->score) return;
    sets_.insert({score, set});
    if (sets_.size() > kept) sets_.erase(std::prev(sets_.end()));
  }
  const std::set<Candidate>& sets() const { return sets_; }

 private:
  std::set<Candidate> sets_;
};

/// Number of sets that keep the limit per event (as a double: it may be huge).
double count_sets(const SelectionProblem& p) {
  std::map<int, std::size_t> sizes;
  for (const int event : p.events) ++sizes[event];
  std::vector<double> ways(p.count + 1, 0.0);
  ways[0] = 1.0;
  for (const auto& [event, size] : sizes) {
    std::vector<double> next(p.count + 1, 0.0);
    double choose = 1.0;  // of this event's records
    for (std::size_t k = 0; k <= std::min({size, p.per_event, p.count}); ++k) {
      for (std::size_t n = k; n <= p.count; ++n) next[n] += choose * ways[n - k];
      choose *= double(size - k) / double(k + 1);
    }
    ways = next;
  }
  return ways[p.count];
}

bool keeps_limit(const SelectionProblem& p, const Set& set) {
  std::map<int, std::size_t> taken;
  return std::ranges::all_of(set, [&](std::size_t r) { return ++taken[p.events[r]] <= p.per_event; });
}

/// Every set, in the order of its records.
void try_all(const SelectionProblem& p, const Products& products, Set& set, std::size_t from, Best& best,
             double& tried) {
  if (set.size() == p.count) {
    ++tried;
    best.add(products.best_within_factors(set), set);
    return;
  }
  for (std::size_t r = from; r < p.events.size(); ++r) {
    set.push_back(r);
    if (keeps_limit(p, set)) try_all(p, products, set, r + 1, best, tried);
    set.pop_back();
  }
}

Set random_set(const SelectionProblem& p, RandomStream& random) {
  Set order(p.events.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  Set set;
  for (const std::size_t r : order) {
    set.push_back(r);
    if (!keeps_limit(p, set)) set.pop_back();
    if (set.size() == p.count) break;
  }
  std::ranges::sort(set);
  return set;
}

/// From random sets to better ones by exchanging one record at a time, the best exchange first, until none helps.
void try_exchanges(const SelectionProblem& p, const Products& products, Best& best, double& tried) {
  RandomStream random(p.seed);
  while (tried < double(p.tries)) {
    Set set = random_set(p, random);
    double score = products.best_within_factors(set);
    best.add(score, set);
    ++tried;
    for (bool better = true; better && tried < double(p.tries);) {
      better = false;
      Set next;
      for (std::size_t out = 0; out < p.count; ++out)
        for (std::size_t in = 0; in < p.events.size(); ++in) {
          if (std::ranges::find(set, in) != set.end()) continue;
          Set other = set;
          other[out] = in;
          std::ranges::sort(other);
          if (!keeps_limit(p, other)) continue;
          ++tried;
          const double s = products.best_within_factors(other);
          best.add(s, other);
          if (s < score) score = s, next = other, better = true;
        }
      if (better) set = next;
    }
  }
}

/// Bounds as rows: c x <= d.
struct Bounds {
  Eigen::MatrixXd c;
  Eigen::VectorXd d;
};
Bounds bounds_of(const SelectionProblem& p, const Set& set) {
  const Eigen::Index n = Eigen::Index(set.size()), m = p.ratios.rows();
  Bounds bounds{Eigen::MatrixXd::Zero(2 * m + 2 * n, n), Eigen::VectorXd(2 * m + 2 * n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    bounds.c.col(i).head(m) = p.ratios.col(Eigen::Index(set[std::size_t(i)])) / double(n);
    bounds.c(2 * m + i, i) = 1.0;
    bounds.c(2 * m + n + i, i) = -1.0;
  }
  bounds.c.middleRows(m, m) = -bounds.c.topRows(m);
  const double inside = 1e-6;  // so that rounding does not cross them
  bounds.d << Eigen::VectorXd::Constant(m, p.high - inside), Eigen::VectorXd::Constant(m, -p.low - inside),
      Eigen::VectorXd::Constant(n, p.most), Eigen::VectorXd::Constant(n, -p.least);
  return bounds;
}

/// Factors of least score within all bounds; by how much the worst bound is missed comes back in `miss`.
Eigen::VectorXd best_within_all(const Quadratic& q, const Bounds& bounds, double& miss) {
  const Eigen::LDLT<Eigen::MatrixXd> inverse(q.a);
  const Eigen::MatrixXd h = bounds.c * inverse.solve(bounds.c.transpose());
  const Eigen::VectorXd free = inverse.solve(q.b), g = bounds.d - bounds.c * free;
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(g.size()), pressed = Eigen::VectorXd::Zero(g.size());  // h λ
  for (int sweep = 0; sweep < 400; ++sweep) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < g.size(); ++i) {
      const double next = std::max(0.0, multipliers[i] - (pressed[i] + g[i]) / h(i, i));
      if (next == multipliers[i]) continue;
      change = std::max(change, std::abs(next - multipliers[i]) * h(i, i));
      pressed += (next - multipliers[i]) * h.col(i);
      multipliers[i] = next;
    }
    if (change < 1e-9) break;
  }
  const Eigen::VectorXd x = free - inverse.solve(bounds.c.transpose() * multipliers);
  miss = std::max(0.0, (bounds.c * x - bounds.d).maxCoeff());
  return x;
}

void check(const SelectionProblem& p) {
  const std::size_t n = p.events.size();
  if (p.count < 1 || n < p.count)
    throw InputError("{} required, but {} are available", counted(p.count, "record is", "records are"), n);
  if (!(p.low > 0.0 && p.low <= 1.0 && p.high >= 1.0))
    throw InputError(
        "the bounds of the mean over the target are {} and {}. The first must be above 0 and at most 1, the second at "
        "least 1.",
        p.low, p.high);
  if (!(p.least > 0.0 && p.least < p.most))
    throw InputError("the scale factors are from {} to {}. The first must be above 0 and below the second.", p.least,
                     p.most);
  if (p.per_event < 1 || count_sets(p) < 1.0)
    throw InputError(
        "{} records with at most {} of one event are required, but there are not enough events. Allow more records of "
        "one "
        "event.",
        p.count, p.per_event);
}

}  // namespace

Selection select_records(const SelectionProblem& p) {
  check(p);
  const Products products(p);
  Selection selection;
  Best best;
  selection.all_tried = count_sets(p) <= double(p.tries);
  if (selection.all_tried) {
    Set set;
    try_all(p, products, set, 0, best, selection.tried);
  } else {
    try_exchanges(p, products, best, selection.tried);
  }
  double least_miss = INFINITY;
  for (const Candidate& candidate : best.sets()) {
    // The score of a set with fewer bounds is a lower limit for its score with all bounds.
    if (selection.found && candidate.score >= selection.score) break;
    const Quadratic q = products.of(candidate.records);
    double miss = 0.0;
    const Eigen::VectorXd x = best_within_all(q, bounds_of(p, candidate.records), miss);
    const bool found = miss <= 1e-6;
    if (selection.found ? !found || q.at(x) >= selection.score : !found && miss >= least_miss) continue;
    selection.found = found;
    least_miss = miss;
    selection.score = q.at(x);
    selection.records = candidate.records;
    selection.factors.assign(x.begin(), x.end());
  }
  const auto n = double(p.count);
  selection.mean.assign(std::size_t(p.ratios.rows()), 0.0);
  for (std::size_t i = 0; i < selection.records.size(); ++i)
    for (Eigen::Index k = 0; k < p.ratios.rows(); ++k)
      selection.mean[std::size_t(k)] += selection.factors[i] * p.ratios(k, Eigen::Index(selection.records[i])) / n;
  return selection;
}

}  // namespace voussoir
