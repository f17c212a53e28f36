// Damping branches of the kernels.
#pragma once

namespace voussoir {

/// Maxwell branches (or the one Rayleigh stiffness branch) as the kernels use them: viscous jump q ← e q + g Δu with Δu
/// the change of the elastic jump over the time step; the traction is stiffness × q (docs/theory/damping.md). q is
/// stored in single precision because it is a correction of some per cent, it decays, and it is most of the data that a
/// damped time step reads and writes.
constexpr int most_branches = 4;
struct Branches {
  int count = 0;
  double e[most_branches] = {}, g[most_branches] = {};

  double stored[most_branches] = {};  // factor of the energy in the spring of the branch: ½ stored q² per stiffness
};

}  // namespace voussoir
