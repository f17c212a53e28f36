// Each refinement is one step of block inverse iteration with the origin's factor in place of the changed model's,
// followed by Rayleigh and Ritz over all vectors so far (Knyazev 2001, whose conjugate directions the earlier vectors
// hold). Static corrections of fixed bases for families of models: Balmès 1996.
#include "solver/diagnosis/reduced_model.h"

#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

/// Of the origin's unknowns, the rest being zero.
Vectors padded(const Vectors& top, Eigen::Index rows) {
  Vectors v = Vectors::Zero(rows, top.cols());
  v.topRows(top.rows()) = top;
  return v;
}

/// A X of the origin's matrix, rows below its unknowns zero. By rows of X, which lie together.
Vectors times(const SparseMatrix& a, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  for (Eigen::Index column = 0; column < a.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry) {
      y.row(entry.row()) += entry.value() * x.row(column);
      if (entry.row() != column) y.row(column) += entry.value() * x.row(entry.row());
    }
  return y;
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& a) {
  return 0.5 * (a + a.transpose());
}

/// Combinations of the basis that are orthonormal in K, without those that others make up to rounding.
Eigen::MatrixXd independent(const Eigen::MatrixXd& k) {
  constexpr double least = 1e-10;
  const Eigen::VectorXd scale = k.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd unit = scale.asDiagonal() * k * scale.asDiagonal();
  const EigenSolution<Eigen::MatrixXd> all = eigen_solution(unit);
  Eigen::Index first = 0;
  while (first < all.values.size() && all.values[first] < least) ++first;
  const Eigen::Index n = all.values.size() - first;
  return scale.asDiagonal() * all.vectors.rightCols(n) * all.values.tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

Origin::Origin(const Assembly& own, const std::vector<Sensor>& sensors, int modes, bool driven)
    : assembly_(own),
      parts_(contributions(assembly_)),
      model_(linear_model(assembly_, parts_)),
      response_(voussoir::response(assembly_, model_, sensors, modes, memory_, driven)) {}

Vectors Origin::static_response(const Vectors& forces) const {
  const Eigen::MatrixXd own = forces.topRows(model_.unknowns.count);
  return padded(memory_.factor.solve(own), forces.rows());
}

ReducedModel::ReducedModel(const Origin& origin, const Assembly& changed, Classes classes)
    : origin_(&origin),
      classes_(std::move(classes)),
      unknowns_(with_freed(origin.model().unknowns, origin.assembly(), changed)) {
  const Eigen::Index known = origin.model().unknowns.count, all = unknowns_.count;
  v_.resize(all, 0);
  k_.classes.resize(classes_.stiffness.size());
  m_.classes.resize(classes_.mass.size());
  const Response& modes = origin.response();
  Vectors first = Vectors::Zero(all, modes.vectors.cols() + all - known), stiffness = first;
  first.topLeftCorner(known, modes.vectors.cols()) = modes.vectors;
  first.bottomRightCorner(all - known, all - known).setIdentity();
  stiffness.leftCols(modes.vectors.cols()) =
      times(origin.model().m, first.leftCols(modes.vectors.cols())) * modes.eigenvalues.asDiagonal();
  append(first, &stiffness);
}

void ReducedModel::append(const Vectors& more, const Vectors* stiffness) {
  const Eigen::Index old = v_.cols(), added = more.cols();
  Vectors whole(v_.rows(), old + added);
  whole << v_, more;
  v_ = std::move(whole);
  const auto grow = [&](Eigen::MatrixXd& projected, const Eigen::MatrixXd& across) {
    projected.conservativeResize(old + added, old + added);
    projected.rightCols(added) = across;
    projected.bottomRows(added) = across.transpose();
    projected.bottomRightCorner(added, added) = symmetric(across.bottomRows(added));
  };
  grow(k_.whole, v_.transpose() * (stiffness ? *stiffness : times(origin_->model().k, more)));
  grow(m_.whole, v_.transpose() * times(origin_->model().m, more));
  for (std::size_t c = 0; c < classes_.stiffness.size(); ++c)
    grow(k_.classes[c], project_stiffness(origin_->parts(), classes_.stiffness[c], unknowns_, v_, more));
  for (std::size_t c = 0; c < classes_.mass.size(); ++c)
    grow(m_.classes[c], project_mass(origin_->parts(), classes_.mass[c], unknowns_, v_, more));
}

Eigen::MatrixXd ReducedModel::sum(const Projected& p, const std::vector<double>& factors) const {
  Eigen::MatrixXd sum = p.whole;
  for (std::size_t c = 0; c < factors.size(); ++c)
    if (factors[c] != 1.0) sum += (factors[c] - 1.0) * p.classes[c];
  return sum;
}

ReducedModel::Matrices ReducedModel::matrices(const Change& change) const {
  return {symmetric(sum(k_, change.stiffness) + project_stiffness(change.others, unknowns_, v_, v_)),
          symmetric(sum(m_, change.mass) + project_mass(change.others, unknowns_, v_, v_))};
}

ReducedModes ReducedModel::modes(const Matrices& matrices) const {
  const Eigen::MatrixXd t = independent(matrices.k);
  // M z = (1/λ) K z, K being nearly 1.
  const EigenSolution<Eigen::MatrixXd> all =
      eigen_solution(symmetric(t.transpose() * matrices.m * t), symmetric(t.transpose() * matrices.k * t));
  ReducedModes modes;
  modes.eigenvalues = all.values.reverse().cwiseInverse();
  modes.q = t * all.vectors.rowwise().reverse() * modes.eigenvalues.cwiseSqrt().asDiagonal();
  return modes;
}

Vectors ReducedModel::times_stiffness(const Change& change, const Vectors& x) const {
  Vectors y = times(origin_->model().k, x) + voussoir::times_stiffness(change.others, unknowns_, x);
  for (std::size_t c = 0; c < change.stiffness.size(); ++c)
    if (change.stiffness[c] != 1.0)
      add_stiffness(origin_->parts(), classes_.stiffness[c], change.stiffness[c] - 1.0, unknowns_, x, y);
  return y;
}

Vectors ReducedModel::times_mass(const Change& change, const Vectors& x) const {
  Vectors y = times(origin_->model().m, x) + voussoir::times_mass(change.others, unknowns_, x);
  for (std::size_t c = 0; c < change.mass.size(); ++c)
    if (change.mass[c] != 1.0) add_mass(origin_->parts(), classes_.mass[c], change.mass[c] - 1.0, unknowns_, x, y);
  return y;
}

double ReducedModel::refine(const Change& change, int wanted) {
  const ReducedModes found = modes(matrices(change));
  const Eigen::Index n = std::min<Eigen::Index>(wanted, found.q.cols());
  const Vectors y = vectors(found, n);
  const Vectors force = times_mass(change, y) * found.eigenvalues.head(n).asDiagonal() - times_stiffness(change, y);
  const Vectors move = origin_->static_response(force);
  double most = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) most = std::max(most, move.col(i).dot(force.col(i)) / found.eigenvalues[i]);
  // (K₀ − σ M₀) move is the force over the origin's unknowns.
  Vectors stiffness = force;
  stiffness.bottomRows(force.rows() - origin_->model().unknowns.count).setZero();
  stiffness += origin_->shift() * times(origin_->model().m, move);
  append(move, &stiffness);
  return most;
}

double ReducedModel::converge(const Change& change, int wanted, double tolerance, int most) {
  double error = 0.0;
  for (int i = 0; i < most; ++i)
    if (error = refine(change, wanted); error < tolerance) break;
  return error;
}

Eigen::MatrixXd ReducedModel::along_origin(const ReducedModes& modes, Eigen::Index count) const {
  return m_.whole.topRows(origin_->response().vectors.cols()) * modes.q.leftCols(count);
}

Eigen::MatrixXd ReducedModel::vectors(const ReducedModes& modes, Eigen::Index count) const {
  return v_ * modes.q.leftCols(std::min(count, modes.q.cols()));
}

}  // namespace voussoir
