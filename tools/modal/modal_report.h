// Tables and JSON of an eigenvalue analysis.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "io/case/case.h"
#include "io/hdf5/modes_file.h"

namespace voussoir {

/// One line a mode: frequency, period, effective mass and its running sum, participation, damping, motion.
std::string modes_table(const ModesFile& file);
/// What it took: unknowns, seconds, memory.
std::string effort_text(const ModesReport& report);
/// What was left out or held because nothing else holds it; empty where everything is held. Up to six blocks by name.
std::string loose_text(const Assembly& assembly, const Modes& modes);

/// Modes of another analysis beside ours, paired by the assurance criterion: for each of theirs the best of ours.
struct Pairing {
  Eigen::MatrixXd assurance;       // rows ours, columns theirs
  std::vector<std::int64_t> ours;  // best of ours for each of theirs; −1 where none reaches 0.5
  double share = 0.0;              // of our mass that has a partner
};
Pairing pair_modes(const ModesFile& ours, const ModesFile& theirs);
/// One line for each of their modes: their frequency, ours, change, assurance, motion.
std::string pairing_table(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing,
                          const std::string& ours_name, const std::string& theirs_name);

/// Periods that the case expects against those found.
struct PeriodCheck {
  ExpectedPeriod expected;
  double found = 0.0;  // s; 0: no such mode among those found
  double error() const { return found / expected.period - 1.0; }
};
std::vector<PeriodCheck> check_periods(const std::vector<ExpectedPeriod>& expected, const std::vector<Mode>& modes);
std::string periods_table(const std::vector<PeriodCheck>& checks);

nlohmann::json modes_json(const ModesFile& file, const Assembly& assembly, const Modes& modes);
nlohmann::json pairing_json(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing);
nlohmann::json periods_json(const std::vector<PeriodCheck>& checks);

}  // namespace voussoir
