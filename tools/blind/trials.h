// The blind suites: cases with hidden effects in their measurements, and the expected diagnosis of each.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace voussoir {

struct BlindTrial {
  std::string bridge, sensors;       // "cs1"; a plan as for hide
  double noise = 0.01;               // relative standard deviation of periods; that of shapes is twice as large
  std::vector<std::string> effects;  // as for hide; channels also as in with_channels()
  std::string without;               // effects excluded from the diagnosis, which should then end unexplained
  std::string where;                 // for an effect outside the library: text that the place should contain
  double minutes = 0.0;              // min, recorded ambient vibration that replaces modes
  double shaken = 0.0;               // s, recorded earthquake that replaces modes, with the ground motion
  std::uint64_t seed = 0;            // seed of hide
  // Other deviations of the true bridge, as for hide.
  double mesh = 0.85, defects = 0.01, scatter = 0.05, noise_said = 1.0;
  std::vector<std::string> truth = {};
  int parapet_gaps = 0;
  std::vector<std::string> loosened = {};  // hidden changes that no effect describes
  std::string fill = "rigid";              // backfill of the case
};

enum class TrialKind { nothing, one, two, outside, fault };
/// The kind of trial: nothing hidden, one effect, two effects (one may be a sensor fault), an effect unknown to
/// diagnose, or a sensor fault.
TrialKind kind_of(const BlindTrial& trial);
/// "abutment_restraint both stiffness_share=0.5 + …, 10 min recorded".
std::string hidden_text(const BlindTrial& trial, const std::vector<std::string>& effects);
/// Other deviations of the true bridge, in words: "mesh 1.20, deformable fill, …".
std::string truth_text(const BlindTrial& trial);

struct Suite {
  std::string name;
  std::vector<BlindTrial> trials;
  double confident = 0.9;  // a probability above this counts as confident
  // The aims, in per cent.
  double right = 90.0, false_alarms = 5.0, wrong = 5.0, values_low = 90.0, values_high = 100.0, faults = 95.0;
};
/// The suite with this name. "first" is defined by hand; "second" and "third" are drawn by one rule (drawn_suite.cpp)
/// from two seeds. Throws InputError.
Suite find_suite(const std::string& name);

std::vector<BlindTrial> first_suite();
std::vector<BlindTrial> drawn_suite(std::uint64_t seed);

/// The case for diagnose, as TOML.
std::string case_of(const BlindTrial& trial);

}  // namespace voussoir
