// Each refinement is one step of block inverse iteration with the origin's factor in place of the changed model's,
// followed by Rayleigh and Ritz over all vectors so far (Knyazev 2001, whose conjugate directions the earlier vectors
// hold). Static corrections of fixed bases for families of models: Balmès 1996.
#include "solver/diagnosis/reduced_model.h"

#include <algorithm>

#include "solver/effects/effect.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

/// Of the origin's unknowns, the rest being zero.
Vectors padded(const Vectors& top, Eigen::Index rows) {
  Vectors v = Vectors::Zero(rows, top.cols());
  v.topRows(top.rows()) = top;
  return v;
}

/// Columns from `first` on of y += A x.
template <int Columns>
void add_times(const SparseMatrix& a, const Vectors& x, Eigen::Index first, Vectors& y) {
  using Row = Eigen::Matrix<double, 1, Columns>;
  const auto of = [&](const Vectors& v, Eigen::Index row) {
    return Eigen::Map<const Row>(v.data() + row * v.cols() + first);
  };
  for (Eigen::Index column = 0; column < a.outerSize(); ++column) {
    const Row own = of(x, column);
    Row sum = Row::Zero();
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry) {
      sum += entry.value() * of(x, entry.row());
      if (entry.row() != column) Eigen::Map<Row>(y.data() + entry.row() * y.cols() + first) += entry.value() * own;
    }
    Eigen::Map<Row>(y.data() + column * y.cols() + first) += sum;
  }
}

/// A X of the origin's matrix, rows below its unknowns zero. By rows of X, which lie together.
Vectors times(const SparseMatrix& a, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  Eigen::Index first = 0;
  for (; first + 8 <= x.cols(); first += 8) add_times<8>(a, x, first, y);
  for (; first + 4 <= x.cols(); first += 4) add_times<4>(a, x, first, y);
  for (; first < x.cols(); ++first) add_times<1>(a, x, first, y);
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
      response_(voussoir::response(assembly_, model_, sensors, modes, memory_, driven)),
      momenta_(times(model_.m, response_.vectors)) {}

Vectors Origin::static_response(const Vectors& forces) const {
  const Eigen::MatrixXd own = forces.topRows(model_.unknowns.count);
  return padded(memory_.factor.solve(own), forces.rows());
}

std::shared_ptr<Assembly> Origin::copy_of(const Assembly& base) const {
  std::unique_ptr<Assembly> copy;
  {
    const std::lock_guard lock(copies_->one_at_a_time);
    if (copies_->base != &base) copies_->free.clear(), copies_->base = &base;
    if (!copies_->free.empty()) copy = std::move(copies_->free.back()), copies_->free.pop_back();
  }
  if (copy)
    take_back_effects(*copy, base);
  else
    copy = std::make_unique<Assembly>(base);
  return {copy.release(), [copies = copies_, of = &base](Assembly* done) {
            std::unique_ptr<Assembly> back(done);
            const std::lock_guard lock(copies->one_at_a_time);
            if (copies->base == of) copies->free.push_back(std::move(back));
          }};
}

ReducedModel::ReducedModel(const Origin& origin, const Assembly& changed, Classes classes)
    : origin_(&origin),
      classes_(std::move(classes)),
      unknowns_(with_freed(origin.model().unknowns, origin.assembly(), changed)) {
  const Eigen::Index known = origin.model().unknowns.count, all = unknowns_.count;
  v_.resize(all, 0);
  k_.classes.resize(classes_.stiffness.size());
  m_.classes.resize(classes_.mass.size());
  const auto is_wide = [&](Eigen::Index rows) { return rows > all / 4; };
  for (const auto& listed : classes_.stiffness)
    k_.wide.push_back(is_wide(stiffness_rows(origin.parts(), listed, unknowns_)));
  for (const auto& listed : classes_.mass) m_.wide.push_back(is_wide(mass_rows(origin.parts(), listed, unknowns_)));
  const Response& modes = origin.response();
  const Eigen::Index count = modes.vectors.cols();
  Vectors first = Vectors::Zero(all, count + all - known), momenta = first, stiffness = first;
  first.topLeftCorner(known, count) = modes.vectors;
  first.bottomRightCorner(all - known, all - known).setIdentity();
  momenta.topLeftCorner(known, count) = origin.momenta();
  stiffness.topLeftCorner(known, count) = origin.momenta() * modes.eigenvalues.asDiagonal();
  append(first, &stiffness, &momenta);
}

void ReducedModel::append(const Vectors& more, const Vectors* stiffness, const Vectors* momenta) {
  const Eigen::Index old = count_, added = more.cols();
  count_ += added;
  if (count_ > v_.cols()) {
    Vectors larger(v_.rows(), count_ + count_ / 2);
    larger.leftCols(old) = v_.leftCols(old);
    v_ = std::move(larger);
  }
  v_.middleCols(old, added) = more;
  const auto grow = [&](Projected& p) {
    p.whole.conservativeResize(count_, count_);
    for (Eigen::MatrixXd& of : p.classes) of.conservativeResize(count_, count_);
  };
  grow(k_), grow(m_);
  // Few columns at a time, but all products of these beside each other: the basis is read once for all of them.
  constexpr Eigen::Index together = 12;
  const auto wide = std::count(k_.wide.begin(), k_.wide.end(), true) + std::count(m_.wide.begin(), m_.wide.end(), true);
  for (Eigen::Index first = 0; first < added; first += together) {
    const Eigen::Index n = std::min(together, added - first);
    const Vectors w = more.middleCols(first, n);
    Vectors products = Vectors::Zero(w.rows(), n * (2 + wide));
    std::vector<Eigen::MatrixXd*> of = {&k_.whole, &m_.whole};
    products.leftCols(n) = stiffness ? Vectors(stiffness->middleCols(first, n)) : times(origin_->model().k, w);
    products.middleCols(n, n) = momenta ? Vectors(momenta->middleCols(first, n)) : times(origin_->model().m, w);
    const auto put = [&](Eigen::MatrixXd& projected, const auto& across) {
      projected.middleCols(old + first, n) = across;
    };
    const auto next = [&] { return products.middleCols(n * Eigen::Index(of.size()), n); };
    for (std::size_t c = 0; c < classes_.stiffness.size(); ++c)
      if (k_.wide[c])
        add_stiffness(origin_->parts(), classes_.stiffness[c], 1.0, unknowns_, w, next()), of.push_back(&k_.classes[c]);
      else
        put(k_.classes[c], project_stiffness(origin_->parts(), classes_.stiffness[c], unknowns_, basis(), w));
    for (std::size_t c = 0; c < classes_.mass.size(); ++c)
      if (m_.wide[c])
        add_mass(origin_->parts(), classes_.mass[c], 1.0, unknowns_, w, next()), of.push_back(&m_.classes[c]);
      else
        put(m_.classes[c], project_mass(origin_->parts(), classes_.mass[c], unknowns_, basis(), w));
    const Eigen::MatrixXd projected = basis().transpose() * products;
    for (std::size_t i = 0; i < of.size(); ++i) put(*of[i], projected.middleCols(Eigen::Index(i) * n, n));
  }
  const auto mirror = [&](Eigen::MatrixXd& projected) {
    projected.bottomLeftCorner(added, old) = projected.topRightCorner(old, added).transpose();
    projected.bottomRightCorner(added, added) = symmetric(projected.bottomRightCorner(added, added));
  };
  for (Projected* p : {&k_, &m_}) {
    mirror(p->whole);
    for (Eigen::MatrixXd& c : p->classes) mirror(c);
  }
}

Eigen::MatrixXd ReducedModel::sum(const Projected& p, const std::vector<double>& factors) const {
  Eigen::MatrixXd sum = p.whole;
  for (std::size_t c = 0; c < factors.size(); ++c)
    if (factors[c] != 1.0) sum += (factors[c] - 1.0) * p.classes[c];
  return sum;
}

ReducedModel::Matrices ReducedModel::matrices(const Change& change) const {
  return {symmetric(sum(k_, change.stiffness) + project_stiffness(change.others, unknowns_, basis(), basis())),
          symmetric(sum(m_, change.mass) + project_mass(change.others, unknowns_, basis(), basis()))};
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

ReducedModel::Worked ReducedModel::refine(const Change& change, const ReducedModes& found,
                                          std::vector<Eigen::Index> which) {
  Worked worked = {std::move(which), {}};
  const Eigen::VectorXd lambda = found.eigenvalues(worked.modes);
  const Vectors y = basis() * found.q(Eigen::all, worked.modes);
  const Vectors force = times_mass(change, y) * lambda.asDiagonal() - times_stiffness(change, y);
  const Vectors move = origin_->static_response(force);
  worked.errors = move.cwiseProduct(force).colwise().sum().transpose().cwiseQuotient(lambda);
  // (K₀ − σ M₀) move is the force over the origin's unknowns.
  Vectors momenta = times(origin_->model().m, move), stiffness = force;
  stiffness.bottomRows(force.rows() - origin_->model().unknowns.count).setZero();
  stiffness += origin_->shift() * momenta;
  append(move, &stiffness, &momenta);
  return worked;
}

namespace {

std::vector<Eigen::Index> lowest(const ReducedModes& found, int wanted) {
  std::vector<Eigen::Index> all(std::size_t(std::min<Eigen::Index>(wanted, found.q.cols())));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = Eigen::Index(i);
  return all;
}

}  // namespace

double ReducedModel::refine(const Change& change, int wanted) {
  const ReducedModes found = modes(matrices(change));
  return refine(change, found, lowest(found, wanted)).most();
}

double ReducedModel::converge(const Change& change, int wanted, double tolerance, int most) {
  ReducedModes found = modes(matrices(change));
  Worked worked = {lowest(found, wanted), {}};
  double error = 0.0;
  for (int i = 0; i < most && !worked.modes.empty(); ++i) {
    worked = refine(change, found, worked.modes);
    error = worked.most();
    if (error < tolerance || i + 1 == most) break;
    // Left alone are those of which little was missing, and that stay where they are.
    const double little = 0.1 * tolerance;
    const ReducedModes now = modes(matrices(change));
    std::vector<Eigen::Index> next;
    for (const Eigen::Index mode : lowest(now, wanted)) {
      const auto at = std::find(worked.modes.begin(), worked.modes.end(), mode);
      const bool settled = at == worked.modes.end() || worked.errors[at - worked.modes.begin()] < little;
      if (!settled || std::abs(now.eigenvalues[mode] - found.eigenvalues[mode]) > little * now.eigenvalues[mode])
        next.push_back(mode);
    }
    found = now;
    worked.modes = std::move(next);
  }
  return error;
}

Eigen::MatrixXd ReducedModel::along_origin(const ReducedModes& modes, Eigen::Index count) const {
  return m_.whole.topRows(origin_->response().vectors.cols()) * modes.q.leftCols(count);
}

Eigen::MatrixXd ReducedModel::vectors(const ReducedModes& modes, Eigen::Index count) const {
  return basis() * modes.q.leftCols(std::min(count, modes.q.cols()));
}

}  // namespace voussoir
