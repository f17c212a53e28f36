#include "solver/identify/transfer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/error.h"
#include "solver/identify/prepare.h"
#include "solver/identify/spectra.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

constexpr double same_motion =
    1e-9;  // of the smallest eigenvalue of the inputs' coherences: nothing is left to tell apart

/// Columns of the gathered signals.
struct Roles {
  std::vector<int> inputs, outputs;
};

Roles sorted(const Prepared& p) {
  Roles roles;
  double largest = 0.0;
  for (const Eigen::MatrixXd& x : p.signals) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  for (int c = 0; c < int(p.channels.size()); ++c) {
    double moves = 0.0;
    for (const Eigen::MatrixXd& x : p.signals) moves = std::max(moves, x.col(c).cwiseAbs().maxCoeff());
    if (!is_base_channel(p.channels[std::size_t(c)]))
      roles.outputs.push_back(c);
    else if (moves > 1e-9 * largest)
      roles.inputs.push_back(c);
  }
  return roles;
}

Roles roles_of(const Prepared& p) {
  Roles roles = sorted(p);
  if (roles.inputs.empty())
    throw InputError(
        "transfer functions: no channel base_x, base_y or base_z moves in all recordings. Give the motion of the "
        "ground under one of these names.");
  if (roles.outputs.empty())
    throw InputError(
        "transfer functions: there is no channel except the motion of the ground. Give channels of sensors on the "
        "structure.");
  return roles;
}

/// Inputs whose spectra are each other's at every line leave nothing to tell them apart by.
void check_independent(const CrossSpectra& spectra, const Prepared& p, const std::vector<int>& inputs) {
  for (std::size_t a = 0; a < inputs.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double least = 1.0;
      for (std::size_t k = 1; k < spectra.density.size(); ++k) {
        const Eigen::MatrixXcd& g = spectra.density[k];
        const double both = g(inputs[a], inputs[a]).real() * g(inputs[b], inputs[b]).real();
        if (both > 0.0) least = std::min(least, std::norm(g(inputs[a], inputs[b])) / both);
      }
      if (least > 0.999)
        throw InputError("transfer functions: '{}' and '{}' are proportional to each other. Leave out one of them.",
                         p.channels[std::size_t(inputs[b])], p.channels[std::size_t(inputs[a])]);
    }
}

/// One line: H = G_yx G_xx⁻¹, multiple coherence G_yx G_xx⁻¹ G_xy / G_yy (Bendat & Piersol 2010, section 7.2).
void solve_line(const Eigen::MatrixXcd& g, const Roles& roles, Eigen::Index line, TransferFunctions& t) {
  const auto q = Eigen::Index(roles.inputs.size()), n = Eigen::Index(roles.outputs.size());
  const double none = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Constant(n, q, {none, none});
  Eigen::MatrixXd spread = Eigen::MatrixXd::Constant(n, q, none);
  const Eigen::MatrixXcd gxx = g(roles.inputs, roles.inputs), gyx = g(roles.outputs, roles.inputs);
  const Eigen::VectorXd size = gxx.diagonal().real().cwiseMax(0.0).cwiseSqrt();
  t.coherence.row(line).setConstant(none);
  if (size.minCoeff() > 0.0) {
    const Eigen::VectorXd over = size.cwiseInverse();
    const auto alike = eigen_solution(Eigen::MatrixXcd(over.asDiagonal() * gxx * over.asDiagonal()));
    if (alike.values[0] > same_motion) {
      const Eigen::MatrixXcd inverse = over.asDiagonal() * alike.vectors * alike.values.cwiseInverse().asDiagonal() *
                                       alike.vectors.adjoint() * over.asDiagonal();
      h = gyx * inverse;
      for (Eigen::Index i = 0; i < n; ++i) {
        const double power = g(roles.outputs[std::size_t(i)], roles.outputs[std::size_t(i)]).real();
        const double explained = (h.row(i) * gyx.row(i).adjoint()).value().real();
        const double rest = std::max(0.0, power - explained);
        if (power > 0.0) t.coherence(line, i) = std::clamp(explained / power, 0.0, 1.0);
        // For one input √(1 − γ²) / (γ √(2 n)) · |H| (Bendat & Piersol 2010, section 9.2); with q, the partial
        // coherence takes the place of γ² and n − q + 1 that of n (section 9.3).
        for (Eigen::Index j = 0; j < q; ++j)
          spread(i, j) = std::sqrt(rest * inverse(j, j).real() / (2.0 * (t.averages - double(q) + 1.0)));
      }
    }
  }
  t.values.push_back(std::move(h));
  t.magnitude_std.push_back(std::move(spread));
}

}  // namespace

bool has_base_motion(const std::vector<Recording>& recordings) {
  return !sorted(gathered(recordings, 0.0)).inputs.empty();
}

TransferFunctions transfer_functions(const std::vector<Recording>& recordings, const TransferSettings& settings) {
  const Prepared p = gathered(recordings, settings.highest_frequency);
  const Roles roles = roles_of(p);
  const int window = window_samples(p, settings.window, 10.0, "transfer functions");
  const CrossSpectra spectra = cross_spectra(p.signals, p.dt, window, p.highest_frequency);
  const double least = double(roles.inputs.size()) + 2.0;
  if (spectra.averages < least)
    throw InputError(
        "transfer functions: the recordings contain {:.1f} independent windows of {:.3g} s, but {} inputs need {}. "
        "Choose a shorter window.",
        spectra.averages, p.dt * window, roles.inputs.size(), least);
  check_independent(spectra, p, roles.inputs);
  TransferFunctions t;
  for (const int c : roles.inputs) t.inputs.push_back(p.channels[std::size_t(c)]);
  for (const int c : roles.outputs) t.outputs.push_back(p.channels[std::size_t(c)]);
  t.window = p.dt * window;
  t.averages = spectra.averages;
  const auto lines = Eigen::Index(spectra.density.size()) - 1;
  t.frequencies = spectra.step * Eigen::VectorXd::LinSpaced(lines, 1.0, double(lines));
  t.coherence.resize(lines, Eigen::Index(roles.outputs.size()));
  for (Eigen::Index k = 0; k < lines; ++k) solve_line(spectra.density[std::size_t(k) + 1], roles, k, t);
  return t;
}

}  // namespace voussoir
