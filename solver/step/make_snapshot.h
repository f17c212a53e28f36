// Snapshots: the state in the terms of files and pictures; blocks, joints and fill in the assembly's order.
#pragma once
#include "solver/model/state.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Contacts found during the run follow the assembly's joints.
Snapshot make_snapshot(const Model& model, const State& state);

/// Displacement (m) relative to the base and to the last gravity stage of a point that was at `position` in the
/// assembly.
Vec3 relative_displacement(const Model& model, const State& state, std::int64_t block, const Vec3& position);

}  // namespace voussoir
