// One trial: makes measurements with the hidden effects of the trial, and diagnoses them.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/blind/trials.h"

namespace voussoir {

/// Runs a program without a shell, with its output in a file. Returns its exit status.
int execute(const std::vector<std::string>& words, const std::string& log);

/// The results of a trial.
struct TrialRun {
  std::vector<std::string> effects;  // the effects of the trial, with the names of channels
  nlohmann::json diagnosis;          // diagnosis.json; null if diagnose failed
  double trace = -1.0;               // trace of the hidden effects, see voussoir hide --trace; below 0: not known, for
                                     // recordings
  std::string log;                   // path of the log
};

/// Runs a trial in FOLDER. It writes the folders seen (case and measurements), sealed (the answer) and said (the
/// diagnosis), and log.txt. Throws RunError if hide fails.
TrialRun run_trial(const BlindTrial& trial, const std::string& program, const std::string& folder);

/// Runs diagnose on FOLDER/seen/case.toml with default settings and one thread. Null if it fails.
nlohmann::json diagnose(const BlindTrial& trial, const std::string& program, const std::string& model,
                        const std::string& measured, const std::string& said, const std::string& log);

/// Replaces channels that an effect names by their position in a sensor plan, given the text of sensors.csv: "{any U}"
/// is the channel at the share U of the list, "{flat U}" and "{upright U}" are horizontal and vertical channels,
/// "{pair U}" two channels of one place. Throws RunError if the plan has no such channel.
std::string with_channels(const std::string& effect, const std::string& sensors);

}  // namespace voussoir
