#include "solver/identify/joint_subspace.h"

#include <algorithm>
#include <cmath>

#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

/// Those rows of every block row of `channels` rows.
Eigen::MatrixXd rows_of(const Eigen::MatrixXd& blocks, Eigen::Index channels, const std::vector<int>& wanted) {
  const Eigen::Index count = Eigen::Index(wanted.size()), block_rows = blocks.rows() / channels;
  Eigen::MatrixXd rows(block_rows * count, blocks.cols());
  for (Eigen::Index i = 0; i < block_rows; ++i)
    for (Eigen::Index c = 0; c < count; ++c)
      rows.row(i * count + c) = blocks.row(i * channels + wanted[std::size_t(c)]);
  return rows;
}

std::vector<Eigen::Index> numbers_of(const std::vector<int>& channels, const std::vector<Eigen::Index>& whole) {
  std::vector<Eigen::Index> numbers;
  for (const int c : channels) numbers.push_back(whole[std::size_t(c)]);
  return numbers;
}

}  // namespace

JointSubspace::JointSubspace(const std::vector<JointPart>& parts, const Eigen::MatrixXd& future, Eigen::Index channels,
                             int block_rows, int largest_order)
    : block_rows_(block_rows), channels_(channels) {
  const auto weight = future.triangularView<Eigen::Lower>();
  std::vector<Eigen::MatrixXd> reference, moved;
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(future.rows(), future.rows());
  for (const JointPart& part : parts) {
    const auto own = Eigen::Index(part.whole.size());
    Eigen::MatrixXd h = hankel(part.covariances, int(own), block_rows);
    part.past.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(h);
    reference.push_back(rows_of(h, own, part.references));
    moved.push_back(rows_of(h, own, part.moved));
    weight.solveInPlace(reference.back());
    product.selfadjointView<Eigen::Lower>().rankUpdate(reference.back());
  }
  // H = U S Vᵀ of the setups' references side by side.
  const EigenSolution<Eigen::MatrixXd> solution = eigen_solution(product);
  const Eigen::VectorXd values = solution.values.reverse();
  Eigen::Index kept = 0;
  while (kept < std::min<Eigen::Index>(largest_order, values.size()) && values[kept] > 1e-15 * values[0]) ++kept;
  const Eigen::MatrixXd u = solution.vectors.rowwise().reverse().leftCols(kept);
  singular_ = values.head(kept).cwiseSqrt();
  references_ = {weight * u, {}, numbers_of(parts.front().references, parts.front().whole)};
  for (std::size_t j = 0; j < parts.size(); ++j) {
    const Eigen::MatrixXd v = reference[j].transpose() * u * singular_.cwiseInverse().asDiagonal();
    moved_.push_back({moved[j] * v, v.transpose() * v, numbers_of(parts[j].moved, parts[j].whole)});
  }
}

/// With Z = S Vᵀ of a setup: its moved channels times the pseudo-inverse of the first `order` rows of Z.
Eigen::MatrixXd JointSubspace::at_order(const Rows& moved, int order) const {
  const Eigen::LDLT<Eigen::MatrixXd> share(moved.share.topLeftCorner(order, order));
  return share.solve(moved.rows.leftCols(order).transpose()).transpose() *
         singular_.head(order).cwiseInverse().asDiagonal();
}

std::vector<Pole> JointSubspace::poles(int order, double dt, double highest, const Eigen::VectorXd& scale) const {
  std::vector<Eigen::MatrixXd> all = {references_.rows.leftCols(order)};
  std::vector<const std::vector<Eigen::Index>*> whole = {&references_.whole};
  Eigen::Index rows = 0;
  for (const Rows& moved : moved_) {
    if (moved.whole.empty()) continue;
    all.push_back(at_order(moved, order));
    whole.push_back(&moved.whole);
  }
  for (const Eigen::MatrixXd& block : all) rows += block.rows() / block_rows_ * (block_rows_ - 1);
  Eigen::MatrixXd upper(rows, order), lower(rows, order), first = Eigen::MatrixXd::Zero(channels_, order);
  Eigen::VectorXd times = Eigen::VectorXd::Zero(channels_);
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto count = Eigen::Index(whole[k]->size()), size = count * (block_rows_ - 1);
    upper.middleRows(at, size) = all[k].topRows(size);
    lower.middleRows(at, size) = all[k].bottomRows(size);
    at += size;
    for (Eigen::Index c = 0; c < count; ++c) {
      const Eigen::Index channel = (*whole[k])[std::size_t(c)];
      first.row(channel) += all[k].row(c);
      times[channel] += 1.0;
    }
  }
  for (Eigen::Index c = 0; c < channels_; ++c)
    if (times[c] > 1.0) first.row(c) /= times[c];  // what two setups recorded beside the references
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(upper);
  const Eigen::MatrixXd down = qr.householderQ().adjoint() * lower;
  const Eigen::MatrixXd transition =
      qr.matrixQR().topRows(order).triangularView<Eigen::Upper>().solve(down.topRows(order));
  return poles_of(transition, first, dt, highest, scale);
}

}  // namespace voussoir
