#include "solver/step/principal_stress.h"

#include "solver/linear/dense_eigen.h"

namespace voussoir {

double largest_compression(const std::array<double, 6>& stress) {
  const auto& [xx, yy, zz, xy, yz, xz] = stress;
  Mat3 compression;
  compression << -xx, -xy, -xz, -xy, -yy, -yz, -xz, -yz, -zz;
  return largest_eigenvalue(compression);
}

}  // namespace voussoir
