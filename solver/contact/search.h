// Search for contacts that appear and change during a run. A patch is made before its bodies touch, as soon as their
// distance is below the skin. It has a gap, so that the joint law handles the first touch and time steps need no narrow
// phase.
#pragma once
#include <span>

#include "solver/contact/patch_kernel.h"

namespace voussoir {

struct ContactUpdate {
  std::int64_t examined = 0;  // pairs of cells examined in the narrow phase
  bool listed = false;        // whether pairs were listed again
  std::int64_t made = 0, clipped = 0, dropped = 0;
  std::vector<std::int32_t> bodies;  // bodies with a new or reclipped patch; repetitions are possible
  std::vector<std::int32_t> nodes;   // nodes of the fill model with such a patch; repetitions are possible
  bool changed() const { return made + clipped + dropped > 0; }
  /// Whether the assignment of patches to slots has changed. Otherwise Stepper::prepare_contacts() is not necessary.
  bool moved = false;
};

/// The distance below which a contact is made before two cells touch, m.
inline double skin(const Model& model) {
  return model.contact.skin * model.typical_size;
}

// Shares of the skin (derivation in docs/theory/contacts.md): motion of a body that requires a search; motion beyond
// which a body counts as moved in a search; least allowed relative motion of an examined pair; distance at which pairs
// are listed; motion of a body after which its pairs are listed again.
constexpr double search_share = 0.25, moved_share = 0.1, least_pair_share = 0.3;
constexpr double list_margin = 6.0, list_distance = 2.7;

/// A rotation by φ changes the quaternion by d = 2 sin(φ/4). It moves a point at the distance r from the axis by
/// 2 r sin(φ/2) ≤ 2 d r. The value has a small margin above 2.
constexpr double quaternion_reach = 2.1;

/// Upper bound of the motion of any point of the body, relative to the base, since its position was noted in
/// State::searched or State::listed, m. It is 0 for lost bodies, which are not searched.
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

/// Notes the position of the body in State::searched or State::listed.
void note_place(const State& state, std::size_t body, Array<float>& places);

/// The distance (m) a body may move, relative to the base, between searches.
inline double search_distance(const Model& model) {
  return model.contact.search ? search_share * skin(model) : 1e300;
}

/// Patches beyond their limits of slip and rotation are reclipped at most every 32nd time step, so that a sliding wall
/// does not interrupt every time step.
constexpr std::int64_t clip_interval = 32;
inline bool may_clip_at(std::int64_t step) {
  return step % clip_interval == 0;
}

/// Searches for new contacts around the bodies that have moved since the last search, and removes their contacts that
/// have separated. In the tiles `past`, in order, patches beyond their limits of slip or rotation are reclipped (force
/// and moment are transferred). The result depends only on the state and `past`, for any number of threads. Call
/// Stepper::prepare_contacts() afterwards if patches have moved to other slots.
ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches,
                              std::span<const std::int32_t> past, int threads = 1);
/// The same for all tiles; with `clip`, all patches beyond their limits are reclipped.
ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches, bool clip = true,
                              int threads = 1);

}  // namespace voussoir
