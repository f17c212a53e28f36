// Vibration modes of an assembly in a given state (docs/theory/modes.md).
#pragma once
#include <string>

#include "solver/linear/eigenpairs.h"
#include "solver/linear/stiffness.h"

namespace voussoir {

/// Per block, in the assembly's order: displacement of the centroid and rotation vector, world axes.
using BlockMotions = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Per node of the fill's mesh: displacement, world axes.
using NodeMotions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A mode in words.
struct ModeWords {
  std::string direction;  // longitudinal (x), transverse (y), vertical (z), torsional; local, rigid motion, mechanism,
                          // unstable
  int order = 0;          // 1 + changes of sign along the assembly's longest axis; 0 where that says nothing
  std::string detail;     // "with vertical"; of a local mode and a mechanism, the component that moves
  std::string text() const;  // "transverse, 1st order"
};

struct Mode {
  double eigenvalue = 0.0;  // rad2/s2; negative where the state is unstable
  double frequency = 0.0;   // Hz; 0 for a rigid motion or a mechanism, or where the eigenvalue is negative
  double period() const { return frequency > 0.0 ? 1.0 / frequency : 0.0; }  // s; 0: none
  BlockMotions shape;  // largest displacement 1 (1/m: rotations per metre of it), positive in its largest component
  NodeMotions nodes;   // of the fill's mesh, to the same scale
  double modal_mass = 0.0;            // kg, φᵀ M φ of that shape
  Vec3 participation = Vec3::Zero();  // φᵀ M r / φᵀ M φ of that shape, r a ground motion along x, y, z
  Vec3 effective = Vec3::Zero();      // kg, (φᵀ M r)² / φᵀ M φ
  double residual = 0.0;              // |K φ − λ M φ| / |λ M φ|, in the norm of diag(M)⁻¹; 0 where λ is zero
  ModeWords words;
};

struct ModesReport {
  std::int32_t unknowns = 0;
  double assembly_seconds = 0.0;
  Eigenpairs solution;  // without vectors
};

struct Modes {
  std::vector<Mode> modes;
  double mass = 0.0;                 // kg, of all blocks that can move, and of the fill
  std::vector<std::int64_t> adrift;  // blocks that nothing holds: left out
  std::vector<std::int64_t> partly;  // blocks that can move some way on their own: held in that way
  ModesReport report;
};

/// The `count` lowest modes at the present placement, and up to `extra` more where there are as many. With `wrenches`
/// (see add_geometric_stiffness) theirs is included. Throws InputError for more modes than unknowns, when nothing
/// is held together, or for a block whose mass matrix is singular, which it names.
Modes find_modes(const Assembly& assembly, const Model& model, const State& state, int count, PatchTangent tangent,
                 const Array<double>* wrenches = nullptr, int extra = 0);

/// Where most of the kinetic energy of a mode goes.
ModeWords mode_words(const Assembly& assembly, const Mode& mode);

/// Modal assurance criterion |φᵀ W ψ|² / (φᵀ W φ)(ψᵀ W ψ) over the displacements of paired blocks, W their masses
/// (Allemang 2003, eq. 4). Rows are the modes of `a`.
struct BlockPairs {
  std::vector<std::pair<std::int64_t, std::int64_t>> blocks;  // of a, of b
  std::vector<double> mass;                                   // kg, of a's
  double share = 0.0;                                         // of the mass of a that has a partner
};
/// What pairing needs to know of an assembly's blocks; mass zero where a block is fixed.
struct BlockPlaces {
  std::vector<Vec3> centroid;  // m, reference placement
  std::vector<double> mass;    // kg
  double size = 0.0;           // m, median block
};
BlockPlaces block_places(const Assembly& assembly, const Model& model);
/// Each moving block of a with the nearest moving one of b, no farther than the larger of the two sizes.
BlockPairs pair_blocks(const BlockPlaces& a, const BlockPlaces& b);
Eigen::MatrixXd assurance(const std::vector<Mode>& a, const std::vector<Mode>& b, const BlockPairs& pairs);

}  // namespace voussoir
