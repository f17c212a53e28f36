#include "solver/diagnosis/misfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

/// How well the standard deviations themselves are known: the model's are measured on half a dozen modes.
constexpr double std_doubt = 1.1;

std::string kind_name(ResidualRow::Kind kind) {
  static const char* const names[] = {"frequencies", "shapes",        "damping ratios",
                                      "phases",      "participation", "phases of participation"};
  return names[int(kind)];
}

}  // namespace

Tail tail(const DiagnosisProblem& problem, const Fit& fit) {
  const std::vector<ResidualRow> rows = residual_rows(problem);
  // No measurement is held to less error than it says it has, however well most of it agrees; and errors of the model
  // that would have to be more than twice as large as they are taken are a misfit.
  const Eigen::MatrixXd covariance =
      problem.covariance.at({std::min(fit.scale.structure, 2.0), std::max(fit.scale.shapes, 1.0)});
  using Kind = ResidualRow::Kind;
  // Phases by sensor: many right clocks do not excuse one that is late.
  std::map<std::pair<Kind, int>, std::vector<int>> kinds;
  const std::vector<int> fitted = split_rows(problem, rows).fitted;
  for (const int i : fitted) {
    const ResidualRow& row = rows[std::size_t(i)];
    kinds[{row.kind, row.kind == Kind::quadrature ? row.sensor : 0}].push_back(i);
  }
  int shapes = 0, phases = 0;  // whose scales are free
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const MeasuredFeature& mode = problem.features.modes[m];
    if (mode.held_back || problem.shape_metric[m].size() == 0) continue;
    ++shapes;
    phases += mode.quadrature.size() > 0;
  }
  const auto misfit_of = [&](const std::vector<int>& of) {
    const Eigen::VectorXd d = fit.best.differences(of);
    return d.dot(solve_symmetric(Eigen::MatrixXd(covariance(of, of)), d));
  };
  Tail worst;
  const auto look_at = [&](double times, double misfit, int freedom, const std::string& of) {
    const double probability = times * chi_square_tail(misfit / (std_doubt * std_doubt), freedom);
    if (probability < worst.probability) worst = {probability, of};
  };
  // Materials that are pulled far are as unlikely as rows that are.
  const Eigen::VectorXd materials = fit.best.x.head(Eigen::Index(fit.hypothesis.materials.size()));
  const auto groups = double(kinds.size() + 1);
  look_at(groups, materials.squaredNorm(), int(materials.size()), "materials");
  for (const auto& [kind, of] : kinds)
    look_at(groups, misfit_of(of), int(of.size()) - (kind.first == Kind::shape ? shapes : 0),
            kind.first == Kind::quadrature ? "phases at " + problem.features.sensors[std::size_t(kind.second)].id
                                           : kind_name(kind.first));
  look_at(1.0, misfit_of(fitted) + fit.best.x.squaredNorm(), int(fitted.size()) - shapes - phases, "all");
  return worst;
}

std::string misfit_text(const Tail& t) {
  return t.of.empty() ? std::string("a misfit of this size is usual")
                      : fmt::format("a misfit at least this large has probability {:.2g} ({})", t.probability, t.of);
}

std::vector<std::string> alarms_of(const Fit& fit) {
  constexpr double far = 2.2;  // standard deviations
  std::vector<std::string> alarms;
  for (std::size_t i = 0; i < fit.hypothesis.materials.size(); ++i) {
    const FitParameter& p = fit.hypothesis.materials[i].parameter;
    const double x = fit.best.x[Eigen::Index(i)];
    if (std::abs(x) > far || fit.at_bound[i])
      alarms.push_back(fmt::format("{} × {:.2f}, {:+.1f} standard deviations from its usual value{}", p.name,
                                   p.value(x), x, fit.at_bound[i] ? " (at its bound)" : ""));
  }
  return alarms;
}

}  // namespace voussoir
