// Contacts that appear and change during a run. A patch exists before its bodies touch: as soon as they come within the
// skin, with its gap, so that the law itself sees them meet and no step needs a narrow phase.
#pragma once
#include <span>

#include "solver/contact/patch_kernel.h"

namespace voussoir {

struct ContactUpdate {
  std::int64_t examined = 0;  // pairs of cells given to the narrow phase
  bool listed = false;        // pairs were listed anew
  std::int64_t made = 0, clipped = 0, dropped = 0;
  std::vector<std::int32_t> bodies;  // that have got a contact, some more than once
  std::vector<std::int32_t> nodes;   // of the fill's model that have got a patch, some more than once
  bool changed() const { return made + clipped + dropped > 0; }
  /// Whether a patch has another place, or its place another patch: else Stepper::prepare_contacts() has nothing to do.
  bool moved = false;
};

/// The distance within which a contact is made before two cells touch, m.
inline double skin(const Model& model) {
  return model.contact.skin * model.typical_size;
}

// Shares of the skin (docs/theory/contacts.md says why they add up): how far a body may move before a search; past
// what it counts as moved in one; how far a pair that has been examined may move relative to each other, at least; how
// near pairs are listed; and how far a body may move until its pairs are listed anew.
constexpr double search_share = 0.25, moved_share = 0.1, least_pair_share = 0.3;
constexpr double list_margin = 6.0, list_distance = 2.7;

/// A turn by φ moves the quaternion by 2 sin(φ/4) ≥ φ/2.1 up to half a turn.
constexpr double quaternion_reach = 2.1;

/// How far any point of the body has moved, relative to the base, since its place was noted in State::searched or
/// State::listed: an upper bound, m. Of lost bodies 0: nobody looks for them.
inline double moved_since(const Model& model, const State& state, const Array<float>& places, std::size_t body,
                          const Vec3& base) {
  if (state.lost(body)) return 0.0;
  const double* pose = &state.pose[pose_width * body];
  const float* from = &places[searched_width * body];
  double d2 = 0.0, r2 = 0.0;
  for (int c = 0; c < 3; ++c) d2 += (pose[c] - base[c] - double(from[c])) * (pose[c] - base[c] - double(from[c]));
  for (int c = 3; c < 7; ++c) r2 += (pose[c] - double(from[c])) * (pose[c] - double(from[c]));
  return std::sqrt(d2) + quaternion_reach * std::sqrt(r2) * model.bodies[body].radius;
}

/// Notes the body's place in State::searched or State::listed.
void note_place(const State& state, std::size_t body, Array<float>& places);

/// The distance (m) a body may move, relative to the base, between searches.
inline double search_distance(const Model& model) {
  return model.contact.search ? search_share * skin(model) : 1e300;
}

/// Patches past their limits of slip and turn are clipped anew at every 32nd step at the earliest, so that a sliding
/// wall does not stop the run at each step.
constexpr std::int64_t clip_interval = 32;
inline bool may_clip_at(std::int64_t step) {
  return step % clip_interval == 0;
}

/// Looks for new contacts around the bodies that have moved since they were last looked at, and drops contacts of
/// theirs that have parted; in the tiles `past`, in order, patches that have slid or turned past their limits are
/// clipped anew (force and moment carried over). Decided by the state and `past` alone, whatever the number of threads.
/// Afterwards Stepper::prepare_contacts() must be called where patches have moved.
ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches,
                              std::span<const std::int32_t> past, int threads = 1);
/// With `clip` wherever a patch is past its limits.
ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches, bool clip = true,
                              int threads = 1);

}  // namespace voussoir
