#include "solver/diagnosis/model_family.h"

#include <cmath>

namespace voussoir {

namespace {

double step_down(const FitParameter& p, double x, double step) {
  return std::max(x - step, std::min(x, p.x(p.low)));
}
double step_up(const FitParameter& p, double x, double step) {
  return std::min(x + step, std::max(x, p.x(p.high)));
}

/// Away from all values at which two things happen to change alike.
Eigen::VectorXd generic(const Hypothesis& hypothesis, Eigen::VectorXd x) {
  const std::vector<FitParameter> parameters = hypothesis.parameters();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const FitParameter& p = parameters[std::size_t(i)];
    x[i] = std::clamp(x[i] + 0.0313 + 0.0171 * double(i), p.x(p.low), p.x(p.high));
  }
  return x;
}

ModelFamily::GroundRows ground_rows(const ReducedModel& reduced, const Assembly& assembly, const Change& change) {
  const Eigen::MatrixXd inertia = reduced.times_mass(change, translations(reduced.unknowns()));
  const GroundForces ground = ground_forces(assembly, reduced.unknowns(), inertia);
  ModelFamily::GroundRows rows = {ground.inertia.transpose() * reduced.basis(), {}};
  for (const Eigen::MatrixXd& pull : ground.pull) rows.pull.push_back(pull.transpose() * reduced.basis());
  return rows;
}

/// One over what modes differ by; of those that nearly coincide, which are a plane, as if they were a little apart.
double one_over_gap(double other, double own) {
  double gap = other - own;
  const double least = 1e-3 * own;
  if (std::abs(gap) < least) gap = gap < 0.0 ? -least : least;
  return 1.0 / gap;
}

/// q′ of the first `count` modes over all of the basis' modes.
Eigen::MatrixXd moved_modes(const ReducedModes& modes, const Eigen::MatrixXd& dk, const Eigen::MatrixXd& dm,
                            Eigen::Index count, Eigen::VectorXd& dlambda) {
  const Eigen::MatrixXd k = modes.q.transpose() * dk * modes.q.leftCols(count),
                        m = modes.q.transpose() * dm * modes.q.leftCols(count);
  Eigen::MatrixXd shares(modes.q.cols(), count);
  dlambda.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double lambda = modes.eigenvalues[i];
    dlambda[i] = k(i, i) - lambda * m(i, i);
    for (Eigen::Index j = 0; j < shares.rows(); ++j)
      shares(j, i) =
          j == i ? -0.5 * m(i, i) : (lambda * m(j, i) - k(j, i)) * one_over_gap(modes.eigenvalues[j], lambda);
  }
  return modes.q * shares;
}

}  // namespace

ModelFamily::ModelFamily(const Origin& origin, const Assembly& base, const Hypothesis& hypothesis,
                         const Question& question, const Eigen::VectorXd& x, Use use)
    : origin_(&origin),
      base_(&base),
      hypothesis_(hypothesis),
      question_(question),
      copy_(origin.copy_of(base)),
      reduced_(reduced_model(x, use)) {
  project_sensors();
}

ReducedModel ModelFamily::reduced_model(const Eigen::VectorXd& x, Use use) const {
  Classes classes;
  if (use == Use::often) classes = find_classes(origin_->assembly(), assembly_at(generic(hypothesis_, x)));
  return {*origin_, assembly_at(x), std::move(classes)};
}

void ModelFamily::project_sensors() {
  const Basis basis(reduced_.basis());
  seen_ = at_sensors(origin_->assembly(), reduced_.unknowns(), question_.sensors, basis);
  motions_ = at_sensors(origin_->assembly(), reduced_.unknowns(), along_axes(question_.sensors), basis);
}

const Assembly& ModelFamily::assembly_at(const Eigen::VectorXd& x) const {
  take_back_effects(*copy_, *base_);
  hypothesis_.change(*copy_, x);
  return *copy_;
}

ModelFamily::Member ModelFamily::without_modes(const Eigen::VectorXd& x) const {
  Member m;
  m.x = x;
  const Assembly& assembly = assembly_at(x);
  const Change change = find_change(origin_->assembly(), reduced_.classes(), assembly);
  m.matrices = reduced_.matrices(change);
  if (question_.driven) m.ground = ground_rows(reduced_, assembly, change);
  return m;
}

ModelFamily::Member ModelFamily::member(const Eigen::VectorXd& x) const {
  Member m = without_modes(x);
  m.modes = reduced_.modes(m.matrices);
  return m;
}

Response ModelFamily::response(const Member& member) const {
  const ReducedModes& modes = member.modes;
  const Eigen::Index count = std::min<Eigen::Index>(question_.modes, modes.q.cols());
  const Response& known = origin_->response();
  Response r;
  r.eigenvalues = modes.eigenvalues.head(count);
  r.log_frequency = (r.eigenvalues.cwiseSqrt() / (2.0 * EIGEN_PI)).array().log();
  r.sensors = seen_ * modes.q.leftCols(count);
  r.motions = motions_ * modes.q.leftCols(count);
  // A mode has the words of the origin's mode that it has most of.
  const Eigen::MatrixXd alike = reduced_.along_origin(modes, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index most = 0;
    const double share = alike.col(i).cwiseAbs2().maxCoeff(&most);
    if (share > 0.5)
      r.words.push_back(known.words[std::size_t(most)]);
    else
      r.words.push_back(
          words_of(origin_->assembly(), reduced_.unknowns(), r.eigenvalues[i], reduced_.basis() * modes.q.col(i)));
  }
  if (!question_.driven) return r;
  const GroundRows& ground = member.ground;
  r.participation = ground.inertia * modes.q.leftCols(count);
  const Eigen::RowVectorXd over = r.eigenvalues.cwiseInverse().transpose();
  for (const Eigen::MatrixXd& pull : ground.pull)
    r.at_support.push_back((pull * modes.q.leftCols(count)).array().rowwise() * over.array());
  return r;
}

ModalData ModelFamily::derivative(const Member& member, Eigen::Index index) const {
  constexpr double step = 1e-4;  // to one side: K and M are smooth in x, and the other side would cost as much again
  const FitParameter p = hypothesis_.parameters()[std::size_t(index)];
  Eigen::VectorXd x = member.x;
  x[index] = step_up(p, member.x[index], step);
  if (x[index] == member.x[index]) x[index] = step_down(p, member.x[index], step);
  const Member moved = without_modes(x);
  const double apart = x[index] - member.x[index];
  const ReducedModes& modes = member.modes;
  const Eigen::Index count = std::min<Eigen::Index>(question_.modes, modes.q.cols());
  Eigen::VectorXd dlambda;
  const Eigen::MatrixXd dq = moved_modes(modes, (moved.matrices.k - member.matrices.k) / apart,
                                         (moved.matrices.m - member.matrices.m) / apart, count, dlambda);
  ModalData d;
  d.log_frequency = 0.5 * dlambda.cwiseQuotient(modes.eigenvalues.head(count));
  d.sensors = seen_ * dq;
  d.motions = motions_ * dq;
  if (!question_.driven) return d;
  const GroundRows &g = member.ground, &g1 = moved.ground;
  const Eigen::MatrixXd q = modes.q.leftCols(count);
  const Eigen::ArrayXd over = modes.eigenvalues.head(count).array().inverse();
  d.participation = g.inertia * dq + (g1.inertia - g.inertia) / apart * q;
  for (std::size_t k = 0; k < g.pull.size(); ++k) {
    const Eigen::MatrixXd work = g.pull[k] * dq + (g1.pull[k] - g.pull[k]) / apart * q;
    const Eigen::ArrayXXd own = g.pull[k] * q;
    d.at_support.push_back(work.array().rowwise() * over.transpose() -
                           own.rowwise() * (over * over * dlambda.array()).transpose());
  }
  return d;
}

Change ModelFamily::change_at(const Eigen::VectorXd& x) const {
  return find_change(origin_->assembly(), reduced_.classes(), assembly_at(x));
}

double ModelFamily::converge(const Eigen::VectorXd& x, double tolerance) {
  constexpr int most = 8;
  const double error = reduced_.converge(change_at(x), question_.wanted, tolerance, most);
  project_sensors();
  return error;
}

double ModelFamily::refine(const Eigen::VectorXd& x) {
  const double error = reduced_.refine(change_at(x), question_.wanted);
  project_sensors();
  return error;
}

void ModelFamily::append(const Vectors& more) {
  if (more.cols() == 0) return;
  Vectors all = Vectors::Zero(reduced_.unknowns().count, more.cols());
  all.topRows(more.rows()) = more;
  reduced_.append(all);
  project_sensors();
}

Vectors material_vectors(const Origin& origin, const Assembly& base, const Hypothesis& hypothesis,
                         const Eigen::VectorXd& x, int wanted) {
  const Response& known = origin.response();
  const Eigen::Index n = std::min<Eigen::Index>(wanted, known.vectors.cols());
  const Vectors phi = known.vectors.leftCols(n);
  const auto materials = Eigen::Index(hypothesis.materials.size());
  Vectors all(phi.rows(), n * materials);
  for (Eigen::Index p = 0; p < materials; ++p) {
    constexpr double step = 1e-3;
    Eigen::VectorXd low = x, high = x;
    low[p] -= step, high[p] += step;
    const std::shared_ptr<Assembly> below = origin.copy_of(base), above = origin.copy_of(base);
    hypothesis.change(*below, low), hypothesis.change(*above, high);
    const Contributions d = derivative(*below, *above, 2.0 * step);
    const Vectors force = times_mass(d, origin.model().unknowns, phi) * known.eigenvalues.head(n).asDiagonal() -
                          times_stiffness(d, origin.model().unknowns, phi);
    all.middleCols(p * n, n) = origin.static_response(force);
  }
  return all;
}

}  // namespace voussoir
