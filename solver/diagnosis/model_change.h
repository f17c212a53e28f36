// Differences of stiffness and mass between two assemblies, by joint, block and element.
#pragma once
#include <tuple>

#include "solver/diagnosis/contributions.h"

namespace voussoir {

/// The faces of a joint or patch. Lists of joints and patches are sorted by them.
inline auto faces_of(const Joint& j) {
  return std::tuple(j.a, j.b, j.cell_a, j.cell_b, j.face_a, j.face_b);
}
inline auto faces_of(const FillJoint& j) {
  return std::tuple(j.block, j.cell, j.face, j.triangle);
}
/// Calls use(joint of low, joint of high), or the same for patches, in the order of their faces. One of the two may be
/// null.
template <class Joints, class Use>
void match(const Joints& low, const Joints& high, const Use& use) {
  auto l = low.begin(), h = high.begin();
  while (l != low.end() || h != high.end()) {
    const bool only_low = h == high.end() || (l != low.end() && faces_of(*l) < faces_of(*h));
    const bool only_high = !only_low && (l == low.end() || faces_of(*h) < faces_of(*l));
    use(only_high ? nullptr : &*l, only_low ? nullptr : &*h);
    if (!only_high) ++l;
    if (!only_low) ++h;
  }
}

/// (K, M of `high` − K, M of `low`)/apart. Both have the same blocks except for their masses, and the same mesh of the
/// fill. `high` may have further blocks, and fixed blocks of `low` may be free in it: see with_freed(). Joints and
/// patches are matched by their faces. Throws InputError for assemblies that cannot be compared.
Contributions derivative(const Assembly& low, const Assembly& high, double apart);

/// Unknowns of the model of `from`, then six for each block that moves only in `to`. Sites are those of `to`.
Unknowns with_freed(const Unknowns& unknowns, const Assembly& from, const Assembly& to);

/// Units of the contributions() of an assembly whose stiffness or mass changes by one factor in all models of a kind.
struct Classes {
  std::vector<std::int32_t> of_stiffness, of_mass;         // class of each unit; −1: none
  std::vector<std::vector<std::int32_t>> stiffness, mass;  // units of each class
};
/// Determined from one model of the kind in which all variable units are changed.
Classes find_classes(const Assembly& origin, const Assembly& changed);

/// A changed model: K = K₀ + Σ (factor − 1) K_class + K of the others, M likewise.
struct Change {
  std::vector<double> stiffness, mass;  // factors, by class
  Contributions others;                 // all other changes
};
/// Without classes all changes are in `others`.
Change find_change(const Assembly& origin, const Classes& classes, const Assembly& changed);

}  // namespace voussoir
