// What gravity did to a bridge: settlements, lost bonds, stresses and periods, before an earthquake finds it
// (docs/formats.md). Kept in DIR/gravity.json, one entry a gravity stage, for the log, the summary and the page.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "solver/run/simulation.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Of the stage that has just ended. Parts (parts_of_blocks()) with what they have moved since they were built (m);
/// families of joints (joint_family()) with the share of bond lost, largest opening and slip (m) and compression (Pa,
/// mean over a joint), each with its place; the first `modes` of a bridge's periods (s), intact and now; a warning
/// where that is not how a bridge should meet an earthquake, else empty.
nlohmann::json gravity_report(const Simulation& run, const Snapshot& snapshot, int modes);

/// For the log: a dozen lines.
std::string gravity_text(const nlohmann::json& report);
/// For the page of a run: a section with tables; empty without reports.
std::string gravity_section(const nlohmann::json& reports);

}  // namespace voussoir
