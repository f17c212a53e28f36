// Which sensor or quantity would tell two explanations apart.
#include <fmt/format.h>

#include <cmath>

#include "solver/diagnosis/diagnose.h"

namespace voussoir {

namespace {

/// The fit's mode that is measured mode `m`, as displacements of the first `blocks` blocks along x, y, z, largest 1.
Eigen::MatrixXd shape_of(const Fit& fit, int computed, std::size_t blocks) {
  Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(Eigen::Index(blocks), 3);
  const Eigen::VectorXd vector = fit.best.response.vectors.col(computed);
  for (std::size_t i = 0; i < blocks; ++i)
    shape.row(Eigen::Index(i)) = part_of(vector, fit.best.model.unknowns, i).head<3>();
  return shape / std::max(shape.cwiseAbs().maxCoeff(), 1e-300);
}

struct Difference {
  double deviations = 0.0;
  std::string text;
};

Difference in_shapes(const DiagnosisProblem& problem, const Trial& a, const Trial& b) {
  Difference most;
  const std::size_t blocks = problem.base.blocks.size();
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const int ca = a.fit.best.pairing.computed[m], cb = b.fit.best.pairing.computed[m];
    if (ca < 0 || cb < 0) continue;
    const Eigen::MatrixXd u = shape_of(a.fit, ca, blocks), v = shape_of(b.fit, cb, blocks);
    const double scale = (u.array() * v.array()).sum() / v.squaredNorm();
    Eigen::Index block = 0, axis = 0;
    const double apart = (u - scale * v).cwiseAbs().maxCoeff(&block, &axis);
    if (apart / problem.error.shape <= most.deviations) continue;
    most.deviations = apart / problem.error.shape;
    const Vec3 at = problem.base.blocks[std::size_t(block)].centroid;
    most.text = fmt::format(
        "place a sensor near ({:.1f}, {:.1f}, {:.1f}) m along {}: mode {} differs there by {:.1f} standard deviations",
        at.x(), at.y(), at.z(), "xyz"[axis], problem.features.modes[m].name, most.deviations);
  }
  return most;
}

/// Modes that were not measured: those of `a` up to twice the highest measured frequency, each compared with the most
/// similar mode of `b`.
Difference in_frequencies(const DiagnosisProblem& problem, const Trial& a, const Trial& b) {
  Difference most;
  const std::size_t blocks = problem.base.blocks.size();
  const Response &ra = a.fit.best.response, &rb = b.fit.best.response;
  double highest = 0.0;
  for (const MeasuredFeature& mode : problem.features.modes) highest = std::max(highest, mode.frequency);
  for (Eigen::Index i = 0; i < ra.log_frequency.size(); ++i) {
    const auto& known = a.fit.best.pairing.computed;
    if (std::find(known.begin(), known.end(), int(i)) != known.end()) continue;
    if (ra.words[std::size_t(i)].direction == "local" || ra.log_frequency[i] > std::log(2.0 * highest)) continue;
    const Eigen::MatrixXd u = shape_of(a.fit, int(i), blocks);
    double like = 0.8, apart = 0.0;
    for (Eigen::Index j = 0; j < rb.log_frequency.size(); ++j) {
      const Eigen::MatrixXd v = shape_of(b.fit, int(j), blocks);
      const double uv = (u.array() * v.array()).sum(), mac = uv * uv / (u.squaredNorm() * v.squaredNorm());
      if (mac > like) like = mac, apart = std::abs(ra.log_frequency[i] - rb.log_frequency[j]);
    }
    if (apart / problem.error.frequency <= most.deviations) continue;
    most.deviations = apart / problem.error.frequency;
    most.text = fmt::format("measure the period of a further mode ({}, about {:.3f} s): it differs by {:.1f} %",
                            ra.words[std::size_t(i)].text(), std::exp(-ra.log_frequency[i]), 100.0 * std::expm1(apart));
  }
  return most;
}

}  // namespace

Advice advise(const DiagnosisProblem& problem, const Trial& best, const Trial& other) {
  const Difference shape = in_shapes(problem, best, other), period = in_frequencies(problem, best, other);
  Advice advice;
  advice.against = other.candidate.full_text();
  const Difference& most = shape.deviations > period.deviations ? shape : period;
  advice.text = most.deviations > 1.0 ? most.text : "none of the examined modes distinguishes them";
  return advice;
}

}  // namespace voussoir
