// Effects: features that a model can lack. An effect is one small file here and one line in effects.cpp. It has a name,
// a description, parameters with units, bounds and a prior, the places where it can act, and a function that changes an
// assembly. Cases add effects with [[effect]]. All results from the changed assembly (runs, modes) then include them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

struct EffectParameter {
  std::string name, unit, help;
  double low = 0.0, high = 1.0;  // allowed range, both ends included
  double neutral = 0.0;          // value at which the effect changes nothing
  double usual = 0.5;            // prior: median and standard deviation; the latter of the logarithm if `logarithmic`
  double spread = 0.5;
  bool logarithmic = false;
};

struct Effect {
  std::string name;     // "abutment_restraint"
  std::string help;     // one clause without a full stop
  std::string on_site;  // inspections or measurements on site if a diagnosis finds it, in one or two sentences
  std::vector<EffectParameter> parameters;
  /// The places where it can act in this assembly, such as "left", "pier 0", "all"; empty if there are none.
  std::vector<std::string> (*places)(const Assembly&) = nullptr;
  /// Changes a finished assembly (blocks, joints, stiffness, laws). `where` is one of places(), `values` are the
  /// parameters in their order and within their bounds.
  void (*apply)(Assembly&, const std::string& where, const std::vector<double>& values) = nullptr;
  /// Changes settings instead of the assembly. A second call must change nothing. `where` is taken from the case: it
  /// may be empty and is not yet compared with places().
  void (*apply_to_settings)(SolverSettings&, const std::string& where, const std::vector<double>& values) = nullptr;
  /// Changes the sensors of a case.
  void (*apply_to_sensors)(std::vector<Sensor>&, const std::string& where, const std::vector<double>& values) = nullptr;
  double weight = 1.0;  // prior: relative frequency among the effects; 0: never a candidate
};

inline constexpr double sensor_housing = 0.5;  // m: channels closer than this can have been exchanged

/// The axis of a wrongly mounted sensor: `tilt` (deg) raises the axis, then `turn` (deg) rotates it about the vertical.
/// A vertical axis has the heading x: a tilt of −90° gives x, and an additional turn of 90° gives y.
Vec3 mounted(const Vec3& axis, double turn, double tilt);

/// All effects, in the order of the documentation.
const std::vector<Effect>& effects();
/// Throws InputError, with a suggestion, for an unknown effect.
const Effect& find_effect(const std::string& name);

/// One [[effect]] of a case.
struct EffectSetting {
  std::string name, where;               // `where` may be empty if there is only one place
  std::map<std::string, double> values;  // all parameters
  std::string text() const;              // "abutment_restraint both stiffness_share=0.5"
};

/// Sets parameters that are not given to their usual values. Throws InputError for an unknown effect or parameter, and
/// for a value outside its bounds.
void complete(EffectSetting& setting);

/// Changes the assembly, adds the effect to Assembly::effects and sorts the joints again. Throws InputError, which
/// lists the possible places, for a place where the effect cannot act.
void apply_effect(Assembly& assembly, const EffectSetting& setting);
void apply_effect(SolverSettings& settings, const EffectSetting& setting);
/// Removes all effects from `copy`, so that it is again equal to `assembly`. Effects do not change the cells of
/// existing blocks or the mesh of a fill, and they add blocks at the end. Cells and mesh are therefore not copied.
void take_back_effects(Assembly& copy, const Assembly& assembly);
/// Throws InputError for an unknown channel.
void apply_effect(std::vector<Sensor>& sensors, const EffectSetting& setting);

Effect abutment_restraint();
Effect foundation_flexibility();
Effect scour();
Effect added_mass();
Effect joint_softening();
Effect stiffer_masonry();
Effect fill_stiffness();
Effect fill_interface();
Effect spandrel_separation();
Effect ring_separation();
Effect tie_rods();
Effect parapet_not_structural();
Effect neighbouring_structure();
Effect amplitude_stiffness();
Effect damping_ratio();
Effect support_motion();
Effect sensor_fault();
Effect calibration();
Effect retrofit_ties();
Effect grouted_infill();
Effect bonded_joints();

}  // namespace voussoir
