// Which bodies and nodes set the time step, and what could be gained by scaling them.
#pragma once
#include "solver/step/mass_scaling.h"

namespace voussoir {

/// A body or a node of the fill that asks for a short step.
struct StiffSite {
  std::int32_t body = -1;   // or −1
  std::int32_t node = -1;   // of the fill's mesh, or −1
  std::int64_t patch = -1;  // the body's stiffest
  double step = 0.0;     // s, the bound from what is around it: the critical step is no shorter than the least of all
  double without = 0.0;  // s, the assembly's critical step with this site held
};

/// The k stiffest sites brought down to the own rate of the next.
struct StiffestRaised {
  std::int64_t count = 0;
  double share = 0.0;  // of the mass, added
  double step = 0.0;   // s, critical
};

struct StepReport {
  CriticalStep critical;
  std::vector<double> local;            // s, each moving site's own bound, ascending
  std::vector<StiffSite> stiffest;      // ascending
  std::vector<StiffestRaised> raised;   // ascending
  double at_share(double share) const;  // s, of `local`: that share of sites asks for a shorter step
};

/// Lists `count` of them. Looks for a critical step for each and for each row of the table.
StepReport report_step(const Model& model, const State& state, int count);

/// The patch of a body with the largest kn A or ks A; −1: none.
std::int64_t stiffest_patch(const Model& model, std::int32_t body);
/// Smallest extent of a body along the normals of its faces, m.
double least_thickness(const Model& model, std::int32_t body);
/// "block 12 (arch, part 0), 94 kg, 0.355 m thick; stiffest joint kn A = 1.4e+09 N/m with block 7 (arch, part 0)".
std::string describe_stiff_body(const Assembly& assembly, const Model& model, std::int32_t body);
/// "node 12 of the fill at (1.00, 0.50, 3.25) m".
std::string node_name(const Assembly& assembly, std::int32_t node);
/// What moves most in the highest mode: "block 12 (arch)" or a node_name(); and the same at length.
std::string short_name(const Assembly& assembly, const Model& model, const CriticalStep& critical);
std::string describe_fastest(const Assembly& assembly, const Model& model, const CriticalStep& critical);
std::string describe_stiff_site(const Assembly& assembly, const Model& model, const StiffSite& site);

}  // namespace voussoir
