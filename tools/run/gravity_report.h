// The effects of gravity on a bridge, before any other loading: settlements, lost bonds, stresses and periods. Stored
// in DIR/gravity.json (docs/formats.md), one entry for each gravity stage, for the log, the summary and the page.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "solver/run/simulation.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// The entry of the stage that has just ended. It has
/// - the parts (parts_of_blocks()) with their displacements since they were built (m),
/// - the families of joints (joint_family()) with the share of bond lost, the largest opening and slip (m) and the
///   largest compression (Pa, mean over a joint), each with its place,
/// - the first `modes` periods of the bridge (s), intact and at present,
/// - a warning if gravity alone has damaged the bridge, otherwise an empty text.
nlohmann::json gravity_report(const Simulation& run, const Snapshot& snapshot, int modes);

/// The text for the log, about a dozen lines.
std::string gravity_text(const nlohmann::json& report);
/// The section for the page of a run, as HTML; empty without reports.
std::string gravity_section(const nlohmann::json& reports);

}  // namespace voussoir
