// A contact patch from the meeting of two convex cells in their present placement.
#pragma once
#include <optional>

#include "solver/contact/enclosed.h"
#include "solver/contact/jump.h"

namespace voussoir {

/// A patch with its own points and corners, not yet placed in the state's lists.
struct NewContact {
  Patch patch;  // first_point and first_corner are zero
  std::vector<PatchPoint> points, corners;
  Array<double> memory;           // 4 a point: plastic jump n, s, t (m), softening
  double carried_opening = 0.0;   // m, largest of the patch it replaces
  double slid[4] = {0, 0, 0, 0};  // see State::contact_slid
};

/// How two cells stand to each other.
struct Examined {
  std::optional<NewContact> contact;  // none: apart, or they share too little to carry anything
  double apart = 0.0;                 // m, where they are apart by more than was asked for: at least so far
};

/// Cells in their present placement; a contact is made when they are within `within` (m).
Examined make_contact(const Model& model, const State& state, const JointsOfBodies& joints, const CellPair& cells,
                      const Convex& placed_a, const Convex& placed_b, double within);

/// Sets the plastic slip of `contact`, and shifts its gap, so that it carries the elastic force and moment that `old`
/// (with its points and memory) carries now: the force always, the moment while the new patch is wholly closed. Where
/// that would take more elastic energy than the old patch holds (`energy`, J), all tractions are lowered until it does
/// not.
void carry_over(const Model& model, const State& state, const Patch& old, const Array<double>& points,
                const PatchMemory& memory, double energy, NewContact& contact);

/// Mean plastic slip of a patch's points (m, world axes, body b relative to a), since it was made.
Vec3 mean_slip(const State& state, const Patch& patch, const Array<double>& points, const PatchMemory& memory);

/// The cell in its present placement.
Convex placed_cell(const Model& model, const State& state, std::int32_t body, std::int32_t cell);

}  // namespace voussoir
