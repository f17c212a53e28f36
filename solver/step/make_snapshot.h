// Makes snapshots: the state in the form for files and pictures, with blocks, joints and fill in the order of the
// assembly.
#pragma once
#include "solver/model/state.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Shear capacity of a patch, N: Mohr–Coulomb with the mean compression. The area without bond has the residual
/// strength. It depends on area, normal traction and bond; infinite for an elastic law.
double shear_capacity(const LawConstants& law, const PatchSnapshot& patch);

/// Contacts found during the run follow the assembly's joints.
Snapshot make_snapshot(const Model& model, const State& state);

/// Makes the present placement, relative to the base, the reference for later displacements and rotations.
void set_baseline(State& state);

/// Displacement (m) relative to the base, since the assembly as built, of a point that was at `position` in it.
Vec3 displacement_since_built(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Displacement (m) relative to the base and to the last gravity stage of a point that was at `position` in the
/// assembly. It corresponds to the reading of an instrument that was set to zero at the end of the last gravity stage.
Vec3 relative_displacement(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Rotation vector (rad) of a block, world axes, since the end of the last gravity stage.
Vec3 relative_rotation(const Model& model, const State& state, std::int64_t block);

/// Velocity (m/s), the motion of the ground included, at the last half step of a point that was at `position` in the
/// assembly.
Vec3 point_velocity(const Model& model, const State& state, std::int64_t block, const Vec3& position);

/// Share of the mass of all free blocks and of the fill that has moved farther than `distance` (m) relative to the
/// base: centroids of blocks since the last gravity stage, nodes of the fill since the assembly as built. A
/// displacement that is not a number counts as farther.
double fallen_share(const Model& model, const State& state, double distance);

}  // namespace voussoir
