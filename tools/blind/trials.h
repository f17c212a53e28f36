// The blind suites: cases with something hidden in their measurements, and what a diagnosis should say of each.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace voussoir {

struct BlindTrial {
  std::string bridge, sensors;       // "cs1"; as hide takes them
  double noise = 0.01;               // of periods; shapes twice that
  std::vector<std::string> effects;  // as hide takes them, channels also as with_channels() has them
  std::string without;               // effects that diagnose may not try: it should end unexplained
  std::string where;                 // out of the library: what the place it gives should contain
  double minutes = 0.0;              // of ambient vibration that is recorded instead of modes
  double shaken = 0.0;               // s of an earthquake, recorded on the ground too
  std::uint64_t seed = 0;            // hide's
  // What the true bridge has otherwise, beside what is hidden; as hide takes it.
  double mesh = 0.85, defects = 0.01, scatter = 0.05, noise_said = 1.0;
  std::vector<std::string> truth = {};
  int parapet_gaps = 0;
  std::vector<std::string> loosened = {};  // what is hidden and no effect makes
  std::string fill = "rigid";              // backfill of the case
};

enum class TrialKind { nothing, one, two, outside, fault };
/// What is hidden: nothing, an effect, two (one may be a fault of a sensor), what diagnose does not know, or a fault.
TrialKind kind_of(const BlindTrial& trial);
/// "abutment_restraint both stiffness_share=0.5 + …, 10 min recorded".
std::string hidden_text(const BlindTrial& trial, const std::vector<std::string>& effects);
/// What the true bridge has otherwise, in words: "mesh 1.20, deformable fill, …".
std::string truth_text(const BlindTrial& trial);

struct Suite {
  std::string name;
  std::vector<BlindTrial> trials;
  double confident = 0.9;  // a probability above this is
  // What is aimed at, in per cent.
  double right = 90.0, false_alarms = 5.0, wrong = 5.0, values_low = 90.0, values_high = 100.0, faults = 95.0;
};
/// "first": made by hand. "second" and "third": drawn by one rule (drawn_suite.cpp) from two seeds. Throws InputError.
Suite find_suite(const std::string& name);

std::vector<BlindTrial> first_suite();
std::vector<BlindTrial> drawn_suite(std::uint64_t seed);

/// The case that diagnose is given: TOML.
std::string case_of(const BlindTrial& trial);

}  // namespace voussoir
