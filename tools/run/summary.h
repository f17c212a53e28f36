// The results of a run for summary.json: demand, sensors, reactions, damage, collapse (docs/formats.md).
#pragma once
#include <nlohmann/json.hpp>

#include "io/hdf5/history_file.h"
#include "solver/run/simulation.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// The members that follow from state and history. `collapse` is present only if the run has a collapse stage.
nlohmann::json summary_of_state(const Simulation& run, const Snapshot& snapshot, const History& history);

/// Numbers of joints of each kind: `bonded`, `dry`, `ties`, `fill` (patches with a deformable fill).
nlohmann::json joint_kinds_json(const Assembly& assembly);

}  // namespace voussoir
