// Damping: Maxwell branches parallel to every elastic stiffness, Rayleigh damping, local damping.
#pragma once
#include <string>
#include <vector>

#include "solver/model/settings.h"
#include "solver/model/state.h"

namespace voussoir {

/// Branches of relative stiffness α and relaxation frequency f parallel to a unit spring.
struct MaxwellFit {
  std::vector<double> stiffness;       // α_j, of the elastic stiffness
  std::vector<double> frequency;       // f_j, Hz
  double lowest = 0.0, highest = 0.0;  // damping ratio over the band: the ripple
};

/// Damping ratio ½ Im/Re of 1 + Σ α_j (iω/ω_j)/(1 + iω/ω_j) at `frequency` (Hz).
double maxwell_ratio(const MaxwellFit& fit, double frequency);
/// Stiffness factor |Re| at `frequency`: undamped frequencies rise by its square root.
double maxwell_stiffening(const MaxwellFit& fit, double frequency);
/// Least squares of the ratio over the band, frequencies spaced evenly in their logarithm (Gauss–Newton with step
/// control).
MaxwellFit fit_maxwell(double ratio, std::array<double, 2> band, int branches);

/// Rayleigh's terms: ξ = mass/(2ω) + stiffness ω/2, equal to the ratio at both ends of the band (Clough & Penzien 1993,
/// eq. 12-38).
struct RayleighTerms {
  double mass = 0.0;       // 1/s
  double stiffness = 0.0;  // s
};
RayleighTerms rayleigh_terms(const DampingSettings& settings);

/// Damping ratios below this value count as no damping.
constexpr double least_damping_ratio = 1e-9;

/// Damping constants for the time step.
struct DampingAtWork {
  Branches branches;
  double mass_rate = 0.0;    // 1/s: Rayleigh's mass term
  double local = 0.0;        // Cundall's coefficient
  double step_factor = 1.0;  // factor on the critical time step
  std::string account;       // one line for the log
};

/// `step` in s; `highest` is the largest undamped circular frequency (rad/s), for the stability of the Rayleigh term.
DampingAtWork damping_at_work(const DampingSettings& settings, double step, double highest);
/// Only the factor on the critical time step, before a time step is chosen.
double damping_step_factor(const DampingSettings& settings, double highest);

}  // namespace voussoir
