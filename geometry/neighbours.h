// Broad phase: which boxes meet.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Pairs (i, j), i < j, of boxes that come within `distance` (m) of each other along all three axes, sorted. Negative
/// distances ask for boxes that interpenetrate by more than that. Sweep along the axis on which the boxes spread most
/// (after Baraff 1992), column by column of a grid across it, so that the time grows with the number of boxes however
/// many stand side by side (after Tracy, Buss & Woods 2009).
std::vector<std::pair<int, int>> neighbours(const std::vector<Box>& boxes, double distance);

/// The same boxes to be asked many times, by several threads at once.
class BoxIndex {
 public:
  /// `distance` as above, not negative.
  BoxIndex(const std::vector<Box>& boxes, double distance);
  ~BoxIndex();
  /// Puts the numbers of the boxes that come within the distance of `box` into `found`, lowest first.
  void near(const Box& box, std::vector<int>& found) const;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

}  // namespace voussoir
