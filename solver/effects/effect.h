// What a model can lack. An effect is one small file here and one line in effects.cpp: a name, a sentence, parameters
// with units, bounds and a prior, the places where it can act, and how it changes an assembly. Cases add effects with
// [[effect]]; whatever is computed from the changed assembly (runs, modes) then has them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

struct EffectParameter {
  std::string name, unit, help;
  double low = 0.0, high = 1.0;  // allowed, both ends included
  double neutral = 0.0;          // where the model is what it is without the effect
  double usual = 0.5;            // prior: its middle, and a standard deviation, of the logarithm where `logarithmic`
  double spread = 0.5;
  bool logarithmic = false;
};

struct Effect {
  std::string name;     // "abutment_restraint"
  std::string help;     // one sentence
  std::string on_site;  // where a diagnosis names it: what to look at or to measure there, in one sentence or two
  std::vector<EffectParameter> parameters;
  /// Where it can act in this assembly, such as "left", "pier 0", "all"; empty: nowhere.
  std::vector<std::string> (*places)(const Assembly&) = nullptr;
  /// Changes a finished assembly (blocks, joints, stiffness, laws). `where` is one of places(), `values` are the
  /// parameters in their order and within their bounds.
  void (*apply)(Assembly&, const std::string& where, const std::vector<double>& values) = nullptr;
  /// What does not act on the assembly: once or twice gives the same. `where` as the case has it, perhaps empty and not
  /// yet compared with places().
  void (*apply_to_settings)(SolverSettings&, const std::string& where, const std::vector<double>& values) = nullptr;
  /// What is wrong with the sensors that a case attaches.
  void (*apply_to_sensors)(std::vector<Sensor>&, const std::string& where, const std::vector<double>& values) = nullptr;
  double weight = 1.0;  // prior: how often it is met, against the other effects; 0: no candidate
};

inline constexpr double sensor_housing = 0.5;  // m: channels closer than this can have been swapped

/// Where a sensor's axis points that is mounted otherwise: `tilt` (deg) raises it, `turn` (deg) then turns it about the
/// vertical. A vertical one has the heading x: lowered by 90° it is x, or, turned by 90° as well, y.
Vec3 mounted(const Vec3& axis, double turn, double tilt);

/// All of them, in the order of the documentation.
const std::vector<Effect>& effects();
/// Throws InputError naming the effect that was probably meant.
const Effect& find_effect(const std::string& name);

/// One [[effect]] of a case.
struct EffectSetting {
  std::string name, where;               // `where` may be empty where there is one place only
  std::map<std::string, double> values;  // all parameters
  std::string text() const;              // "abutment_restraint both stiffness_share=0.5"
};

/// Fills in the usual values of parameters that are not given. Throws InputError for an effect or a parameter that does
/// not exist or a value out of its bounds.
void complete(EffectSetting& setting);

/// Changes the assembly, which remembers that it has been (Assembly::effects); its joints are sorted again. Throws
/// InputError for a place where the effect cannot act, with the places where it can.
void apply_effect(Assembly& assembly, const EffectSetting& setting);
void apply_effect(SolverSettings& settings, const EffectSetting& setting);
/// Takes all effects back from a copy of an assembly that has some: it is then what the assembly is. Effects change
/// neither the cells of blocks that are there nor the mesh of a fill, and add blocks at the end; these are not copied.
void take_back_effects(Assembly& copy, const Assembly& assembly);
/// Throws InputError for a channel that is not there.
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
