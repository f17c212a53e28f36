// Acceleration of a point of a block, from what a step is about to do with the block.
#pragma once
#include "solver/step/body_pass.h"

namespace voussoir {

/// Acceleration (m/s2), the motion of the ground included, at the present step of a point that was at `position` in the
/// assembly: as an accelerometer there would show it, without gravity. Between patches and bodies of a step (see
/// Stepper::advance), whose pass it is. The change of the block's velocity from the last half step to the next is the
/// one that the step will make, exactly; of its spin too, with what turns the arm to the point: a = dv/dt + α × r +
/// ω × (ω × r).
Vec3 point_acceleration(const BodyPass& pass, std::int64_t block, const Vec3& position);

}  // namespace voussoir
