// Contacts that appear and change during a run. A patch exists before its bodies touch: as soon as they come within the
// skin, with its gap, so that the law itself sees them meet and no step needs a narrow phase.
#pragma once
#include "solver/contact/patch_kernel.h"

namespace voussoir {

struct ContactUpdate {
  std::int64_t examined = 0;  // pairs of cells given to the narrow phase
  std::int64_t made = 0, clipped = 0, dropped = 0;
  bool changed() const { return made + clipped + dropped > 0; }
};

/// How far any point of the body has moved, relative to the base, since its contacts were last looked for: an upper
/// bound, m.
inline double moved_since_search(const Model& model, const State& state, std::size_t body, const double* base) {
  const double* pose = &state.pose[pose_width * body];
  const float* from = &state.searched[searched_width * body];
  double d2 = 0.0, r2 = 0.0;
  for (int c = 0; c < 3; ++c) d2 += (pose[c] - base[c] - double(from[c])) * (pose[c] - base[c] - double(from[c]));
  for (int c = 3; c < 7; ++c) r2 += (pose[c] - double(from[c])) * (pose[c] - double(from[c]));
  // A turn by φ moves the quaternion by 2 sin(φ/4) >= φ/2.1 up to half a turn.
  return std::sqrt(d2) + 2.1 * std::sqrt(r2) * model.bodies[body].radius;
}

/// The distance (m) a body may move, relative to the base, between searches: 0.4 of the skin. Pairs farther apart than
/// the skin when last examined cannot have met: one of the two has moved at most 0.4 of it since, the other that and
/// the 0.2 within which a body counts as not having moved.
double search_distance(const Model& model);

/// Patches past their limits of slip and turn are clipped anew at every 32nd step at the earliest, so that a sliding
/// wall does not stop the run at each step.
inline bool may_clip_at(std::int64_t step) {
  return step % 32 == 0;
}

/// Looks for new contacts around the bodies that have moved since they were last looked at, and drops contacts of
/// theirs that have parted; with `clip` all patches that have slid or turned past their limits are clipped anew (force
/// and moment carried over). Serial and decided by the state alone. Afterwards Stepper::prepare() must be called.
ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches, bool clip = true);

}  // namespace voussoir
