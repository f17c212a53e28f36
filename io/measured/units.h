// Units of channels. Private to io/measured.
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace voussoir {

/// What turns a channel into m/s2: a factor, and how often it is to be differentiated (velocities once, displacements
/// twice).
struct ChannelUnit {
  std::string name;
  double factor = 1.0;
  int derivatives = 0;
};

/// m/s2, cm/s2, gal, mm/s2, um/s2, g, mg, ug; m/s, cm/s, mm/s, um/s; m, cm, mm, um.
const std::vector<ChannelUnit>& channel_units();
/// Null when there is none of that name; "m/s²", "m/s^2" and "µm" are understood.
const ChannelUnit* find_unit(const std::string& name);

/// Samples at either end that differentiated() has no derivative for.
inline constexpr Eigen::Index derivative_reach = 24;
/// dx/dt of a signal with steps dt, shorter by derivative_reach at either end. Within 1e-3 of the slope up to 0.8 of
/// half the sampling frequency: the ideal differentiator under a Kaiser window (Oppenheim & Schafer 2010, section 7.5).
Eigen::VectorXd differentiated(const Eigen::VectorXd& x, double dt);

}  // namespace voussoir
