// Numbers of the joints of an assembly by kind.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct JointCounts {
  std::int64_t bonded = 0, dry = 0;  // bonded: with tensile strength or cohesion, or elastic; dry: all others
  std::int64_t ties = 0;
  std::int64_t fill = 0;  // patches between stones and a deformable fill
};

JointCounts count_joints(const Assembly& assembly);
/// "96 joints: 40 bonded, 56 dry", then ", 2 ties" and ", 120 patches with the fill" if there are any.
std::string joints_text(const Assembly& assembly);

}  // namespace voussoir
