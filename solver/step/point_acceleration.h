// Acceleration of a point of a block, from the change of velocity in the present time step.
#pragma once
#include "solver/step/body_pass.h"

namespace voussoir {

/// Acceleration (m/s2) in a frame at rest, the motion of the ground included, at the present time step of a point that
/// was at `position` in the assembly: zero for a block at rest under its weight, g for one that falls. Call it between
/// patches and bodies of a time step (see Stepper::advance), with its pass. The changes of velocity and angular
/// velocity from the last half step to the next are exactly those of the time step: a = dv/dt + α × r + ω × (ω × r).
Vec3 point_acceleration(const BodyPass& pass, std::int64_t block, const Vec3& position);

}  // namespace voussoir
