// Tables and JSON of an eigenvalue analysis.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "io/case/case.h"
#include "io/hdf5/modes_file.h"

namespace voussoir {

/// One line for each mode: frequency, period, effective mass and its running sum, participation, damping, motion.
std::string modes_table(const ModesFile& file);
/// The cost of the analysis: unknowns, seconds, memory.
std::string effort_text(const ModesReport& report);
/// The blocks that were left out or held because no joint holds them, up to six by name; empty if all blocks are held.
std::string loose_text(const Assembly& assembly, const Modes& modes);

/// Modes of another analysis, each paired with the best of our modes by the modal assurance criterion (MAC).
struct Pairing {
  Eigen::MatrixXd assurance;       // MAC; rows are our modes, columns theirs
  std::vector<std::int64_t> ours;  // our best mode for each of theirs; −1 if none reaches a MAC of 0.5
  double share = 0.0;              // share of our mass whose blocks have a partner
};
/// Throws InputError if less than half of our mass has a partner. It needs no modes, so it can be called before they
/// are computed.
void check_same_structure(const BlockPlaces& ours, const BlockPlaces& theirs);
/// Throws the error of check_same_structure().
Pairing pair_modes(const ModesFile& ours, const ModesFile& theirs);
/// One line for each of their modes: their frequency, ours, change, MAC, motion.
std::string pairing_table(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing,
                          const std::string& ours_name, const std::string& theirs_name);

/// A period that the case expects, and the computed one.
struct PeriodCheck {
  ExpectedPeriod expected;
  double found = 0.0;                                             // s; 0: no such mode among the computed ones
  double error() const { return found / expected.period - 1.0; }  // relative; only if found > 0
};
std::vector<PeriodCheck> check_periods(const std::vector<ExpectedPeriod>& expected, const std::vector<Mode>& modes);
std::string periods_table(const std::vector<PeriodCheck>& checks);

nlohmann::json modes_json(const ModesFile& file, const Assembly& assembly, const Modes& modes);
nlohmann::json pairing_json(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing);
nlohmann::json periods_json(const std::vector<PeriodCheck>& checks);

}  // namespace voussoir
