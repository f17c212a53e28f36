// The ranges are wide on purpose: a remark should mean a wrong unit and not an uncommon stone. Densities, moduli and
// strengths are those of stone, brick, mortar and fill as Hendry, Sinha & Davies (2004), Design of Masonry Structures,
// and Heyman (1995), The Stone Skeleton, give them, with room for tuff, loose sand and iron.
#include "io/case/usual.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <map>

#include "solver/base/constants.h"

namespace voussoir {

namespace {
constexpr double degree = 180.0 / pi;

const std::map<std::string, Usual>& quantities() {
  static const std::vector<Slip> stress = {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}};
  static const std::vector<Slip> strength = {{1e6, "MPa"}, {1e3, "kPa"}};
  static const std::vector<Slip> acceleration = {{0.01, "cm/s2"}, {standard_gravity, "g"}};
  static const std::map<std::string, Usual> all = {
      // From pumice to iron; unit weights of masonry are 10 to 30 kN/m3.
      {"density",
       {"for stone, brick and fill",
        "kg/m3",
        500.0,
        8000.0,
        800.0,
        3500.0,
        {{1000.0 / standard_gravity, "kN/m3"}, {1000.0, "t/m3"}, {1.0 / standard_gravity, "N/m3"}}}},
      // From loose sand to steel; those who slip have stone or brick.
      {"modulus", {"for stone, brick and fill", "Pa", 5e6, 2.5e11, 1e8, 1.2e11, stress}},
      {"shear modulus", {"for stone, brick and fill", "Pa", 2e6, 1e11, 4e7, 5e10, stress}},
      // From the weakest mortar to sound granite.
      {"strength", {"for mortar, brick and stone (or 0)", "Pa", 100.0, 5e7, 1e3, 3e7, strength}},
      // From lime mortar to granite; crushing energies of masonry are some thousand J/m2.
      {"compressive strength", {"for mortar, brick and stone", "Pa", 1e5, 4e8, 1e6, 2e8, strength}},
      {"crushing energy", {"for mortar, brick and stone", "J/m2", 100.0, 1e6, 1e3, 1e5, {{1e3, "N/mm"}}}},
      {"friction", {"for dry joints and fill (or 0)", "degrees", 3.0, 89.0, 3.0, 60.0, {{degree, "radians"}}}},
      {"dilation", {"for joints (or 0)", "degrees", 0.5, 45.0, 0.5, 45.0, {{degree, "radians"}}}},
      // Modulus over thickness of a joint or spacing of joints: 5 MPa over 1 m to 60 GPa over a millimetre.
      {"stiffness", {"for joints", "Pa/m", 1e6, 1e14, 1e7, 1e14, {{1e9, "N/mm3"}, {1e6, "MPa/m"}}}},
      {"fracture energy", {"for mortar and brick (or 0)", "J/m2", 1.0, 1e4, 1.0, 1e3, {{1e3, "N/mm"}}}},
      // Of a part: a chip of stone to a viaduct's pier; of the whole: a model on a table to the longest viaduct.
      {"length", {"for bridges and their stones (or 0)", "m", 1e-3, 250.0, 1e-2, 100.0, {{1e-3, "mm"}, {1e3, "km"}}}},
      {"extent", {"for a structure's largest side", "m", 0.05, 2000.0, 0.3, 1000.0, {{1e-3, "mm"}, {1e3, "km"}}}},
      {"gravity",
       {"on Earth", "m/s2", 3.0, 12.0, 9.5, 10.5, {{0.01, "cm/s2"}, {standard_gravity, "g"}, {1e-3, "mm/s2"}}}},
      {"damping", {"for structures", "of critical", 0.0, 0.25, 0.001, 0.25, {{0.01, "per cent"}}}},
      // A tower of 100 m has 3 s, a rubble wall of a metre 0.01 s.
      {"period", {"for masonry", "s", 5e-3, 5.0, 0.02, 3.0, {{1.0, "Hz", true}, {1e-3, "ms"}}}},
      // The strongest ground motions on record have about 3 g; below a fiftieth of g nothing moves.
      {"peak", {"for strong ground motion", "m/s2", 0.2, 35.0, 0.2, 35.0, acceleration}},
      {"ag", {"for codes", "g", 0.005, 1.5, 0.005, 1.5, {{1.0 / standard_gravity, "m/s2"}, {0.01, "per cent"}}}},
      {"pulse frequency", {"for ground motion", "Hz", 0.05, 60.0, 0.1, 20.0, {{1.0 / (2.0 * pi), "rad/s"}}}},
      {"duration", {"for a stage", "s", 1e-3, 600.0, 0.1, 300.0, {{1e-3, "ms"}}}},
      {"sampling", {"for records", "s", 2e-4, 0.1, 5e-4, 0.05, {{1e-3, "ms"}, {1.0, "samples per second", true}}}},
      {"force",
       {"on a group of stones (or 0)", "N", 200.0, 1e9, 200.0, 1e8, {{1e3, "kN"}, {1e3 * standard_gravity, "t"}}}}};
  return all;
}

/// SECTION.KEY and the name of its quantity.
const std::map<std::string, std::string>& keys() {
  static const std::map<std::string, std::string> all = {{"materials.density", "density"},
                                                         {"materials.youngs_modulus", "modulus"},
                                                         {"materials.shear_modulus", "shear modulus"},
                                                         {"materials.tensile_strength", "strength"},
                                                         {"materials.cohesion", "strength"},
                                                         {"materials.friction_angle", "friction"},
                                                         {"materials.dilation_angle", "dilation"},
                                                         {"joints.kn", "stiffness"},
                                                         {"joints.ks", "stiffness"},
                                                         {"joints.tensile_strength", "strength"},
                                                         {"joints.cohesion", "strength"},
                                                         {"joints.residual_cohesion", "strength"},
                                                         {"joints.friction_angle", "friction"},
                                                         {"joints.residual_friction_angle", "friction"},
                                                         {"joints.dilation_angle", "dilation"},
                                                         {"joints.fracture_energy", "fracture energy"},
                                                         {"joints.compressive_strength", "compressive strength"},
                                                         {"joints.compressive_energy", "crushing energy"},
                                                         {"analysis.gravity", "gravity"},
                                                         {"damping.ratio", "damping"},
                                                         {"modal.expected.period", "period"},
                                                         {"stage.duration", "duration"},
                                                         {"stage.dt", "sampling"},
                                                         {"stage.pulse.amplitude", "peak"},
                                                         {"stage.pulse.frequency", "pulse frequency"},
                                                         {"stage.synthetic.peak", "peak"},
                                                         {"stage.synthetic.ag", "ag"},
                                                         {"stage.load.force", "force"}};
  return all;
}

}  // namespace

const Usual& usual(const std::string& name) {
  const auto found = quantities().find(name);
  assert(found != quantities().end());
  return found->second;
}

const Usual* usual_of_key(const std::string& section, const std::string& key) {
  const auto found = keys().find(section + "." + key);
  return found == keys().end() ? nullptr : &usual(found->second);
}

const Usual* usual_of_parameter(const std::string& name, const std::string& unit) {
  if (unit == "m") return &usual("length");
  if (unit == "Pa/m") return &usual("stiffness");
  if (unit == "deg" && name.ends_with("friction")) return &usual("friction");
  return nullptr;
}

std::string unusual(const Usual& usual, double value) {
  const double size = std::abs(value);
  if (size == 0.0 || (size >= usual.low && size <= usual.high)) return {};
  std::string text = fmt::format("usual {} is {:.4g} to {:.4g} {}", usual.what, usual.low, usual.high, usual.unit);
  for (const Slip& slip : usual.slips)
    if (const double mended = slip.mended(size); mended >= usual.meant_low && mended <= usual.meant_high)
      return text + fmt::format("; if it was meant in {}, write {:.4g}", slip.unit, std::copysign(mended, value));
  return text;
}

}  // namespace voussoir
