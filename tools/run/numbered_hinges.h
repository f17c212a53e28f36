// The hinges and sliding joints of a mechanism as a reader counts them.
#pragma once
#include <string>
#include <vector>

#include "solver/statics/collapse.h"

namespace voussoir {

/// Joints of a mechanism that move alike side by side: the width of a ring is one hinge.
struct NumberedHinge {
  int number = 0;  // from 1, from left to right
  bool slides = false;
  std::string edge;           // that stays closed: "intrados", "extrados" or empty
  std::string where;          // "arch 0", "between arch 0 and pier 1"
  Vec3 place = Vec3::Zero();  // m, as built: mean of the joints' places
  std::int64_t a = 0;         // a block beside it
  int joints = 0;
  double opening = 0.0, slip = 0.0;  // the largest, shares of the largest displacement
};

/// `size` (m) is that of a usual block: joints within a half of it in the plane x-z and one and a half across belong
/// together where they do the same.
std::vector<NumberedHinge> numbered_hinges(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism,
                                           double size);

}  // namespace voussoir
