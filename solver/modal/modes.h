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

/// Description of a mode.
struct ModeWords {
  std::string direction;  // longitudinal (x), transverse (y), vertical (z), torsional; local, rigid motion, mechanism,
                          // unstable
  int order = 0;          // 1 + changes of sign along the longest axis of the assembly; 0 if it has no meaning
  std::string detail;     // "with vertical"; of a local mode and a mechanism, the component that moves
  std::string text() const;  // "transverse, 1st order"
};

struct Mode {
  double eigenvalue = 0.0;  // rad2/s2; negative if the state is unstable
  double frequency = 0.0;   // Hz; 0 for a rigid motion or a mechanism, or if the eigenvalue is negative
  double period() const { return frequency > 0.0 ? 1.0 / frequency : 0.0; }  // s; 0: none
  BlockMotions shape;  // scaled to a largest displacement of 1 (rotations: rad per metre of it), which is positive in
                       // its largest component
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
  std::vector<std::int64_t> adrift;  // blocks that nothing holds; they are left out
  std::vector<std::int64_t> partly;  // blocks that can move freely in some direction; they are held in it
  ModesReport report;
};

/// The `count` lowest modes at the present placement, and up to `extra` more if they exist. With `wrenches` the
/// geometric stiffness is included (see add_geometric_stiffness). Throws InputError if `count` is below 1 or exceeds
/// the number of unknowns that have a stiffness, or if the mass matrix of a block, which it names, is singular.
Modes find_modes(const Assembly& assembly, const Model& model, const State& state, int count, PatchTangent tangent,
                 const Array<double>* wrenches = nullptr, int extra = 0);

/// Direction and order of a mode, from the distribution of its kinetic energy.
ModeWords mode_words(const Assembly& assembly, const Mode& mode);

/// Blocks of one assembly and their partners in another.
struct BlockPairs {
  std::vector<std::pair<std::int64_t, std::int64_t>> blocks;  // of a, of b
  std::vector<double> mass;                                   // kg, of a's
  double share = 0.0;                                         // of the mass of a that has a partner
};
/// Data of the blocks for pairing; the mass of a fixed block is zero.
struct BlockPlaces {
  std::vector<Vec3> centroid;  // m, reference placement
  std::vector<double> mass;    // kg
  double size = 0.0;           // m, median block
};
BlockPlaces block_places(const Assembly& assembly, const Model& model);
/// Each moving block of a with the nearest moving one of b, no farther than the larger of the two sizes.
BlockPairs pair_blocks(const BlockPlaces& a, const BlockPlaces& b);
/// Modal assurance criterion |φᵀ W ψ|² / (φᵀ W φ)(ψᵀ W ψ) over the displacements of paired blocks, W their masses
/// (Allemang 2003, eq. 4). Rows are the modes of `a`, columns those of `b`.
Eigen::MatrixXd assurance(const std::vector<Mode>& a, const std::vector<Mode>& b, const BlockPairs& pairs);

}  // namespace voussoir
