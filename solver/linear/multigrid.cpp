#include "solver/linear/multigrid.h"

#include <algorithm>
#include <utility>

#include "solver/base/subnormals.h"
#include "solver/linear/six.h"
#include "solver/linear/stiffness.h"

namespace voussoir {

namespace {

using Vector = Eigen::VectorXd;

auto part(Vector& x, std::size_t i) {
  return x.segment<6>(Eigen::Index(6 * i));
}

/// Every diagonal entry is raised by a ten-millionth, because with single precision a softer mode could make the cycle
/// indefinite.
BlockRows raised(BlockRows a) {
  for (std::size_t i = 0; i < a.rows(); ++i)
    each_of(a, i, [&](std::size_t at) {
      if (std::size_t(a.column[at]) == i) a.block[at].diagonal() *= 1.0 + 1e-7;
    });
  return a;
}

/// The coarse site of each site, or −1 for a site without couplings. Sites are coupled if the block between them is not
/// small relative to their own blocks. Roots take all sites to which they are coupled, and the remaining sites join
/// their strongest neighbour.
std::vector<std::int32_t> aggregates(const BlockRows& a, std::int32_t& count) {
  constexpr double coupled = 0.02;
  const std::size_t n = a.rows();
  std::vector<double> sizes(a.block.size()), own(n);
  for (std::size_t i = 0; i < n; ++i)
    each_of(a, i, [&](std::size_t at) {
      sizes[at] = a.block[at].topLeftCorner<3, 3>().norm();
      if (std::size_t(a.column[at]) == i) own[i] = sizes[at];
    });
  const auto each_neighbour = [&](std::size_t i, const auto& use) {
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      const double size = sizes[at];
      if (j != i && size * size > coupled * coupled * own[i] * own[j]) use(j, size);
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

/// Of D⁻¹ A, at most. Of a patch between two sites each gets no less than half of what it gives both (relaxation.cpp);
/// of coarse sites of walls 1.7 to 1.9 was found.
constexpr double largest_eigenvalue = 2.0;

/// Blocks on the diagonal and left of it.
struct Parts {
  Array<Matrix6> diagonal;
  SingleRows left;
};
Parts parts_of(const BlockRows& a) {
  Parts parts;
  const std::size_t n = a.rows(), half = (a.block.size() - n) / 2;  // it is symmetric
  parts.diagonal.reserve(n);
  SingleRows& left = parts.left;
  left.first.reserve(n + 1), left.column.reserve(half), left.block.reserve(block_width * half + site_width - 6);
  left.first.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      if (j == i) parts.diagonal.push_back(a.block[at]);
      if (j < i) left.column.push_back(a.column[at]), append(a.block[at], left.block);
    });
    left.first.push_back(std::int32_t(left.column.size()));
  }
  end_blocks(left.block);
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

/// Room for all of so many rows, by what those that are there take.
void make_room(BlockRows& m, std::size_t rows) {
  const std::size_t all = m.column.size() * (rows + rows / 8) / m.rows();
  m.column.reserve(all), m.block.reserve(all);
}

/// (1 − ω D⁻¹ A) times the rigid motions of the aggregates.
BlockRows smoothed(const BlockRows& a, const Array<Matrix6>& inverse, const Array<Matrix6>& rigid_motion,
                   const std::vector<std::int32_t>& of, std::int32_t count) {
  constexpr double omega = 4.0 / 3.0 / largest_eigenvalue;
  constexpr std::size_t sample = 1000;  // rows
  BlockRows p;
  p.first.push_back(0);
  RowSum sum{std::size_t(count)};
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      if (of[j] >= 0) Columns(a.block[at]).add_times(rigid_motion[j], sum.at(of[j]));
    });
    const Columns w(-omega * inverse[i]);
    order = sum.columns();
    std::sort(order.begin(), order.end());
    for (const std::int32_t c : order) {
      p.column.push_back(c), p.block.push_back(c == of[i] ? rigid_motion[i] : Matrix6(Matrix6::Zero()));
      w.add_times(std::as_const(sum).at(c), p.block.back());
    }
    p.first.push_back(std::int32_t(p.column.size()));
    sum.clear();
    if (p.rows() == sample) make_room(p, a.rows());
  }
  return p;
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
      level.left = std::move(parts.left);
    }
    const std::vector<Vec3> middle = middles(place, of, count);
    Array<Matrix6> rigid_motion(n, Matrix6::Zero());
    for (std::size_t i = 0; i < n; ++i)
      if (of[i] >= 0) rigid_motion[i] = rigid(place[i] - middle[std::size_t(of[i])]);
    if (levels_.size() == 1)
      for (std::size_t i = 0; i < n; ++i) hold(unknowns.of[i], rigid_motion[i]);
    const BlockRows p = smoothed(*a, inverse, rigid_motion, of, count);
    level.inverse = in_singles(inverse), level.p = in_singles(p);
    for (Array<float>* vector : {&level.b, &level.x, &level.rest}) vector->assign(site_width * n, 0.0f);
    coarse = coarse_rows(*a, p, std::size_t(count));
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
/// What is right of the diagonal is added up in `rest` as soon as x of its column is there.
void Multigrid::cycle(std::size_t at) {
  if (at == levels_.size()) return solve_coarsest();
  Level& level = levels_[at];
  const std::size_t n = level.left.rows();
  const float* b = level.b.data();
  float *x = level.x.data(), *rest = level.rest.data();
  const auto relax = [&](std::size_t i, const Eight& unbalanced) {
    float numbers[site_width];
    store(numbers, unbalanced);
    store(x + site_width * i, six_of(transposed_times(&level.inverse[block_width * i], numbers)));
    add_transposed(level.left, i, x + site_width * i, rest);
  };
  // Forwards from nothing: what is left of the diagonal alone; what then remains is what is right of it, reversed.
  for (std::size_t i = 0; i < n; ++i) {
    store(rest + site_width * i, Eight{});
    relax(i, load(b + site_width * i) - times(level.left, i, x));
  }
  const bool last = at + 1 == levels_.size();
  Array<float>&coarse = last ? coarsest_b_ : levels_[at + 1].b, &correction = last ? coarsest_x_ : levels_[at + 1].x;
  std::fill(coarse.begin(), coarse.end(), 0.0f);
  for (std::size_t i = 0; i < n; ++i) add_transposed(level.p, i, rest + site_width * i, coarse.data());
  if (!last && !levels_[at + 1].diagonal.empty())
    two_cycles(at + 1);
  else
    cycle(at + 1);
  for (std::size_t i = 0; i < n; ++i) {
    store(x + site_width * i, load(x + site_width * i) - times(level.p, i, correction.data()));
    store(rest + site_width * i, Eight{});
  }
  for (std::size_t i = n; i-- > 0;)
    relax(i, load(b + site_width * i) - load(rest + site_width * i) - times_backwards(level.left, i, x));
}

/// A second cycle for the remaining residual.
void Multigrid::two_cycles(std::size_t at) {
  Level& level = levels_[at];
  cycle(at);
  level.before = level.x;
  const std::size_t n = level.left.rows();
  float *x = level.x.data(), *b = level.b.data(), *rest = level.rest.data();
  for (std::size_t i = 0; i < n; ++i) {
    float* own = x + site_width * i;
    const Eight here = transposed_times(&level.diagonal[block_width * i], own) + times(level.left, i, x);
    store(rest + site_width * i, here);
    add_transposed(level.left, i, own, rest);
  }
  for (std::size_t k = 0; k < level.b.size(); ++k) b[k] -= rest[k];
  cycle(at);
  for (std::size_t k = 0; k < level.x.size(); ++k) x[k] += level.before[k];
}

std::optional<Vector> Multigrid::solve(const BlockMatrix& k, const Unknowns& unknowns, const Vector& b,
                                       double tolerance, int most_iterations) {
  // Products of what is rounding alone, as what a wall does out of its plane, come so far down in single precision.
  const NoSubnormals none;
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
