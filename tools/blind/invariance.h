// Whether verdicts change when the same measurements are written otherwise.
#pragma once
#include "tools/blind/run_trial.h"

namespace voussoir {

/// How measurements are written otherwise; what they say is the same.
enum class Copy { rounded, scaled, reordered, other_unit };
const std::vector<std::string>& copy_names();

/// A copy of a folder of measurements as voussoir hide writes it. rounded: numbers of modes, shapes and recordings to
/// four digits; scaled: shapes with their deviations, or recordings, times 1000; reordered: sensors, shapes, channels
/// and modes back to front; other_unit: frequencies instead of periods, recordings in g.
void write_copy(const std::string& measured, Copy copy, const std::string& folder);

/// What is said of each copy of one trial, which has been run.
struct Invariance {
  std::size_t number = 0;           // of the trial, from 1
  std::string said;                 // verdict, names and places, without probabilities
  std::vector<std::string> copies;  // the same by copy
  double change = 0.0;              // largest of a value, in its standard deviations
};
Invariance compare_copies(const BlindTrial& trial, std::size_t number, const nlohmann::json& diagnosis,
                          const std::string& program, const std::string& folder);
/// Markdown: a row a trial, with what differs.
std::string invariance_table(const std::vector<Invariance>& all);

}  // namespace voussoir
