#include "solver/modal/multigrid.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "solver/modal/six.h"
#include "solver/modal/stiffness.h"

namespace voussoir {

namespace {

using Vector = Eigen::VectorXd;

auto part(Vector& x, std::size_t i) {
  return x.segment<6>(Eigen::Index(6 * i));
}

/// Calls use(entry) for each block of a row.
template <class F>
void each_of(const BlockRows& m, std::size_t row, F use) {
  for (auto at = std::size_t(m.first[row]); at < std::size_t(m.first[row + 1]); ++at) use(at);
}

void multiply(const BlockRows& m, const Vector& x, Vector& y) {
  for (std::size_t i = 0; i < m.rows(); ++i) {
    Six sum;
    each_of(m, i, [&](std::size_t at) { Columns(m.block[at]).add_times(x.data() + 6 * m.column[at], sum); });
    sum.store(y.data() + 6 * i);
  }
}

constexpr std::size_t block_width = 36, site_width = 8;

/// The six rows of a column in single precision, and two numbers that belong to the next.
using Eight = float __attribute__((vector_size(32)));
[[gnu::always_inline]] inline Eight load(const float* from) {
  Eight x;
  std::memcpy(&x, from, sizeof(x));
  return x;
}
[[gnu::always_inline]] inline void store(float* to, const Eight& x) {
  std::memcpy(to, &x, sizeof(x));
}

/// Block times the six numbers of a site. Two sums, so that each waits for half as many.
struct ColumnSums {
  Eight even = {}, odd = {};
  [[gnu::always_inline]] void add(const float* block, const float* x) {
    for (int c = 0; c < 6; c += 2) even += load(block + 6 * c) * x[c], odd += load(block + 6 * (c + 1)) * x[c + 1];
  }
  [[gnu::always_inline]] void add_backwards(const float* block, const float* x) {
    for (int c = 4; c >= 0; c -= 2) odd += load(block + 6 * (c + 1)) * x[c + 1], even += load(block + 6 * c) * x[c];
  }
};

/// Σ block x of a row. Blocks some way on are asked for, which the processor would not do early enough by itself.
[[gnu::always_inline]] inline Eight times(const SingleRows& m, std::size_t row, const float* x) {
  constexpr std::size_t ahead = 1024, most = 7 * cache_line;  // numbers; bytes
  const auto begin = std::size_t(m.first[row]), end = std::size_t(m.first[row + 1]);
  fetch(&m.block[block_width * begin] + ahead, std::min(most, sizeof(float) * block_width * (end - begin)));
  ColumnSums sums;
  for (std::size_t at = begin; at < end; ++at)
    sums.add(&m.block[block_width * at], x + site_width * std::size_t(m.column[at]));
  return sums.even + sums.odd;
}
/// The same where rows are gone through from the last to the first: a processor reads ahead of what goes steadily
/// downwards, not of what goes up within each row.
[[gnu::always_inline]] inline Eight times_backwards(const SingleRows& m, std::size_t row, const float* x) {
  ColumnSums sums;
  for (auto at = std::size_t(m.first[row + 1]); at-- > std::size_t(m.first[row]);)
    sums.add_backwards(&m.block[block_width * at], x + site_width * std::size_t(m.column[at]));
  return sums.even + sums.odd;
}
/// Block times six numbers.
[[gnu::always_inline]] inline Eight times(const float* block, const Eight& x) {
  float numbers[site_width];
  store(numbers, x);
  ColumnSums sums;
  sums.add(block, numbers);
  return sums.even + sums.odd;
}

void append(const Matrix6& block, Array<float>& singles) {
  for (const double x : block.reshaped()) singles.push_back(float(x));
}
/// The last block's last column is read with two numbers more.
void end_blocks(Array<float>& singles) {
  singles.resize(singles.size() + site_width - 6, 0.0f);
}
Array<float> in_singles(const Array<Matrix6>& blocks) {
  Array<float> singles;
  singles.reserve(block_width * blocks.size() + site_width - 6);
  for (const Matrix6& block : blocks) append(block, singles);
  end_blocks(singles);
  return singles;
}
SingleRows in_singles(const BlockRows& m) {
  return {m.first, m.column, in_singles(m.block)};
}

/// A row of a block matrix, summed up from blocks that come in any order of columns, which is the order it has then.
class RowSum {
 public:
  explicit RowSum(std::size_t columns) : place_(columns, -1) {}
  Matrix6& at(std::int32_t column) {
    std::int32_t& place = place_[std::size_t(column)];
    if (place < 0) place = std::int32_t(column_.size()), column_.push_back(column), block_.push_back(Matrix6::Zero());
    return block_[std::size_t(place)];
  }
  const Matrix6& at(std::int32_t column) const { return block_[std::size_t(place_[std::size_t(column)])]; }
  const std::vector<std::int32_t>& columns() const { return column_; }
  void clear() {
    for (const std::int32_t column : column_) place_[std::size_t(column)] = -1;
    column_.clear(), block_.clear();
  }

 private:
  std::vector<std::int32_t> place_, column_;
  std::vector<Matrix6> block_;
};

/// Rows one after the other, each summed up so.
class RowSums {
 public:
  RowSums(std::size_t rows, std::size_t columns) : rows_(rows), row_(columns) {
    m_.first.reserve(rows + 1);
    m_.first.push_back(0);
  }
  Matrix6& at(std::int32_t column) { return row_.at(column); }
  void end_row() {
    order_ = row_.columns();
    std::sort(order_.begin(), order_.end());
    for (const std::int32_t column : order_)
      m_.column.push_back(column), m_.block.push_back(std::as_const(row_).at(column));
    m_.first.push_back(std::int32_t(m_.column.size()));
    row_.clear();
    constexpr std::size_t sample = 1000;  // rows, by which the room for all is judged
    if (m_.rows() == sample) {
      const std::size_t all = m_.column.size() * (rows_ + rows_ / 8) / sample;
      m_.column.reserve(all), m_.block.reserve(all);
    }
  }
  BlockRows take() { return std::move(m_); }

 private:
  std::size_t rows_;
  BlockRows m_;
  RowSum row_;
  std::vector<std::int32_t> order_;
};

BlockRows transposed(const BlockRows& m, std::size_t columns) {
  BlockRows t;
  t.first.assign(columns + 1, 0);
  for (const std::int32_t c : m.column) ++t.first[std::size_t(c) + 1];
  for (std::size_t c = 0; c < columns; ++c) t.first[c + 1] += t.first[c];
  t.column.resize(m.column.size()), t.block.resize(m.block.size());
  Array<std::int32_t> next(t.first.begin(), t.first.end() - 1);
  for (std::size_t i = 0; i < m.rows(); ++i)
    each_of(m, i, [&](std::size_t at) {
      const auto to = std::size_t(next[std::size_t(m.column[at])]++);
      t.column[to] = std::int32_t(i), t.block[to] = m.block[at].transpose();
    });
  return t;
}

/// Rows of A P, each made when it is first asked for and forgotten when it has been asked for by all columns of its row
/// of P: few of them are there at a time.
class ProductRows {
 public:
  struct Row {
    std::vector<std::int32_t> column;
    std::vector<Matrix6> block;
    std::size_t uses = 0;  // to come
  };
  ProductRows(const BlockRows& a, const BlockRows& p, std::size_t columns)
      : a_(a), p_(p), sum_(columns), slot_(a.rows(), -1) {}

  template <class F>
  void use_once(std::size_t i, const F& use) {
    if (slot_[i] < 0) make(i);
    Row& row = rows_[std::size_t(slot_[i])];
    use(std::as_const(row));
    if (--row.uses == 0) free_.push_back(slot_[i]);
  }

 private:
  void make(std::size_t i) {
    if (free_.empty()) free_.push_back(std::int32_t(rows_.size())), rows_.emplace_back();
    slot_[i] = free_.back(), free_.pop_back();
    each_of(a_, i, [&](std::size_t at) {
      const Columns block(a_.block[at]);
      each_of(p_, std::size_t(a_.column[at]),
              [&](std::size_t q) { block.add_times(p_.block[q], sum_.at(p_.column[q])); });
    });
    Row& row = rows_[std::size_t(slot_[i])];
    row.column = sum_.columns(), row.uses = std::size_t(p_.first[i + 1] - p_.first[i]);
    row.block.clear();
    for (const std::int32_t column : row.column) row.block.push_back(std::as_const(sum_).at(column));
    sum_.clear();
  }

  const BlockRows &a_, &p_;
  RowSum sum_;
  std::vector<Row> rows_;
  std::vector<std::int32_t> slot_, free_;  // where each row is; what others may take
};

/// The upper triangle of Pᵀ A P.
BlockRows coarse_upper(const BlockRows& a, const BlockRows& p, const BlockRows& p_transposed) {
  const std::size_t n = p_transposed.rows();
  ProductRows products(a, p, n);
  RowSums sums(n, n);
  for (std::size_t c = 0; c < n; ++c) {
    each_of(p_transposed, c, [&](std::size_t at) {
      const Columns block(p_transposed.block[at]);
      products.use_once(std::size_t(p_transposed.column[at]), [&](const ProductRows::Row& row) {
        for (std::size_t q = 0; q < row.column.size(); ++q)
          if (std::size_t(row.column[q]) >= c) block.add_times(row.block[q], sums.at(row.column[q]));
      });
    });
    sums.end_row();
  }
  return sums.take();
}

/// All of a symmetric matrix whose blocks each_block(use) goes through once, row by row or column by column, one of
/// every two that mirror each other: use(row, column, block).
template <class EachBlock>
BlockRows mirrored(std::size_t n, const EachBlock& each_block) {
  BlockRows rows;
  rows.first.assign(n + 1, 0);
  each_block([&](std::int32_t i, std::int32_t j, const Matrix6&) {
    ++rows.first[std::size_t(i) + 1];
    if (i != j) ++rows.first[std::size_t(j) + 1];
  });
  for (std::size_t i = 0; i < n; ++i) rows.first[i + 1] += rows.first[i];
  rows.column.resize(std::size_t(rows.first.back())), rows.block.resize(rows.column.size());
  Array<std::int32_t> next(rows.first.begin(), rows.first.end() - 1);
  // A row has what comes of the rows (or columns) before its own first: so its columns ascend.
  each_block([&](std::int32_t i, std::int32_t j, const Matrix6& block) {
    const auto at = std::size_t(next[std::size_t(i)]++);
    rows.column[at] = j, rows.block[at] = block;
    if (i == j) return;
    const auto mirror = std::size_t(next[std::size_t(j)]++);
    rows.column[mirror] = i, rows.block[mirror] = block.transpose();
  });
  return rows;
}
/// Of one whose lower triangle is there.
BlockRows rows_of(const BlockMatrix& k) {
  return mirrored(k.sites(), [&](const auto& use) { k.for_each(use); });
}
/// Of one whose upper triangle is there.
BlockRows rows_of(const BlockRows& upper) {
  return mirrored(upper.rows(), [&](const auto& use) {
    for (std::size_t i = 0; i < upper.rows(); ++i)
      each_of(upper, i, [&](std::size_t at) { use(std::int32_t(i), upper.column[at], upper.block[at]); });
  });
}

/// With every diagonal entry raised by a ten-millionth: what a cycle in single precision takes for softer than that may
/// not be positive any more.
BlockRows raised(BlockRows a) {
  for (std::size_t i = 0; i < a.rows(); ++i)
    each_of(a, i, [&](std::size_t at) {
      if (std::size_t(a.column[at]) == i) a.block[at].diagonal() *= 1.0 + 1e-7;
    });
  return a;
}

/// Which coarse site each site belongs to, −1: none, as nothing is coupled to it. Sites are coupled where the block
/// between them is not small against their own; roots take all that they are coupled to, and what is left over goes to
/// its strongest neighbour's.
std::vector<std::int32_t> aggregates(const BlockRows& a, std::int32_t& count) {
  constexpr double coupled = 0.02;
  const std::size_t n = a.rows();
  std::vector<double> own(n);
  for (std::size_t i = 0; i < n; ++i)
    each_of(a, i, [&](std::size_t at) {
      if (std::size_t(a.column[at]) == i) own[i] = a.block[at].topLeftCorner<3, 3>().norm();
    });
  const auto each_neighbour = [&](std::size_t i, const auto& use) {
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      if (j == i) return;
      const double size = a.block[at].topLeftCorner<3, 3>().norm();
      if (size * size > coupled * coupled * own[i] * own[j]) use(j, size);
    });
  };
  std::vector<std::int32_t> of(n, -1);
  count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bool alone = true, free = of[i] < 0;
    each_neighbour(i, [&](std::size_t j, double) { alone = false, free &= of[j] < 0; });
    if (alone || !free) continue;
    of[i] = count;
    each_neighbour(i, [&](std::size_t j, double) { of[j] = count; });
    ++count;
  }
  const std::vector<std::int32_t> first = of;
  for (std::size_t i = 0; i < n; ++i) {
    double strongest = 0.0;
    if (first[i] < 0)
      each_neighbour(i, [&](std::size_t j, double size) {
        if (first[j] >= 0 && size > strongest) strongest = size, of[i] = first[j];
      });
  }
  return of;
}

/// How a site moves when its coarse site does: rigidly about the coarse site's place.
Matrix6 rigid(const Vec3& arm) {
  Matrix6 m = Matrix6::Identity();
  m.topRightCorner<3, 3>() = -skew(arm);  // Θ × arm
  return m;
}

/// Ways in which a site may not move.
void hold(const std::array<std::int32_t, 6>& unknowns, Matrix6& motion) {
  for (std::size_t c = 0; c < 6; ++c)
    if (unknowns[c] < 0) motion.row(Eigen::Index(c)).setZero();
}

/// Largest eigenvalue of D⁻¹ A, by some steps of power iteration.
double largest_eigenvalue(const BlockRows& a, const Array<Matrix6>& inverse) {
  Vector x(Eigen::Index(6 * a.rows())), y(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + double(i) * 0.7390851332151607);
  double value = 1.0;
  for (int step = 0; step < 12; ++step) {
    x /= x.norm();
    multiply(a, x, y);
    for (std::size_t i = 0; i < a.rows(); ++i) part(y, i) = (inverse[i] * part(y, i)).eval();
    value = y.norm();
    x.swap(y);
  }
  return 1.1 * value;
}

/// Blocks left of the diagonal, on it and right of it.
struct Parts {
  SingleRows left, right;
  Array<Matrix6> diagonal;
};
Parts parts_of(const BlockRows& a) {
  Parts parts;
  const std::size_t n = a.rows(), half = (a.block.size() - n) / 2;  // it is symmetric
  parts.diagonal.reserve(n);
  for (SingleRows* side : {&parts.left, &parts.right}) {
    side->first.reserve(n + 1), side->column.reserve(half), side->block.reserve(block_width * half + site_width - 6);
    side->first.push_back(0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    each_of(a, i, [&](std::size_t at) {
      if (std::size_t(a.column[at]) == i) return parts.diagonal.push_back(a.block[at]);
      SingleRows& side = std::size_t(a.column[at]) < i ? parts.left : parts.right;
      side.column.push_back(a.column[at]), append(a.block[at], side.block);
    });
    for (SingleRows* side : {&parts.left, &parts.right}) side->first.push_back(std::int32_t(side->column.size()));
  }
  end_blocks(parts.left.block), end_blocks(parts.right.block);
  return parts;
}

/// Middles of the aggregates, m.
std::vector<Vec3> middles(const std::vector<Vec3>& place, const std::vector<std::int32_t>& of, std::int32_t count) {
  std::vector<Vec3> middle(std::size_t(count), Vec3::Zero());
  std::vector<double> members(std::size_t(count), 0.0);
  for (std::size_t i = 0; i < place.size(); ++i)
    if (of[i] >= 0) middle[std::size_t(of[i])] += place[i], members[std::size_t(of[i])] += 1.0;
  for (std::size_t c = 0; c < middle.size(); ++c) middle[c] /= members[c];
  return middle;
}

/// (1 − ω D⁻¹ A) times the rigid motions of the aggregates.
BlockRows smoothed(const BlockRows& a, const Array<Matrix6>& inverse, double largest_eigenvalue,
                   const Array<Matrix6>& rigid_motion, const std::vector<std::int32_t>& of, std::int32_t count) {
  const double omega = 4.0 / 3.0 / largest_eigenvalue;
  RowSums sums(a.rows(), std::size_t(count));
  for (std::size_t i = 0; i < a.rows(); ++i) {
    if (of[i] >= 0) sums.at(of[i]) += rigid_motion[i];
    const Columns w(-omega * inverse[i]);
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      if (of[j] >= 0) w.add_times(block_product(a.block[at], rigid_motion[j]), sums.at(of[j]));
    });
    sums.end_row();
  }
  return sums.take();
}

}  // namespace

bool Multigrid::compute(const BlockMatrix& k, const Unknowns& unknowns, const std::vector<Vec3>& places) {
  constexpr std::size_t small = 60, too_large = 500;  // sites
  constexpr std::size_t visited_twice = 2;            // from the second level on, which cost little
  levels_.clear();
  const BlockRows finest = raised(rows_of(k));
  BlockRows coarse;
  const BlockRows* a = &finest;
  for (std::vector<Vec3> place = places; a->rows() > small;) {
    const std::size_t n = a->rows();
    std::int32_t count = 0;
    const std::vector<std::int32_t> of = aggregates(*a, count);
    if (2 * std::size_t(count) > n) break;
    Level& level = levels_.emplace_back();
    Array<Matrix6> inverse(n);
    {
      Parts parts = parts_of(*a);
      for (std::size_t i = 0; i < n; ++i) inverse[i] = parts.diagonal[i].inverse();
      if (levels_.size() >= visited_twice) level.diagonal = in_singles(parts.diagonal);
      level.left = std::move(parts.left), level.right = std::move(parts.right);
    }
    const std::vector<Vec3> middle = middles(place, of, count);
    Array<Matrix6> rigid_motion(n, Matrix6::Zero());
    for (std::size_t i = 0; i < n; ++i)
      if (of[i] >= 0) rigid_motion[i] = rigid(place[i] - middle[std::size_t(of[i])]);
    if (levels_.size() == 1)
      for (std::size_t i = 0; i < n; ++i) hold(unknowns.of[i], rigid_motion[i]);
    // Of a patch between two sites each gets no less than half of what it gives both (relaxation.cpp).
    const double largest = levels_.size() == 1 ? 2.0 : largest_eigenvalue(*a, inverse);
    const BlockRows p = smoothed(*a, inverse, largest, rigid_motion, of, count),
                    back = transposed(p, std::size_t(count));
    level.inverse = in_singles(inverse), level.p = in_singles(p), level.restriction = in_singles(back);
    for (Array<float>* vector : {&level.b, &level.x, &level.rest}) vector->assign(site_width * n, 0.0f);
    coarse = rows_of(coarse_upper(*a, p, back));
    a = &coarse;
    place = middle;
  }
  return a->rows() <= too_large && factor_coarsest(*a);
}

bool Multigrid::factor_coarsest(const BlockRows& a) {
  const auto size = Eigen::Index(6 * a.rows());
  coarsest_b_.assign(site_width * a.rows(), 0.0f), coarsest_x_ = coarsest_b_;
  if (size == 0) return true;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < a.rows(); ++i)
    each_of(a, i, [&](std::size_t at) { dense.block<6, 6>(Eigen::Index(6 * i), 6 * a.column[at]) = a.block[at]; });
  coarsest_.compute(dense);
  return coarsest_.info() == Eigen::Success;
}

void Multigrid::solve_coarsest() {
  const std::size_t n = coarsest_b_.size() / site_width;
  Vector b(Eigen::Index(6 * n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 6; ++c) b[Eigen::Index(6 * i + c)] = coarsest_b_[site_width * i + c];
  if (n > 0) coarsest_.solveInPlace(b);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < 6; ++c) coarsest_x_[site_width * i + c] = float(b[Eigen::Index(6 * i + c)]);
}

/// x ≈ A⁻¹ b of a level: block Gauss–Seidel forwards, the coarse correction, block Gauss–Seidel backwards; symmetric.
void Multigrid::cycle(std::size_t at) {
  if (at == levels_.size()) return solve_coarsest();
  Level& level = levels_[at];
  const std::size_t n = level.left.rows();
  const float* b = level.b.data();
  float *x = level.x.data(), *rest = level.rest.data();
  const auto inverse_times = [&](std::size_t i, const Eight& y) { return times(&level.inverse[block_width * i], y); };
  // Forwards from nothing: what is left of the diagonal alone; what then remains is what is right of it.
  for (std::size_t i = 0; i < n; ++i)
    store(x + site_width * i, inverse_times(i, load(b + site_width * i) - times(level.left, i, x)));
  for (std::size_t i = 0; i < n; ++i) store(rest + site_width * i, -times(level.right, i, x));
  const bool last = at + 1 == levels_.size();
  Array<float>&coarse = last ? coarsest_b_ : levels_[at + 1].b, &correction = last ? coarsest_x_ : levels_[at + 1].x;
  for (std::size_t i = 0; i < level.restriction.rows(); ++i)
    store(&coarse[site_width * i], times(level.restriction, i, rest));
  if (!last && !levels_[at + 1].diagonal.empty())
    two_cycles(at + 1);
  else
    cycle(at + 1);
  for (std::size_t i = 0; i < n; ++i)
    store(x + site_width * i, load(x + site_width * i) + times(level.p, i, correction.data()));
  for (std::size_t i = n; i-- > 0;)
    store(x + site_width * i, inverse_times(i, load(b + site_width * i) - times_backwards(level.right, i, x) -
                                                   times_backwards(level.left, i, x)));
}

/// A second cycle for what the first left.
void Multigrid::two_cycles(std::size_t at) {
  Level& level = levels_[at];
  cycle(at);
  level.before = level.x;
  const float* x = level.x.data();
  for (std::size_t i = 0; i < level.left.rows(); ++i) {
    float* b = &level.b[site_width * i];
    const Eight own = times(&level.diagonal[block_width * i], load(x + site_width * i));
    store(b, load(b) - own - times(level.left, i, x) - times(level.right, i, x));
  }
  cycle(at);
  for (std::size_t k = 0; k < level.x.size(); ++k) level.x[k] += level.before[k];
}

std::optional<Vector> Multigrid::solve(const BlockMatrix& k, const Unknowns& unknowns, const Vector& b,
                                       double tolerance, int most_iterations) {
  const std::size_t n = k.sites();
  Vector r(Eigen::Index(6 * n)), x = Vector::Zero(r.size()), p = x, kp(r.size());
  for (std::size_t i = 0; i < n; ++i) part(r, i) = part_of(b, unknowns, i);
  Array<float>&rough_b = levels_.empty() ? coarsest_b_ : levels_.front().b,
  &rough_x = levels_.empty() ? coarsest_x_ : levels_.front().x;
  const auto rough = [&](std::size_t i) -> Vector6 {  // of the cycle
    return Eigen::Map<const Eigen::Matrix<float, 6, 1>>(&rough_x[site_width * i]).cast<double>();
  };
  const auto roughen = [&](std::size_t i, const Vector6& from) {
    for (std::size_t c = 0; c < 6; ++c) rough_b[site_width * i + c] = float(from[Eigen::Index(c)]);
  };
  double left2 = r.squaredNorm(), before = 0.0;
  const double target2 = tolerance * tolerance * left2;
  for (std::size_t i = 0; i < n; ++i) roughen(i, part(r, i));
  for (iterations_ = 0; left2 > target2; ++iterations_) {
    if (iterations_ == most_iterations) return {};
    cycle(0);
    double now = 0.0;
    for (std::size_t i = 0; i < n; ++i) now += part(r, i).dot(rough(i));
    if (!(now > 0.0)) return {};
    const double kept = iterations_ == 0 ? 0.0 : now / before;
    for (std::size_t i = 0; i < n; ++i) part(p, i) = rough(i) + kept * part(p, i);
    const double stiffness = k.times(p, kp);
    if (!(stiffness > 0.0)) return {};
    const double share = now / stiffness;
    before = now, left2 = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      part(x, i) += share * part(p, i);
      const Vector6 rest = part(r, i) - share * part(kp, i);
      part(r, i) = rest, left2 += rest.squaredNorm();
      roughen(i, rest);
    }
  }
  Vector found(b.size());
  for (std::size_t i = 0; i < n; ++i) set_part(found, unknowns, i, part(x, i));
  return found;
}

}  // namespace voussoir
