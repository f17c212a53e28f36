// How stiffness and mass differ between two assemblies, joint by joint, block by block, element by element.
#pragma once
#include <tuple>

#include "solver/diagnosis/contributions.h"

namespace voussoir {

/// The faces that a joint, or a patch, joins: lists of them are in this order.
inline auto faces_of(const Joint& j) {
  return std::tuple(j.a, j.b, j.cell_a, j.cell_b, j.face_a, j.face_b);
}
inline auto faces_of(const FillJoint& j) {
  return std::tuple(j.block, j.cell, j.face, j.triangle);
}
/// Calls use(joint of low, joint of high), or patches, in the order of the faces that they join; one of them may be
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

/// (K, M of `high` − K, M of `low`)/apart. Both have the same blocks, but for their mass, and the same mesh of the
/// fill; `high` may have further blocks, and fixed ones of `low` may be free in it: see with_freed(). Joints and
/// patches are matched by the faces that they join. Throws InputError for assemblies that cannot be compared.
Contributions derivative(const Assembly& low, const Assembly& high, double apart);

/// Unknowns of the model of `from`, then six of each block that moves in `to` alone. Sites are those of `to`.
Unknowns with_freed(const Unknowns& unknowns, const Assembly& from, const Assembly& to);

/// Units of the contributions() of an assembly whose stiffness or mass changes by one factor in all models of a kind.
struct Classes {
  std::vector<std::int32_t> of_stiffness, of_mass;         // class of each unit; −1: none
  std::vector<std::vector<std::int32_t>> stiffness, mass;  // units of each class
};
/// Found from one model of the kind, in which what may differ does.
Classes find_classes(const Assembly& origin, const Assembly& changed);

/// A changed model: K = K₀ + Σ (factor − 1) K_class + K of the others, M likewise.
struct Change {
  std::vector<double> stiffness, mass;  // factors, by class
  Contributions others;                 // what changes in any other way
};
/// Without classes all that changes is among the others.
Change find_change(const Assembly& origin, const Classes& classes, const Assembly& changed);

}  // namespace voussoir
