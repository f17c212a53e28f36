#include "solver/model/laws.h"

#include <algorithm>

namespace voussoir {

LawConstants law_constants(const JointLaw& law) {
  LawConstants c;
  c.kind = law.kind;
  c.tension = law.tension;
  c.cohesion = law.cohesion;
  c.tan_friction = std::tan(law.friction_angle);
  c.residual_cohesion = law.residual_cohesion;
  c.residual_tan_friction = std::tan(law.residual_friction_angle);
  c.tan_dilation = std::tan(law.dilation_angle);
  c.mode_1 = law.fracture_energy[0];
  c.mode_2 = law.fracture_energy[1];
  c.prestress = law.prestress;
  if (law.kind == JointLaw::Kind::composite) {
    c.crushing = law.compressive_strength;
    c.mode_c = law.compressive_energy;
    c.crushing_peak = law.compressive_peak;
    c.cap_shear = law.cap_shear;
    c.dilation_length = law.dilation_length;
    c.dilation_pressure = law.dilation_pressure;
    c.plain_pressure = plain_pressure(c);
  }
  constexpr double none = 1e300;
  const bool elastic = law.kind == JointLaw::Kind::elastic;
  const double apex = c.tan_friction > 0.0 ? c.cohesion / c.tan_friction : none;
  c.most_tension = elastic ? none : std::min(c.tension, apex);
  c.most_cohesion = elastic ? none : c.cohesion;
  c.slope = elastic ? 0.0 : c.tan_friction;
  return c;
}

}  // namespace voussoir
