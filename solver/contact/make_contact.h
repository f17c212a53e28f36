// Makes a contact patch from two convex cells in their present placement.
#pragma once
#include <optional>

#include "solver/contact/enclosed.h"
#include "solver/contact/jump.h"

namespace voussoir {

/// A patch with its points and corners, not yet in the lists of the state.
struct NewContact {
  Patch patch;  // first_point and first_corner are zero
  std::vector<PatchPoint> points, corners;
  Array<double> memory;           // 4 per point: plastic jump n, s, t (m), softening
  double carried_opening = 0.0;   // m, largest of the patch it replaces
  double slid[4] = {0, 0, 0, 0};  // see State::contact_slid
};

/// Relative position of two cells.
struct Examined {
  std::optional<NewContact> contact;  // none: the cells are apart, or their common area is too small
  double apart = 0.0;                 // m, lower bound of their distance if it exceeds `within`
};

/// Examines two cells in their present placement. A contact is made if their distance is at most `within` (m).
Examined make_contact(const Model& model, const State& state, const JointsOfBodies& joints, const CellPair& cells,
                      const Convex& placed_a, const Convex& placed_b, double within);

/// Sets the plastic slip of `contact`, and shifts its gap, so that it carries the elastic force that `old` (with its
/// points and memory) carries now. It also carries the moment if the new patch is then wholly closed. If this needs
/// more elastic energy than the old patch has (`energy`, J), all tractions are reduced accordingly. Nothing is
/// transferred if the old normal force is not compressive.
void carry_over(const Model& model, const State& state, const Patch& old, const Array<double>& points,
                const PatchMemory& memory, double energy, NewContact& contact);

/// Mean plastic slip of the points of a patch since it was made (m, world axes, body b relative to a).
Vec3 mean_slip(const State& state, const Patch& patch, const Array<double>& points, const PatchMemory& memory);

/// The cell in its present placement.
Convex placed_cell(const Model& model, const State& state, std::int32_t body, std::int32_t cell);

}  // namespace voussoir
