// One trial: the program hides what the trial says and diagnoses what it measured.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/blind/trials.h"

namespace voussoir {

/// Runs a program without a shell, its output in a file; its exit status.
int execute(const std::vector<std::string>& words, const std::string& log);

/// What came of a trial's run.
struct TrialRun {
  std::vector<std::string> effects;  // the trial's, with the names of channels
  nlohmann::json diagnosis;          // diagnosis.json; null where diagnose failed
  double trace = -1.0;               // of what is hidden: see voussoir hide --trace; below 0: not known of recordings
  std::string log;                   // file
};

/// In FOLDER: seen (case and measurements), sealed (the answer), said, log.txt. Throws RunError where hide fails.
TrialRun run_trial(const BlindTrial& trial, const std::string& program, const std::string& folder);

/// diagnose of FOLDER/seen/case.toml with default settings and one thread; null where it fails.
nlohmann::json diagnose(const BlindTrial& trial, const std::string& program, const std::string& model,
                        const std::string& measured, const std::string& said, const std::string& log);

/// Channels that an effect names by where they stand in a plan of sensors, of the text of its sensors.csv: "{any U}" is
/// the channel at the share U of the list, "{flat U}" and "{upright U}" of its horizontal and vertical channels, "{pair
/// U}" two channels of one place. Throws RunError where the plan has none.
std::string with_channels(const std::string& effect, const std::string& sensors);

}  // namespace voussoir
