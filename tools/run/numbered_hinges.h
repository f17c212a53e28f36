// The hinges and sliding joints of a mechanism, joined and numbered for a reader.
#pragma once
#include <string>
#include <vector>

#include "solver/statics/collapse.h"

namespace voussoir {

/// A group of neighbouring joints of a mechanism that move in the same way, such as the joints across the width of a
/// ring.
struct NumberedHinge {
  int number = 0;  // from 1, from left to right
  bool slides = false;
  std::string edge;           // edge that stays closed: "intrados", "extrados" or empty
  std::string where;          // "arch 0", "between arch 0 and pier 1"
  Vec3 place = Vec3::Zero();  // m, as built: mean of the joints' places
  std::int64_t a = 0;         // a block next to it
  int joints = 0;
  double opening = 0.0, slip = 0.0;  // the largest, shares of the largest displacement
};

/// `size` (m) is the size of a usual block. Joints that move in the same way belong together if they are closer than
/// 0.5 of it in the plane x-z and 1.5 of it across.
std::vector<NumberedHinge> numbered_hinges(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism,
                                           double size);

/// The hinges and sliding joints with the largest motion (opening or slip), at most `most`, in their order. Pictures
/// use it, because more numbers would cover each other.
std::vector<NumberedHinge> largest_hinges(std::vector<NumberedHinge> all, std::size_t most);

}  // namespace voussoir
