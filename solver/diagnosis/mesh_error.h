// Effect of the block size on frequencies and shapes, computed with a coarser mesh.
#pragma once
#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/response.h"

namespace voussoir {

/// The same bridge with blocks 1.25 times as large.
struct CoarserMesh {
  Assembly assembly;
  std::vector<Sensor> sensors;  // on its blocks
  double farther = 1.0;         // difference in size between the mesh of the model and the real stones, over that
                                // between the two meshes
};

struct MeshError {
  double shift = 0.0;    // mean change of the logarithms of frequencies: equivalent to a change of stiffness, which is
                         // fitted
  double scatter = 0.0;  // standard deviation of the changes about `shift`
  double shape = 0.0;    // root mean square difference of shapes, share of the largest component
  /// Logarithms of frequencies (minus the shift) and values at the sensors: of the coarser mesh minus those of the
  /// model, zero for modes that only one of them has. Other members are empty.
  ModalData difference;
};

/// The error between the coarser mesh, with a hypothesis applied at x, and the model with this response. It compares
/// those of the lowest modes that have the same direction and frequencies within about 15 %; zero if there are none.
/// Throws the exceptions of Hypothesis::assembly() and linear_model().
MeshError mesh_error(const CoarserMesh& coarser, const Response& response, const Hypothesis& hypothesis,
                     const Eigen::VectorXd& x, int modes);

}  // namespace voussoir
