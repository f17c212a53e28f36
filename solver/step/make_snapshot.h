// Snapshots: the state in the terms of files and pictures; blocks, joints and fill in the assembly's order.
#pragma once
#include "solver/model/state.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// What a patch bears in shear, N: Mohr–Coulomb with the mean compression; what has lost its bond counts with the
/// residual strength. Looks at area, normal traction and bond; infinite for an elastic law.
double shear_capacity(const LawConstants& law, const PatchSnapshot& patch);

/// Contacts found during the run follow the assembly's joints.
Snapshot make_snapshot(const Model& model, const State& state);

/// Displacements and rotations count from the present placement, relative to the base, from now on.
void set_baseline(State& state);

/// Displacement (m) relative to the base, since the assembly as built, of a point that was at `position` in it.
Vec3 displacement_since_built(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Displacement (m) relative to the base and to the last gravity stage of a point that was at `position` in the
/// assembly. As an instrument would show it that was set to zero when the last gravity stage ended.
Vec3 relative_displacement(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Rotation vector (rad) of a block, world axes, since the end of the last gravity stage.
Vec3 relative_rotation(const Model& model, const State& state, std::int64_t block);

/// Velocity (m/s), the motion of the ground included, at the last half step of a point that was at `position` in the
/// assembly.
Vec3 point_velocity(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Share of the mass of all free blocks and of the fill that has gone farther than `distance` (m) relative to the base:
/// blocks by their centroids since the last gravity stage, nodes of the fill since all was built. A displacement that
/// is not a number counts as farther.
double fallen_share(const Model& model, const State& state, double distance);

}  // namespace voussoir
