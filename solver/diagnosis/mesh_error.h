// What the size of the blocks does to frequencies and shapes: measured on a mesh that is coarser still.
#pragma once
#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/response.h"

namespace voussoir {

/// The same bridge in blocks 1.25 times as large.
struct CoarserMesh {
  Assembly assembly;
  std::vector<Sensor> sensors;  // on its blocks
  double farther = 1.0;         // distance of the model's mesh to the real stones over that between the two meshes
};

struct MeshError {
  double shift = 0.0;    // mean of the logarithms of frequencies: one of stiffness, which is fitted
  double scatter = 0.0;  // their standard deviation about it
  double shape = 0.0;    // root mean square difference of shapes, share of the largest component
  /// Modes on the coarser mesh less those of the model, where both have them; frequencies less the shift.
  ModalData difference;
};

/// Between the coarser mesh with a hypothesis in place at x and the model, whose response this is. Of the lowest modes,
/// those of the same direction and order whose frequencies are near; zero where there are none. Throws what
/// Hypothesis::assembly() and linear_model() throw.
MeshError mesh_error(const CoarserMesh& coarser, const Response& response, const Hypothesis& hypothesis,
                     const Eigen::VectorXd& x, int modes);

}  // namespace voussoir
