#include "solver/model/laws.h"

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
  return c;
}

}  // namespace voussoir
