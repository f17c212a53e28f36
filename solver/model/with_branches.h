// Selects kernels that are compiled for the number of damping branches, which is known when a run begins.
#pragma once
#include <type_traits>

#include "solver/model/branches.h"

namespace voussoir {

/// Calls use(std::integral_constant<int, count>()).
template <class Use>
auto with_branches(int count, const Use& use) {
  static_assert(most_branches == 4);
  switch (count) {
    case 0:
      return use(std::integral_constant<int, 0>());
    case 1:
      return use(std::integral_constant<int, 1>());
    case 2:
      return use(std::integral_constant<int, 2>());
    case 3:
      return use(std::integral_constant<int, 3>());
    default:
      return use(std::integral_constant<int, 4>());
  }
}

}  // namespace voussoir
