#include "solver/step/critical_step.h"

#include <Eigen/Cholesky>

#include "solver/linear/dense_eigen.h"
#include "solver/linear/stiffness.h"

namespace voussoir {

namespace {

/// S of a site with S Sᵀ = M⁻¹ in world axes: of its mass, and of its inertia; 0 where it may not turn.
struct InverseRoot {
  double mass = 0.0;            // kg^−½
  Mat3 inertia = Mat3::Zero();  // kg^−½ m⁻¹
};
std::vector<InverseRoot> inverse_roots(const Model& model, const State& state) {
  std::vector<InverseRoot> roots(model.sites());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Mat3 r = rotation_of(state, i).toRotationMatrix();
    const Mat3 inverse = r * model.bodies[i].inverse_inertia * r.transpose();
    roots[i] = {1.0 / std::sqrt(model.bodies[i].inertial_mass), inverse.llt().matrixL()};
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    roots[model.bodies.size() + i].mass = 1.0 / std::sqrt(model.fill.inertial[i]);
  return roots;
}

/// Sᵀ K S, whose eigenvalues are those of M⁻¹ K where there are unknowns. Held components stay apart from the others: a
/// body turns freely or not at all.
BlockMatrix scaled_stiffness(const Model& model, const State& state, const Unknowns& unknowns) {
  BlockMatrix k = stiffness_blocks(model, state, PatchTangent::intact);
  k.hold(unknowns);
  const std::vector<InverseRoot> roots = inverse_roots(model, state);
  k.change_each([&](std::int32_t row, std::int32_t column, Matrix6& block) {
    const InverseRoot &left = roots[std::size_t(row)], &right = roots[std::size_t(column)];
    block.topRows<3>() *= left.mass;
    block.bottomRows<3>() = (left.inertia.transpose() * block.bottomRows<3>()).eval();
    block.leftCols<3>() *= right.mass;
    block.rightCols<3>() = (block.rightCols<3>() * right.inertia).eval();
  });
  return k;
}

/// A unit vector of six numbers a site with every direction in it that is an unknown, the same on every machine.
Eigen::VectorXd scattered(const Unknowns& unknowns) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(6 * unknowns.of.size()));
  std::uint64_t s = 0x9e3779b97f4a7c15ULL;
  for (std::size_t i = 0; i < unknowns.of.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c) {
      if (unknowns.of[i][c] < 0) continue;
      s ^= s << 13, s ^= s >> 7, s ^= s << 17;
      x[Eigen::Index(6 * i + c)] = double(s >> 11) / 9007199254740992.0 - 0.5;
    }
  const double size = x.norm();
  return size > 0.0 ? Eigen::VectorXd(x / size) : x;
}

/// Lanczos's recurrence (1950) from a unit vector v₀: A vⱼ = βⱼ₋₁ vⱼ₋₁ + αⱼ vⱼ + βⱼ vⱼ₊₁. Calls use(vⱼ, αⱼ, βⱼ) until
/// it is false or nothing is left.
template <class F>
void lanczos(const BlockMatrix& a, Eigen::VectorXd v, const F& use) {
  Eigen::VectorXd before = Eigen::VectorXd::Zero(v.size()), next(v.size());
  double left = 0.0;
  while (true) {
    const double alpha = a.times(v, next);
    double norm2 = 0.0;
    for (Eigen::Index i = 0; i < v.size(); i += 6) {
      const Vector6 rest = next.segment<6>(i) - alpha * v.segment<6>(i) - left * before.segment<6>(i);
      next.segment<6>(i) = rest, norm2 += rest.squaredNorm();
    }
    const double beta = std::sqrt(norm2);
    if (!use(v, alpha, beta) || !(beta > 1e-10 * std::abs(alpha))) return;
    before.swap(v), v.swap(next);
    v *= 1.0 / beta, left = beta;
  }
}

struct Highest {
  double value = 0.0;
  Eigen::VectorXd vector;
};

/// Largest eigenvalue, from below, and its vector, of which the recurrence is run a second time.
Highest highest_of(const BlockMatrix& a, const Unknowns& unknowns) {
  constexpr std::size_t most = 100, look_every = 5;
  constexpr double grows_no_more = 1e-4;  // in so many steps
  const Eigen::VectorXd start = scattered(unknowns);
  std::vector<double> alpha, beta;
  Eigen::VectorXd share;  // of each vⱼ
  double value = 0.0;
  const auto largest = [&] {
    const auto n = Eigen::Index(alpha.size());
    Eigen::MatrixXd small = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      small(j, j) = alpha[std::size_t(j)];
      if (j > 0) small(j, j - 1) = small(j - 1, j) = beta[std::size_t(j - 1)];
    }
    const EigenSolution<Eigen::MatrixXd> ritz = eigen_solution(small);
    share = ritz.vectors.col(n - 1);
    return ritz.values[n - 1];
  };
  lanczos(a, start, [&](const Eigen::VectorXd&, double on, double beside) {
    alpha.push_back(on), beta.push_back(beside);
    if (alpha.size() % look_every != 0) return true;
    const double before = value;
    value = largest();
    return value > before * (1.0 + grows_no_more) && alpha.size() < most;
  });
  value = largest();
  Highest highest = {value, Eigen::VectorXd::Zero(start.size())};
  Eigen::Index j = 0;
  lanczos(a, start, [&](const Eigen::VectorXd& v, double, double) {
    highest.vector += share[j] * v;
    return ++j < share.size();
  });
  return highest;
}

/// x: six numbers a site, whose squares are its part of the kinetic energy.
void name_the_fastest(const Model& model, const State& state, const Eigen::VectorXd& x, CriticalStep& result) {
  double most = -1.0;
  const auto energy = [&](std::size_t site) { return x.segment<6>(Eigen::Index(6 * site)).squaredNorm(); };
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (energy(i) > most) most = energy(i), result.body = std::int32_t(i);
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    if (const double of_node = energy(model.bodies.size() + i); of_node > most)
      most = of_node, result.node = model.fill.mesh_node[i];
  double stiffest = -1.0;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& patch = model.joints[i];
    if (patch.a != result.body && patch.b != result.body) continue;
    const double k = patch_stiffness(model, state, i, PatchTangent::intact).trace();
    if (k > stiffest) stiffest = k, result.patch = std::int64_t(i);
  }
}

}  // namespace

CriticalStep critical_step(const Model& model, const State& state) {
  return critical_step(model, state, number_unknowns(model));
}

CriticalStep critical_step(const Model& model, const State& state, const Unknowns& unknowns) {
  CriticalStep result;
  const Highest highest = highest_of(scaled_stiffness(model, state, unknowns), unknowns);
  if (!(highest.value > 0.0)) return result;  // nothing but zero modes: no joints at all
  result.highest = std::sqrt(highest.value);
  result.step = 2.0 / result.highest;
  name_the_fastest(model, state, highest.vector, result);
  return result;
}

}  // namespace voussoir
