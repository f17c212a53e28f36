#include "solver/diagnosis/locate.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/effects/parts.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// Shares of the computed modes in a measured one: those that fit its shape with the least residual energy.
Eigen::VectorXd expansion(const DiagnosisProblem& problem, const Evaluation& at, std::size_t mode) {
  constexpr double trust = 0.1;  // residual energy that weighs as much as a standard deviation at one sensor
  const MeasuredFeature& measured = problem.features.modes[mode];
  const Eigen::Index count = at.response.eigenvalues.size();
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(count);
  const int pair = at.pairing.computed[mode];
  if (!std::isfinite(at.pairing.assurance[mode])) {
    if (pair >= 0) shares[pair] = 1.0;
    return shares;
  }
  const double lambda = std::pow(2.0 * EIGEN_PI * measured.frequency, 2);
  double largest = 0.0;
  std::vector<Eigen::Index> seen;
  for (Eigen::Index s = 0; s < measured.shape.size(); ++s)
    if (std::isfinite(measured.shape[s])) seen.push_back(s), largest = std::max(largest, std::abs(measured.shape[s]));
  Eigen::MatrixXd a(Eigen::Index(seen.size()), count);
  Eigen::VectorXd b(Eigen::Index(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double std = std::hypot(measured.shape_std[seen[i]] / largest, problem.error.shape);
    a.row(Eigen::Index(i)) = at.readings.row(seen[i]) / std;
    b[Eigen::Index(i)] = measured.shape[seen[i]] / largest / std;
  }
  // In the scale of the shape: its computed partner has this size at the sensors.
  const double unit = pair >= 0 ? at.readings.col(pair).cwiseAbs().maxCoeff() : at.readings.cwiseAbs().maxCoeff();
  Eigen::VectorXd penalty(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const double apart = at.response.eigenvalues[j] - lambda;
    penalty[j] = apart * apart / (at.response.eigenvalues[j] * lambda) * unit * unit / (trust * trust);
  }
  const Eigen::VectorXd right = a.transpose() * b;
  return solve_symmetric(
      a.transpose() * a + Eigen::MatrixXd(penalty.asDiagonal()) + 1e-9 * Eigen::MatrixXd::Identity(count, count),
      right);
}

/// Twice the energy of u in each joint, half to each of its blocks; all of it to the free one where one is fixed. Of a
/// patch with the fill likewise, to its block and its nodes; that of the fill to its nodes.
class Energy {
 public:
  Energy(const Assembly& assembly, const Unknowns& unknowns)
      : unknowns_(unknowns), parts_(contributions(assembly)), sites_(unknowns.of.size(), 0.0) {
    const std::size_t first = parts_.pairs.size() + parts_.patches.size();
    for (std::size_t i = 0; i < parts_.elements.size() + parts_.rings.size(); ++i)
      fill_.push_back(std::int32_t(first + i));
  }
  void add(const Eigen::VectorXd& u, double factor) {
    for (const auto& pair : parts_.pairs) {
      const auto a = std::size_t(pair.a), b = std::size_t(pair.b);
      Vector12 motion;
      motion.head<6>() = part_of(u, unknowns_, a);
      motion.tail<6>() = part_of(u, unknowns_, b);
      share(factor * motion.dot(pair.k * motion), {a}, {b});
    }
    for (const auto& patch : parts_.patches) {
      std::vector<std::size_t> nodes;
      for (const std::int32_t node : patch.nodes) nodes.push_back(unknowns_.bodies + std::size_t(node));
      Eigen::Matrix<double, 15, 1> motion;
      motion.head<6>() = part_of(u, unknowns_, std::size_t(patch.block));
      for (std::size_t i = 0; i < 3; ++i)
        motion.segment<3>(Eigen::Index(6 + 3 * i)) = part_of(u, unknowns_, nodes[i]).head<3>();
      share(factor * motion.dot(patch.k * motion), {std::size_t(patch.block)}, nodes);
    }
    if (fill_.empty()) return;
    Vectors force = Vectors::Zero(u.size(), 1);
    add_stiffness(parts_, fill_, factor, unknowns_, u, force);
    const Eigen::VectorXd f = force.col(0);
    for (std::size_t site = unknowns_.bodies; site < sites_.size(); ++site)
      sites_[site] += part_of(u, unknowns_, site).dot(part_of(f, unknowns_, site));
  }
  const std::vector<double>& sites() const { return sites_; }

 private:
  void share(double energy, const std::vector<std::size_t>& one, const std::vector<std::size_t>& other) {
    const bool both = unknowns_.any(one[0]) && unknowns_.any(other[0]);
    for (const auto* side : {&one, &other})
      for (const std::size_t site : *side)
        if (unknowns_.any(site)) sites_[site] += (both ? 0.5 : 1.0) * energy / double(side->size());
  }

  const Unknowns& unknowns_;
  const Contributions parts_;
  std::vector<std::int32_t> fill_;  // units of its elements and rings
  std::vector<double> sites_;
};

/// The part of the bridge that each site belongs to.
std::vector<std::string> parts_of_sites(const Assembly& assembly, const Unknowns& unknowns) {
  std::vector<std::string> parts = parts_of_blocks(assembly);
  parts.resize(unknowns.of.size(), component_names()[std::size_t(Component::backfill)]);
  return parts;
}

}  // namespace

Location locate(const DiagnosisProblem& problem, const Evaluation& at) {
  Location location;
  Energy energy(at.assembly, at.model.unknowns);
  std::vector<Vec3> work(at.model.unknowns.of.size(), Vec3::Zero());
  int modes = 0;
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const Eigen::VectorXd shares = expansion(problem, at, m);
    if (shares.isZero(0.0)) continue;
    const double lambda = std::pow(2.0 * EIGEN_PI * problem.features.modes[m].frequency, 2);
    const Eigen::ArrayXd apart = at.response.eigenvalues.array() - lambda;
    const Eigen::VectorXd u = at.response.vectors * (shares.array() * apart / at.response.eigenvalues.array()).matrix();
    const Eigen::VectorXd f =
        at.model.m.selfadjointView<Eigen::Lower>() * (at.response.vectors * (shares.array() * apart).matrix());
    const double scale = 1.0 / (lambda * shares.squaredNorm());
    energy.add(u, scale);
    for (std::size_t i = 0; i < work.size(); ++i)
      work[i] += scale * part_of(f, at.model.unknowns, i)
                             .head<3>()
                             .cwiseProduct(part_of(u, at.model.unknowns, i).head<3>())
                             .cwiseAbs();
    ++modes;
  }
  const std::vector<std::string> parts = parts_of_sites(at.assembly, at.model.unknowns);
  std::map<std::string, std::pair<double, Vec3>> sums;
  double all = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto& [sum, along] = sums.try_emplace(parts[i], 0.0, Vec3::Zero()).first->second;
    sum += energy.sites()[i];
    along += work[i];
    all += energy.sites()[i];
  }
  location.blocks.assign(energy.sites().begin(), energy.sites().begin() + std::ptrdiff_t(at.assembly.blocks.size()));
  if (all <= 0.0) return location;
  for (const auto& [part, sum] : sums) {
    int axis = 0;
    sum.second.maxCoeff(&axis);
    if (sum.first > 0.0) location.parts.push_back({part, sum.first / all, "xyz"[axis]});
  }
  std::stable_sort(location.parts.begin(), location.parts.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  location.size = all / modes;
  const double largest = *std::max_element(location.blocks.begin(), location.blocks.end());
  for (double& block : location.blocks) block /= std::max(largest, 1e-300);
  return location;
}

std::vector<PartSensitivity> sensitivities(const Evaluation& at, int mode) {
  const Eigen::VectorXd phi = at.response.vectors.col(mode);
  Energy energy(at.assembly, at.model.unknowns);
  energy.add(phi, 0.5 / at.response.eigenvalues[mode]);
  const Eigen::VectorXd momentum = at.model.m.selfadjointView<Eigen::Lower>() * phi;
  const std::vector<std::string> parts = parts_of_sites(at.assembly, at.model.unknowns);
  std::map<std::string, PartSensitivity> sums;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    PartSensitivity& s = sums[parts[i]];
    s.part = parts[i];
    s.stiffness += energy.sites()[i];
    s.mass -= 0.5 * part_of(phi, at.model.unknowns, i).dot(part_of(momentum, at.model.unknowns, i));
  }
  std::vector<PartSensitivity> all;
  for (const auto& [part, s] : sums)
    if (s.stiffness != 0.0 || s.mass != 0.0) all.push_back(s);
  return all;
}

}  // namespace voussoir
