// Decides whether two stones that touch along an edge are held there by other stones. The edge then carries no force.
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// The joints of each body, in both directions, without ties.
class JointsOfBodies {
 public:
  explicit JointsOfBodies(const Model& model);

  /// Whether an active joint of the two bodies, or a joint of each of them with another body, ends within `reach` (m)
  /// of the present contact position, with all of these bodies near their positions as built. In masonry this holds for
  /// nearly all contacts of an edge with an edge or of a corner with a corner, because the stones of a bond fill the
  /// space around them.
  bool enclose(const State& state, const CellPair& cells, const Vec3& place, double reach) const;

 private:
  struct Entry {
    std::int32_t other, joint;  // body, index in Assembly::joints
  };
  std::pair<const Entry*, const Entry*> of(std::int32_t body) const;
  const Patch& patch(const Entry& entry) const;

  const Model& model_;
  std::vector<std::int32_t> first_;  // of each body, and one past the end
  std::vector<Entry> entries_;
};

}  // namespace voussoir
