// Damping branches as the kernels use them.
#pragma once

namespace voussoir {

/// Maxwell branches (or the one Rayleigh stiffness branch) as the kernels use them: viscous jump q ← e q + g Δu with Δu
/// the change of the elastic jump over the step; traction stiffness × q (docs/theory/damping.md). q is kept in single
/// precision: it is a correction of some per cent, it decays, and it is most of what a damped step reads and writes.
constexpr int most_branches = 4;
struct Branches {
  int count = 0;
  double e[most_branches] = {}, g[most_branches] = {};

  double stored[most_branches] = {};  // held by the branch's spring per stiffness: ½ stored q²
};

}  // namespace voussoir
