#include "solver/fill/mohr_coulomb.h"

#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

FillLaw fill_law(const Material& m) {
  const double bulk = m.youngs_modulus * m.shear_modulus / (3.0 * (3.0 * m.shear_modulus - m.youngs_modulus));
  if (!(m.density > 0.0) || !(m.youngs_modulus > 0.0) || !(m.shear_modulus > 0.0))
    throw InputError(
        "the material '{}' of the fill has density {} kg/m3, youngs_modulus {} Pa and shear_modulus {} Pa. All must be "
        "above 0.",
        m.name, m.density, m.youngs_modulus, m.shear_modulus);
  if (!(m.youngs_modulus < 3.0 * m.shear_modulus) || m.youngs_modulus < 2.0 * m.shear_modulus * (1.0 - 1e-9))
    throw InputError(
        "the material '{}' of the fill has youngs_modulus {:g} Pa and shear_modulus {:g} Pa, which gives a Poisson's "
        "ratio of {:.3f}. Choose a shear_modulus between a third and a half of youngs_modulus (ratio 0 to 0.5).",
        m.name, m.youngs_modulus, m.shear_modulus, 0.5 * m.youngs_modulus / m.shear_modulus - 1.0);
  if (m.dilation_angle > m.friction_angle + 1e-12)
    throw InputError(
        "the material '{}' of the fill has a dilation_angle of {:.2f} degrees, above its friction_angle of {:.2f} "
        "degrees. Lower the dilation_angle.",
        m.name, m.dilation_angle * 180.0 / pi, m.friction_angle * 180.0 / pi);
  FillLaw law;
  law.density = m.density;
  law.bulk = bulk;
  law.shear = m.shear_modulus;
  const double sine = std::sin(m.friction_angle), cosine = std::cos(m.friction_angle),
               flow = std::sin(m.dilation_angle);
  law.major = 1.0 + sine, law.minor = 1.0 - sine;
  law.flow_major = 1.0 + flow, law.flow_minor = 1.0 - flow;
  law.strength = 2.0 * m.cohesion * cosine;
  law.cone = 1.0 + sine * sine / 3.0;
  // Without friction there is no apex: the cut-off is where the case puts it.
  law.tension = sine > 1e-9 ? std::min(m.tensile_strength, m.cohesion * cosine / sine) : m.tensile_strength;
  return law;
}

}  // namespace voussoir
