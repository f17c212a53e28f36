// Contributions of the joints, blocks, fill elements and patches of an intact assembly to its stiffness matrix K and
// mass matrix M, computed directly from the assembly, and products with their sums without forming a matrix.
#pragma once
#include "geometry/assembly.h"
#include "solver/linear/fill_stiffness.h"

namespace voussoir {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix15 = Eigen::Matrix<double, 15, 15>;

/// Stiffness of a joint for the motions (du_a, dθ_a, du_b, dθ_b) of its blocks: N/m, N, N m. The patch is fully bonded,
/// as in solver/linear/stiffness.h. A tie acts only along its axis.
Matrix12 pair_stiffness(const Assembly& assembly, const Joint& joint);
/// Stiffness of a fully bonded patch with the fill for the motions (du, dθ) of its block and those of the corners of
/// its triangle.
Matrix15 patch_stiffness(const Assembly& assembly, const FillJoint& patch);
/// Elements of the fill in the geometry of the mesh; nodes as in FillMesh. Throws InputError for a material that is not
/// valid for a fill.
std::vector<FillElement> fill_elements(const Assembly& assembly);
/// diag(m 1, I) of a block: kg, kg m2.
Matrix6 block_mass(const Block& block);

/// Terms of K and M, or of the difference or derivative of two models. A node n of the fill is the site
/// Unknowns::bodies + n. Units of K are the terms in the order pairs, patches, elements, rings; those of M blocks,
/// lumps.
struct Contributions {
  struct Pair {
    std::int64_t a = 0, b = 0;  // blocks
    Matrix12 k;
  };
  struct Patch {
    std::int64_t block = 0;
    std::array<std::int32_t, 3> nodes = {};
    Matrix15 k;
  };
  struct Element {  // deviatoric part only
    std::array<std::int32_t, 4> nodes = {};
    std::array<Vec3, 4> gradient;  // 1/m
    double scale = 0.0;            // N m: V μ
  };
  struct Ring {  // mean volumetric strain about a node: scale pull pullᵀ
    std::vector<std::int32_t> nodes;
    std::vector<Vec3> pull;  // N
    double scale = 0.0;      // 1/(N m)
  };
  struct Own {
    std::int64_t block = 0;
    Matrix6 m;
  };
  struct Lump {
    std::array<std::int32_t, 4> nodes = {};
    double mass = 0.0;  // kg, on each of them
  };
  std::vector<Pair> pairs;
  std::vector<Patch> patches;
  std::vector<Element> elements;
  std::vector<Ring> rings;
  std::vector<Own> blocks;
  std::vector<Lump> lumps;
};
/// The contributions of all joints, blocks, patches and elements in their order, and of the rings around all nodes.
/// Fixed blocks have their masses. Throws InputError as fill_elements(), and for a node of the fill without a
/// tetrahedron.
Contributions contributions(const Assembly& assembly);
/// Terms of one element, and of a ring from fill_rings().
Contributions::Element shear_term(const FillElement& element);
Contributions::Ring ring_term(FillRing ring);

/// Vectors over the unknowns, one in each column. The storage is by rows because joints read rows.
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A reference to such vectors, or to some of their columns.
using Basis = Eigen::Ref<const Vectors>;

/// K X and M X.
Vectors times_stiffness(const Contributions& c, const Unknowns& unknowns, const Vectors& x);
Vectors times_mass(const Contributions& c, const Unknowns& unknowns, const Vectors& x);
/// The same for one vector.
Eigen::VectorXd times_stiffness(const Contributions& c, const Unknowns& unknowns, const Eigen::VectorXd& x);
Eigen::VectorXd times_mass(const Contributions& c, const Unknowns& unknowns, const Eigen::VectorXd& x);
/// y += factor K x, or factor M x, with the contributions of the listed units only.
void add_stiffness(const Contributions& c, const std::vector<std::int32_t>& listed, double factor,
                   const Unknowns& unknowns, const Basis& x, Eigen::Ref<Vectors> y);
void add_mass(const Contributions& c, const std::vector<std::int32_t>& listed, double factor, const Unknowns& unknowns,
              const Basis& x, Eigen::Ref<Vectors> y);
/// Number of non-zero rows of K, or M, of the listed units.
Eigen::Index stiffness_rows(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns);
Eigen::Index mass_rows(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns);
/// Vᵀ K W and Vᵀ M W of all units, or of the listed ones. Zero rows of K and M are skipped.
Eigen::MatrixXd project_stiffness(const Contributions& c, const Unknowns& unknowns, const Basis& v, const Basis& w);
Eigen::MatrixXd project_mass(const Contributions& c, const Unknowns& unknowns, const Basis& v, const Basis& w);
Eigen::MatrixXd project_stiffness(const Contributions& c, const std::vector<std::int32_t>& listed,
                                  const Unknowns& unknowns, const Basis& v, const Basis& w);
Eigen::MatrixXd project_mass(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns,
                             const Basis& v, const Basis& w);

}  // namespace voussoir
