// What a run comes to, for summary.json: demand, sensors, reactions, damage, collapse (docs/formats.md).
#pragma once
#include <nlohmann/json.hpp>

#include "io/hdf5/history_file.h"
#include "solver/run/simulation.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// The parts that follow from state and history; `collapse` only when the run looked for it.
nlohmann::json summary_of_state(const Simulation& run, const Snapshot& snapshot, const History& history);

/// Joints of each kind: `bonded`, `dry`, `ties`, `fill` (patches with a deformable fill).
nlohmann::json joint_kinds_json(const Assembly& assembly);

}  // namespace voussoir
