// Whether two stones that touch along an edge are held there by others: then the edge has nothing to carry.
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// The joints of each body, both ways; ties are none.
class JointsOfBodies {
 public:
  explicit JointsOfBodies(const Model& model);

  /// Whether a living joint of the two bodies, or a joint of each of them with some other, ends within `reach` (m) of a
  /// place where they stand now, all of them being about it as they were built. In masonry nearly every edge beside an
  /// edge and every corner at a corner is such a place: the stones of a bond fill the space around it.
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
