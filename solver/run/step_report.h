// Bodies and nodes that limit the time step, and the gain if their mass is scaled.
#pragma once
#include "solver/step/mass_scaling.h"

namespace voussoir {

/// A body or node of the fill that needs a short time step.
struct StiffSite {
  std::int32_t body = -1;   // or −1
  std::int32_t node = -1;   // of the fill's mesh, or −1
  std::int64_t patch = -1;  // stiffest patch of the body
  double step = 0.0;     // s, bound from the stiffness around the site; the critical time step is at least the smallest
                         // of these bounds
  double without = 0.0;  // s, critical time step of the assembly with this site held
};

/// Result of mass scaling that lowers the rates of the k stiffest sites to the rate of the next one.
struct StiffestRaised {
  std::int64_t count = 0;
  double share = 0.0;  // added share of the mass
  double step = 0.0;   // s, critical time step
};

struct StepReport {
  CriticalStep critical;
  std::vector<double> local;            // s, bound of each moving site, ascending
  std::vector<StiffSite> stiffest;      // ascending
  std::vector<StiffestRaised> raised;   // ascending
  double at_share(double share) const;  // s, quantile of `local`: this share of the sites needs a shorter time step
};

/// Lists the `count` stiffest sites. Computes a critical time step for each of them and for each row of `raised`.
StepReport report_step(const Model& model, const State& state, int count);

/// The joint of a body with the largest kn A or ks A, as index in Model::joints, or −1.
std::int64_t stiffest_patch(const Model& model, std::int32_t body);
/// Smallest extent of a body along the normals of its faces, m.
double least_thickness(const Model& model, std::int32_t body);
/// "block 12 (arch, part 0), 94 kg, 0.355 m thick; stiffest joint kn A = 1.4e+09 N/m with block 7 (arch, part 0)".
std::string describe_stiff_body(const Assembly& assembly, const Model& model, std::int32_t body);
/// "node 12 of the fill at (1.00, 0.50, 3.25) m".
std::string node_name(const Assembly& assembly, std::int32_t node);
/// The body or node that moves most in the highest mode: as "block 12 (arch)" or a node_name(), and with details.
std::string short_name(const Assembly& assembly, const Model& model, const CriticalStep& critical);
std::string describe_fastest(const Assembly& assembly, const Model& model, const CriticalStep& critical);
std::string describe_stiff_site(const Assembly& assembly, const Model& model, const StiffSite& site);

}  // namespace voussoir
