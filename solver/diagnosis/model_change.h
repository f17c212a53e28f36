// How stiffness and mass differ between two assemblies, joint by joint and block by block.
#pragma once
#include <tuple>

#include "solver/diagnosis/linear_model.h"

namespace voussoir {

/// How K and M change with a parameter: only the joints and blocks that do.
struct Derivative {
  struct Pair {
    std::int64_t a = 0, b = 0;  // blocks
    Matrix12 k;
  };
  struct Own {
    std::int64_t block = 0;
    Matrix6 m;
  };
  std::vector<Pair> pairs;
  std::vector<Own> blocks;
};
/// Calls use(joint of low, joint of high) in the order of the faces that they join; one of them may be null.
template <class Use>
void match_joints(const Assembly& low, const Assembly& high, const Use& use) {
  const auto key = [](const Joint& j) { return std::tuple(j.a, j.b, j.cell_a, j.cell_b, j.face_a, j.face_b); };
  auto l = low.joints.begin(), h = high.joints.begin();
  while (l != low.joints.end() || h != high.joints.end()) {
    const bool only_low = h == high.joints.end() || (l != low.joints.end() && key(*l) < key(*h));
    const bool only_high = !only_low && (l == low.joints.end() || key(*h) < key(*l));
    use(only_high ? nullptr : &*l, only_low ? nullptr : &*h);
    if (!only_high) ++l;
    if (!only_low) ++h;
  }
}

/// (K, M of `high` − K, M of `low`)/apart. Both have the same blocks, but for their mass; `high` may have further ones,
/// and fixed ones of `low` may be free in it: see with_freed(). Joints are matched by the faces that they join.
Derivative derivative(const Assembly& low, const Assembly& high, double apart);

/// Unknowns of the model of `from`, then six of each block that moves in `to` alone.
Unknowns with_freed(const Unknowns& unknowns, const Assembly& from, const Assembly& to);

/// Vectors over the unknowns, one a column; rows lie together, because joints ask for rows.
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// K′ X and M′ X.
Vectors times_stiffness(const Derivative& d, const Unknowns& unknowns, const Vectors& x);
Vectors times_mass(const Derivative& d, const Unknowns& unknowns, const Vectors& x);
/// y += factor K x of those pairs alone that are listed.
void add_products(const std::vector<Derivative::Pair>& pairs, const std::vector<std::int32_t>& listed, double factor,
                  const Unknowns& unknowns, const Vectors& x, Vectors& y);
/// The same of one vector.
Eigen::VectorXd times_stiffness(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x);
Eigen::VectorXd times_mass(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x);
/// Vᵀ K′ W and Vᵀ M′ W, without a pass over rows that K′ and M′ do not have.
Eigen::MatrixXd project_stiffness(const Derivative& d, const Unknowns& unknowns, const Vectors& v, const Vectors& w);
Eigen::MatrixXd project_mass(const Derivative& d, const Unknowns& unknowns, const Vectors& v, const Vectors& w);

/// Joints and blocks of an assembly whose stiffness or mass changes by one factor in all models of a kind.
struct Classes {
  std::vector<std::int32_t> of_joint, of_block;           // −1: none
  std::vector<std::vector<std::int32_t>> joints, blocks;  // of each class
};
/// Found from one model of the kind, in which what may differ does.
Classes find_classes(const Assembly& origin, const Assembly& changed);

/// A changed model: K = K₀ + Σ (factor − 1) K_class + K of the others, M likewise.
struct Change {
  std::vector<double> stiffness, mass;  // factors, by class
  Derivative others;                    // joints and blocks that change in any other way
};
/// Without classes all that changes is among the others.
Change find_change(const Assembly& origin, const Classes& classes, const Assembly& changed);

}  // namespace voussoir
