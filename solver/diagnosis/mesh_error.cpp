#include "solver/diagnosis/mesh_error.h"

#include <cmath>

namespace voussoir {

namespace {

/// Which mode of `other` is each of the first of `r`: of the same direction, the k-th of it, when their frequencies are
/// near.
std::vector<int> same_modes(const Response& r, const Response& other, std::size_t count) {
  std::vector<int> partner(std::min(count, r.words.size()), -1);
  std::vector<bool> taken(other.words.size(), false);
  for (std::size_t i = 0; i < partner.size(); ++i)
    for (std::size_t j = 0; j < other.words.size(); ++j) {
      if (taken[j] || other.words[j].direction != r.words[i].direction || r.words[i].direction == "local") continue;
      if (std::abs(r.log_frequency[Eigen::Index(i)] - other.log_frequency[Eigen::Index(j)]) > 0.15) continue;
      partner[i] = int(j);
      taken[j] = true;
      break;
    }
  return partner;
}

}  // namespace

MeshError mesh_error(const CoarserMesh& coarser, const Response& a, const Hypothesis& hypothesis,
                     const Eigen::VectorXd& x, int modes) {
  const Assembly assembly = hypothesis.assembly(coarser.assembly, x);
  EigenMemory memory;
  const Response b = response(assembly, linear_model(assembly), coarser.sensors, modes, memory);
  const std::vector<int> partner = same_modes(a, b, std::size_t(modes));
  MeshError error;
  error.difference.log_frequency = Eigen::VectorXd::Zero(a.log_frequency.size());
  error.difference.sensors = Eigen::MatrixXd::Zero(a.sensors.rows(), a.sensors.cols());
  std::vector<double> shifts;
  double squares = 0.0;
  int entries = 0;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] < 0) continue;
    shifts.push_back(b.log_frequency[partner[i]] - a.log_frequency[Eigen::Index(i)]);
    error.difference.log_frequency[Eigen::Index(i)] = shifts.back();
    if (coarser.sensors.empty()) continue;
    const Eigen::VectorXd u = a.sensors.col(Eigen::Index(i)), v = b.sensors.col(partner[i]);
    const double scale = u.dot(v) / std::max(v.squaredNorm(), 1e-300), largest = u.cwiseAbs().maxCoeff();
    if (u.dot(v) * u.dot(v) < 0.8 * u.squaredNorm() * v.squaredNorm()) continue;  // close modes that mix otherwise
    error.difference.sensors.col(Eigen::Index(i)) = scale * v - u;
    squares += (u - scale * v).squaredNorm() / (largest * largest);
    entries += int(u.size());
  }
  if (shifts.empty()) return error;
  for (double s : shifts) error.shift += s / double(shifts.size());
  for (std::size_t i = 0; i < partner.size(); ++i)
    if (partner[i] >= 0) error.difference.log_frequency[Eigen::Index(i)] -= error.shift;
  for (double s : shifts) error.scatter += (s - error.shift) * (s - error.shift);
  error.scatter = std::sqrt(error.scatter / double(shifts.size()));
  if (entries > 0) error.shape = std::sqrt(squares / entries);
  return error;
}

}  // namespace voussoir
