// Which bodies set the time step, and what could be gained by scaling them.
#pragma once
#include "solver/step/mass_scaling.h"

namespace voussoir {

struct StiffBody {
  std::int32_t body = 0;
  std::int64_t patch = -1;  // its stiffest
  double step = 0.0;        // s, the bound from its own patches: the critical step is no shorter than the least of all
  double without = 0.0;     // s, the assembly's critical step with this body held
};

/// The k stiffest bodies brought down to the own rate of the next.
struct StiffestRaised {
  std::int64_t count = 0;
  double share = 0.0;  // of the mass, added
  double step = 0.0;   // s, critical
};

struct StepReport {
  CriticalStep critical;
  std::vector<double> local;            // s, each moving body's own bound, ascending
  std::vector<StiffBody> stiffest;      // ascending
  std::vector<StiffestRaised> raised;   // ascending
  double at_share(double share) const;  // s, of `local`: that share of bodies asks for a shorter step
};

/// Lists `bodies` of them. A power iteration for each and for each row of the table.
StepReport report_step(const Model& model, const State& state, int bodies);

/// The patch of a body with the largest kn A or ks A; −1: none.
std::int64_t stiffest_patch(const Model& model, std::int32_t body);
/// Smallest extent of a body along the normals of its faces, m.
double least_thickness(const Model& model, std::int32_t body);
/// "block 12 (arch, part 0), 94 kg, 0.355 m thick; stiffest joint kn A = 1.4e+09 N/m with block 7 (arch, part 0)".
std::string describe_stiff_body(const Assembly& assembly, const Model& model, std::int32_t body);

}  // namespace voussoir
