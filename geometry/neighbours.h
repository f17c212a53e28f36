// Broad phase of the contact search: pairs of boxes that are close to each other.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Pairs (i, j), i < j, of boxes that come within `distance` (m) of each other along all three axes, sorted. Negative
/// distances find boxes that overlap by more than that. The method is a sweep along the axis on which the boxes spread
/// most (after Baraff 1992), in columns of a grid across it. The time is therefore proportional to the number of boxes
/// even if many are side by side (after Tracy, Buss & Woods 2009).
std::vector<std::pair<int, int>> neighbours(const std::vector<Box>& boxes, double distance);

/// An index of boxes for many queries, also by several threads at once.
class BoxIndex {
 public:
  /// `distance` as above, not negative.
  BoxIndex(const std::vector<Box>& boxes, double distance);
  ~BoxIndex();
  /// Replaces the contents of `found` by the numbers of the boxes that come within the distance of `box`, lowest first.
  void near(const Box& box, std::vector<int>& found) const;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

}  // namespace voussoir
