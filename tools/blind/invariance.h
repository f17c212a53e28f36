// Checks that verdicts do not change when the same measurements are written differently.
#pragma once
#include "tools/blind/run_trial.h"

namespace voussoir {

/// Ways of writing the same measurements.
enum class Copy { rounded, scaled, reordered, other_unit };
const std::vector<std::string>& copy_names();

/// Writes a copy of a folder of measurements of voussoir hide. rounded: numbers of modes, shapes and recordings to
/// four digits; scaled: shapes with their standard deviations, or recordings, times 1000; reordered: sensors, shapes,
/// channels and modes in reverse order; other_unit: frequencies instead of periods, recordings in g.
void write_copy(const std::string& measured, Copy copy, const std::string& folder);

/// The results for the copies of one trial, which has been run before.
struct Invariance {
  std::size_t number = 0;           // number of the trial, from 1
  std::string said;                 // verdict, names and places of the original, without probabilities
  std::vector<std::string> copies;  // the same for each copy
  double change = 0.0;              // largest change of a value, in its standard deviations
};
Invariance compare_copies(const BlindTrial& trial, std::size_t number, const nlohmann::json& diagnosis,
                          const std::string& program, const std::string& folder);
/// A Markdown table with one row for each trial and its differences.
std::string invariance_table(const std::vector<Invariance>& all);

}  // namespace voussoir
