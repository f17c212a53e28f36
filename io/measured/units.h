// Units of channels. Private to io/measured.
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace voussoir {

/// Conversion of a channel into m/s2: a factor and the number of derivatives (1 for velocities, 2 for displacements).
struct ChannelUnit {
  std::string name;
  double factor = 1.0;
  int derivatives = 0;
};

/// m/s2, cm/s2, gal, mm/s2, um/s2, g, mg, ug; m/s, cm/s, mm/s, um/s; m, cm, mm, um.
const std::vector<ChannelUnit>& channel_units();
/// The unit of that name, also "m/s²", "m/s^2" and "µm"; null if there is none.
const ChannelUnit* find_unit(const std::string& name);

/// Number of samples at each end for which differentiated() has no derivative.
inline constexpr Eigen::Index derivative_reach = 24;
/// dx/dt of a signal with time step dt, shorter by derivative_reach samples at each end. Within 1e-3 of the slope up to
/// 0.8 of half the sampling frequency: the ideal differentiator under a Kaiser window (Oppenheim & Schafer 2010,
/// section 7.5).
Eigen::VectorXd differentiated(const Eigen::VectorXd& x, double dt);

}  // namespace voussoir
