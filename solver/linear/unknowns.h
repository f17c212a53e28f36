// Unknowns of the linear problems (equilibrium, critical time step, modes) and vectors over them.
//
// A site has up to six unknowns. A body has a displacement (m, world axes, of its centroid) and a rotation vector (rad,
// world axes); a node of the fill has a displacement. Prescribed components (of fixed bodies, and those held by a
// guide) are not unknowns.
#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/model/model.h"

namespace voussoir {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Unknowns {
  std::vector<std::array<std::int32_t, 6>> of;  // of each site, in the order of bodies; −1 if prescribed
  std::int32_t count = 0;
  std::size_t bodies = 0;  // sites that are bodies; the others are nodes of the fill
  /// Number of unknowns of a free site.
  std::size_t ways(std::size_t site) const { return site < bodies ? 6 : 3; }
  bool any(std::size_t site) const {
    for (std::int32_t unknown : of[site])
      if (unknown >= 0) return true;
    return false;
  }
};

/// The unknowns of all components that can move.
Unknowns number_unknowns(const Model& model);
/// The same without the sites for which `held` is set.
Unknowns without(const Unknowns& unknowns, const std::vector<bool>& held);

/// The six components of the site; zero for components that are not unknowns.
inline Vector6 part_of(const Eigen::VectorXd& x, const Unknowns& unknowns, std::size_t site) {
  Vector6 part = Vector6::Zero();
  for (int c = 0; c < 6; ++c)
    if (const std::int32_t at = unknowns.of[site][c]; at >= 0) part[c] = x[at];
  return part;
}
/// Ignores components that are not unknowns.
inline void set_part(Eigen::VectorXd& x, const Unknowns& unknowns, std::size_t site, const Vector6& part) {
  for (int c = 0; c < 6; ++c)
    if (const std::int32_t at = unknowns.of[site][c]; at >= 0) x[at] = part[c];
}

}  // namespace voussoir
