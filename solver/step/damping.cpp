#include "solver/step/damping.h"

#include <complex>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

std::complex<double> complex_stiffness(const MaxwellFit& fit, double frequency) {
  std::complex<double> k = 1.0;
  for (std::size_t j = 0; j < fit.stiffness.size(); ++j) {
    const std::complex<double> x(0.0, frequency / fit.frequency[j]);
    k += fit.stiffness[j] * x / (1.0 + x);
  }
  return k;
}

constexpr int fit_points = 400;

double fit_frequency(std::array<double, 2> band, int i) {
  return band[0] * std::pow(band[1] / band[0], (i + 0.5) / fit_points);
}

MaxwellFit from_logs(const Eigen::VectorXd& x) {
  MaxwellFit fit;
  for (Eigen::Index j = 0; j < x.size() / 2; ++j) {
    fit.stiffness.push_back(std::exp(x[2 * j]));
    fit.frequency.push_back(std::exp(x[2 * j + 1]));
  }
  return fit;
}

Eigen::VectorXd residual(const Eigen::VectorXd& x, double ratio, std::array<double, 2> band) {
  const MaxwellFit fit = from_logs(x);
  Eigen::VectorXd r(fit_points);
  for (int i = 0; i < fit_points; ++i) r[i] = maxwell_ratio(fit, fit_frequency(band, i)) / ratio - 1.0;
  return r;
}

Eigen::VectorXd first_guess(double ratio, std::array<double, 2> band, int branches) {
  Eigen::VectorXd x(2 * branches);
  const double decades = std::log10(band[1] / band[0]);
  for (int j = 0; j < branches; ++j) {
    x[2 * j] = std::log(2.0 * ratio * std::max(0.6, decades) * 1.6 / branches);
    const double share = branches == 1 ? 0.5 : double(j) / (branches - 1);
    x[2 * j + 1] = std::log(band[0]) + share * std::log(band[1] / band[0]);
  }
  return x;
}

}  // namespace

double maxwell_ratio(const MaxwellFit& fit, double frequency) {
  const std::complex<double> k = complex_stiffness(fit, frequency);
  return 0.5 * k.imag() / k.real();
}

double maxwell_stiffening(const MaxwellFit& fit, double frequency) {
  return complex_stiffness(fit, frequency).real();
}

MaxwellFit fit_maxwell(double ratio, std::array<double, 2> band, int branches) {
  Eigen::VectorXd x = first_guess(ratio, band, branches), r = residual(x, ratio, band);
  double damping = 1e-3;
  for (int iteration = 0; iteration < 300 && damping < 1e9; ++iteration) {
    Eigen::MatrixXd jacobian(fit_points, x.size());
    for (Eigen::Index c = 0; c < x.size(); ++c) {
      Eigen::VectorXd y = x;
      y[c] += 1e-6;
      jacobian.col(c) = (residual(y, ratio, band) - r) / 1e-6;
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd step = normal.ldlt().solve(-jacobian.transpose() * r);
    const Eigen::VectorXd r_new = residual(x + step, ratio, band);
    if (r_new.squaredNorm() < r.squaredNorm()) {
      x += step;
      r = r_new;
      damping = std::max(1e-12, damping / 5.0);
      if (step.norm() < 1e-10) break;
    } else {
      damping *= 4.0;
    }
  }
  MaxwellFit fit = from_logs(x);
  fit.lowest = 1e300;
  for (int i = 0; i <= 1000; ++i) {
    const double z = maxwell_ratio(fit, band[0] * std::pow(band[1] / band[0], i / 1000.0));
    fit.lowest = std::min(fit.lowest, z);
    fit.highest = std::max(fit.highest, z);
  }
  return fit;
}

namespace {

DampingAtWork maxwell_at_work(const DampingSettings& settings, double step) {
  DampingAtWork work;
  const MaxwellFit fit = fit_maxwell(settings.ratio, settings.band, settings.branches);
  Branches& b = work.branches;
  b.count = settings.branches;
  double total = 0.0;
  work.account = fmt::format("Maxwell damping, {}:", counted(b.count, "branch", "branches"));
  for (int j = 0; j < b.count; ++j) {
    const double omega = two_pi * fit.frequency[j];
    b.e[j] = std::exp(-omega * step);
    b.g[j] = fit.stiffness[j] * (step > 0.0 ? -std::expm1(-omega * step) / (omega * step) : 1.0);

    b.stored[j] = 1.0 / fit.stiffness[j];
    total += fit.stiffness[j];
    work.account += fmt::format(" {:.4f} at {:.3f} Hz,", fit.stiffness[j], fit.frequency[j]);
  }
  work.step_factor = 1.0 / std::sqrt(1.0 + total);
  work.account +=
      fmt::format(" damping ratio {:.3f}–{:.3f} % from {} to {} Hz; stiffness × {:.3f} at {} Hz, × {:.3f} at {} Hz",
                  100 * fit.lowest, 100 * fit.highest, settings.band[0], settings.band[1],
                  maxwell_stiffening(fit, settings.band[0]), settings.band[0],
                  maxwell_stiffening(fit, settings.band[1]), settings.band[1]);
  return work;
}

DampingAtWork rayleigh_at_work(const DampingSettings& settings, double step, double highest) {
  DampingAtWork work;
  const auto [alpha, beta] = rayleigh_terms(settings);
  work.mass_rate = alpha;
  Branches& b = work.branches;
  b.count = 1;
  b.e[0] = 0.0;
  b.g[0] = step > 0.0 ? beta / step : 0.0;

  // Central differences with a lagged damping force: stable below 2/ω (√(1 + ξ²) − ξ) (Belytschko 1983).
  const double xi = 0.5 * beta * highest;
  work.step_factor = std::sqrt(1.0 + xi * xi) - xi;
  work.account =
      fmt::format("Rayleigh damping: mass term {:.4f} 1/s, stiffness term {:.3e} s; {:.2f} % at {} and {} Hz",
                  work.mass_rate, beta, 100 * settings.ratio, settings.band[0], settings.band[1]);
  return work;
}

}  // namespace

RayleighTerms rayleigh_terms(const DampingSettings& settings) {
  const double w1 = two_pi * settings.band[0], w2 = two_pi * settings.band[1];
  return {2.0 * settings.ratio * w1 * w2 / (w1 + w2), 2.0 * settings.ratio / (w1 + w2)};
}

DampingAtWork damping_at_work(const DampingSettings& settings, double step, double highest) {
  const bool by_ratio =
      settings.kind == DampingSettings::Kind::maxwell || settings.kind == DampingSettings::Kind::rayleigh;
  if (by_ratio && settings.ratio < least_damping_ratio) {  // branches without stiffness would store q² / 0
    DampingAtWork work;
    work.account = "no damping (the damping ratio is zero)";
    return work;
  }
  switch (settings.kind) {
    case DampingSettings::Kind::maxwell:
      return maxwell_at_work(settings, step);
    case DampingSettings::Kind::rayleigh:
      return rayleigh_at_work(settings, step, highest);
    case DampingSettings::Kind::local: {
      DampingAtWork work;
      work.local = settings.coefficient;
      // A force that slows a body down is raised by the coefficient: the assembly is that much stiffer half of the
      // time.
      work.step_factor = 1.0 / std::sqrt(1.0 + work.local);
      work.account = fmt::format("local damping, {:.2f} of the out-of-balance force", work.local);
      return work;
    }
    default: {
      DampingAtWork work;
      work.account = "no damping";
      return work;
    }
  }
}

double damping_step_factor(const DampingSettings& settings, double highest) {
  return damping_at_work(settings, 0.0, highest).step_factor;
}

}  // namespace voussoir
