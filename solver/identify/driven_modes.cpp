#include "solver/identify/driven_modes.h"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/identify/spectra.h"
#include "solver/identify/ssi.h"
#include "solver/linear/dense_eigen.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

using Complex = std::complex<double>;
constexpr Eigen::Index least_lines = 16;
constexpr Eigen::Index background = 3;        // columns of the basis before those of the poles
constexpr Eigen::Index kept_directions = 24;  // of the columns: more than poles and background can fill
constexpr double first_damping = 0.03;
constexpr double least_ratio = 1e-4, most_ratio = 0.9;  // of damping, in the search
constexpr double edge_lines = 2.0;
constexpr double most_leverage = 0.9;  // of a line on itself: nearer to 1 the jackknife says nothing
/// Hann windows correlate the errors of neighbouring lines by 4/9 and of the next ones by 1/36:
/// 1 + 2 (4/9 + 1/36) lines tell as much as one.
constexpr double lines_as_one = 1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0);

/// The transfer functions, a column for each output and input (outputs first), over their standard deviations.
struct Data {
  Eigen::Index outputs = 0, inputs = 0;
  Eigen::VectorXd omega;      // rad/s, of the lines that are used
  Eigen::VectorXd line;       // weight of each line
  Eigen::RowVectorXd column;  // weight of each column
  Eigen::MatrixXcd values;    // lines × columns, weighted
  Eigen::MatrixXcd reduced;   // the same along the columns' leading directions
  double window = 0.0;        // s; 0: not smoothed
};

std::vector<Eigen::Index> finite_lines(const TransferFunctions& t) {
  std::vector<Eigen::Index> lines;
  for (std::size_t k = 0; k < t.values.size(); ++k)
    if (t.values[k].allFinite() && t.magnitude_std[k].allFinite()) lines.push_back(Eigen::Index(k));
  if (Eigen::Index(lines.size()) < least_lines)
    throw InputError(
        "driven modes: {} finite, but {} are needed. Choose a longer window or a higher highest frequency, or give "
        "longer recordings.",
        counted(lines.size(), "line of the transfer functions is", "lines of the transfer functions are"), least_lines);
  return lines;
}

/// Median over the lines of each column's standard deviation; where that is nothing, next to nothing.
Eigen::RowVectorXd column_spread(const Eigen::MatrixXd& spread, double size) {
  Eigen::RowVectorXd medians(spread.cols());
  for (Eigen::Index c = 0; c < spread.cols(); ++c) medians[c] = median_of({spread.col(c).begin(), spread.col(c).end()});
  const double least = 1e-3 * medians.maxCoeff() + 1e-9 * size;
  return least > 0.0 ? medians.cwiseMax(least).eval() : Eigen::RowVectorXd::Ones(spread.cols()).eval();
}

/// A line's standard deviations over those of the median line, root mean square over the columns.
Eigen::VectorXd line_spread(const Eigen::MatrixXd& spread, const Eigen::RowVectorXd& column) {
  const Eigen::VectorXd ratio = (spread.array().rowwise() / column.array()).square().rowwise().mean().sqrt().matrix();
  const double usual = median_of({ratio.begin(), ratio.end()});
  return usual > 0.0 ? (ratio / usual).cwiseMax(0.1).eval() : Eigen::VectorXd::Ones(ratio.size()).eval();
}

/// Values along the leading right singular vectors: what is left out holds noise alone.
Eigen::MatrixXcd along_leading(const Eigen::MatrixXcd& values) {
  if (values.cols() <= kept_directions) return values;
  const auto squared = eigen_solution(Eigen::MatrixXcd(values.adjoint() * values));
  return values * squared.vectors.rightCols(kept_directions);
}

Data weighted(const TransferFunctions& t, bool smoothed) {
  const std::vector<Eigen::Index> lines = finite_lines(t);
  Data d;
  d.outputs = Eigen::Index(t.outputs.size());
  d.inputs = Eigen::Index(t.inputs.size());
  d.window = smoothed ? t.window : 0.0;
  d.omega = two_pi * t.frequencies(lines);
  const auto n = Eigen::Index(lines.size());
  Eigen::MatrixXd spread(n, d.outputs * d.inputs);
  d.values.resize(n, spread.cols());
  for (Eigen::Index k = 0; k < n; ++k) {
    d.values.row(k) = t.values[std::size_t(lines[std::size_t(k)])].reshaped().transpose();
    spread.row(k) = t.magnitude_std[std::size_t(lines[std::size_t(k)])].reshaped().transpose();
  }
  const Eigen::RowVectorXd of_column = column_spread(spread, d.values.cwiseAbs().maxCoeff());
  d.column = of_column.cwiseInverse();
  d.line = line_spread(spread, of_column).cwiseInverse();
  d.values = d.line.asDiagonal() * d.values * d.column.asDiagonal();
  d.reduced = along_leading(d.values);
  return d;
}

/// ∫ (1 − u) e^(pu) du from 0 to 1.
Complex ramp_integral(Complex p) {
  if (std::abs(p) > 0.5) return (std::exp(p) - 1.0 - p) / (p * p);
  Complex term = 0.5, sum = term;
  for (int n = 3; n < 16; ++n) sum += term *= p / double(n);
  return sum;
}

/// ∫ c(u) e^(pu) du from 0 to 1, c the autocorrelation of a Hann window of length 1 over that without a lag:
/// (1 − u) (2 + cos 2πu) / 3 + sin(2πu) / 2π.
Complex window_integral(Complex p) {
  const Complex up = p + Complex(0.0, two_pi), down = p - Complex(0.0, two_pi);
  const Complex j_up = ramp_integral(up), j_down = ramp_integral(down);
  const Complex sine = (up * j_up - down * j_down) / Complex(0.0, 2.0 * two_pi);
  return 2.0 / 3.0 * ramp_integral(p) + (j_up + j_down) / 6.0 + sine;
}

/// S = Ω² / (ω² − Ω² + 2iζωΩ) as windows of `window` seconds see it (0: as it is).
Complex response(double omega, double damping, double at, double window) {
  if (window == 0.0) return at * at / Complex(omega * omega - at * at, 2.0 * damping * omega * at);
  // S = −1 + Σ R / (iΩ − λ) over λ and its conjugate; the impulse response R e^(λτ) is multiplied by the window's
  // autocorrelation.
  const double damped = omega * std::sqrt(1.0 - damping * damping);
  const Complex pole(-damping * omega, damped), residue = -pole * pole / Complex(0.0, 2.0 * damped);
  const Complex i_at(0.0, at);
  return -1.0 + window * (residue * window_integral((pole - i_at) * window) +
                          std::conj(residue) * window_integral((std::conj(pole) - i_at) * window));
}

/// Unknowns of the search: log ω and log ζ of each pole.
using Unknowns = Eigen::VectorXd;

double omega_of(const Data& d, double x) {
  return std::clamp(std::exp(x), 0.5 * d.omega[0], 1.5 * d.omega.tail(1)[0]);
}
double damping_of(double x) {
  return std::clamp(std::exp(x), least_ratio, most_ratio);
}

Eigen::VectorXcd pole_column(const Data& d, double log_omega, double log_damping) {
  const double omega = omega_of(d, log_omega), damping = damping_of(log_damping);
  Eigen::VectorXcd b(d.omega.size());
  for (Eigen::Index k = 0; k < b.size(); ++k) b[k] = d.line[k] * response(omega, damping, d.omega[k], d.window);
  return b;
}

/// By the unknown of that number, central difference.
Eigen::VectorXcd pole_derivative(const Data& d, const Unknowns& x, Eigen::Index index) {
  constexpr double step = 1e-5;
  Unknowns low = x, high = x;
  low[index] -= step;
  high[index] += step;
  const Eigen::Index m = index / 2 * 2;
  return (pole_column(d, high[m], high[m + 1]) - pole_column(d, low[m], low[m + 1])) / (2.0 * step);
}

/// Lines × (1, iΩ, Ω², poles), weighted.
Eigen::MatrixXcd basis(const Data& d, const Unknowns& x) {
  Eigen::MatrixXcd b(d.omega.size(), background + x.size() / 2);
  const Eigen::VectorXcd s = Complex(0.0, 1.0) * d.omega / d.omega.tail(1)[0];
  b.col(0) = d.line.cast<Complex>();
  b.col(1) = b.col(0).cwiseProduct(s);
  b.col(2) = b.col(1).cwiseProduct(s);
  for (Eigen::Index m = 0; m < x.size() / 2; ++m) b.col(background + m) = pole_column(d, x[2 * m], x[2 * m + 1]);
  return b;
}

/// Linear least squares in an orthonormal basis.
struct Projection {
  Eigen::MatrixXcd q;        // lines × columns of the basis
  Eigen::MatrixXcd inverse;  // the basis' pseudo-inverse
  Projection(const Data& d, const Unknowns& x) {
    const Eigen::MatrixXcd b = basis(d, x);
    const Eigen::HouseholderQR<Eigen::MatrixXcd> qr(b);
    q = qr.householderQ() * Eigen::MatrixXcd::Identity(b.rows(), b.cols());
    inverse = qr.matrixQR().topRows(b.cols()).triangularView<Eigen::Upper>().solve(q.adjoint());
  }
  Eigen::MatrixXcd left(const Eigen::MatrixXcd& y) const { return y - q * (q.adjoint() * y); }
};

/// What the projection leaves, real and imaginary parts, and its derivatives without the term that vanishes with the
/// residuals (Kaufman 1975).
class Cost : public ceres::CostFunction {
 public:
  Cost(const Data& data, Eigen::Index unknowns) : data_(&data) {
    mutable_parameter_block_sizes()->push_back(int(unknowns));
    set_num_residuals(int(2 * data.reduced.size()));
  }
  bool Evaluate(double const* const* parameters, double* r, double** jacobians) const override {
    const Eigen::Index n = parameter_block_sizes()[0], rows = num_residuals();
    const Unknowns x = Eigen::Map<const Unknowns>(parameters[0], n);
    if (!x.allFinite()) return false;
    const Projection p(*data_, x);
    put(p.left(data_->reduced), Eigen::Map<Eigen::VectorXd>(r, rows));
    if (!jacobians || !jacobians[0]) return true;
    const Eigen::MatrixXcd amplitudes = p.inverse * data_->reduced;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(jacobians[0], rows, n);
    for (Eigen::Index i = 0; i < n; ++i)
      put(-p.left(pole_derivative(*data_, x, i)) * amplitudes.row(background + i / 2), j.col(i));
    return true;
  }

 private:
  template <class Column>
  static void put(const Eigen::MatrixXcd& values, Column&& column) {
    column.head(values.size()) = values.real().reshaped();
    column.tail(values.size()) = values.imag().reshaped();
  }
  const Data* data_;
};

void refine(const Data& d, Unknowns& x) {
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(d, x.size()), nullptr, x.data());  // the problem owns it
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-8;
  options.parameter_tolerance = 1e-8;
  options.initial_trust_region_radius = 100.0;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw RunError("driven modes: the fit failed: {}", summary.message);
}

/// The line within the band at which most is unexplained: highest of the maxima of the largest singular value of
/// outputs × inputs; −1 when there is none. What rises to an edge lies beyond it.
Eigen::Index next_start(const Data& d, const Eigen::MatrixXcd& left) {
  Eigen::VectorXd size(left.rows());
  for (Eigen::Index k = 0; k < left.rows(); ++k)
    size[k] = Eigen::JacobiSVD<Eigen::MatrixXcd>(left.row(k).reshaped(d.outputs, d.inputs)).singularValues()[0];
  Eigen::Index best = -1;
  for (Eigen::Index k = 2; k + 2 < size.size(); ++k)
    if (size[k] >= size[k - 1] && size[k] >= size[k + 1] && (best < 0 || size[k] > size[best])) best = k;
  return best;
}

/// Schwarz (1978): n log of the residuals' mean square, and log n for each number fitted.
double information(const Data& d, const Unknowns& x, double left) {
  const double values = 2.0 * double(d.values.size()) / lines_as_one;
  // The residue of a mode has rank one. The least-squares solution is reduced to this rank.
  const Eigen::Index poles = x.size() / 2;
  const double of_residue = double(d.outputs + d.inputs - 1);
  const double fitted = double(x.size()) + 2.0 * (double(background * d.values.cols()) + double(poles) * of_residue);
  const double least = 1e-20 * d.values.squaredNorm();
  return values * std::log(std::max(left, least) / values) + fitted * std::log(values);
}

Unknowns search(const Data& d, int largest_count) {
  Unknowns x;
  Eigen::MatrixXcd left = Projection(d, x).left(d.values);
  double best = information(d, x, left.squaredNorm());
  // Half of the lines at most are fitted.
  const Eigen::Index most = std::min(Eigen::Index(largest_count), d.omega.size() / 2 - background);
  while (x.size() / 2 < most && left.squaredNorm() > 0.0) {
    const Eigen::Index start = next_start(d, left);
    if (start < 0) break;
    Unknowns more(x.size() + 2);
    more << x, std::log(d.omega[start]), std::log(first_damping);
    refine(d, more);
    const Eigen::MatrixXcd rest = Projection(d, more).left(d.values);
    const double now = information(d, more, rest.squaredNorm());
    if (!(now < best)) break;
    best = now;
    x = more;
    left = rest;
  }
  return x;
}

/// A residue as shape × participationᵀ.
struct RankOne {
  Eigen::VectorXcd shape, participation;
  double second = 0.0;     // singular value over the first
  std::vector<int> known;  // outputs whose component stands out of the noise as the others' do
  int largest = 0;         // of these
};

/// Weights of outputs and inputs whose products are nearest to those of the columns.
struct Sides {
  Eigen::VectorXd output, input;
  explicit Sides(const Data& d) {
    const Eigen::MatrixXd logs = d.column.array().log().matrix().reshaped(d.outputs, d.inputs);
    output = logs.rowwise().mean().array().exp();
    input = (logs.colwise().mean().transpose().array() - logs.mean()).exp();
  }
};

/// What is known, and the largest of it, in a shape over its weights.
void choose(RankOne& r, const Eigen::VectorXcd& weighted) {
  constexpr double faint = 0.1;
  const double least = faint * weighted.cwiseAbs().maxCoeff();
  for (int s = 0; s < int(weighted.size()); ++s)
    if (std::abs(weighted[s]) >= least) r.known.push_back(s);
  r.largest = *std::max_element(r.known.begin(), r.known.end(),
                                [&](int a, int b) { return std::abs(r.shape[a]) < std::abs(r.shape[b]); });
}

/// Scales a shape to a largest component of size 1 with positive real part, and rotates its known components to the
/// least imaginary parts.
void normalise_residue(RankOne& r) {
  const double size = std::abs(r.shape[r.largest]);
  if (!(size > 0.0)) return;
  Complex factor = std::polar(1.0 / size, -0.5 * std::arg(r.shape(r.known).array().square().sum()));
  if ((factor * r.shape[r.largest]).real() < 0.0) factor = -factor;
  r.shape *= factor;
  r.participation /= factor;
}

/// Of outputs × inputs, normalised as `like`, or as it is best.
RankOne rank_one(const Sides& sides, const Eigen::MatrixXcd& residue, const RankOne* like = nullptr) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(sides.output.asDiagonal() * residue * sides.input.asDiagonal(),
                                               Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  RankOne r;
  r.shape = svd.matrixU().col(0).cwiseQuotient(sides.output);
  r.participation = values[0] * svd.matrixV().col(0).conjugate().cwiseQuotient(sides.input);
  r.second = values.size() > 1 && values[0] > 0.0 ? values[1] / values[0] : 0.0;
  if (like) {
    r.known = like->known;
    r.largest = like->largest;
  } else {
    choose(r, svd.matrixU().col(0));
  }
  normalise_residue(r);
  return r;
}

/// All that is fitted, and how far each line moves it.
struct Fitted {
  Unknowns x;
  Eigen::MatrixXcd residues;              // poles × columns
  Eigen::MatrixXcd left;                  // lines × columns, weighted
  Eigen::MatrixXd moves;                  // unknowns × lines
  std::vector<Eigen::MatrixXcd> changes;  // of the residues with each unknown
  Eigen::MatrixXcd inverse;               // poles × lines
  Eigen::VectorXd leverage;               // of each line
};

Fitted fitted(const Data& d, const Unknowns& x) {
  const Eigen::Index n = x.size(), lines = d.omega.size();
  const Projection p(d, x);
  Fitted f;
  f.x = x;
  f.left = p.left(d.values);
  f.inverse = p.inverse.bottomRows(n / 2);
  f.residues = f.inverse * d.values;
  f.leverage = p.q.rowwise().squaredNorm().cwiseMin(most_leverage);
  if (n == 0) return f;
  Eigen::MatrixXd normal(n, n), pull(n, lines);
  Eigen::MatrixXcd slopes(lines, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXcd slope = pole_derivative(d, x, i);
    slopes.col(i) = p.left(slope);
    f.changes.push_back(-(f.inverse * slope) * f.residues.row(i / 2));
    pull.row(i) = (f.left * f.residues.row(i / 2).adjoint()).cwiseProduct(slopes.col(i).conjugate()).real().transpose();
  }
  const Eigen::MatrixXcd across = slopes.adjoint() * slopes, residues = f.residues * f.residues.adjoint();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) normal(i, j) = (across(i, j) * residues(j / 2, i / 2)).real();
  f.moves = shortest_least_squares(normal, pull);
  return f;
}

/// The mode of pole m with standard deviations by the jackknife over lines, to first order in what a line leaves
/// (MacKinnon & White 1985).
DrivenMode mode_of(const Data& d, const Fitted& f, Eigen::Index m) {
  const Sides sides(d);
  const auto matrix = [&](const Eigen::RowVectorXcd& row) -> Eigen::MatrixXcd {
    return row.cwiseQuotient(d.column.cast<Complex>()).reshaped(d.outputs, d.inputs);
  };
  const RankOne r = rank_one(sides, matrix(f.residues.row(m)));
  DrivenMode mode;
  mode.frequency = omega_of(d, f.x[2 * m]) / two_pi;
  mode.damping = damping_of(f.x[2 * m + 1]);
  mode.shape = r.shape;
  mode.participation = r.participation;
  mode.second = r.second;
  mode.mean_phase = phase_collinearity(r.shape(r.known));
  double frequency = 0.0, damping = 0.0;
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(d.outputs), participation = Eigen::VectorXd::Zero(d.inputs);
  for (Eigen::Index k = 0; k < d.omega.size(); ++k) {
    const double grown = 1.0 / (1.0 - f.leverage[k]);
    Eigen::RowVectorXcd residue = f.inverse(m, k) * f.left.row(k);
    for (Eigen::Index i = 0; i < f.x.size(); ++i) residue += f.moves(i, k) * f.changes[std::size_t(i)].row(m);
    const RankOne moved = rank_one(sides, matrix(f.residues.row(m) + grown * residue), &r);
    frequency += std::pow(grown * f.moves(2 * m, k), 2.0);
    damping += std::pow(grown * f.moves(2 * m + 1, k), 2.0);
    shape += (moved.shape - r.shape).cwiseAbs2() / 2.0;
    participation += (moved.participation - r.participation).cwiseAbs2() / 2.0;
  }
  mode.frequency_std = mode.frequency * std::sqrt(lines_as_one * frequency);
  mode.damping_std = mode.damping * std::sqrt(lines_as_one * damping);
  mode.shape_std = (lines_as_one * shape).cwiseSqrt();
  mode.participation_std = (lines_as_one * participation).cwiseSqrt();
  return mode;
}

/// Why it is no mode of the structure, empty where it is.
std::string doubt(const Data& d, const DrivenMode& mode, const DrivenSettings& settings) {
  const double step = d.omega[1] - d.omega[0], omega = two_pi * mode.frequency;
  if (omega < d.omega[0] + edge_lines * step || omega > d.omega.tail(1)[0] - edge_lines * step)
    return "it is at the edge of the frequency band";
  if (mode.damping > settings.largest_damping) return fmt::format("its damping ratio is {:.2f}", mode.damping);
  if (!(mode.frequency_std <= settings.largest_spread * mode.frequency))
    return fmt::format("its frequency is uncertain by {:.0f} %", 100.0 * mode.frequency_std / mode.frequency);
  if (mode.mean_phase < settings.least_mean_phase)
    return fmt::format("its points do not move in phase: collinearity {:.2f}", mode.mean_phase);
  if (mode.second > settings.largest_second)
    return fmt::format("it is not a single mode: the second singular value of its residue is {:.2f} of the first",
                       mode.second);
  return {};
}

/// Share of the measured power, each function over its usual standard deviation.
double explained_share(const Data& d, const Eigen::MatrixXcd& left) {
  const Eigen::VectorXd over = d.line.cwiseInverse();
  const double all = (over.asDiagonal() * d.values).squaredNorm();
  return all > 0.0 ? std::clamp(1.0 - (over.asDiagonal() * left).squaredNorm() / all, 0.0, 1.0) : 0.0;
}

}  // namespace

DrivenModes driven_modes(const TransferFunctions& t, const DrivenSettings& settings) {
  if (settings.largest_count < 1)
    throw InputError("driven modes: 'largest_count' is {}. It must be at least 1.", settings.largest_count);
  const Data d = weighted(t, settings.smoothed);
  const Fitted f = fitted(d, search(d, settings.largest_count));
  DrivenModes result = {.inputs = t.inputs, .outputs = t.outputs, .modes = {}, .set_aside = {}};
  result.explained = explained_share(d, f.left);
  std::vector<DrivenMode> all;
  for (Eigen::Index m = 0; m < f.x.size() / 2; ++m) all.push_back(mode_of(d, f, m));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  for (DrivenMode& mode : all) {
    std::string reason = doubt(d, mode, settings);
    if (reason.empty())
      result.modes.push_back(std::move(mode));
    else
      result.set_aside.push_back({std::move(mode), std::move(reason)});
  }
  return result;
}

}  // namespace voussoir
